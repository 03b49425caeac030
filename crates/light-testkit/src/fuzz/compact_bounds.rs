use light_bounds::{CompactLightBounds, LightBounds};
use light_math::glam::Vec3;

use super::input::Input;
use crate::real3::{Real3, cross, dot, length, real3, sub};

/// Compact bounds contain the original: box, cone of normals, angle of emission. A light within the
/// bounds that contributes to a point has an importance there, by the exact form and by the compact
/// one.
///
/// Importance as such is not promised to stay: that of the exact form may be above 0 by its slack
/// alone, where no light contributes.
pub(super) fn compact_bounds(data: &[u8]) {
    let mut input = Input::new(data);
    let bounds = input.bounds();
    let all = bounds.bounds.union(input.aabb());
    let compact = CompactLightBounds::encode(&bounds, &all);
    let decoded = compact.decode(&all);
    assert!(
        contains(&decoded, &bounds),
        "{bounds:?} in {all:?} became {decoded:?}"
    );
    let ctx = input.context();
    let (exact, coarse) = (bounds.importance(&ctx), compact.importance(&all, &ctx));
    for importance in [exact, coarse] {
        assert!(
            importance >= 0.0 && importance.is_finite(),
            "importance {importance} at {ctx:?} for {bounds:?} in {all:?}"
        );
    }
    let shares = [input.unit(), input.unit(), input.unit()];
    let [low, high] = [bounds.bounds.min, bounds.bounds.max].map(real3);
    let point = core::array::from_fn(|i| low[i] + (high[i] - low[i]) * f64::from(shares[i]));
    let points = [low, high, point, real3(bounds.bounds.center())];
    let contributes = |&from: &Real3| bounds.phi > 0.0 && emits(&bounds, from, ctx.p);
    if let Some(from) = points.iter().find(|from| contributes(from)) {
        assert!(
            exact > 0.0 && coarse > 0.0,
            "importance {exact}, compact {coarse} at {ctx:?} of {bounds:?} in {all:?}, which emits \
             from {from:?}"
        );
    }
}

/// Whether a light at the point `from` of the box may emit toward `p`, in double precision and
/// without a margin.
fn emits(bounds: &LightBounds, from: Real3, p: Vec3) -> bool {
    let away = between(real3(bounds.w), sub(real3(p), from));
    let [theta_o, theta_e] = [bounds.cos_theta_o, bounds.cos_theta_e].map(|c| f64::from(c).acos());
    let other = core::f64::consts::PI - away;
    let nearest = if bounds.two_sided {
        away.min(other)
    } else {
        away
    };
    nearest - theta_o <= theta_e
}

/// The angle between two vectors.
fn between(a: Real3, b: Real3) -> f64 {
    length(cross(a, b)).atan2(dot(a, b))
}

fn contains(outer: &LightBounds, inner: &LightBounds) -> bool {
    let between = between(real3(outer.w), real3(inner.w));
    let cone = |bounds: &LightBounds| f64::from(bounds.cos_theta_o).acos();
    let whole = outer.cos_theta_o <= -1.0;
    outer.bounds.contains_box(&inner.bounds)
        && (whole || between + cone(inner) <= cone(outer) + 1e-9)
        && outer.cos_theta_e <= inner.cos_theta_e
        && outer.phi == inner.phi
        && outer.two_sided == inner.two_sided
}
