use light_scene::glam::{Vec2, Vec3};
use light_scene::{
    Clearcoat, Color, ColorImage, Emission, EmissionSides, Image, Material, MetallicRoughness,
    Surface, UvSet,
};

use crate::gltf_materials::scenes::{
    add_sky, add_sun, assert_near, dielectric, direct, plane_of, row,
};
use crate::support::{Shot, assert_threads_change_nothing, cornell};

fn of(surface: MetallicRoughness) -> Surface {
    Surface::MetallicRoughness(Box::new(surface))
}

#[test]
fn a_white_dielectric_in_a_furnace_is_white_and_nothing_is_brighter() {
    for roughness in [0.0, 0.3, 1.0] {
        for eye in [Vec3::Y, Vec3::new(0.0, 0.4, 1.0)] {
            let mut scene = plane_of(of(dielectric(Vec3::ONE, roughness)), eye);
            add_sky(&mut scene);
            let mean = direct(&scene);
            let what = format!("roughness {roughness} from {eye}");
            assert!((mean.0.x - 1.0).abs() < 0.01, "{what}: {mean:?}");
            let Surface::MetallicRoughness(surface) = &mut scene.materials[0].surface else {
                panic!("the surface of the plane");
            };
            surface.roughness_metallic = Color::Constant(Vec3::new(0.0, roughness, 0.5));
            surface.clearcoat = Some(Clearcoat {
                weight: Color::Constant(Vec3::ONE),
                roughness: Color::Constant(Vec3::splat(0.2)),
            });
            let (mean, error) = direct(&scene);
            assert!(mean.x < 1.005 + 4.5 * error.x, "{what}, coated: {mean}");
        }
    }
}

/// On the left a mirror, on the right matt paint, by the texels of one image: the mirror shows the
/// sky, and the paint the sun as well.
#[test]
fn one_side_mirrors_and_the_other_is_matt() {
    let mirror = Vec3::new(0.0, 0.0, 1.0);
    let matt = Vec3::new(0.0, 1.0, 0.0);
    let color = 0.6;
    let cos = 0.8;
    let matt_sun = f64::from(color) * cos / core::f64::consts::PI;
    for (at, extra) in [(-0.5, 0.0), (0.5, matt_sun)] {
        let surface = MetallicRoughness {
            f0: Vec3::ZERO,
            f90: 0.0,
            ..dielectric(Vec3::splat(color), 1.0)
        };
        let mut scene = plane_of(of(surface), Vec3::Y);
        let image = scene.add_image(row(&[mirror, mirror, matt, matt]));
        let Surface::MetallicRoughness(surface) = &mut scene.materials[0].surface else {
            panic!("the surface of the plane");
        };
        surface.roughness_metallic = Color::Image(ColorImage::new(image));
        let place = Vec3::new(at, 0.0, 0.0);
        scene.camera = light_scene::Camera::look_at(place + Vec3::Y, place, Vec3::Z, 1e-3).ok();
        add_sky(&mut scene);
        add_sun(&mut scene, Vec3::new(0.0, 0.8, 0.6));
        let expected = f64::from(color) + extra;
        assert_near(direct(&scene), expected, &format!("at {at}"));
    }
}

#[test]
fn half_a_metal_scatters_half_of_what_the_base_does() {
    let albedo = |metallic| {
        let mut scene = plane_of(
            of(MetallicRoughness {
                roughness_metallic: Color::Constant(Vec3::new(0.0, 0.0, metallic)),
                ..dielectric(Vec3::splat(0.5), 0.0)
            }),
            Vec3::Y,
        );
        add_sky(&mut scene);
        direct(&scene)
    };
    // The base below the dielectric, and the metal.
    let [none, all] = [0.04 + 0.96 * 0.5, 0.5];
    assert_near(albedo(0.0), none, "no metal");
    assert_near(albedo(1.0), all, "a metal");
    assert_near(albedo(0.5), f64::midpoint(none, all), "half");
}

#[test]
fn colors_of_vertices_multiply_and_second_coordinates_find_their_image() {
    let mut scene = plane_of(
        Surface::Diffuse {
            reflectance: Color::Constant(Vec3::splat(0.8)),
        },
        Vec3::Y,
    );
    add_sky(&mut scene);
    scene.meshes[0].colors = Some(vec![Vec3::splat(0.25); 4]);
    assert_near(direct(&scene), 0.2, "a quarter");
    let image = scene.add_image(row(&[Vec3::splat(0.4), Vec3::splat(0.8)]));
    scene.materials[0].surface = Surface::Diffuse {
        reflectance: Color::Image(ColorImage {
            uv_set: UvSet::Second,
            ..ColorImage::new(image)
        }),
    };
    scene.meshes[0].second_uvs = Some(vec![Vec2::new(0.75, 0.5); 4]);
    assert_near(direct(&scene), 0.2, "the second texel, by a quarter");
}

/// A room of worn metal below a coat, with a normal map and coloured vertices.
#[test]
fn light_samples_material_samples_and_both_agree() {
    let mut scene = cornell();
    let mut dice = 7u32;
    let mut next = || {
        dice = dice.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
        (dice >> 8) as f32 / 16_777_216.0
    };
    let texels = (0..64).map(|_| Vec3::new(0.0, 0.3 + 0.7 * next(), next()));
    let worn = Image::new(8, 8, texels.collect()).expect("an image");
    let worn = scene.add_image(worn);
    let texels = (0..64).map(|_| {
        let n = Vec3::new(next() - 0.5, next() - 0.5, 0.6).normalize();
        0.5 * n + 0.5
    });
    let bumps = Image::new(8, 8, texels.collect()).expect("an image");
    let bumps = scene.add_image(bumps);
    let surface = MetallicRoughness {
        roughness_metallic: Color::Image(ColorImage::new(worn)),
        clearcoat: Some(Clearcoat {
            weight: Color::Constant(Vec3::splat(0.7)),
            roughness: Color::Constant(Vec3::splat(0.6)),
        }),
        ..dielectric(Vec3::new(0.8, 0.6, 0.4), 1.0)
    };
    let worn = scene.add_material(Material {
        normal_map: Some(ColorImage::new(bumps)),
        ..Material::new("worn", of(surface))
    });
    for mesh in scene.meshes.iter_mut().filter(|mesh| mesh.name != "lamp") {
        mesh.material = worn;
        mesh.colors = Some(vec![Vec3::new(1.0, 0.9, 0.7); mesh.positions.len()]);
    }
    Shot::default().assert_estimators_agree(&scene, 64);
    assert_threads_change_nothing(&scene);
}

#[test]
fn emission_keeps_the_first_coordinates_and_the_base_has_the_second() {
    let mut scene = plane_of(
        Surface::Diffuse {
            reflectance: Color::Constant(Vec3::ZERO),
        },
        Vec3::Y,
    );
    let image = scene.add_image(row(&[Vec3::splat(0.25), Vec3::splat(0.75)]));
    scene.meshes[0].uvs = Some(vec![Vec2::new(0.25, 0.5); 4]);
    scene.meshes[0].second_uvs = Some(vec![Vec2::new(0.75, 0.5); 4]);
    scene.materials[0].emission = Some(Emission {
        radiance: Color::Image(ColorImage::new(image)),
        sides: EmissionSides::Front,
    });
    let reflectance = Color::Image(ColorImage {
        uv_set: UvSet::Second,
        ..ColorImage::new(image)
    });
    scene.materials[0].surface = Surface::Diffuse { reflectance };
    add_sky(&mut scene);
    assert_near(direct(&scene), 0.25 + 0.75, "emitted and reflected");
}
