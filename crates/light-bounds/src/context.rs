use crate::LightGroups;
use crate::glam::Vec3;
use light_math::direction;

/// The receiver of light: a point on a surface, a point in a medium, or a ray segment in a medium.
///
/// Lengths are in scene units. Samplers read the shading normal and no other; lights read both
/// normals, to move the point off the surface along the geometric one. Samplers obey their laws for
/// any position and any segment, also those that are not finite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightSampleContext {
    /// The point; of a ray segment its origin.
    pub p: Vec3,
    /// Half widths of the box around `p` in which the exact point lies: the rounding error of the
    /// intersection.
    pub p_error: Vec3,
    /// The groups of lights to choose from.
    pub groups: LightGroups,
    kind: ReceiverKind,
}

/// What kind of receiver a [`LightSampleContext`] is. Normals and the direction to the viewer are
/// unit vectors.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum ReceiverKind {
    /// A point on a surface.
    #[non_exhaustive]
    Surface {
        /// Geometric normal.
        n: Vec3,
        /// Shading normal.
        ns: Vec3,
        /// From which sides light reaches the surface.
        sides: ReceiverSides,
        /// The gloss of the surface, if known; samplers may ignore it.
        gloss: Option<Gloss>,
    },
    /// A point in a medium: light counts equally from all directions.
    Medium,
    /// A ray segment in a medium.
    #[non_exhaustive]
    Segment {
        /// From the origin to the other end; not zero.
        extent: Vec3,
    },
}

/// Glossy reflection of a surface: its BSDF is about
/// `diffuse / pi + (1 - diffuse) D G / (4 cos cos)`, GGX microfacets.
///
/// Only a hint for choosing lights: it may be approximate, because no light loses its probability
/// by it.
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
    ///
    /// Only the directions of the normals are used; a vector of unit length up to rounding keeps
    /// its bits. A normal without a direction (zero, infinite, not a number) is replaced by the
    /// other one; without both the receiver is a point in a medium.
    #[inline]
    #[must_use]
    pub fn surface(p: Vec3, n: Vec3, ns: Vec3) -> Self {
        Self::on_surface(p, n, ns, ReceiverSides::Front)
    }

    /// A point on a surface that transmits light, so that light from behind counts as well. Normals
    /// are those of [`surface`](Self::surface).
    #[inline]
    #[must_use]
    pub fn two_sided(p: Vec3, n: Vec3, ns: Vec3) -> Self {
        Self::on_surface(p, n, ns, ReceiverSides::Both)
    }

    /// A ray segment in a medium, from `p` to `p + extent`: lights are weighted by their
    /// contribution along all of it. One of no extent is a point.
    ///
    /// Samplers that read the context choose for the whole segment; lights use the point `p`.
    #[inline]
    #[must_use]
    pub fn segment(p: Vec3, extent: Vec3) -> Self {
        let kind = if extent == Vec3::ZERO {
            ReceiverKind::Medium
        } else {
            ReceiverKind::Segment { extent }
        };
        Self::known(p, kind)
    }

    /// A point in a medium: light counts equally from all directions.
    #[inline]
    #[must_use]
    pub const fn medium(p: Vec3) -> Self {
        Self::known(p, ReceiverKind::Medium)
    }

    /// The same context with the rounding error of `p`, one half width per axis.
    #[inline]
    #[must_use]
    pub const fn with_error(self, p_error: Vec3) -> Self {
        Self { p_error, ..self }
    }

    /// The same context for the lights of some groups only: light linking, as in
    /// the example [`light_groups`][1].
    ///
    /// [1]: https://github.com/lights-rs/lights/blob/main/crates/lights/examples/light_groups.rs
    #[inline]
    #[must_use]
    pub const fn with_groups(self, groups: LightGroups) -> Self {
        Self { groups, ..self }
    }

    /// The same context on a glossy surface; unchanged in a medium.
    ///
    /// Values outside of their domain are moved into it, not a number to 1; without a direction to
    /// the viewer the surface counts as diffuse.
    #[must_use]
    pub fn with_gloss(mut self, with: Gloss) -> Self {
        if let ReceiverKind::Surface { gloss, .. } = &mut self.kind {
            // Written so that NaN becomes 1.
            let within = |x: f32, low: f32| if x < 1.0 { x.max(low) } else { 1.0 };
            *gloss = direction(with.wo).map(|wo| Gloss {
                wo,
                alpha: within(with.alpha, f32::MIN_POSITIVE),
                diffuse: within(with.diffuse, 0.0),
            });
        }
        self
    }

    /// What kind of receiver this is, with what belongs to it.
    #[inline]
    #[must_use]
    pub const fn kind(&self) -> &ReceiverKind {
        &self.kind
    }

    /// The geometric normal, a unit vector; `None` in a medium.
    #[inline]
    #[must_use]
    pub const fn n(&self) -> Option<Vec3> {
        match self.kind {
            ReceiverKind::Surface { n, .. } => Some(n),
            ReceiverKind::Medium | ReceiverKind::Segment { .. } => None,
        }
    }

    /// The shading normal, a unit vector; `None` in a medium.
    #[inline]
    #[must_use]
    pub const fn ns(&self) -> Option<Vec3> {
        match self.kind {
            ReceiverKind::Surface { ns, .. } => Some(ns),
            ReceiverKind::Medium | ReceiverKind::Segment { .. } => None,
        }
    }

    /// The gloss of the surface, if it is known.
    #[inline]
    #[must_use]
    pub const fn gloss(&self) -> Option<Gloss> {
        match self.kind {
            ReceiverKind::Surface { gloss, .. } => gloss,
            ReceiverKind::Medium | ReceiverKind::Segment { .. } => None,
        }
    }

    #[inline]
    fn on_surface(p: Vec3, n: Vec3, ns: Vec3, sides: ReceiverSides) -> Self {
        let kind = match (direction(n), direction(ns)) {
            (None, None) => ReceiverKind::Medium,
            (n, ns) => {
                let either = n.or(ns).unwrap_or(Vec3::Z);
                ReceiverKind::Surface {
                    n: either,
                    ns: ns.unwrap_or(either),
                    sides,
                    gloss: None,
                }
            }
        };
        Self::known(p, kind)
    }

    const fn known(p: Vec3, kind: ReceiverKind) -> Self {
        Self {
            p,
            p_error: Vec3::ZERO,
            groups: LightGroups::ALL,
            kind,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GLOSS: Gloss = Gloss {
        wo: Vec3::Z,
        alpha: 0.25,
        diffuse: 0.5,
    };

    #[test]
    fn constructors_keep_what_they_are_given() {
        let segment = LightSampleContext::segment(Vec3::X, Vec3::Y);
        assert_eq!(segment.p, Vec3::X, "the origin");
        let extent = Vec3::Y;
        assert_eq!(
            *segment.kind(),
            ReceiverKind::Segment { extent },
            "the extent"
        );
        assert_eq!((segment.n(), segment.ns()), (None, None), "no normal");
        let error = Vec3::splat(1e-4);
        let ctx = LightSampleContext::two_sided(Vec3::ONE, Vec3::X, Vec3::Z)
            .with_gloss(GLOSS)
            .with_error(error);
        assert_eq!(ctx.p_error, error, "error");
        let kind = ReceiverKind::Surface {
            n: Vec3::X,
            ns: Vec3::Z,
            sides: ReceiverSides::Both,
            gloss: Some(GLOSS),
        };
        assert_eq!(*ctx.kind(), kind, "to the bit");
        assert_eq!(
            (ctx.n(), ctx.ns()),
            (Some(Vec3::X), Some(Vec3::Z)),
            "normals"
        );
    }

    #[test]
    fn normals_are_directions_or_replaced() {
        let at = |n, ns| LightSampleContext::surface(Vec3::ONE, n, ns);
        let long = at(Vec3::X * 1e30, Vec3::Y * 1e-30);
        assert_eq!(
            (long.n(), long.ns()),
            (Some(Vec3::X), Some(Vec3::Y)),
            "any length"
        );
        for none in [Vec3::ZERO, Vec3::NAN, Vec3::INFINITY] {
            let (n, ns) = (at(none, Vec3::X), at(Vec3::X, none));
            assert_eq!((n.n(), n.ns()), (Some(Vec3::X), Some(Vec3::X)), "{none}");
            assert_eq!((ns.n(), ns.ns()), (Some(Vec3::X), Some(Vec3::X)), "{none}");
            assert_eq!(
                at(none, none),
                LightSampleContext::medium(Vec3::ONE),
                "{none}"
            );
        }
        let point = LightSampleContext::segment(Vec3::ONE, Vec3::ZERO);
        assert_eq!(point, LightSampleContext::medium(Vec3::ONE), "no extent");
    }

    #[test]
    fn gloss_is_moved_into_its_domain() {
        let floor = LightSampleContext::surface(Vec3::ZERO, Vec3::Z, Vec3::Z);
        let odd = |wo, alpha, diffuse| floor.with_gloss(Gloss { wo, alpha, diffuse }).gloss();
        let moved = odd(Vec3::Z * 7.0, -1.0, 2.0).expect("a direction to the viewer");
        assert!(moved.wo == Vec3::Z && moved.alpha > 0.0 && moved.diffuse == 1.0);
        let moved = odd(Vec3::Z, f32::NAN, f32::NAN).expect("a direction to the viewer");
        assert_eq!((moved.alpha, moved.diffuse), (1.0, 1.0), "not a number");
        assert_eq!(odd(Vec3::ZERO, 0.5, 0.5), None, "no viewer");
        let fog = LightSampleContext::medium(Vec3::ZERO);
        assert_eq!(fog.with_gloss(GLOSS), fog, "no surface");
    }
}
