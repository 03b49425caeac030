//! Which module checks which kind.

use crate::Checker;

mod alias_table;
mod bounds;
mod compact;
mod compact_codes;
mod direction_cone;
mod equal_area;
mod light_bounds_importance;
mod light_bounds_union;
mod light_samplers;
mod light_tree;
mod light_tree_splits;
mod lights;
mod octahedral;
mod piecewise_constant_1d;
mod piecewise_constant_2d;
mod pmf_range;
mod sampler_answers;
mod sampler_set;
mod sampling;
mod sampling_discrete;
mod sampling_solid_angle;
mod sampling_spherical;
mod summed_area_table;
mod tables;
mod windowed_piecewise_constant_2d;

/// The checker of `kind`, fresh for the first line of a file; none while the kind has no module.
pub(super) fn checker(kind: &str) -> Option<Box<dyn Checker>> {
    Some(match kind {
        "alias_table" => Box::new(alias_table::check),
        "compact" => Box::new(compact::check),
        "direction_cone" => Box::new(direction_cone::check),
        "equal_area" => Box::new(equal_area::check),
        "light_bounds_importance" => Box::new(light_bounds_importance::check),
        "light_bounds_union" => Box::new(light_bounds_union::check),
        "light_samplers" => Box::<light_samplers::LightSamplers>::default(),
        "lights" => Box::<lights::Lights>::default(),
        "octahedral" => Box::new(octahedral::check),
        "piecewise_constant_1d" => Box::new(piecewise_constant_1d::check),
        "piecewise_constant_2d" => Box::new(piecewise_constant_2d::check),
        "sampling" => Box::new(sampling::check),
        "summed_area_table" => Box::new(summed_area_table::check),
        "windowed_piecewise_constant_2d" => Box::new(windowed_piecewise_constant_2d::check),
        _ => return None,
    })
}
