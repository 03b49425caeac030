use core::f32::consts::{FRAC_2_PI, FRAC_PI_2, PI};

use light_math::float;
use light_math::glam::Vec3;

use crate::importance::child_view::{ChildView, DISTANCE};
#[cfg(feature = "alloc")]
use crate::importance::frame::Frame;
use crate::importance::position::near;
use crate::importance::receiver::Receiver;
use crate::lane_math::{larger, smaller};

/// Points along the segment at which the emission is evaluated.
pub(crate) const PLACES: usize = 4;

/// The bend of the approximation of tangents: 1 - 8 / pi^2.
pub(crate) const BENT: f32 = 1.0 - 8.0 / (PI * PI);

/// How near a light may be to a segment, as a share of its length: nearer ones count as there, so
/// that the weights of neighbours stay within what floats hold, whatever the length.
pub(crate) const NEAREST: f32 = 1e-8;

/// A ray segment in a medium: lights count by their mean fluence along it.
///
/// The places are equally spaced in the angle under which the light sees the segment, so that a
/// light close to it is not missed.
#[derive(Clone, Copy, Debug)]
pub struct SegmentReceiver {
    p: Vec3,
    direction: Vec3,
    length: f32,
    /// Length in the norm that adds up the axes.
    reach: f32,
}

impl SegmentReceiver {
    /// The segment from `p` to `p + extent`.
    #[inline(always)]
    #[must_use]
    pub fn new(p: Vec3, extent: Vec3) -> Self {
        let p = near(p);
        let extent = near(p + extent) - p;
        // Scaled before it is squared: the length of any finite segment is finite, and above 0
        // unless the segment is a point.
        let largest = extent.abs().max_element().max(f32::MIN_POSITIVE);
        let length = (extent / largest).length() * largest;
        Self {
            p,
            direction: (extent / largest).normalize_or(Vec3::Z),
            length,
            reach: extent.abs().element_sum(),
        }
    }

    /// The same segment in another frame.
    #[cfg(feature = "alloc")]
    #[inline(always)]
    pub(crate) fn in_frame(&self, frame: &Frame) -> Self {
        let extent = frame.vector(self.direction * self.length);
        Self::new(frame.point(self.p), extent)
    }
}

impl Receiver for SegmentReceiver {
    #[inline(always)]
    fn position(&self) -> Vec3 {
        self.p
    }

    #[inline(always)]
    fn reach(&self) -> f32 {
        self.reach
    }

    #[cfg_attr(target_os = "none", inline)]
    #[cfg_attr(not(target_os = "none"), inline(always))]
    fn weigh(&self, child: &ChildView, inv_unit: f32) -> f32 {
        // Far from a short segment, or at a segment without length, all places are the same.
        let length = larger(1e-3 * child.dist, self.length * inv_unit);
        let w = self.direction;
        let nearest = Vec3::from(child.mean).dot(w);
        let aside = Vec3::from(child.mean) - w * nearest;
        let blur_sq = DISTANCE * Vec3::from(child.extent).length_squared();
        let height_sq = aside.length_squared() + 2.0 * blur_sq + child.slack * child.slack;
        let least_sq = (NEAREST * length) * (NEAREST * length);
        let height_sq = larger(least_sq, height_sq);
        let height = float::sqrt(height_sq);
        let begin = angle(-nearest / height);
        let span = angle((length - nearest) / height) - begin;
        let span = larger(1e-6, span);
        let mut sum = 0.0;
        for i in 0..PLACES {
            let theta = begin + span * ((i as f32 + 0.5) / PLACES as f32);
            let t = nearest + height * tangent(theta);
            let t = smaller(length, larger(0.0, t));
            let from_nearest = t - nearest;
            let from = child.displacement_at(w * t, least_sq);
            sum += child.fluence(&from) * (height_sq + from_nearest * from_nearest);
        }
        sum * (span / (PLACES as f32 * height * length))
    }
}

/// Arc tangent to within 0.005, by arithmetic alone, and never at a right angle, where its tangent
/// would be infinite.
#[inline(always)]
fn angle(x: f32) -> f32 {
    let (magnitude, square) = (x.abs(), x * x);
    let low = magnitude / (1.0 + 0.28 * square);
    let high = FRAC_PI_2 - magnitude / (square + 0.28);
    let angle = if magnitude <= 1.0 { low } else { high };
    smaller(FRAC_PI_2 - 1e-4, angle).copysign(x)
}

/// Tangent of an angle below a right one, to within a fiftieth: a rational function with its slopes
/// at 0 and its poles.
#[inline(always)]
fn tangent(x: f32) -> f32 {
    let t = x * FRAC_2_PI;
    let square = t * t;
    x * (1.0 - BENT * square) / (1.0 - square)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_are_those_of_the_arc_tangent() {
        for i in -1000..=1000 {
            let x = i as f32 * 0.05;
            assert!((angle(x) - float::atan(x)).abs() < 0.006, "{x}");
        }
        assert!(
            angle(f32::INFINITY).is_finite() || angle(1e30).is_finite(),
            "far"
        );
    }

    #[test]
    fn tangents_are_within_a_fiftieth() {
        for i in -1560..=1560 {
            let x = i as f32 * 0.001;
            let exact = float::tan(x);
            assert!((tangent(x) - exact).abs() <= 0.02 * exact.abs(), "{x}");
        }
    }

    #[test]
    fn length_of_any_finite_segment() {
        for scale in [1e-30, 1.0, 1e30] {
            let s = SegmentReceiver::new(Vec3::ZERO, Vec3::new(3.0, 4.0, 0.0) * scale);
            assert!((s.length / (5.0 * scale) - 1.0).abs() < 1e-5, "{scale}");
            let reach = s.reach() / (7.0 * scale);
            assert!((reach - 1.0).abs() < 1e-5, "{scale}: {reach} of both axes");
        }
    }
}
