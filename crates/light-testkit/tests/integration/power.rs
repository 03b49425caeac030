//! The statistical tests are not empty: each finds a fault of a known, small size.

use core::f32::consts::PI;
use core::panic::AssertUnwindSafe;
use std::panic::catch_unwind;

use light_bounds::{LightExtent, LightSampleContext};
use light_sources::glam::{Affine3A, Vec2, Vec3};
use light_sources::{
    EmittedRay, IntensityAmount, LePdf, Light, LightLeSample, LightLiSample, LightType,
    MediumInterface, PdfCoverage, RadianceAmount, Rgb, SceneSphere, SpotLight, SpotLightDesc,
    UniformInfiniteLight, UniformInfiniteLightDesc,
};
use light_testkit::laws::light::*;
use light_testkit::{Cap, DensityTest, Estimate, Rng, kolmogorov_smirnov_uniform};

/// A density that rises by 15 % from the middle to one end, where the samples are even.
#[test]
fn a_tilt_of_a_density_is_found() {
    let test = DensityTest::default();
    let line = test.interval([0.0, 1.0], |rng| Some(rng.f32()), |x| 0.85 + 0.3 * x);
    assert!(line.fault().is_some(), "interval: {line:?}");
    let square = test.square(|rng| Some(rng.vec2()), |p| 0.85 + 0.3 * p.y);
    assert!(square.fault().is_some(), "square: {square:?}");
    let even = 0.25 / PI;
    let sphere = test.sphere(|rng| Some(rng.direction()), |w| even * (1.0 + 0.15 * w.x));
    assert!(sphere.fault().is_some(), "sphere: {sphere:?}");
}

/// Two of a hundred samples in the wrong place.
#[test]
fn strays_are_found() {
    let place = |rng: &mut Rng| {
        let p = rng.vec2();
        Some(if rng.f32() < 0.02 { p * 0.1 } else { p })
    };
    let outcome = DensityTest::default().square(place, |_| 1.0);
    assert!(outcome.fault().is_some(), "{outcome:?}");
}

/// Numbers of which the distribution function is off by a fortieth.
#[test]
fn a_bend_of_uniform_numbers_is_found() {
    let mut rng = Rng::new(2);
    let mut bent: Vec<f64> = (0..1 << 15)
        .map(|_| rng.f64())
        .map(|u| u * (0.9 + 0.1 * u))
        .collect();
    let outcome = kolmogorov_smirnov_uniform(&mut bent);
    assert!(!outcome.passes(), "{outcome:?}");
}

/// A mean that is 3 % off, where the numbers spread as widely as their mean is large.
#[test]
fn a_biased_mean_is_found() {
    let mut rng = Rng::new(3);
    let exponential = Estimate::of(1 << 18, || -(1.0 - rng.f64()).ln());
    assert!(exponential.agrees_with(1.0), "{exponential:?}");
    assert!(!exponential.agrees_with(1.03), "{exponential:?}");
}

/// What is wrong with a light.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Fault {
    None,
    /// A density that is 5 % too large.
    PdfLi,
    /// A radiance of samples that is 2 % too large.
    Li,
    /// 2 % too much light in the rays that leave.
    Le,
    /// Rays that leave in mirrored directions, with the light and the density of the others.
    MirroredRays,
    /// A density of directions of rays that is 2 % too large, in samples and in queries.
    LePdf,
    /// A power that is 2 % too large.
    Phi,
}

/// A light with a fault.
#[derive(Debug)]
struct Broken<L> {
    light: L,
    fault: Fault,
}

impl<L: Light<Rgb>> Light<Rgb> for Broken<L> {
    fn light_type(&self) -> LightType {
        self.light.light_type()
    }

    fn phi(&self, wavelengths: &()) -> Vec3 {
        self.light.phi(wavelengths) * self.factor(Fault::Phi, 1.02)
    }

    fn sample_li(
        &self,
        ctx: &LightSampleContext,
        u: Vec2,
        wavelengths: &(),
        coverage: PdfCoverage,
    ) -> Option<LightLiSample<Vec3>> {
        let mut sample = self.light.sample_li(ctx, u, wavelengths, coverage)?;
        sample.l *= self.factor(Fault::Li, 1.02);
        sample.pdf *= self.factor(Fault::PdfLi, 1.05);
        Some(sample)
    }

    fn pdf_li(&self, ctx: &LightSampleContext, wi: Vec3, coverage: PdfCoverage) -> f32 {
        self.light.pdf_li(ctx, wi, coverage) * self.factor(Fault::PdfLi, 1.05)
    }

    fn sample_le(&self, u1: Vec2, u2: Vec2, wavelengths: &()) -> Option<LightLeSample<Vec3>> {
        let mut sample = self.light.sample_le(u1, u2, wavelengths)?;
        sample.l *= self.factor(Fault::Le, 1.02);
        sample.pdf.dir *= self.factor(Fault::LePdf, 1.02);
        if self.fault == Fault::MirroredRays {
            sample.ray.direction *= Vec3::new(-1.0, 1.0, 1.0);
        }
        Some(sample)
    }

    fn pdf_le(&self, ray: &EmittedRay) -> LePdf {
        let mut pdf = self.light.pdf_le(ray);
        pdf.dir *= self.factor(Fault::LePdf, 1.02);
        pdf
    }

    fn extent(&self) -> LightExtent {
        self.light.extent()
    }
}

impl<L> Broken<L> {
    fn factor(&self, fault: Fault, factor: f32) -> f32 {
        if self.fault == fault { factor } else { 1.0 }
    }
}

fn sky(fault: Fault) -> Broken<UniformInfiniteLight<Rgb>> {
    let desc = UniformInfiniteLightDesc {
        emission: Vec3::ONE,
        amount: RadianceAmount::Radiometric(0.7),
    };
    let scene = SceneSphere::new(Vec3::ZERO, 5.0).expect("a sphere");
    let light = UniformInfiniteLight::new(desc, scene).expect("a sky");
    Broken { light, fault }
}

/// A spot whose beam lies off the plane in which broken rays are mirrored.
fn spot(fault: Fault) -> Broken<SpotLight<Rgb>> {
    let light = SpotLight::new(SpotLightDesc {
        transform: Affine3A::from_rotation_y(0.5),
        angle: 0.9,
        falloff_start: 0.2,
        emission: Vec3::ONE,
        amount: IntensityAmount::Radiometric(3.0),
        media: MediumInterface::default(),
    });
    let light = light.expect("a spot");
    Broken { light, fault }
}

/// Whether a light passes a law.
fn holds<L: Light<Rgb>>(light: &L, radius: f32, law: impl Fn(&LightCase<'_, Rgb, L>)) -> bool {
    let case = LightCase::around("broken", light, Vec3::ZERO, radius, 2);
    catch_unwind(AssertUnwindSafe(|| law(&case))).is_ok()
}

#[test]
fn laws_of_arriving_light_find_their_faults() {
    let whole = |_| Cap::sphere();
    let density = |case: &LightCase<'_, Rgb, _>| li_follows_its_density(case, whole, |_, _| 0.7);
    let mean = |case: &LightCase<'_, Rgb, _>| li_adds_up(case, whole, |_, _| f64::from(0.7f32));
    for (fault, found) in [(Fault::None, false), (Fault::PdfLi, true)] {
        assert_eq!(
            !holds(&sky(fault), 1.0, density),
            found,
            "density, {fault:?}"
        );
    }
    for (fault, found) in [
        (Fault::None, false),
        (Fault::Li, true),
        (Fault::PdfLi, true),
    ] {
        assert_eq!(!holds(&sky(fault), 1.0, mean), found, "mean, {fault:?}");
    }
}

#[test]
fn laws_of_leaving_light_find_their_faults() {
    for (fault, found) in [
        (Fault::None, false),
        (Fault::Le, true),
        (Fault::LePdf, true),
        (Fault::Phi, true),
    ] {
        let light = spot(fault);
        assert_eq!(!holds(&light, 1.0, le_adds_up_to_phi), found, "{fault:?}");
    }
    let axis = Affine3A::from_rotation_y(0.5).transform_vector3(Vec3::Z);
    let beam = Cap::new(axis, 0.95);
    for (fault, found) in [(Fault::None, false), (Fault::MirroredRays, true)] {
        let light = spot(fault);
        let directions = |case: &LightCase<'_, Rgb, _>| {
            le_directions_follow_their_density(case, &beam, Vec3::ZERO);
        };
        let alike =
            |case: &LightCase<'_, Rgb, _>| rays_and_samples_light_alike(case, Vec3::ZERO, 1.0);
        assert_eq!(!holds(&light, 1.0, directions), found, "density, {fault:?}");
        assert_eq!(!holds(&light, 1.0, alike), found, "where, {fault:?}");
    }
}
