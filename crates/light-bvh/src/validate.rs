use light_bounds::{LightBoundsError, LightExtent, LightId};

use crate::LightBvhError;

/// Whether every one of `lights` can be one; the index of a light is its id.
///
/// # Errors
/// [`LightBvhError`] names the first light that cannot.
pub fn validate(lights: &[LightExtent]) -> Result<(), LightBvhError> {
    let mut all = (0..).map(LightId).zip(lights);
    all.try_for_each(|(light, extent)| validate_light(light, extent))
}

/// Whether `extent` can be that of a light.
pub(crate) fn validate_light(light: LightId, extent: &LightExtent) -> Result<(), LightBvhError> {
    match extent {
        LightExtent::Bounded(bounds) => bounds
            .validate()
            .map_err(|reason| LightBvhError::BadBounds { light, reason }),
        LightExtent::Lobe(bounds, lobe) => {
            let lobe = if lobe.is_valid() {
                Ok(())
            } else {
                Err(LightBoundsError::Lobe)
            };
            let valid = bounds.validate().and(lobe);
            valid.map_err(|reason| LightBvhError::BadBounds { light, reason })
        }
        LightExtent::Infinite(bounds) => bounds
            .validate()
            .map_err(|reason| LightBvhError::BadInfiniteBounds { light, reason }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use light_bounds::{
        EmissionLobe, InfiniteBounds, InfiniteBoundsError, LightBounds, LightBoundsError,
    };
    use light_math::Aabb;
    use light_math::glam::Vec3;

    #[test]
    fn the_first_bad_light_is_named() {
        let sky = LightExtent::Infinite(InfiniteBounds::uniform(1.0));
        assert_eq!(validate(&[sky]), Ok(()), "a sky");
        let no_sky = LightExtent::Infinite(InfiniteBounds::uniform(-1.0));
        let empty = LightExtent::Bounded(LightBounds::EMPTY);
        let bad_sky = LightBvhError::BadInfiniteBounds {
            light: LightId(1),
            reason: InfiniteBoundsError::Fluence,
        };
        assert_eq!(validate(&[sky, no_sky, empty]), Err(bad_sky), "the sky");
        let bad_box = LightBvhError::BadBounds {
            light: LightId(0),
            reason: LightBoundsError::Box,
        };
        assert_eq!(validate(&[empty, no_sky]), Err(bad_box), "the box");
    }
    #[test]
    fn a_lobe_that_is_none_is_refused() {
        let bounds = LightBounds {
            bounds: Aabb::from_point(Vec3::ZERO),
            w: Vec3::Z,
            ..LightBounds::EMPTY
        };
        let of = |power| {
            let mean = Vec3::Z * 0.5;
            let lobe = EmissionLobe {
                power,
                mean,
                spread: 0.1,
            };
            validate(&[LightExtent::Lobe(bounds, lobe)])
        };
        assert_eq!(of(1.0), Ok(()), "a lobe");
        let bad = LightBvhError::BadBounds {
            light: LightId(0),
            reason: LightBoundsError::Lobe,
        };
        assert_eq!(of(-1.0), Err(bad), "its power is negative");
    }
}
