use light_bounds::{LightGroups, LightSampleContext};

use crate::importance::context_receiver::{AnyKind, ContextReceiver, with_kind};
use crate::importance::receiver::Receiver;
use crate::simd::VectorWork;

/// A computation over a tree that is compiled for each kind of receiver.
#[expect(unnameable_types, reason = "nobody else writes queries")]
pub trait Query {
    type Output;

    /// Runs it for `receiver`. Every implementation is `#[inline(always)]`: its caller chooses the
    /// vectors.
    fn run<R: Receiver>(self, receiver: &R) -> Self::Output;
}

/// What a query of a tree takes as its receiver: a reference to a [`LightSampleContext`] or to a
/// [`Receiver`].
pub trait IntoReceiver: Copy {
    /// The receiver by value, prepared for several queries.
    type Kept: KeptReceiver;

    /// Prepares it.
    fn keep(self) -> Self::Kept;

    /// The groups of lights to choose from; by default all.
    #[inline]
    fn groups(self) -> LightGroups {
        LightGroups::ALL
    }
}

/// A receiver that queries keep: a [`Receiver`] or a [`ContextReceiver`].
pub trait KeptReceiver: Copy {
    /// Runs `query` for this receiver.
    #[doc(hidden)]
    fn run<Q: Query>(&self, query: Q) -> Q::Output;
}

impl<R: Receiver> KeptReceiver for R {
    #[inline(always)]
    fn run<Q: Query>(&self, query: Q) -> Q::Output {
        query.run(self)
    }
}

impl KeptReceiver for ContextReceiver {
    #[inline(always)]
    fn run<Q: Query>(&self, query: Q) -> Q::Output {
        // Without an operating system memory for code is short.
        if cfg!(target_os = "none") {
            query.run(&AnyKind(self))
        } else {
            with_kind!(self, receiver => query.run(receiver))
        }
    }
}

impl<R: KeptReceiver> IntoReceiver for &R {
    type Kept = R;

    #[inline(always)]
    fn keep(self) -> R {
        *self
    }
}

impl IntoReceiver for &LightSampleContext {
    type Kept = ContextReceiver;

    #[inline(always)]
    fn keep(self) -> ContextReceiver {
        self.into()
    }

    #[inline(always)]
    fn groups(self) -> LightGroups {
        self.groups
    }
}

/// A receiver that asks for the lights of some groups.
#[cfg(feature = "alloc")]
#[derive(Clone, Copy, Debug)]
pub(crate) struct InGroups<R> {
    pub(crate) receiver: R,
    pub(crate) groups: LightGroups,
}

#[cfg(feature = "alloc")]
impl From<&LightSampleContext> for InGroups<ContextReceiver> {
    #[inline(always)]
    fn from(ctx: &LightSampleContext) -> Self {
        Self {
            receiver: ctx.keep(),
            groups: ctx.groups(),
        }
    }
}

#[cfg(feature = "alloc")]
impl<R: KeptReceiver> IntoReceiver for &InGroups<R> {
    type Kept = R;

    #[inline(always)]
    fn keep(self) -> R {
        self.receiver
    }

    #[inline(always)]
    fn groups(self) -> LightGroups {
        self.groups
    }
}

/// A query and for whom it is run.
#[cfg_attr(test, derive(Clone, Copy))]
pub(crate) struct QueryFor<'a, R, Q>(pub(crate) &'a R, pub(crate) Q);

impl<R: KeptReceiver, Q: Query> VectorWork for QueryFor<'_, R, Q> {
    type Output = Q::Output;

    #[inline(always)]
    fn run(self) -> Q::Output {
        self.0.run(self.1)
    }
}

#[cfg(all(test, feature = "alloc"))]
mod tests {
    use super::*;
    use crate::LightBvh;
    use crate::importance::position::FAR;
    use alloc::vec::Vec;
    use light_bounds::{Gloss, LightBounds, LightExtent, LightId};
    use light_math::Aabb;
    use light_math::fraction::stratum;
    use light_math::glam::Vec3;

    #[test]
    fn one_type_for_all_kinds_gives_the_bits_of_each_kind() {
        let lights: Vec<_> = (0..40)
            .map(|i| {
                let p = Vec3::new((i * 7 % 40) as f32, (i * 11 % 40) as f32, i as f32);
                LightExtent::Bounded(LightBounds {
                    bounds: Aabb::from_point(p),
                    w: Vec3::X,
                    phi: 1.0,
                    cos_theta_o: -1.0,
                    cos_theta_e: 0.0,
                    two_sided: false,
                })
            })
            .collect();
        let tree = LightBvh::build(&lights).expect("valid lights");
        let (p, n) = (Vec3::new(20.0, 20.0, 5.0), Vec3::Z);
        let surface = LightSampleContext::surface(p, n, n);
        let gloss = Gloss {
            wo: Vec3::Z,
            alpha: 0.1,
            diffuse: 0.5,
        };
        for ctx in [
            surface.with_gloss(gloss),
            LightSampleContext::two_sided(p, n, n),
            LightSampleContext::medium(p),
            LightSampleContext::segment(p, Vec3::new(1.0, 2.0, 30.0)),
            surface,
        ] {
            let kept = (&ctx).keep();
            let any = AnyKind(&kept);
            for u in (0..64).map(|i| stratum(i, 64, 1 << 63)) {
                assert_eq!(tree.sample(&any, u), tree.sample(&ctx, u), "{ctx:?}");
            }
            for light in (0..40).map(LightId) {
                assert_eq!(tree.pmf(&any, light), tree.pmf(&ctx, light), "{ctx:?}");
            }
        }
    }

    /// Beyond the reach of the tree a point is taken to be nearer. A light that is above its
    /// horizon may seem to be below it then, so that the normal does not count.
    #[test]
    fn a_normal_does_not_count_where_coordinates_are_clamped() {
        let lights = [Vec3::ZERO, Vec3::Y].map(|p| {
            LightExtent::Bounded(LightBounds {
                bounds: Aabb::from_point(p),
                w: Vec3::X,
                phi: 1.0,
                cos_theta_o: -1.0,
                cos_theta_e: 0.0,
                two_sided: false,
            })
        });
        let tree = LightBvh::build(&lights).expect("valid lights");
        for axis in [
            Vec3::X,
            Vec3::Y,
            Vec3::Z,
            Vec3::NEG_X,
            Vec3::NEG_Y,
            Vec3::NEG_Z,
        ] {
            let near = LightSampleContext::surface(axis * FAR, axis, axis);
            assert_eq!(tree.pmf(&near, LightId(0)), 0.0, "below the horizon");
            let p = axis * (2.0 * FAR);
            let far = LightSampleContext::surface(p, axis, axis);
            let pmf = tree.pmf(&far, LightId(0));
            assert!(pmf > 0.0, "{axis}: {pmf}");
            assert_eq!(
                pmf,
                tree.pmf(&LightSampleContext::medium(p), LightId(0)),
                "{axis}"
            );
        }
    }
}
