use light_bounds::LightSampleContext;
use light_math::Frame;
use light_math::glam::Vec3;
use light_sources::{ColorModel, EmittedRay, Light, PdfCoverage, Radiance};

use super::case::le;
use super::{LightCase, SAMPLES, STRAY};
use crate::{Cap, DensityTest, Estimate, Rng, kolmogorov_smirnov_uniform};

/// Directions of rays that leave follow `pdf_le`, for lights whose directions do not depend on
/// where a ray starts.
///
/// `cap` holds all directions of travel, `origin` is the origin of the rays for `pdf_le`.
///
/// # Panics
/// If the law does not hold.
pub fn le_directions_follow_their_density<C: ColorModel, L: Light<C>>(
    case: &LightCase<'_, C, L>,
    cap: &Cap,
    origin: Vec3,
) {
    let test = DensityTest::default();
    let outcome = test.cap(
        cap,
        |rng| {
            le(case, rng.vec2(), rng.vec2())
                .ray
                .map(|ray| ray.direction)
        },
        |w| case.light.pdf_le(&EmittedRay::from_point(origin, w)).dir,
    );
    let strays = f64::from(outcome.impossible + outcome.outside) / f64::from(test.samples);
    assert!(
        outcome.chi_squared.passes() && strays <= STRAY,
        "{}: rays do not follow the density of their direction: {outcome:?}",
        case.name
    );
}

/// Rays that leave a diffuse surface are even in the squared sine of the angle with its normal, and
/// in azimuth.
///
/// # Panics
/// If the law does not hold.
pub fn le_directions_are_diffuse<C: ColorModel, L: Light<C>>(case: &LightCase<'_, C, L>) {
    let mut rng = Rng::new(48);
    let (mut sin_sq, mut azimuths) = (Vec::new(), Vec::new());
    while sin_sq.len() < 2 * SAMPLES as usize {
        let Some(ray) = le(case, rng.vec2(), rng.vec2()).ray else {
            continue;
        };
        let w = Frame::from_z(ray.normal).to_local(ray.direction);
        let [x, y] = [w.x, w.y].map(f64::from);
        sin_sq.push((x * x + y * y).min(1.0 - f64::EPSILON));
        azimuths.push((y.atan2(x) / core::f64::consts::TAU).rem_euclid(1.0));
    }
    for (what, numbers) in [("angles", &mut sin_sq), ("azimuths", &mut azimuths)] {
        let outcome = kolmogorov_smirnov_uniform(numbers);
        assert!(outcome.passes(), "{}: {what}: {outcome:?}", case.name);
    }
}

/// Where rays start is even over the surface, for lights that emit equally in all directions.
/// `place` takes a point of the surface to the unit square so that equal areas stay equal.
///
/// # Panics
/// If the law does not hold.
pub fn le_origins_are_even<C: ColorModel, L: Light<C>>(
    case: &LightCase<'_, C, L>,
    place: impl Fn(Vec3) -> [f64; 2],
) {
    let outcome = DensityTest::default().square(
        |rng| {
            let ray = le(case, rng.vec2(), rng.vec2()).ray?;
            let at = place(ray.origin).map(|x| x as f32);
            Some(at.into())
        },
        |_| 1.0,
    );
    outcome.assert(&format!("{}: origins", case.name));
}

/// A sphere around a bounded light, or one in the middle of a scene that infinite lights surround,
/// is lit alike by rays that leave and by samples from its points: the power that passes each part
/// of it.
///
/// # Panics
/// If the law does not hold.
pub fn rays_and_samples_light_alike<C: ColorModel, L: Light<C>>(
    case: &LightCase<'_, C, L>,
    center: Vec3,
    radius: f32,
) {
    const GRID: [u8; 2] = [6, 4];
    const RAYS: u32 = 8 * SAMPLES;
    let [columns, rows] = GRID.map(f64::from);
    let sphere = Cap::sphere();
    let mut rng = Rng::new(49);
    let passing: Vec<(Option<[u8; 2]>, f64)> = (0..RAYS)
        .map(|_| {
            let left = le(case, rng.vec2(), rng.vec2());
            let passed = left.ray.and_then(|ray| crossing(&ray, center, radius));
            let cell = passed.map(|outward| {
                let [x, y] = sphere.square(outward);
                [
                    ((x * columns) as u8).min(GRID[0] - 1),
                    ((y * rows) as u8).min(GRID[1] - 1),
                ]
            });
            (cell, left.power)
        })
        .collect();

    let bounded = case.light.bounds().is_some();
    let phi = f64::from(case.light.phi(&case.wavelengths).average());
    let cell_area = 4.0 * core::f64::consts::PI * f64::from(radius).powi(2) / (columns * rows);
    for cell in (0..GRID[0]).flat_map(|x| (0..GRID[1]).map(move |y| [x, y])) {
        let mut rays = passing.iter();
        let mut by_rays = Estimate::of(RAYS, || match rays.next() {
            Some((at, power)) if *at == Some(cell) => *power,
            _ => 0.0,
        });
        let by_samples = Estimate::of(SAMPLES / 2, || {
            let [x, y] = cell.map(f64::from);
            let outward = sphere.direction([(x + rng.f64()) / columns, (y + rng.f64()) / rows]);
            let ctx = LightSampleContext::medium(center + outward * radius);
            let sample = case.li(&ctx, rng.vec2(), PdfCoverage::Complete);
            sample.map_or(0.0, |s| {
                // Out of the sphere around a light, into the one that lights at infinity surround.
                let cos = f64::from(s.wi.dot(if bounded { -outward } else { outward }));
                cell_area * s.l * cos.max(0.0) / f64::from(s.pdf)
            })
        });
        // Of the few rays that pass a dim part there may be none, which says nothing of their
        // spread.
        let of_few = (phi * by_samples.mean / f64::from(RAYS)).sqrt();
        by_rays.standard_error = by_rays.standard_error.max(of_few);
        assert!(
            by_rays.agrees_with_estimate(&by_samples),
            "{}: through {cell:?} pass {by_rays:?} by rays, {by_samples:?} by samples",
            case.name
        );
    }
}

/// The unit vector from the centre to where a ray passes the sphere: on its way out if it starts
/// inside, in otherwise.
fn crossing(ray: &EmittedRay, center: Vec3, radius: f32) -> Option<Vec3> {
    let to = |v: Vec3| v.to_array().map(f64::from);
    let (o, d) = (to(ray.origin - center), to(ray.direction));
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let (along, r) = (dot(o, d), f64::from(radius));
    let outside = dot(o, o) - r * r;
    let root = (along * along - outside).sqrt();
    let t = if outside > 0.0 {
        -along - root
    } else {
        -along + root
    };
    let at = |i: usize| ((o[i] + t * d[i]) / r) as f32;
    // NaN where the ray misses.
    (t > 0.0).then(|| Vec3::new(at(0), at(1), at(2)))
}
