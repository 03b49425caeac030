use light_bounds::{LightSampleContext, ReceiverSides};
use light_math::glam::Vec3;

use crate::importance::glossy::GlossyReceiver;
use crate::importance::segment::SegmentReceiver;
use crate::importance::surface::{
    MediumReceiver, Receiver, SurfaceReceiver, TwoSidedReceiver, is_far,
};

/// A question to a tree that any receiver may ask.
pub(crate) trait Query {
    type Answer;

    /// The answer as `receiver` sees the tree. To be inlined where it is asked: there the vectors are chosen.
    fn of<R: Receiver>(self, receiver: &R) -> Self::Answer;
}

/// Who turns into a receiver to ask a [`Query`].
pub(crate) trait Asker {
    fn ask<Q: Query>(self, query: Q) -> Q::Answer;
}

/// A receiver asks as it is.
pub(crate) struct Oneself<'a, R>(pub(crate) &'a R);

impl<R: Receiver> Asker for Oneself<'_, R> {
    #[inline(always)]
    fn ask<Q: Query>(self, query: Q) -> Q::Answer {
        query.of(self.0)
    }
}

/// A context asks as the receiver that it stands for: a ray segment, a point in a medium, or a point on a surface by its shading normal.
impl Asker for &LightSampleContext {
    #[inline(always)]
    fn ask<Q: Query>(self, query: Q) -> Q::Answer {
        if self.segment != Vec3::ZERO {
            return query.of(&SegmentReceiver::new(self.p, self.segment));
        }
        // Where coordinates had to be clamped, directions to lights mean nothing.
        let normal = self.unit_ns().filter(|_| !is_far(self.p));
        let Some(ns) = normal else {
            return query.of(&MediumReceiver::new(self.p));
        };
        match (self.sides, &self.gloss) {
            (ReceiverSides::Front, None) => query.of(&SurfaceReceiver::facing(self.p, ns)),
            (ReceiverSides::Front, Some(gloss)) => {
                query.of(&GlossyReceiver::facing(self.p, ns, gloss))
            }
            (ReceiverSides::Both, _) => query.of(&TwoSidedReceiver::facing(self.p, ns)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::LightBvh;
    use crate::importance::surface::FAR;
    use light_bounds::{LightBounds, LightExtent, LightId};
    use light_math::Aabb;

    /// Beyond the reach of the tree a point is taken to be nearer. A light that is above its horizon may seem to be below it then, so
    /// that the normal does not count.
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
