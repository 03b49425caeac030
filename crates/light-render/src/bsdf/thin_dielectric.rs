use lights::glam::Vec3;

use super::bsdf_sample::BsdfSample;
use super::fresnel;

/// A thin pane of glass: reflects and transmits without refraction, with all internal reflections.
///
/// # Source
/// `[PBRT4]`, section 9.5.2 (thin dielectric).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThinDielectric {
    /// Index of refraction of the pane.
    pub eta: f32,
}

impl ThinDielectric {
    /// A reflection or the way straight on, as likely as it is bright. `wo` is a unit vector in the
    /// frame of the surface, `u_lobe` is in `[0, 1)`.
    #[inline]
    #[must_use]
    pub fn sample(&self, wo: Vec3, u_lobe: f32) -> BsdfSample {
        let once = fresnel::dielectric(wo.z.abs(), self.eta);
        // The geometric series of reflections between the two faces; all is reflected at the limit.
        let share = if once < 1.0 {
            2.0 * once / (1.0 + once)
        } else {
            1.0
        };
        let wi = if u_lobe < share {
            Vec3::new(-wo.x, -wo.y, wo.z)
        } else {
            -wo
        };
        BsdfSample {
            wi,
            weight: Vec3::ONE,
            pdf: None,
            eta: 1.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pane_reflects_less_than_twice_a_face() {
        let pane = ThinDielectric { eta: 1.5 };
        let wo = Vec3::Z;
        assert_eq!(
            pane.sample(wo, 0.0768).wi,
            Vec3::Z,
            "2 * 0.04 / 1.04 is reflected"
        );
        assert_eq!(pane.sample(wo, 0.0770).wi, Vec3::NEG_Z, "the rest goes on");
    }
}
