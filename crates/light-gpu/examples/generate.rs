//! Writes `wesl/constants.wesl` and `lights.wgsl` anew.

use std::fs;
use std::path::Path;

fn main() -> std::io::Result<()> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    fs::write(root.join("wesl/constants.wesl"), light_gpu::constants())?;
    fs::write(root.join("lights.wgsl"), light_gpu::flat())
}
