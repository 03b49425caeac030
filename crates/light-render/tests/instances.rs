//! Objects that stand in several places look as copies of them do, and are stored once.

mod support;

use std::path::Path;

use light_render::{Ray, Surface, World, WorldError};
use light_scene::glam::{Affine3A, Quat, Vec2, Vec3};
use light_scene::{
    Alpha, Color, ColorImage, Emission, Files, Image, Material, MaterialId, Mesh, Placement,
    Prototype, Scene, Surface as Finish, parse_scene,
};
use lights::media::phase::Isotropic;
use lights::media::{Homogeneous, Region, Substance};
use lights::sources::MediumInterface;
use serde_json::json;
use support::{Shot, agree, cornell, room};

/// A ball of `columns` times half as many quads, with normals and texture coordinates.
fn ball(material: MaterialId, columns: u32) -> Mesh {
    let mut mesh = Mesh::new("ball", material);
    let (mut normals, mut uvs) = (Vec::new(), Vec::new());
    let rows = columns / 2;
    for (j, i) in (0..=rows).flat_map(|j| (0..=columns).map(move |i| (j, i))) {
        let uv = Vec2::new(i as f32 / columns as f32, j as f32 / rows as f32);
        let (phi, theta) = (uv.x * core::f32::consts::TAU, uv.y * core::f32::consts::PI);
        let n = Vec3::new(
            theta.sin() * phi.cos(),
            theta.sin() * phi.sin(),
            -theta.cos(),
        );
        mesh.positions.push(n);
        normals.push(n);
        uvs.push(uv);
    }
    for (j, i) in (0..rows).flat_map(|j| (0..columns).map(move |i| (j, i))) {
        let a = j * (columns + 1) + i;
        let b = a + columns + 1;
        if j > 0 {
            mesh.indices.push([a, a + 1, b + 1]);
        }
        if j + 1 < rows {
            mesh.indices.push([a, b + 1, b]);
        }
    }
    (mesh.normals, mesh.uvs) = (Some(normals), Some(uvs));
    mesh
}

/// A block without normals and texture coordinates.
fn block(material: MaterialId) -> Mesh {
    let mut mesh = Mesh::new("block", material);
    for [a, b, c, d] in room() {
        mesh.push_quad([a, d, c, b].map(|p| p * Vec3::new(0.5, 3.0, 0.5) - Vec3::Y * 3.0));
    }
    mesh
}

/// Turned, mirrored, squeezed and skewed places in the box `[0, 1]^3`.
fn places() -> Vec<Affine3A> {
    let turn = |angle| Affine3A::from_axis_angle(Vec3::new(1.0, 2.0, 2.0) / 3.0, angle);
    [
        (Vec3::new(0.3, 0.7, 0.4), turn(0.0), Vec3::splat(0.1)),
        (
            Vec3::new(0.7, 0.7, 0.4),
            turn(1.0),
            Vec3::new(0.15, 0.05, 0.1),
        ),
        (
            Vec3::new(0.7, 0.3, 0.3),
            turn(2.0),
            Vec3::new(-0.1, 0.1, 0.1),
        ),
        (
            Vec3::new(0.8, 0.2, 0.7),
            turn(3.0),
            Vec3::new(0.02, -0.05, 0.2),
        ),
    ]
    .map(|(at, turn, scale)| {
        Affine3A::from_translation(at) * turn * Affine3A::from_scale(scale) * turn
    })
    .to_vec()
}

/// The room with a tree of matt wood, in [`places`], its crown of `crown`.
fn grove(crown: Material) -> Scene {
    let mut scene = cornell();
    let wood = scene.add_material(Material::diffuse("wood", Vec3::new(0.5, 0.4, 0.2)));
    let crown = scene.add_material(crown);
    let tree = Prototype::new("tree", vec![block(wood), ball(crown, 16)]);
    let prototype = scene.add_prototype(tree);
    let placed = places()
        .into_iter()
        .map(|place| Placement { prototype, place });
    scene.placements.extend(placed);
    scene
}

fn green() -> Material {
    Material::diffuse("leaves", Vec3::new(0.2, 0.6, 0.1))
}

/// The same scene with copies instead of placements.
fn flattened(scene: &Scene) -> Scene {
    let mut flat = scene.clone();
    flat.prototypes.clear();
    for Placement { prototype, place } in core::mem::take(&mut flat.placements) {
        let Prototype {
            meshes, spheres, ..
        } = scene.prototype(prototype);
        flat.meshes
            .extend(meshes.iter().map(|mesh| mesh.transformed(&place)));
        for sphere in spheres {
            match sphere.transformed(&place) {
                Some(sphere) => flat.spheres.push(sphere),
                None => flat.meshes.push(sphere.mesh(512).transformed(&place)),
            }
        }
    }
    flat
}

fn world(scene: &Scene) -> World {
    World::new(scene.clone()).expect("a good scene")
}

/// Rays between points of two lattices in the room.
fn rays() -> impl Iterator<Item = Ray> {
    let lattice = |i: u32, g: Vec3| (g * i as f32).fract();
    (1..40_000).map(move |i| {
        let origin = lattice(i, Vec3::new(0.819_172_5, 0.671_043_6, 0.549_700_5));
        let target = lattice(i, Vec3::new(0.754_877_7, 0.569_840_3, 0.430_159_7));
        let direction = (target - origin).normalize();
        Ray { origin, direction }
    })
}

#[test]
fn rays_meet_what_they_meet_of_copies() {
    let scene = grove(green());
    let (placed, flat) = (world(&scene), world(&flattened(&scene)));
    let mut met = 0;
    for ray in rays() {
        let hits = [&placed, &flat].map(|world| world.closest(&ray, None));
        let [Some(a), Some(b)] = hits else {
            panic!("the room is closed: {hits:?}");
        };
        if a.primitive.placement().is_none() {
            // Where two walls meet, either may be hit first.
            assert!(a.p.distance(b.p) < 1e-5, "{} and {}", a.p, b.p);
            continue;
        }
        met += 1;
        assert!(a.p.distance(b.p) < 1e-5, "{} and {}", a.p, b.p);
        assert!(a.n.distance(b.n) < 1e-5, "{} and {}", a.n, b.n);
        assert!(a.ns.distance(b.ns) < 1e-3, "{} and {}", a.ns, b.ns);
        assert!(a.uv.distance(b.uv) < 1e-3, "{} and {}", a.uv, b.uv);
        let light = |surface: &Surface| surface.p + a.n * 0.3;
        let hidden = [(&placed, &a), (&flat, &b)]
            .map(|(world, surface)| world.occluded(surface, a.n, light(surface)));
        assert_eq!(hidden[0], hidden[1], "the same shadow at {}", a.p);
    }
    assert!(met > 2000, "{met} rays met a tree");
}

/// The placements of `scene` look like copies: with the same random numbers no more than one pixel in a hundred differs, where rounding
/// sent a path another way, and the means agree within their noise.
fn assert_looks_flattened(scene: &Scene, what: &str) {
    let shot = Shot {
        size: 32,
        spp: 4,
        ..Shot::default()
    };
    let flat = flattened(scene);
    let [a, b] = [scene, &flat].map(|scene| shot.render(scene, 7).film.develop());
    let differ = |(a, b): &(&Vec3, &Vec3)| a.distance(**b) > 1e-3 * a.max_element();
    let different = a.iter().zip(&b).filter(differ).count();
    assert!(different <= 10, "{what}: {different} of 1024 pixels differ");
    let [a, b] = [scene, &flat].map(|scene| shot.mean(scene));
    assert!(agree(a, b), "{what}: {a:?} and {b:?}");
}

#[test]
fn pictures_are_those_of_copies() {
    assert_looks_flattened(&grove(green()), "matt");
    let glass = Finish::Dielectric {
        eta: 1.5,
        alpha: Vec2::ZERO,
    };
    assert_looks_flattened(&grove(Material::new("glass", glass)), "glass");
    let metal = Finish::Conductor {
        eta: Vec3::splat(0.2),
        k: Vec3::splat(3.0),
        alpha: Vec2::splat(0.2),
    };
    assert_looks_flattened(&grove(Material::new("metal", metal)), "metal");
}

/// A lamp in a room, and three balls on stools.
const STOOLS: &str = r#"
    Scale -1 1 1 LookAt 0 1 4  0 1 0  0 1 0
    Camera "perspective" "float fov" 50
    WorldBegin
    AttributeBegin
        AreaLightSource "diffuse" "rgb L" [ 9 8 7 ] Translate 0 3 0 Rotate 90 1 0 0
        Shape "disk" "float radius" 1
    AttributeEnd
    Shape "trianglemesh" "point3 P" [ -9 0 9  9 0 9  9 0 -9  -9 0 -9 ] "integer indices" [ 0 1 2 0 2 3 ]
    ObjectBegin "stool"
        Material "diffuse" "rgb reflectance" [ 0.5 0.3 0.1 ]
        Rotate 90 1 0 0 Shape "cylinder" "float zmin" -1 "float zmax" 0 "float radius" 0.3
        Material "dielectric" Translate 0 0 -1.5 ReverseOrientation Shape "sphere" "float radius" 0.4
    ObjectEnd
    ObjectInstance "stool"
    AttributeBegin Translate -1.2 0 0.3 Scale 1 0.5 -0.7 ObjectInstance "stool" AttributeEnd
    Translate 1.2 0 0.3 Rotate 40 0 0.6 0.8 ObjectInstance "stool""#;

#[test]
fn objects_of_pbrt_files_look_flattened() {
    let scene = parse_scene(Path::new("a.pbrt"), STOOLS.as_bytes(), Files::NONE);
    let scene = scene.expect("a scene");
    let world = world(&scene);
    assert_eq!(
        (world.prototype_count(), world.placement_count()),
        (1, 3),
        "stools"
    );
    assert_looks_flattened(&scene, "pbrt");
}

#[test]
fn nodes_of_gltf_files_look_flattened() {
    let folder =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../light-scene/testdata/three_formats");
    let path = folder.join("room.gltf");
    let text = std::fs::read_to_string(&path).expect("it ships");
    let mut document: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let primitive = |positions: u32, material: u32| json!({"attributes": {"POSITION": positions, "TEXCOORD_0": 0}, "indices": 1, "material": material});
    // Matt and metal, and what shines.
    let primitives = [(2, 0), (5, 3), (4, 2)].map(|(p, m)| primitive(p, m));
    let lists = |document: &mut serde_json::Value, list: &str, more: serde_json::Value| {
        document[list].as_array_mut().expect("a list").push(more);
    };
    lists(&mut document, "meshes", json!({"primitives": primitives}));
    let places = [
        json!({"mesh": 4, "translation": [0.4, 0.5, 0.0], "scale": [0.2, 0.3, 0.2]}),
        json!({"mesh": 4, "translation": [-0.6, 1.0, 0.5], "scale": [-0.2, 0.1, 0.3], "rotation": [0.0, 0.6, 0.0, 0.8]}),
        json!({"mesh": 4, "translation": [0.7, 1.4, 0.5], "scale": [0.2, 0.2, 0.2], "rotation": [0.36, 0.48, 0.0, 0.8]}),
    ];
    for (number, node) in (5..).zip(places) {
        lists(&mut document, "nodes", node);
        lists(&mut document["scenes"][0], "nodes", json!(number));
    }
    let text = document.to_string();
    let scene = parse_scene(&path, text.as_bytes(), Files::DISK).expect("a scene");
    let world = world(&scene);
    assert_eq!(
        (world.prototype_count(), world.placement_count()),
        (1, 3),
        "placed"
    );
    assert_eq!(
        world.stored_triangle_count(),
        8 + 3 * 2 + 4,
        "the shining part is copied"
    );
    assert_looks_flattened(&scene, "glTF");
}

#[test]
fn textures_and_holes_are_placed_with_their_meshes() {
    let mut scene = grove(green());
    let texels = (0..64).map(|i| Vec3::splat(if i % 3 == 0 { 0.1 } else { 0.9 }));
    let image = Image::new(8, 8, texels.collect()).expect("an image");
    let color = Color::Image(ColorImage::new(scene.add_image(image)));
    let leaves = scene.materials.iter_mut().find(|m| m.name == "leaves");
    let leaves = leaves.expect("the crown's");
    leaves.surface = Finish::Diffuse { reflectance: color };
    assert_looks_flattened(&scene, "textured");
    let leaves = scene.materials.iter_mut().find(|m| m.name == "leaves");
    leaves.expect("the crown's").alpha = Some(Alpha {
        share: color,
        cutoff: Some(0.5),
    });
    assert_looks_flattened(&scene, "with holes");
    assert!(scene.materials.iter().any(|m| m.alpha.is_some()), "holes");
}

#[test]
fn media_are_bounded_by_placements() {
    let smoke = Homogeneous {
        substance: Substance::new(Vec3::splat(1.0), Vec3::new(4.0, 8.0, 12.0), Vec3::ZERO)
            .expect("valid"),
        phase: lights::media::Phase::Isotropic(Isotropic),
        region: Region::UNBOUNDED,
    };
    for (what, surface) in [
        ("smoke", Finish::Interface),
        (
            "smoke in glass",
            Finish::Dielectric {
                eta: 1.5,
                alpha: Vec2::ZERO,
            },
        ),
    ] {
        let mut scene = grove(Material::new("leaves", surface));
        let inside = Some(scene.add_medium("smoke", smoke.clone()));
        let leaves = scene.materials.last_mut().expect("the crown's");
        leaves.media = MediumInterface {
            inside,
            outside: None,
        };
        assert_looks_flattened(&scene, what);
    }
}

#[test]
fn what_shines_is_copied_and_the_rest_is_stored_once() {
    let tree = grove(green());
    let own = tree
        .prototype(tree.placements[0].prototype)
        .triangle_count();
    let room: usize = tree.meshes.iter().map(|mesh| mesh.indices.len()).sum();
    let dark = world(&tree);
    assert_eq!(dark.stored_triangle_count(), room + own, "stored once");
    assert_eq!(dark.triangle_count(), room + 4 * own, "seen four times");
    assert_eq!(
        (dark.prototype_count(), dark.placement_count()),
        (1, 4),
        "counted"
    );

    let shining = grove(Material {
        emission: Some(Emission::one_sided(Vec3::ONE)),
        ..green()
    });
    let (placed, flat) = (world(&shining), world(&flattened(&shining)));
    assert_eq!(placed.lights().len(), flat.lights().len(), "all its lights");
    let crown = own - 12;
    assert_eq!(
        placed.stored_triangle_count(),
        room + 12 + 4 * crown,
        "copies"
    );
    let means = [&shining, &flattened(&shining)].map(|scene| Shot::default().mean(scene));
    assert!(agree(means[0], means[1]), "{means:?}");
}

#[test]
fn a_forest_takes_the_memory_of_a_tree() {
    let mut scene = grove(green());
    let stored = world(&scene).stored_triangle_count();
    let prototype = scene.placements[0].prototype;
    scene.placements.extend((0..10_000u16).map(|i| {
        let at = Vec3::new(f32::from(i % 100), 0.0, f32::from(i / 100));
        let place = Affine3A::from_translation(at) * Affine3A::from_scale(Vec3::splat(0.3));
        Placement { prototype, place }
    }));
    let forest = world(&scene);
    assert_eq!(forest.stored_triangle_count(), stored, "none more");
    assert_eq!(forest.placement_count(), 10_004, "all are there");
    let count = forest.triangle_count();
    assert!(count > 2_000_000, "{count} triangles to be seen");
    let last = forest.primitive(count - 1).expect("there");
    assert!(last.placement().is_some(), "the last one is placed");
    assert_eq!(forest.primitive(count), None, "no more");
}

/// Copies in exactly the same place are stored once, so that a ray does not visit all of them, unless each hides a share of
/// what is behind: a long row of them and one place elsewhere.
#[test]
fn copies_in_the_same_place_are_one() {
    let count = |crown: Material, copies: usize| {
        let mut scene = grove(crown);
        let first = scene.placements[0];
        let others = scene.placements.len();
        scene.placements.extend(vec![first; copies]);
        let world = World::new(scene).expect("a world");
        (world.placement_count(), others)
    };
    let (found, others) = count(green(), 20_000);
    assert_eq!(found, others, "those that were there");
    let half = Some(Alpha {
        share: Color::Constant(Vec3::splat(0.5)),
        cutoff: None,
    });
    let lace = || Material {
        alpha: half,
        ..green()
    };
    let (found, others) = count(lace(), 10);
    assert_eq!(found, others + 10, "each of them");
}

#[test]
fn no_ray_meets_the_plane_that_it_starts_on() {
    let mut scene = Scene::default();
    let matt = scene.add_material(Material::diffuse("matt", Vec3::ONE));
    let mut floor = Mesh::new("floor", matt);
    for (x, z) in (0..20u8).flat_map(|x| (0..20u8).map(move |z| (f32::from(x), f32::from(z)))) {
        let corners = room()[0].map(|p| (p + Vec3::new(x, 0.0, z)) * 0.1 + Vec3::splat(0.37));
        floor.push_quad(corners);
    }
    let prototype = scene.add_prototype(Prototype::new("floor", vec![floor]));
    let turn = Quat::from_axis_angle(Vec3::new(2.0, -1.0, 2.0) / 3.0, 0.7);
    for (scale, at) in [
        (Vec3::ONE, Vec3::ZERO),
        (Vec3::new(3.0, 0.01, 0.2), Vec3::new(100.0, -30.0, 7.0)),
        (Vec3::new(-0.02, 5.0, 0.1), Vec3::new(-2000.0, 900.0, 1.0)),
        (Vec3::splat(1e5), Vec3::splat(1e3)),
        (Vec3::splat(1e-3), Vec3::splat(10.0)),
    ] {
        let place = Affine3A::from_scale_rotation_translation(scale, turn, at)
            * Affine3A::from_quat(turn.inverse());
        scene.placements.push(Placement { prototype, place });
    }
    let world = world(&scene);
    let places = world.placement_count();
    assert_eq!(places, 5, "none is copied");
    for n in 0..world.triangle_count() {
        let triangle = world.primitive(n).expect("there");
        let surface = world.surface(triangle, Vec2::new(0.3, 0.4));
        for k in 0..32u8 {
            let turn = f32::from(k) * 2.4;
            let along = surface.n.any_orthonormal_vector();
            let along = Quat::from_axis_angle(surface.n, turn) * along;
            for side in [surface.n, -surface.n] {
                let wi = (along + side * 0.01 * f32::from(k)).normalize();
                let met = world.closest(&surface.spawn(wi), Some(surface.primitive));
                let met = met.filter(|met| met.primitive.placement() == triangle.placement());
                assert_eq!(met, None, "from {triangle:?} along {wi}");
            }
        }
    }
}

#[test]
fn impossible_objects_are_refused() {
    let mut scene = grove(green());
    scene.placements[1].place = Affine3A::from_scale(Vec3::new(1.0, 0.0, 1.0));
    let error = World::new(scene).err().map(|error| error.to_string());
    let flat = "object tree: expected places that do not make it flat";
    assert_eq!(error.as_deref(), Some(flat), "flat");

    let mut scene = grove(Material {
        emission: Some(Emission::one_sided(Vec3::ONE)),
        ..green()
    });
    let placement = scene.placements[0];
    scene.placements.resize(200_000, placement);
    let error = World::new(scene).err();
    assert_eq!(
        error,
        Some(WorldError::Copies {
            name: "tree".into(),
            most: 1 << 25
        }),
        "224 triangles 200,000 times"
    );
}
