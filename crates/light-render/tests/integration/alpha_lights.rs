//! Lamps with an alpha mask: light samples, material samples and both together agree with a closed
//! form.

use core::f64::consts::PI;

use light_render::integrator::Estimator;
use light_scene::glam::{Affine2, Affine3A, DVec3, Vec2, Vec3};
use light_scene::{
    Alpha, Color, ColorImage, Emission, EmissionSides, Image, Material, Mesh, Quadric,
    QuadricFront, Scene,
};
use lights::sources::{TextureMapping, Wrap};

use crate::support::{Shot, plane, room};

const ALBEDO: f32 = 0.5;
const HEIGHT: f32 = 3.0;

/// The means by all three estimators agree with each other and with `expected` within three
/// standard errors.
fn assert_means(what: &str, scene: &Scene, expected: f64) {
    let all = [
        (Estimator::Mis, 16),
        (Estimator::Light, 16),
        (Estimator::Bsdf, 256),
    ];
    let means = all.map(|(estimator, spp)| {
        let shot = Shot {
            estimator,
            spp,
            max_depth: 2,
            ..Shot::default()
        };
        (estimator, shot.mean(scene))
    });
    for (estimator, (mean, error)) in means {
        let off = (mean - DVec3::splat(expected)).abs();
        let margin = error * 3.0 + 1e-4 * expected;
        assert!(
            off.cmple(margin).all(),
            "{what}, {estimator:?}: {mean} for {expected}, error {error}"
        );
    }
}

fn constant(share: f32) -> Alpha {
    Alpha {
        opacity: Color::Constant(Vec3::splat(share)),
        cutoff: None,
    }
}

/// A square lamp with sides of twice the height, over a matt floor that looks up to it.
fn under_square(emission: Emission, alpha: Option<Alpha>, scene: Scene) -> Scene {
    let mut scene = scene;
    let lamp = scene.add_material(Material {
        emission: Some(emission),
        alpha,
        ..Material::diffuse("lamp", Vec3::ZERO)
    });
    let corners =
        room()[1].map(|p| (p - Vec3::new(0.5, 1.0, 0.5)) * 2.0 * HEIGHT + HEIGHT * Vec3::Y);
    let mut mesh = Mesh::quad("lamp", lamp, corners);
    let uvs = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
    mesh.uvs = Some(uvs.map(|(u, v)| Vec2::new(u, v)).to_vec());
    scene.meshes.push(mesh);
    scene
}

/// What the floor's middle shows under the square, for a radiance of 1: the form factor of four
/// squares with a corner over it, their sides as long as they are high.
fn square() -> f64 {
    let corner = 2.0 / 2f64.sqrt() * (1.0 / 2f64.sqrt()).atan() / (2.0 * PI);
    f64::from(ALBEDO) * 4.0 * corner
}

fn floor() -> Scene {
    plane(ALBEDO, 1.0)
}

#[test]
fn a_share_of_a_square() {
    let one = Emission::one_sided(Vec3::splat(2.0));
    for share in [0.5, 0.1, 1.0] {
        let scene = under_square(one, Some(constant(share)), floor());
        assert_means(
            &format!("{share}"),
            &scene,
            f64::from(2.0 * share) * square(),
        );
    }
}

#[test]
fn a_cutoff_leaves_all_of_a_square_or_nothing() {
    let one = Emission::one_sided(Vec3::ONE);
    for (share, left) in [(0.6, 1.0), (0.4, 0.0)] {
        let alpha = Alpha {
            cutoff: Some(0.5),
            ..constant(share)
        };
        let scene = under_square(one, Some(alpha), floor());
        assert_means(&format!("{share}"), &scene, left * square());
    }
}

/// Images of one value, which have a closed form, alone and under an image of emission, with one
/// mapping or two, with a factor and with a cutoff.
#[test]
fn alpha_images_of_one_value() {
    let turned = TextureMapping {
        transform: Affine2::from_angle(0.3),
        wrap: [Wrap::Mirror; 2],
    };
    let image = |scene: &mut Scene, value: f32, scale: f32, mapping| {
        let image = Image::new(2, 2, vec![Vec3::splat(value); 4]).expect("an image");
        Color::Image(ColorImage {
            scale: Vec3::splat(scale),
            mapping,
            ..ColorImage::new(scene.add_image(image))
        })
    };
    for (value, scale, cutoff, left) in [
        (0.5, 1.0, None, 0.5),
        (0.8, 0.5, None, 0.4),
        (1.5, 0.5, None, 0.75),
        (2.0, 1.0, None, 1.0),
        (0.7, 1.0, Some(0.5), 1.0),
        (0.3, 1.0, Some(0.5), 0.0),
    ] {
        for (has_image, mapping) in [
            (false, TextureMapping::REPEAT),
            (true, TextureMapping::REPEAT),
            (true, turned),
        ] {
            let mut scene = floor();
            let share = image(&mut scene, value, scale, mapping);
            let radiance = if has_image {
                image(&mut scene, 3.0, 0.5, TextureMapping::REPEAT)
            } else {
                Color::Constant(Vec3::splat(1.5))
            };
            let emission = Emission {
                radiance,
                sides: EmissionSides::Front,
            };
            let scene = under_square(
                emission,
                Some(Alpha {
                    opacity: share,
                    cutoff,
                }),
                scene,
            );
            let what = format!("{value}, {scale}, {cutoff:?}, {has_image}, {mapping:?}");
            assert_means(&what, &scene, 1.5 * left * square());
        }
    }
}

/// A mask that is half opaque over a lamp whose left third emits light: all three estimators agree,
/// however both are placed.
#[test]
fn alpha_images_over_images_of_emission() {
    for (cutoff, turn) in [(None, 0.0), (None, 0.4), (Some(0.5), 0.0), (Some(0.5), 0.4)] {
        let mut scene = floor();
        let stripes = (0..16u8).map(|i| Vec3::splat(f32::from(i * 7 % 16) / 15.0));
        let stripes = Image::new(4, 4, stripes.collect()).expect("an image");
        let share = Color::Image(ColorImage {
            mapping: TextureMapping {
                transform: Affine2::from_angle(turn),
                wrap: [Wrap::Repeat; 2],
            },
            ..ColorImage::new(scene.add_image(stripes))
        });
        let third = [Vec3::ONE, Vec3::ZERO, Vec3::ZERO].to_vec();
        let third = Image::new(3, 1, third).expect("an image");
        let third = scene.add_image(third);
        let emission = Emission {
            radiance: Color::Image(ColorImage::new(third)),
            sides: EmissionSides::Front,
        };
        let scene = under_square(
            emission,
            Some(Alpha {
                opacity: share,
                cutoff,
            }),
            scene,
        );
        let shot = |estimator, spp| {
            let shot = Shot {
                estimator,
                spp,
                max_depth: 2,
                ..Shot::default()
            };
            shot.mean(&scene)
        };
        let mis = shot(Estimator::Mis, 16);
        let light = shot(Estimator::Light, 16);
        let bsdf = shot(Estimator::Bsdf, 256);
        assert!(mis.0.x > 0.01, "it emits light: {mis:?}");
        for (name, mean) in [("light", light), ("bsdf", bsdf)] {
            let error = (mean.1 * mean.1 + mis.1 * mis.1).map(f64::sqrt);
            assert!(
                (mean.0 - mis.0).abs().cmple(error * 3.0).all(),
                "{cutoff:?}, {turn}, {name}: {mean:?}, both {mis:?}"
            );
        }
    }
}

/// The lamp itself, seen by the camera, is as bright as its opaque part.
#[test]
fn a_lamp_is_seen_as_a_share() {
    let mut scene = floor();
    let one = Emission::one_sided(Vec3::splat(2.0));
    scene.camera = light_scene::Camera::look_at(Vec3::Y, Vec3::Y * 2.0, Vec3::Z, 0.5).ok();
    let scene = under_square(one, Some(constant(0.25)), scene);
    for estimator in [Estimator::Mis, Estimator::Light, Estimator::Bsdf] {
        let shot = Shot {
            estimator,
            max_depth: 1,
            ..Shot::default()
        };
        let (mean, error) = shot.mean(&scene);
        assert!((mean.x - 0.5).abs() < 3.0 * error.x, "{mean}, {error}");
    }
}

/// Through the mask of the near side of a sphere, the inside of its far side is visible.
#[test]
fn spheres_with_holes() {
    let inside_too = [
        (EmissionSides::Front, QuadricFront::Outside, [1.0, 0.0]),
        (EmissionSides::Front, QuadricFront::Inside, [0.0, 1.0]),
        (EmissionSides::Both, QuadricFront::Outside, [1.0, 1.0]),
    ];
    for (sides, front, [outside, inside]) in inside_too {
        for share in [0.5, 0.9] {
            for has_image in [false, true] {
                let mut scene = floor();
                let alpha = if has_image {
                    let image = Image::new(1, 1, vec![Vec3::splat(share)]).expect("an image");
                    let share = Color::Image(ColorImage::new(scene.add_image(image)));
                    Alpha {
                        opacity: share,
                        cutoff: None,
                    }
                } else {
                    constant(share)
                };
                let lamp = scene.add_material(Material {
                    emission: Some(Emission {
                        radiance: Color::Constant(Vec3::splat(8.0)),
                        sides,
                    }),
                    alpha: Some(alpha),
                    ..Material::diffuse("lamp", Vec3::ZERO)
                });
                scene.quadrics.push(Quadric {
                    front,
                    ..sphere(lamp)
                });
                let a = f64::from(share);
                // A sphere with its centre at the height h over the floor has the form factor (r /
                // h)^2.
                let factor = 8.0 * f64::from(ALBEDO) / 36.0;
                let expected = factor * (a * outside + (1.0 - a) * a * inside);
                let what = format!("{sides:?}, {front:?}, {share}, {has_image}");
                assert_means(&what, &scene, expected);
            }
        }
    }
}

/// Of radius 1/2, with its centre at the [`HEIGHT`].
fn sphere(material: light_scene::MaterialId) -> Quadric {
    let transform =
        Affine3A::from_translation(Vec3::Y * HEIGHT) * Affine3A::from_scale(Vec3::splat(0.5));
    Quadric::sphere("lamp", material, transform)
}
