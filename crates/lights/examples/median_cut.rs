//! A sky as a few distant lights of equal energy: median cut, for renderers without image lights.
//! It is biased, and free of noise.
//!
//! `cargo run --release -p lights --example median_cut` writes `out/median_cut.png`: the sky with
//! the regions of 64 lights, and matt balls lit by 4, 16 and 64 of them and by the sky itself.

use core::error::Error;
use core::f32::consts::PI;

use lights::glam::{DVec3, Vec2, Vec3};
use lights::math::{SphereMap, lat_long};
use lights::sources::*;

mod picture;

type Result<T> = core::result::Result<T, Box<dyn Error>>;

/// Columns and rows of the sky.
const SIZE: [u32; 2] = [256, 128];

/// A blue sky with a soft sun, and dark ground. Row 0 is the top.
fn texel(x: u32, y: u32) -> Vec3 {
    let up = direction(x, y);
    let sun = Vec3::new(0.4, 0.6, 0.7).normalize();
    let glow = 12.0 * (60.0 * (up.dot(sun) - 1.0)).exp();
    let base = if up.y > 0.0 {
        Vec3::new(0.25, 0.4, 0.7) * (1.0 - 0.6 * up.y)
    } else {
        Vec3::new(0.08, 0.06, 0.05)
    };
    base + Vec3::new(1.0, 0.85, 0.6) * glow
}

/// Where the middle of a texel lies.
fn direction(x: u32, y: u32) -> Vec3 {
    let [width, height] = SIZE.map(|n| n as f32);
    lat_long::direction((Vec2::new(x as f32, y as f32) + 0.5) / Vec2::new(width, height))
}

fn texels() -> impl Iterator<Item = (u32, u32)> {
    (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| (x, y)))
}

fn cut() -> Result<MedianCut> {
    let values = texels().flat_map(|(x, y)| texel(x, y).to_array());
    let image = Image::from_f32(SIZE, Channels::Rgb, values.collect::<Vec<f32>>())?;
    Ok(MedianCut::new(
        image,
        SphereMap::LatLong,
        RegionSums::Table,
    )?)
}

/// Irradiance of a surface with unit normal `n` in the open, by all lights at once.
fn by_lights(lights: &[MedianCutLight], n: Vec3) -> Vec3 {
    let lit = |light: &MedianCutLight| light.irradiance * light.direction.dot(n).max(0.0);
    lights.iter().map(lit).sum()
}

/// The same by all texels: what the lights stand for.
fn by_texels(n: Vec3) -> Vec3 {
    let area = 1.0 / (SIZE[0] * SIZE[1]) as f32;
    let parts = texels().map(|(x, y)| {
        let solid_angle = area * lat_long::solid_angle_per_area((y as f32 + 0.5) / SIZE[1] as f32);
        (texel(x, y) * (solid_angle * direction(x, y).dot(n).max(0.0))).as_dvec3()
    });
    parts.sum::<DVec3>().as_vec3()
}

fn main() -> Result<()> {
    let cut = cut()?;
    let counts = [4, 16, 64];
    let sets = counts.map(|n| cut.lights(n, Centroid::Luminance));
    let mut lights = Vec::new();
    for set in sets {
        lights.push(set?);
    }
    let [width, height] = SIZE;
    let is_edge = |x, y| {
        let at_edge = |light: &MedianCutLight| {
            let TexelRegion { min, max } = light.region;
            let is_inside = (min[0]..max[0]).contains(&x) && (min[1]..max[1]).contains(&y);
            is_inside && (x == min[0] || y == min[1])
        };
        lights[2].iter().any(at_edge)
    };
    picture::save("median_cut", [width, height + width / 4], |x, y| {
        if y < height {
            return if is_edge(x, y) {
                Vec3::ZERO
            } else {
                texel(x, y)
            };
        }
        // Four balls in a row, seen from -z, their albedo 0.8.
        let at = Vec2::new((x % 64) as f32 - 31.5, 31.5 - (y - height) as f32) / 30.0;
        if at.length_squared() >= 1.0 {
            return Vec3::ZERO;
        }
        let n = at.extend((1.0 - at.length_squared()).sqrt());
        let set = lights.get((x / 64) as usize);
        set.map_or_else(|| by_texels(n), |set| by_lights(set, n)) * (0.8 / PI)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// As many as asked for, all energy of the sky, and with 256 of them its irradiance.
    #[test]
    fn lights_stand_for_the_sky() -> Result<()> {
        let cut = cut()?;
        for (count, bound) in [(16, 0.3), (64, 0.03), (256, 0.01)] {
            let lights = cut.lights(count, Centroid::Luminance)?;
            assert_eq!(lights.len(), count, "lights");
            // In shares of the irradiance of a surface that faced all of it.
            let energy = lights.iter().map(|light| light.irradiance).sum::<Vec3>();
            let normals = texels().filter(|(x, y)| x % 32 == 0 && y % 32 == 0);
            for n in normals
                .map(|(x, y)| direction(x, y))
                .chain([Vec3::Y, Vec3::NEG_Y])
            {
                let off = (by_lights(&lights, n) - by_texels(n)).abs() / energy;
                assert!(off.max_element() < bound, "{off} of {count} at {n}");
            }
        }
        Ok(())
    }

    #[test]
    fn no_energy_is_lost() -> Result<()> {
        let lights = cut()?.lights(32, Centroid::Luminance)?;
        let energy = lights.iter().map(|light| light.irradiance).sum::<Vec3>();
        let area = 1.0 / (SIZE[0] * SIZE[1]) as f32;
        let parts = texels().map(|(x, y)| {
            let v = (y as f32 + 0.5) / SIZE[1] as f32;
            (texel(x, y) * (area * lat_long::solid_angle_per_area(v))).as_dvec3()
        });
        let exact = parts.sum::<DVec3>().as_vec3();
        let off = (energy / exact - 1.0).abs().max_element();
        assert!(off < 1e-3, "{energy}, not {exact}");
        Ok(())
    }
}
