//! A lamp walks through a field of 10,000 others under a sky and drops sparks, which come and go:
//! what a frame has to do.
//!
//! `cargo run --release -p lights --example moving_lights` writes `out/moving_lights_0.png` and so
//! on, and prints how long the lights of each frame took.

use core::error::Error;
use core::time::Duration;
use std::time::Instant;

use lights::bounds::{LightExtent, LightSampleContext, SampledLight};
use lights::bvh::LightBvhOptions;
use lights::glam::{Vec2, Vec3};
use lights::math::fraction;
use lights::samplers::{BvhLightSampler, LightSampler};
use lights::sources::*;

mod picture;

type Result<T> = core::result::Result<T, Box<dyn Error>>;

/// A field of lamps under a sky, one lamp of which moves, with room for some more.
struct Field {
    lights: LightSet<Rgb>,
    moving: SourceId,
    /// Lamps that are off: as many can be added.
    spare: Vec<SourceId>,
    /// Kept from frame to frame, so that no frame allocates.
    extents: Vec<LightExtent>,
    sampler: BvhLightSampler,
}

fn lamp(position: Vec3, emission: Vec3, watts_per_sr: f32) -> PointLightDesc<Rgb> {
    PointLightDesc::new(
        position,
        emission,
        IntensityAmount::Radiometric(watts_per_sr),
    )
}

/// A dim sky with a brighter horizon, `height` rows of a panorama.
fn sky(height: u32) -> Result<ImageInfiniteLightDesc> {
    let row = |y| if y == height / 2 { 0.02 } else { 0.002 };
    let texels = (0..height).flat_map(|y| (0..2 * height).map(move |_| row(y)));
    let image = Image::from_f32(
        [2 * height, height],
        Channels::Gray,
        texels.collect::<Vec<f32>>(),
    )?;
    Ok(ImageInfiniteLightDesc::new(EnvironmentMap::LatLong(image)))
}

impl Field {
    /// `side * side` lamps a length apart, on the plane y = 0, and room for `capacity` more.
    fn new(side: u16, sky_height: u32, capacity: usize) -> Result<Self> {
        let radius = f32::from(side);
        let mut lights = LightSetBuilder::new(SceneSphere::new(Vec3::ZERO, radius)?);
        lights.add(sky(sky_height)?)?;
        for i in 0..side * side {
            let at = Vec2::new((i % side).into(), (i / side).into()) - 0.5 * radius;
            let color = Vec3::new(1.0, 0.6, 0.3);
            lights.add(lamp(Vec3::new(at.x, 0.2, at.y), color, 0.01))?;
        }
        let moving = lights.add(lamp(Vec3::Y, Vec3::ONE, 1.0))?;
        let off = || lamp(Vec3::Y, Vec3::ONE, 0.0);
        let spare = (0..capacity).map(|_| lights.add(off()));
        let spare = spare.collect::<core::result::Result<Vec<_>, _>>()?;
        let lights = lights.build();
        let extents = lights.extents();
        Ok(Self {
            // Lights that are off have a place in the tree, which a refit switches on.
            sampler: BvhLightSampler::with_options(&extents, &LightBvhOptions::DYNAMIC)?,
            extents,
            lights,
            moving,
            spare,
        })
    }

    /// Adds a lamp; `None` where the room is used up. It is lit from the next frame on.
    fn add(&mut self, lamp: PointLightDesc<Rgb>) -> Result<Option<SourceId>> {
        let Some(source) = self.spare.pop() else {
            return Ok(None);
        };
        self.lights.update(source, lamp)?;
        Ok(Some(source))
    }

    /// Removes a lamp that was added.
    fn remove(&mut self, source: SourceId) -> Result<()> {
        self.lights.update(source, lamp(Vec3::Y, Vec3::ONE, 0.0))?;
        self.spare.push(source);
        Ok(())
    }

    /// Moves the lamp: the light, the extents, the tree, with all that was added or removed.
    fn advance(&mut self, position: Vec3) -> Result<Duration> {
        let start = Instant::now();
        self.lights
            .update(self.moving, lamp(position, Vec3::new(0.3, 0.6, 1.0), 4.0))?;
        self.lights.extents_into(&mut self.extents);
        self.sampler.refit(&self.extents)?;
        Ok(start.elapsed())
    }

    /// Irradiance of the ground at `p`, by `count` lights at `offset` in equal parts of `[0, 1)`.
    fn irradiance(&self, p: Vec3, count: u16, offset: f32) -> Vec3 {
        let ctx = LightSampleContext::surface(p, Vec3::Y, Vec3::Y);
        let here = self.sampler.at(&ctx, count.into());
        let from = |(i, choice): (u16, SampledLight)| {
            let u = (f32::from(i) + offset) / f32::from(count);
            let u = Vec2::new(u, (f32::from(i) * 0.618 + offset).fract());
            let light = self.lights.get(choice.light)?;
            let li = light.sample_li(&ctx, u, &(), PdfCoverage::Complete)?;
            Some(li.l * li.wi.y.max(0.0) / (li.pdf * choice.pmf * f32::from(count)))
        };
        let choices = here.samples(fraction::from_f32(offset, 0));
        (0..).zip(choices).filter_map(from).sum()
    }

    /// A pixel of the ground from above, 10 units to each side.
    fn pixel(&self, size: u16, x: u32, y: u32) -> Vec3 {
        let pixel = Vec2::new(x as f32, y as f32);
        let at = (pixel + 0.5) / f32::from(size) * 20.0 - 10.0;
        // Neighbours take different offsets, so that noise forms no pattern.
        let offset = pixel.dot(Vec2::new(0.7549, 0.5698)).fract();
        self.irradiance(Vec3::new(at.x, 0.0, at.y), 32, offset)
    }
}

/// Where the lamp is.
fn position(frame: u16) -> Vec3 {
    let angle = f32::from(frame) * 0.3;
    Vec3::new(8.0 * angle.cos(), 1.5, 8.0 * angle.sin())
}

fn main() -> Result<()> {
    let mut field = Field::new(100, 512, 3)?;
    let mut sparks = Vec::new();
    for frame in 0..8 {
        // A spark lives for three frames.
        if sparks.len() == 3 {
            field.remove(sparks.remove(0))?;
        }
        let spark = lamp(position(frame) * 0.7, Vec3::new(1.0, 0.3, 0.1), 1.0);
        sparks.extend(field.add(spark)?);
        let took = field.advance(position(frame))?;
        println!(
            "frame {frame}: lights ready in {:.2} ms",
            1e3 * took.as_secs_f64()
        );
        let name = format!("moving_lights_{frame}");
        picture::save(&name, [200, 200], |x, y| field.pixel(200, x, y))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Under the lamp it is bright, where it was a moment ago no longer; and no sample is left out.
    #[test]
    fn the_light_follows_the_lamp() -> Result<()> {
        let mut field = Field::new(8, 16, 0)?;
        let ground = |frame| position(frame) * Vec3::new(1.0, 0.0, 1.0);
        for frame in 1..4 {
            field.advance(position(frame))?;
            let [here, before] =
                [frame, frame - 1].map(|at| field.irradiance(ground(at), 256, 0.5));
            assert!(here.z > 2.0 * before.z, "{here} here, {before} before");
            // The lamp's own share is 4 / 1.5^2; other lamps and the sky add a few per cent.
            let own = 4.0 / (1.5 * 1.5);
            assert!(
                (here.z / own - 1.0).abs() < 0.1,
                "{here}, the lamp alone {own}"
            );
        }
        Ok(())
    }
    /// Added lamps give light, removed ones none, and there is room for so many.
    #[test]
    fn lamps_come_and_go() -> Result<()> {
        let mut field = Field::new(8, 16, 2)?;
        field.advance(position(0))?;
        let place = Vec3::new(-6.0, 0.0, 3.0);
        let red = || lamp(place + Vec3::Y, Vec3::X, 2.0);
        let at = |field: &Field| field.irradiance(place, 256, 0.5);
        let before = at(&field);
        let added = [field.add(red())?, field.add(red())?, field.add(red())?];
        assert!(added[1].is_some() && added[2].is_none(), "room for two");
        field.advance(position(0))?;
        let gain = at(&field) - before;
        assert!((gain.x - 4.0).abs() < 0.1, "two of 2 W/sr at 1: {gain}");
        for source in added.into_iter().flatten() {
            field.remove(source)?;
        }
        field.advance(position(0))?;
        let off = (at(&field) - before).abs().max_element();
        assert!(off < 0.01, "{off} is left");
        Ok(())
    }
}
