//! Which module checks which kind.

use super::Checker;

mod bounds;
mod compact;
mod direction_cone;
mod equal_area;
mod light_bounds_importance;
mod light_bounds_union;
mod octahedral;

/// The checker of `kind`, fresh for the first line of a file; none while the kind has no module.
pub(super) fn checker(kind: &str) -> Option<Box<dyn Checker>> {
    Some(match kind {
        "compact" => Box::new(compact::check),
        "direction_cone" => Box::new(direction_cone::check),
        "equal_area" => Box::new(equal_area::check),
        "light_bounds_importance" => Box::new(light_bounds_importance::check),
        "light_bounds_union" => Box::new(light_bounds_union::check),
        "octahedral" => Box::new(octahedral::check),
        _ => return None,
    })
}
