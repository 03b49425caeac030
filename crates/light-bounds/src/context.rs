use crate::glam::Vec3;
use light_math::direction;

/// Who asks for light: a point on a surface, or a point in a medium.
///
/// Lengths are in scene units. Both normals are unit vectors, or both zero in a medium. Samplers
/// read [`ns`](Self::ns) and no other normal; lights read both, to move the point off the surface
/// along [`n`](Self::n).
///
/// Samplers keep their laws for any numbers in here. A normal of another length counts by its
/// direction, and one without a direction as none: see [`unit_ns`](Self::unit_ns). A position or a
/// segment that is not finite is somewhere, and always in the same place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightSampleContext {
    /// The point.
    pub p: Vec3,
    /// Half widths of the box around `p` in which the exact point lies: the rounding error of the
    /// intersection.
    pub p_error: Vec3,
    /// Geometric normal.
    pub n: Vec3,
    /// Shading normal.
    pub ns: Vec3,
    /// From which sides light reaches the surface.
    pub sides: ReceiverSides,
    /// From `p` to the other end of a ray segment in a medium; zero for a point.
    pub segment: Vec3,
    /// How the surface mirrors, if it is known and worth a closer look; samplers may ignore it.
    pub gloss: Option<Gloss>,
}

/// How a surface reflects more than a matt one: about
/// `diffuse / pi + (1 - diffuse) D G / (4 cos cos)`, GGX microfacets.
///
/// Only a hint for choosing lights: it may be rough, and no light is lost by it. Numbers outside of
/// their domain are moved into it; without a direction to the viewer the surface counts as matt.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gloss {
    /// Unit vector to the viewer.
    pub wo: Vec3,
    /// Width of the distribution of facets, in (0, 1].
    pub alpha: f32,
    /// The share of all reflected light that is reflected as by a matt surface, in [0, 1].
    pub diffuse: f32,
}

/// From which sides light reaches a surface.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ReceiverSides {
    /// From the side of its normal only: the surface is opaque.
    #[default]
    Front,
    /// From both sides: the surface transmits light.
    Both,
}

impl LightSampleContext {
    /// A point on a surface with geometric normal `n` and shading normal `ns`, known exactly.
    #[must_use]
    pub const fn surface(p: Vec3, n: Vec3, ns: Vec3) -> Self {
        Self {
            p,
            p_error: Vec3::ZERO,
            n,
            ns,
            sides: ReceiverSides::Front,
            segment: Vec3::ZERO,
            gloss: None,
        }
    }

    /// A point on a surface that transmits light, so that light from behind counts as well.
    #[must_use]
    pub const fn two_sided(p: Vec3, n: Vec3, ns: Vec3) -> Self {
        Self {
            sides: ReceiverSides::Both,
            ..Self::surface(p, n, ns)
        }
    }

    /// A ray segment in a medium, from `p` to `p + segment`: lights count by what they give along
    /// all of it.
    ///
    /// The default hierarchy chooses for the segment as a whole; other samplers, and lights, take
    /// it for the point `p`.
    #[must_use]
    pub const fn segment(p: Vec3, segment: Vec3) -> Self {
        Self {
            segment,
            ..Self::medium(p)
        }
    }

    /// A point in a medium: light counts from all sides alike.
    #[must_use]
    pub const fn medium(p: Vec3) -> Self {
        Self::surface(p, Vec3::ZERO, Vec3::ZERO)
    }

    /// The same context with the rounding error of `p`, one half width per axis.
    #[must_use]
    pub const fn with_error(self, p_error: Vec3) -> Self {
        Self { p_error, ..self }
    }

    /// The same context on a surface that mirrors.
    #[must_use]
    pub const fn with_gloss(self, gloss: Gloss) -> Self {
        Self {
            gloss: Some(gloss),
            ..self
        }
    }

    /// The direction of the shading normal; `None` in a medium, and for a normal that has no
    /// direction: zero, infinite, or not a number.
    ///
    /// A unit vector to rounding comes back to the bit: see [`direction`].
    #[inline]
    #[must_use]
    pub fn unit_ns(&self) -> Option<Vec3> {
        direction(self.ns)
    }

    /// Whether the point has no surface, so no normal; or one without a direction.
    #[inline]
    #[must_use]
    pub fn is_medium(&self) -> bool {
        self.unit_ns().is_none()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn constructors_keep_what_they_are_given() {
        let segment = LightSampleContext::segment(Vec3::X, Vec3::Y);
        assert_eq!((segment.p, segment.segment), (Vec3::X, Vec3::Y), "the way");
        assert!(segment.is_medium(), "no normal");
        let gloss = Gloss {
            wo: Vec3::Z,
            alpha: 0.25,
            diffuse: 0.5,
        };
        let error = Vec3::splat(1e-4);
        let ctx = LightSampleContext::two_sided(Vec3::ONE, Vec3::X, Vec3::Z)
            .with_gloss(gloss)
            .with_error(error);
        assert_eq!(ctx.gloss, Some(gloss), "gloss");
        assert_eq!(ctx.p_error, error, "error");
        assert_eq!((ctx.n, ctx.ns), (Vec3::X, Vec3::Z), "normals");
        assert_eq!(ctx.sides, ReceiverSides::Both, "sides");
        assert_eq!(ctx.unit_ns(), Some(Vec3::Z), "a unit normal, to the bit");
    }
}
