use crate::oracle::Jitter;
use glam::{DVec2, DVec3};

/// The point that is lit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Receiver {
    pub(crate) p: DVec3,
    /// Zero in a medium.
    pub(crate) ns: DVec3,
    pub(crate) is_incomplete: bool,
}

/// Light that arrives.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Arriving {
    pub(crate) wi: DVec3,
    pub(crate) p: DVec3,
    /// Of the front side.
    pub(crate) n: DVec3,
    pub(crate) uv: DVec2,
    pub(crate) pdf: f64,
    pub(crate) l: DVec3,
}

/// A ray that leaves a light.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Leaving {
    pub(crate) o: DVec3,
    pub(crate) d: DVec3,
    pub(crate) n: DVec3,
    pub(crate) uv: DVec2,
}

/// Densities of a ray: per area, and per solid angle.
pub(crate) type RayPdf = [f64; 2];

/// Bounds of a light that is not at infinity.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ExactBounds {
    pub(crate) min: DVec3,
    pub(crate) max: DVec3,
    pub(crate) w: DVec3,
    pub(crate) phi: f64,
    pub(crate) cos_theta_o: f64,
    pub(crate) cos_theta_e: f64,
    pub(crate) two_sided: bool,
}

/// A light in double precision.
pub(crate) trait ExactLight {
    /// Power of each colour.
    fn phi(&self) -> DVec3;

    /// None at infinity.
    fn bounds(&self) -> Option<ExactBounds>;

    /// The sample toward a point.
    fn sample_li(&self, at: &Receiver, u: DVec2, jitter: &mut Jitter) -> Option<Arriving>;

    /// Its density, 0 for lights of one point or direction.
    fn pdf_li(&self, at: &Receiver, wi: DVec3, jitter: &mut Jitter) -> f64;

    /// The ray for random numbers.
    fn sample_le(&self, u1: DVec2, u2: DVec2, jitter: &mut Jitter) -> Option<Leaving>;

    /// What a ray carries that the light sends, and its densities, where a Dirac counts as 1.
    fn sent(&self, ray: &Leaving, jitter: &mut Jitter) -> (DVec3, RayPdf);

    /// The densities of any ray, where a Dirac counts as 0.
    fn pdf_le(&self, ray: &Leaving, jitter: &mut Jitter) -> RayPdf {
        self.sent(ray, jitter).1
    }

    /// Radiance of a ray that escapes, or of a surface with the normal and in the direction of
    /// `ray`.
    fn radiance(&self, ray: &Leaving, jitter: &mut Jitter) -> DVec3;
}
