//! Light of a sky picture: texels are sampled as they are, a sun of one texel among them, and with
//! directions of the BSDF beside them those of little light may be left out.
//!
//! `cargo run --release -p lights --example environment` writes `out/environment.png`: a matt ball
//! under the sky, its left half by samples of the sky alone, its right half by both.

use core::error::Error;
use core::f32::consts::PI;

use lights::bounds::LightSampleContext;
use lights::glam::{Vec2, Vec3};
use lights::math::warp::cosine_hemisphere;
use lights::math::{Frame, mis};
use lights::media::LatinHypercube;
use lights::sources::*;

mod picture;
type Result<T> = core::result::Result<T, Box<dyn Error>>;

/// Texels of a row; half as many rows.
const WIDTH: u32 = 64;
/// Column and row of the sun.
const SUN: [u32; 2] = [39, 9];

/// Blue above, bright along the horizon, brown below, and a sun of one texel. Row 0 is the top.
fn texel(x: u32, y: u32) -> Vec3 {
    let height = 1.0 - (y as f32 + 0.5) / (WIDTH / 4) as f32;
    let glow = (-8.0 * height.abs()).exp();
    let base = if height > 0.0 {
        Vec3::new(0.08, 0.16, 0.35)
    } else {
        Vec3::new(0.06, 0.05, 0.04)
    };
    let sun = if [x, y] == SUN { 150.0 } else { 0.0 };
    base + Vec3::new(0.5, 0.45, 0.4) * glow + Vec3::new(1.0, 0.9, 0.7) * sun
}

fn sky() -> Result<ImageInfiniteLight<Rgb>> {
    let texels = (0..WIDTH / 2).flat_map(|y| (0..WIDTH).flat_map(move |x| texel(x, y).to_array()));
    let size = [WIDTH, WIDTH / 2];
    let image = Image::from_f32(size, Channels::Rgb, texels.collect::<Vec<f32>>())?;
    let desc = ImageInfiniteLightDesc::new(EnvironmentMap::LatLong(image));
    Ok(ImageInfiniteLight::new(
        desc,
        SceneSphere::new(Vec3::ZERO, 1.0)?,
    )?)
}

/// Irradiance of a surface with unit normal `n`, by a sample of the sky.
fn by_sky(sky: &ImageInfiniteLight<Rgb>, n: Vec3, [a, b, ..]: [f32; 4]) -> Vec3 {
    let ctx = LightSampleContext::surface(Vec3::ZERO, n, n);
    let li = sky.sample_li(&ctx, Vec2::new(a, b), &(), PdfCoverage::Complete);
    li.map_or(Vec3::ZERO, |li| li.l * (li.wi.dot(n).max(0.0) / li.pdf))
}

/// The same by two samples. What the BSDF finds easily the sky leaves out: `Incomplete`, in the
/// sample and in the density alike.
fn by_both(sky: &ImageInfiniteLight<Rgb>, n: Vec3, [a, b, c, d]: [f32; 4]) -> Vec3 {
    let ctx = LightSampleContext::surface(Vec3::ZERO, n, n);
    let coverage = PdfCoverage::Incomplete;
    let li = sky.sample_li(&ctx, Vec2::new(a, b), &(), coverage);
    let of_sky = li.map_or(Vec3::ZERO, |li| {
        let cos = li.wi.dot(n).max(0.0);
        li.l * (cos * mis::balance(li.pdf, cosine_hemisphere::pdf(cos)) / li.pdf)
    });
    let w = cosine_hemisphere::sample(Vec2::new(c, d));
    let wi = Frame::from_z(n).from_local(w);
    let by_light = sky.pdf_li(&ctx, wi, coverage);
    let weight = mis::balance(cosine_hemisphere::pdf(w.z), by_light);
    of_sky + sky.le(Vec3::ZERO, wi, &()) * (PI * weight)
}

type Estimator = fn(&ImageInfiniteLight<Rgb>, Vec3, [f32; 4]) -> Vec3;

/// The mean of `count` estimates.
fn mean(by: Estimator, sky: &ImageInfiniteLight<Rgb>, n: Vec3, count: u32, seed: u32) -> Vec3 {
    let one = |i| by(sky, n, LatinHypercube::new(count, seed).point_f32(i));
    (0..count).map(one).sum::<Vec3>() / count as f32
}

fn main() -> Result<()> {
    let sky = sky()?;
    picture::save("environment", [320, 200], |x, y| {
        let at = Vec2::new(x as f32 - 159.5, 99.5 - y as f32) / 100.0;
        let towards = Vec3::new(at.x, at.y, -2.0).normalize();
        // The ball fills four fifths of the height; its albedo is 0.8.
        let n = at / 0.8;
        if n.length_squared() < 1.0 {
            let n = n.extend((1.0 - n.length_squared()).sqrt());
            let by = if x < 160 { by_sky } else { by_both };
            mean(by, &sky, n, 64, y * 320 + x) * (0.8 / PI)
        } else {
            sky.le(Vec3::ZERO, towards, &())
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use lights::glam::DVec3;
    use lights::math::lat_long;

    /// The integral by midpoints, 64 of them in each texel, over which the radiance is even.
    fn quadrature(n: Vec3) -> Vec3 {
        let size = [8 * WIDTH, 4 * WIDTH];
        let cells = (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| (x, y)));
        let parts = cells.map(|(x, y)| {
            let uv =
                (Vec2::new(x as f32, y as f32) + 0.5) / Vec2::new(size[0] as f32, size[1] as f32);
            let solid_angle = lat_long::solid_angle_per_area(uv.y) / (size[0] * size[1]) as f32;
            let cos = lat_long::direction(uv).dot(n).max(0.0);
            (texel(x / 8, y / 8) * (cos * solid_angle)).as_dvec3()
        });
        parts.sum::<DVec3>().as_vec3()
    }

    #[test]
    fn both_ways_give_the_integral() -> Result<()> {
        let (sky, count) = (sky()?, 1 << 14);
        for n in [Vec3::Y, Vec3::X, Vec3::new(-0.6, 0.0, 0.8), Vec3::NEG_Y] {
            let exact = quadrature(n);
            for (by, seed) in [(by_sky as Estimator, 1), (by_both, 2)] {
                let mean = mean(by, &sky, n, count, seed);
                let off = (mean / exact - 1.0).abs().max_element();
                assert!(off < 0.02, "{mean}, not {exact}, for {n}");
            }
        }
        Ok(())
    }

    /// The share of samples in the sun's texel is its share of the sky's light: nothing is blurred.
    #[test]
    fn the_sun_keeps_its_texel() -> Result<()> {
        let (sky, count) = (sky()?, 1 << 14);
        let ctx = LightSampleContext::medium(Vec3::ZERO);
        let in_sun = (0..count).filter(|&i| {
            let u = Vec2::from(LatinHypercube::new(count, 3).point_f32(i));
            let li = sky.sample_li(&ctx, u, &(), PdfCoverage::Complete);
            li.is_some_and(|li| li.l.x > 100.0)
        });
        let flux = |[x, y]: [u32; 2]| {
            // The exact solid angle of a row's texels.
            let edge = |y| (PI * y as f32 / (WIDTH / 2) as f32).cos();
            (texel(x, y).element_sum() * (edge(y) - edge(y + 1))) as f64
        };
        let texels = (0..WIDTH / 2).flat_map(|y| (0..WIDTH).map(move |x| [x, y]));
        let exact = flux(SUN) / texels.map(flux).sum::<f64>();
        let share = in_sun.count() as f64 / f64::from(count);
        assert!((share / exact - 1.0).abs() < 0.01, "{share}, not {exact}");
        Ok(())
    }
}
