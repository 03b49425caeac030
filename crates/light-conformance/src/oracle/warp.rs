//! Warps of the unit square, by their definitions.

use super::Jitter;
use glam::{DVec2, DVec3};
use std::f64::consts::{FRAC_PI_4, PI, TAU};

/// Shirley and Chiu 1997: squares around the centre become circles.
pub(crate) fn concentric_disk(u: DVec2) -> DVec2 {
    let p = 2.0 * u - 1.0;
    if p == DVec2::ZERO {
        return p;
    }
    let (r, angle) = if p.x.abs() > p.y.abs() {
        (p.x, FRAC_PI_4 * p.y / p.x)
    } else {
        (p.y, 2.0 * FRAC_PI_4 - FRAC_PI_4 * p.x / p.y)
    };
    r * DVec2::from_angle(angle)
}

/// The direction with `1 - cos` of its polar angle, and its azimuth as a part of a turn.
pub(crate) fn polar(one_minus_cos: f64, turn: f64) -> DVec3 {
    let sin = (one_minus_cos * (2.0 - one_minus_cos)).max(0.0).sqrt();
    (sin * DVec2::from_angle(TAU * turn)).extend(1.0 - one_minus_cos)
}

pub(crate) fn uniform_sphere(u: DVec2) -> DVec3 {
    polar(2.0 * u.x, u.y)
}

pub(crate) fn uniform_cone(u: DVec2, one_minus_cos_max: f64) -> DVec3 {
    polar(u.x * one_minus_cos_max, u.y)
}

/// The rim itself has no density, so directions stay above it by a rounding of the unit length.
pub(crate) fn cosine_hemisphere(u: DVec2) -> DVec3 {
    let disk = concentric_disk(u);
    let z = (1.0 - disk.length_squared()).max(0.0).sqrt();
    disk.extend(z.max(f64::from(f32::EPSILON)))
}

/// Barycentric coordinates: the square is folded along its diagonal (Heitz 2019).
pub(crate) fn uniform_triangle(u: DVec2) -> DVec3 {
    let (b0, b1) = if u.x < u.y {
        (0.5 * u.x, u.y - 0.5 * u.x)
    } else {
        (u.x - 0.5 * u.y, 0.5 * u.y)
    };
    DVec3::new(b0, b1, 1.0 - b0 - b1)
}

/// The place in [0, 1] below which the line from `a` to `b` has the part `u` of its integral.
pub(crate) fn linear(u: f64, a: f64, b: f64) -> f64 {
    if a + b == 0.0 {
        return u;
    }
    u * (a + b) / (a + ((1.0 - u) * a * a + u * b * b).sqrt())
}

/// The point of the square for weights of its corners (0, 0), (1, 0), (0, 1), (1, 1).
pub(crate) fn bilinear(u: DVec2, w: [f64; 4]) -> DVec2 {
    let y = linear(u.y, w[0] + w[1], w[2] + w[3]);
    let (a, b) = row(y, w);
    DVec2::new(linear(u.x, a, b), y)
}

pub(crate) fn bilinear_pdf(p: DVec2, w: [f64; 4]) -> f64 {
    let (a, b) = row(p.y, w);
    let sum = w.iter().sum::<f64>();
    if sum == 0.0 {
        return 1.0;
    }
    4.0 * ((1.0 - p.x) * a + p.x * b) / sum
}

fn row(y: f64, w: [f64; 4]) -> (f64, f64) {
    (w[0] + y * (w[2] - w[0]), w[1] + y * (w[3] - w[1]))
}

/// The cubic step from 0 to 1.
pub(crate) fn smoothstep(t: f64) -> f64 {
    let t = t.clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// The place in [0, 1] below which the cubic step has the part `u` of its integral.
pub(crate) fn smoothstep_sample(u: f64) -> f64 {
    bisect(|t| t * t * t * (2.0 - t) - u)
}

/// The zero in [0, 1] of a rising function.
pub(crate) fn bisect(f: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..64 {
        let middle = 0.5 * (low + high);
        if f(middle) < 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

/// The axes around the unit vector `z` of Duff et al. 2017.
pub(crate) fn frame(z: DVec3) -> [DVec3; 3] {
    let sign = 1f64.copysign(z.z);
    let a = -1.0 / (sign + z.z);
    let b = z.x * z.y * a;
    [
        DVec3::new(1.0 + sign * z.x * z.x * a, sign * b, -sign * z.x),
        DVec3::new(b, sign + z.y * z.y * a, -z.y),
        z,
    ]
}

/// A vector of the frame around the unit vector `z`, which rounding moves.
pub(crate) fn around(z: DVec3, local: DVec3, jitter: &mut Jitter) -> DVec3 {
    let [x, y, z] = frame(jitter.vector(z, 1.0).normalize());
    x * local.x + y * local.y + z * local.z
}

/// Density per solid angle of all directions.
pub(crate) const SPHERE_PDF: f64 = 0.25 / PI;
