use light_scene::glam::{Affine3A, DVec3, Vec3};
use light_scene::{BackFaces, Color, Instance, Material, Mesh, Prototype, Scene, Surface};

use crate::gltf_materials::scenes::{add_sky, direct, plane_of};
use crate::support::{Shot, agree};

/// A matt plane under a sky, and at the height `y` a plate of which the front looks up or down.
fn under_plate(y: f32, looks_up: bool, back_faces: BackFaces) -> Scene {
    let reflectance = Color::Constant(Vec3::ONE);
    let eye = Vec3::new(0.0, 0.1, 0.4);
    let mut scene = plane_of(Surface::Diffuse { reflectance }, eye);
    let plate = scene.add_material(Material {
        back_faces,
        ..Material::diffuse("plate", Vec3::ZERO)
    });
    let corners = scene.meshes[0].positions.clone();
    let [a, b, c, d] = [0, 1, 2, 3].map(|i| corners[i] * 4.0 + Vec3::Y * y);
    let corners = if looks_up { [a, b, c, d] } else { [d, c, b, a] };
    scene.meshes.push(Mesh::quad("plate", plate, corners));
    add_sky(&mut scene);
    scene
}

#[test]
fn rays_pass_back_faces_that_are_culled_and_no_others() {
    let [culled, visible] = [BackFaces::Culled, BackFaces::Visible];
    let open = direct(&under_plate(-1.0, true, visible));
    assert!(
        agree(open, (DVec3::ONE, DVec3::ZERO)),
        "no plate above: {open:?}"
    );
    let mean = |looks_up, back_faces| direct(&under_plate(1.0, looks_up, back_faces)).0.x;
    assert!(
        mean(true, visible) < 0.5,
        "the back of the plate hides the sky"
    );
    assert!(mean(false, visible) < 0.5, "so does the front");
    assert!(
        mean(false, culled) < 0.5,
        "which is there even if backs are not"
    );
    let seen_through = direct(&under_plate(1.0, true, culled));
    assert!(agree(seen_through, open), "{seen_through:?}");
}

#[test]
fn all_estimators_agree_below_a_plate_without_a_back() {
    let mut scene = under_plate(0.5, true, BackFaces::Culled);
    scene.meshes[1]
        .positions
        .iter_mut()
        .for_each(|p| p.x += 4.2);
    let shot = Shot {
        size: 8,
        spp: 32,
        max_depth: 3,
        ..Shot::default()
    };
    shot.assert_estimators_agree(&scene, 64);
}

/// The camera sees through a culled back face, also of mirrored and instanced meshes.
#[test]
fn the_front_of_an_instance_is_where_it_is_moved() {
    for mirrors in [false, true] {
        for looks_up in [false, true] {
            let mut scene = under_plate(0.05, looks_up, BackFaces::Culled);
            let plate = scene.meshes.remove(1);
            let mut lower = plate.clone();
            lower.positions.iter_mut().for_each(|p| p.y -= 20.0);
            let prototype = scene.add_prototype(Prototype::new("plates", vec![plate, lower]));
            for x in [0.0, 100.0] {
                let scale = Vec3::new(if mirrors { -1.0 } else { 1.0 }, 1.0, 1.0);
                let transform =
                    Affine3A::from_translation(Vec3::X * x) * Affine3A::from_scale(scale);
                scene.instances.push(Instance {
                    prototype,
                    transform,
                });
            }
            // The eye is above the plate, which is black.
            let (mean, _) = direct(&scene);
            assert_eq!(mean.x == 0.0, looks_up, "{mirrors}, {looks_up}: {mean}");
        }
    }
}
