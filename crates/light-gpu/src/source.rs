use alloc::format;
use alloc::string::String;

use light_samplers::HORIZON_SLACK;
use light_samplers::light_bvh::QUERY_CONSTANTS;

/// All functions in one text of plain WGSL, which needs one of yours:
/// `fn light_row(i: u32) -> vec4<u32>`, row `i` of the buffer that holds trees and tables.
///
/// Its names begin with `light_`, `Light` or `LIGHT_`, but for `SampledLight`. It declares no
/// bindings.
pub const LIGHTS_WGSL: &str = include_str!("../lights.wgsl");

/// The modules, in the order of the text, each after what it needs.
const MODULES: [&str; 8] = [
    include_str!("../wesl/fraction.wesl"),
    include_str!("../wesl/alias_table.wesl"),
    include_str!("../wesl/sphere_maps.wesl"),
    include_str!("../wesl/receiver.wesl"),
    include_str!("../wesl/children.wesl"),
    include_str!("../wesl/importance.wesl"),
    include_str!("../wesl/light_tree.wesl"),
    include_str!("../wesl/light_sampler.wesl"),
];

/// The module of constants, with the numbers of the Rust crates: `wesl/constants.wesl`.
#[must_use]
pub fn constants() -> String {
    let head = "// The numbers of light-bvh (QUERY_CONSTANTS) and light-samplers. Generated.\n\n";
    QUERY_CONSTANTS
        .iter()
        .chain(&[("HORIZON_SLACK", HORIZON_SLACK)])
        .fold(head.into(), |text: String, (name, value)| {
            text + &format!("const LIGHT_{name}: f32 = {value:?};\n")
        })
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
