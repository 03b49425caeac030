use light_math::Aabb;
use light_math::float;
use light_math::glam::{Mat3, Vec3};

use crate::node::sheet_code::SheetCode;

/// The least variance along the mean axis, as a share of the variance along all axes, of a group
/// that counts as a slanted sheet: lamps in a plane across their axis see none of it.
const LEAST_DEPTH: f32 = 0.03;

/// The least length of the mean axis of lights that face about the same way.
pub(crate) const LEAST_AXIS: f32 = 0.6;

/// The largest determinant of its correlations: 0 of a plane, 1 of an evenly filled box.
const LARGEST_DETERMINANT: f32 = 0.05;

/// The least number of lights of such a sheet: few are correlated by chance.
const LEAST_LIGHTS: u32 = 16;

/// The least number of lights along a line: a pair always is, and three often are.
const LEAST_ALONG_LINE: u32 = 4;

/// The least sum of squares of the covariance of lights along a line, as a share of the squared sum of
/// variances: 1 of a line, a half of an evenly filled square. Chosen by V and by time: see
/// `docs/light-bvh-study.md`.
const ALONG_LINE: f32 = 0.99;

/// The least number of lights of a large group. Chosen by V and by instructions: see
/// `docs/light-bvh-study.md`.
const LARGE_LIGHTS: u32 = 1024;

/// The covariance of the positions of a group of lights, over a squared length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Covariance {
    lights: u32,
    /// Of x, y and z.
    variance: Vec3,
    /// Of x and y, y and z, z and x.
    mixed: Vec3,
}

impl Covariance {
    pub(crate) const ZERO: Self = Self {
        lights: 0,
        variance: Vec3::ZERO,
        mixed: Vec3::ZERO,
    };

    /// Of one light that fills a box evenly, over its squared `width`.
    #[inline(always)]
    pub(crate) fn of_box(bounds: &Aabb, width: f32) -> Self {
        let half = (bounds.max - bounds.min) * (0.5 / width.max(f32::MIN_POSITIVE));
        Self {
            lights: 1,
            variance: half * half * (1.0 / 3.0),
            mixed: Vec3::ZERO,
        }
    }

    /// Adds a part with a `share` of all, whose covariance is over a length that is `relative` to
    /// that of the sum, and whose mean is `from_mean` away from that of all.
    #[inline(always)]
    pub(crate) fn add(&mut self, share: f32, part: &Self, relative: f32, from_mean: Vec3) {
        let scale = share * (relative * relative);
        let d = from_mean;
        self.lights = self.lights.saturating_add(part.lights);
        self.variance += part.variance * scale + d * d * share;
        self.mixed += part.mixed * scale + d * Vec3::new(d.y, d.z, d.x) * share;
    }

    /// The same lights turned by `axes`, over a length that is `relative` to what it was over.
    pub(crate) fn turned(&self, axes: Mat3, relative: f32) -> Self {
        let scale = relative * relative;
        let (v, [xy, yz, zx]) = (self.variance, self.mixed.to_array());
        let whole = Mat3::from_cols(
            Vec3::new(v.x, xy, zx),
            Vec3::new(xy, v.y, yz),
            Vec3::new(zx, yz, v.z),
        );
        let [x, y, z] = (axes * whole * axes.transpose()).to_cols_array_2d();
        Self {
            lights: self.lights,
            variance: Vec3::new(x[0], y[1], z[2]) * scale,
            mixed: Vec3::new(x[1], y[2], z[0]) * scale,
        }
    }

    /// Whether these are many lights.
    pub(crate) const fn is_large(&self) -> bool {
        self.lights >= LARGE_LIGHTS
    }

    /// Whether these are several lights along a line, of any direction.
    pub(crate) fn is_line(&self) -> bool {
        let trace = self.variance.element_sum();
        let squares = self.variance.length_squared() + 2.0 * self.mixed.length_squared();
        self.lights >= LEAST_ALONG_LINE && trace > 0.0 && squares >= ALONG_LINE * (trace * trace)
    }

    /// The code of a thin slanted sheet of lights that face about the same way, if it is one.
    pub(crate) fn sheet(&self, axis: Vec3) -> Option<SheetCode> {
        let length_sq = axis.length_squared();
        if self.lights < LEAST_LIGHTS || !(length_sq >= LEAST_AXIS * LEAST_AXIS) {
            return None;
        }
        let v = self.variance;
        let product = v * Vec3::new(v.y, v.z, v.x);
        let root = Vec3::from_array(product.to_array().map(float::sqrt));
        let r = self.mixed / root.max(Vec3::splat(f32::MIN_POSITIVE));
        let determinant = 1.0 + 2.0 * (r.x * r.y * r.z) - r.length_squared();
        let along =
            v.dot(axis * axis) + 2.0 * self.mixed.dot(axis * Vec3::new(axis.y, axis.z, axis.x));
        let is_sheet = determinant <= LARGEST_DETERMINANT
            && along >= LEAST_DEPTH * length_sq * v.element_sum();
        if is_sheet {
            SheetCode::new(r.to_array())
        } else {
            None
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const POINT: Covariance = Covariance {
        lights: 1,
        ..Covariance::ZERO
    };

    /// Of points in a plane with the given normal, evenly within `[-1, 1]` along x and y.
    fn of_plane(normal: Vec3) -> Covariance {
        let mut covariance = Covariance::ZERO;
        let at = |i: i32| i as f32 / 10.0;
        for (x, y) in (-10..=10).flat_map(|i| (-10..=10).map(move |j| (at(i), at(j)))) {
            let z = -(normal.x * x + normal.y * y) / normal.z;
            covariance.add(1.0 / 441.0, &POINT, 1.0, Vec3::new(x, y, z));
        }
        covariance
    }

    #[test]
    fn slanted_sheets_are_found() {
        let rows = of_plane(Vec3::new(0.0, -1.0, 1.0));
        assert_eq!(rows.sheet(Vec3::Y), SheetCode::new([0.0, 1.0, 0.0]), "rows");
        assert_eq!(rows.sheet(0.5 * Vec3::Y), None, "axes that differ");
        let across = Vec3::new(0.0, -1.0, 1.0).normalize();
        assert_eq!(
            rows.sheet(across),
            None,
            "lamps that face away from their plane"
        );
        let few = Covariance { lights: 15, ..rows };
        assert_eq!(few.sheet(Vec3::Y), None, "few lights");
        let level = of_plane(Vec3::Z);
        assert_eq!(level.sheet(Vec3::X), None, "a plane along axes");
    }

    /// Of `lights` points along `axis`, each `aside` from it in another direction.
    fn of_row(lights: u16, axis: Vec3, aside: f32) -> Covariance {
        let mut covariance = Covariance::ZERO;
        let (across, up) = axis.any_orthonormal_pair();
        for i in 0..lights {
            let t = 2.0 * (f32::from(i) + 0.5) / f32::from(lights) - 1.0;
            let (sin, cos) = (float::sin(3.0 * t), float::cos(3.0 * t));
            let place = axis * t + (across * sin + up * cos) * aside;
            covariance.add(1.0 / f32::from(lights), &POINT, 1.0, place);
        }
        covariance
    }

    #[test]
    fn rows_of_any_direction_are_lines() {
        for axis in [Vec3::X, Vec3::new(0.6, 0.0, -0.8), Vec3::ONE.normalize()] {
            assert!(of_row(16, axis, 0.0).is_line(), "{axis}");
            assert!(of_row(16, axis, 0.05).is_line(), "{axis}, a little bent");
            assert!(!of_row(16, axis, 0.3).is_line(), "{axis}, bent");
            assert!(!of_row(3, axis, 0.0).is_line(), "{axis}, three");
        }
        assert!(!of_plane(Vec3::Z).is_line(), "a plane");
        assert!(!of_row(16, Vec3::ZERO, 0.0).is_line(), "one place");
    }

    #[test]
    fn parts_add_up_to_the_whole() {
        let slope = of_plane(Vec3::new(0.3, -1.0, 1.0));
        let (mut joined, apart) = (Covariance::ZERO, Vec3::new(0.5, -0.25, 0.75));
        for sign in [-1.0, 1.0] {
            joined.add(0.5, &slope, 0.5, sign * apart);
        }
        let expected = slope.mixed * 0.25 + apart * Vec3::new(apart.y, apart.z, apart.x);
        assert!((joined.mixed - expected).length() < 1e-6, "{joined:?}");
        let expected = slope.variance * 0.25 + apart * apart;
        assert!((joined.variance - expected).length() < 1e-6, "{joined:?}");
    }

    #[test]
    fn turning_the_lights_turns_their_covariance() {
        let axes = Mat3::from_axis_angle(Vec3::new(0.6, 0.0, 0.8), 0.7);
        let mut turned = Covariance::ZERO;
        let slope = of_plane(Vec3::new(0.3, -1.0, 1.0));
        let at = |i: i32| i as f32 / 10.0;
        for (x, y) in (-10..=10).flat_map(|i| (-10..=10).map(move |j| (at(i), at(j)))) {
            let place = axes * Vec3::new(x, y, y - 0.3 * x);
            turned.add(1.0 / 441.0, &POINT, 1.0, place * 0.5);
        }
        let found = slope.turned(axes, 0.5);
        assert!((found.mixed - turned.mixed).length() < 1e-5, "{found:?}");
        assert!(
            (found.variance - turned.variance).length() < 1e-5,
            "{found:?}"
        );
        assert_eq!(found.lights, 441, "no light is lost");
    }

    #[test]
    fn boxes_and_what_is_no_number_are_no_sheets() {
        let bounds = Aabb::from_points([Vec3::ZERO, Vec3::new(2.0, 4.0, 6.0)]);
        let box_ = Covariance::of_box(&bounds, 2.0);
        assert_eq!(
            box_.variance,
            Vec3::new(1.0, 4.0, 9.0) / 12.0,
            "a third of the half, squared"
        );
        for value in [0.0, f32::INFINITY, f32::NAN] {
            let all = Covariance {
                lights: 100,
                variance: Vec3::splat(value),
                mixed: Vec3::splat(value),
            };
            assert_eq!(all.sheet(Vec3::Z), None, "{value}");
        }
    }
}
