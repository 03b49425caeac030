//! The results of lights, in double precision.

mod area;
mod at_point;
mod by_solid_angle;
mod disk;
mod flat;
mod goniometric;
mod infinite;
mod patch;
mod picture;
mod portal;
mod projection;
mod rectangle;
mod sphere;
mod spot;
mod triangle;

use super::Jitter;
use crate::{Case, Malformed};
use glam::{DMat3, DVec2, DVec3};

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

/// The light of a line.
pub(crate) fn light(case: &Case<'_>) -> Result<Box<dyn ExactLight>, Malformed> {
    Ok(match case.get("type")?.text().unwrap_or_default() {
        "point" => Box::new(at_point::isotropic(case)?),
        "spot" => Box::new(spot::spot(case)?),
        "projection" => Box::new(projection::projection(case)?),
        "goniometric" => Box::new(goniometric::goniometric(case)?),
        "distant" => Box::new(infinite::Distant::new(case)?),
        "uniform_infinite" => Box::new(infinite::Uniform::new(case)?),
        "image_infinite" => Box::new(picture::ImageSky::new(case)?),
        "portal_infinite" => Box::new(portal::PortalSky::new(case)?),
        "area_triangle" => Box::new(area::Area::new(case, triangle::Triangle::read(case)?)?),
        "area_patch" => patch::light(case)?,
        "area_sphere" => Box::new(area::Area::new(case, sphere::Sphere::read(case)?)?),
        "area_disk" => Box::new(area::Area::new(case, disk::Disk::read(case)?)?),
        other => return Err(Malformed(format!("unknown light type {other}"))),
    })
}

pub(crate) use portal::PortalSky;

/// Linear part and origin of a transform.
fn transform(matrix: &Case<'_>) -> Result<(DMat3, DVec3), Malformed> {
    let m = matrix.float_array::<16>()?.map(f64::from);
    let column = |i: usize| DVec3::new(m[i], m[4 + i], m[8 + i]);
    Ok((DMat3::from_cols(column(0), column(1), column(2)), column(3)))
}

fn point(case: &Case<'_>) -> Result<DVec3, Malformed> {
    Ok(case.vec3()?.as_dvec3())
}

fn number(case: &Case<'_>, name: &str) -> Result<f64, Malformed> {
    Ok(f64::from(case.get(name)?.float()?))
}

/// The angle around z as a part of a turn, in [0, 1).
fn azimuth(v: DVec3) -> f64 {
    (f64::atan2(v.y, v.x) / std::f64::consts::TAU).rem_euclid(1.0)
}
