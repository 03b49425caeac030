//! Spheres are round: they are met, lit, and shine as closed forms say, and as very many triangles do.

mod support;

use std::path::Path;

use light_render::integrator::Estimator;
use light_render::{PrimitiveId, Ray, SamplerKind, World, WorldError};
use light_scene::glam::{Affine3A, DVec3, Vec2, Vec3};
use light_scene::{
    Alpha, Camera, Color, Emission, Files, Image, Material, Placement, Prototype, Scene, Sphere,
    SphereFront, Surface as Finish, parse_scene,
};
use lights::media::phase::Isotropic;
use lights::media::{Homogeneous, Phase, Region, Substance};
use lights::sources::{LightDesc, MediumInterface, RadianceAmount, UniformInfiniteLightDesc};
use support::{Shot, agree, assert_estimators_agree, cornell, plane};

const ALL: [Estimator; 3] = [Estimator::Light, Estimator::Bsdf, Estimator::Mis];

fn place(center: Vec3, radius: f32) -> Affine3A {
    let turn = Affine3A::from_axis_angle(Vec3::new(1.0, 2.0, -2.0) / 3.0, 0.9);
    Affine3A::from_translation(center) * turn * Affine3A::from_scale(Vec3::splat(radius))
}

fn add(scene: &mut Scene, material: Material, place: Affine3A) {
    let material = scene.add_material(material);
    scene.spheres.push(Sphere::new("ball", material, place));
}

fn lamp(emission: Emission) -> Material {
    Material {
        emission: Some(emission),
        ..Material::diffuse("lamp", Vec3::splat(0.5))
    }
}

fn glass() -> Finish {
    Finish::Dielectric {
        eta: 1.5,
        alpha: Vec2::ZERO,
    }
}

/// The scene with meshes of many triangles instead of spheres.
fn tessellated(scene: &Scene, columns: u16) -> Scene {
    let mut scene = scene.clone();
    let meshes = scene.spheres.drain(..).map(|sphere| sphere.mesh(columns));
    scene.meshes.extend(meshes);
    scene
}

fn world(scene: Scene) -> World {
    World::new(scene).expect("a good scene")
}

#[test]
fn rays_meet_what_they_meet_of_triangles() {
    let mut scene = Scene::default();
    add(
        &mut scene,
        Material::diffuse("a", Vec3::ONE),
        place(Vec3::new(0.4, 0.5, 0.6), 0.3),
    );
    add(
        &mut scene,
        Material::diffuse("b", Vec3::ONE),
        place(Vec3::new(0.8, 0.2, 0.3), 0.2),
    );
    scene.spheres[1].front = SphereFront::Inside;
    let [round, fine] = [world(scene.clone()), world(tessellated(&scene, 512))];
    let lattice = |i: u32, g: Vec3| (g * i as f32).fract();
    let mut met = 0;
    for i in 1..20_000 {
        let origin = lattice(i, Vec3::new(0.819_172_5, 0.671_043_6, 0.549_700_5));
        let target = lattice(i, Vec3::new(0.754_877_7, 0.569_840_3, 0.430_159_7));
        let direction = (target - origin).normalize();
        let ray = Ray { origin, direction };
        let (Some(a), Some(b)) = (round.closest(&ray, None), fine.closest(&ray, None)) else {
            continue;
        };
        // Where a ray grazes, a little in height is much along the ray.
        if a.n.dot(direction).abs() < 0.1 || a.p.distance(origin) < 1e-3 {
            continue;
        }
        met += 1;
        assert!(a.p.distance(b.p) < 1e-3, "{} and {}", a.p, b.p);
        assert!(a.n.dot(b.n) > 0.999, "{} and {}", a.n, b.n);
        assert!(a.ns.distance(b.ns) < 5e-3, "{} and {}", a.ns, b.ns);
        let seam = (a.uv - b.uv).abs();
        assert!(
            seam.min(1.0 - seam).max_element() < 0.02,
            "{} and {}",
            a.uv,
            b.uv
        );
    }
    assert!(met > 5000, "{met} rays met a sphere");
}

#[test]
fn rays_that_start_on_a_sphere_meet_its_other_side_alone() {
    let mut met_again = 0;
    for (center, radius) in [
        (Vec3::ZERO, 1.0),
        (Vec3::new(1e3, -2e3, 5e2), 0.5),
        (Vec3::new(0.0, -1e5, 0.0), 1e5),
        (Vec3::new(3.0, 4.0, 5.0), 1e-3),
    ] {
        let mut scene = Scene::default();
        add(
            &mut scene,
            Material::diffuse("ball", Vec3::ONE),
            place(center, radius),
        );
        let world = world(scene);
        for k in 0..64u8 {
            let at = Vec2::new(f32::from(k) * 0.618, f32::from(k) * 0.755).fract() * 2.0 - 1.0;
            let surface = world.surface(PrimitiveId::new(0), at);
            for slope in [1e-4, 0.01, 0.3, 2.0] {
                let along = surface.n.any_orthonormal_vector();
                let out = (along + surface.n * slope).normalize();
                let met = world.closest(&surface.spawn(out), Some(surface.primitive));
                assert_eq!(met, None, "nothing outside of {surface:?}");
                let inward = (along - surface.n * slope).normalize();
                let chord = 2.0 * radius * -inward.dot(surface.n);
                if chord * slope < 8.0 * surface.p_error.max_element() {
                    continue;
                }
                met_again += 1;
                let met = world.closest(&surface.spawn(inward), Some(surface.primitive));
                let Some(met) = met else {
                    panic!("the other side, from {surface:?} with {slope}");
                };
                let error = (met.p.distance(surface.p) - chord).abs();
                let rounding = surface.p_error.max_element() / slope.min(1.0);
                assert!(
                    error <= 4.0 * rounding + 1e-5 * radius,
                    "{error} of {chord}"
                );
            }
        }
    }
    assert!(met_again > 500, "{met_again} chords beyond rounding");
}

/// Direct light on a plane at the origin, below or beside a sphere of radiance 1.
#[test]
fn a_sphere_gives_the_irradiance_of_its_solid_angle() {
    const ALBEDO: f32 = 0.6;
    for (center, radius) in [
        (Vec3::new(0.0, 3.0, 0.0), 1.0),
        (Vec3::new(3.0, 4.0, 0.0), 2.0),
        (Vec3::new(0.0, 1.01, 0.0), 0.99),
        (Vec3::new(2e3, 4e3, 1e3), 5.0),
    ] {
        let mut scene = plane(ALBEDO, 1.0);
        scene.camera = Camera::look_at(Vec3::Y * 0.015, Vec3::ZERO, Vec3::Z, 1e-3).ok();
        add(
            &mut scene,
            lamp(Emission::one_sided(Vec3::ONE)),
            place(center, radius),
        );
        let (distance, radius) = (f64::from(center.length()), f64::from(radius));
        let sine = radius / distance;
        let expected = f64::from(ALBEDO) * sine * sine * f64::from(center.y) / distance;
        // Rays that scatter find a small lamp too seldom.
        for estimator in ALL.into_iter().filter(|e| sine > 0.1 || e.samples_lights()) {
            let shot = Shot {
                size: 8,
                spp: 64,
                max_depth: 2,
                estimator,
                sampler: SamplerKind::Bvh,
                ..Shot::default()
            };
            let mean = shot.mean(&scene);
            let exact = (DVec3::splat(expected), DVec3::ZERO);
            assert!(
                agree(mean, exact),
                "{estimator:?} under {center}: {mean:?}, expected {expected}"
            );
        }
    }
}

#[test]
fn a_furnace_inside_of_a_sphere_is_the_geometric_series() {
    const ALBEDO: f32 = 0.7;
    const DEPTH: i32 = 5;
    let mut scene = Scene::default();
    let wall = Material {
        emission: Some(Emission::one_sided(Vec3::new(1.0, 2.0, 3.0))),
        ..Material::diffuse("wall", Vec3::splat(ALBEDO))
    };
    add(&mut scene, wall, place(Vec3::new(10.0, 0.0, -3.0), 2.0));
    scene.spheres[0].front = SphereFront::Inside;
    let eye = Vec3::new(10.5, 0.3, -2.0);
    scene.camera = Camera::look_at(eye, eye + Vec3::X, Vec3::Y, 1.5).ok();
    let albedo = f64::from(ALBEDO);
    let series = (1.0 - albedo.powi(DEPTH)) / (1.0 - albedo);
    for estimator in ALL {
        let shot = Shot {
            max_depth: 5,
            spp: 64,
            estimator,
            ..Shot::default()
        };
        let mean = shot.mean(&scene);
        let exact = (DVec3::new(1.0, 2.0, 3.0) * series, DVec3::ZERO);
        assert!(
            agree(mean, exact),
            "{estimator:?}: {mean:?}, expected {series} times the emission"
        );
    }
}

#[test]
fn glass_balls_under_an_even_sky_are_not_seen() {
    let mut scene = Scene::default();
    add(
        &mut scene,
        Material::new("glass", glass()),
        place(Vec3::ZERO, 1.0),
    );
    let sky = UniformInfiniteLightDesc {
        emission: Vec3::ONE,
        amount: RadianceAmount::default(),
    };
    scene.lights.push(LightDesc::UniformInfinite(sky));
    scene.camera = Camera::look_at(Vec3::Z * 4.0, Vec3::ZERO, Vec3::Y, 0.6).ok();
    let shot = Shot {
        max_depth: 1000,
        spp: 64,
        ..Shot::default()
    };
    let mean = shot.mean(&scene);
    assert!(agree(mean, (DVec3::ONE, DVec3::ZERO)), "{mean:?}");
}

/// A room with a ball of `material` in it, an ordinary lamp above.
fn ball_in_room(material: Material) -> Scene {
    let mut scene = cornell();
    add(&mut scene, material, place(Vec3::new(0.65, 0.3, 0.4), 0.2));
    scene
}

fn assert_looks_tessellated(scene: &Scene, what: &str) {
    let shot = Shot {
        max_depth: 12,
        ..Shot::default()
    };
    let means = [scene, &tessellated(scene, 128)].map(|scene| shot.mean(scene));
    assert!(agree(means[0], means[1]), "{what}: {means:?}");
}

#[test]
fn pictures_are_those_of_fine_triangles() {
    let grey = Vec3::splat(0.5);
    let metal = Finish::Conductor {
        eta: Vec3::splat(0.2),
        k: Vec3::splat(3.0),
        alpha: Vec2::splat(0.2),
    };
    for material in [
        Material::diffuse("matt", grey),
        Material::new("glass", glass()),
        Material::new("metal", metal),
        lamp(Emission::one_sided(Vec3::ONE)),
        lamp(Emission::two_sided(Vec3::ONE)),
        Material {
            alpha: Some(Alpha {
                share: Color::Constant(Vec3::splat(0.4)),
                cutoff: None,
            }),
            ..Material::diffuse("holes", grey)
        },
        Material {
            emission: Some(Emission::one_sided(Vec3::ONE)),
            ..Material::new("glass lamp", glass())
        },
    ] {
        let what = material.name.clone();
        assert_looks_tessellated(&ball_in_room(material), &what);
    }
}

#[test]
fn textures_lie_on_spheres_as_on_triangles() {
    let texels = (0..64).map(|i| Vec3::splat(if i % 3 == 0 { 0.1 } else { 0.9 }));
    let image = Image::new(8, 8, texels.collect()).expect("an image");
    let mut scene = ball_in_room(Material::diffuse("ball", Vec3::ONE));
    let color = Color::Image(light_scene::ColorImage::new(scene.add_image(image)));
    let ball = scene.materials.last_mut().expect("the ball's");
    ball.surface = Finish::Diffuse { reflectance: color };
    assert_looks_tessellated(&scene, "textured");
    let ball = scene.materials.last_mut().expect("the ball's");
    ball.alpha = Some(Alpha {
        share: color,
        cutoff: Some(0.5),
    });
    assert_looks_tessellated(&scene, "with holes");
}

#[test]
fn estimators_agree_on_lamps_inside_and_outside() {
    for front in [SphereFront::Outside, SphereFront::Inside] {
        for emission in [Emission::one_sided, Emission::two_sided] {
            let mut scene = ball_in_room(lamp(emission(Vec3::new(3.0, 2.0, 1.0))));
            scene.spheres[0].front = front;
            assert_estimators_agree(&scene);
            // From inside of it.
            scene.spheres[0].place = place(Vec3::new(0.5, 0.5, 0.9), 0.3);
            assert_estimators_agree(&scene);
        }
    }
}

#[test]
fn media_are_bounded_by_spheres() {
    let smoke = Homogeneous {
        substance: Substance::new(Vec3::ONE, Vec3::new(4.0, 8.0, 12.0), Vec3::ZERO).expect("valid"),
        phase: Phase::Isotropic(Isotropic),
        region: Region::UNBOUNDED,
    };
    for (what, surface) in [("smoke", Finish::Interface), ("smoke in glass", glass())] {
        let mut scene = ball_in_room(Material::new(what, surface));
        let inside = Some(scene.add_medium("smoke", smoke.clone()));
        let outside = None;
        let ball = scene.materials.last_mut().expect("the ball's");
        ball.media = MediumInterface { inside, outside };
        assert_looks_tessellated(&scene, what);
    }
}

#[test]
fn prototypes_hold_spheres_which_places_may_stretch() {
    let stretched =
        place(Vec3::new(0.6, 0.6, 0.5), 1.0) * Affine3A::from_scale(Vec3::new(0.2, 0.1, -0.15));
    let places = [stretched, place(Vec3::new(0.25, 0.6, 0.4), 0.12)];
    for (shines, material) in [
        (false, Material::new("glass", glass())),
        (true, lamp(Emission::one_sided(Vec3::ONE))),
    ] {
        let mut scene = cornell();
        let id = scene.add_material(material);
        let ball = Sphere::new("ball", id, Affine3A::IDENTITY);
        let mut flat = scene.clone();
        let fine = ball.mesh(128);
        flat.meshes
            .extend(places.iter().map(|place| fine.transformed(place)));
        let mut prototype = Prototype::new("ball", Vec::new());
        prototype.spheres.push(ball);
        let prototype = scene.add_prototype(prototype);
        scene
            .placements
            .extend(places.map(|place| Placement { prototype, place }));

        let world = world(scene.clone());
        let count = (world.placement_count(), world.stored_sphere_count());
        assert_eq!(
            count,
            if shines { (0, 1) } else { (2, 1) },
            "what shines is copied"
        );
        let shot = Shot {
            max_depth: 12,
            ..Shot::default()
        };
        let means = [&scene, &flat].map(|scene| shot.mean(scene));
        assert!(agree(means[0], means[1]), "{means:?}");
    }
}

#[test]
fn spheres_of_pbrt_files_are_round_where_they_can_be() {
    let count = |text: &str| {
        let text = format!("WorldBegin {text}");
        let scene = parse_scene(Path::new("a.pbrt"), text.as_bytes(), Files::NONE);
        let scene = scene.expect("a scene");
        (scene.spheres.len(), scene.meshes.len())
    };
    let light = "AreaLightSource \"diffuse\" \"rgb L\" [1 1 1]";
    let both = format!("{light} \"bool twosided\" true");
    for round in [
        "Shape \"sphere\"".to_owned(),
        "Scale 2 2 -2 Rotate 20 1 2 3 ReverseOrientation Shape \"sphere\" \"float radius\" 3"
            .into(),
        "Shape \"sphere\" \"float zmin\" -1 \"float phimax\" 360 \"float alpha\" .5".into(),
        format!("{light} Material \"interface\" Shape \"sphere\" \"float alpha\" .5"),
        format!("{both} Shape \"sphere\""),
    ] {
        assert_eq!(count(&round), (1, 0), "{round}");
    }
    for tessellated in [
        "Scale 1 2 1 Shape \"sphere\"".to_owned(),
        "Shape \"sphere\" \"float zmax\" 0.5".into(),
        "Shape \"sphere\" \"float phimax\" 90".into(),
        format!("{both} Material \"interface\" Shape \"sphere\""),
        format!("{light} ReverseOrientation Shape \"sphere\" \"float alpha\" .5"),
    ] {
        assert_eq!(count(&tessellated), (0, 1), "{tessellated}");
    }
}

#[test]
fn impossible_spheres_are_refused() {
    let mut scene = Scene::default();
    add(
        &mut scene,
        Material::diffuse("grey", Vec3::ONE),
        Affine3A::from_scale(Vec3::new(1.0, 2.0, 1.0)),
    );
    let error = World::new(scene).err();
    assert_eq!(
        error,
        Some(WorldError::Sphere {
            name: "ball".into()
        }),
        "stretched"
    );
    let text = "WorldBegin\nShape \"sphere\" \"float radius\" -1";
    let error = parse_scene(Path::new("a.pbrt"), text.as_bytes(), Files::NONE).err();
    let error = error.map(|error| error.to_string());
    let expected = "a.pbrt:2: expected `radius` above 0, found -1";
    assert_eq!(error.as_deref(), Some(expected), "inside out");
}
