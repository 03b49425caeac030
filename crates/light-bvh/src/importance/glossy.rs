use light_bounds::Gloss;
use light_math::glam::Vec3;
use light_math::{direction, float};

use crate::importance::child_view::{ChildView, dist_sq};
#[cfg(feature = "alloc")]
use crate::importance::frame::Frame;
use crate::importance::receiver::Receiver;
use crate::importance::surface::SurfaceReceiver;
use crate::lane_math::{dot, larger, smaller};

/// How much of a group's squared extent over its squared distance widens the facets, and how much
/// of its squared width is variance of that distance: less than elsewhere, for lights on the far
/// side of the receiver lie in other directions.
pub(crate) const WIDENING: f32 = 0.375;
pub(crate) const DISTANCE: f32 = 0.03;

/// Keeps the weights of the smoothest mirrors within what products of them can hold.
pub(crate) const MIN_ALPHA: f32 = 0.01;

/// What is left for lights far from the mirror direction, whose estimate is the worst.
pub(crate) const MIN_DIFFUSE: f32 = 0.02;

/// Keeps the half vector from vanishing where the light is behind the viewer's mirror image.
pub(crate) const MIN_HALF_SQ: f32 = 1e-5;

/// Keeps grazing views from dividing by nothing.
pub(crate) const MIN_COS: f32 = 1e-3;

/// A point on a surface that mirrors: what a [`SurfaceReceiver`] counts, times the reflection
/// toward the viewer.
///
/// The facets are widened by the angular size of a group of lights, so that a reflection beside its
/// centre still counts.
///
/// # Source
/// The distribution of facets is that of `[PBRT4]` 9.6; its shadowing is the rational approximation
/// of `[Hammon2017]`.
#[derive(Clone, Copy, Debug)]
pub struct GlossyReceiver {
    surface: SurfaceReceiver,
    wo: Vec3,
    cos_o: f32,
    alpha: f32,
    diffuse: f32,
}

impl GlossyReceiver {
    /// The point `p` with the normal `n`, of any length, seen from its side of `n`. Values outside
    /// of their domain are moved into it; without a direction to the viewer the surface is matt.
    #[inline(always)]
    #[must_use]
    pub fn new(p: Vec3, n: Vec3, gloss: &Gloss) -> Self {
        Self::facing(p, direction(n).unwrap_or(Vec3::ZERO), gloss)
    }

    /// The same with the unit normal `n`.
    #[inline(always)]
    pub(crate) fn facing(p: Vec3, n: Vec3, gloss: &Gloss) -> Self {
        // Written so that NaN becomes the first bound.
        let within = |x: f32, low: f32| if x > low { x.min(1.0) } else { low };
        let (wo, diffuse) = match direction(gloss.wo) {
            Some(wo) => (wo, gloss.diffuse),
            None => (n, 1.0),
        };
        Self {
            surface: SurfaceReceiver::facing(p, n),
            wo,
            cos_o: within(n.dot(wo), MIN_COS),
            alpha: within(gloss.alpha, MIN_ALPHA),
            diffuse: within(diffuse, MIN_DIFFUSE),
        }
    }

    /// The same point in another frame.
    #[cfg(feature = "alloc")]
    #[inline(always)]
    pub(crate) fn in_frame(&self, frame: &Frame) -> Self {
        Self {
            surface: self.surface.in_frame(frame),
            wo: frame.direction(self.wo),
            ..*self
        }
    }

    /// The reflection of the child's light toward the viewer over that of a matt surface; above 0.
    #[inline(always)]
    fn reflected(&self, child: &ChildView, height: f32) -> f32 {
        let Self {
            wo, cos_o, alpha, ..
        } = *self;
        let dist_sq = dist_sq(child.mean, child.extent, DISTANCE);
        let inv_dist = 1.0 / float::sqrt(dist_sq);
        let cos_i = smaller(1.0, height * inv_dist);
        // The squared length of the half vector, and of its part along the normal.
        let half_sq = 2.0 + 2.0 * dot(&child.mean, &wo.to_array()) * inv_dist;
        let half_sq = larger(MIN_HALF_SQ, half_sq);
        let cos_sum = cos_i + cos_o;
        let upright = smaller(half_sq, cos_sum * cos_sum);
        let extent_sq = dot(&child.extent, &child.extent);
        let widening = WIDENING * extent_sq / (dist_sq + extent_sq);
        let alpha_sq = smaller(1.0, alpha * alpha + widening);
        let spread = half_sq - (1.0 - alpha_sq) * upright;
        let facets = alpha_sq * half_sq * half_sq / (spread * spread);
        let shadowing = 0.5 / ((1.0 - alpha) * 2.0 * cos_i * cos_o + alpha * cos_sum);
        self.diffuse + (1.0 - self.diffuse) * facets * shadowing
    }
}

impl Receiver for GlossyReceiver {
    #[inline(always)]
    fn position(&self) -> Vec3 {
        self.surface.position()
    }

    #[cfg_attr(target_os = "none", inline)]
    #[cfg_attr(not(target_os = "none"), inline(always))]
    fn weigh(&self, child: &ChildView, inv_unit: f32) -> f32 {
        let height = self.surface.expected_height(child);
        self.surface.weigh(child, inv_unit) * self.reflected(child, height)
    }

    fn likelihood(&self, child: &ChildView) -> f32 {
        self.surface.likelihood(child)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lane_math::LaneMask;

    /// A child without extent in direction `v`, which emits alike in all directions.
    fn child(v: Vec3) -> ChildView {
        ChildView {
            mean: v.to_array(),
            extent: [0.0; 3],
            dist: v.length(),
            dist_sq: v.length_squared(),
            slack: 1e-5,
            axis: [0.0; 3],
            offset: -1.0,
            spread: 2.0f32.sqrt(),
            soft: LaneMask::of_sign(-1),
            step: LaneMask::of_sign(0),
            both_sides: LaneMask::when(false),
            power: 1.0,
            sheet: None,
            opposed: 0,
            axis_dot_mean: 0.0,
        }
    }

    fn polished(alpha: f32, diffuse: f32) -> GlossyReceiver {
        let wo = Vec3::new(-0.6, 0.0, 0.8);
        GlossyReceiver::new(Vec3::ZERO, Vec3::Z, &Gloss { wo, alpha, diffuse })
    }

    #[test]
    fn lights_in_the_mirror_direction_count_most() {
        let weigh = |x: f32| {
            let v = Vec3::new(x, 0.0, 0.8).normalize();
            polished(0.1, 0.0).weigh(&child(v), 1.0)
        };
        assert!(
            weigh(0.6) > 20.0 * weigh(0.0),
            "mirrored and straight above"
        );
        assert!(
            weigh(0.6) > weigh(0.55) && weigh(0.6) > weigh(0.65),
            "a peak"
        );
        assert!(weigh(-0.6) > 0.0, "the viewer's side still counts");
    }

    #[test]
    fn a_matt_surface_is_a_matt_surface() {
        let matt = SurfaceReceiver::new(Vec3::ZERO, Vec3::Z);
        for v in [Vec3::Z, Vec3::X + Vec3::Z, Vec3::NEG_X + 0.1 * Vec3::Z] {
            let (a, b) = (
                polished(0.3, 1.0).weigh(&child(v), 1.0),
                matt.weigh(&child(v), 1.0),
            );
            assert!((a - b).abs() <= 1e-6 * b, "{v}: {a} and {b}");
        }
        assert_eq!(
            polished(0.1, 0.0).weigh(&child(Vec3::NEG_Z), 1.0),
            0.0,
            "below the horizon"
        );
    }

    #[test]
    fn lights_far_from_the_mirror_direction_keep_a_fiftieth() {
        for v in [Vec3::Z, Vec3::new(-0.6, 0.0, 0.8), Vec3::Y + 0.1 * Vec3::Z] {
            let w = polished(0.01, 0.0).reflected(&child(v), v.z);
            assert!(w >= 0.02, "{v}: {w}");
        }
    }

    #[test]
    fn nonsense_still_gives_positive_numbers() {
        for alpha in [f32::NAN, -1.0, 0.0, 2.0] {
            for v in [
                Vec3::Z,
                Vec3::new(0.6, 0.0, -0.79),
                Vec3::new(0.6, 0.0, 1e-6),
            ] {
                let w = polished(alpha, f32::NAN).reflected(&child(v), 1e-6);
                assert!(w > 0.0 && w.is_finite(), "{alpha}, {v}: {w}");
            }
        }
    }
}
