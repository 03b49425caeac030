use core::f64::consts::PI;

use light_bounds::LightSampleContext;
use light_math::glam::Vec3;
use light_sources::{ColorModel, InfiniteLight, Light, PdfCoverage, Radiance};

use super::case::le;
use super::{LightCase, SAMPLES, STRAY};
use crate::{Cap, Estimate, Rng};

/// The mean of what leaves over its density is `phi`, and `pdf_le` returns the densities that
/// samples carry.
///
/// # Panics
/// If the law does not hold.
pub fn le_adds_up_to_phi<C: ColorModel, L: Light<C>>(case: &LightCase<'_, C, L>) {
    let phi = f64::from(case.light.phi(&case.wavelengths).average());
    let mut rng = Rng::new(44);
    let mut strays = 0;
    let estimate = Estimate::of(SAMPLES, || {
        let ray = le(case, rng.vec2(), rng.vec2());
        strays += u32::from(!ray.pdf_agrees);
        ray.power
    });
    assert!(
        f64::from(strays) <= STRAY * f64::from(SAMPLES),
        "{}: pdf_le disagrees with {strays} of {SAMPLES} samples",
        case.name
    );
    assert!(
        estimate.agrees_with(phi),
        "{}: emits {phi}, rays that leave say {estimate:?}",
        case.name
    );
}

/// Every ray that leaves carries `phi`: the sampling of the light has no variance in power.
///
/// # Panics
/// If the law does not hold.
pub fn le_has_no_variance<C: ColorModel, L: Light<C>>(case: &LightCase<'_, C, L>) {
    let phi = f64::from(case.light.phi(&case.wavelengths).average());
    let mut rng = Rng::new(45);
    for _ in 0..1000 {
        let (u1, u2) = (rng.vec2(), rng.vec2());
        let power = le(case, u1, u2).power;
        assert!(
            (power - phi).abs() <= 1e-3 * phi,
            "{}: emits {phi}, a ray carries {power} at {u1}, {u2}",
            case.name
        );
    }
}

/// The flux through a sphere around a bounded light, by `sample_li` from all over it, is `phi`.
///
/// # Panics
/// If the law does not hold, or the light has no bounds.
pub fn flux_is_phi<C: ColorModel, L: Light<C>>(case: &LightCase<'_, C, L>) {
    let bounds = case.light.bounds().expect("a bounded light");
    let (center, radius) = bounds.bounds.bounding_sphere();
    let radius = if radius > 0.0 { 1.5 * radius } else { 1.0 };
    let area = 4.0 * PI * f64::from(radius) * f64::from(radius);
    let phi = f64::from(case.light.phi(&case.wavelengths).average());
    let mut rng = Rng::new(46);
    let estimate = Estimate::of(2 * SAMPLES, || {
        let outward = rng.direction();
        let ctx = LightSampleContext::medium(center + outward * radius);
        let sample = case.li(&ctx, rng.vec2(), PdfCoverage::Complete);
        sample.map_or(0.0, |s| {
            area * s.l * f64::from(-s.wi.dot(outward)) / f64::from(s.pdf)
        })
    });
    assert!(
        estimate.agrees_with(phi),
        "{}: phi is {phi}, the flux around it {estimate:?}",
        case.name
    );
}

/// The radiance of a light at infinity, integrated over the sphere and times the disk of the scene,
/// is `phi`.
///
/// # Panics
/// If the law does not hold.
pub fn infinite_flux_is_phi<C: ColorModel, L: InfiniteLight<C>>(
    case: &LightCase<'_, C, L>,
    scene_radius: f32,
) {
    let phi = f64::from(case.light.phi(&case.wavelengths).average());
    let disk = PI * f64::from(scene_radius) * f64::from(scene_radius);
    let integral = Cap::sphere().integrate(1e-3 * phi / disk, |w| {
        f64::from(case.light.le(Vec3::ZERO, w, &case.wavelengths).average())
    });
    assert!(
        (disk * integral - phi).abs() <= 5e-3 * phi,
        "{}: phi is {phi}, the flux into the scene {}",
        case.name,
        disk * integral
    );
}
