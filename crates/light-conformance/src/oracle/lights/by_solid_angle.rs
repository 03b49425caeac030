use super::area::{At, Cosines, Shape, per_solid_angle};
use super::exact_light::Receiver;
use crate::oracle::{ExactRectangle, ExactTriangle, Jitter};
use glam::{DVec2, DVec3};

/// A shape as a receiver sees it.
pub(super) trait Seen {
    /// A place on the shape.
    type Place: Copy;

    fn solid_angle(&self) -> f64;

    /// A place, evenly by solid angle.
    fn sample(&self, u: DVec2) -> Self::Place;

    fn invert(&self, place: Self::Place) -> DVec2;
}

impl Seen for ExactRectangle {
    /// Fractions of the two edges.
    type Place = DVec2;

    fn solid_angle(&self) -> f64 {
        self.solid_angle()
    }

    fn sample(&self, u: DVec2) -> DVec2 {
        self.sample(u)
    }

    fn invert(&self, place: DVec2) -> DVec2 {
        self.invert(place)
    }
}

impl Seen for ExactTriangle {
    /// Barycentric coordinates.
    type Place = DVec3;

    fn solid_angle(&self) -> f64 {
        self.solid_angle()
    }

    fn sample(&self, u: DVec2) -> DVec3 {
        self.sample(u)
    }

    fn invert(&self, place: DVec3) -> DVec2 {
        self.invert(place)
    }
}

/// A shape that is sampled by solid angle and cosine, or by area where it is small.
pub(super) trait BySolidAngle: Shape {
    type Seen: Seen;

    /// The point at a place.
    fn at(&self, place: <Self::Seen as Seen>::Place) -> At;

    /// How the receiver sees the shape, and the map of its random numbers; none where it is small.
    fn seen(&self, from: &Receiver, jitter: &mut Jitter) -> Option<(Self::Seen, Cosines)>;

    /// The place that a ray passes, if it hits.
    fn hit(&self, o: DVec3, d: DVec3) -> Option<<Self::Seen as Seen>::Place>;

    /// The place on an edge that a ray passes at a distance that the inputs round off; none where
    /// they are not moved.
    fn hit_edge(
        &self,
        _o: DVec3,
        _d: DVec3,
        _jitter: &mut Jitter,
    ) -> Option<<Self::Seen as Seen>::Place> {
        None
    }
}

/// [`Shape::toward`] of such a shape.
pub(super) fn toward<S: BySolidAngle>(
    shape: &S,
    from: &Receiver,
    u: DVec2,
    jitter: &mut Jitter,
) -> Option<(At, f64)> {
    match shape.seen(from, jitter) {
        Some((seen, cosines)) => {
            let (u, pdf) = cosines.sample(jitter.numbers(u));
            let at = shape.at(seen.sample(jitter.numbers(u)));
            Some((at, pdf / seen.solid_angle()))
        }
        None => {
            let at = shape.sample(u, jitter)?;
            let pdf = per_solid_angle(1.0 / shape.area(), from, &at, jitter)?;
            Some((at, pdf))
        }
    }
}

/// [`Shape::pdf_toward`] of such a shape.
pub(super) fn pdf_toward<S: BySolidAngle>(
    shape: &S,
    from: &Receiver,
    wi: DVec3,
    jitter: &mut Jitter,
) -> f64 {
    let edge = shape.hit_edge(from.p, wi, jitter);
    let hit = shape.hit(from.p, jitter.vector(wi, 1.0));
    let Some(place) = hit.or(edge) else {
        return 0.0;
    };
    match shape.seen(from, jitter) {
        Some((seen, cosines)) => cosines.pdf(seen.invert(place)) / seen.solid_angle(),
        None => {
            let at = shape.at(place);
            per_solid_angle(1.0 / shape.area(), from, &at, jitter).unwrap_or(0.0)
        }
    }
}
