//! Emissive meshes of objects are stored once, and shine as copies do.

use core::fmt::Write as _;
use std::path::Path;

use light_render::integrator::{Estimator, Integrator, PathSettings};
use light_render::{
    AnyLightSampler, Film, PictureIdentity, RenderSettings, SamplerKind, SceneDigest, View,
    Visibility, World, render,
};
use light_scene::glam::Vec3;
use light_scene::{
    Alpha, Color, ColorImage, Emission, Files, Image, Instance, Material, Prototype, Scene,
    parse_scene,
};
use lights::bounds::LightId;

use super::pictures::assert_looks_flattened;
use super::{ball, block, flattened, green, grove, transforms, world};
use crate::support::{Shot, agree, assert_estimators_agree, cornell};

fn shining(emission: Emission) -> Material {
    Material {
        emission: Some(emission),
        ..green()
    }
}

/// Two emissive meshes and a dark one in [`transforms`], and dark trees before and behind them.
fn garden() -> Scene {
    let mut scene = cornell();
    let wood = scene.add_material(Material::diffuse("wood", Vec3::splat(0.4)));
    let warm = Emission::one_sided(Vec3::new(2.0, 1.5, 0.5));
    let warm = scene.add_material(shining(warm));
    let cold = Emission::two_sided(Vec3::new(0.2, 0.3, 0.6));
    let cold = scene.add_material(shining(cold));
    let tree = Prototype::new("tree", vec![block(wood)]);
    let lamp = Prototype::new("lamp", vec![ball(warm, 4), block(wood), ball(cold, 6)]);
    let [tree, lamp] = [tree, lamp].map(|object| scene.add_prototype(object));
    for (number, transform) in (0..).zip(transforms()) {
        let objects = if number % 2 == 0 {
            [tree, lamp]
        } else {
            [lamp, tree]
        };
        scene.instances.extend(objects.map(|prototype| Instance {
            prototype,
            transform,
        }));
    }
    scene
}

/// The same ids, and the same lights to the bit: what a light sampler makes of them is the same.
#[test]
fn lights_of_instances_are_those_of_copies() {
    let emissive = shining(Emission::one_sided(Vec3::ONE));
    for scene in [grove(emissive), garden()] {
        let placed = world(&scene);
        // A copied object lies behind those that are defined after it, so that lights have other
        // ids if several objects emit.
        let copied = world(&flattened(&scene));
        let [lights, copies] = [&placed, &copied].map(World::lights);
        let sorted = |world: &World| {
            let mut extents: Vec<_> = world.lights().extents();
            extents.sort_by_key(|extent| format!("{extent:?}"));
            extents
        };
        assert_eq!(sorted(&placed), sorted(&copied), "the same lights");
        let [bytes, of_copies] = [lights, copies].map(|lights| lights.bytes().vertices);
        assert!(
            3 * bytes < of_copies,
            "{bytes} bytes, {of_copies} of copies"
        );
        let names = |world: &World, id| world.light_names(id).map(|names| names.map(String::from));
        for id in (0..lights.len()).filter_map(|id| u32::try_from(id).ok()) {
            assert!(
                names(&placed, LightId(id)).is_some(),
                "light {id} has names"
            );
        }
    }
}

#[test]
fn lamps_look_like_copies() {
    let warm = Vec3::new(2.0, 1.5, 0.5);
    assert_looks_flattened(&grove(shining(Emission::one_sided(warm))), "one-sided");
    assert_looks_flattened(&grove(shining(Emission::two_sided(warm))), "two-sided");

    let mut scene = grove(shining(Emission::one_sided(warm)));
    let texels = (0..64).map(|i| Vec3::splat(if i % 3 == 0 { 0.2 } else { 1.0 }));
    let image = Image::new(8, 8, texels.collect()).expect("an image");
    let image = Color::Image(ColorImage::new(scene.add_image(image)));
    let leaves = |scene: &mut Scene, change: &dyn Fn(&mut Material)| {
        let mut materials = scene.materials.iter_mut();
        change(materials.find(|m| m.name == "leaves").expect("the crown's"));
    };
    leaves(&mut scene, &|m| {
        let emission = m.emission.as_mut().expect("it emits");
        emission.radiance = image;
    });
    assert_looks_flattened(&scene, "with an image");
    let masked = |cutoff| {
        move |m: &mut Material| {
            let opacity = image;
            m.alpha = Some(Alpha { opacity, cutoff });
        }
    };
    leaves(&mut scene, &masked(Some(0.5)));
    assert_looks_flattened(&scene, "with holes");
    // Which rays pass is a hash of the primitive, so that the noise is another.
    leaves(&mut scene, &masked(None));
    let shot = Shot {
        spp: 4,
        ..Shot::default()
    };
    let means = [&scene, &flattened(&scene)].map(|scene| shot.mean(scene));
    assert!(agree(means[0], means[1]), "half there: {means:?}");
}

/// A ray that hits a triangle of an instance finds the light that light samples choose there.
#[test]
fn light_and_material_samples_of_lamps_have_one_mean() {
    assert_estimators_agree(&garden());
}

/// Ten thousand lamps of twelve triangles in a plain, one object.
fn plain() -> Scene {
    let mut text = String::from(
        r#"LookAt 0 -40 25  0 0 0  0 0 1 Camera "perspective" "float fov" 50 WorldBegin
        Shape "trianglemesh" "point3 P" [ -99 -99 0  99 -99 0  99 99 0  -99 99 0 ]
        "integer indices" [ 0 1 2 0 2 3 ]
        ObjectBegin "lamp" AreaLightSource "diffuse" "rgb L" [ 9 8 7 ]
        Shape "trianglemesh" "point3 P" [ -.1 -.1 .4  .1 -.1 .4  .1 .1 .4  -.1 .1 .4
            -.1 -.1 .6  .1 -.1 .6  .1 .1 .6  -.1 .1 .6 ]
        "integer indices" [ 0 2 1 0 3 2  4 5 6 4 6 7  0 1 5 0 5 4  1 2 6 1 6 5  2 3 7 2 7 6
            3 0 4 3 4 7 ] ObjectEnd "#,
    );
    for i in 0..10_000u16 {
        let (x, y) = (f32::from(i % 100) - 49.5, f32::from(i / 100) - 49.5);
        let turn = f32::from(i % 360);
        let lamp = "ObjectInstance \"lamp\" AttributeEnd";
        writeln!(
            text,
            "AttributeBegin Translate {x} {y} 0 Rotate {turn} 0 0 1 {lamp}"
        )
        .expect("a string");
    }
    parse_scene(Path::new("a.pbrt"), text.as_bytes(), Files::NONE).expect("a scene")
}

#[test]
fn ten_thousand_lamps_are_stored_once() {
    let scene = plain();
    let placed = world(&scene);
    assert_eq!(placed.lights().len(), 120_000, "twelve each");
    assert_eq!(placed.stored_triangle_count(), 2 + 12, "a plain and a lamp");
    let bytes = placed.lights().bytes();
    let a_lamp = 3 * 12 * size_of::<Vec3>();
    assert!(
        bytes.vertices <= a_lamp,
        "{} bytes of vertices",
        bytes.vertices
    );
    let each = bytes.lights / 10_000;
    assert!(each < 170, "{each} bytes a lamp, of twelve lights");
    assert_eq!(
        placed.lights().extents(),
        world(&flattened(&scene)).lights().extents(),
        "in the order of copies"
    );
}

fn settings(samples: core::ops::Range<u32>, world: &World) -> RenderSettings {
    RenderSettings {
        samples,
        time_limit: None,
        seed: 5,
        path: PathSettings {
            max_depth: 4,
            estimator: Estimator::Mis,
            light_samples: core::num::NonZeroU32::MIN,
            integrator: Integrator::fitting(world),
        },
    }
}

/// The picture of `scene` by so many samples, on so many threads.
fn film(scene: &Scene, samples: core::ops::Range<u32>, threads: usize) -> Film {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    pool.expect("threads").install(|| {
        let world = world(scene);
        let view = View::new(&scene.camera_or_default(), 16, 16).expect("a view");
        let lights = AnyLightSampler::new(SamplerKind::Bvh, world.lights()).expect("lights");
        let settings = settings(samples, &world);
        render(&world, &view, &lights, &settings, |_| ()).film
    })
}

#[test]
fn threads_and_parts_do_not_change_a_bit() {
    for scene in [garden(), plain()] {
        let whole = film(&scene, 0..6, 1).develop();
        for threads in [2, 7] {
            let picture = film(&scene, 0..6, threads).develop();
            assert!(picture == whole, "{threads} threads");
        }
        let mut merged = film(&scene, 4..6, 2);
        merged.add(&film(&scene, 0..1, 1));
        merged.add(&film(&scene, 1..4, 2));
        assert!(merged.develop() == whole, "three parts");
    }
}

/// Ids of lights follow the order of the instances: parts of pictures of another order are others.
#[test]
fn the_order_of_lamps_counts_and_that_of_dark_objects_does_not() {
    let identity = |scene: &Scene| -> PictureIdentity {
        let digest = SceneDigest::new(scene).expect("no own light");
        let (world, kind) = (world(scene), SamplerKind::Bvh);
        let view = View::new(&scene.camera_or_default(), 8, 8).expect("a view");
        digest.identity(
            &world,
            &view,
            &settings(0..1, &world),
            kind,
            Visibility::Off,
        )
    };
    let swapped = |scene: &Scene| {
        let mut other = scene.clone();
        other.instances.swap(0, 3);
        other
    };
    let dark = grove(green());
    assert_eq!(identity(&dark), identity(&swapped(&dark)), "dark objects");
    let lamps = grove(shining(Emission::one_sided(Vec3::ONE)));
    assert_ne!(identity(&lamps), identity(&swapped(&lamps)), "lamps");
    assert_eq!(identity(&lamps), identity(&lamps.clone()), "the same");
}
