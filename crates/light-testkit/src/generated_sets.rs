use light_math::glam::Vec3;

use crate::{Emitter, LightSet, Rng};

/// Contexts at random places of a set; more are added at its bounds.
const CONTEXTS: usize = 12;

impl LightSet {
    /// Triangles all over the unit cube, their powers spread over three decades.
    #[must_use]
    pub fn uniform(n: usize, seed: u64) -> Self {
        let mut rng = Rng::new(seed);
        let size = 0.3 * (n as f32).powf(-1.0 / 3.0);
        let triangle = |_| {
            let (p, w) = (rng.vec3(), rng.direction());
            let power = rng.log_range(1.0, 1000.0);
            triangle(&mut rng, p, w, size, power)
        };
        Self::new("uniform", (0..n).map(triangle).collect(), CONTEXTS, seed)
    }

    /// A city: clusters of downward lamps, and of windows on round walls; one light in twenty is
    /// two-sided.
    #[must_use]
    pub fn clusters(n: usize, seed: u64) -> Self {
        let mut rng = Rng::new(seed);
        let count = usize::max(1, (n as f32).sqrt() as usize / 2);
        let centers: Vec<Vec3> = (0..count)
            .map(|_| {
                Vec3::new(
                    rng.range(0.0, 10.0),
                    rng.range(0.0, 10.0),
                    rng.range(0.2, 1.5),
                )
            })
            .collect();
        let emitters = (0..n)
            .map(|i| {
                let center = centers[i % count];
                let (p, w) = if i % count % 2 == 0 {
                    let spread = rng.vec3() - Vec3::splat(0.5);
                    (center + spread * 0.3, Vec3::NEG_Z)
                } else {
                    let out = rng.direction().with_z(0.0).normalize_or(Vec3::X);
                    (center + out * 0.4 + Vec3::Z * rng.f32(), out)
                };
                let power = rng.log_range(0.1, 10.0);
                let light = triangle(&mut rng, p, w, 0.02, power);
                if i % 20 == 19 {
                    two_sided(light)
                } else {
                    light
                }
            })
            .collect();
        Self::new("clusters", emitters, CONTEXTS, seed)
    }

    /// Spot lights and a few point lights above a floor, most of them pointing roughly down.
    #[must_use]
    pub fn spots(n: usize, seed: u64) -> Self {
        let mut rng = Rng::new(seed);
        let emitters = (0..n)
            .map(|i| {
                let position = Vec3::new(
                    rng.range(0.0, 10.0),
                    rng.range(0.0, 10.0),
                    rng.range(1.0, 4.0),
                );
                if i % 5 == 4 {
                    let intensity = rng.log_range(0.1, 10.0);
                    Emitter::Point {
                        position,
                        intensity,
                    }
                } else {
                    spot(&mut rng, position)
                }
            })
            .collect();
        Self::new("spots", emitters, CONTEXTS, seed)
    }

    /// All kinds together, a few of them very strong, with a sky and a sun.
    #[must_use]
    pub fn mixed(n: usize, seed: u64) -> Self {
        let mut rng = Rng::new(seed);
        let emitters = (0..n)
            .map(|i| {
                let (p, w) = (rng.vec3() * 10.0, rng.direction());
                let strength = if i % 50 == 7 { 1e6 } else { 1.0 };
                let power = strength * rng.log_range(0.1, 10.0);
                match i % 10 {
                    0 if i == 10 => Emitter::Sky { radiance: 0.01 },
                    0 if i == 20 => Emitter::Sun {
                        wi: Vec3::new(0.6, 0.0, 0.8),
                        irradiance: 2.0,
                    },
                    0 | 1 => Emitter::Point {
                        position: p,
                        intensity: power,
                    },
                    2 | 3 => spot(&mut rng, p),
                    4 | 5 => two_sided(triangle(&mut rng, p, w, 0.2, power)),
                    _ => triangle(&mut rng, p, w, 0.2, power),
                }
            })
            .collect();
        Self::new("mixed", emitters, CONTEXTS, seed)
    }
}

/// A triangle of about the given size around `p` that faces `w` and emits `power`.
pub(crate) fn triangle(rng: &mut Rng, p: Vec3, w: Vec3, size: f32, power: f32) -> Emitter {
    let (x, y) = w.any_orthonormal_pair();
    let turn = rng.range(0.0, core::f32::consts::TAU);
    let corner = |k: u8| {
        let angle = turn + f32::from(k) * core::f32::consts::TAU / 3.0;
        p + (x * angle.cos() + y * angle.sin()) * (0.5 * size)
    };
    let area = 0.75 * 3f32.sqrt() * (0.5 * size) * (0.5 * size);
    Emitter::Triangle {
        corners: [corner(0), corner(1), corner(2)],
        radiance: power / (core::f32::consts::PI * area),
        two_sided: false,
    }
}

fn two_sided(light: Emitter) -> Emitter {
    match light {
        Emitter::Triangle {
            corners, radiance, ..
        } => Emitter::Triangle {
            corners,
            radiance,
            two_sided: true,
        },
        other => other,
    }
}

/// A spot light that points roughly down; one in eight has no falloff band.
fn spot(rng: &mut Rng, position: Vec3) -> Emitter {
    let end = rng.range(0.1, 1.2);
    let band = if rng.below(8) == 0 {
        0.0
    } else {
        rng.range(0.1, 0.9)
    };
    Emitter::Spot {
        position,
        axis: (Vec3::NEG_Z + 0.4 * rng.direction()).normalize(),
        intensity: rng.log_range(0.1, 10.0),
        cos_start: (end * (1.0 - band)).cos(),
        cos_end: end.cos(),
    }
}
