//! The equal-area map of the sphere to the square of Clarberg 2008.

use glam::{DVec2, DVec3};
use std::f64::consts::{FRAC_2_PI, FRAC_PI_4};

pub(crate) fn square_to_sphere(p: DVec2) -> DVec3 {
    let q = 2.0 * p - 1.0;
    let a = q.abs();
    let inside = 1.0 - a.x - a.y;
    let r = 1.0 - inside.abs();
    let angle = if r == 0.0 { 1.0 } else { (a.y - a.x) / r + 1.0 } * FRAC_PI_4;
    let s = r * (2.0 - r * r).sqrt();
    DVec3::new(
        (s * angle.cos()).copysign(q.x),
        (s * angle.sin()).copysign(q.y),
        (1.0 - r * r).copysign(inside),
    )
}

pub(crate) fn sphere_to_square(d: DVec3) -> DVec2 {
    let d = d.normalize();
    let a = d.abs();
    // 1 - |z|, without its cancellation.
    let r = ((a.x * a.x + a.y * a.y) / (1.0 + a.z)).sqrt();
    let y = f64::atan2(a.y, a.x) * FRAC_2_PI * r;
    let mut q = DVec2::new(r - y, y);
    if d.z < 0.0 {
        q = DVec2::new(1.0 - q.y, 1.0 - q.x);
    }
    0.5 * DVec2::new(q.x.copysign(d.x), q.y.copysign(d.y)) + 0.5
}

/// The texel of an `n` by `n` map for indices that may lie beyond its edges by less than `n`: the
/// neighbour on the sphere.
pub(crate) fn wrap([x, y]: [i64; 2], n: i64) -> [usize; 2] {
    let beyond = |i: i64| !(0..n).contains(&i);
    let back = |i: i64| {
        if i < 0 {
            -1 - i
        } else if i >= n {
            2 * n - 1 - i
        } else {
            i
        }
    };
    let (mut p, mut q) = (x, y);
    if beyond(p) {
        (p, q) = (back(p), n - 1 - q);
    }
    if beyond(q) {
        (p, q) = (n - 1 - p, back(q));
    }
    [p, q].map(|i| usize::try_from(i).unwrap_or(0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_ways() {
        for i in 0..400 {
            let p = DVec2::new(f64::from(i % 20) + 0.3, f64::from(i / 20) + 0.6) / 20.0;
            let back = sphere_to_square(square_to_sphere(p));
            assert!(back.distance(p) < 1e-12, "{p}: {back}");
        }
    }

    #[test]
    fn neighbours_are_near() {
        let n = 8;
        let center = |[x, y]: [i64; 2]| {
            let p = DVec2::new(x as f64, y as f64) + 0.5;
            square_to_sphere(p / n as f64)
        };
        for i in 0..n {
            for beyond in [[-1, i], [n, i], [i, -1], [i, n]] {
                let beside = beyond.map(|x| x.clamp(0, n - 1));
                let [x, y] = wrap(beyond, n).map(|x| x as i64);
                let distance = center([x, y]).distance(center(beside));
                assert!(distance < 0.6, "{beyond:?} is {distance} from {beside:?}");
            }
        }
    }
}
