use lights::bounds::LightBounds;
use lights::math::{Aabb, glam::Vec3};

use crate::{Case, Malformed};

/// The box `[[min], [max]]`.
pub(super) fn read_box(case: &Case<'_>) -> Result<Aabb, Malformed> {
    Ok(Aabb {
        min: case.at(0)?.vec3()?,
        max: case.at(1)?.vec3()?,
    })
}

/// An object with the fields of [`LightBounds`].
pub(super) fn read_light_bounds(case: &Case<'_>) -> Result<LightBounds, Malformed> {
    Ok(LightBounds {
        bounds: read_box(&case.get("bounds")?)?,
        w: case.get("w")?.vec3()?,
        phi: case.get("phi")?.float()?,
        cos_theta_o: case.get("cos_theta_o")?.float()?,
        cos_theta_e: case.get("cos_theta_e")?.float()?,
        two_sided: case.get("two_sided")?.flag()?,
    })
}

/// What decides on the importance of bounds, in double precision.
pub(super) struct Margins {
    /// `cos theta' - cos theta_e`: light is emitted toward the point if this is positive.
    pub(super) emission_margin: f64,
    /// `d / r - 1`: the point is within the bounding sphere if this is negative.
    pub(super) sphere_margin: f64,
    /// `phi / max(d^2, |diagonal| / 2)`: importance without its cosines.
    pub(super) scale: f64,
}

impl Margins {
    /// Of `lb` seen from `p`.
    pub(super) fn new(lb: &LightBounds, p: Vec3) -> Self {
        let [min, max, p, w] = [lb.bounds.min, lb.bounds.max, p, lb.w].map(|v| v.as_dvec3());
        let to_p = p - 0.5 * (min + max);
        let (dist, radius) = (to_p.length(), 0.5 * (max - min).length());

        let theta_b = if dist < radius {
            std::f64::consts::PI
        } else {
            (radius / dist).clamp(0.0, 1.0).asin()
        };
        let cos_w = w.dot(to_p) / (dist * w.length());
        let theta_w = if lb.two_sided { cos_w.abs() } else { cos_w };
        let theta_w = theta_w.clamp(-1.0, 1.0).acos();
        let theta_o = f64::from(lb.cos_theta_o).acos();
        let cos_emission = (theta_w - theta_o - theta_b).max(0.0).cos();
        let scale = f64::from(lb.phi) / (dist * dist).max(radius);
        Self {
            emission_margin: cos_emission - f64::from(lb.cos_theta_e),
            sphere_margin: dist / radius - 1.0,
            scale,
        }
    }
}
