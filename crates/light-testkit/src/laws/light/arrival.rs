use light_math::glam::Vec3;
use light_sources::{ColorModel, Light, PdfCoverage};

use super::case::same_density;
use super::{LightCase, SAMPLES, STRAY};
use crate::{Cap, DensityTest, Estimate, Rng};

/// Relative error that the quadrature of a radiance with jumps may have.
const QUADRATURE: f64 = 1e-3;

/// Directions toward the light follow `pdf_li`, which integrates to one at most, and which each
/// sample carries.
///
/// A sample that finds no light is `None`, so the samples follow the density where light arrives.
///
/// # Panics
/// If the law does not hold.
pub fn li_follows_its_density<C: ColorModel, L: Light<C>>(
    case: &LightCase<'_, C, L>,
    cap: impl Fn(Vec3) -> Cap,
    radiance: impl Fn(Vec3, Vec3) -> f64,
) {
    for coverage in [PdfCoverage::Complete, PdfCoverage::Incomplete] {
        for ctx in &case.contexts {
            if coverage == PdfCoverage::Incomplete && !case.reads_coverage(ctx) {
                continue;
            }
            let at = format!("{}, {coverage:?}, at {ctx:?}", case.name);
            let around = cap(ctx.p);
            let pdf = |wi| case.light.pdf_li(ctx, wi, coverage);
            let test = DensityTest::default();
            let mut strays = 0;
            let outcome = test.cap(
                &around,
                |rng| {
                    let sample = case.li(ctx, rng.vec2(), coverage)?;
                    strays += u32::from(!same_density(pdf(sample.wi), sample.pdf));
                    Some(sample.wi)
                },
                |wi| {
                    if radiance(ctx.p, wi) > 0.0 {
                        pdf(wi)
                    } else {
                        0.0
                    }
                },
            );
            let strays = f64::from(strays.max(outcome.impossible)) / f64::from(test.samples);
            assert!(
                strays <= STRAY,
                "{at}: pdf_li disagrees with {strays} of the samples"
            );
            assert!(
                outcome.chi_squared.passes() && outcome.outside == 0,
                "{at}: the samples do not follow the density: {outcome:?}"
            );
            let mass = around.integrate(4e-3, |wi| f64::from(pdf(wi)));
            assert!(mass <= 1.01, "{at}: the density integrates to {mass}");
        }
    }
}

/// The mean of radiance over density is the integral of the arriving radiance.
///
/// # Panics
/// If the law does not hold.
pub fn li_adds_up<C: ColorModel, L: Light<C>>(
    case: &LightCase<'_, C, L>,
    cap: impl Fn(Vec3) -> Cap,
    radiance: impl Fn(Vec3, Vec3) -> f64,
) {
    let mut rng = Rng::new(42);
    for ctx in &case.contexts {
        let estimate = Estimate::of(SAMPLES, || {
            let sample = case.li(ctx, rng.vec2(), PdfCoverage::Complete);
            sample.map_or(0.0, |s| s.l / f64::from(s.pdf))
        });
        let tolerance = 0.2 * estimate.margin(estimate.mean) + QUADRATURE * estimate.mean;
        let truth = cap(ctx.p).integrate(tolerance.max(1e-12), |wi| radiance(ctx.p, wi));
        let error = (estimate.mean - truth).abs();
        assert!(
            error <= estimate.margin(truth) + tolerance,
            "{}: {truth} arrives, samples say {estimate:?} at {ctx:?}",
            case.name
        );
    }
}

/// A Dirac light returns the given irradiance (of a plane that faces it) with pdf 1, and its
/// density is 0.
///
/// # Panics
/// If the law does not hold.
pub fn dirac_li_is<C: ColorModel, L: Light<C>>(
    case: &LightCase<'_, C, L>,
    irradiance: impl Fn(Vec3) -> f64,
) {
    let mut rng = Rng::new(43);
    for ctx in &case.contexts {
        let truth = irradiance(ctx.p);
        let sample = case.li(ctx, rng.vec2(), PdfCoverage::Complete);
        let l = sample.map_or(0.0, |s| s.l);
        assert!(
            (l - truth).abs() <= Estimate::ROUNDING * truth,
            "{}: {truth} arrives, not {l} at {ctx:?}",
            case.name
        );
        if let Some(sample) = sample {
            let pdf = case.light.pdf_li(ctx, sample.wi, PdfCoverage::Complete);
            assert_eq!(
                (sample.pdf, pdf),
                (1.0, 0.0),
                "{}: densities of a Dirac",
                case.name
            );
        }
    }
}
