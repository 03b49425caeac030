use core::str::FromStr;

use light_sets::SetPoint;
use lights::bounds::{Gloss, LightSampleContext};
use lights::glam::{DVec3, Vec3};

/// Albedo of the diffuse part of glossy receivers; the other half is reflected by microfacets.
const GLOSSY_DIFFUSE: f32 = 0.5;

/// The kind of receiver at the points of a set.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum BenchReceiverKind {
    /// A diffuse surface, lit from the front.
    #[default]
    Diffuse,
    /// A surface that scatters light equally from both sides.
    TwoSided,
    /// A point in a medium.
    Medium,
    /// A surface half diffuse, half microfacets of this roughness, each point seen from a direction
    /// of its own.
    Glossy(f32),
}

/// A receiver at a point of a set.
#[derive(Clone, Copy, Debug)]
pub(super) struct BenchReceiver {
    pub(super) at: SetPoint,
    pub(super) ctx: LightSampleContext,
    kind: BenchReceiverKind,
}

impl BenchReceiverKind {
    /// The receiver at the point of the given index.
    pub(super) fn receiver_at(self, index: usize, at: SetPoint) -> BenchReceiver {
        let ctx = match self {
            Self::Diffuse => LightSampleContext::surface(at.p, at.n, at.n),
            Self::TwoSided => LightSampleContext::two_sided(at.p, at.n, at.n),
            Self::Medium => LightSampleContext::medium(at.p),
            Self::Glossy(alpha) => {
                LightSampleContext::surface(at.p, at.n, at.n).with_gloss(Gloss {
                    wo: view(index, at.n),
                    alpha,
                    diffuse: GLOSSY_DIFFUSE,
                })
            }
        };
        BenchReceiver {
            at,
            ctx,
            kind: self,
        }
    }
}

impl BenchReceiver {
    /// The weight of light that arrives from the unit vector `wi`.
    pub(super) fn response(&self, wi: DVec3) -> f64 {
        let cos = self.at.n.as_dvec3().dot(wi);
        match self.kind {
            BenchReceiverKind::Diffuse => cos.max(0.0),
            BenchReceiverKind::TwoSided => cos.abs(),
            BenchReceiverKind::Medium => 1.0,
            BenchReceiverKind::Glossy(_) if cos <= 0.0 => 0.0,
            BenchReceiverKind::Glossy(_) => self.ctx.gloss().map_or(0.0, |gloss| {
                let n = self.at.n.as_dvec3();
                let diffuse = f64::from(gloss.diffuse) * core::f64::consts::FRAC_1_PI;
                (diffuse + (1.0 - f64::from(gloss.diffuse)) * microfacets(&gloss, n, wi)) * cos
            }),
        }
    }
}

/// Value of the microfacets for full reflectance: the GGX distribution with height-correlated
/// masking and shadowing.
///
/// # Source
/// `[Walter2007]`, equation 33; the masking is Smith's with the height correlation of
/// `[Heitz2014]`, equation 99.
fn microfacets(gloss: &Gloss, n: DVec3, wi: DVec3) -> f64 {
    let wo = gloss.wo.as_dvec3();
    let alpha_sq = f64::from(gloss.alpha) * f64::from(gloss.alpha);
    let cos_half = n.dot((wi + wo).normalize());
    let tail = cos_half * cos_half * (alpha_sq - 1.0) + 1.0;
    let distribution = alpha_sq / (core::f64::consts::PI * tail * tail);
    let (cos_i, cos_o) = (n.dot(wi), n.dot(wo));
    let lambda = |cos: f64| (alpha_sq + (1.0 - alpha_sq) * cos * cos).sqrt();
    distribution * 0.5 / (cos_i * lambda(cos_o) + cos_o * lambda(cos_i))
}

/// A unit vector on the side of `n`, uniform in the cosine over the points of a set.
fn view(index: usize, n: Vec3) -> Vec3 {
    // The plastic number's sequence: evenly spread in both dimensions.
    let x = (0.5 + 0.754_877_7 * index as f64).fract();
    let y = (0.5 + 0.569_840_3 * index as f64).fract();
    let cos = 0.05 + 0.95 * x;
    let sin = (1.0 - cos * cos).sqrt();
    let (s, c) = (core::f64::consts::TAU * y).sin_cos();
    let n = n.as_dvec3();
    let (a, b) = n.any_orthonormal_pair();
    (a * (sin * c) + b * (sin * s) + n * cos)
        .normalize()
        .as_vec3()
}

impl FromStr for BenchReceiverKind {
    type Err = &'static str;

    fn from_str(s: &str) -> Result<Self, Self::Err> {
        let expected = "expected diffuse, two-sided, medium, or glossy:ROUGHNESS with a roughness \
                        of 0.01 to 1";
        match s {
            "diffuse" => Ok(Self::Diffuse),
            "two-sided" => Ok(Self::TwoSided),
            "medium" => Ok(Self::Medium),
            _ => {
                let roughness = s.strip_prefix("glossy:").ok_or(expected)?;
                let roughness = roughness.parse().map_err(|_| expected)?;
                if (0.01..=1.0).contains(&roughness) {
                    Ok(Self::Glossy(roughness))
                } else {
                    Err(expected)
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_roughness_are_read() {
        assert_eq!(
            "two-sided".parse(),
            Ok(BenchReceiverKind::TwoSided),
            "a name"
        );
        assert_eq!(
            "glossy:0.3".parse(),
            Ok(BenchReceiverKind::Glossy(0.3)),
            "lobe"
        );
        for bad in ["glossy", "glossy:0", "glossy:x", "glossy:NaN", "wet"] {
            assert!(bad.parse::<BenchReceiverKind>().is_err(), "{bad}");
        }
    }

    /// The white furnace: the light that a rough surface reflects of a uniform radiance is below
    /// one; the rougher, the more is lost between facets.
    #[test]
    fn microfacets_reflect_no_more_than_arrives() {
        for (roughness, least) in [(0.1, 0.9), (0.3, 0.8), (0.6, 0.5), (1.0, 0.3)] {
            let gloss = Gloss {
                wo: Vec3::new(0.6, 0.0, 0.8),
                alpha: roughness,
                diffuse: 0.0,
            };
            let steps = 400;
            let mut sum = 0.0;
            for i in 0..steps {
                for j in 0..steps {
                    let cos = (f64::from(i) + 0.5) / f64::from(steps);
                    let (s, c) = (core::f64::consts::TAU * (f64::from(j) + 0.5) / f64::from(steps))
                        .sin_cos();
                    let sin = (1.0 - cos * cos).sqrt();
                    let wi = DVec3::new(sin * c, sin * s, cos);
                    sum += microfacets(&gloss, DVec3::Z, wi) * cos;
                }
            }
            let albedo = sum * core::f64::consts::TAU / f64::from(steps * steps);
            assert!(albedo < 1.0 && albedo > least, "{roughness}: {albedo}");
        }
    }
}
