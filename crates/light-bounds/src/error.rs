use core::fmt;

/// Why [`LightBounds`](crate::LightBounds) are invalid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum LightBoundsError {
    /// The box is empty, or a corner is not a finite number.
    Box,
    /// The axis is not a unit vector.
    Axis,
    /// The power is negative, infinite or not a number.
    Power,
    /// A cosine lies outside of `[-1, 1]`.
    Cosine,
    /// A moment of the [lobe](crate::EmissionLobe) is negative or not finite, or the mean direction
    /// is longer than 1.
    Lobe,
}

impl fmt::Display for LightBoundsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Box => "the box of a light is empty or not finite",
            Self::Axis => "the axis of a light is no unit vector",
            Self::Power => "the power of a light is negative or not finite",
            Self::Cosine => "a cosine of a light's bounds is outside of [-1, 1]",
            Self::Lobe => {
                "a moment of a light's emission is negative or not finite, or its mean is longer \
                 than one"
            }
        })
    }
}

impl core::error::Error for LightBoundsError {}

/// Why [`InfiniteBounds`](crate::InfiniteBounds) are invalid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum InfiniteBoundsError {
    /// The fluence is negative, infinite or not a number.
    Fluence,
    /// The mean direction is longer than 1, or not a number.
    Mean,
    /// The cone has no unit axis, or its cosine is neither in `[-1, 1]` nor that of the empty cone.
    Cone,
}

impl fmt::Display for InfiniteBoundsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Fluence => "the fluence of a light at infinity is negative or not finite",
            Self::Mean => "the mean direction of a light at infinity is longer than one",
            Self::Cone => "the cone of a light at infinity has no unit axis or no cosine",
        })
    }
}

impl core::error::Error for InfiniteBoundsError {}
