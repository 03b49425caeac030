use crate::color::Radiance;
use crate::glam::{Vec2, Vec3};
use crate::sample::LightLiSample;
use light_bounds::LightSampleContext;

/// The sample toward a light that is a point: `intensity`, asked for the unit direction away from the light, over the
/// squared distance. `None` in the dark, where the two points meet, and where they are so near or so far that the
/// inverse square is no positive finite number.
pub(crate) fn sample_point<R: Radiance>(
    ctx: &LightSampleContext,
    position: Vec3,
    intensity: impl FnOnce(Vec3) -> R,
) -> Option<LightLiSample<R>> {
    let to_light = position - ctx.p;
    let wi = to_light.try_normalize()?;
    let inv_dist_sq = 1.0 / to_light.length_squared();
    if !(inv_dist_sq > 0.0 && inv_dist_sq.is_finite()) {
        return None;
    }
    let l = intensity(-wi) * inv_dist_sq;
    (!l.is_black()).then_some(LightLiSample {
        l,
        wi,
        pdf: 1.0,
        p_light: position,
        n_light: Vec3::ZERO,
        uv: Vec2::ZERO,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn falls_with_the_squared_distance() {
        let ctx = LightSampleContext::medium(Vec3::ZERO);
        let sample = sample_point(&ctx, Vec3::Z * 2.0, |w| {
            assert_eq!(w, Vec3::NEG_Z, "away from the light");
            Vec3::ONE
        });
        assert_eq!(
            sample.map(|s| (s.l, s.wi)),
            Some((Vec3::splat(0.25), Vec3::Z)),
            "1 / 4"
        );
    }

    #[test]
    fn no_sample_in_the_dark_nor_where_the_square_fails() {
        let ctx = LightSampleContext::medium(Vec3::ZERO);
        assert!(
            sample_point(&ctx, Vec3::Z, |_| Vec3::ZERO).is_none(),
            "dark"
        );
        for distance in [0.0, 1e-30, 1e30, f32::NAN] {
            let sample = sample_point(&ctx, Vec3::Z * distance, |_| Vec3::ONE);
            assert!(sample.is_none(), "distance {distance}");
        }
    }
}
