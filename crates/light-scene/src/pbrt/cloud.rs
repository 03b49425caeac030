use lights::math::Aabb;

use crate::glam::Vec3;

/// A cloud that thins out upward, from layers of noise.
///
/// # Source
/// `[PBRT4]`, its medium of type "cloud": the same layers and the same fall of the density with
/// height over a noise of our own, so that clouds look alike but are not the same.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cloud {
    pub(super) density: f32,
    pub(super) wispiness: f32,
    pub(super) frequency: f32,
}

impl Cloud {
    /// The density at the centres of the cells of a grid that fills `bounds`, x fastest.
    pub(super) fn sampled(&self, bounds: &Aabb, size: [u32; 3]) -> Vec<f32> {
        let cell = bounds.diagonal() / Vec3::from(size.map(|n| n as f32));
        let [nx, ny, nz] = size;
        let places =
            (0..nz).flat_map(|z| (0..ny).flat_map(move |y| (0..nx).map(move |x| [x, y, z])));
        let centre =
            |place: [u32; 3]| bounds.min + cell * (Vec3::from(place.map(|i| i as f32)) + 0.5);
        places.map(|place| self.density(centre(place))).collect()
    }

    fn density(&self, p: Vec3) -> f32 {
        let mut at = p * self.frequency;
        let (mut shift, mut scale) = (0.05 * self.wispiness, 10.0);
        for _ in 0..2 {
            at += shift * noise_gradient(at * scale);
            shift *= 0.5;
            scale *= 1.99;
        }
        let (mut weight, mut scale, mut sum) = (0.5, 1.0, 0.0);
        for _ in 0..5 {
            sum += weight * noise(at * scale);
            weight *= 0.5;
            scale *= 1.99;
        }
        let puffs = ((1.0 - p.y) * 4.5 * self.density * sum).clamp(0.0, 1.0);
        (puffs + 2.0 * (0.5 - p.y).max(0.0)).clamp(0.0, 1.0)
    }
}

/// Smooth noise of mean 0 within [-1, 1] whose details are one unit in size: zero at the points of
/// the lattice, with a slope there that is drawn from a hash.
fn noise(p: Vec3) -> f32 {
    let base = p.floor();
    let f = p - base;
    // Perlin's quintic, flat to second order at both ends.
    let s = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
    let mut sum = 0.0;
    for corner in 0u8..8 {
        let offset = Vec3::from([0, 1, 2].map(|bit| f32::from(corner >> bit & 1)));
        let weight = s * offset + (Vec3::ONE - s) * (Vec3::ONE - offset);
        sum += weight.element_product() * slope(base + offset).dot(f - offset);
    }
    sum
}

/// The gradient of [`noise`], by differences.
fn noise_gradient(p: Vec3) -> Vec3 {
    const STEP: f32 = 0.01;
    let here = noise(p);
    Vec3::from(Vec3::AXES.map(|axis| (noise(p + axis * STEP) - here) / STEP))
}

/// One of the twelve directions to the edges of a cube.
fn slope(lattice: Vec3) -> Vec3 {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a lattice point wraps around far away"
    )]
    let key = lattice.to_array().map(|x| (x as i64 & 0xffff_ffff) as u32);
    let mixed = key.iter().fold(0x9e37_79b9u32, |hash, &x| {
        let hash = (hash ^ x).wrapping_mul(0x7feb_352d);
        (hash ^ hash >> 15).wrapping_mul(0x846c_a68b) ^ hash >> 16
    });
    let sign = |bit: u32| if mixed >> bit & 1 == 0 { 1.0 } else { -1.0 };
    let (a, b) = (sign(20), sign(21));
    match (mixed >> 24) % 3 {
        0 => Vec3::new(0.0, a, b),
        1 => Vec3::new(a, 0.0, b),
        _ => Vec3::new(a, b, 0.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_is_smooth_and_centred() {
        let n = 4096u16;
        let place = |i: u16| Vec3::new(0.37, 0.61, 0.83) * f32::from(i);
        let values: Vec<f32> = (0..n).map(|i| noise(place(i))).collect();
        let mean = values.iter().sum::<f32>() / f32::from(n);
        assert!(mean.abs() < 0.02, "mean {mean}");
        assert!(values.iter().all(|v| v.abs() <= 1.0), "bounded");
        assert!(values.iter().any(|v| v.abs() > 0.4), "not flat");
        let p = Vec3::new(3.0, 1.7, -2.2);
        let across = noise(p + Vec3::X * 1e-4) - noise(p - Vec3::X * 1e-4);
        assert!(across.abs() < 1e-3, "no step at the lattice");
    }

    #[test]
    fn a_cloud_is_dense_below_and_gone_above() {
        let cloud = Cloud {
            density: 1.0,
            wispiness: 1.0,
            frequency: 5.0,
        };
        let values = cloud.sampled(&Aabb::new(Vec3::ZERO, Vec3::ONE), [8, 8, 8]);
        let layer = |y: usize| -> f32 {
            let of = |z: usize| (0..8).map(move |x| (z * 8 + y) * 8 + x);
            (0..8).flat_map(of).map(|i| values[i]).sum()
        };
        assert!(layer(0) > 0.8 * 64.0 && layer(7) < 8.0, "falls with height");
        assert!(values.iter().all(|v| (0.0..=1.0).contains(v)), "a share");
    }
}
