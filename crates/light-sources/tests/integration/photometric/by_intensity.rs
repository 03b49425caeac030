use core::f32::consts::PI;

use crate::photometric::model::*;
use light_sources::glam::{Affine3A, Vec2, Vec3};
use light_sources::light_bounds::{LightId, LightSampleContext};
use light_sources::light_math::spectrum::photometric::{Candela, Lumen, Watt};
use light_sources::*;

const CANDELA: IntensityAmount = IntensityAmount::LuminousIntensity(Candela(50.0));
const LUMEN: IntensityAmount = IntensityAmount::LuminousPower(Lumen(800.0));
const WATT: IntensityAmount = IntensityAmount::RadiantPower(Watt(9.0));

#[test]
fn a_point_light_spreads_its_power_over_four_pi() {
    spreads::<Rgb>("rgb", 4.0 * PI, point);
    spreads::<Spectral<4>>("spectral", 4.0 * PI, point);
}

#[test]
fn a_spot_spreads_its_power_over_its_cone() {
    // Half of the falloff counts.
    let solid_angle = PI * (2.0 - 0.3f32.cos() - 0.6f32.cos());
    spreads::<Rgb>("rgb", solid_angle, spot);
    spreads::<Spectral<4>>("spectral", solid_angle, spot);
}

#[test]
fn a_goniometric_light_spreads_its_power_as_its_image() {
    spreads::<Rgb>("rgb", 4.0 * PI * 0.625, goniometric);
    spreads::<Spectral<4>>("spectral", 4.0 * PI * 0.625, goniometric);
}

#[test]
fn a_projector_spreads_its_power_over_its_picture() {
    // A pyramid with a square base seen under a right angle is one face of a cube.
    let solid_angle = 4.0 * PI / 6.0;
    for n in [1, 4, 64] {
        spreads::<Rgb>("rgb", solid_angle, |amount| projection(n, amount));
        spreads::<Spectral<4>>("spectral", solid_angle, |amount| projection(n, amount));
    }
}

#[test]
fn at_one_metre_candelas_are_lux() {
    let ctx = LightSampleContext::medium(Vec3::Z);
    let set = light_set(point::<Spectral<4>>(CANDELA));
    let light = set.get(LightId(0)).expect("one light");
    let illuminance = Spectral::<4>::luminous(|w| {
        let sample = light.sample_li(&ctx, Vec2::ZERO, w, PdfCoverage::Complete);
        sample.expect("in sight").l
    });
    near(illuminance, 50.0, "I / d^2");
}

#[test]
fn impossible_amounts_name_their_field() {
    let error = |emission, amount| {
        let position = Vec3::ZERO;
        let media = MediumInterface::default();
        let desc = PointLightDesc::<Rgb> {
            position,
            emission,
            amount,
            media,
        };
        PointLight::new(desc).err()
    };
    let black = Some(PointLightError::Emission(EmissionError::Dark));
    assert_eq!(error(Vec3::ZERO, LUMEN), black, "black");
    let no_emission = Some(PointLightError::Emission(EmissionError::Emission));
    assert_eq!(error(Vec3::NAN, LUMEN), no_emission, "NaN");
    let no_amount = Some(PointLightError::Emission(EmissionError::Amount));
    for lumen in [-1.0, f32::NAN, f32::INFINITY] {
        let amount = IntensityAmount::LuminousPower(Lumen(lumen));
        assert_eq!(error(Vec3::ONE, amount), no_amount, "{lumen} lm");
    }
}

/// Checks power by power, and power by intensity, of a light that is at its full over
/// `solid_angle`.
fn spreads<M: Model>(name: &str, solid_angle: f32, desc: impl Fn(IntensityAmount) -> LightDesc<M>) {
    near(lumens(&light_set(desc(LUMEN))), 800.0, name);
    near(lumens(&light_set(desc(CANDELA))), 50.0 * solid_angle, name);
    let set = light_set(desc(WATT));
    let watts = M::radiant(|w| set.get(LightId(0)).expect("one light").phi(w));
    near(watts, 9.0, name);
}

fn point<M: Model>(amount: IntensityAmount) -> LightDesc<M> {
    LightDesc::Point(PointLightDesc {
        position: Vec3::ZERO,
        emission: M::lamp(),
        amount,
        media: MediumInterface::default(),
    })
}

fn spot<M: Model>(amount: IntensityAmount) -> LightDesc<M> {
    LightDesc::Spot(SpotLightDesc {
        transform: Affine3A::IDENTITY,
        angle: 0.6,
        falloff_start: 0.3,
        emission: M::lamp(),
        amount,
        media: MediumInterface::default(),
    })
}

fn goniometric<M: Model>(amount: IntensityAmount) -> LightDesc<M> {
    let texels = vec![1.0, 0.5, 1.0, 0.0];
    LightDesc::Goniometric(GoniometricLightDesc {
        transform: Affine3A::IDENTITY,
        distribution: Image::from_f32([2, 2], Channels::Gray, texels).expect("an image"),
        emission: M::lamp(),
        amount,
        media: MediumInterface::default(),
    })
}

fn projection<M: Model>(n: u32, amount: IntensityAmount) -> LightDesc<M> {
    let white = vec![1.0; 3 * (n * n) as usize];
    LightDesc::Projection(ProjectionLightDesc {
        transform: Affine3A::IDENTITY,
        image: Image::from_f32([n, n], Channels::Rgb, white).expect("an image"),
        fov: 0.5 * PI,
        amount,
        media: MediumInterface::default(),
    })
}
