//! One of several candidates, kept by what it gives without shadows: what that gains over a single
//! choice of a sampler, which is one candidate, with one shadow ray each.
//!
//! `cargo run --release -p lights --example resampling` prints the variance of estimates over the
//! square of their mean, for the irradiance of a floor under a grating and 2,000 spots.

use core::error::Error;

use lights::bounds::{LightId, LightSampleContext};
use lights::glam::{Affine3A, Quat, Vec2, Vec3};
use lights::math::fraction;
use lights::samplers::{BvhLightSampler, LightSampler, PowerLightSampler};
use lights::sources::*;

type Result<T> = core::result::Result<T, Box<dyn Error>>;

/// Points of the floor that are asked.
const POINTS: u32 = 32;

/// Random numbers: a counter and a hash.
struct Random(u64);

impl Random {
    const fn u64(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ self.0 >> 32).wrapping_mul(0xd6e8_feb8_6659_fd93);
        (z ^ z >> 32).wrapping_mul(0xd6e8_feb8_6659_fd93)
    }

    fn vec3(&mut self) -> Vec3 {
        Vec3::from([(); 3].map(|()| fraction::to_f32(self.u64())))
    }
}

/// Spots of unlike power that point downward, above a grating, above a floor of 20 by 20.
struct Hall {
    lights: LightSet<Rgb>,
    power: PowerLightSampler,
    bvh: BvhLightSampler,
}

impl Hall {
    fn new(count: u32) -> Result<Self> {
        let mut random = Random(1);
        let mut lights = LightSetBuilder::<Rgb>::new(SceneSphere::new(Vec3::ZERO, 30.0)?);
        for _ in 0..count {
            let at = random.vec3() * Vec3::new(20.0, 4.0, 20.0) + Vec3::Y;
            let to = (random.vec3() - Vec3::new(0.5, 1.0, 0.5)).normalize();
            let turn = Quat::from_rotation_arc(Vec3::Z, to);
            let transform = Affine3A::from_rotation_translation(turn, at);
            let amount = IntensityAmount::Radiometric(100f32.powf(random.vec3().x));
            lights.add(SpotLightDesc::new(transform, 1.0, Vec3::ONE, amount))?;
        }
        let lights = lights.build();
        Ok(Self {
            power: PowerLightSampler::new(&lights.powers())?,
            bvh: BvhLightSampler::new(&lights.extents())?,
            lights,
        })
    }

    /// Irradiance of the floor at `p` by a light: without shadows, and with that of the grating,
    /// which stands for a ray. The first is the target: 0 for no light that contributes.
    fn irradiance(&self, p: Vec3, light: LightId) -> [f32; 2] {
        let sample = |light: LightRef<'_, Rgb>| {
            let li = light.sample_li(&floor(p), Vec2::ZERO, &(), PdfCoverage::Complete)?;
            let e = li.l.x * li.wi.y.max(0.0);
            Some([e, if is_blocked(p, li.p_light) { 0.0 } else { e }])
        };
        self.lights.get(light).and_then(sample).unwrap_or_default()
    }

    /// Irradiance at `p` by one light, the one of `count` candidates that is kept.
    fn estimate(&self, by: &dyn LightSampler, p: Vec3, count: u32, random: &mut Random) -> f32 {
        let here = by.at(&floor(p), count);
        let u = random.u64();
        let target = |light| self.irradiance(p, light)[0];
        let kept = here.resampled(u, target, || random.u64());
        let e = kept.value().map_or(0.0, |&id| self.irradiance(p, id)[1]);
        e * kept.contribution_weight()
    }

    /// The mean of estimates over the exact sum, and their variance over its square.
    fn statistics(&self, by: &dyn LightSampler, count: u32, draws: u32) -> [f64; 2] {
        let (mut random, mut sums) = (Random(2), [0.0; 2]);
        for _ in 0..POINTS {
            let p = random.vec3() * Vec3::new(16.0, 0.0, 16.0) + Vec3::new(2.0, 0.0, 2.0);
            let all = self.lights.iter().map(|(id, _)| self.irradiance(p, id)[1]);
            let exact: f64 = all.map(f64::from).sum();
            for _ in 0..draws {
                let x = f64::from(self.estimate(by, p, count, &mut random)) / exact;
                sums = [sums[0] + x, sums[1] + (x - 1.0).powi(2)];
            }
        }
        sums.map(|sum| sum / f64::from(POINTS * draws))
    }

    /// The same by power and by the hierarchy.
    fn row(&self, count: u32, draws: u32) -> [[f64; 2]; 2] {
        let samplers: [&dyn LightSampler; 2] = [&self.power, &self.bvh];
        samplers.map(|by| self.statistics(by, count, draws))
    }
}

/// The receiver: the floor at `p`.
fn floor(p: Vec3) -> LightSampleContext {
    LightSampleContext::surface(p, Vec3::Y, Vec3::Y)
}

/// Whether the grating is between two points: every second bar of 0.2, at a height of 0.5.
fn is_blocked(p: Vec3, q: Vec3) -> bool {
    let x = p.x + (q.x - p.x) * 0.5 / q.y;
    (x / 0.4).rem_euclid(1.0) < 0.5
}

fn main() -> Result<()> {
    let hall = Hall::new(2000)?;
    println!("relative variance | by power | by the hierarchy");
    for count in [1, 4, 16] {
        let [[_, power], [_, bvh]] = hall.row(count, 4000);
        println!("{count:3} candidates    | {power:8.2} | {bvh:8.2}");
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every mean is the exact sum within four standard errors, and candidates pay.
    #[test]
    fn all_estimates_have_one_mean() -> Result<()> {
        let draws = 500;
        let rows = Hall::new(2000).map(|hall| [1, 4, 16].map(|count| hall.row(count, draws)))?;
        for [mean, variance] in rows.into_iter().flatten() {
            let error = (variance / f64::from(POINTS * draws)).sqrt();
            assert!((mean - 1.0).abs() < 4.0 * error, "{mean} in {rows:?}");
        }
        for (alone, of_16) in rows[0].into_iter().zip(rows[2]) {
            assert!(of_16[1] < alone[1], "candidates pay: {rows:?}");
        }
        Ok(())
    }
}
