//! The same lamps, of the same lumens, as RGB and as spectra: on a grey wall both have one colour,
//! on a green one they part but for daylight, because the product of two colours is not the colour
//! of a product.
//!
//! `cargo run --release -p lights --example spectral_and_rgb` writes `out/spectral_and_rgb.png` (a
//! bulb of 2700 K, daylight and an open sky of 12,000 K; a grey wall and a green one, each as RGB
//! above and as spectra below), and prints XYZ below each lamp.

use core::error::Error;
use core::f32::consts::FRAC_1_PI;

use lights::bounds::LightSampleContext;
use lights::glam::{Vec2, Vec3};
use lights::math::spectrum::photometric::{K_M, Lumen};
use lights::math::spectrum::{
    Blackbody, Daylight, PiecewiseLinear, RgbColorSpace, SampledWavelengths, Spectrum, cie,
};
use lights::sources::*;

mod picture;

type Result<T> = core::result::Result<T, Box<dyn Error>>;
/// Four wavelengths, as pbrt takes.
type S4 = Spectral<4>;
/// A reflectance by wavelength.
type Reflectance = PiecewiseLinear<Vec<f32>>;

/// Each lamp's luminous power in lm.
const LUMENS: f32 = 800.0;

/// Steps of each of the four wavelengths through the visible range.
const STEPS: u16 = 128;

/// The wall z = 0 with its lamps, in both models.
struct Scene {
    rgb: LightSet<Rgb>,
    spectral: LightSet<S4>,
    walls: [Wall; 2],
}

/// A colour, as a spectrum and as what sRGB makes of it under daylight.
struct Wall {
    name: &'static str,
    spectrum: Reflectance,
    rgb: Vec3,
}

/// The lamps' names, places and spectra.
fn lamps() -> Result<[(&'static str, Vec3, SpectralEmission); 3]> {
    Ok([
        (
            "2700 K",
            Vec3::new(-3.0, 0.0, 1.2),
            Blackbody::new(2700.0)?.into(),
        ),
        ("D65", Vec3::new(0.0, 0.0, 1.2), Daylight::D65.into()),
        (
            "12000 K",
            Vec3::new(3.0, 0.0, 1.2),
            Blackbody::new(12_000.0)?.into(),
        ),
    ])
}

impl Wall {
    fn new(name: &'static str, points: &[[f32; 2]]) -> Result<Self> {
        let [nanometres, values] = [0, 1].map(|i| points.iter().map(|point| point[i]).collect());
        let spectrum = PiecewiseLinear::new(nanometres, values)?;
        // Daylight on white is white.
        let (mut seen, mut white) = (Vec3::ZERO, 0.0);
        for nm in (0..470_u16).map(|i| 360.5 + f32::from(i)) {
            let response = cie::matching(nm) * Daylight::D65.eval(nm);
            seen += response * spectrum.eval(nm);
            white += response.y;
        }
        let rgb = RgbColorSpace::srgb().rgb_from_xyz() * (seen / white);
        Ok(Self {
            name,
            spectrum,
            rgb,
        })
    }
}

impl Scene {
    fn new() -> Result<Self> {
        let around = SceneSphere::new(Vec3::ZERO, 10.0)?;
        let mut rgb = LightSetBuilder::<Rgb>::new(around);
        let mut spectral = LightSetBuilder::<S4>::new(around);
        for (_, position, spectrum) in lamps()? {
            let amount = IntensityAmount::LuminousPower(Lumen(LUMENS));
            let color = RgbColorSpace::srgb().rgb_from_xyz() * cie::xyz(&spectrum);
            rgb.add(PointLightDesc::new(position, color, amount))?;
            spectral.add(PointLightDesc::new(position, spectrum, amount))?;
        }
        Ok(Self {
            rgb: rgb.build(),
            spectral: spectral.build(),
            walls: [
                Wall::new("grey", &[[360.0, 0.6], [830.0, 0.6]])?,
                Wall::new(
                    "green",
                    &[
                        [360.0, 0.1],
                        [470.0, 0.12],
                        [535.0, 0.55],
                        [610.0, 0.12],
                        [830.0, 0.12],
                    ],
                )?,
            ],
        })
    }

    /// CIE XYZ of what the wall reflects at `p`, as RGB: luminance in nit is `K_M` times its Y.
    fn by_rgb(&self, p: Vec3, wall: &Wall) -> Vec3 {
        let to_xyz = RgbColorSpace::srgb().xyz_from_rgb();
        to_xyz * (reflected(&self.rgb, p, &()) * wall.rgb)
    }

    /// As [`by_rgb`](Self::by_rgb), as spectra: even steps through the wavelengths.
    fn by_spectra(&self, p: Vec3, wall: &Wall) -> Vec3 {
        let steps = (0..STEPS).map(|i| (f32::from(i) + 0.5) / f32::from(STEPS));
        let sum: Vec3 = steps
            .map(|u| {
                let lambda = SampledWavelengths::<4>::visible(u);
                let l = reflected(&self.spectral, p, &lambda) * wall.spectrum.sample(&lambda);
                cie::sampled_xyz(&l, &lambda)
            })
            .sum();
        // Y of a radiance per nanometre is in units of the response's integral.
        sum * (cie::Y_INTEGRAL / f32::from(STEPS))
    }
}

/// What a white wall z = 0 reflects at `p` of all the lamps.
fn reflected<C: ColorModel>(lights: &LightSet<C>, p: Vec3, lambda: &C::Wavelengths) -> C::Radiance {
    let ctx = LightSampleContext::surface(p, Vec3::Z, Vec3::Z);
    let mut sum = C::Radiance::BLACK;
    for (_, light) in lights.iter() {
        if let Some(li) = light.sample_li(&ctx, Vec2::ZERO, lambda, PdfCoverage::Complete) {
            sum = sum + li.l * (li.wi.z.max(0.0) * FRAC_1_PI / li.pdf);
        }
    }
    sum
}

fn main() -> Result<()> {
    let scene = Scene::new()?;
    println!("wall   lamp     RGB: X Y Z in nit          spectral                    apart");
    for wall in &scene.walls {
        for (name, position, _) in lamps()? {
            let p = position.with_z(0.0);
            let [rgb, spectral] =
                [scene.by_rgb(p, wall), scene.by_spectra(p, wall)].map(|l| l * K_M);
            let apart = (rgb - spectral).length() / spectral.length();
            println!(
                "{:<6} {name:<8} {:>8.3} {:>8.3} {:>8.3} {:>8.3} {:>8.3} {:>8.3} {:>7.2} %",
                wall.name,
                rgb.x,
                rgb.y,
                rgb.z,
                spectral.x,
                spectral.y,
                spectral.z,
                100.0 * apart
            );
        }
    }
    let srgb = RgbColorSpace::srgb();
    picture::save("spectral_and_rgb", [360, 160], |x, y| {
        let at = Vec2::new(x as f32 - 179.5, 79.5 - y as f32) / 40.0;
        // Each wall is a strip of its own, as high as half the picture.
        let (wall, center) = if y < 80 { (0, 1.0) } else { (1, -1.0) };
        let (wall, p) = (&scene.walls[wall], Vec3::new(at.x, at.y - center, 0.0));
        let xyz = if y % 80 < 40 {
            scene.by_rgb(p, wall)
        } else {
            scene.by_spectra(p, wall)
        };
        // Colours outside of the screen's are cut.
        (srgb.rgb_from_xyz() * xyz * EXPOSURE).max(Vec3::ZERO)
    })
}

/// The luminance of 12 cd/m^2 is white.
const EXPOSURE: f32 = K_M / 12.0;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_models_agree_on_grey_and_in_daylight() -> Result<()> {
        let scene = Scene::new()?;
        let [grey, green] = &scene.walls;
        for (name, position, _) in lamps()? {
            let p = position.with_z(0.0);
            let (rgb, spectral) = (scene.by_rgb(p, grey), scene.by_spectra(p, grey));
            let apart = (rgb - spectral).length() / spectral.length();
            assert!(apart < 0.005, "{name}: {rgb}, {spectral}");
        }
        let below = Vec3::ZERO;
        let (rgb, spectral) = (scene.by_rgb(below, green), scene.by_spectra(below, green));
        let apart = (rgb - spectral).length() / spectral.length();
        assert!(
            apart < 0.02,
            "the colour's own light, and some of the others: {apart}"
        );
        // Nothing is cut to make it a colour of sRGB.
        assert!(green.rgb.min_element() > 0.0, "{}", green.rgb);
        Ok(())
    }

    #[test]
    fn colors_part_under_a_bulb() -> Result<()> {
        let scene = Scene::new()?;
        let [_, green] = &scene.walls;
        let p = Vec3::new(-3.0, 0.0, 0.0);
        let (rgb, spectral) = (scene.by_rgb(p, green), scene.by_spectra(p, green));
        let apart = (rgb - spectral).length() / spectral.length();
        assert!(apart > 0.05, "{rgb}, {spectral}");
        Ok(())
    }
}
