//! Which module checks which kind.

use super::Checker;

mod direction_cone;
mod equal_area;
mod octahedral;

/// The checker of `kind`, fresh for the first line of a file; none while the kind has no module.
pub(super) fn checker(kind: &str) -> Option<Box<dyn Checker>> {
    Some(match kind {
        "direction_cone" => Box::new(direction_cone::check),
        "equal_area" => Box::new(equal_area::check),
        "octahedral" => Box::new(octahedral::check),
        _ => return None,
    })
}
