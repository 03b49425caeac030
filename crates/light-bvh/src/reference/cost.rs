use core::f32::consts::{FRAC_PI_2, PI};

use light_bounds::LightBounds;
use light_bounds::light_math::Aabb;
use light_bounds::light_math::float::{cos, safe_acos, safe_sqrt};

/// Relative cost of a group of lights on one side of a split along `axis` of a node with the box
/// `node`.
///
/// Power times solid angle of emission times size, and for a split across a short axis that many
/// times more. In `f64`, so that it is finite for any finite bounds.
///
/// # Source
/// `[PBRT4]`, section 12.6.3; `[ContyEstevez2018]`, section 4. Where the node's box has no area its
/// length takes the place of area: lights on a line would otherwise cost nothing however they are
/// split.
pub(super) fn side_cost(side: &LightBounds, node: &Aabb, axis: usize) -> f64 {
    let extents = extents(node);
    let longest = extents.into_iter().fold(0.0, f64::max);
    let regularity = longest / extents[axis];
    let size = if area(extents) > 0.0 {
        area(self::extents(&side.bounds))
    } else {
        self::extents(&side.bounds).into_iter().fold(0.0, f64::max)
    };
    f64::from(side.phi) * f64::from(emission_measure(side)) * regularity * size
}

/// Integral of the emission profile over the sphere: the solid angle of the normals, and a cosine
/// lobe beyond it.
fn emission_measure(bounds: &LightBounds) -> f32 {
    let theta_o = safe_acos(bounds.cos_theta_o);
    let theta_e = safe_acos(bounds.cos_theta_e);
    let theta_w = (theta_o + theta_e).min(PI);
    let cos_o = bounds.cos_theta_o;
    let sin_o = safe_sqrt((1.0 - cos_o) * (1.0 + cos_o));
    let beyond = 2.0 * (theta_w - theta_o) * sin_o - cos(theta_o - 2.0 * theta_w) + cos_o;
    2.0 * PI * (1.0 - cos_o) + FRAC_PI_2 * beyond
}

fn extents(bounds: &Aabb) -> [f64; 3] {
    core::array::from_fn(|i| f64::from(bounds.max[i]) - f64::from(bounds.min[i]))
}

/// Half of the surface area.
fn area([x, y, z]: [f64; 3]) -> f64 {
    x * y + y * z + z * x
}

#[cfg(test)]
mod tests {
    use super::*;
    use light_bounds::light_math::glam::Vec3;

    fn group(bounds: Aabb, cos_theta_o: f32) -> LightBounds {
        LightBounds {
            bounds,
            w: Vec3::Z,
            phi: 1.0,
            cos_theta_o,
            cos_theta_e: 0.0,
            two_sided: false,
        }
    }

    #[test]
    fn emission_of_a_flat_light_and_of_a_bulb() {
        let point = Aabb::from_point(Vec3::ZERO);
        assert!(
            (emission_measure(&group(point, 1.0)) - PI).abs() < 1e-5,
            "a cosine lobe"
        );
        assert!(
            (emission_measure(&group(point, -1.0)) - 4.0 * PI).abs() < 1e-5,
            "the whole sphere"
        );
    }

    #[test]
    fn splits_across_a_short_axis_cost_more() {
        let node = Aabb::new(Vec3::ZERO, Vec3::new(4.0, 1.0, 1.0));
        let side = group(Aabb::new(Vec3::ZERO, Vec3::ONE), 1.0);
        let ratio = side_cost(&side, &node, 1) / side_cost(&side, &node, 0);
        assert_eq!(ratio, 4.0, "longest over shortest");
    }

    #[test]
    fn lights_on_a_line_cost_by_length() {
        let node = Aabb::new(Vec3::ZERO, Vec3::X * 4.0);
        let cost = |length| {
            side_cost(
                &group(Aabb::new(Vec3::ZERO, Vec3::X * length), 1.0),
                &node,
                0,
            )
        };
        assert!(cost(3.0) > cost(1.0) && cost(1.0) > 0.0, "ordered");
    }

    #[test]
    fn huge_scenes_cost_finitely() {
        let node = Aabb::new(Vec3::splat(-3e38), Vec3::splat(3e38));
        let side = LightBounds {
            phi: f32::MAX,
            ..group(node, -1.0)
        };
        assert!(side_cost(&side, &node, 0).is_finite(), "in range");
    }
}
