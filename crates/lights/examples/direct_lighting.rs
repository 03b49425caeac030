//! Direct light on a floor below a glowing ball, a lamp and a sky: a light is chosen, sampled, and
//! counts if nothing is in the way. `mis` adds directions of the BSDF.
//!
//! `cargo run --release -p lights --example direct_lighting` writes `out/direct_lighting.png`.

use lights::bounds::LightSampleContext;
use lights::glam::{Affine3A, Vec2, Vec3};
use lights::math::fraction;
use lights::media::LatinHypercube;
use lights::samplers::{BvhLightSampler, LightSampler};
use lights::sources::shape::{Shape, ShapeDesc, Sphere};
use lights::sources::*;

mod picture;
type Result<T> = core::result::Result<T, Box<dyn core::error::Error>>;
/// The lights, and what can be in their way: the ball.
struct Scene(LightSet<Rgb>, BvhLightSampler, Sphere);

const CENTER: Vec3 = Vec3::new(0.0, 1.2, 0.0);
const LAMP: Vec3 = Vec3::new(1.5, 0.8, -0.8);
const INTENSITY: f32 = 2.0;
const BALL: f32 = 3.0;
const SKY: f32 = 0.1;

fn scene(radius: f32) -> Result<Scene> {
    let mut lights = LightSetBuilder::<Rgb>::new(SceneSphere::new(Vec3::ZERO, 5.0)?);
    let (intensity, radiance) = (IntensityAmount::Radiometric, RadianceAmount::Radiometric);
    lights.add(PointLightDesc::new(LAMP, Vec3::ONE, intensity(INTENSITY)))?;
    lights.add(UniformInfiniteLightDesc::new(Vec3::ONE, radiance(SKY)))?;
    let transform = Affine3A::from_translation(CENTER);
    let glow = DiffuseEmissionDesc::new(SurfaceColor::Uniform(Vec3::ONE), radiance(BALL));
    let shape = ShapeDesc::Sphere { transform, radius };
    lights.add(AreaLightDesc::new(shape, glow))?;
    let lights = lights.build();
    let sampler = BvhLightSampler::new(&lights.extents())?;
    let ball = Sphere::new(RigidTransform::new(transform)?, radius)?;
    Ok(Scene(lights, sampler, ball))
}

/// An estimate of the irradiance at `p` with unit normal `n`, by one light.
fn direct(Scene(lights, sampler, ball): &Scene, p: Vec3, n: Vec3, u: [u64; 3]) -> Option<Vec3> {
    let ctx = LightSampleContext::surface(p, n, n);
    let choice = sampler.sample(&ctx, u[0])?;
    let u = Vec2::new(fraction::to_f32(u[1]), fraction::to_f32(u[2]));
    let light = lights.get(choice.light)?;
    let li = light.sample_li(&ctx, u, &(), PdfCoverage::Complete)?;
    let hit = ball.hit(p, li.wi);
    let is_hidden = hit.is_some_and(|at| at.p.distance(p) < 0.999 * li.p_light.distance(p));
    (!is_hidden).then_some(li.l * li.wi.dot(n).max(0.0) / (choice.pmf * li.pdf))
}

/// The mean of `count` estimates at a point of the floor.
fn mean(scene: &Scene, p: Vec3, count: u32, seed: u32) -> Vec3 {
    let numbers = LatinHypercube::new(count, seed);
    let one = |i| direct(scene, p, Vec3::Y, numbers.point(i));
    (0..count).filter_map(one).sum::<Vec3>() / count as f32
}

fn main() -> Result<()> {
    let scene = scene(0.5)?;
    picture::save("direct_lighting", [320, 200], |x, y| {
        let p = Vec3::new(x as f32 - 159.5, 0.0, y as f32 - 99.5) / 60.0;
        mean(&scene, p, 64, y * 320 + x) * 0.25
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A ball of radius r at distance d, above the horizon, gives `pi L (r / d)^2 cos`, hides that
    /// much of the sky, and may hide the lamp.
    fn exact(radius: f32, p: Vec3) -> f32 {
        let to_ball = CENTER - p;
        let share = (radius / to_ball.length()).powi(2) * to_ball.normalize().y;
        let to_lamp = LAMP - p;
        let along = to_ball.dot(to_lamp) / to_lamp.length_squared();
        let is_hidden = (along * to_lamp - to_ball).length() < radius;
        let lamp = INTENSITY * to_lamp.normalize().y / to_lamp.length_squared();
        let lamp = if is_hidden { 0.0 } else { lamp };
        core::f32::consts::PI * (BALL * share + SKY * (1.0 - share)) + lamp
    }

    #[test]
    fn means_are_those_of_closed_forms() -> Result<()> {
        for radius in [0.1, 0.5, 1.1] {
            let scene = scene(radius)?;
            // The lamp is behind the largest ball for the last of these points.
            let last = Vec3::new(-0.6, 0.0, 0.3);
            for p in [Vec3::ZERO, Vec3::X, Vec3::new(1.0, 0.0, -2.0), last] {
                let (mean, exact) = (mean(&scene, p, 1 << 14, 7).x, exact(radius, p));
                let off = (mean / exact - 1.0).abs();
                assert!(off < 0.01, "{mean}, not {exact}: radius {radius} at {p}");
            }
        }
        Ok(())
    }
}
