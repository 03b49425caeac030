//! 90,000 lamps of very different powers: a hierarchy chooses those that matter where one asks.
//!
//! `cargo run --release -p lights --example many_lights` writes `out/many_lights.png`, a plain seen
//! from above: four lights a pixel, chosen alike, by power and by the hierarchy, from left to
//! right.

use core::error::Error;

use lights::bounds::LightSampleContext;
use lights::glam::{Vec2, Vec3};
use lights::media::LatinHypercube;
use lights::samplers::{BvhLightSampler, LightSampler, PowerLightSampler, UniformLightSampler};
use lights::sources::*;

mod picture;
type Result<T> = core::result::Result<T, Box<dyn Error>>;

/// `side * side` lamps a length apart above the plane y = 0, at random heights and powers.
fn lamps(side: u32) -> Result<LightSet<Rgb>> {
    let mut lights = LightSetBuilder::new(SceneSphere::new(Vec3::ZERO, side as f32)?);
    let count = side * side;
    for i in 0..count {
        let [height, power, hue] = LatinHypercube::new(count, 5).point_f32(i);
        let at = Vec2::new((i % side) as f32, (i / side) as f32) - 0.5 * (side - 1) as f32;
        let position = Vec3::new(at.x, 0.2 + height, at.y);
        let color = Vec3::new(1.0, 0.4 + 0.4 * hue, 0.2 + 0.8 * hue);
        // Three orders of magnitude.
        let amount = IntensityAmount::Radiometric(0.001 * 1000f32.powf(power));
        lights.add(PointLightDesc::new(position, color, amount))?;
    }
    Ok(lights.build())
}

/// An estimate of the irradiance of the ground at `p`, by `count` choices of a light.
fn irradiance(
    lights: &LightSet<Rgb>,
    sampler: &dyn LightSampler,
    p: Vec3,
    count: u32,
    u: u64,
) -> Vec3 {
    let ctx = LightSampleContext::surface(p, Vec3::Y, Vec3::Y);
    let here = sampler.at(&ctx, count);
    let mut sum = Vec3::ZERO;
    for choice in here.samples(u) {
        let light = lights.get(choice.light);
        let li = light.and_then(|l| l.sample_li(&ctx, Vec2::ZERO, &(), PdfCoverage::Complete));
        if let Some(li) = li {
            sum += li.l * li.wi.y.max(0.0) / (li.pdf * choice.pmf);
        }
    }
    // Also where a choice came to nothing.
    sum / here.count() as f32
}

/// Samplers from the plainest to the one to use.
fn samplers(lights: &LightSet<Rgb>) -> Result<[Box<dyn LightSampler>; 3]> {
    Ok([
        Box::new(UniformLightSampler::new(u32::try_from(lights.len())?)),
        Box::new(PowerLightSampler::new(&lights.powers())?),
        Box::new(BvhLightSampler::new(&lights.extents())?),
    ])
}

fn main() -> Result<()> {
    let lights = lamps(300)?;
    let samplers = samplers(&lights)?;
    picture::save("many_lights", [600, 200], |x, y| {
        let at = (Vec2::new((x % 200) as f32, y as f32) - 99.5) * 0.1;
        let p = Vec3::new(at.x, 0.0, at.y);
        let [u] = LatinHypercube::new(600 * 200, 6).point(y * 600 + x);
        irradiance(&lights, &*samplers[(x / 200) as usize], p, 4, u)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// All lights at once, as the inverse square of the distance and the cosine say.
    fn exact(lights: &LightSet<Rgb>, p: Vec3) -> f64 {
        let ctx = LightSampleContext::surface(p, Vec3::Y, Vec3::Y);
        let li = |(_, light): (_, LightRef<'_, Rgb>)| {
            let li = light.sample_li(&ctx, Vec2::ZERO, &(), PdfCoverage::Complete)?;
            let to_light = li.p_light - p;
            let intensity = light.phi(&()).x / (4.0 * core::f32::consts::PI);
            Some(f64::from(
                intensity * to_light.y / to_light.length().powi(3),
            ))
        };
        lights.iter().filter_map(li).sum()
    }

    /// All three agree with the sum over all lights, and the hierarchy has a tenth of the others'
    /// variance.
    #[test]
    fn means_agree_and_noise_falls() -> Result<()> {
        let lights = lamps(20)?;
        let samplers = samplers(&lights)?;
        let count = 1 << 15;
        for p in [
            Vec3::ZERO,
            Vec3::new(3.3, 0.0, -4.7),
            Vec3::new(9.0, 0.0, 9.5),
        ] {
            let exact = exact(&lights, p);
            let mut noise = Vec::new();
            for sampler in &samplers {
                let estimates = (0..count).map(|i| {
                    let [u] = LatinHypercube::new(count, 8).point(i);
                    f64::from(irradiance(&lights, &**sampler, p, 1, u).x) / exact
                });
                let (mut mean, mut square) = (0.0, 0.0);
                for estimate in estimates {
                    mean += estimate / f64::from(count);
                    square += (estimate - 1.0).powi(2) / f64::from(count);
                }
                let error = (square / f64::from(count)).sqrt();
                let off = (mean - 1.0).abs();
                assert!(off < 3.0 * error, "{mean} +- {error} of {exact} at {p}");
                noise.push(square);
            }
            let other = noise[0].min(noise[1]);
            assert!(noise[2] < 0.1 * other, "hierarchy last {noise:?} at {p}");
        }
        Ok(())
    }
}
