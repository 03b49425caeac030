use alloc::string::String;
use alloc::vec;

use super::*;
use crate::amount::RadianceAmount;
use crate::channels::Channels;
use crate::diffuse_emission_desc::{DiffuseEmissionDesc, SurfaceColor};
use crate::glam::{Quat, Vec2, Vec3};
use crate::image::Image;
use crate::light::AreaLight;
use crate::light_desc::LightDesc;
use crate::light_ref::LightRef;
use crate::light_set_update::LightUpdateError;
use crate::mesh::MeshLight;
use crate::mesh_indices::MeshIndices;
use crate::pdf_coverage::PdfCoverage;
use crate::rgb::Rgb;
use crate::scene_sphere::SceneSphere;
use crate::texture::Texture;
use light_bounds::{LightId, LightSampleContext};

fn builder() -> LightSetBuilder<Rgb> {
    LightSetBuilder::new(SceneSphere::new(Vec3::ZERO, 100.0).expect("a sphere"))
}

fn uniform() -> SurfaceColor<Rgb> {
    SurfaceColor::Uniform(Vec3::new(1.0, 2.0, 0.5))
}

/// A tent of four triangles; its vertices are shared, or follow each other.
fn tent(color: SurfaceColor<Rgb>, is_shared: bool) -> MeshLightDesc<Rgb> {
    let corners = [Vec3::X, Vec3::Y, Vec3::NEG_X, Vec3::NEG_Y, Vec3::Z];
    let list = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]];
    let uv = |p: Vec3| Vec2::new(0.5 + 0.4 * p.x, 0.5 + 0.3 * p.y);
    let (positions, indices): (Vec<Vec3>, MeshIndices) = if is_shared {
        (corners.into(), list.into())
    } else {
        let all = list.as_flattened().iter().map(|&v| corners[v as usize]);
        (all.collect(), MeshIndices::Consecutive(4))
    };
    MeshLightDesc {
        uvs: is_shared.then(|| positions.iter().map(|&p| uv(p)).collect()),
        positions: positions.into(),
        indices,
        emission: DiffuseEmissionDesc::new(color, RadianceAmount::Radiometric(3.0)),
    }
}

fn transforms() -> [Affine3A; 4] {
    let turn = Quat::from_axis_angle(Vec3::new(0.0, 0.6, 0.8), 1.0);
    let at = Vec3::new(3.0, -7.0, 1.5);
    let scaled = |scale| Affine3A::from_scale_rotation_translation(scale, turn, at);
    [
        Affine3A::IDENTITY,
        scaled(Vec3::splat(0.3)),
        scaled(Vec3::new(0.1, 2.0, 7.0)),
        scaled(Vec3::new(-1.0, 1.0, 1.5)),
    ]
}

/// The mesh with moved vertices, and front faces that stay front faces.
fn moved(desc: &MeshLightDesc<Rgb>, to_scene: &Affine3A) -> MeshLightDesc<Rgb> {
    let positions = desc.positions.iter().map(|&p| to_scene.transform_point3(p));
    let turned = |[a, b, c]: [u32; 3]| {
        if to_scene.matrix3.determinant() < 0.0 {
            [a, c, b]
        } else {
            [a, b, c]
        }
    };
    MeshLightDesc {
        positions: positions.collect(),
        indices: desc.indices.iter().map(turned).collect::<Vec<_>>().into(),
        ..desc.clone()
    }
}

/// All that queries of a light return, in words that differ where a bit does.
fn answers(light: &LightRef<'_, Rgb>) -> String {
    let LightRef::Triangle(triangle) = light else {
        panic!("a triangle");
    };
    let mut words = alloc::format!("{:?} {:?}", light.phi(&()), light.extent());
    for i in 0..8u8 {
        let x = f32::from(i);
        let p = Vec3::new(5.0 - x, x * 0.7, 3.0 * (x - 4.0));
        let ctx = LightSampleContext::surface(p, Vec3::Z, Vec3::Z);
        let u = Vec2::new(0.1 * x + 0.05, 0.9 - 0.1 * x);
        let sample = light.sample_li(&ctx, u, &(), PdfCoverage::default());
        let wi = (triangle.shape().vertices()[0] - p).normalize();
        let pdf = light.pdf_li(&ctx, wi, PdfCoverage::default());
        let (hit, emitted) = (triangle.hit(p, wi), light.sample_le(u, u, &()));
        words += &alloc::format!("{sample:?} {pdf:?} {hit:?} {emitted:?}");
    }
    words
}

#[test]
fn placed_lights_are_those_of_a_moved_mesh_to_the_bit() {
    for is_shared in [true, false] {
        let desc = tent(uniform(), is_shared);
        let (mut placed, mut copied) = (builder(), builder());
        let prototype = placed.add_mesh_prototype(desc.clone()).expect("a mesh");
        for to_scene in transforms() {
            let source = placed.place_mesh(prototype, &to_scene).expect("a place");
            let copy = copied.add(moved(&desc, &to_scene)).expect("a mesh");
            assert_eq!(source, copy, "sources count alike");
        }
        let (placed, copied) = (placed.build(), copied.build());
        assert_eq!(placed.len(), 16, "four triangles each");
        for (id, copy) in copied.iter() {
            let light = placed.get(id).expect("as many");
            assert_eq!(answers(&light), answers(&copy), "{id:?}");
            assert_eq!(placed.source_of(id), copied.source_of(id), "{id:?}");
        }
        assert_eq!(placed.extents(), copied.extents(), "extents");
    }
}

/// The means of the texture come from the prototype, where a mirrored copy adds up in another
/// order.
#[test]
fn images_are_placed_as_well() {
    let texels: Vec<_> = (0..64u8).map(|i| f32::from(i % 7) * 0.1).collect();
    let image = Image::from_f32([8, 8], Channels::Gray, texels).expect("an image");
    let texture = Texture::new(image);
    let tint = Vec3::ONE;
    let desc = tent(SurfaceColor::Image { texture, tint }, true);
    let (mut placed, mut copied) = (builder(), builder());
    let prototype = placed.add_mesh_prototype(desc.clone()).expect("a mesh");
    for to_scene in transforms() {
        placed.place_mesh(prototype, &to_scene).expect("a place");
        copied.add(moved(&desc, &to_scene)).expect("a mesh");
    }
    let (placed, copied) = (placed.build(), copied.build());
    for (id, copy) in copied.iter() {
        let light = placed.get(id).expect("as many");
        let [power, expected] = [light.phi(&()), copy.phi(&())];
        assert!(expected.x > 0.0, "{id:?} is lit");
        assert!(power.distance(expected) < 1e-5 * expected.x, "{id:?}");
        let ctx = LightSampleContext::surface(Vec3::splat(9.0), Vec3::Z, Vec3::Z);
        let sample = |light: &LightRef<'_, Rgb>| {
            light.sample_li(&ctx, Vec2::splat(0.3), &(), PdfCoverage::default())
        };
        assert_eq!(sample(&light), sample(&copy), "{id:?}");
    }
}

#[test]
fn what_cannot_be_placed_is_refused_by_name() {
    let mut lights = builder();
    let prototype = lights.add_mesh_prototype(tent(uniform(), true));
    let prototype = prototype.expect("a mesh");
    let mut bad = tent(uniform(), true);
    bad.indices = [[0, 1, 5]].into();
    assert!(lights.add_mesh_prototype(bad).is_err(), "no such vertex");
    let place = |lights: &mut LightSetBuilder<Rgb>, id, at: Vec3| {
        lights.place_mesh(id, &Affine3A::from_translation(at)).err()
    };
    let unknown = place(&mut lights, MeshPrototypeId(1), Vec3::ZERO);
    assert_eq!(unknown, Some(PlacedMeshError::UnknownPrototype), "only one");
    let nowhere = place(&mut lights, prototype, Vec3::splat(f32::NAN));
    assert_eq!(nowhere, Some(PlacedMeshError::Transform), "NaN");
    let huge = Affine3A::from_scale_rotation_translation(
        Vec3::splat(3e38),
        Quat::IDENTITY,
        Vec3::splat(3e38),
    );
    let huge = lights.place_mesh(prototype, &huge).err();
    assert_eq!(huge, Some(PlacedMeshError::Transform), "1 is beyond f32");
    for scale in [1e17, 1e18, 3e18, 1e19, 1e20] {
        let to_scene = Affine3A::from_scale(Vec3::splat(scale));
        let refused = lights.place_mesh(prototype, &to_scene).err();
        let same = MeshLight::new(moved(&tent(uniform(), true), &to_scene)).err();
        assert_eq!(refused, same.map(PlacedMeshError::Mesh), "scale {scale}");
    }
    let mut lights = builder();
    let prototype = lights.add_mesh_prototype(tent(uniform(), true));
    let prototype = prototype.expect("a mesh");
    let endless = Affine3A::from_scale(Vec3::splat(1e20));
    let endless = lights.place_mesh(prototype, &endless).err();
    assert!(
        matches!(endless, Some(PlacedMeshError::Mesh(_))),
        "{endless:?}"
    );
    assert!(lights.build().is_empty(), "nothing was placed");

    let mut lights = builder();
    let mut many = tent(uniform(), true);
    many.indices = vec![[0, 1, 4]; 1 << 22].into();
    let many = lights.add_mesh_prototype(many).expect("a mesh");
    let mut placed = 0;
    let error = loop {
        match place(&mut lights, many, Vec3::ZERO) {
            None => placed += 1,
            Some(error) => break error,
        }
    };
    assert_eq!((placed, error), (1023, PlacedMeshError::TooMany), "ids end");
}

#[test]
fn placements_move_and_other_sources_do_not() {
    let desc = tent(uniform(), true);
    let mut lights = builder();
    let listed = lights.add(desc.clone()).expect("a mesh");
    let prototype = lights.add_mesh_prototype(desc.clone()).expect("a mesh");
    let [first, _, second, third] = transforms();
    let placed = lights.place_mesh(prototype, &first).expect("a place");
    let last = lights.place_mesh(prototype, &second).expect("a place");
    let mut set = lights.build();
    let before = set.extents();

    set.update_placement(placed, &third).expect("finite");
    let mut alone = builder();
    alone.add(moved(&desc, &third)).expect("a mesh");
    let after = set.extents();
    assert_eq!(after[4..8], alone.build().extents(), "moved");
    assert_eq!(
        [&after[..4], &after[8..]],
        [&before[..4], &before[8..]],
        "the others"
    );
    let (of, to_scene) = set.placement(placed).expect("a placement");
    assert_eq!((of, *to_scene), (prototype, third), "its transform");
    assert_eq!(set.placement(listed), None, "a mesh");
    assert_eq!(set.prototype_extents(prototype), before[..4], "at its own");
    assert!(set.prototype_extents(MeshPrototypeId(1)).is_empty(), "none");
    let refused = set.update_placement(listed, &third).err();
    assert_eq!(refused, Some(PlacedMeshError::OtherSource), "a mesh");
    let refused = set.update_placement(SourceId(9), &third).err();
    assert_eq!(refused, Some(PlacedMeshError::OtherSource), "unknown");
    let nowhere = Affine3A::from_translation(Vec3::splat(f32::INFINITY));
    let refused = set.update_placement(last, &nowhere).err();
    assert_eq!(refused, Some(PlacedMeshError::Transform), "nowhere");
    let refused = set.update(last, LightDesc::Mesh(desc)).err();
    assert_eq!(refused, Some(LightUpdateError::OtherKind), "a description");
    assert_eq!(set.extents(), after, "unchanged");
}

#[test]
fn a_thousand_placements_hold_their_mesh_once() {
    let mut desc = tent(uniform(), true);
    desc.indices = vec![[0, 1, 4]; 1000].into();
    let mut lights = builder();
    let prototype = lights.add_mesh_prototype(desc).expect("a mesh");
    let alone = lights.clone().build().bytes();
    for i in 0..1000u16 {
        let at = Affine3A::from_translation(Vec3::X * f32::from(i));
        lights.place_mesh(prototype, &at).expect("a place");
    }
    let set = lights.build();
    assert_eq!(set.len(), 1_000_000, "all");
    let bytes = set.bytes();
    assert_eq!(bytes.vertices, alone.vertices, "no copy");
    let each = (bytes.lights - alone.lights) / 1000;
    assert!((80..170).contains(&each), "{each} bytes a placement");
    let corners = set.corners(LightId(999_999));
    assert_eq!(corners, None, "by a list of vertices");
    let expected = PlacedMeshCounts {
        prototypes: 1,
        stored_lights: 1000,
        placements: 1000,
        lights: 1_000_000,
    };
    assert_eq!(set.placed_counts(), expected, "counted");
}
