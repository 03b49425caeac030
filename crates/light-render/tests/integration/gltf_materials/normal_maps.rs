use core::f64::consts::PI;

use light_scene::glam::{Affine3A, Vec2, Vec3, Vec4};
use light_scene::{Color, ColorImage, Instance, Prototype, Scene, Surface};

use crate::gltf_materials::scenes::{
    add_sky, add_sun, assert_near, dielectric, direct, plane_of, row,
};
use crate::support::ALL;

/// The normal in tangent space: leaning by 30 degrees, most of it toward u.
fn leaning() -> Vec3 {
    Vec3::new(0.4, 0.3, 0.75f32.sqrt())
}

/// A white matt plane whose normals all lean, below a sun at this direction.
fn under_sun(direction: Vec3) -> Scene {
    let reflectance = Color::Constant(Vec3::ONE);
    let mut scene = plane_of(Surface::Diffuse { reflectance }, Vec3::Y);
    let image = scene.add_image(row(&[0.5 * leaning() + 0.5]));
    scene.materials[0].normal_map = Some(ColorImage::new(image));
    add_sun(&mut scene, direction);
    scene
}

/// The radiance where the normal of the plane is `ns`.
fn expected(ns: Vec3, direction: Vec3) -> f64 {
    f64::from(ns.dot(direction)) / PI
}

const SUN: Vec3 = Vec3::new(0.48, 0.8, 0.36);

#[test]
fn the_irradiance_is_that_of_the_leaning_normal() {
    let l = leaning();
    // u runs along +x, v along -z.
    let ns = Vec3::new(l.x, l.z, -l.y);
    assert_near(direct(&under_sun(SUN)), expected(ns, SUN), "as it is");

    let mut mirrored = under_sun(SUN);
    for uv in mirrored.meshes[0].uvs.iter_mut().flatten() {
        uv.x = -uv.x;
    }
    let ns = Vec3::new(-l.x, l.z, -l.y);
    assert_near(direct(&mirrored), expected(ns, SUN), "u runs backwards");

    let mut turned = under_sun(SUN);
    for uv in turned.meshes[0].uvs.iter_mut().flatten() {
        *uv = Vec2::new(-uv.y, uv.x);
    }
    // u runs along +z, v along +x.
    let ns = Vec3::new(l.y, l.z, l.x);
    assert_near(direct(&turned), expected(ns, SUN), "turned");

    let mut weak = under_sun(SUN);
    let map = weak.materials[0].normal_map.as_mut().expect("a map");
    map.scale = Vec3::new(0.5, 0.5, 1.0);
    let ns = Vec3::new(0.5 * l.x, l.z, -0.5 * l.y).normalize();
    assert_near(direct(&weak), expected(ns, SUN), "half as strong");
}

#[test]
fn tangents_of_the_file_come_before_those_of_the_coordinates() {
    let l = leaning();
    for side in [1.0, -1.0] {
        let mut scene = under_sun(SUN);
        scene.meshes[0].tangents = Some(vec![Vec4::new(0.0, 0.1, 2.0, side); 4]);
        // The bitangent is the cross product of +y and +z.
        let ns = Vec3::new(side * l.y, l.z, l.x);
        assert_near(direct(&scene), expected(ns, SUN), &format!("side {side}"));
    }
}

/// A mesh that is moved, an instance and a mirrored one turn their tangents with them.
#[test]
fn transforms_turn_tangents() {
    let l = leaning();
    for has_tangents in [false, true] {
        for mirrors in [false, true] {
            let x = if mirrors { -1.0 } else { 1.0 };
            let transform = Affine3A::from_scale(Vec3::new(2.0 * x, 1.0, 3.0));
            let ns = Vec3::new(x * l.x, l.z, -l.y);
            let mut scene = under_sun(SUN);
            if has_tangents {
                scene.meshes[0].tangents = Some(vec![Vec4::new(1.0, 0.0, 0.0, 1.0); 4]);
            }
            let mut moved = scene.clone();
            moved.meshes[0] = scene.meshes[0].transformed(&transform);
            let what = format!("tangents {has_tangents}, mirrors {mirrors}");
            assert_near(direct(&moved), expected(ns, SUN), &what);
            // Small objects are copied: more triangles, twice.
            let mesh = scene.meshes.remove(0);
            let mut below = mesh.clone();
            for p in &mut below.positions {
                p.y -= 1.0;
            }
            let prototype = scene.add_prototype(Prototype::new("planes", vec![mesh, below]));
            for y in [0.0, -5.0] {
                let transform = Affine3A::from_translation(Vec3::Y * y) * transform;
                scene.instances.push(Instance {
                    prototype,
                    transform,
                });
            }
            assert_near(
                direct(&scene),
                expected(ns, SUN),
                &format!("{what}, instance"),
            );
        }
    }
}

/// At grazing angles the mirrored directions of leaning normals would end below the surface: no
/// pixel is black, and all ways to find light agree.
#[test]
fn grazing_views_have_no_black_fringes() {
    for lean in [Vec3::new(-0.7, 0.0, 0.714), Vec3::new(0.7, 0.0, 0.714)] {
        for roughness in [0.0, 0.5] {
            let surface = dielectric(Vec3::splat(0.8), roughness);
            let surface = Surface::MetallicRoughness(Box::new(surface));
            let mut scene = plane_of(surface, Vec3::new(1.0, 0.1, 0.0));
            let image = scene.add_image(row(&[0.5 * lean.normalize() + 0.5]));
            scene.materials[0].normal_map = Some(ColorImage::new(image));
            add_sky(&mut scene);
            let (mean, _) = direct(&scene);
            let what = format!("{lean}, {roughness}");
            assert!(mean.x > 0.4 && mean.x < 1.01, "{what}: {mean}");
            for estimator in ALL {
                let shot = crate::support::Shot {
                    size: 8,
                    spp: 64,
                    max_depth: 2,
                    estimator,
                    ..Default::default()
                };
                let found = shot.mean(&scene);
                let off = (found.0.x - mean.x).abs();
                assert!(
                    off < 0.01 + 5.0 * found.1.x,
                    "{what}, {estimator:?}: {found:?}"
                );
            }
        }
    }
}
