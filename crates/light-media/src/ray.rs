use light_math::glam::{Affine3A, Vec3};

/// A ray through media: the points `o + t d`. In a transformed space the direction
/// may have another length than 1; `t` is still a distance in scene units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Origin, the point at `t = 0`.
    pub o: Vec3,
    /// Direction; of unit length in the scene.
    pub d: Vec3,
}

impl Ray {
    /// The point at distance `t`.
    #[inline]
    #[must_use]
    pub fn at(&self, t: f32) -> Vec3 {
        self.o + self.d * t
    }

    /// The same ray in another space, with the same `t` for the same point.
    #[inline]
    pub(crate) fn transformed(&self, transform: &Affine3A) -> Self {
        Self {
            o: transform.transform_point3(self.o),
            d: transform.transform_vector3(self.d),
        }
    }
}

/// The part of a ray from `t0` to `t1`, with `0 <= t0 <= t1`, in scene units.
///
/// Any other span, also one with an end that is NaN, is empty: media clip it to nothing, so that
/// its transmittance is 1 and nothing on it emits or scatters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    /// Where it begins.
    pub t0: f32,
    /// Where it ends.
    pub t1: f32,
}

impl Span {
    /// The span from `t0` to `t1`; `None` when it is empty, which includes ends that are negative
    /// or NaN.
    #[must_use]
    pub fn new(t0: f32, t1: f32) -> Option<Self> {
        (t0 >= 0.0 && t0 < t1).then_some(Self { t0, t1 })
    }

    /// Its length; the largest finite number for an unbounded span, so that its transmittance in
    /// vacuum is 1.
    #[inline]
    #[must_use]
    pub fn length(&self) -> f32 {
        (self.t1 - self.t0).min(f32::MAX)
    }

    /// The intersection of both; `None` when it is empty.
    #[must_use]
    pub fn intersection(&self, other: &Self) -> Option<Self> {
        Self::new(self.t0.max(other.t0), self.t1.min(other.t1))
    }
}
