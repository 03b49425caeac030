//! Direct light by two strategies, weighted against each other: sample a light, or follow the BSDF
//! and ask with which probability light sampling would have found what the ray hits.
//!
//! `cargo run --release -p lights --example mis` writes `out/mis.png`: a section of the room below
//! a large panel, with a lamp and a sky, where each pixel is a matt surface that faces up; its left
//! half by light samples alone, its right half by both. It prints the mean and the deviation of one
//! sample at some heights.

use core::error::Error;
use core::f32::consts::FRAC_1_PI;

use lights::bounds::{LightId, LightSampleContext};
use lights::glam::{Vec2, Vec3};
use lights::math::mis::balance;
use lights::math::warp::cosine_hemisphere as bsdf;
use lights::math::{Frame, fraction};
use lights::media::LatinHypercube;
use lights::samplers::{BvhLightSampler, LightSampler};
use lights::sources::shape::{Shape, Triangle};
use lights::sources::*;

mod picture;
type Result<T> = core::result::Result<T, Box<dyn Error>>;

/// What an estimator is given: the lights, and where rays hit them.
struct Scene {
    lights: LightSet<Rgb>,
    sampler: BvhLightSampler,
    /// The emissive mesh, and its triangles for rays.
    panel: SourceId,
    triangles: Vec<Triangle>,
}

/// The random numbers of one estimate: a fraction of 2^64, and points of `[0, 1)^2`.
struct Uniforms {
    choice: u64,
    light: Vec2,
    bsdf: Vec2,
}

impl From<[u64; 5]> for Uniforms {
    fn from([choice, a, b, c, d]: [u64; 5]) -> Self {
        let pair = |x, y| Vec2::new(fraction::to_f32(x), fraction::to_f32(y));
        Self {
            choice,
            light: pair(a, b),
            bsdf: pair(c, d),
        }
    }
}

/// The value of the BSDF: a matt floor.
const BSDF: f32 = 0.8 * FRAC_1_PI;

/// Reflected radiance at `p` with normal `n`, from one light that is sampled. `weight` gets the
/// density of this sample and that of the BSDF, which never finds a Dirac light.
fn by_light(s: &Scene, p: Vec3, n: Vec3, u: &Uniforms, weight: Weight) -> Option<Vec3> {
    let ctx = LightSampleContext::surface(p, n, n);
    let choice = s.sampler.sample(&ctx, u.choice)?;
    let light = s.lights.get(choice.light)?;
    let li = light.sample_li(&ctx, u.light, &(), PdfCoverage::Complete)?;
    let cos_theta = li.wi.dot(n);
    let is_lit = cos_theta > 0.0 && !s.is_blocked(p, li.p_light);
    let pdf = choice.pmf * li.pdf;
    let is_delta = light.light_type().is_delta();
    let other = if is_delta { 0.0 } else { bsdf::pdf(cos_theta) };
    is_lit.then(|| li.l * (BSDF * cos_theta * weight(pdf, other) / pdf))
}

/// The same from a direction of the BSDF: from the hit to the id of its light, to the probability
/// of that light, to the weight.
fn by_bsdf(s: &Scene, p: Vec3, n: Vec3, u: &Uniforms, weight: Weight) -> Vec3 {
    let ctx = LightSampleContext::surface(p, n, n);
    let w = bsdf::sample(u.bsdf);
    let (wi, pdf) = (Frame::from_z(n).from_local(w), bsdf::pdf(w.z));
    let hit = s.hit(p, wi);
    let from = |id: LightId| {
        let light = s.lights.get(id)?;
        let l = hit.map_or_else(|| light.le(p, wi, &()), |(_, at)| light.l(&at, -wi, &()));
        let other = s.sampler.pmf(&ctx, id) * light.pdf_li(&ctx, wi, PdfCoverage::Complete);
        Some(l * (BSDF * w.z * weight(pdf, other) / pdf))
    };
    let Some((triangle, _)) = hit else {
        return s.lights.infinite_ids().filter_map(from).sum();
    };
    let id = s.lights.id_of(s.panel, triangle);
    id.and_then(from).unwrap_or_default()
}

/// The weight of a sample by its density and that of the other strategy.
type Weight = fn(f32, f32) -> f32;

impl Scene {
    fn new() -> Result<Self> {
        let corner = |x: f32, z: f32| Vec3::new(x, 1.0, z);
        let corners = [
            corner(-1.0, -1.0),
            corner(1.0, -1.0),
            corner(1.0, 1.0),
            corner(-1.0, 1.0),
        ];
        let indices = vec![[0, 1, 2], [0, 2, 3]];
        let shapes = indices.iter().map(|ids: &[u32; 3]| {
            let vertices = ids.map(|i| corners[i as usize]);
            Triangle::new(vertices, Triangle::DEFAULT_UV)
        });
        let triangles = shapes.collect::<core::result::Result<_, _>>()?;
        let radiance = RadianceAmount::Radiometric(1.0);
        let emission = DiffuseEmissionDesc::new(SurfaceColor::Uniform(Vec3::ONE), radiance);

        let mut lights = LightSetBuilder::<Rgb>::new(SceneSphere::new(Vec3::ZERO, 3.0)?);
        let lamp = IntensityAmount::Radiometric(0.1);
        lights.add(PointLightDesc::new(Vec3::new(0.3, 0.5, 0.3), Vec3::X, lamp))?;
        let panel = lights.add(MeshLightDesc::new(corners, indices, emission))?;
        let sky = RadianceAmount::Radiometric(0.5);
        lights.add(UniformInfiniteLightDesc::new(Vec3::Z, sky))?;
        let lights = lights.build();
        Ok(Self {
            sampler: BvhLightSampler::new(&lights.extents())?,
            lights,
            panel,
            triangles,
        })
    }

    /// The first triangle that a ray hits, and where.
    fn hit(&self, p: Vec3, w: Vec3) -> Option<(u32, SurfacePoint)> {
        let hit = |(k, triangle): (u32, &Triangle)| Some((k, triangle.hit(p, w)?));
        (0..).zip(&self.triangles).find_map(hit)
    }

    /// Whether something is between two points, their ends left out.
    fn is_blocked(&self, p: Vec3, q: Vec3) -> bool {
        let hit = self.hit(p, (q - p).normalize());
        hit.is_some_and(|(_, at)| at.p.distance(p) < 0.999 * q.distance(p))
    }
}

/// Mean and standard deviation of the channels' average.
fn statistics(values: impl Iterator<Item = Vec3>) -> (f64, f64) {
    let (mut count, mut sum, mut squares) = (0.0, 0.0, 0.0);
    for value in values {
        let value = f64::from(value.element_sum() / 3.0);
        (count, sum, squares) = (count + 1.0, sum + value, squares + value * value);
    }
    let mean = sum / count;
    (mean, (squares / count - mean * mean).max(0.0).sqrt())
}

/// The numbers of estimate `i`: a sequence of low discrepancy in five dimensions, by powers of the
/// root of `x^6 = x + 1`.
#[expect(
    clippy::cast_possible_truncation,
    reason = "rounding up to 1 is undone"
)]
fn uniforms(i: u32) -> Uniforms {
    let part = |k: i32| (f64::from(i) * 1.134_724_138_401_519_5_f64.powi(-k)).fract();
    let pair = |k: i32| Vec2::new(part(k) as f32, part(k + 1) as f32);
    Uniforms {
        choice: fraction::from_f64(part(1)),
        light: pair(2).min(Vec2::splat(1.0 - f32::EPSILON)),
        bsdf: pair(4).min(Vec2::splat(1.0 - f32::EPSILON)),
    }
}

/// An estimate for a surface at `p` that faces up, by a light sample alone.
fn light_alone(scene: &Scene, p: Vec3, u: &Uniforms) -> Vec3 {
    by_light(scene, p, Vec3::Y, u, |_, _| 1.0).unwrap_or_default()
}

/// The same by both, weighted against each other.
fn both(scene: &Scene, p: Vec3, u: &Uniforms) -> Vec3 {
    let light = by_light(scene, p, Vec3::Y, u, balance).unwrap_or_default();
    light + by_bsdf(scene, p, Vec3::Y, u, balance)
}

/// Mean and deviation at a place: by light samples alone, then by both.
fn estimates(scene: &Scene, p: Vec3, count: u32) -> [(f64, f64); 2] {
    [light_alone, both].map(|by| statistics((0..count).map(|i| by(scene, p, &uniforms(i)))))
}

fn main() -> Result<()> {
    let scene = Scene::new()?;
    for height in [0.0, 0.5, 0.9, 0.99] {
        let [light, both] = estimates(&scene, Vec3::new(0.0, height, 0.0), 1 << 16);
        println!("{:.2} below the panel:", 1.0 - height);
        println!(
            "    light samples alone {:.4}, deviation {:.3}",
            light.0, light.1
        );
        println!(
            "    both, weighted      {:.4}, deviation {:.3}",
            both.0, both.1
        );
    }
    picture::save("mis", [320, 160], |x, y| {
        let p = Vec3::new(x as f32 - 159.5, 159.5 - y as f32, 0.0) / 160.0;
        let by = if x < 160 { light_alone } else { both };
        let numbers = LatinHypercube::new(SAMPLES, 320 * y + x);
        let one = |i| by(&scene, p, &numbers.point(i).into());
        (0..SAMPLES).map(one).sum::<Vec3>() / (SAMPLES as f32 / EXPOSURE)
    })
}

/// The light that is white in the picture is 1 over this.
const EXPOSURE: f32 = 0.7;

/// Estimates a pixel.
const SAMPLES: u32 = 8;

#[cfg(test)]
mod tests {
    use super::*;

    /// Below the middle of the panel, a square of half side 1 at height 1, in closed form: what it
    /// sends, what it leaves of the sky, and the lamp.
    #[test]
    fn means_are_those_of_closed_forms() -> Result<()> {
        let scene = Scene::new()?;
        for height in [0.0, 0.3] {
            let p = Vec3::Y * height;
            let a = 1.0 / (1.0 - height);
            let root = (1.0 + a * a).sqrt();
            let panel = 4.0 * a / root * (a / root).atan();
            let to_lamp = Vec3::new(0.3, 0.5, 0.3) - p;
            let lamp = 0.1 * to_lamp.y / to_lamp.length().powi(3);
            // Lamp and sky have one of three colours.
            let sky = 0.5 * (core::f32::consts::PI - panel);
            let exact = f64::from(0.8 * FRAC_1_PI * (panel + (sky + lamp) / 3.0));
            for (mean, _) in estimates(&scene, p, 1 << 14) {
                let off = (mean / exact - 1.0).abs();
                assert!(off < 0.01, "{mean}, not {exact}, at {p}");
            }
        }
        Ok(())
    }

    /// Both means agree within four standard errors, and weighting never costs much.
    #[test]
    fn both_estimates_have_one_mean() -> Result<()> {
        let scene = Scene::new()?;
        let count = 1 << 14;
        for p in [
            Vec3::ZERO,
            Vec3::new(0.7, 0.9, 0.2),
            Vec3::new(1.5, 0.3, 0.0),
        ] {
            let [light, both] = estimates(&scene, p, count);
            let error = (light.1.powi(2) + both.1.powi(2)).sqrt() / f64::from(count).sqrt();
            let off = (light.0 - both.0).abs();
            assert!(
                off < 4.0 * error,
                "{light:?} by lights, {both:?} by both, at {p}"
            );
        }
        Ok(())
    }
}
