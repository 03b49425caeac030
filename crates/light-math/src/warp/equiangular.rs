//! Equiangular sampling: distances along a ray, uniform in the angle seen from a point.

use crate::float::{atan2, inverse_power_of_two, sin_cos, sqrt};
use glam::Vec3;

/// The least distance of a point from the ray: its square is still a normal number.
const SMALLEST_DIST: f32 = 2e-19;

/// Farther than this many units no `u` leads, because the largest is 1 - 2^-24.
const FARTHEST: f32 = (1 << 26) as f32;

/// A segment of a ray seen from a point off the ray, such as a light in a medium.
///
/// # Source
/// `[Kulla2012]`, equations 4 to 7, with angles counted from the near end, so that they keep their
/// digits where the part is short or far.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Equiangular {
    t_min: f32,
    t_max: f32,
    /// The last distance that is sampled: the end, or where the density is nearly 0.
    t_last: f32,
    /// A power of two, so that no square of a distance overflows.
    inv_unit: f32,
    /// The near end in that unit, relative to the place closest to the point.
    near: f32,
    /// The distance of the point from the ray, in that unit.
    dist: f32,
    /// The angle between both ends.
    angle: f32,
}

impl Equiangular {
    /// The ray from an origin along the unit vector `direction` between `t_min` and `t_max`, and
    /// the point at `to_point` from that origin; `t_max` may be infinite. `None` if the part is
    /// empty.
    ///
    /// A point on the ray itself is moved off it by 1e-6 of the largest distance, at least by
    /// 2e-19, because the density toward it has no integral.
    #[must_use]
    pub fn new(to_point: Vec3, direction: Vec3, t_min: f32, t_max: f32) -> Option<Self> {
        let end = if t_max.is_finite() { t_max.abs() } else { 0.0 };
        let largest = to_point.abs().max_element().max(t_min.abs()).max(end);
        let inv_unit = inverse_power_of_two(largest.max(SMALLEST_DIST));
        let to_point = to_point * inv_unit;
        let closest = to_point.dot(direction);
        let (near, far) = (t_min * inv_unit - closest, t_max * inv_unit - closest);
        let reach = if far.is_finite() { far.abs() } else { 0.0 };
        let least = (1e-6 * reach.max(near.abs())).max(SMALLEST_DIST * inv_unit);
        let dist = to_point.cross(direction).length().max(least);
        let angle = if far == f32::INFINITY {
            atan2(dist, near)
        } else {
            let length = (t_max - t_min) * inv_unit;
            atan2(dist * length, dist * dist + near * far)
        };
        let is_usable = t_min.is_finite() && t_min < t_max && angle > 0.0 && dist.is_finite();
        // Where the density falls to the least normal number.
        let faint = sqrt(dist / angle * (inv_unit / f32::MIN_POSITIVE));
        let last = (faint.min(FARTHEST * dist.max(near.abs())) - near).max(0.0) / inv_unit;
        is_usable.then_some(Self {
            t_min,
            t_max,
            t_last: (t_min + last).min(t_max).min(f32::MAX),
            inv_unit,
            near,
            dist,
            angle,
        })
    }

    /// The distance along the ray for `u` in `[0, 1)`: between `t_min` and `t_max`, in their unit,
    /// where the density is above 0.
    #[inline]
    #[must_use]
    pub fn sample(&self, u: f32) -> f32 {
        let (sin_angle, cos_angle) = sin_cos(u * self.angle);
        let across = self.dist * cos_angle - self.near * sin_angle;
        let step = (self.dist * self.dist + self.near * self.near) * sin_angle / across;
        if across > 0.0 && step >= 0.0 {
            (self.t_min + step / self.inv_unit).min(self.t_last)
        } else {
            self.t_last
        }
    }

    /// The density per length at distance `t` along the ray; 0 outside the part.
    #[inline]
    #[must_use]
    pub fn pdf(&self, t: f32) -> f32 {
        if !(self.t_min..=self.t_max).contains(&t) {
            return 0.0;
        }
        let x = self.x(t);
        self.dist / (self.angle * (self.dist * self.dist + x * x)) * self.inv_unit
    }

    /// The `u` in `[0, 1]` that [`sample`](Self::sample) takes to `t`.
    #[inline]
    #[must_use]
    pub fn invert(&self, t: f32) -> f32 {
        let step = (t - self.t_min) * self.inv_unit;
        let across = self.dist * self.dist + self.near * self.x(t);
        let angle = atan2(self.dist * step, across);
        (angle / self.angle).clamp(0.0, 1.0)
    }

    /// The place at distance `t`, relative to the one closest to the point, in the unit.
    fn x(&self, t: f32) -> f32 {
        self.near + (t - self.t_min) * self.inv_unit
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::float::ONE_MINUS_EPSILON;

    #[test]
    fn fixed_points() {
        let lamp = Vec3::new(1.0, 0.0, 1.0);
        let e = Equiangular::new(lamp, Vec3::Z, 0.0, 2.0).expect("a part of the ray");
        assert!(
            (e.sample(0.5) - 1.0).abs() < 1e-6,
            "the closest place is in the middle"
        );
        assert_eq!(e.sample(0.0), 0.0, "near end");
        assert_eq!(
            (e.pdf(-0.1), e.pdf(2.1), e.pdf(f32::NAN)),
            (0.0, 0.0, 0.0),
            "outside"
        );
        let half = Equiangular::new(lamp, Vec3::Z, 1.0, f32::INFINITY).expect("half a ray");
        assert!((half.sample(0.5) - 2.0).abs() < 1e-6, "45 degrees");
    }

    #[test]
    fn nothing_to_sample() {
        let new = |t_min, t_max| Equiangular::new(Vec3::X, Vec3::Z, t_min, t_max);
        assert_eq!((new(1.0, 1.0), new(2.0, 1.0)), (None, None), "empty");
        assert_eq!(
            (new(f32::NAN, 1.0), new(0.0, f32::NAN)),
            (None, None),
            "NaN"
        );
        assert_eq!(
            Equiangular::new(Vec3::NAN, Vec3::Z, 0.0, 1.0),
            None,
            "nowhere"
        );
    }

    #[test]
    fn inverse_and_density_from_near_to_far() {
        let parts = [
            (0.0, 1.0),
            (0.0, f32::INFINITY),
            (10.0, 10.001),
            (-5.0, 1e6),
        ];
        for point in [1e-3, 1.0, 1e4].map(|d| Vec3::new(d, 0.0, 0.7)) {
            for (t_min, t_max) in parts {
                let e = Equiangular::new(point, Vec3::Z, t_min, t_max).expect("a part of the ray");
                for u in [0.0, 0.1, 0.5, 0.9, 0.999, ONE_MINUS_EPSILON] {
                    let t = e.sample(u);
                    assert!(
                        (t_min..=t_max).contains(&t),
                        "{t} for {u} in {t_min}..{t_max}"
                    );
                    let x = t - 0.7;
                    let dist = e.dist / e.inv_unit;
                    let rounding =
                        f32::EPSILON * t.abs() * e.pdf(t) + 1e-6 * (1.0 + x.abs() / dist);
                    let error = (e.invert(t) - u).abs();
                    assert!(error < rounding, "{point} {t_min}..{t_max} {u}: {error}");
                }
            }
        }
    }

    #[test]
    fn a_point_on_the_ray_keeps_a_density() {
        let e = Equiangular::new(Vec3::Z, Vec3::Z, 0.0, 2.0).expect("a part of the ray");
        for u in [0.0, 0.25, 0.5, ONE_MINUS_EPSILON] {
            let density = e.pdf(e.sample(u));
            assert!(
                density > 0.0 && density.is_finite(),
                "density {density} for {u}"
            );
        }
    }

    /// Wherever squares of distances overflow, too.
    #[test]
    fn every_number_leads_to_a_density() {
        for scale in [0.0, 1e-30, 1e-13, 1.0, 1e13, 1e25, 1e33, 3e37] {
            for point in [Vec3::X, Vec3::new(1e-3, 0.0, 1.0), Vec3::Z] {
                for (t_min, t_max) in [(0.0, f32::INFINITY), (-scale, scale), (scale, 1e38)] {
                    let e = Equiangular::new(point * scale, Vec3::Z, t_min, t_max);
                    let Some(e) = e else {
                        assert_eq!((t_min, t_max), (-scale, scale), "an empty part");
                        continue;
                    };
                    for u in [0.0, 0.5, 0.999, 0.999_999, ONE_MINUS_EPSILON] {
                        let t = e.sample(u);
                        let density = e.pdf(t);
                        assert!(
                            t.is_finite() && density > 0.0 && density.is_finite(),
                            "{scale}, {point}, {t_min}..{t_max}, {u}: {density} at {t}"
                        );
                    }
                }
            }
        }
    }
}
