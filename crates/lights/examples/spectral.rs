//! Lights as spectra: four wavelengths a sample, and the eye's response makes colours of them.
//!
//! `cargo run --release -p lights --example spectral` writes `out/spectral.png`: candle, daylight
//! and a sodium lamp on a white wall, above, and on a blue one, below, that sodium light leaves
//! black.

use core::error::Error;
use core::f32::consts::FRAC_1_PI;

use lights::bounds::LightSampleContext;
use lights::glam::{Vec2, Vec3};
use lights::math::fraction;
use lights::math::spectrum::photometric::{Candela, K_M};
use lights::math::spectrum::{
    Blackbody, Daylight, PiecewiseLinear, RgbColorSpace, SampledWavelengths, Spectrum, cie,
};
use lights::media::LatinHypercube;
use lights::samplers::{BvhLightSampler, LightSampler};
use lights::sources::*;

mod picture;

type Result<T> = core::result::Result<T, Box<dyn Error>>;
/// Four wavelengths, as pbrt takes.
type S4 = Spectral<4>;
/// A reflectance by wavelength.
type Reflectance = PiecewiseLinear<Vec<f32>>;

/// Each lamp's luminous intensity in cd.
const CANDELAS: f32 = 1000.0;

struct Scene {
    lights: LightSet<S4>,
    sampler: BvhLightSampler,
    white: Reflectance,
    blue: Reflectance,
}

/// Where the lamps hang, before the wall z = 0, and their spectra.
fn lamps() -> Result<[(Vec3, SpectralEmission); 3]> {
    let sodium = PiecewiseLinear::new([579.0, 589.0, 599.0].into(), [0.0, 1.0, 0.0].into())?;
    let spectra = [
        Blackbody::new(1900.0)?.into(),
        Daylight::D65.into(),
        SpectralEmission::PiecewiseLinear(sodium),
    ];
    let mut x = -6.0;
    Ok(spectra.map(|spectrum| {
        x += 3.0;
        (Vec3::new(x, 0.0, 1.0), spectrum)
    }))
}

impl Scene {
    fn new() -> Result<Self> {
        let mut lights = LightSetBuilder::<S4>::new(SceneSphere::new(Vec3::ZERO, 10.0)?);
        for (position, emission) in lamps()? {
            let amount = IntensityAmount::LuminousIntensity(Candela(CANDELAS));
            lights.add(PointLightDesc::new(position, emission, amount))?;
        }
        let lights = lights.build();
        Ok(Self {
            sampler: BvhLightSampler::new(&lights.extents())?,
            lights,
            white: PiecewiseLinear::new(vec![360.0, 830.0], vec![0.8; 2])?,
            blue: PiecewiseLinear::new(vec![360.0, 480.0, 530.0, 830.0], vec![0.8, 0.8, 0.0, 0.0])?,
        })
    }

    /// Colour that the wall reflects at `p`, in CIE XYZ: one light at four wavelengths.
    fn xyz(&self, p: Vec3, wall: &Reflectance, choice: u64, wavelength: f32) -> Vec3 {
        let lambda = SampledWavelengths::<4>::visible(wavelength);
        let ctx = LightSampleContext::surface(p, Vec3::Z, Vec3::Z);
        let li = self.sampler.sample(&ctx, choice).and_then(|choice| {
            let light = self.lights.get(choice.light)?;
            let li = light.sample_li(&ctx, Vec2::ZERO, &lambda, PdfCoverage::Complete)?;
            Some(li.l * (li.wi.z.max(0.0) / (li.pdf * choice.pmf)))
        });
        let l = li.map(|e| e * wall.sample(&lambda) * FRAC_1_PI);
        l.map_or(Vec3::ZERO, |l| cie::sampled_xyz(&l, &lambda))
    }

    /// The mean of `count` such estimates.
    fn mean(&self, p: Vec3, wall: &Reflectance, count: u32, seed: u32) -> Vec3 {
        let one = |i| {
            let [choice, wavelength] = LatinHypercube::new(count, seed).point(i);
            self.xyz(p, wall, choice, fraction::to_f32(wavelength))
        };
        (0..count).map(one).sum::<Vec3>() / count as f32
    }
}

fn main() -> Result<()> {
    let scene = Scene::new()?;
    let srgb = RgbColorSpace::srgb();
    picture::save("spectral", [360, 160], |x, y| {
        let at = Vec2::new(x as f32 - 179.5, 79.5 - y as f32) / 40.0;
        let wall = if at.y > 0.0 {
            &scene.white
        } else {
            &scene.blue
        };
        let xyz = scene.mean(at.extend(0.0), wall, 256, y * 360 + x);
        // Colours outside of the screen's are cut.
        (srgb.rgb_from_xyz() * xyz * EXPOSURE).max(Vec3::ZERO)
    })
}

/// The luminance of 300 cd/m^2 is white.
const EXPOSURE: f32 = K_M * cie::Y_INTEGRAL / 300.0;

#[cfg(test)]
mod tests {
    use super::*;

    /// Sums over each nanometre, of lamps that are scaled to their candelas: the integral that four
    /// wavelengths a sample estimate.
    fn quadrature(p: Vec3, wall: &Reflectance) -> Result<Vec3> {
        let nanometres = || (0..470).map(|i| 360.5 + i as f32);
        let mut sum = Vec3::ZERO;
        for (position, spectrum) in lamps()? {
            let responses = nanometres().map(|nm| spectrum.eval(nm) * cie::matching(nm));
            let watts_per_sr = CANDELAS / (K_M * responses.map(|r| r.y).sum::<f32>());
            let to_light = position - p;
            let fall = to_light.normalize().z / to_light.length_squared();
            let reflected = |nm| spectrum.eval(nm) * wall.eval(nm) * cie::matching(nm);
            let seen = nanometres().map(reflected).sum::<Vec3>() / cie::Y_INTEGRAL;
            sum += seen * (watts_per_sr * fall * FRAC_1_PI);
        }
        Ok(sum)
    }

    #[test]
    fn means_are_the_integrals_over_wavelengths() -> Result<()> {
        let scene = Scene::new()?;
        for (x, wall) in [
            (-3.0, &scene.white),
            (0.5, &scene.blue),
            (3.0, &scene.white),
        ] {
            let p = Vec3::new(x, 0.3, 0.0);
            let (mean, exact) = (scene.mean(p, wall, 1 << 14, 4), quadrature(p, wall)?);
            let off = (mean - exact).abs().max_element() / exact.max_element();
            assert!(off < 0.02, "{mean}, not {exact}, at {p}");
        }
        Ok(())
    }

    #[test]
    fn sodium_light_leaves_blue_walls_black() -> Result<()> {
        let scene = Scene::new()?;
        let below_sodium = Vec3::new(3.0, 0.0, 0.0);
        let [white, blue] =
            [&scene.white, &scene.blue].map(|wall| scene.mean(below_sodium, wall, 1 << 12, 5).y);
        assert!(blue < 0.05 * white, "{blue} beside {white}");
        Ok(())
    }
}
