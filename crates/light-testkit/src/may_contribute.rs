use light_bounds::{
    InfiniteBounds, LightBounds, LightExtent, LightSampleContext, ReceiverKind, ReceiverSides,
};
use light_math::glam::Vec3;

use crate::real3::{Real3, dot, length, normalize, real3, sub};

/// Angles and cosines closer than this to the end of emission are not tested.
const MARGIN: f64 = 1e-4;

/// Positions along a ray segment that are tested.
const ALONG: [f64; 5] = [0.0, 0.25, 0.5, 0.75, 1.0];

/// Whether a light that has this extent certainly can send light to the receiver, by the meaning of
/// the extent's fields alone, in `f64`.
///
/// Tests the corners and the centre of the light's box only, so `false` proves nothing. A receiver
/// without a place gets nothing, and neither does one that is so far away that its irradiance is no
/// positive `f32`.
#[must_use]
pub fn may_contribute(light: &LightExtent, ctx: &LightSampleContext) -> bool {
    if !(ctx.p.is_finite() && extent(ctx).is_finite()) {
        return false;
    }
    match light {
        LightExtent::Bounded(bounds) | LightExtent::Lobe(bounds, _) => bounded(bounds, ctx),
        LightExtent::Infinite(bounds) => infinite(bounds, ctx),
    }
}

/// From the origin of the receiver to its other end.
fn extent(ctx: &LightSampleContext) -> Vec3 {
    match *ctx.kind() {
        ReceiverKind::Segment { extent, .. } => extent,
        _ => Vec3::ZERO,
    }
}

/// The receiver's normal and sides; `None` where light counts from all sides.
fn normal(ctx: &LightSampleContext) -> Option<(Real3, ReceiverSides)> {
    match *ctx.kind() {
        ReceiverKind::Surface { ns, sides, .. } => Some((normalize(real3(ns)), sides)),
        _ => None,
    }
}

fn bounded(light: &LightBounds, ctx: &LightSampleContext) -> bool {
    let (low, high) = (real3(light.bounds.min), real3(light.bounds.max));
    let corner = |i: usize| [0, 1, 2].map(|k| if i >> k & 1 == 0 { low[k] } else { high[k] });
    let center = [0, 1, 2].map(|k| 0.5 * (low[k] + high[k]));
    let places = (0..8).map(corner).chain([center]);
    places.into_iter().any(|from| {
        receivers(ctx).any(|p| {
            let to_light = sub(from, p);
            let dist = length(to_light);
            let wi = normalize(to_light);
            let irradiance = f64::from(light.phi) / (dist * dist);
            dist > 0.0
                && irradiance > f64::from(f32::MIN_POSITIVE)
                && is_lit_from(ctx, wi)
                && emits(light, wi.map(|c| -c))
        })
    })
}

/// The points at which the light is received.
fn receivers(ctx: &LightSampleContext) -> impl Iterator<Item = Real3> {
    let (p, along) = (real3(ctx.p), real3(extent(ctx)));
    let at = move |t: f64| [0, 1, 2].map(|k| p[k] + t * along[k]);
    let count = if extent(ctx) == Vec3::ZERO {
        1
    } else {
        ALONG.len()
    };
    ALONG.into_iter().take(count).map(at)
}

/// Whether light from the direction `wi` arrives at the receiver's side.
fn is_lit_from(ctx: &LightSampleContext, wi: Real3) -> bool {
    let Some((ns, sides)) = normal(ctx) else {
        return true;
    };
    let cos = dot(ns, wi);
    match sides {
        ReceiverSides::Front => cos > MARGIN,
        ReceiverSides::Both => cos.abs() > MARGIN,
    }
}

/// Whether some of the light's normals are near enough to the direction `w` away from it.
fn emits(light: &LightBounds, w: Real3) -> bool {
    let reach = f64::from(light.cos_theta_o).acos() + f64::from(light.cos_theta_e).acos();
    let cos = dot(normalize(real3(light.w)), w).clamp(-1.0, 1.0);
    let cos = if light.two_sided { cos.abs() } else { cos };
    cos.acos() < reach - MARGIN
}

fn infinite(light: &InfiniteBounds, ctx: &LightSampleContext) -> bool {
    if light.fluence <= f32::MIN_POSITIVE || light.cone.is_empty() {
        return false;
    }
    let Some((ns, sides)) = normal(ctx).filter(|_| !light.cone.is_whole_sphere()) else {
        return true;
    };
    let cos = dot(ns, normalize(real3(light.cone.w))).clamp(-1.0, 1.0);
    let cos = match sides {
        ReceiverSides::Front => cos,
        ReceiverSides::Both => cos.abs(),
    };
    let half_angle = f64::from(light.cone.cos_theta).clamp(-1.0, 1.0).acos();
    cos.acos() - half_angle < core::f64::consts::FRAC_PI_2 - MARGIN
}

#[cfg(test)]
mod tests {
    use super::*;
    use light_math::Aabb;

    fn lamp() -> LightBounds {
        LightBounds {
            bounds: Aabb::from_point(Vec3::Z),
            w: Vec3::NEG_Z,
            phi: 1.0,
            cos_theta_o: 1.0,
            cos_theta_e: 0.5,
            two_sided: false,
        }
    }

    fn reaches(light: LightBounds, ctx: &LightSampleContext) -> bool {
        may_contribute(&LightExtent::Bounded(light), ctx)
    }

    #[test]
    fn a_lamp_lights_what_is_in_its_cone_and_faces_it() {
        let floor = |p| LightSampleContext::surface(p, Vec3::Z, Vec3::Z);
        assert!(reaches(lamp(), &floor(Vec3::ZERO)), "below");
        assert!(!reaches(lamp(), &floor(Vec3::X * 2.0)), "aside");
        assert!(!reaches(lamp(), &floor(Vec3::Z * 2.0)), "above");
        let ceiling = LightSampleContext::surface(Vec3::ZERO, Vec3::NEG_Z, Vec3::NEG_Z);
        assert!(!reaches(lamp(), &ceiling), "turned away");
        let leaf = LightSampleContext::two_sided(Vec3::ZERO, Vec3::NEG_Z, Vec3::NEG_Z);
        assert!(reaches(lamp(), &leaf), "through a leaf");
        let above = LightSampleContext::medium(Vec3::Z * 2.0);
        assert!(!reaches(lamp(), &above), "behind");
        let both = LightBounds {
            two_sided: true,
            ..lamp()
        };
        assert!(reaches(both, &above), "on both sides");
        let dark = LightBounds { phi: 0.0, ..lamp() };
        assert!(!reaches(dark, &floor(Vec3::ZERO)), "switched off");
    }

    #[test]
    fn a_segment_is_lit_where_one_of_its_places_is() {
        let across = LightSampleContext::segment(Vec3::X * -3.0, Vec3::X * 6.0);
        assert!(reaches(lamp(), &across), "in the middle");
        let beside = LightSampleContext::segment(Vec3::X * 3.0, Vec3::X * 6.0);
        assert!(!reaches(lamp(), &beside), "nowhere");
    }

    #[test]
    fn skies_light_what_they_rise_above() {
        let floor = LightSampleContext::surface(Vec3::ZERO, Vec3::Z, Vec3::Z);
        let sun = |wi| LightExtent::Infinite(InfiniteBounds::distant(1.0, wi));
        assert!(may_contribute(&sun(Vec3::Z), &floor), "noon");
        assert!(!may_contribute(&sun(Vec3::NEG_Z), &floor), "night");
        let sky = LightExtent::Infinite(InfiniteBounds::uniform(1.0));
        assert!(may_contribute(&sky, &floor), "the sky");
        let nowhere = LightSampleContext::medium(Vec3::NAN);
        assert!(
            !may_contribute(&sky, &nowhere),
            "a receiver without a place"
        );
        let long = LightSampleContext::surface(Vec3::ZERO, Vec3::Z, Vec3::Z * 1e30);
        assert!(!may_contribute(&sun(Vec3::NEG_Z), &long), "a long normal");
        let none = LightSampleContext::surface(Vec3::ZERO, Vec3::NAN, Vec3::NAN);
        assert!(may_contribute(&sun(Vec3::NEG_Z), &none), "no direction");
    }
}
