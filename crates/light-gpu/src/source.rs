use alloc::format;
use alloc::string::String;

use crate::light_rows::KINDS;
use light_samplers::HORIZON_SLACK;
use light_samplers::light_bvh::light_bounds::IMPORTANCE_CONSTANTS;
use light_samplers::light_bvh::{CutDetail, QUERY_CONSTANTS};
use light_sources::ENVIRONMENT_CONSTANTS;
use light_sources::light_math::OctahedralVector;
use light_sources::light_math::warp::WARP_CONSTANTS;
use light_sources::shape::SHAPE_CONSTANTS;

/// All functions in one text of plain WGSL, which needs one of yours:
/// `fn light_row(i: u32) -> vec4<u32>`, row `i` of the buffer that holds trees and tables.
///
/// Its names begin with `light_`, `Light` or `LIGHT_`, but for `SampledLight`. It declares no
/// bindings.
pub const LIGHTS_WGSL: &str = include_str!("../lights.wgsl");

/// The modules, in the order of the text, each after what it needs.
const MODULES: [&str; 19] = [
    include_str!("../wesl/fraction.wesl"),
    include_str!("../wesl/alias_table.wesl"),
    include_str!("../wesl/sphere_maps.wesl"),
    include_str!("../wesl/receiver.wesl"),
    include_str!("../wesl/children.wesl"),
    include_str!("../wesl/importance.wesl"),
    include_str!("../wesl/light_tree.wesl"),
    include_str!("../wesl/light_cut.wesl"),
    include_str!("../wesl/light_sampler.wesl"),
    include_str!("../wesl/warps.wesl"),
    include_str!("../wesl/environment.wesl"),
    include_str!("../wesl/compact_bounds.wesl"),
    include_str!("../wesl/seen_triangle.wesl"),
    include_str!("../wesl/spherical_triangle.wesl"),
    include_str!("../wesl/spherical_rectangle.wesl"),
    include_str!("../wesl/flat_lights.wesl"),
    include_str!("../wesl/sphere_light.wesl"),
    include_str!("../wesl/light_set.wesl"),
    include_str!("../wesl/light_scene.wesl"),
];

#[expect(clippy::cast_possible_truncation, reason = "a few nodes")]
const CUT_NODES: u32 = CutDetail::MAX_NODES as u32;

/// The module of constants, with the numbers of the Rust crates: `wesl/constants.wesl`.
#[must_use]
pub fn constants() -> String {
    let head = "// The numbers of the Rust crates: light-bvh, light-samplers, light-bounds,\n\
                // light-math (warp), light-sources (shape, environment maps), and the kinds of rows.\n\
                // Generated.\n\n";
    let numbers = QUERY_CONSTANTS
        .iter()
        .chain(&[("HORIZON_SLACK", HORIZON_SLACK)])
        .chain(&IMPORTANCE_CONSTANTS)
        .chain(&[("CODE_ERROR", OctahedralVector::MAX_ANGULAR_ERROR)])
        .chain(&WARP_CONSTANTS)
        .chain(&SHAPE_CONSTANTS)
        .chain(&ENVIRONMENT_CONSTANTS)
        .map(|(name, value)| format!("const LIGHT_{name}: f32 = {value:?};\n"));
    let kinds = KINDS
        .iter()
        .copied()
        .chain([("CUT_NODES", CUT_NODES)])
        .map(|(name, number)| format!("const LIGHT_{name}: u32 = {number}u;\n"));
    numbers
        .chain(kinds)
        .fold(head.into(), |text: String, line| text + &line)
}

/// [`LIGHTS_WGSL`], made anew from the modules and the constants.
#[must_use]
pub fn flat() -> String {
    MODULES.iter().fold(constants(), |text, module| {
        text + "\n" + &without_imports(module)
    })
}

/// A module without what it imports, which is in the same text.
fn without_imports(module: &str) -> String {
    let mut text = String::new();
    let mut rest = module;
    while let Some(at) = rest.find("import ") {
        let (before, import) = rest.split_at(at);
        text += before;
        let end = import.find(';').map_or(import.len(), |end| end + 1);
        rest = import[end..].trim_start_matches('\n');
    }
    text + rest
}
