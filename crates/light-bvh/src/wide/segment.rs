use core::f32::consts::FRAC_PI_2;

use light_math::float;
use light_math::glam::Vec3;

use super::importance::{DISTANCE, Receiver, near};
use super::lane::Lane;

/// Places along the segment at which the emission is looked at.
const PLACES: usize = 4;

/// A ray segment in a medium: lights count by their mean fluence along it.
///
/// The places are equally spaced in the angle under which the light sees the segment, so that a light close to it is not missed.
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
    #[must_use]
    pub fn new(p: Vec3, extent: Vec3) -> Self {
        let p = near(p);
        let extent = near(p + extent) - p;
        // Scaled before it is squared: the length of any finite segment is finite, and above 0 unless the segment is a point.
        let largest = extent.abs().max_element().max(f32::MIN_POSITIVE);
        let length = (extent / largest).length() * largest;
        Self {
            p,
            direction: (extent / largest).normalize_or(Vec3::Z),
            length,
            reach: extent.abs().element_sum(),
        }
    }
}

impl Receiver for SegmentReceiver {
    #[inline]
    fn position(&self) -> Vec3 {
        self.p
    }

    #[inline]
    fn reach(&self) -> f32 {
        self.reach
    }

    #[inline]
    fn weigh(&self, lane: &Lane, inv_unit: f32) -> f32 {
        // Far from a short segment, or at a segment without length, all places are the same.
        let length = (self.length * inv_unit).max(1e-6);
        let w = self.direction;
        let nearest = Vec3::from(lane.mean).dot(w);
        let aside = Vec3::from(lane.mean) - w * nearest;
        let blur_sq = DISTANCE * Vec3::from(lane.extent).length_squared();
        let height_sq = aside.length_squared() + 2.0 * blur_sq + 1e-12;
        let height = float::sqrt(height_sq);
        let begin = angle(-nearest / height);
        let span = (angle((length - nearest) / height) - begin).max(1e-6);
        let mut sum = 0.0;
        for i in 0..PLACES {
            let theta = begin + span * ((i as f32 + 0.5) / PLACES as f32);
            let t = (nearest + height * float::tan(theta)).clamp(0.0, length);
            let from_nearest = t - nearest;
            let here = lane.seen_from(w * t);
            sum += here.fluence() * (height_sq + from_nearest * from_nearest);
        }
        sum * (span / (PLACES as f32 * height * length))
    }
}

/// Arc tangent to within 0.005, by arithmetic alone, and never at a right angle, where its tangent would be infinite.
#[inline]
fn angle(x: f32) -> f32 {
    let magnitude = if x.abs() <= 1.0 {
        x.abs() / (1.0 + 0.28 * x * x)
    } else {
        FRAC_PI_2 - x.abs() / (x * x + 0.28)
    };
    magnitude.min(FRAC_PI_2 - 1e-4).copysign(x)
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
    fn length_of_any_finite_segment() {
        for scale in [1e-30, 1.0, 1e30] {
            let s = SegmentReceiver::new(Vec3::ZERO, Vec3::new(3.0, 4.0, 0.0) * scale);
            assert!((s.length / (5.0 * scale) - 1.0).abs() < 1e-5, "{scale}");
        }
    }
}
