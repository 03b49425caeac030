//! Lights with a surface in a scene's list of lights: rays find them as they find emissive
//! geometry.

use light_render::World;
use light_scene::glam::{Affine3A, Quat, Vec3};
use light_scene::{Emission, Material, Mesh, Quadric, Scene};
use lights::math::Aabb;
use lights::sources::shape::ShapeDesc;
use lights::sources::*;

use crate::support::{Shot, assert_estimators_agree, assert_threads_change_nothing, cornell};

const RADIANCE: Vec3 = Vec3::new(3.0, 2.0, 1.0);

fn glow() -> DiffuseEmissionDesc<Rgb> {
    DiffuseEmissionDesc::new(SurfaceColor::Uniform(RADIANCE), RadianceAmount::default())
}

/// A bent sheet of four triangles, to which light falls from both sides.
fn sheet() -> (Vec<Vec3>, Vec<[u32; 3]>) {
    let at = |x, y, z| Vec3::new(0.6, 0.2, 0.4) + Vec3::new(x, y, z) * 0.3;
    let rows = [(0.0, 0.0), (0.5, 0.3), (1.0, 0.0)];
    let positions = rows
        .into_iter()
        .flat_map(|(x, z)| [at(x, 0.0, z), at(x, 1.0, z)]);
    (
        positions.collect(),
        vec![[0, 2, 3], [0, 3, 1], [2, 4, 5], [2, 5, 3]],
    )
}

/// `cornell` with a glowing black sheet as geometry of the scene, and in its list of lights.
fn sheets() -> [Scene; 2] {
    let mut plain = cornell();
    let black = plain.add_material(Material {
        emission: Some(Emission::two_sided(RADIANCE)),
        ..Material::diffuse("glow", Vec3::ZERO)
    });
    let (positions, indices) = sheet();
    let mut listed = cornell();
    let emission = DiffuseEmissionDesc {
        sides: Sides::Both,
        ..glow()
    };
    let desc = MeshLightDesc::new(positions.clone(), indices.clone(), emission);
    listed.lights.push(LightDesc::Mesh(desc));
    plain.meshes.push(Mesh {
        indices,
        positions,
        ..Mesh::quad("sheet", black, [Vec3::ZERO; 4])
    });
    [plain, listed]
}

/// `cornell` with a light of every shape in its list, one of them seen from outside of the room.
fn shapes() -> Scene {
    let mut scene = cornell();
    let at = |x, y, z| Affine3A::from_translation(Vec3::new(x, y, z));
    let turned = |x, y, z| at(x, y, z) * Affine3A::from_quat(Quat::from_rotation_x(1.2));
    let corner = Vec3::new(0.6, 0.6, 0.2);
    let shapes = [
        ShapeDesc::Triangle([Vec3::new(0.1, 0.6, 0.1), Vec3::new(0.3, 0.6, 0.1), corner]),
        ShapeDesc::Rectangle {
            corner,
            edges: [Vec3::X * 0.2, Vec3::Y * 0.1],
        },
        ShapeDesc::Quad([
            Vec3::new(0.05, 0.2, 0.3),
            Vec3::new(0.15, 0.2, 0.3),
            Vec3::new(0.05, 0.35, 0.3),
            Vec3::new(0.15, 0.35, 0.35),
        ]),
        ShapeDesc::Sphere {
            transform: at(0.8, 0.12, 0.6),
            radius: 0.1,
        },
        ShapeDesc::Disk {
            transform: turned(0.7, 0.4, 0.4),
            radius: 0.1,
            inner_radius: 0.04,
        },
        ShapeDesc::Cylinder {
            transform: turned(0.15, 0.7, 0.6),
            radius: 0.04,
            length: 0.2,
        },
    ];
    let texels = vec![0.0, 1.0, 0.25, 0.5];
    let texture = || {
        let image = Image::from_f32([2, 2], Channels::Gray, texels.clone());
        Texture::new(image.expect("an image"))
    };
    let mask = AlphaMask {
        texture: texture(),
        scale: 1.0,
        mapping: None,
        cutoff: None,
    };
    for (number, shape) in shapes.into_iter().enumerate() {
        let mut emission = glow();
        match number % 3 {
            0 => emission.sides = Sides::Both,
            1 => {
                let tint = RADIANCE;
                let texture = texture();
                emission.color = SurfaceColor::Image { texture, tint };
            }
            _ => emission.mask = EmissionMask::Alpha(mask.clone()),
        }
        scene
            .lights
            .push(AreaLightDesc::new(shape, emission).into());
    }
    scene
}

#[test]
fn all_ways_to_find_a_listed_light_agree() {
    for scene in [shapes(), sheets()[1].clone()] {
        assert_estimators_agree(&scene);
    }
    assert_threads_change_nothing(&shapes());
}

#[test]
fn a_listed_mesh_makes_the_picture_of_an_emissive_one() {
    let [plain, listed] = sheets();
    let [a, b] = [&plain, &listed].map(|scene| Shot::default().render(scene, 5).film.develop());
    assert!(a == b, "bit for bit");
    let dark = Shot::default().render(&cornell(), 5).film.develop();
    assert!(dark != a, "the sheet is seen");
    assert_eq!(plain.bounds(), listed.bounds(), "the same box");
}

#[test]
fn listed_lights_bound_the_scene_and_keep_their_names() {
    let radius = 0.25;
    let transform = Affine3A::from_translation(Vec3::X);
    let ball = AreaLightDesc::new(ShapeDesc::Sphere { transform, radius }, glow());
    let mut scene = Scene::default();
    scene.lights.push(ball.clone().into());
    let half = Vec3::splat(radius);
    let around = Aabb::new(Vec3::X - half, Vec3::X + half);
    assert_eq!(scene.bounds(), around, "a sphere");
    let (positions, indices) = sheet();
    let mesh = MeshLightDesc::new(positions, indices, glow());
    scene.lights.push(LightDesc::Mesh(mesh));
    let world = World::new(scene).expect("a world");
    let names = |id| {
        let names = world.light_names(lights::bounds::LightId(id));
        names.expect("a light").map(|name| name.to_string())
    };
    assert_eq!(names(0), ["area", "light 0"], "the sphere");
    assert_eq!(names(4), ["triangle", "light 1"], "the last triangle");
}

/// No ray finds what is invisible, and it has no place in the scene.
#[test]
fn invisible_surfaces_stay_unseen() {
    let invisible = DiffuseEmissionDesc {
        mask: EmissionMask::Invisible,
        ..glow()
    };
    let (positions, indices) = sheet();
    let mesh = MeshLightDesc::new(positions, indices, invisible.clone());
    let transform = Affine3A::from_translation(Vec3::new(0.7, 0.5, 0.5));
    let ball = Quadric::sphere("ball", light_scene::MaterialId(0), transform);
    let mut scene = Scene::default();
    scene.lights.push(LightDesc::Mesh(mesh));
    scene
        .lights
        .push(AreaLightDesc::new(ball.shape(), invisible).into());
    assert_eq!(scene.bounds(), Aabb::EMPTY, "no box");
    scene.meshes = cornell().meshes;
    scene.materials = cornell().materials;
    let world = World::new(scene).expect("a world");
    let ray = light_render::Ray {
        origin: Vec3::new(0.9, 0.5, 0.9),
        direction: Vec3::new(-0.2, 0.0, -0.4).normalize(),
    };
    let hit = world.closest(&ray, None).expect("a wall");
    assert!(
        hit.p.x < 0.6 || hit.p.z < 1e-3,
        "a wall, not the ball: {hit:?}"
    );
}

/// A light that is not valid is named, wherever its surface would be.
#[test]
fn invalid_listed_lights_are_named() {
    let far = Vec3::splat(f32::INFINITY);
    let mesh = |positions: Vec<Vec3>, indices: Vec<[u32; 3]>| {
        let mut scene = cornell();
        let mesh = MeshLightDesc::new(positions, indices, glow());
        scene.lights.push(LightDesc::Mesh(mesh));
        let error = World::new(scene).expect_err("refused");
        error.to_string()
    };
    let corners = vec![Vec3::ZERO, Vec3::X, far];
    let found = mesh(corners.clone(), vec![[0, 1, 2]]);
    assert_eq!(
        found,
        "light 0: mesh light, positions: vertex 2 is not finite"
    );
    let found = mesh(corners[..2].to_vec(), vec![[0, 1, 2]]);
    let expected = "light 0: mesh light, indices: triangle 0 names a vertex that is not there";
    assert_eq!(found, expected);
}
