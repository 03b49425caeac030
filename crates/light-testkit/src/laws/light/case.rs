use light_bounds::LightSampleContext;
use light_math::glam::{Vec2, Vec3};
use light_sources::{ColorModel, EmittedRay, Light, PdfCoverage, Radiance};

use super::DENSITY_ROUNDING;
use crate::Rng;

/// A light, and the contexts at which it is queried.
#[derive(Debug)]
pub struct LightCase<'a, C: ColorModel, L> {
    /// What the light is.
    pub name: &'a str,
    /// The light.
    pub light: &'a L,
    /// The wavelengths of all queries.
    pub wavelengths: C::Wavelengths,
    /// Contexts of the queries.
    pub contexts: Vec<LightSampleContext>,
}

impl<'a, C: ColorModel, L: Light<C>> LightCase<'a, C, L> {
    /// A light at the colour model's reference wavelengths, queried at `count` random points that
    /// are up to three radii from `center`: on surfaces of any orientation, and in a medium.
    #[must_use]
    pub fn around(name: &'a str, light: &'a L, center: Vec3, radius: f32, count: usize) -> Self {
        let mut rng = Rng::new(41);
        let contexts = (0..count).map(|i| {
            let p = center + rng.direction() * (radius * rng.range(0.2, 3.0));
            let n = rng.direction();
            match i % 3 {
                0 => LightSampleContext::medium(p),
                _ => LightSampleContext::surface(p, n, n),
            }
        });
        Self {
            name,
            light,
            wavelengths: C::reference_wavelengths(),
            contexts: contexts.collect(),
        }
    }

    /// Whether samples at `ctx` depend on the requested coverage.
    pub(super) fn reads_coverage(&self, ctx: &LightSampleContext) -> bool {
        let mut rng = Rng::new(40);
        (0..64).any(|_| {
            let u = rng.vec2();
            let pair = [PdfCoverage::Complete, PdfCoverage::Incomplete];
            let [complete, incomplete] = pair.map(|coverage| {
                let sample = self.li(ctx, u, coverage)?;
                Some((sample, self.light.pdf_li(ctx, sample.wi, coverage)))
            });
            complete != incomplete
        })
    }

    pub(super) fn li(
        &self,
        ctx: &LightSampleContext,
        u: Vec2,
        coverage: PdfCoverage,
    ) -> Option<Li> {
        let sample = self.light.sample_li(ctx, u, &self.wavelengths, coverage)?;
        Some(Li {
            l: f64::from(sample.l.average()),
            wi: sample.wi,
            pdf: sample.pdf,
        })
    }
}

/// What the laws look at in a sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Li {
    pub(super) l: f64,
    pub(super) wi: Vec3,
    pub(super) pdf: f32,
}

/// What the laws look at in a ray that leaves.
#[derive(Clone, Copy, Debug)]
pub(super) struct Le {
    /// The power that the ray represents.
    pub(super) power: f64,
    /// Whether `pdf_le` returns the densities that the sample carries.
    pub(super) pdf_agrees: bool,
    /// The ray; `None` where none leaves.
    pub(super) ray: Option<EmittedRay>,
}

/// One ray; no power where none leaves.
pub(super) fn le<C: ColorModel, L: Light<C>>(case: &LightCase<'_, C, L>, u1: Vec2, u2: Vec2) -> Le {
    let Some(sample) = case.light.sample_le(u1, u2, &case.wavelengths) else {
        return Le {
            power: 0.0,
            pdf_agrees: true,
            ray: None,
        };
    };
    let asked = case.light.pdf_le(&sample.ray);
    let pairs = [(sample.pdf.pos, asked.pos), (sample.pdf.dir, asked.dir)];
    for (pdf, _) in pairs {
        let valid = pdf > 0.0 && pdf.is_finite();
        assert!(valid, "{}: a density of {sample:?} is not valid", case.name);
    }
    let density = f64::from(sample.pdf.pos) * f64::from(sample.pdf.dir);
    Le {
        power: f64::from(sample.l.average()) * cos_at_origin(&sample.ray) / density,
        // A Dirac counts as 1 in a sample, as 0 in a query.
        pdf_agrees: pairs
            .iter()
            .all(|&(pdf, asked)| (pdf == 1.0 && asked == 0.0) || same_density(pdf, asked)),
        ray: Some(sample.ray),
    }
}

/// Whether two ways to compute one density agree.
pub(super) fn same_density(a: f32, b: f32) -> bool {
    (a - b).abs() <= DENSITY_ROUNDING * a.max(b)
}

fn cos_at_origin(ray: &EmittedRay) -> f64 {
    if ray.normal == Vec3::ZERO {
        1.0
    } else {
        f64::from(ray.normal.dot(ray.direction).abs())
    }
}
