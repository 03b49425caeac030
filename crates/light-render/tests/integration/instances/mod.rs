//! Instances of an object look as copies of it do, and the object is stored once.

mod hits;
mod lamps;
mod pictures;
mod placed_tree;
mod storage;

use light_render::World;
use light_scene::glam::{Affine3A, Vec2, Vec3};
use light_scene::{Instance, Material, MaterialId, Mesh, Prototype, Scene};

use crate::support::{cornell, room};

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

/// Rotated, mirrored, scaled and skewed transforms into the box `[0, 1]^3`.
fn transforms() -> Vec<Affine3A> {
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

/// The room with a tree of matt wood, in [`transforms`], its crown of `crown`.
fn grove(crown: Material) -> Scene {
    let mut scene = cornell();
    let wood = scene.add_material(Material::diffuse("wood", Vec3::new(0.5, 0.4, 0.2)));
    let crown = scene.add_material(crown);
    let tree = Prototype::new("tree", vec![block(wood), ball(crown, 16)]);
    let prototype = scene.add_prototype(tree);
    let instanced = transforms().into_iter().map(|transform| Instance {
        prototype,
        transform,
    });
    scene.instances.extend(instanced);
    scene
}

fn green() -> Material {
    Material::diffuse("leaves", Vec3::new(0.2, 0.6, 0.1))
}

/// The same scene with copies instead of instances.
fn flattened(scene: &Scene) -> Scene {
    let mut flat = scene.clone();
    flat.prototypes.clear();
    for Instance {
        prototype,
        transform,
    } in core::mem::take(&mut flat.instances)
    {
        let Prototype {
            meshes, quadrics, ..
        } = scene.prototype(prototype);
        flat.meshes
            .extend(meshes.iter().map(|mesh| mesh.transformed(&transform)));
        for sphere in quadrics {
            match sphere.transformed(&transform) {
                Some(sphere) => flat.quadrics.push(sphere),
                None => flat.meshes.push(sphere.mesh(512).transformed(&transform)),
            }
        }
    }
    flat
}

fn world(scene: &Scene) -> World {
    World::new(scene.clone()).expect("a good scene")
}
