use crate::glam::Vec3;
use light_math::DirectionCone;

use crate::{EmissionLobe, InfiniteBoundsError, LightBounds};

/// What a sampler knows of a light: bounds in space, or bounds at infinity.
///
/// Samplers are built from `&[LightExtent]`, in which the index of an entry is the light's
/// [`LightId`](crate::LightId).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum LightExtent {
    /// The light has a position.
    Bounded(LightBounds),
    /// The light is a point light whose moments of emission are known. Samplers that do not use
    /// lobes use the bounds alone.
    Lobe(LightBounds, EmissionLobe),
    /// The light is infinitely far away: an environment, or a distant light.
    Infinite(InfiniteBounds),
}

impl LightExtent {
    /// The bounds of a light with a position.
    #[inline]
    #[must_use]
    pub const fn bounded(&self) -> Option<&LightBounds> {
        match self {
            Self::Bounded(bounds) | Self::Lobe(bounds, _) => Some(bounds),
            Self::Infinite(_) => None,
        }
    }

    /// The bounds of a light at infinity.
    #[inline]
    #[must_use]
    pub const fn infinite(&self) -> Option<&InfiniteBounds> {
        match self {
            Self::Bounded(_) | Self::Lobe(..) => None,
            Self::Infinite(bounds) => Some(bounds),
        }
    }
}

impl From<LightBounds> for LightExtent {
    fn from(bounds: LightBounds) -> Self {
        Self::Bounded(bounds)
    }
}

impl From<InfiniteBounds> for LightExtent {
    fn from(bounds: InfiniteBounds) -> Self {
        Self::Infinite(bounds)
    }
}

/// The fluence and the directions of light that arrives from infinity.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct InfiniteBounds {
    /// Integral of the radiance over the sphere of directions, in W·m⁻² or the same multiple of it
    /// as the powers of the other lights; for a distant light its irradiance.
    pub fluence: f32,
    /// Mean of the unit vectors toward the light, weighted by radiance: zero for a uniform sky, a
    /// unit vector for a distant light.
    pub mean: Vec3,
    /// All directions toward the light.
    pub cone: DirectionCone,
}

impl InfiniteBounds {
    /// The bounds of the same radiance from everywhere, in W·m⁻²·sr⁻¹.
    #[must_use]
    pub fn uniform(radiance: f32) -> Self {
        Self {
            fluence: 4.0 * core::f32::consts::PI * radiance,
            mean: Vec3::ZERO,
            cone: DirectionCone::WHOLE_SPHERE,
        }
    }

    /// The bounds of a light in the one direction `wi`, a unit vector toward it, with this
    /// irradiance on a plane that faces it, in W·m⁻².
    #[must_use]
    pub const fn distant(irradiance: f32, wi: Vec3) -> Self {
        Self {
            fluence: irradiance,
            mean: wi,
            cone: DirectionCone::from_direction(wi),
        }
    }

    /// Checks the bounds.
    ///
    /// # Errors
    /// The first rule that is broken.
    pub fn validate(&self) -> Result<(), InfiniteBoundsError> {
        if !(self.fluence >= 0.0 && self.fluence.is_finite()) {
            return Err(InfiniteBoundsError::Fluence);
        }
        if !(self.mean.length_squared() <= 1.0 + EmissionLobe::LENGTH_TOLERANCE) {
            return Err(InfiniteBoundsError::Mean);
        }
        let has_axis =
            self.cone.w.is_normalized() || self.cone.is_empty() || self.cone.is_whole_sphere();
        if !(has_axis && self.cone.cos_theta >= -1.0) {
            return Err(InfiniteBoundsError::Cone);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{LightSampleContext, SampledLight};

    #[test]
    fn bounds_of_either_kind_are_extents() {
        let (near, sky) = (LightBounds::EMPTY, InfiniteBounds::uniform(1.0));
        assert_eq!(LightExtent::from(near), LightExtent::Bounded(near), "near");
        assert_eq!(LightExtent::from(sky), LightExtent::Infinite(sky), "a sky");
    }

    #[test]
    fn named_skies_are_valid() {
        let sky = InfiniteBounds::uniform(0.5);
        let sun = InfiniteBounds::distant(1000.0, Vec3::Z);
        assert_eq!(sky.validate(), Ok(()), "uniform");
        assert_eq!(sun.validate(), Ok(()), "distant");
        assert!(
            (sky.fluence - core::f32::consts::TAU).abs() < 1e-6,
            "4 pi / 2"
        );
    }

    #[test]
    fn each_rule_has_its_error() {
        let sun = InfiniteBounds::distant(1.0, Vec3::Z);
        for fluence in [-1.0, f32::NAN, f32::INFINITY] {
            assert_eq!(
                InfiniteBounds { fluence, ..sun }.validate(),
                Err(InfiniteBoundsError::Fluence),
                "{fluence}"
            );
        }
        for mean in [Vec3::ONE, Vec3::NAN] {
            assert_eq!(
                InfiniteBounds { mean, ..sun }.validate(),
                Err(InfiniteBoundsError::Mean),
                "{mean}"
            );
        }
        for cone in [
            DirectionCone::new(Vec3::ONE, 0.0),
            DirectionCone::new(Vec3::Z, f32::NAN),
            DirectionCone::new(Vec3::Z, -1.5),
        ] {
            assert_eq!(
                InfiniteBounds { cone, ..sun }.validate(),
                Err(InfiniteBoundsError::Cone),
                "{cone:?}"
            );
        }
    }

    /// The example of the README.
    #[test]
    fn sizes() {
        assert_eq!(size_of::<LightBounds>(), 52, "bounds");
        assert_eq!(size_of::<InfiniteBounds>(), 32, "at infinity");
        assert_eq!(size_of::<EmissionLobe>(), 20, "lobe");
        assert_eq!(size_of::<LightExtent>(), 72, "any of them");
        assert_eq!(size_of::<LightSampleContext>(), 80, "a receiver");
        assert_eq!(size_of::<SampledLight>(), 16, "a choice");
    }

    #[test]
    fn an_extent_is_one_or_the_other() {
        let sky = LightExtent::from(InfiniteBounds::uniform(1.0));
        assert!(sky.infinite().is_some() && sky.bounded().is_none(), "sky");
    }
}
