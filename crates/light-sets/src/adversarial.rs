//! Sets on which light hierarchies have failed: excessive depth, probability 0 for lights that
//! contribute, or powers that underflow.

use glam::Vec3;
use light_math::float;

use crate::bench_set::{BenchSet, POINTS};
use crate::random::{Random, repeat};
use crate::set_light::SetLight;
use crate::set_point::SetPoint;

/// How many scales nested clusters have, each an eighth of the one before.
const SCALES: i32 = 24;

/// Side of the large world and of a town in it, and radius of its lights: 10 km, 40 m, 1 cm.
const WORLD: f32 = 10_000.0;
const TOWN: f32 = 40.0;
const LIGHT: f32 = 0.01;

/// Side of a place of lamps.
const PLACE: f32 = 30.0;

impl BenchSet {
    /// Points and spots at one place, with points all around it and every 64th there.
    pub(super) fn one_point(r: &mut Random, n: usize) -> Self {
        let place = Vec3::new(1.0, 2.0, 3.0);
        let mut index = 0;
        Self {
            lights: repeat(n, || point_or_spot(r, place)),
            points: repeat(POINTS, || {
                index += 1;
                let distance = 0.001 * r.log_uniform(4.0);
                SetPoint {
                    p: if index % 64 == 0 {
                        place
                    } else {
                        place + r.direction() * distance
                    },
                    n: r.direction(),
                }
            }),
        }
    }

    /// Points and spots along the x axis, with points at all distances from it.
    pub(super) fn line(r: &mut Random, n: usize) -> Self {
        Self {
            lights: repeat(n, || {
                let place = Vec3::X * (2.0 * r.unit() - 1.0);
                point_or_spot(r, place)
            }),
            points: repeat(POINTS, || {
                let distance = 0.0001 * r.log_uniform(4.0);
                SetPoint {
                    p: Vec3::X * (2.4 * r.unit() - 1.2) + r.direction() * distance,
                    n: r.direction(),
                }
            }),
        }
    }

    /// Triangles in clusters about the origin, each cluster an eighth as wide as the one before,
    /// over 24 scales.
    pub(super) fn nested(r: &mut Random, n: usize) -> Self {
        let mut next = 0..;
        let mut scale = || float::powf(0.125, (next.next().unwrap_or(0) % SCALES) as f32);
        let size = 0.3 * float::powf((n as f32 / SCALES as f32).max(1.0), -1.0 / 3.0);
        let lights = repeat(n, || {
            let scale = scale();
            let center = (r.cube() - 0.5) * scale;
            small_triangle(r, center, size * scale, scale)
        });
        Self {
            lights,
            points: repeat(POINTS, || SetPoint {
                p: (r.cube() - 0.5) * scale(),
                n: r.direction(),
            }),
        }
    }

    /// Triangles of 2 cm in towns of a world of 10 km, where a float is as coarse as a millimetre.
    /// Three points in four are in a town.
    pub(super) fn large_world(r: &mut Random, n: usize) -> Self {
        let towns = repeat((n.isqrt() / 2).max(1), || r.cube() * WORLD);
        let mut next = 0;
        let mut place = |r: &mut Random| {
            next += 1;
            towns[next % towns.len()] + (r.cube() - 0.5) * TOWN
        };
        Self {
            lights: repeat(n, || {
                let center = place(r);
                let power = r.log_uniform(2.0);
                small_triangle(r, center, LIGHT, power)
            }),
            points: repeat(POINTS, || SetPoint {
                p: if r.unit() < 0.75 {
                    place(r)
                } else {
                    r.cube() * WORLD
                },
                n: r.direction(),
            }),
        }
    }

    /// Points at distances from 1e-20 to 1e18, as strong as the square of the distance, and points
    /// at the same distances.
    pub(super) fn magnitudes(r: &mut Random, n: usize) -> Self {
        let place = |r: &mut Random| {
            let distance = 1e-20 * r.log_uniform(38.0);
            (r.direction() * distance, distance)
        };
        Self {
            lights: repeat(n, || {
                let (p, distance) = place(r);
                SetLight::Point {
                    p,
                    intensity: distance * distance,
                }
            }),
            points: repeat(POINTS, || SetPoint {
                p: place(r).0,
                n: r.direction(),
            }),
        }
    }

    /// Panels and spots that shine down in two places, in turn, with points on the ground of both.
    pub(super) fn twin_places(r: &mut Random, n: usize) -> Self {
        let distance = 10.0 * PLACE * r.log_uniform(1.0);
        let away = r.direction() * distance;
        let mut middles = [Vec3::ZERO, away].into_iter().cycle();
        let mut middle = || middles.next().unwrap_or_default();
        Self {
            lights: repeat(n, || lamp(r, middle(), n)),
            points: repeat(POINTS, || SetPoint {
                p: middle() + on_ground(r),
                n: Vec3::Z,
            }),
        }
    }

    /// Panels and spots that shine down in one place, with points on its ground, and one point
    /// light far above the horizon.
    pub(super) fn far_lamp(r: &mut Random, n: usize) -> Self {
        let distance = 1000.0 * PLACE;
        let mut lights = repeat(n, || lamp(r, Vec3::ZERO, n));
        // About the mean irradiance of the others.
        let intensity = 3.0 * n as f32 / (PLACE * PLACE) * distance * distance;
        let p = (r.direction() + 2.0 * Vec3::Z).normalize() * distance;
        if let Some(last) = lights.last_mut() {
            *last = SetLight::Point { p, intensity };
        }
        Self {
            lights,
            points: repeat(POINTS, || SetPoint {
                p: on_ground(r),
                n: Vec3::Z,
            }),
        }
    }
}

/// A panel or a spot that shines down into a place about `middle`, as one of so many.
fn lamp(r: &mut Random, middle: Vec3, n: usize) -> SetLight {
    let high = Vec3::new(0.0, 0.0, 2.8 + 0.4 * r.unit());
    let p = middle + on_ground(r) + high;
    let power = r.log_uniform(1.5);
    if r.unit() < 0.5 {
        let size = 0.3 * PLACE / float::sqrt(n as f32);
        return r.triangle(p, Vec3::NEG_Z, size, power, false);
    }
    let cone_deg = 15.0 + 45.0 * r.unit();
    SetLight::Spot {
        p,
        target: p + Vec3::NEG_Z,
        intensity: power,
        cone_deg,
        delta_deg: cone_deg * (0.1 + 0.4 * r.unit()),
    }
}

/// A point of a place about the origin, on its ground.
fn on_ground(r: &mut Random) -> Vec3 {
    (r.square() - 0.5).extend(0.0) * PLACE
}

/// One point light to two spots in any direction.
fn point_or_spot(r: &mut Random, p: Vec3) -> SetLight {
    let intensity = r.log_uniform(2.0);
    if r.unit() < 1.0 / 3.0 {
        return SetLight::Point { p, intensity };
    }
    let cone_deg = 10.0 + 60.0 * r.unit();
    SetLight::Spot {
        p,
        target: p + r.direction(),
        intensity,
        cone_deg,
        delta_deg: cone_deg * (0.1 + 0.4 * r.unit()),
    }
}

/// A triangle of any direction. Its shape is made at size 1, since the squares of tiny sizes vanish
/// in `f32`; one in twenty is two-sided.
#[expect(clippy::cast_possible_truncation, reason = "rounding is what is meant")]
fn small_triangle(r: &mut Random, center: Vec3, size: f32, power: f32) -> SetLight {
    let (normal, two_sided) = (r.direction(), r.unit() < 0.05);
    let mut light = r.triangle(Vec3::ZERO, normal, 1.0, 1.0, two_sided);
    if let SetLight::Triangle {
        vertices, radiance, ..
    } = &mut light
    {
        *vertices = vertices.map(|v| center + v * size);
        let squared = f64::from(size) * f64::from(size);
        *radiance = (f64::from(*radiance) * f64::from(power) / squared) as f32;
    }
    light
}
