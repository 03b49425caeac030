use crate::glam::Vec3;
use light_math::direction;

/// The receiver of light: a point on a surface, a point in a medium, or a ray segment in a medium.
///
/// Lengths are in scene units. Both normals are unit vectors, or both zero in a medium. Samplers
/// read [`ns`](Self::ns) and no other normal; lights read both, to move the point off the surface
/// along [`n`](Self::n).
///
/// Samplers obey their laws for any values of these fields. Only the direction of a normal is used;
/// a normal without a direction counts as none: see [`unit_ns`](Self::unit_ns). A position or a
/// segment that is not finite is replaced by a finite one, always the same.
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
    /// The gloss of the surface, if known; samplers may ignore it.
    pub gloss: Option<Gloss>,
}

/// Glossy reflection of a surface: its BSDF is about
/// `diffuse / pi + (1 - diffuse) D G / (4 cos cos)`, GGX microfacets.
///
/// Only a hint for choosing lights: it may be approximate, because no light loses its probability
/// by it. Values outside of their domain are clamped; without a direction to the viewer the surface
/// counts as diffuse.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gloss {
    /// Unit vector to the viewer.
    pub wo: Vec3,
    /// Width of the distribution of facets, in (0, 1].
    pub alpha: f32,
    /// The diffuse share of all reflected light, in [0, 1].
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

    /// A ray segment in a medium, from `p` to `p + segment`: lights are weighted by their
    /// contribution along all of it.
    ///
    /// The default hierarchy chooses for the whole segment; other samplers, and lights, use the
    /// point `p`.
    #[must_use]
    pub const fn segment(p: Vec3, segment: Vec3) -> Self {
        Self {
            segment,
            ..Self::medium(p)
        }
    }

    /// A point in a medium: light counts equally from all directions.
    #[must_use]
    pub const fn medium(p: Vec3) -> Self {
        Self::surface(p, Vec3::ZERO, Vec3::ZERO)
    }

    /// The same context with the rounding error of `p`, one half width per axis.
    #[must_use]
    pub const fn with_error(self, p_error: Vec3) -> Self {
        Self { p_error, ..self }
    }

    /// The same context on a glossy surface.
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
    /// A vector of unit length up to rounding is returned with its bits: see [`direction`].
    #[inline]
    #[must_use]
    pub fn unit_ns(&self) -> Option<Vec3> {
        direction(self.ns)
    }

    /// Whether the context has no surface: the shading normal is zero or has no direction.
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
