use core::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI, TAU};

use light_math::glam::{DVec2, DVec3};

/// The direction of a point of the unit square in the equal-area map: its centre is +z, its corners
/// are -z.
///
/// # Source
/// `[Clarberg2008]`, section 2.
pub(super) fn equal_area_direction(p: DVec2) -> DVec3 {
    let uv = p * 2.0 - 1.0;
    let abs = uv.abs();
    let inside = 1.0 - abs.x - abs.y;
    let r = 1.0 - inside.abs();
    // Inside of the diamond the angle grows along its sides, and is mirrored outside.
    let phi = if r > 0.0 {
        ((abs.y - abs.x) / r + 1.0) * FRAC_PI_4
    } else {
        0.0
    };
    let z = (1.0 - r * r) * inside.signum();
    let across = (1.0 - z * z).max(0.0).sqrt();
    DVec3::new(
        across * phi.cos() * uv.x.signum(),
        across * phi.sin() * uv.y.signum(),
        z,
    )
}

/// The point of the unit square of a direction, the inverse of [`equal_area_direction`].
pub(super) fn equal_area_place(w: DVec3) -> DVec2 {
    let abs = w.abs();
    let r = (1.0 - abs.z).max(0.0).sqrt();
    let turn = abs.y.atan2(abs.x) / FRAC_PI_2;
    // On the diamond of radius r, from the axis x to the axis y.
    let (u, v) = (r * (1.0 - turn), r * turn);
    let (u, v) = if w.z < 0.0 {
        (1.0 - v, 1.0 - u)
    } else {
        (u, v)
    };
    DVec2::new(u.copysign(w.x), v.copysign(w.y)) * 0.5 + 0.5
}

/// The direction of a point of a lat-long map, and its solid angle per area: the upper row is +y,
/// the middle +z.
pub(super) fn lat_long_direction(p: DVec2) -> (DVec3, f64) {
    let (sin_theta, cos_theta) = (PI * p.y).sin_cos();
    let (sin_phi, cos_phi) = (TAU * p.x).sin_cos();
    (
        DVec3::new(sin_theta * sin_phi, cos_theta, -sin_theta * cos_phi),
        TAU * PI * sin_theta,
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Rng;

    #[test]
    fn the_equal_area_map_and_its_inverse() {
        let mut rng = Rng::new(1);
        let mut mean = DVec3::ZERO;
        for _ in 0..10_000 {
            let p = DVec2::new(rng.f64(), rng.f64());
            let w = equal_area_direction(p);
            assert!((w.length() - 1.0).abs() < 1e-12, "{p}");
            assert!(equal_area_place(w).distance(p) < 1e-7, "{p}: {w}");
            mean += w * w / 10_000.0;
        }
        assert!(
            (mean - 1.0 / 3.0).abs().max_element() < 0.01,
            "{mean}: even"
        );
    }
}
