//! A city whose houses are placed and stored once: a billion lights, and with a million the same
//! lights in one flat tree for comparison.
//!
//! `city` measures both; `city variance` is the comparison alone; `city samples` and `city flat` only
//! take samples, for callgrind.

use std::hint::black_box;
use std::time::{Duration, Instant};

use light_testkit::Rng;
use light_testkit::light_sets::{BenchSet, SetKind, SetLight, SetPoint};
use lights::bounds::{LightExtent, LightSampleContext};
use lights::bvh::{InstancedLightBvh, LightBvh, LightPrototype, Placement};
use lights::glam::{Quat, Vec3};

/// Length of the side of a house.
const SIDE: f32 = 12.0;

/// Calls of one turn of a timing.
const CALLS: u32 = 20_000;

fn main() {
    match std::env::args().nth(1).as_deref() {
        Some("samples") => ask(&billion(&mut Rng::new(1)), 316),
        Some("flat") => ask_flat(&flat_million()),
        Some("variance") => ARRANGEMENTS.into_iter().for_each(million_lights),
        _ => {
            billion_lights();
            for name in ARRANGEMENTS {
                million_lights(name);
            }
        }
    }
}

/// Windows in the walls of a house, which face outward: two triangles each.
fn house(lights: usize, rng: &mut Rng) -> Vec<SetLight> {
    let mut windows = Vec::with_capacity(lights);
    while windows.len() < lights {
        let wall = Quat::from_rotation_z(core::f32::consts::FRAC_PI_2 * rng.below(4) as f32);
        let at = Vec3::new(0.5 * SIDE, (rng.f32() - 0.5) * SIDE, 2.0 * SIDE * rng.f32());
        let size = 0.5 * SIDE / (lights as f32).sqrt();
        let radiance = rng.log_range(0.1, 10.0);
        let [a, b, c, d] = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
            .map(|(y, z)| wall * (at + Vec3::new(0.0, y, z) * size));
        for vertices in [[a, b, c], [a, c, d]] {
            windows.push(SetLight::Triangle {
                vertices,
                radiance,
                two_sided: false,
            });
        }
    }
    windows.truncate(lights);
    windows
}

fn extents(lights: &[SetLight]) -> Vec<LightExtent> {
    lights.iter().map(|light| light.bounds().into()).collect()
}

fn prototype(lights: &[SetLight]) -> LightPrototype {
    LightPrototype::new(&extents(lights)).expect("valid lights")
}

/// On a grid of `across` streets.
fn on_grid(i: usize, across: usize) -> Vec3 {
    Vec3::new((i % across) as f32, (i / across) as f32, 0.0) * (2.0 * SIDE)
}

/// 10^5 houses of 20 kinds, with 10^4 lights each.
fn billion(rng: &mut Rng) -> InstancedLightBvh {
    let kinds: Vec<_> = (0..20).map(|_| prototype(&house(10_000, rng))).collect();
    let place = |i: usize| {
        let turn = Quat::from_rotation_z(rng.f32() * core::f32::consts::TAU);
        let scale = 0.8 + 0.4 * rng.f32();
        let placed = Placement::new(rng.below(20) as u32, turn, scale, on_grid(i, 316));
        placed.expect("a rigid transform")
    };
    let placements: Vec<_> = (0..100_000).map(place).collect();
    InstancedLightBvh::build(kinds, &placements).expect("a city")
}

/// A receiver on the ground, or on a wall, of a city of so many streets.
fn receiver(rng: &mut Rng, across: f32) -> SetPoint {
    let city = 2.0 * SIDE * across;
    let p = Vec3::new(rng.f32() * city, rng.f32() * city, 0.01);
    if rng.below(2) == 0 {
        return SetPoint { p, n: Vec3::Z };
    }
    let n = Vec3::new(rng.f32() - 0.5, rng.f32() - 0.5, 0.0).normalize_or(Vec3::X);
    let p = p + Vec3::Z * (2.0 * SIDE * rng.f32());
    SetPoint { p, n }
}

fn context(point: &SetPoint) -> LightSampleContext {
    LightSampleContext::surface(point.p, point.n, point.n)
}

// Not inlined, so that callgrind can count it alone.
#[inline(never)]
fn ask(tree: &InstancedLightBvh, across: u16) {
    let mut rng = Rng::new(3);
    for _ in 0..CALLS {
        let ctx = context(&receiver(&mut rng, f32::from(across)));
        black_box(tree.sample(&ctx, rng.u64()));
    }
}

#[inline(never)]
fn ask_flat(tree: &LightBvh) {
    let mut rng = Rng::new(3);
    for _ in 0..CALLS {
        let ctx = context(&receiver(&mut rng, 10.0));
        black_box(tree.sample(&ctx, rng.u64()));
    }
}

/// 100 houses of 10^4 lights.
fn flat_million() -> LightBvh {
    let mut rng = Rng::new(1);
    let mut lights = Vec::new();
    for i in 0..100 {
        let by = on_grid(i, 10);
        let house = house(10_000, &mut rng);
        lights.extend(house.iter().map(|light| light.moved(by)));
    }
    LightBvh::build(&extents(&lights)).expect("valid lights")
}

fn billion_lights() {
    let start = Instant::now();
    let tree = billion(&mut Rng::new(1));
    println!(
        "{} lights, built in {:?}",
        tree.light_count(),
        start.elapsed()
    );
    println!("{} MB of tree", tree.bytes() / 1_000_000);
    println!("{} at most in memory", peak());
    let flat = flat_million();
    let mut rng = Rng::new(2);
    let (mut ours, mut theirs) = (Vec::new(), Vec::new());
    for _ in 0..15 {
        theirs.push(timed(|| {
            let ctx = context(&receiver(&mut rng, 10.0));
            black_box(flat.sample(&ctx, rng.u64()));
        }));
        ours.push(timed(|| {
            let ctx = context(&receiver(&mut rng, 316.0));
            black_box(tree.sample(&ctx, rng.u64()));
        }));
    }
    let median = |times: &mut Vec<Duration>| {
        times.sort();
        times[times.len() / 2].as_nanos() / u128::from(CALLS)
    };
    println!(
        "ns a sample, with what makes its receiver: {}, of a flat tree of a million {}",
        median(&mut ours),
        median(&mut theirs)
    );
}

fn timed(mut call: impl FnMut()) -> Duration {
    let start = Instant::now();
    (0..CALLS).for_each(|_| call());
    start.elapsed()
}

/// The largest resident size of this process, as Linux says it.
fn peak() -> String {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let peak = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    peak.map_or_else(|| "an unknown amount".into(), |kb| kb.trim().into())
}

/// How a thousand prototypes of a thousand lights are placed.
const ARRANGEMENTS: [&str; 4] = ["upright", "oblique", "crowded", "unlike"];

fn million_lights(name: &str) {
    const COUNT: usize = 1000;
    let mut rng = Rng::new(4);
    let set = |kind, seed| BenchSet::generate(kind, COUNT, seed).lights;
    let kinds: Vec<Vec<SetLight>> = match name {
        "unlike" => vec![
            set(SetKind::Clusters, 1),
            set(SetKind::Mixed, 2),
            set(SetKind::Spots, 3),
            set(SetKind::Uniform, 4),
        ],
        _ => (0..4).map(|_| house(COUNT, &mut rng)).collect(),
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
    let across = if name == "crowded" { 6.0 } else { 32.0 };
    let (mut ours, mut theirs, mut points) = (Vec::new(), Vec::new(), 0);
    while points < 200 {
        let point = receiver(&mut rng, across);
        let total: f64 = lights.iter().map(|light| light.contribution(&point)).sum();
        if total <= 0.0 {
            continue;
        }
        points += 1;
        let ctx = context(&point);
        ours.push(variance(&lights, &point, total, &mut rng, |u| {
            let chosen = tree.sample(&ctx, u)?;
            Some((tree.light_index(chosen.light)? as usize, chosen.pmf))
        }));
        theirs.push(variance(&lights, &point, total, &mut rng, |u| {
            let chosen = flat.sample(&ctx, u)?;
            Some((chosen.light.index(), chosen.pmf))
        }));
    }
    let summary = |all: &mut Vec<f64>| {
        all.sort_by(f64::total_cmp);
        let mean = all.iter().sum::<f64>() / all.len() as f64;
        format!("mean {mean:.2}, median {:.2}", all[all.len() / 2])
    };
    let (ours, theirs) = (summary(&mut ours), summary(&mut theirs));
    println!("V of a million lights, {name}: {ours}; of a flat tree {theirs}");
}

/// The relative variance of one sample, estimated from many.
fn variance(
    lights: &[SetLight],
    point: &SetPoint,
    total: f64,
    rng: &mut Rng,
    sample: impl Fn(u64) -> Option<(usize, f32)>,
) -> f64 {
    const SAMPLES: u32 = 3_000;
    let squares: f64 = (0..SAMPLES)
        .filter_map(|_| sample(rng.u64()))
        .map(|(light, pmf)| (lights[light].contribution(point) / f64::from(pmf)).powi(2))
        .sum();
    squares / f64::from(SAMPLES) / (total * total) - 1.0
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
