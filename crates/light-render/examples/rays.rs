//! How many rays a second the renderer traces, next to bare `obvhs` on the same rays and the same
//! build.
//!
//! Follows paths through a scene that ships (`--example rays -- night`), keeps every ray that they
//! ask for, and replays them on one thread, in turns: by [`Accel`], which leaves out the triangle
//! that a ray starts on and finds the place of a hit, and by `obvhs` alone.

use core::hint::black_box;
use core::time::Duration;
use std::time::Instant;

use light_render::{Accel, PrimitiveId, Ray, SampleStream, View, World};
use light_scene::glam::{Vec2, Vec3};
use light_scene::{BuiltinScene, Scene};
use lights::samplers::{BvhLightSampler, LightSampler};
use lights::sources::{Light, PdfCoverage};
use obvhs::BvhBuildParams;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::builder::build_bvh2_from_tris;
use obvhs::cwbvh::CwBvh;
use obvhs::cwbvh::builder::build_cwbvh_from_tris;
use obvhs::ray::{Ray as ObvhsRay, RayHit};
use obvhs::rt_triangle::RtTriangle;
use obvhs::triangle::Triangle;

/// Replays of all rays by each; the fastest of them counts.
const ROUNDS: u32 = 9;

/// The rays of some paths, in the order in which the paths ask for them.
#[derive(Default)]
struct Rays {
    closest: Vec<(Ray, Option<PrimitiveId>)>,
    shadow: Vec<(Ray, f32, PrimitiveId)>,
}

/// Who traces rays.
enum Tracer {
    Renderer(Box<Accel>),
    Binary(Bvh2, Vec<RtTriangle>),
    Wide(CwBvh, Vec<RtTriangle>),
}

fn main() -> Result<(), Box<dyn core::error::Error>> {
    let name = std::env::args().nth(1).unwrap_or_else(|| "night".into());
    let scene = name.parse::<BuiltinScene>()?.load();
    let triangles = corners(&scene);
    let rays = follow_paths(scene)?;
    println!(
        "{name}: {} triangles, {} rays to the first hit, {} shadow rays",
        triangles.len(),
        rays.closest.len(),
        rays.shadow.len()
    );
    let plain: Vec<Triangle> = triangles
        .iter()
        .map(|&[a, b, c]| Triangle {
            v0: a.into(),
            v1: b.into(),
            v2: c.into(),
        })
        .collect();
    let leaves = |indices: &[u32]| -> Vec<RtTriangle> {
        indices
            .iter()
            .map(|&i| (&plain[i as usize]).into())
            .collect()
    };
    let mut tracers = vec![(
        "renderer",
        Tracer::Renderer(Box::new(Accel::new(&triangles))),
    )];
    for (names, params) in [
        (
            ["obvhs bvh2 medium", "obvhs cwbvh medium"],
            BvhBuildParams::medium_build(),
        ),
        (
            ["obvhs bvh2 slow", "obvhs cwbvh slow"],
            BvhBuildParams::slow_build(),
        ),
        (
            ["obvhs bvh2 very slow", "obvhs cwbvh very slow"],
            BvhBuildParams::very_slow_build(),
        ),
    ] {
        let bvh = build_bvh2_from_tris(&plain, params, &mut Duration::default());
        let triangles = leaves(&bvh.primitive_indices);
        tracers.push((names[0], Tracer::Binary(bvh, triangles)));
        let bvh = build_cwbvh_from_tris(&plain, params, &mut Duration::default());
        let triangles = leaves(&bvh.primitive_indices);
        tracers.push((names[1], Tracer::Wide(bvh, triangles)));
    }
    let mut best = vec![[Duration::MAX; 2]; tracers.len()];
    for _ in 0..ROUNDS {
        for ((_, tracer), best) in tracers.iter().zip(&mut best) {
            let times = [
                time(|| tracer.closest(&rays)),
                time(|| tracer.shadows(&rays)),
            ];
            *best = [best[0].min(times[0]), best[1].min(times[1])];
        }
    }
    println!("million rays a second    first hit   shadow     both");
    for ((name, _), [closest, shadow]) in tracers.iter().zip(best) {
        let rate = |n: usize, time: Duration| n as f64 / time.as_secs_f64() * 1e-6;
        let (n, m) = (rays.closest.len(), rays.shadow.len());
        println!(
            "{name:<24} {:>9.3} {:>8.3} {:>8.3}",
            rate(n, closest),
            rate(m, shadow),
            rate(n + m, closest + shadow)
        );
    }
    Ok(())
}

impl Tracer {
    /// Finds the first hit of every ray.
    fn closest(&self, rays: &Rays) {
        let bare = |ray: &Ray| ObvhsRay::new_inf(ray.origin.into(), ray.direction.into());
        for (ray, from) in &rays.closest {
            let mut hit = RayHit::none();
            match self {
                Self::Renderer(accel) => {
                    black_box(accel.closest(ray, *from));
                }
                Self::Binary(bvh, leaves) => {
                    bvh.ray_traverse(bare(ray), &mut hit, |ray, i| leaves[i].intersect(ray));
                }
                Self::Wide(bvh, leaves) => {
                    bvh.ray_traverse(bare(ray), &mut hit, |ray, i| leaves[i].intersect(ray));
                }
            }
            black_box(hit);
        }
    }

    /// Finds out whether anything is in the way of every shadow ray.
    fn shadows(&self, rays: &Rays) {
        for (ray, t, from) in &rays.shadow {
            let bare = ObvhsRay::new(ray.origin.into(), ray.direction.into(), 0.0, *t);
            black_box(match self {
                Self::Renderer(accel) => accel.occluded(ray, *t, Some(*from)),
                Self::Binary(bvh, leaves) => {
                    bvh.ray_traverse_miss(bare, |ray, i| leaves[i].intersect(ray))
                }
                Self::Wide(bvh, leaves) => {
                    bvh.ray_traverse_miss(bare, |ray, i| leaves[i].intersect(ray))
                }
            });
        }
    }
}

fn time(replay: impl FnOnce()) -> Duration {
    let start = Instant::now();
    replay();
    start.elapsed()
}

/// The corners of all triangles, in the order of the renderer.
fn corners(scene: &Scene) -> Vec<[Vec3; 3]> {
    let triangles = |mesh: &light_scene::Mesh| {
        (0..mesh.indices.len())
            .map(|i| mesh.triangle(i))
            .collect::<Vec<_>>()
    };
    scene.meshes.iter().flat_map(triangles).collect()
}

fn follow_paths(scene: Scene) -> Result<Rays, Box<dyn core::error::Error>> {
    const VERTICES: u32 = 6;
    let view = View::new(&scene.camera_or_default(), 240, 135)?;
    let world = World::new(scene)?;
    let sampler = BvhLightSampler::new(&world.lights().extents())?;
    let (width, height) = view.resolution();
    let mut rays = Rays::default();
    for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
        let stream = SampleStream::new(0, (x, y), 0);
        let numbers = stream.camera();
        let mut ray = view.ray(Vec2::new(x as f32, y as f32) + numbers.film, numbers.lens);
        let mut from = None;
        for vertex in 0..VERTICES {
            rays.closest.push((ray, from));
            let Some(surface) = world.closest(&ray, from) else {
                break;
            };
            let wo = -ray.direction;
            let numbers = stream.vertex(vertex);
            let scattering = world.scattering(&surface);
            let ctx = world.light_context(&surface, &scattering, wo);
            let choice = sampler.sample(&ctx, numbers.light);
            let light = choice.and_then(|choice| world.lights().get(choice.light));
            let point = stream.light_point(vertex, 0, 1);
            if let Some(li) =
                light.and_then(|light| light.sample_li(&ctx, point, &(), PdfCoverage::Incomplete))
                && scattering.eval(wo, li.wi) != Vec3::ZERO
            {
                let origin = surface.spawn(li.wi).origin;
                let way = li.p_light - origin;
                let t = way.length();
                rays.shadow.push((
                    Ray {
                        origin,
                        direction: way / t,
                    },
                    t * (1.0 - 1e-4),
                    surface.primitive,
                ));
            }
            let Some(sample) = scattering.sample(wo, numbers.lobe, numbers.direction) else {
                break;
            };
            ray = surface.spawn(sample.wi);
            from = Some(surface.primitive);
        }
    }
    Ok(rays)
}
