use super::*;

fn white(roughness: f32) -> MetallicRoughnessParameters {
    MetallicRoughnessParameters {
        base_color: Vec3::ONE,
        metallic: 0.0,
        roughness,
        f0: Vec3::splat(0.04),
        f90: 1.0,
        clearcoat: None,
    }
}

/// The reflected share of uniform light.
fn albedo(parameters: &MetallicRoughnessParameters, cos: f32) -> Vec3 {
    let bsdf = MetallicRoughness::new(parameters);
    let wo = Vec3::new((1.0 - cos * cos).sqrt(), 0.0, cos);
    let n = 48u16;
    let mut sum = Vec3::ZERO;
    for k in 0..n * n {
        let u = Vec2::new(f32::from(k / n) + 0.5, f32::from(k % n) + 0.5) / f32::from(n);
        let lobe = (f32::from(k) * 0.618_034).fract();
        sum += bsdf.sample(wo, lobe, u).map_or(Vec3::ZERO, |s| s.weight);
    }
    sum / f32::from(n * n)
}

#[test]
fn a_white_dielectric_reflects_all_light_at_every_roughness() {
    for roughness in [0.0, 0.1, 0.3, 0.5, 0.8, 1.0] {
        for cos in [0.1, 0.3, 0.6, 1.0] {
            let found = albedo(&white(roughness), cos).x;
            assert!((found - 1.0).abs() < 0.015, "{roughness}, {cos}: {found}");
        }
    }
}

#[test]
fn a_smooth_metal_reflects_by_its_colour_and_half_a_metal_by_half() {
    let color = Vec3::new(0.9, 0.6, 0.2);
    let metal = |metallic| MetallicRoughnessParameters {
        base_color: color,
        metallic,
        ..white(0.0)
    };
    let full = albedo(&metal(1.0), 1.0);
    assert!(full.abs_diff_eq(color, 5e-5), "{full}");
    assert!(MetallicRoughness::new(&metal(1.0)).is_dirac(), "a mirror");
    let half = albedo(&metal(0.5), 1.0);
    // Half of the metal, and half of what the dielectric reflects and lets through.
    let expected = 0.5 * color + 0.5 * (Vec3::splat(0.04) + 0.96 * color);
    assert!(half.abs_diff_eq(expected, 0.02), "{half}, not {expected}");
}

#[test]
fn a_coat_adds_no_light_and_darkens_what_is_below() {
    for (coat, cos) in [(0.0, 0.9), (0.3, 0.4), (0.7, 0.2)] {
        let coated = MetallicRoughnessParameters {
            clearcoat: Some([1.0, coat]),
            ..white(0.5)
        };
        let found = albedo(&coated, cos).x;
        assert!(found < 1.005 && found > 0.85, "{coat}, {cos}: {found}");
        let black = MetallicRoughnessParameters {
            base_color: Vec3::ZERO,
            f0: Vec3::ZERO,
            f90: 0.0,
            ..coated
        };
        let alone = albedo(&black, cos).x;
        assert!(alone > 0.03 && alone < 0.4, "the coat alone: {alone}");
    }
}
