//! A light of your own among those of a set: a lantern whose bars throw a star. It says its
//! intensity by direction (`PointSource`), is a `Light` by that, and joins the hierarchy by its
//! bounds, under ids behind those of the set.
//!
//! `cargo run --release -p lights --example own_light` writes `out/own_light.png`: the ground from
//! above, with lamps of the set and three lanterns.

use core::error::Error;
use core::f32::consts::{FRAC_1_PI, PI};

use lights::bounds::{LightBounds, LightId, LightSampleContext};
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

/// A set, and own lights behind it.
struct Lights {
    set: LightSet<Rgb>,
    own: Vec<Lantern>,
    sampler: BvhLightSampler,
}

impl Lights {
    fn new() -> Result<Self> {
        let mut set = LightSetBuilder::<Rgb>::new(SceneSphere::new(Vec3::ZERO, 10.0)?);
        for x in -4..=4i8 {
            let position = Vec3::new(f32::from(x), 0.5, -3.5);
            let amount = IntensityAmount::Radiometric(0.1);
            set.add(PointLightDesc::new(
                position,
                Vec3::new(1.0, 0.6, 0.3),
                amount,
            ))?;
        }
        let set = set.build();
        let own = [-3.0, 0.0, 3.0].map(|x| Lantern {
            position: Vec3::new(x, 1.0, 1.5 - 0.3 * x),
            mean: Vec3::new(0.4, 0.6, 1.0),
        });
        // The place in this list is the id.
        let mut extents = set.extents();
        extents.extend(own.iter().map(Light::extent));
        Ok(Self {
            set,
            own: own.into(),
            sampler: BvhLightSampler::new(&extents)?,
        })
    }

    /// What `query` answers for a light, be it of the set or own.
    fn with<R>(&self, id: LightId, query: impl FnOnce(&dyn Light<Rgb>) -> R) -> Option<R> {
        match (id.0 as usize).checked_sub(self.set.len()) {
            None => self.set.get(id).map(|light| query(&light)),
            Some(own) => self.own.get(own).map(|light| query(light)),
        }
    }

    /// The mean of `count` estimates of the irradiance of the ground at `p`.
    fn irradiance(&self, p: Vec3, count: u32, u: u64) -> Vec3 {
        let ctx = LightSampleContext::surface(p, Vec3::Y, Vec3::Y);
        let here = self.sampler.at(&ctx, count);
        let mut sum = Vec3::ZERO;
        for choice in here.samples(u) {
            let sample =
                |l: &dyn Light<Rgb>| l.sample_li(&ctx, Vec2::ZERO, &(), PdfCoverage::Complete);
            if let Some(li) = self.with(choice.light, sample).flatten() {
                sum += li.l * li.wi.y.max(0.0) / (li.pdf * choice.pmf);
            }
        }
        sum / count as f32
    }
}

fn main() -> Result<()> {
    let lights = Lights::new()?;
    picture::save("own_light", [256, 256], |x, y| {
        let at = (Vec2::new(x as f32, y as f32) - 127.5) / 25.6;
        let [u] = LatinHypercube::new(256 * 256, 2).point(y * 256 + x);
        lights.irradiance(Vec3::new(at.x, 0.0, at.y), 32, u)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use lights::math::fraction;

    impl Lights {
        /// A ray of some light, and its power in W.
        fn emit(&self, u: u64, v: [f32; 4]) -> Option<(EmittedRay, Vec3)> {
            let choice = self.sampler.sample_emitter(u)?;
            let sample =
                |l: &dyn Light<Rgb>| l.sample_le(Vec2::new(v[0], v[1]), Vec2::new(v[2], v[3]), &());
            let LightLeSample { l, ray, pdf } = self.with(choice.light, sample).flatten()?;
            Some((ray, l / (pdf.pos * pdf.dir * choice.pmf)))
        }
    }

    /// Estimates have the mean of the inverse square law over all lights, and choices of own lights
    /// have the probabilities that the sampler states.
    #[test]
    fn own_lights_are_chosen_and_counted() -> Result<()> {
        let lights = Lights::new()?;
        for p in [
            Vec3::ZERO,
            Vec3::new(2.0, 0.0, 1.0),
            Vec3::new(-1.0, 0.0, -3.0),
        ] {
            let mut exact = Vec3::ZERO;
            for (_, light) in lights.set.iter() {
                let LightRef::Point(lamp) = light else {
                    continue;
                };
                let to_light = PointSource::position(lamp) - p;
                exact += light.phi(&()) * (to_light.y / to_light.length().powi(3) / (4.0 * PI));
            }
            for Lantern { position, mean } in &lights.own {
                let to_light = *position - p;
                // The cosine of the sixfold angle by the polynomial of Chebyshev.
                let z = to_light.z / to_light.x.hypot(to_light.z);
                let cos_6a = 32.0 * z.powi(6) - 48.0 * z.powi(4) + 18.0 * z * z - 1.0;
                exact += mean * (1.0 + cos_6a) * (to_light.y / to_light.length().powi(3));
            }
            let mean = lights.irradiance(p, 1 << 14, 1 << 63);
            let off = (mean / exact - 1.0).abs().max_element();
            assert!(off < 0.01, "{mean}, not {exact}, at {p}");
        }
        Ok(())
    }

    /// Emitted rays carry the power of both kinds, which splits by the sign of z in halves.
    #[test]
    fn rays_carry_all_power() -> Result<()> {
        let (lights, count) = (Lights::new()?, 1 << 16);
        let mut halves = [Vec3::ZERO; 2];
        for i in 0..count {
            let [u, a, b, c, d] = LatinHypercube::new(count, 4).point(i);
            if let Some((ray, watts)) = lights.emit(u, [a, b, c, d].map(fraction::to_f32)) {
                halves[usize::from(ray.direction.z < 0.0)] += watts / count as f32;
            }
        }
        let own = lights.own.iter().map(|light| light.mean).sum::<Vec3>();
        let set = Vec3::new(1.0, 0.6, 0.3) * (0.1 * lights.set.len() as f32);
        let half = (own + set) * (2.0 * PI);
        for found in halves {
            let off = (found / half - 1.0).abs().max_element();
            assert!(off < 0.01, "{found}, not {half}");
        }
        Ok(())
    }
}
