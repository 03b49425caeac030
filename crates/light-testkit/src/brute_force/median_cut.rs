use core::f64::consts::{PI, TAU};

use light_math::SphereMap;
use light_math::glam::{DVec2, DVec3};
use light_sources::{Centroid, Channels, Image, MedianCut, MedianCutLight, RegionSums};

use super::picture::random_image;
use super::sphere_maps::{equal_area_direction, lat_long_direction};
use crate::Rng;

/// Relative rounding of sums, and of directions.
const ROUNDING: f64 = 1e-5;

/// A sky that is cut into distant lights: as many as are possible, of all light, each in the middle
/// of its own.
pub(super) fn check(rng: &mut Rng) -> Result<(), String> {
    let map = [SphereMap::EqualArea, SphereMap::LatLong][rng.below(2)];
    let n = 1 + rng.below(12) as u32;
    let width = match map {
        SphereMap::EqualArea => n,
        SphereMap::LatLong => 1 + rng.below(24) as u32,
    };
    let channels = [Channels::Gray, Channels::Rgb][rng.below(2)];
    let image = random_image(rng, [width, n], channels);
    let sums = [RegionSums::Table, RegionSums::Pyramid][rng.below(2)];
    let centroid = [Centroid::Luminance, Centroid::SquaredLuminance][rng.below(2)];
    let count = 1 + rng.below(40);
    let describe = |fault| format!("{fault}\n  {count} lights of {map:?}, {sums:?}, {image:?}");
    let cut = MedianCut::new(image.clone(), map, sums).map_err(|e| describe(e.to_string()))?;
    let lights = cut.lights(count, centroid);
    let lights = lights.map_err(|e| describe(e.to_string()))?;
    let sky = Sky { image: &image, map };
    let lit = sky.texels().filter(|at| sky.radiance(*at) != DVec3::ZERO);
    let lit: Vec<[u32; 2]> = lit.collect();
    let wanted = count.min(lit.len());
    let are_enough = lights.len() == wanted || sums == RegionSums::Pyramid;
    if lights.len() > wanted || !are_enough {
        return Err(describe(format!(
            "{} lights, not {wanted}, of {} texels that emit",
            lights.len(),
            lit.len()
        )));
    }
    let owners = |at: &[u32; 2]| lights.iter().filter(|light| contains(light, *at)).count();
    if let Some(at) = lit.iter().find(|at| owners(at) != 1) {
        return Err(describe(format!("{} lights have {at:?}", owners(at))));
    }
    for light in &lights {
        sky.light_holds(light, centroid).map_err(describe)?;
    }
    Ok(())
}

fn contains(light: &MedianCutLight, at: [u32; 2]) -> bool {
    let region = light.region;
    (0..2).all(|i| (region.min[i]..region.max[i]).contains(&at[i]))
}

struct Sky<'a> {
    image: &'a Image,
    map: SphereMap,
}

impl Sky<'_> {
    fn texels(&self) -> impl Iterator<Item = [u32; 2]> + use<> {
        let [width, height] = self.image.size();
        (0..height).flat_map(move |y| (0..width).map(move |x| [x, y]))
    }

    fn radiance(&self, [x, y]: [u32; 2]) -> DVec3 {
        self.image.texel(x, y).as_dvec3()
    }

    /// The direction of the middle of a texel, and its solid angle.
    fn part(&self, at: [u32; 2]) -> (DVec3, f64) {
        let [width, height] = self.image.size().map(f64::from);
        let [x, y] = at.map(f64::from);
        let middle = DVec2::new((x + 0.5) / width, (y + 0.5) / height);
        match self.map {
            SphereMap::EqualArea => (equal_area_direction(middle), 2.0 * TAU / (width * height)),
            SphereMap::LatLong => {
                let cos = |row: f64| (PI * row / height).cos();
                let (direction, _) = lat_long_direction(middle);
                (direction, TAU / width * (cos(y) - cos(y + 1.0)))
            }
        }
    }

    /// The light has what its region emits, from the mean direction of that.
    fn light_holds(&self, light: &MedianCutLight, centroid: Centroid) -> Result<(), String> {
        let (mut irradiance, mut directions, mut sum) = (DVec3::ZERO, DVec3::ZERO, 0.0);
        for at in self.texels().filter(|at| contains(light, *at)) {
            let (direction, solid_angle) = self.part(at);
            let radiance = self.radiance(at);
            irradiance += radiance * solid_angle;
            let luminance = radiance.dot(DVec3::new(0.2125, 0.7154, 0.0721));
            let weight = match centroid {
                Centroid::Luminance => luminance,
                Centroid::SquaredLuminance => luminance * luminance,
            };
            directions += direction * (weight * solid_angle);
            sum += weight * solid_angle;
        }
        let off = (light.irradiance.as_dvec3() - irradiance)
            .abs()
            .max_element();
        if !(off <= ROUNDING * irradiance.max_element()) {
            return Err(format!("{light:?} has not the irradiance {irradiance}"));
        }
        let is_unit = (light.direction.length() - 1.0).abs() < 1e-5;
        let mean = directions / sum;
        // Light from all around has a mean of rounding only.
        let off = light
            .direction
            .as_dvec3()
            .distance(mean.normalize_or_zero());
        let is_mean = off <= ROUNDING / mean.length() || mean.length() < 2e-3;
        if is_unit && is_mean {
            return Ok(());
        }
        Err(format!("{light:?} has not the mean direction {mean}"))
    }
}
