//! The G-buffer of a scene.

use core::error::Error;
use core::f32::consts::PI;

use light_gpu::light_sources::light_bounds::LightId;
use light_gpu::light_sources::{LightSet, Rgb, SurfacePoint};
use light_math::glam::{Vec2, Vec3};
use light_render::{View, World};
use light_scene::{BuiltinScene, Scene};

/// The lights of the night, and the pixels that see it, four rows each: place, normal, albedo and
/// emission; of a picture of so many columns and rows.
pub fn pixels(
    [width, height]: [u32; 2],
) -> Result<(LightSet<Rgb>, Vec<[f32; 16]>), Box<dyn Error>> {
    let scene = BuiltinScene::Night.load();
    let view = View::new(&scene.camera_or_default(), width, height)?;
    let emitters = emitters(&scene);
    let world = World::new(scene)?;
    let lights = world.lights();
    let pixel = |(x, y): (u32, u32)| {
        let ray = view.ray(Vec2::new(x as f32, y as f32) + 0.5, Vec2::splat(0.5));
        let mut rows = [Vec3::ZERO; 4];
        if let Some(surface) = world.closest(&ray, None) {
            let wo = -ray.direction;
            let n = surface.n * surface.n.dot(wo).signum();
            let albedo = world.scattering(&surface).eval(n, n) * PI;
            let emitter = emitters[surface.primitive.number() as usize];
            let at = SurfacePoint { p: surface.p, n: surface.n, uv: surface.uv };
            let emitted = emitter.and_then(|id| Some(lights.get(id)?.l(&at, wo, &())));
            let albedo = albedo.clamp(Vec3::ZERO, Vec3::ONE);
            rows = [surface.p, n, albedo, emitted.unwrap_or(Vec3::ZERO)];
        } else {
            for id in lights.infinite_ids() {
                let sky = lights.get(id).expect("a light of the set");
                rows[3] += sky.le(ray.origin, ray.direction, &());
            }
        }
        let [p, n, albedo, emitted] = rows.map(|row| row.extend(0.0).to_array());
        let rows = [p, n, albedo, emitted].concat();
        rows.try_into().expect("sixteen numbers")
    };
    let places = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    Ok((lights.clone(), places.map(pixel).collect()))
}

/// The light that each triangle is, in the order of the renderer. Lights of meshes come first, in
/// that order too.
fn emitters(scene: &Scene) -> Vec<Option<LightId>> {
    let mut next = (0..).map(LightId);
    let triangles = scene.meshes.iter().flat_map(|mesh| {
        let is_emissive = scene.is_emissive(mesh.material);
        mesh.indices.iter().map(move |_| is_emissive)
    });
    triangles.map(|is_emissive| is_emissive.then(|| next.next()).flatten()).collect()
}
