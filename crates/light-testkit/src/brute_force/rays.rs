use light_math::glam::{DVec3, Vec3};
use light_sources::{Light, LightRef};

use super::arrival::{BACKWARD_ERROR, DENSITY_ROUNDING, excess};
use super::model::Model;
use super::stratified::{Stratified, place_in_square};
use crate::Rng;

/// Rows of cells of the first comparison, and of the one that confirms a difference.
const SIDES: [u32; 2] = [32, 256];

/// The mean of what rays carry is what leaves the light, in power, direction and origin: the power
/// over the channels, then the integrals of direction and of the place from `center`, weighted by
/// the power in the last channel. Densities of rays are those of their query.
pub(super) fn leaving_holds<M: Model>(
    light: &LightRef<'_, M>,
    wavelengths: &M::Wavelengths,
    coordinates: f64,
    center: DVec3,
    rng: &mut Rng,
    leaving: impl Fn(u32, &mut Rng) -> Stratified<10>,
) -> Result<(), String> {
    let mut fault = String::new();
    for side in SIDES {
        let (mut strays, mut samples, mut stray) = (0u32, 0u32, String::new());
        let found = Stratified::<10>::over_square(side, rng, |u, rng| {
            let u = place_in_square(u);
            let Some(sample) = light.sample_le(u, rng.vec2(), wavelengths) else {
                return [0.0; 10];
            };
            samples += 1;
            let asked = light.pdf_le(&sample.ray);
            let is_same = |pdf: f32, asked: f32| {
                // A Dirac counts as 1 in a sample, as 0 in a query.
                (pdf == 1.0 && asked == 0.0)
                    || (pdf - asked).abs() <= DENSITY_ROUNDING * pdf.max(asked)
            };
            if !(is_same(sample.pdf.pos, asked.pos) && is_same(sample.pdf.dir, asked.dir)) {
                strays += 1;
                stray = format!("queried {asked:?}, {sample:?}");
            }
            let direction = sample.ray.direction.as_dvec3();
            let cos_theta = if sample.ray.normal == Vec3::ZERO {
                1.0
            } else {
                direction.dot(sample.ray.normal.as_dvec3()).abs()
            };
            let density = f64::from(sample.pdf.pos) * f64::from(sample.pdf.dir);
            let power = M::values(sample.l).map(|l| l * cos_theta / density);
            let position = (sample.ray.origin.as_dvec3() - center) * power[3];
            let [[a, b, c], [d, e, f]] = [direction * power[3], position].map(|v| v.to_array());
            let [r, s, t, u] = power;
            [r, s, t, u, a, b, c, d, e, f]
        });
        if f64::from(strays) > 2e-3 * f64::from(samples) + 2.0 {
            return Err(format!(
                "{strays} rays of {samples} stray, the last {stray}"
            ));
        }
        let expected = leaving(side, rng);
        let mut margin = found.margin(&expected);
        let [found, expected] = [found, expected].map(|s| s.values());
        for (i, margin) in margin.iter_mut().enumerate().skip(4) {
            let size = if i < 7 { 1.0 } else { coordinates };
            *margin += expected[3] * (BACKWARD_ERROR * size + 1e-4 * size.min(1.0));
        }
        let off = excess(&found, &expected, &margin);
        if off == [0.0; 10] {
            return Ok(());
        }
        fault = format!(
            "{expected:?} leaves (power, direction, origin), rays say {found:?}, beyond chance by \
             {off:?}"
        );
    }
    Err(fault)
}
