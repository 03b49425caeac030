use core::f32::consts::PI;

use glam::{Quat, Vec3};

use crate::bench_set::{BenchSet, POINTS};
use crate::set_light::SetLight;
use crate::set_point::SetPoint;

/// A set that is being filled: never more lights or points than asked for.
pub(super) struct Place {
    n: usize,
    set: BenchSet,
}

impl Place {
    pub(super) fn new(n: usize) -> Self {
        Self {
            n,
            set: BenchSet::default(),
        }
    }

    /// Lights of the whole place.
    pub(super) fn n(&self) -> usize {
        self.n
    }

    pub(super) fn wants_lights(&self) -> bool {
        self.set.lights.len() < self.n
    }

    pub(super) fn wants_points(&self) -> bool {
        self.set.points.len() < POINTS
    }

    pub(super) fn light(&mut self, light: SetLight) {
        if self.wants_lights() {
            self.set.lights.push(light);
        }
    }

    /// A diffuse triangle of the given power; its front is where its corners run
    /// counter-clockwise. One without an area is left out.
    pub(super) fn triangle(&mut self, vertices: [Vec3; 3], power: f32, two_sided: bool) {
        let [a, b, c] = vertices;
        let area = 0.5 * (b - a).cross(c - a).length();
        if area > 0.0 {
            self.light(SetLight::Triangle {
                vertices,
                radiance: power / (PI * area),
                two_sided,
            });
        }
    }

    /// A rectangle of two triangles about `center` with these half edges, which shines along their
    /// cross product.
    pub(super) fn panel(&mut self, center: Vec3, [x, y]: [Vec3; 2], power: f32) {
        let corner = |a: f32, b: f32| center + x * a + y * b;
        let corners = [
            corner(-1.0, -1.0),
            corner(1.0, -1.0),
            corner(1.0, 1.0),
            corner(-1.0, 1.0),
        ];
        let [a, b, c, d] = corners;
        self.triangle([a, b, c], 0.5 * power, false);
        self.triangle([a, c, d], 0.5 * power, false);
    }

    /// A spot at `p` with a rim of the given share of its half angle.
    pub(super) fn spot(&mut self, p: Vec3, target: Vec3, cone_deg: f32, rim: f32, intensity: f32) {
        self.light(SetLight::Spot {
            p,
            target,
            intensity,
            cone_deg,
            delta_deg: cone_deg * rim,
        });
    }

    pub(super) fn point(&mut self, p: Vec3, n: Vec3) {
        if self.wants_points() {
            self.set.points.push(SetPoint { p, n });
        }
    }

    /// The whole place about the origin.
    pub(super) fn turned(self, rotation: Quat) -> BenchSet {
        let mut set = self.set;
        if rotation != Quat::IDENTITY {
            for light in &mut set.lights {
                *light = light.turned(rotation);
            }
            for point in &mut set.points {
                *point = SetPoint {
                    p: rotation * point.p,
                    n: (rotation * point.n).normalize(),
                };
            }
        }
        set
    }
}
