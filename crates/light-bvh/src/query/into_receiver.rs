use light_bounds::{LightSampleContext, ReceiverSides};
use light_math::glam::Vec3;

use crate::importance::glossy::GlossyReceiver;
use crate::importance::medium::MediumReceiver;
use crate::importance::position::is_far;
use crate::importance::receiver::Receiver;
use crate::importance::segment::SegmentReceiver;
use crate::importance::surface::SurfaceReceiver;
use crate::importance::two_sided::TwoSidedReceiver;
use crate::simd::VectorWork;

/// A computation over a tree that is compiled for each kind of receiver.
pub(crate) trait Query {
    type Output;

    /// Runs it for `receiver`. Every implementation is `#[inline(always)]`: its caller chooses the
    /// vectors.
    fn run<R: Receiver>(self, receiver: &R) -> Self::Output;
}

/// A receiver, or what becomes one.
pub(crate) trait IntoReceiver {
    /// Runs `query` for the receiver that this becomes.
    fn run<Q: Query>(self, query: Q) -> Q::Output;
}

impl<R: Receiver> IntoReceiver for &R {
    #[inline(always)]
    fn run<Q: Query>(self, query: Q) -> Q::Output {
        query.run(self)
    }
}

/// A ray segment, a point in a medium, or a point on a surface by its shading normal.
impl IntoReceiver for &LightSampleContext {
    #[inline(always)]
    fn run<Q: Query>(self, query: Q) -> Q::Output {
        if self.segment != Vec3::ZERO {
            return query.run(&SegmentReceiver::new(self.p, self.segment));
        }
        // Where coordinates were clamped, directions to lights mean nothing.
        let normal = self.unit_ns().filter(|_| !is_far(self.p));
        let Some(ns) = normal else {
            return query.run(&MediumReceiver::new(self.p));
        };
        match (self.sides, &self.gloss) {
            (ReceiverSides::Front, None) => query.run(&SurfaceReceiver::facing(self.p, ns)),
            (ReceiverSides::Front, Some(gloss)) => {
                query.run(&GlossyReceiver::facing(self.p, ns, gloss))
            }
            (ReceiverSides::Both, _) => query.run(&TwoSidedReceiver::facing(self.p, ns)),
        }
    }
}

/// A query and for whom it is run.
#[cfg_attr(test, derive(Clone, Copy))]
pub(crate) struct QueryFor<A, Q>(pub(crate) A, pub(crate) Q);

impl<A: IntoReceiver, Q: Query> VectorWork for QueryFor<A, Q> {
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
    use light_bounds::{LightBounds, LightExtent, LightId};
    use light_math::Aabb;

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
