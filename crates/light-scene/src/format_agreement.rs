//! One small scene written in every format that is read: the same triangles, materials, lights and
//! cameras.

use std::fs::read;
use std::path::{Path, PathBuf};

use lights::sources::TextureMapping;

use crate::glam::{Vec2, Vec3};
use crate::{Color, EmissionSides, Scene, Surface, read_gltf, read_obj, read_pbrt};

fn path(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("testdata/three_formats");
    folder.join(name)
}

/// A colour without reference to the scene.
#[derive(Debug)]
enum Paint {
    Plain(Vec3),
    Texels(Vec<Vec3>, Vec3, TextureMapping),
}

impl Paint {
    fn of(scene: &Scene, color: Color) -> Self {
        match color {
            Color::Constant(color) => Self::Plain(color),
            Color::Image(texture) => {
                let image = &scene.images[texture.image.0 as usize];
                Self::Texels(image.texels().to_vec(), texture.scale, texture.mapping)
            }
        }
    }

    fn is_near(&self, other: &Self) -> bool {
        // Files hold six digits, and nits become radiance by a division.
        let near = |a: Vec3, b: Vec3| a.abs_diff_eq(b, 1e-5 * b.max_element());
        match (self, other) {
            (Self::Plain(a), Self::Plain(b)) => near(*a, *b),
            (Self::Texels(a, by, on), Self::Texels(b, with, over)) => {
                a == b && near(*by, *with) && on == over
            }
            _ => false,
        }
    }
}

/// Corners of all triangles with their texture coordinates, mesh by mesh.
fn triangles(scene: &Scene) -> Vec<Vec<[(Vec3, Vec2); 3]>> {
    let of_mesh = |mesh: &crate::Mesh| {
        let uvs = mesh.uvs.as_ref().expect("texture coordinates");
        let corner = |i: u32| (mesh.positions[i as usize], uvs[i as usize]);
        mesh.indices.iter().map(|t| t.map(corner)).collect()
    };
    scene.meshes.iter().map(of_mesh).collect()
}

fn assert_alike(a: &Scene, b: &Scene, names: &str) {
    assert_eq!(triangles(a), triangles(b), "{names}: triangles");
    for (ma, mb) in a.meshes.iter().zip(&b.meshes) {
        let (ma, mb) = (a.material(ma.material), b.material(mb.material));
        let what = format!("{names}: {}", mb.name);
        match (&ma.surface, &mb.surface) {
            (Surface::Diffuse { reflectance: x }, Surface::Diffuse { reflectance: y }) => {
                let (x, y) = (Paint::of(a, *x), Paint::of(b, *y));
                assert!(x.is_near(&y), "{what}: {x:?} and {y:?}");
            }
            // glTF's metals have Schlick's Fresnel factor.
            (Surface::MetallicRoughness(x), Surface::Conductor { alpha, .. }) => {
                let Color::Constant(reflectance) = x.base_color else {
                    panic!("{what}: one colour");
                };
                let Color::Constant(Vec3 {
                    y: roughness,
                    z: metallic,
                    ..
                }) = x.roughness_metallic
                else {
                    panic!("{what}: one roughness");
                };
                assert_eq!(metallic, 1.0, "{what}: a metal");
                let width = Vec2::splat(roughness * roughness);
                let conductor = Surface::conductor_of_reflectance(reflectance, width);
                assert_eq!(conductor, mb.surface, "{what}");
                assert_eq!(*alpha, width, "{what}: roughness");
            }
            (x, y) => assert_eq!(x, y, "{what}"),
        }
        match (ma.emission, mb.emission) {
            (Some(x), Some(y)) => {
                assert_eq!(x.sides, EmissionSides::Front, "{what}: sides");
                assert_eq!(x.sides, y.sides, "{what}: sides");
                let (x, y) = (Paint::of(a, x.radiance), Paint::of(b, y.radiance));
                assert!(x.is_near(&y), "{what} emission: {x:?} and {y:?}");
            }
            (x, y) => assert_eq!(x, y, "{what}: emission"),
        }
        assert_eq!(ma.alpha, mb.alpha, "{what}: alpha");
    }
    assert!(
        a.lights.is_empty() && b.lights.is_empty(),
        "{names}: no other lights"
    );
}

#[test]
fn all_formats_read_to_the_same_scene() {
    let obj = read_obj(&path("room.obj")).expect("room.obj");
    let pbrt = read_pbrt(&path("room.pbrt")).expect("room.pbrt");
    let glb = read_gltf(&path("room.glb")).expect("room.glb");
    let gltf = read_gltf(&path("room.gltf")).expect("room.gltf");
    assert_eq!(obj.emissive_triangle_count(), 4, "two emissive quads");
    for (scene, name) in [(&pbrt, "pbrt"), (&glb, "glb"), (&gltf, "gltf")] {
        assert_alike(scene, &obj, name);
        assert_eq!(scene.warnings, [], "{name}: all understood");
        assert_eq!(scene.images.len(), 1, "{name}: the image is shared");
    }
    let (a, b) = (
        pbrt.camera.expect("a camera"),
        glb.camera.expect("a camera"),
    );
    for (a, b) in [
        (a.position, b.position),
        (a.right, b.right),
        (a.up, b.up),
        (a.forward, b.forward),
    ] {
        assert!(a.abs_diff_eq(b, 1e-6), "cameras: {a} and {b}");
    }
    assert!((a.fov - b.fov).abs() < 1e-6, "fields of view");
}

/// The `gltf` crate sees the same vertices, indices, images and places.
#[test]
fn another_reader_of_gltf_agrees() {
    let bytes = read(path("room.glb")).expect("room.glb");
    let theirs = gltf::Gltf::from_slice(&bytes).expect("valid");
    let ours = read_gltf(&path("room.glb")).expect("a scene");
    let blob = theirs.blob.as_deref();
    let mut meshes = ours.meshes.iter();
    for node in theirs.nodes() {
        let Some(mesh) = node.mesh() else {
            continue;
        };
        let ([move_x, move_y, move_z], _, _) = node.transform().decomposed();
        for primitive in mesh.primitives() {
            let ours = meshes.next().expect("as many meshes");
            let reader = primitive.reader(|_| blob);
            let positions = reader.read_positions().expect("positions");
            let moved = positions.map(|p| Vec3::from(p) + Vec3::new(move_x, move_y, move_z));
            assert_eq!(ours.positions, moved.collect::<Vec<_>>(), "positions");
            let indices: Vec<u32> = reader.read_indices().expect("indices").into_u32().collect();
            assert_eq!(ours.indices.as_flattened(), indices, "indices");
            let uvs = reader
                .read_tex_coords(0)
                .expect("texture coordinates")
                .into_f32();
            let flipped = uvs.map(|[u, v]| Vec2::new(u, 1.0 - v));
            assert_eq!(ours.uvs, Some(flipped.collect()), "texture coordinates");
        }
    }
    assert_eq!(meshes.next(), None, "no mesh more");
}
