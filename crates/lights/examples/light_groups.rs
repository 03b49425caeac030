//! Light linking, and a picture in layers: lamps of one group light all, those of another light
//! only what asks for them; and the layers of the groups sum to the picture.
//!
//! `cargo run --release -p lights --example light_groups` writes `out/light_groups.png`: the
//! picture, then the layer of each group.

use core::error::Error;

use lights::bounds::{LightGroups, LightSampleContext};
use lights::glam::{Vec2, Vec3};
use lights::math::fraction;
use lights::samplers::{BvhLightSampler, LightSampler};
use lights::sources::*;

mod picture;

type Result<T> = core::result::Result<T, Box<dyn Error>>;

/// The lamps of the street, and those of the windows.
const STREET: LightGroups = LightGroups::of(0);
const WINDOWS: LightGroups = LightGroups::of(1);

/// Choices of a light a pixel.
const CHOICES: u32 = 64;

struct Scene {
    lights: LightSet<Rgb>,
    sampler: BvhLightSampler,
}

impl Scene {
    /// Two rows of lamps in each other's colours, each row a group.
    fn new() -> Result<Self> {
        let mut lights = LightSetBuilder::<Rgb>::new(SceneSphere::new(Vec3::ZERO, 20.0)?);
        let rows = [
            (STREET, -3.0, Vec3::new(1.0, 0.6, 0.2)),
            (WINDOWS, 3.0, Vec3::new(0.3, 0.5, 1.0)),
        ];
        let mut sources = Vec::new();
        for (groups, z, color) in rows {
            for x in 0..40u8 {
                let place = Vec3::new(f32::from(x) * 0.4 - 8.0, 1.0, z);
                let lamp = PointLightDesc::new(place, color, IntensityAmount::Radiometric(0.5));
                sources.push((lights.add(lamp)?, groups));
            }
        }
        let mut lights = lights.build();
        for (source, groups) in sources {
            lights.set_groups(source, groups)?;
        }
        let mut sampler = BvhLightSampler::new(&lights.extents())?;
        sampler.set_groups(lights.groups())?;
        Ok(Self { lights, sampler })
    }

    /// Irradiance of the ground at `p` by the lights of some groups.
    fn irradiance(&self, p: Vec3, groups: LightGroups) -> Vec3 {
        let ctx = LightSampleContext::surface(p, Vec3::Y, Vec3::Y).with_groups(groups);
        let here = self.sampler.at(&ctx, CHOICES);
        let mut sum = Vec3::ZERO;
        // Neighbours take different numbers, so that noise forms no pattern.
        let offset = p.dot(Vec3::new(75.49, 0.0, 56.98)).rem_euclid(1.0);
        for choice in here.samples(fraction::from_f32(offset, 0)) {
            let light = self.lights.get(choice.light);
            let li = light
                .and_then(|light| light.sample_li(&ctx, Vec2::ZERO, &(), PdfCoverage::Complete));
            if let Some(li) = li {
                sum += li.l * li.wi.y.max(0.0) / (li.pdf * choice.pmf);
            }
        }
        sum / here.count() as f32
    }

    /// The ground from above, 10 units to each side, by the lights of some groups.
    fn layer(&self, size: u16, groups: LightGroups) -> Vec<Vec3> {
        let pixels = (0..size).flat_map(|y| (0..size).map(move |x| (x, y)));
        let at = pixels.map(|(x, y)| {
            let pixel = Vec2::new(f32::from(x), f32::from(y)) + 0.5;
            pixel / f32::from(size) * 20.0 - 10.0
        });
        at.map(|at| self.irradiance(Vec3::new(at.x, 0.0, at.y), groups))
            .collect()
    }
}

fn main() -> Result<()> {
    let scene = Scene::new()?;
    let size = 256;
    let groups = [LightGroups::ALL, STREET, WINDOWS];
    let layers = groups.map(|groups| scene.layer(size, groups));
    let side = u32::from(size);
    picture::save("light_groups", [3 * side, side], |x, y| {
        layers[(x / side) as usize][(y * side + x % side) as usize]
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mean(layer: &[Vec3]) -> Vec3 {
        layer.iter().sum::<Vec3>() / layer.len() as f32
    }

    #[test]
    fn layers_sum_to_the_picture() -> Result<()> {
        let scene = Scene::new()?;
        let [all, street, windows] =
            [LightGroups::ALL, STREET, WINDOWS].map(|groups| mean(&scene.layer(24, groups)));
        let off = (street + windows - all).abs() / all;
        assert!(
            off.max_element() < 0.01,
            "{street} and {windows}, not {all}"
        );
        assert!(
            street.x > 2.0 * street.z && windows.z > 2.0 * windows.x,
            "colours"
        );
        Ok(())
    }

    /// All lamps at once, as the inverse square of the distance and the cosine say.
    #[test]
    fn layers_are_the_sums_over_their_lamps() -> Result<()> {
        let scene = Scene::new()?;
        for groups in [LightGroups::ALL, STREET, WINDOWS] {
            let found = mean(&scene.layer(24, groups));
            let lamps = scene.lights.iter().filter(|&(id, _)| {
                let of = scene.lights.groups()[id.index()];
                of.is_wanted(groups)
            });
            let lamps: Vec<_> = lamps.collect();
            let mut exact = Vec3::ZERO;
            for pixel in 0..24 * 24u16 {
                let at = Vec2::new(f32::from(pixel % 24), f32::from(pixel / 24)) + 0.5;
                let at = at / 24.0 * 20.0 - 10.0;
                for (_, light) in &lamps {
                    let LightRef::Point(lamp) = light else {
                        continue;
                    };
                    let to_lamp = PointSource::position(*lamp) - Vec3::new(at.x, 0.0, at.y);
                    let intensity = light.phi(&()) / (4.0 * core::f32::consts::PI);
                    exact += intensity * (to_lamp.y / to_lamp.length().powi(3)) / (24.0 * 24.0);
                }
            }
            let off = (found - exact).abs().max_element() / exact.max_element();
            assert!(off < 0.01, "{found}, not {exact}, of {groups:?}");
        }
        Ok(())
    }

    #[test]
    fn what_asks_for_one_group_gets_no_light_of_the_other() -> Result<()> {
        let scene = Scene::new()?;
        let beside_a_window = Vec3::new(0.0, 0.0, 3.0);
        let e = scene.irradiance(beside_a_window, STREET);
        assert!(e.x > 2.0 * e.z, "{e}");
        Ok(())
    }
}
