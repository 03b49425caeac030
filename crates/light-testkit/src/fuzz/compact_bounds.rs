use light_bounds::{CompactLightBounds, LightBounds};

use super::input::Input;
use crate::real3::{cross, dot, length, real3};

/// Compact bounds contain the original: box, cone of normals, angle of emission, and what matters to a point.
///
/// # Panics
/// If a promise is broken.
pub fn compact_bounds(data: &[u8]) {
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
    assert!(
        coarse >= 0.0 && coarse.is_finite() && (exact == 0.0 || coarse > 0.0),
        "importance {exact} became {coarse} at {ctx:?} for {bounds:?} in {all:?}"
    );
}

fn contains(outer: &LightBounds, inner: &LightBounds) -> bool {
    let (a, b) = (real3(outer.w), real3(inner.w));
    let between = length(cross(a, b)).atan2(dot(a, b));
    let cone = |bounds: &LightBounds| f64::from(bounds.cos_theta_o).acos();
    let whole = outer.cos_theta_o <= -1.0;
    outer.bounds.contains_box(&inner.bounds)
        && (whole || between + cone(inner) <= cone(outer) + 1e-9)
        && outer.cos_theta_e <= inner.cos_theta_e
        && outer.phi == inner.phi
        && outer.two_sided == inner.two_sided
}
