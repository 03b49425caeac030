//! FLIP against figures of the PyPI package `flip-evaluator` 1.7: small pictures that a formula
//! makes, so that no file is needed.

use light_render::Flip;
use light_scene::glam::Vec3;

/// Numbers in `[0, 1)` that look random.
fn noise(index: u32, channel: u32, seed: u32) -> f32 {
    let mut x = index
        .wrapping_mul(2_654_435_761)
        .wrapping_add(channel.wrapping_mul(40_503_u32.wrapping_mul(65_537)))
        .wrapping_add(seed.wrapping_mul(97_003_u32.wrapping_mul(4_099)));
    x = (x ^ (x >> 15)).wrapping_mul(2_246_822_519);
    x ^= x >> 13;
    (x >> 8) as f32 / (1 << 24) as f32
}

fn noise_picture([w, h]: [u32; 2], seed: u32) -> Vec<Vec3> {
    let pixel = |i| Vec3::from_array([0, 1, 2].map(|channel| noise(i, channel, seed)));
    (0..w * h).map(pixel).collect()
}

/// Edges in two directions, and stripes.
fn shapes([w, h]: [u32; 2]) -> Vec<Vec3> {
    let pixel = |(x, y): (u32, u32)| {
        Vec3::new(
            if x * 2 < w { 0.125 } else { 0.75 },
            if y * 3 < h { 0.5 } else { 0.25 },
            if (x + y) % 8 < 4 { 0.0625 } else { 0.375 },
        )
    };
    let places = (0..h).flat_map(|y| (0..w).map(move |x| (x, y)));
    places.map(pixel).collect()
}

/// The size, and what the package says of noise, of noisy shapes, and of noisy radiance.
const FIGURES: [([u32; 2], [f64; 3]); 4] = [
    ([1, 1], [0.955_159_0, 0.138_698_8, 0.136_400_0]),
    ([24, 16], [0.446_063_4, 0.093_164_7, 0.172_872_9]),
    ([37, 5], [0.486_520_8, 0.104_551_9, 0.190_569_2]),
    ([64, 48], [0.412_917_6, 0.085_971_7, 0.152_798_7]),
];

#[test]
fn figures_are_those_of_the_package() {
    for (size, [noise, noisy, radiance]) in FIGURES {
        let (a, b, shapes) = (noise_picture(size, 1), noise_picture(size, 2), shapes(size));
        let close = |what: &str, flip: Option<Flip>, expected: f64| {
            let mean = flip.expect("the same size").mean();
            // Half of the 1e-4 that is promised: both compute with f32.
            assert!(
                (mean - expected).abs() < 5e-5,
                "{size:?}, {what}: {mean}, {expected}"
            );
        };
        close("noise", Flip::ldr(&b, &a, size[0]), noise);
        let add = |(s, n): (&Vec3, &Vec3)| (s + (n - 0.5) * 0.125).clamp(Vec3::ZERO, Vec3::ONE);
        let with_noise: Vec<Vec3> = shapes.iter().zip(&a).map(add).collect();
        close("shapes", Flip::ldr(&with_noise, &shapes, size[0]), noisy);
        let bright = |(s, n): (&Vec3, &Vec3)| s * 8.0 * n * n;
        let reference: Vec<Vec3> = shapes.iter().zip(&b).map(bright).collect();
        let times = |(r, n): (&Vec3, &Vec3)| r * (0.5 + n);
        let image: Vec<Vec3> = reference.iter().zip(&a).map(times).collect();
        close("radiance", Flip::hdr(&image, &reference, size[0]), radiance);
    }
}

#[test]
fn equal_pictures_do_not_differ() {
    let picture = noise_picture([9, 7], 3);
    for flip in [
        Flip::ldr(&picture, &picture, 9),
        Flip::hdr(&picture, &picture, 9),
    ] {
        let flip = flip.expect("the same size");
        assert_eq!(flip.mean(), 0.0, "{flip:?}");
        assert_eq!(flip.map.len(), 63, "a number a pixel");
    }
}

#[test]
fn sizes_must_agree() {
    let picture = noise_picture([6, 1], 1);
    assert_eq!(
        Flip::ldr(&picture, &picture[1..], 5),
        None,
        "one is missing"
    );
    assert_eq!(Flip::hdr(&picture, &picture, 4), None, "no whole rows");
    assert_eq!(Flip::ldr(&picture, &picture, 0), None, "no rows");
    assert_eq!(Flip::ldr(&[], &[], 1), None, "no pixels");
}

/// A reference without light has no exposure of its own; any light is then a large difference.
#[test]
fn odd_radiance_gives_numbers() {
    let black = vec![Vec3::ZERO; 12];
    let lit = vec![Vec3::ONE; 12];
    let odd = vec![Vec3::new(f32::NAN, f32::INFINITY, -1.0); 12];
    let mean = |a: &[Vec3], b: &[Vec3]| Flip::hdr(a, b, 4).expect("the same size").mean();
    assert_eq!(mean(&black, &black), 0.0, "the same");
    assert!(mean(&lit, &black) > 0.9, "as far as can be");
    for (a, b) in [(&odd, &lit), (&lit, &odd), (&odd, &odd)] {
        assert!((0.0..=1.0).contains(&mean(a, b)), "{}", mean(a, b));
    }
}
