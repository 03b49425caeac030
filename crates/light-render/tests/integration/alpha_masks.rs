//! Surfaces with alpha masks: camera rays and shadow rays pass through, and lights emit only where
//! they are opaque.

use light_render::integrator::Estimator;
use light_scene::glam::{DVec3, Vec2, Vec3};
use light_scene::{Alpha, Color, ColorImage, Image, Material, Mesh, Scene};
use lights::sources::{DistantLightDesc, IrradianceAmount, LightDesc};

use crate::support::{Shot, agree, cornell, plane, room};

/// A plane under the noon sun, and between them a roof with this `alpha`.
fn under_roof(alpha: impl Fn(&mut Scene) -> Option<Alpha>) -> Scene {
    let mut scene = plane(0.5, 1.0);
    let sun = DistantLightDesc {
        direction: Vec3::Y,
        emission: Vec3::ONE,
        amount: IrradianceAmount::default(),
    };
    scene.lights.push(LightDesc::Distant(sun));
    let alpha = alpha(&mut scene);
    let roof = scene.add_material(Material {
        alpha,
        ..Material::diffuse("roof", Vec3::ZERO)
    });
    let corners = room()[0].map(|p| (p - Vec3::new(0.5, 0.0, 0.5)) * 4.0 + 3.0 * Vec3::Y);
    let mut mesh = Mesh::quad("roof", roof, corners);
    let uvs = [(0.0, 0.0), (0.0, 1.0), (1.0, 1.0), (1.0, 0.0)];
    mesh.uvs = Some(uvs.map(|(u, v)| Vec2::new(u, v)).to_vec());
    scene.meshes.push(mesh);
    scene
}

fn share(share: f32, cutoff: Option<f32>) -> Scene {
    under_roof(|_| {
        Some(Alpha {
            opacity: Color::Constant(Vec3::splat(share)),
            cutoff,
        })
    })
}

fn mean(scene: &Scene) -> (DVec3, DVec3) {
    let shot = Shot {
        max_depth: 2,
        ..Shot::default()
    };
    shot.mean(scene)
}

#[test]
fn a_share_of_the_light_passes() {
    let open = mean(&share(0.0, None));
    assert!(open.0.x > 0.0, "a hole lets all light through");
    assert_eq!(mean(&under_roof(|_| None)).0, DVec3::ZERO, "a roof none");
    assert_eq!(
        mean(&share(1.0, None)).0,
        DVec3::ZERO,
        "nor does a whole one"
    );
    let quarter = mean(&share(0.75, None));
    let expected = (open.0 * 0.25, open.1);
    assert!(
        agree(quarter, expected),
        "{quarter:?}, expected {expected:?}"
    );
}

#[test]
fn a_cutoff_leaves_all_or_nothing() {
    let open = mean(&share(0.0, None));
    assert_eq!(mean(&share(0.4, Some(0.5))), open, "below it");
    assert_eq!(mean(&share(0.5, Some(0.5))).0, DVec3::ZERO, "at it");
}

#[test]
fn holes_are_where_the_image_says() {
    // The picture shows the middle of the plane, under the seam of the image's two halves in z.
    let scene = under_roof(|scene| {
        let texels = [1.0, 1.0, 0.0, 0.0].map(Vec3::splat).to_vec();
        let image = scene.add_image(Image::new(1, 4, texels).expect("an image"));
        Some(Alpha {
            opacity: Color::Image(ColorImage::new(image)),
            cutoff: Some(0.5),
        })
    });
    let shot = Shot {
        max_depth: 2,
        spp: 4,
        ..Shot::default()
    };
    let pixels = shot.render(&scene, 0).film.develop();
    let lit = |rows: core::ops::Range<usize>| pixels[rows].iter().filter(|p| p.x > 0.0).count();
    let halves = (lit(0..128), lit(128..256));
    assert!(
        halves == (128, 0) || halves == (0, 128),
        "lit pixels above and below: {halves:?}"
    );
}

#[test]
fn a_lamp_that_is_not_seen_gives_all_its_light() {
    let lamps = |alpha: Option<Alpha>| {
        let mut scene = cornell();
        scene
            .materials
            .iter_mut()
            .filter(|material| material.emission.is_some())
            .for_each(|lamp| lamp.alpha = alpha);
        // The lamp is seen by light alone.
        scene.camera = light_scene::Camera::look_at(
            Vec3::new(0.5, 0.9, 0.97),
            Vec3::new(0.5, 0.0, 0.4),
            Vec3::Y,
            0.6,
        )
        .ok();
        scene
    };
    let of = |scene: &Scene, estimator| {
        let shot = Shot {
            estimator,
            max_depth: 2,
            ..Shot::default()
        };
        shot.mean(scene)
    };
    let hidden = lamps(Some(Alpha {
        opacity: Color::Constant(Vec3::ZERO),
        cutoff: None,
    }));
    let whole = of(&lamps(None), Estimator::Mis);
    for estimator in [Estimator::Mis, Estimator::Light] {
        let mean = of(&hidden, estimator);
        assert!(agree(mean, whole), "{estimator:?}: {mean:?} and {whole:?}");
    }
    let missed = of(&hidden, Estimator::Bsdf).0;
    assert_eq!(missed, DVec3::ZERO, "no ray meets it");
}
