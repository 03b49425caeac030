//! `cargo xtask gallery`: remakes the pictures of the README and the references of the demo.

use crate::steps::{Outcome, StepResult, cargo, root, run};

/// A scene that ships: name, width of its picture, samples a pixel.
const PICTURES: [(&str, u32, u32); 3] = [
    ("cornell-box", 300, 8192),
    ("rotunda", 450, 8192),
    ("night", 480, 4096),
];

/// Renders every scene that ships until no noise is left: hours of work for two cores.
///
/// # Errors
/// The command that failed.
pub fn gallery() -> StepResult {
    for (scene, width, spp) in PICTURES {
        let [exr, png] = [
            root().join(format!("crates/light-render/assets/{scene}.exr")),
            root().join(format!("docs/images/{scene}.png")),
        ];
        let mut command = cargo(["run", "--release", "--package", "light-render", "--bin"]);
        command
            .args(["lights", "--", "render", scene, "--half", "--seed", "99"])
            .args(["--max-depth", "6", "--width", &width.to_string()])
            .args(["--spp", &spp.to_string()]);
        for path in [exr, png] {
            command.arg("-o").arg(path);
        }
        run(&mut command)?;
    }
    Ok(Outcome::Passed)
}
