//! Masks that do not lie as their image does.

use super::*;

/// Triangles of a mesh with other surface parameters show other parts of image and mask: each has
/// the power that it has alone.
#[test]
fn triangles_of_a_mesh_with_a_mask_of_its_own() {
    let corners = [Vec3::ZERO, Vec3::X, Vec3::X + Vec3::Y, Vec3::Y];
    let uvs = [Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y];
    let indices = [[0, 1, 2], [0, 2, 3], [1, 2, 3], [0, 1, 2]];
    let (color, mapping) = ramp();
    let desc = DiffuseEmissionDesc {
        mask: EmissionMask::Alpha(saddle()),
        mapping,
        ..DiffuseEmissionDesc::new(color, RadianceAmount::Radiometric(1.0))
    };
    let scene = SceneSphere::new(Vec3::ZERO, 4.0).expect("a sphere");
    let mut builder = LightSetBuilder::<Rgb>::new(scene);
    let mesh = MeshLightDesc {
        positions: corners.into(),
        indices: indices.into(),
        uvs: Some(uvs.into()),
        emission: desc,
    };
    builder.add(LightDesc::Mesh(mesh)).expect("a mesh");
    let set = builder.build();
    for ((_, light), places) in set.iter().zip(indices) {
        let of = |i: u32| (corners[i as usize], uvs[i as usize]);
        let triangle = Triangle::new(places.map(|i| of(i).0), places.map(|i| of(i).1));
        let triangle = triangle.expect("an area");
        let alone = emission(ramp(), saddle()).phi(&triangle, &()).x;
        let found = light.phi(&()).x;
        assert!(alone > 0.01, "{places:?}: {alone}");
        assert!((found - alone).abs() < 1e-6, "{places:?}: {found}, {alone}");
    }
}

/// A fine mask that hides the dark half of its image: by the same mapping, and by one that differs
/// only beyond the edges of the image.
#[test]
fn fine_masks_with_a_mapping_of_their_own() {
    let mut rng = Rng::new(92);
    let texels: Vec<f32> = (0..512 * 32).map(|_| rng.range(0.0, 1.0)).collect();
    let texture = Texture::from(gray([512, 32], &texels));
    let turned = Affine2::from_scale_angle_translation(Vec2::splat(0.6), 0.3, Vec2::new(0.3, 0.15));
    let [mapping, own] = [Wrap::Clamp, Wrap::Mirror].map(|wrap| TextureMapping {
        transform: turned,
        wrap: [wrap; 2],
    });
    for cutoff in [None, Some(0.5)] {
        let [together, apart] = [None, Some(own)].map(|own| {
            let mask = AlphaMask {
                mapping: own,
                cutoff,
                ..texture.clone().into()
            };
            let color = SurfaceColor::Image {
                texture: texture.clone(),
                tint: Vec3::ONE,
            };
            mean(&emission((color, mapping), mask), &square())
        });
        assert!(together > 0.26, "of noise the mean of squares: {together}");
        assert_near(apart, together, &format!("cutoff {cutoff:?}"));
    }
}

/// A mask that repeats itself so often that its smallest blocks count by their mean: over a ramp it
/// has half of its mean, but for the periods at the edges.
#[test]
fn repeated_masks_with_a_mapping_of_their_own() {
    let mut rng = Rng::new(93);
    let texels: Vec<f32> = (0..32 * 32).map(|_| rng.range(0.0, 1.0)).collect();
    let (color, mapping) = ramp();
    for cutoff in [None, Some(0.5)] {
        let [over_ramp, over_period] = [100.0, 1.0].map(|repeats| {
            let mask = AlphaMask {
                mapping: Some(TextureMapping {
                    transform: Affine2::from_scale(Vec2::splat(repeats)),
                    wrap: [Wrap::Repeat; 2],
                }),
                cutoff,
                ..gray([32, 32], &texels).into()
            };
            let color = if repeats > 1.0 {
                (color.clone(), mapping)
            } else {
                white()
            };
            mean(&emission(color, mask), &square())
        });
        let found = over_ramp / (0.5 * over_period);
        assert!((found - 1.0).abs() < 1e-3, "cutoff {cutoff:?}: {found}");
    }
}
