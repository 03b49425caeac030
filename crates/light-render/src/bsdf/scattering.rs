use lights::glam::{Vec2, Vec3};
use lights::math::Frame;

use super::{Bsdf, BsdfSample};
use crate::Surface;

/// A surface's scattering function in the scene: a [`Bsdf`] in the frame of the shading normal,
/// kept from leaking light through the geometric surface. All directions are in scene space.
#[derive(Clone, Copy, Debug)]
pub struct Scattering {
    bsdf: Bsdf,
    frame: Frame,
    n: Vec3,
}

impl Scattering {
    /// `bsdf` in the shading frame of `surface`.
    #[inline]
    #[must_use]
    pub fn new(bsdf: Bsdf, surface: &Surface) -> Self {
        Self {
            bsdf,
            frame: Frame::from_z(surface.ns),
            n: surface.n,
        }
    }

    /// The scattering function in the frame of the shading normal.
    #[inline]
    #[must_use]
    pub(crate) const fn bsdf(&self) -> &Bsdf {
        &self.bsdf
    }

    /// The scattering function times `|cos theta_i|`, in sr^-1.
    #[inline]
    #[must_use]
    pub fn eval(&self, wo: Vec3, wi: Vec3) -> Vec3 {
        let (local_wo, local_wi) = (self.frame.to_local(wo), self.frame.to_local(wi));
        if self.leaks(wo, wi, local_wo.z * local_wi.z) {
            return Vec3::ZERO;
        }
        self.bsdf.eval(local_wo, local_wi)
    }

    /// The density of [`sample`](Self::sample), in sr^-1.
    #[inline]
    #[must_use]
    pub fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        let (local_wo, local_wi) = (self.frame.to_local(wo), self.frame.to_local(wi));
        if self.leaks(wo, wi, local_wo.z * local_wi.z) {
            return 0.0;
        }
        self.bsdf.pdf(local_wo, local_wi)
    }

    /// Samples a direction of incidence; see [`Bsdf::sample`].
    #[inline]
    #[must_use]
    pub fn sample(&self, wo: Vec3, u_lobe: f32, u: Vec2) -> Option<BsdfSample> {
        let local_wo = self.frame.to_local(wo);
        let sample = self.bsdf.sample(local_wo, u_lobe, u)?;
        let wi = self.frame.from_local(sample.wi).normalize();
        (!self.leaks(wo, wi, local_wo.z * sample.wi.z)).then_some(BsdfSample { wi, ..sample })
    }

    /// Whether the two normals disagree on reflection or transmission.
    ///
    /// # Source
    /// `[Veach1997]`, section 5.3.2.
    #[inline]
    fn leaks(&self, wo: Vec3, wi: Vec3, shading_sides: f32) -> bool {
        let geometric_sides = wo.dot(self.n) * wi.dot(self.n);
        !(geometric_sides * shading_sides > 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::PrimitiveId;
    use crate::bsdf::Lambert;

    /// A surface whose shading normal leans away from the geometric one.
    fn leaning() -> Surface {
        let flat = Surface::on_triangle(
            PrimitiveId::new(0),
            [Vec3::ZERO, Vec3::X, Vec3::Y],
            Vec2::ZERO,
        );
        Surface {
            ns: Vec3::new(0.6, 0.0, 0.8),
            ..flat
        }
    }

    #[test]
    fn no_light_passes_where_the_normals_disagree() {
        let bsdf = Bsdf::Lambert(Lambert::opaque(Vec3::ONE));
        let scattering = Scattering::new(bsdf, &leaning());
        let below = Vec3::new(0.95, 0.0, -0.1).normalize();
        assert!(below.dot(leaning().ns) > 0.0, "above the shading horizon");
        assert_eq!(
            scattering.eval(Vec3::Z, below),
            Vec3::ZERO,
            "but behind the surface"
        );
        assert_eq!(scattering.pdf(Vec3::Z, below), 0.0, "and never chosen");
        assert!(scattering.eval(Vec3::Z, Vec3::Z).x > 0.0, "in front");
    }

    #[test]
    fn samples_agree_with_the_density() {
        let bsdf = Bsdf::Lambert(Lambert {
            reflectance: Vec3::splat(0.6),
            transmittance: Vec3::splat(0.2),
        });
        let scattering = Scattering::new(bsdf, &leaning());
        let wo = Vec3::new(0.0, 0.6, 0.8);
        for k in 0..64u8 {
            let x = (f32::from(k) + 0.5) / 64.0;
            let Some(s) = scattering.sample(wo, x, Vec2::new(x, (7.0 * x).fract())) else {
                continue;
            };
            let pdf = s.pdf.expect("no Dirac");
            assert!(
                (scattering.pdf(wo, s.wi) / pdf - 1.0).abs() < 1e-4,
                "pdf of sample {k}"
            );
            let f = scattering.eval(wo, s.wi) / pdf;
            assert!(f.distance(s.weight) < 1e-4, "weight of sample {k}");
        }
    }
}
