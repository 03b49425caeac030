//! A room that gets its light from the sky through one window: the sky sampled as a whole, most of
//! which the walls hide, and sampled through the window, a portal, in the same processor time.
//!
//! `cargo run --release -p light-render --example portals` writes `out/portals-sky.png` and
//! `out/portals-window.png`, and prints relMSE: half the squared difference of two pictures of
//! other seeds, over the squared pixel and a floor, where no sky is seen directly.

use std::fs;
use std::path::Path;

use light_render::bench::PictureBench;
use light_render::integrator::{Estimator, Integrator, PathSettings};
use light_render::{AnyLightSampler, SamplerKind, View, World};
use light_scene::glam::Vec3;
use light_scene::{BuiltinSky, Camera, Image, Material, MaterialId, Mesh, Scene, write_png};
use lights::sources::{LightDesc, PortalInfiniteLightDesc, Rgb};

/// Width and height of the pictures.
const SIZE: [u32; 2] = [240, 160];

/// Seconds of all threads that a picture may take.
const SECONDS: f64 = 6.0;

/// Samples a pixel from which the time of one is known.
const TRIAL: u32 = 4;

/// The window in the wall x = -2: clockwise from where light comes.
const WINDOW: [Vec3; 4] = [
    Vec3::new(-2.0, 0.9, -0.6),
    Vec3::new(-2.0, 2.1, -0.6),
    Vec3::new(-2.0, 2.1, 0.6),
    Vec3::new(-2.0, 0.9, 0.6),
];

type Result<T> = core::result::Result<T, Box<dyn core::error::Error>>;

fn main() -> Result<()> {
    let sky = room()?;
    let mut window = sky.clone();
    window.lights = sky.lights.iter().map(through_window).collect();
    fs::create_dir_all("out")?;
    println!("{:<18} spp   seconds    mean   relMSE", "sampled");
    for (name, title, scene) in [
        ("sky", "the whole sky", sky),
        ("window", "through the window", window),
    ] {
        picture(name, title, scene)?;
    }
    Ok(())
}

/// Two pictures of one scene, as many samples as the time allows, and their row.
fn picture(name: &str, title: &str, scene: Scene) -> Result<()> {
    let view = View::new(&scene.camera_or_default(), SIZE[0], SIZE[1])?;
    let bench = PictureBench::new(World::new(scene)?, view)?;
    let sampler = AnyLightSampler::new(SamplerKind::DEFAULT, bench.world().lights())?;
    let path = PathSettings {
        max_depth: 6,
        estimator: Estimator::Mis,
        light_samples: PathSettings::DEFAULT_LIGHT_SAMPLES,
        integrator: Integrator::Path,
    };
    let trial = bench.picture(&sampler, path, TRIAL, 0).seconds;
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a small number of samples"
    )]
    let spp = (SECONDS / trial * f64::from(TRIAL)).max(1.0) as u32;
    let [a, b] = [1, 2].map(|seed| bench.picture(&sampler, path, spp, seed));
    let both: Vec<Vec3> = a
        .pixels
        .iter()
        .zip(&b.pixels)
        .map(|(a, b)| 0.5 * (*a + *b))
        .collect();
    // The square of a tenth of the mean.
    let floor = bench.tenth_of_mean(&both);
    let error = bench.error(&both, floor);
    println!(
        "{title:<18} {spp:>3} {:>9.1} {:>7.4} {:>8.4}",
        0.5 * (a.seconds + b.seconds),
        10.0 * floor.sqrt(),
        error.of_pair(&a.pixels, &b.pixels)
    );
    let shown = a.pixels.iter().map(|&l| (l * EXPOSURE).min(Vec3::ONE));
    let image = Image::new(SIZE[0], SIZE[1], shown.collect())?;
    write_png(Path::new(&format!("out/portals-{name}.png")), &image)?;
    Ok(())
}

/// Factor of radiances; 1 is white then.
const EXPOSURE: f32 = 25.0;

/// A sky as it is seen through the window alone.
fn through_window(light: &LightDesc<Rgb>) -> LightDesc<Rgb> {
    match light {
        LightDesc::ImageInfinite(sky) => LightDesc::PortalInfinite(PortalInfiniteLightDesc {
            transform: sky.transform,
            map: sky.map.clone(),
            amount: sky.amount,
            portal: WINDOW,
        }),
        other => other.clone(),
    }
}

/// A room of 4 by 3 by 5 metres with a table, under a blue sky without a sun.
fn room() -> Result<Scene> {
    let mut scene = Scene::default();
    BuiltinSky::ClearNoon.add_to(&mut scene, Vec3::Y);
    scene
        .lights
        .retain(|light| matches!(light, LightDesc::ImageInfinite(_)));
    let [white, green, brown] = [
        ("white", Vec3::new(0.75, 0.72, 0.66)),
        ("green", Vec3::new(0.45, 0.6, 0.5)),
        ("brown", Vec3::new(0.5, 0.33, 0.2)),
    ]
    .map(|(name, color)| scene.add_material(Material::diffuse(name, color)));

    let (low, high) = (Vec3::new(-2.0, 0.0, -2.5), Vec3::new(2.0, 3.0, 2.5));
    let sides = sides(low, high);
    for (corners, material) in sides
        .into_iter()
        .zip([white, white, brown, white, green, white])
    {
        scene.meshes.push(Mesh::quad("room", material, corners));
    }
    // The first side, x = -2, leaves the window open.
    scene.meshes[0] = around_window(white, low, high);
    for (low, high) in [
        (Vec3::new(-0.7, 0.7, -1.6), Vec3::new(0.8, 0.78, -0.6)),
        (Vec3::new(-0.65, 0.0, -1.55), Vec3::new(-0.59, 0.7, -1.49)),
        (Vec3::new(0.69, 0.0, -1.55), Vec3::new(0.75, 0.7, -1.49)),
        (Vec3::new(-0.65, 0.0, -0.71), Vec3::new(-0.59, 0.7, -0.65)),
        (Vec3::new(0.69, 0.0, -0.71), Vec3::new(0.75, 0.7, -0.65)),
        (Vec3::new(-0.15, 0.78, -1.2), Vec3::new(0.15, 1.15, -0.9)),
    ] {
        for corners in self::sides(low, high) {
            scene.meshes.push(Mesh::quad("table", brown, corners));
        }
    }
    let (eye, target) = (Vec3::new(1.7, 1.6, 2.3), Vec3::new(-0.5, 1.1, -1.5));
    scene.camera = Some(Camera::look_at(eye, target, Vec3::Y, 62_f32.to_radians())?);
    Ok(scene)
}

/// The six sides of a box, x, y and z, the lower before the upper.
fn sides(low: Vec3, high: Vec3) -> [[Vec3; 4]; 6] {
    let side = |axis: usize, at: f32| {
        [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(a, b)| {
            let mut corner = Vec3::ZERO;
            corner[axis] = at;
            for (other, upper) in [((axis + 1) % 3, a), ((axis + 2) % 3, b)] {
                corner[other] = [low, high][upper][other];
            }
            corner
        })
    };
    let of_axis = |axis: usize| [side(axis, low[axis]), side(axis, high[axis])];
    let ([a, b], [c, d], [e, f]) = (of_axis(0), of_axis(1), of_axis(2));
    [a, b, c, d, e, f]
}

/// The wall of the window, as a frame of four pieces.
fn around_window(material: MaterialId, low: Vec3, high: Vec3) -> Mesh {
    let corner = |y, z| Vec3::new(low.x, y, z);
    let outer = [
        corner(low.y, low.z),
        corner(high.y, low.z),
        corner(high.y, high.z),
        corner(low.y, high.z),
    ];
    let mut wall = Mesh::new("wall with the window", material);
    for i in 0..4 {
        let next = (i + 1) % 4;
        wall.push_quad([outer[i], outer[next], WINDOW[next], WINDOW[i]]);
    }
    wall
}
