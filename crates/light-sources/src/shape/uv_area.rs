#[cfg(feature = "alloc")]
use super::normal::normal_length;
use crate::glam::{Vec2, Vec3};

/// The distribution of the area of a shape over its surface parameters (u, v).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum UvArea {
    /// Uniform over a triangle, which may be degenerate.
    Triangle([Vec2; 3]),
    /// Over the unit square.
    Square(UvDensity),
}

/// The area of a shape per area of its surface parameters, up to a factor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum UvDensity {
    /// Uniform.
    Even,
    /// `sin(pi v)`: of a sphere with the poles at `v = 0` and `v = 1`.
    Sine,
    /// The length of `[at_origin + du u + dv v]`: of a disk, or of a bilinear patch with this
    /// normal.
    Length([Vec3; 3]),
}

#[cfg(feature = "alloc")]
impl UvDensity {
    /// The density at a point of the unit square.
    #[expect(
        clippy::cast_possible_truncation,
        reason = "single precision is enough for a weight"
    )]
    pub(crate) fn at(&self, uv: glam::DVec2) -> f64 {
        match self {
            Self::Even => 1.0,
            Self::Sine => light_math::float::sin(core::f32::consts::PI * (uv.y as f32))
                .max(0.0)
                .into(),
            Self::Length([n, du, dv]) => {
                let n = n.as_dvec3() + du.as_dvec3() * uv.x + dv.as_dvec3() * uv.y;
                normal_length(n.as_vec3()).into()
            }
        }
    }
}
