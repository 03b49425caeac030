//! How far directional lights from a median cut are from image importance sampling, on the sky that
//! ships and on given lat-long images: the table of `docs/light-sources.md`.
//! `cargo xtask median-cut-table [IMAGE...]`.
//!
//! What is estimated is the unshadowed irradiance of 64 normals, against the exact integral over
//! the same equal-area image.

use core::error::Error;
use std::path::{Path, PathBuf};
use std::time::Instant;

use benches::page::{root, write_table};
use light_testkit::Rng;
use lights::bounds::LightSampleContext;
use lights::glam::{Affine3A, DVec3, Vec2, Vec3};
use lights::math::SphereMap;
use lights::math::equal_area::square_to_sphere;
use lights::samplers::{LightSampler, PowerLightSampler};
use lights::sources::{
    Centroid, EnvironmentMap, Image, ImageInfiniteLight, ImageInfiniteLightDesc, Light, LightDesc,
    LightSet, LightSetBuilder, MedianCut, MedianCutLight, PdfCoverage, RadianceAmount, RegionSums,
    Rgb, SceneSphere, equal_area_size,
};

const PAGE: &str = "docs/light-sources.md";

const HEADER: &str = "\
| map | lights | ready, ms | pyramid | ns a sample | bias^2 | squared centroid | pyramid | \
variance | 16 samples | 64 | 256 | 1024 |
| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |
";

const NORMALS: u32 = 64;
const TRIALS: u32 = 64;
const LIGHTS: [usize; 4] = [16, 64, 256, 1024];
const SAMPLES: [u32; 4] = [16, 64, 256, 1024];

type Failure = Box<dyn Error>;

/// An equal-area image, and the irradiance that it gives some normals.
struct Sky {
    image: Image,
    exact: Vec<(Vec3, f64)>,
}

/// Errors relative to the exact irradiance, means over the normals.
struct Errors {
    variance: f64,
    mse: [f64; SAMPLES.len()],
    ns_per_sample: f64,
}

fn main() -> Result<(), Failure> {
    let mut table = HEADER.to_owned();
    let shipped = root().join("crates/light-scene/assets/sky.exr");
    let given = std::env::args_os().skip(1).map(PathBuf::from);
    for path in core::iter::once(shipped).chain(given) {
        let name = path.file_stem().unwrap_or_default().to_string_lossy();
        let sky = Sky::read(&path)?;
        table += &image_row(&name, &sky)?;
        for n in LIGHTS {
            table += &median_cut_row(&name, &sky, n)?;
        }
    }
    write_table(PAGE, "median-cut-table", &table)?;
    print!("{table}");
    Ok(())
}

fn image_row(name: &str, sky: &Sky) -> Result<String, Failure> {
    let build = || {
        let desc = ImageInfiniteLightDesc {
            transform: Affine3A::IDENTITY,
            map: EnvironmentMap::EqualArea(sky.image.clone()),
            amount: RadianceAmount::Radiometric(1.0),
        };
        ImageInfiniteLight::<Rgb>::new(desc, scene())
    };
    let (ms, light) = timed(build);
    let light = light?;
    let errors = sky.errors(|rng, ctx| {
        let u = rng.vec2();
        light
            .sample_li(ctx, u, &(), PdfCoverage::Complete)
            .map_or(0.0, |s| {
                f64::from(luminance(s.l) * cosine(ctx, s.wi) / s.pdf)
            })
    });
    Ok(format!(
        "| {name} | image | {ms:.1} | | {}\n",
        row(&errors, "0 | |")
    ))
}

fn median_cut_row(name: &str, sky: &Sky, n: usize) -> Result<String, Failure> {
    let cut = |sums, centroid| {
        timed(|| MedianCut::new(sky.image.clone(), SphereMap::EqualArea, sums)?.lights(n, centroid))
    };
    let lights = |lights: Vec<MedianCutLight>| -> Result<LightSet<Rgb>, Failure> {
        let mut builder = LightSetBuilder::new(scene());
        for light in lights {
            builder.add(LightDesc::Distant(light.into()))?;
        }
        Ok(builder.build())
    };
    let (ms, table) = cut(RegionSums::Table, Centroid::Luminance);
    let (pyramid_ms, pyramid) = cut(RegionSums::Pyramid, Centroid::Luminance);
    let (_, squared) = cut(RegionSums::Table, Centroid::SquaredLuminance);
    let set = lights(table?)?;
    let [squared, pyramid] = [lights(squared?)?, lights(pyramid?)?];
    let sampler = PowerLightSampler::new(&set.powers())?;
    let errors = sky.errors(|rng, ctx| {
        let chosen = sampler.sample(ctx, rng.u64());
        let chosen = chosen.and_then(|s| set.get(s.light).map(|light| (light, s.pmf)));
        chosen.map_or(0.0, |(light, pmf)| {
            let sample = light.sample_li(ctx, Vec2::ZERO, &(), PdfCoverage::Complete);
            sample.map_or(0.0, |s| {
                f64::from(luminance(s.l) * cosine(ctx, s.wi) / (s.pdf * pmf))
            })
        })
    });
    let bias = format!(
        "{:.1e} | {:.1e} | {:.1e}",
        sky.bias_sq(&set),
        sky.bias_sq(&squared),
        sky.bias_sq(&pyramid)
    );
    Ok(format!(
        "| {name} | {n} | {ms:.1} | {pyramid_ms:.1} | {}\n",
        row(&errors, &bias)
    ))
}

impl Sky {
    /// Reads a lat-long image and makes it an equal-area one.
    fn read(path: &Path) -> Result<Self, Failure> {
        let file = light_scene::read_image(path).map_err(|error| error.to_string())?;
        let n = equal_area_size(file.image.height());
        let image = file.image.to_light()?;
        let image = image.resampled(SphereMap::LatLong, SphereMap::EqualArea, [n, n])?;
        let exact = (0..NORMALS).map(normal);
        let exact = exact
            .map(|normal| (normal, irradiance(&image, normal)))
            .collect();
        Ok(Self { image, exact })
    }

    /// What an estimator of one sample gives, over all normals and several numbers of samples.
    fn errors(&self, mut estimate: impl FnMut(&mut Rng, &LightSampleContext) -> f64) -> Errors {
        let mut rng = Rng::new(7);
        let (mut variance, mut mse) = (0.0, [0.0; SAMPLES.len()]);
        let start = Instant::now();
        for &(normal, exact) in &self.exact {
            let ctx = LightSampleContext::surface(Vec3::ZERO, normal, normal);
            let (mut sum, mut squares, mut count) = (0.0, 0.0, 0.0);
            for (mse, samples) in mse.iter_mut().zip(SAMPLES) {
                for _ in 0..TRIALS {
                    let mut mean = 0.0;
                    for _ in 0..samples {
                        let value = estimate(&mut rng, &ctx) / exact;
                        mean += value / f64::from(samples);
                        (sum, squares, count) = (sum + value, squares + value * value, count + 1.0);
                    }
                    *mse += (mean - 1.0).powi(2) / f64::from(TRIALS * NORMALS);
                }
            }
            variance += (squares / count - (sum / count).powi(2)) / f64::from(NORMALS);
        }
        let draws = NORMALS * TRIALS * SAMPLES.iter().sum::<u32>();
        Errors {
            variance,
            mse,
            ns_per_sample: start.elapsed().as_secs_f64() * 1e9 / f64::from(draws),
        }
    }

    /// What is left of the error when all lights are used.
    fn bias_sq(&self, set: &LightSet<Rgb>) -> f64 {
        let error = |&(normal, exact): &(Vec3, f64)| {
            let ctx = LightSampleContext::surface(Vec3::ZERO, normal, normal);
            let samples = set.iter().filter_map(|(_, light)| {
                light.sample_li(&ctx, Vec2::ZERO, &(), PdfCoverage::Complete)
            });
            let sum: f64 = samples
                .map(|s| f64::from(luminance(s.l)) * f64::from(s.wi.dot(normal).max(0.0)))
                .sum();
            (sum / exact - 1.0).powi(2)
        };
        self.exact.iter().map(error).sum::<f64>() / f64::from(NORMALS)
    }
}

/// What of the light from `wi` arrives at a surface.
fn cosine(ctx: &LightSampleContext, wi: Vec3) -> f32 {
    ctx.ns().map_or(1.0, |ns| ns.dot(wi).max(0.0))
}

fn row(errors: &Errors, bias: &str) -> String {
    let mse: Vec<String> = errors.mse.iter().map(|mse| format!("{mse:.1e}")).collect();
    format!(
        "{:.0} | {bias} | {:.2} | {} |",
        errors.ns_per_sample,
        errors.variance,
        mse.join(" | ")
    )
}

/// The irradiance of a surface: each texel through four directions.
fn irradiance(image: &Image, normal: Vec3) -> f64 {
    let n = image.size()[0];
    let normal = normal.as_dvec3();
    let mut sum = 0.0;
    for (y, x) in (0..2 * n).flat_map(|y| (0..2 * n).map(move |x| (y, x))) {
        let p = (Vec2::new(x as f32, y as f32) + 0.5) / (2 * n) as f32;
        let cosine = DVec3::from(square_to_sphere(p)).dot(normal).max(0.0);
        sum += cosine * f64::from(luminance(image.texel(x / 2, y / 2)));
    }
    sum * 4.0 * core::f64::consts::PI / (4.0 * f64::from(n) * f64::from(n))
}

/// Normal `i` of a spiral that covers the sphere evenly.
fn normal(i: u32) -> Vec3 {
    let z = 1.0 - (2.0 * i as f32 + 1.0) / NORMALS as f32;
    let (sin, cos) = (i as f32 * 2.399_963).sin_cos();
    let r = (1.0 - z * z).sqrt();
    Vec3::new(r * cos, r * sin, z).normalize()
}

fn luminance(rgb: Vec3) -> f32 {
    rgb.dot(Vec3::new(0.2125, 0.7154, 0.0721))
}

/// The least of five times, in ms, and a result.
fn timed<T>(mut f: impl FnMut() -> T) -> (f64, T) {
    let mut run = || {
        let start = Instant::now();
        let result = f();
        (start.elapsed().as_secs_f64() * 1e3, result)
    };
    let mut best = run();
    for _ in 0..4 {
        let next = run();
        best = if next.0 < best.0 { next } else { best };
    }
    best
}

fn scene() -> SceneSphere {
    SceneSphere::new(Vec3::ZERO, 1.0).expect("a sphere")
}
