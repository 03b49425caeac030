//! Light the other way round: rays leave the lights, and the floor counts the power that lands.
//!
//! `cargo run --release -p lights --example light_tracing` writes `out/light_tracing.png`: the
//! floor below a lamp, a spot light and a panel, from above.

use core::error::Error;
use core::f32::consts::FRAC_PI_2;

use lights::glam::{Affine3A, Vec2, Vec3};
use lights::math::fraction;
use lights::media::LatinHypercube;
use lights::samplers::{BvhLightSampler, LightSampler};
use lights::sources::shape::ShapeDesc;
use lights::sources::*;

mod picture;

type Result<T> = core::result::Result<T, Box<dyn Error>>;

/// Half the side of the floor, a square around the origin of the plane y = 0.
const HALF: f32 = 2.0;

fn lights() -> Result<LightSet<Rgb>> {
    let mut lights = LightSetBuilder::<Rgb>::new(SceneSphere::new(Vec3::ZERO, 4.0)?);
    let amount = IntensityAmount::Radiometric(0.4);
    let lamp = Vec3::new(-1.0, 0.6, -0.8);
    lights.add(PointLightDesc::new(lamp, Vec3::new(1.0, 0.5, 0.2), amount))?;

    let down = Affine3A::from_rotation_x(FRAC_PI_2);
    let spot = Affine3A::from_translation(Vec3::new(1.0, 2.0, -1.0)) * down;
    let amount = IntensityAmount::Radiometric(2.0);
    lights.add(SpotLightDesc::new(
        spot,
        0.3,
        Vec3::new(0.3, 1.0, 0.4),
        amount,
    ))?;

    let corner = Vec3::new(-0.2, 0.5, 0.7);
    let edges = [Vec3::X * 1.2, Vec3::Z * 0.4];
    let amount = RadianceAmount::Radiometric(2.0);
    let color = SurfaceColor::Uniform(Vec3::new(0.4, 0.6, 1.0));
    let emission = DiffuseEmissionDesc::new(color, amount);
    let shape = ShapeDesc::Rectangle { corner, edges };
    lights.add(AreaLightDesc::new(shape, emission))?;
    Ok(lights.build())
}

/// A ray of one of the lights, and the power in W that it carries.
fn emit(
    lights: &LightSet<Rgb>,
    sampler: &BvhLightSampler,
    u: [u64; 5],
) -> Option<(EmittedRay, Vec3)> {
    let choice = sampler.sample_emitter(u[0])?;
    let [a, b, c, d] = [u[1], u[2], u[3], u[4]].map(fraction::to_f32);
    let light = lights.get(choice.light)?;
    let LightLeSample { l, ray, pdf } = light.sample_le(Vec2::new(a, b), Vec2::new(c, d), &())?;
    // A surface has a cosine, a light at a point has none.
    let is_surface = ray.normal != Vec3::ZERO;
    let cos = if is_surface {
        ray.normal.dot(ray.direction).abs()
    } else {
        1.0
    };
    Some((ray, l * (cos / (pdf.pos * pdf.dir * choice.pmf))))
}

/// The number of the cell of a coordinate that is not negative.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "rounds down on purpose"
)]
const fn cell(x: f32) -> usize {
    x as usize
}

/// The irradiance of the cells of the floor, by rows toward +z, from `count` rays.
fn floor(lights: &LightSet<Rgb>, cells: u16, count: u32) -> Result<Vec<Vec3>> {
    let sampler = BvhLightSampler::new(&lights.extents())?;
    let numbers = LatinHypercube::new(count, 3);
    let side = f32::from(cells);
    let mut power = vec![Vec3::ZERO; usize::from(cells).pow(2)];
    let rays = (0..count).filter_map(|i| emit(lights, &sampler, numbers.point(i)));
    for (ray, watts) in rays.filter(|(ray, _)| ray.direction.y < 0.0) {
        let p = ray.origin - ray.direction * (ray.origin.y / ray.direction.y);
        let at = (Vec2::new(p.x, p.z) / (2.0 * HALF) + 0.5) * side;
        if at.min_element() >= 0.0 && at.max_element() < side {
            power[cell(at.y) * usize::from(cells) + cell(at.x)] += watts;
        }
    }
    let area = (2.0 * HALF / side).powi(2) * count as f32;
    Ok(power.into_iter().map(|watts| watts / area).collect())
}

fn main() -> Result<()> {
    let side = 200;
    let floor = floor(&lights()?, side, 4_000_000)?;
    picture::save("light_tracing", [side.into(); 2], |x, y| {
        floor[(y * u32::from(side) + x) as usize]
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use lights::bounds::LightSampleContext;

    /// What lands in a cell is what samples of the lights toward its points say.
    #[test]
    fn the_floor_gets_what_it_sees() -> Result<()> {
        let (lights, cells) = (lights()?, 4u16);
        for (i, found) in (0u16..).zip(floor(&lights, cells, 1 << 22)?) {
            let cell = Vec2::new((i % cells).into(), (i / cells).into());
            let count = 1 << 12;
            let seen = |k| {
                let [x, z, u, v] = LatinHypercube::new(count, 9).point_f32(k);
                let at = ((cell + Vec2::new(x, z)) / f32::from(cells) - 0.5) * (2.0 * HALF);
                let p = Vec3::new(at.x, 0.0, at.y);
                let ctx = LightSampleContext::surface(p, Vec3::Y, Vec3::Y);
                let li = lights.iter().filter_map(|(_, light)| {
                    light.sample_li(&ctx, Vec2::new(u, v), &(), PdfCoverage::Complete)
                });
                li.map(|li| li.l * li.wi.y / li.pdf).sum::<Vec3>()
            };
            let exact = (0..count).map(seen).sum::<Vec3>() / count as f32;
            let off = (found - exact).abs().max_element() / exact.max_element();
            assert!(off < 0.04, "{found}, not {exact}, in cell {cell}");
        }
        Ok(())
    }

    /// A lamp of intensity I at height h above the middle of a square of half side a sends
    /// `4 I atan(a^2 / (h sqrt(2 a^2 + h^2)))` there, the intensity times the solid angle.
    #[test]
    fn the_power_of_a_lamp_is_that_of_its_solid_angle() -> Result<()> {
        let (height, intensity) = (0.7f32, 0.5);
        let mut lights = LightSetBuilder::<Rgb>::new(SceneSphere::new(Vec3::ZERO, 4.0)?);
        let amount = IntensityAmount::Radiometric(intensity);
        lights.add(PointLightDesc::new(Vec3::Y * height, Vec3::ONE, amount))?;
        let found = floor(&lights.build(), 1, 1 << 16)?[0].x * 4.0 * HALF * HALF;
        let diagonal = (2.0 * HALF * HALF + height * height).sqrt();
        let exact = 4.0 * intensity * (HALF * HALF / (height * diagonal)).atan();
        assert!((found / exact - 1.0).abs() < 0.005, "{found}, not {exact}");
        Ok(())
    }
}
