//! The page shows the source of the example, which `cargo xtask gpu` compiles and runs.

use std::fs;
use std::path::Path;

fn example(file: &str) -> String {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../gpu/wgsl/examples/gbuffer");
    fs::read_to_string(folder.join(file)).expect("a file of the example")
}

const PAGE: &str = include_str!("../../../docs/light-gpu.md");

#[test]
fn the_host_code_is_that_of_the_example() {
    let host = example("lit.rs");
    assert!(
        PAGE.contains(&format!("```rust,ignore\n{host}```")),
        "lit.rs"
    );
    let (_, body) = host.split_once("\npub fn ").expect("a function");
    assert!(body.lines().count() <= 40, "{} lines", body.lines().count());
}

#[test]
fn the_shader_is_that_of_the_example() {
    let shader = example("gbuffer.wgsl");
    let at = shader.find("@compute").expect("an entry point");
    assert!(
        PAGE.contains(&format!("```wgsl\n{}```", &shader[at..])),
        "gbuffer.wgsl"
    );
}
