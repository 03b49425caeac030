//! Direct light on a floor below a glowing ball, a lamp and a sky: light samples and directions of
//! the BSDF, weighted against each other. The loop is `direct`; `mis` shows its two halves apart.
//!
//! `cargo run --release -p lights --example direct_lighting` writes `out/direct_lighting.png`.

use core::error::Error;
use core::f32::consts::FRAC_1_PI;

use lights::bounds::{LightId, LightSampleContext, SampledLight};
use lights::glam::{Affine3A, Vec2, Vec3};
use lights::math::mis::balance;
use lights::math::warp::cosine_hemisphere;
use lights::math::{Frame, fraction};
use lights::media::LatinHypercube;
use lights::samplers::{BvhLightSampler, LightSampler};
use lights::sources::shape::{Shape, ShapeDesc, Sphere};
use lights::sources::*;

mod picture;
type Result<T> = core::result::Result<T, Box<dyn Error>>;

/// The lights, and what rays can hit: the ball.
struct Scene {
    lights: LightSet<Rgb>,
    sampler: BvhLightSampler,
    ball: Sphere,
    ball_id: LightId,
}

/// Two random numbers as a point of `[0, 1)^2`.
fn pair(x: u64, y: u64) -> Vec2 {
    Vec2::new(fraction::to_f32(x), fraction::to_f32(y))
}

/// An estimate of the radiance that a matt surface reflects at `p` with unit normal `n`.
fn direct(s: &Scene, p: Vec3, n: Vec3, albedo: f32, u: [u64; 5]) -> Vec3 {
    let ctx = LightSampleContext::surface(p, n, n);
    let here = s.sampler.at(&ctx, 1);
    // A light, chosen and sampled.
    let sampled = |choice: SampledLight| {
        let light = s.lights.get(choice.light)?;
        let li = light.sample_li(&ctx, pair(u[1], u[2]), &(), PdfCoverage::Complete)?;
        let (cos, pdf) = (li.wi.dot(n).max(0.0), choice.pmf * li.pdf);
        // No direction of the BSDF meets a Dirac light.
        let by_bsdf = f32::from(!light.light_type().is_delta()) * cosine_hemisphere::pdf(cos);
        let l = li.l * (albedo * FRAC_1_PI * cos * balance(pdf, by_bsdf) / pdf);
        (!s.is_blocked(p, li.p_light)).then_some(l)
    };
    // A direction of the BSDF, and the lights that it meets: the ball, or all that is at infinity.
    let w = cosine_hemisphere::sample(pair(u[3], u[4]));
    let wi = Frame::from_z(n).from_local(w);
    let at = s.ball.hit(p, wi);
    let ids = at.map(|_| s.ball_id).into_iter();
    let ids = ids.chain(s.lights.infinite_ids().filter(|_| at.is_none()));
    let met = ids.filter_map(|id| {
        let light = s.lights.get(id)?;
        let l = at.map_or_else(|| light.le(p, wi, &()), |at| light.l(&at, -wi, &()));
        let by_light = here.pmf(id) * light.pdf_li(&ctx, wi, PdfCoverage::Complete);
        Some(l * (albedo * balance(cosine_hemisphere::pdf(w.z), by_light)))
    });
    here.samples(u[0]).filter_map(sampled).chain(met).sum()
}

const CENTER: Vec3 = Vec3::new(0.0, 1.2, 0.0);
const LAMP: Vec3 = Vec3::new(1.5, 0.8, -0.8);
const LAMP_INTENSITY: f32 = 2.0;
const BALL: f32 = 3.0;
const SKY: f32 = 0.1;

impl Scene {
    fn new(radius: f32) -> Result<Self> {
        let mut lights = LightSetBuilder::<Rgb>::new(SceneSphere::new(Vec3::ZERO, 5.0)?);
        let amount = IntensityAmount::Radiometric(LAMP_INTENSITY);
        lights.add(PointLightDesc::new(LAMP, Vec3::ONE, amount))?;
        let sky = RadianceAmount::Radiometric(SKY);
        lights.add(UniformInfiniteLightDesc::new(Vec3::ONE, sky))?;
        let transform = Affine3A::from_translation(CENTER);
        let amount = RadianceAmount::Radiometric(BALL);
        let glow = DiffuseEmissionDesc::new(SurfaceColor::Uniform(Vec3::ONE), amount);
        let shape = ShapeDesc::Sphere { transform, radius };
        let ball = lights.add(AreaLightDesc::new(shape, glow))?;
        let lights = lights.build();
        Ok(Self {
            sampler: BvhLightSampler::new(&lights.extents())?,
            ball: Sphere::new(RigidTransform::new(transform)?, radius)?,
            ball_id: lights.first_id(ball).ok_or("no ball")?,
            lights,
        })
    }

    /// Whether the ball is between two points, their ends left out.
    fn is_blocked(&self, p: Vec3, q: Vec3) -> bool {
        let hit = self.ball.hit(p, (q - p).normalize());
        hit.is_some_and(|at| at.p.distance(p) < 0.999 * q.distance(p))
    }

    /// What a camera sees along a ray from `o`: the ball, the floor y = 0 or the sky.
    fn seen(&self, o: Vec3, w: Vec3, seed: u32) -> Vec3 {
        if self.ball.hit(o, w).is_some() {
            return Vec3::splat(BALL);
        }
        if w.y >= 0.0 {
            return Vec3::splat(SKY);
        }
        let p = o - w * (o.y / w.y);
        self.mean(p * Vec3::new(1.0, 0.0, 1.0), 64, seed)
    }

    /// The mean of `count` estimates on the floor, whose albedo is 0.8.
    fn mean(&self, p: Vec3, count: u32, seed: u32) -> Vec3 {
        let numbers = LatinHypercube::new(count, seed);
        let one = |i| direct(self, p, Vec3::Y, 0.8, numbers.point(i));
        (0..count).map(one).sum::<Vec3>() / count as f32
    }
}

fn main() -> Result<()> {
    let scene = Scene::new(0.5)?;
    picture::save("direct_lighting", [320, 200], |x, y| {
        let at = Vec2::new(x as f32 - 159.5, 99.5 - y as f32) / 200.0;
        let w = Vec3::new(at.x, at.y - 0.25, 1.0).normalize();
        scene.seen(Vec3::new(0.0, 1.8, -4.0), w, y * 320 + x)
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
        let lamp = LAMP_INTENSITY * to_lamp.normalize().y / to_lamp.length_squared();
        let lamp = if is_hidden { 0.0 } else { lamp };
        0.8 * (BALL * share + SKY * (1.0 - share) + lamp * FRAC_1_PI)
    }

    #[test]
    fn means_are_those_of_closed_forms() -> Result<()> {
        for radius in [0.1, 0.5, 1.1] {
            let scene = Scene::new(radius)?;
            // The lamp is behind the largest ball for the last of these points.
            let last = Vec3::new(-0.6, 0.0, 0.3);
            for p in [Vec3::ZERO, Vec3::X, Vec3::new(1.0, 0.0, -2.0), last] {
                let (mean, exact) = (scene.mean(p, 1 << 14, 7).x, exact(radius, p));
                let off = (mean / exact - 1.0).abs();
                assert!(off < 0.01, "{mean}, not {exact}: radius {radius} at {p}");
            }
        }
        Ok(())
    }
}
