//! The results of lights, in double precision.

mod area;
mod at_point;
mod azimuth;
mod by_solid_angle;
mod disk;
mod exact_light;
mod fields;
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

use crate::{Case, Malformed};
pub(crate) use exact_light::{ExactBounds, ExactLight, Leaving, Receiver};
pub(crate) use portal::PortalSky;

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
