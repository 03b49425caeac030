//! A light of your own in a set: a lantern whose bars throw a star. It says its intensity by
//! direction (`PointSource`), is a `Light` by that, and joins the lamps of a `LightSet` as an
//! `OwnLight`: set, hierarchy and integrators treat it as they treat the others.
//!
//! `cargo run --release -p lights --example own_light` writes `out/own_light.png`: the ground from
//! above, with nine lamps and three lanterns.

extern crate alloc;

use alloc::sync::Arc;
use core::error::Error;
use core::f32::consts::{FRAC_1_PI, PI};

use lights::bounds::{LightBounds, LightSampleContext};
use lights::glam::{Vec2, Vec3};
use lights::math::Aabb;
use lights::math::warp::uniform_sphere;
use lights::media::LatinHypercube;
use lights::samplers::{BvhLightSampler, LightSampler};
use lights::sources::*;

mod picture;

type Result<T> = core::result::Result<T, Box<dyn Error>>;

/// A lantern with six openings: its intensity is `mean * (1 + cos(6 a))` W/sr at the angle `a`
/// around the y axis.
struct Lantern {
    position: Vec3,
    mean: Vec3,
}

impl PointSource for Lantern {
    type Color = Rgb;

    fn position(&self) -> Vec3 {
        self.position
    }

    fn intensity(&self, w: Vec3, (): &()) -> Vec3 {
        self.mean * (1.0 + (6.0 * w.x.atan2(w.z)).cos())
    }

    fn power(&self, (): &()) -> Vec3 {
        self.mean * (4.0 * PI)
    }

    fn sample_direction(&self, u1: Vec2, _u2: Vec2, (): &()) -> Option<DirectionSample<Vec3>> {
        let w = uniform_sphere::sample(u1);
        let intensity = self.intensity(w, &());
        let pdf = self.direction_pdf(w);
        Some(DirectionSample { w, intensity, pdf })
    }

    fn direction_pdf(&self, _w: Vec3) -> f32 {
        0.25 * FRAC_1_PI
    }

    /// All directions; the power as if it emitted in all of them as in the brightest, so that no
    /// place gets more light than the hierarchy expects.
    fn point_bounds(&self) -> LightBounds {
        LightBounds {
            bounds: Aabb::from_point(self.position),
            w: Vec3::Y,
            phi: 4.0 * PI * 2.0 * self.mean.max_element(),
            cos_theta_o: -1.0,
            cos_theta_e: 0.0,
            two_sided: false,
        }
    }

    fn surroundings(&self) -> MediumInterface {
        MediumInterface::default()
    }
}

/// The colour of a lamp.
const LAMP: Vec3 = Vec3::new(1.0, 0.6, 0.3);

/// Where the lanterns hang.
const LANTERNS: [Vec3; 3] = [
    Vec3::new(-3.0, 1.0, 2.4),
    Vec3::new(0.0, 1.0, 1.5),
    Vec3::new(3.0, 1.0, 0.6),
];

/// Their mean intensity in W/sr.
const MEAN: Vec3 = Vec3::new(0.4, 0.6, 1.0);

fn lights() -> Result<LightSet<Rgb>> {
    let mut lights = LightSetBuilder::<Rgb>::new(SceneSphere::new(Vec3::ZERO, 10.0)?);
    for x in -4..=4i8 {
        let position = Vec3::new(f32::from(x), 0.5, -3.5);
        let (color, amount) = (LAMP, IntensityAmount::Radiometric(0.1));
        lights.add(PointLightDesc::new(position, color, amount))?;
    }
    for position in LANTERNS {
        let lantern = Lantern {
            position,
            mean: MEAN,
        };
        // No ray finds a point. Surfaces are an `OwnLight::Area`, skies an `OwnLight::Infinite`.
        lights.add(OwnLight::Delta(Arc::new(lantern)))?;
    }
    Ok(lights.build())
}

/// The mean of `count` estimates of the irradiance of the ground at `p`.
fn irradiance(
    lights: &LightSet<Rgb>,
    sampler: &BvhLightSampler,
    p: Vec3,
    count: u32,
    u: u64,
) -> Vec3 {
    let ctx = LightSampleContext::surface(p, Vec3::Y, Vec3::Y);
    let mut sum = Vec3::ZERO;
    for choice in sampler.at(&ctx, count).samples(u) {
        let light = lights.get(choice.light);
        let sample = light.and_then(|l| l.sample_li(&ctx, Vec2::ZERO, &(), PdfCoverage::Complete));
        if let Some(li) = sample {
            sum += li.l * li.wi.y.max(0.0) / (li.pdf * choice.pmf);
        }
    }
    sum / count as f32
}

fn main() -> Result<()> {
    let lights = lights()?;
    let sampler = BvhLightSampler::new(&lights.extents())?;
    picture::save("own_light", [256, 256], |x, y| {
        let at = (Vec2::new(x as f32, y as f32) - 127.5) / 25.6;
        let [u] = LatinHypercube::new(256 * 256, 2).point(y * 256 + x);
        irradiance(&lights, &sampler, Vec3::new(at.x, 0.0, at.y), 32, u)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use lights::math::fraction;

    /// Estimates have the mean of the inverse square law over all lights, and choices of own lights
    /// have the probabilities that the sampler states.
    #[test]
    fn own_lights_are_chosen_and_counted() -> Result<()> {
        let lights = lights()?;
        let sampler = BvhLightSampler::new(&lights.extents())?;
        for p in [
            Vec3::ZERO,
            Vec3::new(2.0, 0.0, 1.0),
            Vec3::new(-1.0, 0.0, -3.0),
        ] {
            let mut exact = Vec3::ZERO;
            for (_, light) in lights.iter() {
                let LightRef::Point(lamp) = light else {
                    continue;
                };
                let to_light = PointSource::position(lamp) - p;
                exact += light.phi(&()) * (to_light.y / to_light.length().powi(3) / (4.0 * PI));
            }
            for position in LANTERNS {
                let to_light = position - p;
                // The cosine of the sixfold angle by the polynomial of Chebyshev.
                let z = to_light.z / to_light.x.hypot(to_light.z);
                let cos_6a = 32.0 * z.powi(6) - 48.0 * z.powi(4) + 18.0 * z * z - 1.0;
                exact += MEAN * (1.0 + cos_6a) * (to_light.y / to_light.length().powi(3));
            }
            let mean = irradiance(&lights, &sampler, p, 1 << 14, 1 << 63);
            let off = (mean / exact - 1.0).abs().max_element();
            assert!(off < 0.01, "{mean}, not {exact}, at {p}");
        }
        Ok(())
    }

    /// Emitted rays carry the power of both kinds, which splits by the sign of z in halves; and
    /// each light states its power.
    #[test]
    fn rays_carry_all_power() -> Result<()> {
        let (lights, count) = (lights()?, 1 << 16);
        let sampler = BvhLightSampler::new(&lights.extents())?;
        let mut halves = [Vec3::ZERO; 2];
        for i in 0..count {
            let [u, a, b, c, d] = LatinHypercube::new(count, 4).point(i);
            let [a, b, c, d] = [a, b, c, d].map(fraction::to_f32);
            let choice = sampler.sample_emitter(u).ok_or("no light")?;
            let light = lights.get(choice.light).ok_or("no such light")?;
            if let Some(le) = light.sample_le(Vec2::new(a, b), Vec2::new(c, d), &()) {
                let watts = le.l / (le.pdf.pos * le.pdf.dir * choice.pmf);
                halves[usize::from(le.ray.direction.z < 0.0)] += watts / count as f32;
            }
        }
        let lanterns = MEAN * LANTERNS.len() as f32;
        let lamps = LAMP * (0.1 * (lights.len() - LANTERNS.len()) as f32);
        let half = (lanterns + lamps) * (2.0 * PI);
        let stated = lights.iter().map(|(_, light)| light.phi(&()));
        let off = (stated.sum::<Vec3>() / (2.0 * half) - 1.0).abs();
        assert!(off.max_element() < 1e-5, "{off} of twice {half}");
        for found in halves {
            let off = (found / half - 1.0).abs().max_element();
            assert!(off < 0.01, "{found}, not {half}");
        }
        Ok(())
    }
}
