//! The page shows the source of the example `lit_pixel`, which `cargo xtask gpu` compiles and runs.

use std::fs;
use std::path::Path;

fn example(file: &str) -> String {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../gpu/wgsl/examples/lit_pixel");
    fs::read_to_string(folder.join(file)).expect("a file of the example")
}

const PAGE: &str = include_str!("../../../../docs/light-gpu.md");

#[test]
fn the_host_code_is_that_of_the_example() {
    let host = example("main.rs");
    let shown = format!("```rust,ignore\n{host}```");
    assert!(PAGE.contains(&shown), "main.rs");
    let lines = host.lines().count();
    assert!(lines <= 40, "{lines} lines of a program");
}

#[test]
fn the_shader_is_that_of_the_example() {
    let shown = format!("```wgsl\n{}```", example("pixel.wgsl"));
    assert!(PAGE.contains(&shown), "pixel.wgsl");
}
