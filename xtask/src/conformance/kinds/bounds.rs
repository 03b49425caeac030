use lights::bounds::LightBounds;
use lights::math::{Aabb, glam::Vec3};

use crate::conformance::{Case, Malformed};

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

/// Importance in double precision, from trigonometric functions: the formula without its round-off, and what decides on zero.
pub(super) struct PreciseImportance {
    /// The result where it is not zero.
    pub(super) importance: f64,
    /// `cos theta' - cos theta_e`: light is emitted toward the point if this is positive.
    pub(super) emission_margin: f64,
    /// `d / r - 1`: the point is within the bounding sphere if this is negative.
    pub(super) sphere_margin: f64,
    /// `phi / max(d^2, |diagonal| / 2)`: importance without its cosines.
    pub(super) scale: f64,
}

impl PreciseImportance {
    /// The importance of `lb` at `p` with the normal `n`, zero in a medium.
    pub(super) fn new(lb: &LightBounds, p: Vec3, n: Vec3) -> Self {
        let [min, max, p, w, n] = [lb.bounds.min, lb.bounds.max, p, lb.w, n].map(double);
        let center: [f64; 3] = std::array::from_fn(|i| 0.5 * (min[i] + max[i]));
        let to_p: [f64; 3] = std::array::from_fn(|i| p[i] - center[i]);
        let diagonal: [f64; 3] = std::array::from_fn(|i| max[i] - min[i]);
        let (dist, radius) = (length(to_p), 0.5 * length(diagonal));

        let theta_b = if dist < radius {
            std::f64::consts::PI
        } else {
            (radius / dist).clamp(0.0, 1.0).asin()
        };
        let cos_w = dot(w, to_p) / (dist * length(w));
        let theta_w = if lb.two_sided { cos_w.abs() } else { cos_w };
        let theta_w = theta_w.clamp(-1.0, 1.0).acos();
        let theta_o = f64::from(lb.cos_theta_o).acos();
        let cos_emission = (theta_w - theta_o - theta_b).max(0.0).cos();
        let cos_incidence = if length(n) == 0.0 {
            1.0
        } else {
            let theta_i = (dot(n, to_p) / dist).abs().min(1.0).acos();
            (theta_i - theta_b).max(0.0).cos()
        };
        let scale = f64::from(lb.phi) / (dist * dist).max(radius);
        Self {
            importance: scale * cos_emission * cos_incidence,
            emission_margin: cos_emission - f64::from(lb.cos_theta_e),
            sphere_margin: dist / radius - 1.0,
            scale,
        }
    }
}

fn double(v: Vec3) -> [f64; 3] {
    v.to_array().map(f64::from)
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|i| a[i] * b[i]).sum()
}

fn length(v: [f64; 3]) -> f64 {
    dot(v, v).sqrt()
}
