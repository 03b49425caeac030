use core::f32::consts::{PI, TAU};

use glam::{Vec2, Vec3};
use light_math::{Frame, float};
use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

use crate::set_light::SetLight;
use crate::set_point::SetPoint;

/// Random lights and points, the same for the same seed.
pub(crate) struct Random(Pcg64Mcg);

impl Random {
    pub(crate) fn new(seed: u64) -> Self {
        Self(Pcg64Mcg::seed_from_u64(seed))
    }

    /// Uniform in `[0, 1)`.
    pub(crate) fn unit(&mut self) -> f32 {
        (self.0.next_u32() >> 8) as f32 / 16_777_216.0
    }

    /// Uniform in `[low, high)`.
    pub(crate) fn between(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * self.unit()
    }

    /// A number below `n`, which is below 2^24.
    pub(crate) fn below(&mut self, n: usize) -> usize {
        self.0.next_u32() as usize % n
    }

    /// Puts items in any order.
    pub(crate) fn shuffle<T>(&mut self, items: &mut [T]) {
        for i in (1..items.len()).rev() {
            items.swap(i, self.below(i + 1));
        }
    }

    /// A unit vector without a z.
    pub(crate) fn level_direction(&mut self) -> Vec3 {
        let (s, c) = float::sin_cos(TAU * self.unit());
        Vec3::new(c, s, 0.0)
    }

    /// From 1 to `10^decades`, uniform in the logarithm.
    pub(crate) fn log_uniform(&mut self, decades: f32) -> f32 {
        float::powf(10.0, decades * self.unit())
    }

    pub(crate) fn cube(&mut self) -> Vec3 {
        Vec3::new(self.unit(), self.unit(), self.unit())
    }

    pub(crate) fn square(&mut self) -> Vec2 {
        Vec2::new(self.unit(), self.unit())
    }

    pub(crate) fn direction(&mut self) -> Vec3 {
        let u = self.square();
        let z = 1.0 - 2.0 * u.x;
        let (s, c) = float::sin_cos(TAU * u.y);
        let radius = float::safe_sqrt(1.0 - z * z);
        Vec3::new(radius * c, radius * s, z).normalize()
    }

    pub(crate) fn over_floor(&mut self, low: f32, high: f32) -> Vec3 {
        let u = self.square() * 10.0;
        Vec3::new(u.x, u.y, low + (high - low) * self.unit())
    }

    pub(crate) fn on_floor(&mut self) -> SetPoint {
        SetPoint {
            p: self.over_floor(0.0, 0.0),
            n: Vec3::Z,
        }
    }

    pub(crate) fn point_light(&mut self) -> SetLight {
        SetLight::Point {
            p: self.over_floor(0.5, 3.0),
            intensity: self.log_uniform(2.0),
        }
    }

    pub(crate) fn spot(&mut self, narrow_deg: f32, wide_deg: f32) -> SetLight {
        let p = self.over_floor(0.5, 3.0);
        let aside = self.square() * 2.0 - 1.0;
        let cone_deg = narrow_deg + (wide_deg - narrow_deg) * self.unit();
        SetLight::Spot {
            p,
            target: Vec3::new(p.x + aside.x * p.z * 0.5, p.y + aside.y * p.z * 0.5, 0.0),
            intensity: self.log_uniform(2.0),
            cone_deg,
            delta_deg: cone_deg * (0.1 + 0.4 * self.unit()),
        }
    }

    /// A triangle of about the given size (radius of its circumscribed circle) and emitted power.
    pub(crate) fn triangle(
        &mut self,
        center: Vec3,
        normal: Vec3,
        size: f32,
        power: f32,
        two_sided: bool,
    ) -> SetLight {
        let frame = Frame::from_z(normal);
        let turn = TAU * self.unit();
        let corner = |k: f32, stretch: f32| {
            let (s, c) = float::sin_cos(turn + TAU * k / 3.0);
            (frame.x * c + frame.y * s) * (size * stretch)
        };
        let corners = [
            corner(0.0, 0.6 + 0.4 * self.unit()),
            corner(1.0, 0.6 + 0.4 * self.unit()),
            corner(2.0, 0.6 + 0.4 * self.unit()),
        ];
        let vertices = corners.map(|corner| center + corner);
        let area = 0.5
            * (corners[1] - corners[0])
                .cross(corners[2] - corners[0])
                .length();
        SetLight::Triangle {
            vertices,
            radiance: power / (PI * area),
            two_sided,
        }
    }
}

/// As many items as asked for, made one after the other.
pub(crate) fn repeat<T>(n: usize, make: impl FnMut() -> T) -> Vec<T> {
    core::iter::repeat_with(make).take(n).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn triangles_have_the_requested_power_and_side() {
        let mut r = Random::new(1);
        let normal = r.direction();
        let light = r.triangle(Vec3::ONE, normal, 0.1, 5.0, false);
        let bounds = light.bounds();
        assert!((bounds.phi - 5.0).abs() < 1e-3, "power");
        assert!(bounds.w.dot(normal) > 0.999, "front side");
    }
}
