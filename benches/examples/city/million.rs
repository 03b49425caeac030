//! The variance of a choice among a million placed lights, and among the same lights in a flat tree.

use benches::city::{extents, house, on_grid, prototype, receiver};
use benches::exact_variance::{flat_variance, placed_variance, summary};
use light_testkit::Rng;
use light_testkit::light_sets::{BenchSet, SetKind, SetLight};
use lights::bvh::{InstancedLightBvh, LightBvh, Placement};
use lights::glam::{Quat, Vec3};

/// How a thousand prototypes of a thousand lights are placed.
const ARRANGEMENTS: [&str; 4] = ["upright", "oblique", "crowded", "unlike"];

/// Points that the variance is taken at.
const POINTS: usize = 64;

/// Lights of a prototype.
const LIGHTS: usize = 1000;

/// Compares both trees in all arrangements, of each of the seeds.
pub(crate) fn compare(seeds: &[u64]) {
    for name in ARRANGEMENTS {
        for &seed in seeds {
            compare_in(name, seed);
        }
    }
}

fn compare_in(name: &str, seed: u64) {
    let mut rng = Rng::new(seed);
    let set = |kind, seed| BenchSet::generate(kind, LIGHTS, seed).lights;
    let kinds: Vec<Vec<SetLight>> = match name {
        "unlike" => vec![
            set(SetKind::Clusters, 1),
            set(SetKind::Mixed, 2),
            set(SetKind::Spots, 3),
            set(SetKind::Uniform, 4),
        ],
        _ => (0..4).map(|_| house(LIGHTS, &mut rng)).collect(),
    };
    let (mut placements, mut lights) = (Vec::new(), Vec::new());
    for i in 0..1000 {
        let turn = match name {
            "upright" => Quat::from_rotation_z(core::f32::consts::FRAC_PI_2 * rng.below(4) as f32),
            _ => Quat::from_axis_angle(rng.direction(), rng.f32() * core::f32::consts::TAU),
        };
        let by = on_grid(i, 32) * if name == "crowded" { 0.2 } else { 1.0 };
        let kind = rng.below(4);
        let scale = rng.log_range(0.5, 2.0);
        let placed = Placement::new(kind as u32, turn, scale, by);
        placements.push(placed.expect("a rigid transform"));
        let out = |p: Vec3| by + turn * (p * scale);
        lights.extend(kinds[kind].iter().map(|light| mapped(*light, scale, out)));
    }
    let prototypes = kinds.iter().map(|lights| prototype(lights)).collect();
    let tree = InstancedLightBvh::build(prototypes, &placements).expect("placements");
    let flat = LightBvh::build(&extents(&lights)).expect("valid lights");
    let streets = if name == "crowded" { 6 } else { 32 };
    let (mut ours, mut theirs) = (Vec::new(), Vec::new());
    while ours.len() < POINTS {
        let point = receiver(&mut rng, streets);
        ours.extend(placed_variance(&lights, &tree, &point));
        theirs.extend(flat_variance(&lights, &flat, &point));
    }
    let [ours, theirs] = [ours, theirs].map(summary);
    println!("V of a million lights, {name}, seed {seed}: {ours}; of a flat tree {theirs}");
}

/// A light with other points, whose power grows with its area.
fn mapped(light: SetLight, scale: f32, out: impl Fn(Vec3) -> Vec3) -> SetLight {
    let mut light = light;
    match &mut light {
        SetLight::Triangle { vertices, .. } => *vertices = vertices.map(&out),
        SetLight::Point { p, intensity } => {
            *p = out(*p);
            *intensity *= scale * scale;
        }
        SetLight::Spot {
            p,
            target,
            intensity,
            ..
        } => {
            *p = out(*p);
            *target = out(*target);
            *intensity *= scale * scale;
        }
    }
    light
}
