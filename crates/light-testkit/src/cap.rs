use core::f64::consts::TAU;
use light_math::glam::Vec3;

use crate::integrate;
use crate::real3::{Real3, cross, dot, normalize, real3, vec3};

/// A spherical cap: all directions within an angle of an axis, mapped to the unit square without
/// change of area.
///
/// Checks on the sphere run over a cap that holds the whole density, so that narrow ones are
/// resolved too.
#[derive(Clone, Copy, Debug)]
pub struct Cap {
    axes: [Real3; 3],
    one_minus_cos: f64,
}

impl Cap {
    /// The whole sphere.
    #[must_use]
    pub fn sphere() -> Self {
        Self::new(Vec3::Z, core::f64::consts::PI)
    }

    /// The half of the sphere around `axis`.
    #[must_use]
    pub fn hemisphere(axis: Vec3) -> Self {
        Self::new(axis, core::f64::consts::FRAC_PI_2)
    }

    /// The directions within `angle` (radians, up to pi) of `axis` (any length but zero).
    #[must_use]
    pub fn new(axis: Vec3, angle: f64) -> Self {
        let z = normalize(real3(axis));
        let smallest = if z[0].abs() < 0.6 {
            [1.0, 0.0, 0.0]
        } else {
            [0.0, 1.0, 0.0]
        };
        let x = normalize(cross(smallest, z));
        let half_sin = (0.5 * angle).sin();
        Self {
            axes: [x, cross(z, x), z],
            one_minus_cos: 2.0 * half_sin * half_sin,
        }
    }

    /// The solid angle, in sr.
    #[must_use]
    pub fn solid_angle(&self) -> f64 {
        TAU * self.one_minus_cos
    }

    /// The direction at `[azimuth, height]` of the unit square; height 0 is the axis, height 1 the
    /// rim.
    #[must_use]
    pub fn direction(&self, [azimuth, height]: [f64; 2]) -> Vec3 {
        let one_minus_z = self.one_minus_cos * height;
        let r = (one_minus_z * (2.0 - one_minus_z)).max(0.0).sqrt();
        let (sin, cos) = (azimuth * TAU).sin_cos();
        let local = [r * cos, r * sin, 1.0 - one_minus_z];
        let outer = |k| (0..3).map(|i| self.axes[i][k] * local[i]).sum();
        vec3([outer(0), outer(1), outer(2)])
    }

    /// Where direction `w` lies in the unit square; a height above 1 is outside of the cap.
    #[must_use]
    pub fn square(&self, w: Vec3) -> [f64; 2] {
        let w = real3(w);
        let [x, y, z] = self.axes.map(|axis| dot(axis, w));
        // Near the axis 1 - z cancels, sin^2 / (1 + z) does not.
        let one_minus_z = if z > 0.0 {
            (x * x + y * y) / (1.0 + z)
        } else {
            1.0 - z
        };
        let azimuth = (y.atan2(x) / TAU).rem_euclid(1.0);
        [azimuth, one_minus_z / self.one_minus_cos]
    }

    /// The integral of `f` over the cap, with an absolute error of about `tolerance`.
    pub fn integrate(&self, tolerance: f64, mut f: impl FnMut(Vec3) -> f64) -> f64 {
        let omega = self.solid_angle();
        let grid = 8;
        let step = 1.0 / f64::from(grid);
        let mut total = 0.0;
        for cell in 0..grid * grid {
            let low = [f64::from(cell % grid) * step, f64::from(cell / grid) * step];
            let high = [low[0] + step, low[1] + step];
            // The errors of the cells have random signs.
            let share = tolerance / (omega * f64::from(grid));
            total += integrate(low, high, share, |x| f(self.direction(x)));
        }
        total * omega
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Rng;

    #[test]
    fn square_inverts_direction() {
        let mut rng = Rng::new(1);
        for angle in [1e-3, 0.3, 1.5, 3.0] {
            let cap = Cap::new(rng.direction(), angle);
            for _ in 0..100 {
                let x = [rng.f64(), rng.f64()];
                let back = cap.square(cap.direction(x));
                // f32 directions carry 6e-8, a thousandth of the smallest cap's ring at height
                // 0.01.
                let turn = (x[0] - back[0]).abs();
                let near = turn.min(1.0 - turn) * x[1].sqrt() < 1e-3;
                assert!(
                    near && (x[1] - back[1]).abs() < 1e-3,
                    "{x:?} became {back:?}"
                );
            }
        }
    }

    #[test]
    fn integrals_over_caps() {
        let omega = Cap::sphere().integrate(1e-6, |_| 1.0);
        assert!((omega - 2.0 * TAU).abs() < 1e-9, "4 pi: {omega}");
        let axis = Vec3::new(0.6, 0.0, -0.8);
        let cosine = Cap::hemisphere(axis).integrate(1e-6, |w| f64::from(w.dot(axis)));
        assert!((cosine - TAU / 2.0).abs() < 1e-5, "pi: {cosine}");
    }
}
