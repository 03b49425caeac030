//! `cargo xtask gallery [--references]`: remakes the pictures of `docs/gallery.md`, or the picture
//! of the README and the references of the demo.

use std::fs;

use crate::steps::{Outcome, StepResult, cargo, root, run};

/// Examples of `lights` that write a picture of their name.
const EXAMPLES: [&str; 5] = [
    "fog",
    "light_groups",
    "median_cut",
    "spectral",
    "spectral_and_rgb",
];

/// Examples of `light-render`, and the pictures that they write.
const RENDERED: [(&str, &[&str]); 3] = [
    ("portals", &["portals-sky", "portals-window"]),
    (
        "cornell_lesson",
        &[
            "cornell-lesson-hemisphere-10",
            "cornell-lesson-hemisphere-1000",
            "cornell-lesson-lamp-10",
        ],
    ),
    ("side_by_side", &["side_by_side"]),
];

/// Pictures of the demo.
const DEMO: [&str; 6] = [
    "cornell-box",
    "rotunda",
    "night-uniform",
    "night-power",
    "night-bvh-reference",
    "night-bvh",
];

/// Runs the demo and the examples, and copies what they write into `out` to the gallery.
///
/// # Errors
/// The command that failed, a file that cannot be copied, or an argument that is not known.
pub fn gallery(arguments: &[String]) -> StepResult {
    match arguments {
        [] => {}
        [flag] if flag == "--references" => return references(),
        _ => return Err("usage: cargo xtask gallery [--references]".into()),
    }
    run(&mut cargo(["run", "--release"]))?;
    for example in EXAMPLES {
        let package = ["run", "--release", "--package", "lights", "--example"];
        run(cargo(package).arg(example))?;
    }
    for (example, _) in RENDERED {
        let package = ["run", "--release", "--package", "light-render", "--example"];
        run(cargo(package).arg(example))?;
    }
    let rendered = RENDERED.iter().flat_map(|(_, pictures)| *pictures);
    for name in DEMO.iter().chain(&EXAMPLES).chain(rendered) {
        let from = root().join(format!("out/{name}.png"));
        let to = root().join(format!("docs/images/gallery/{name}.png"));
        fs::copy(&from, to).map_err(|e| format!("{}: {e}", from.display()))?;
    }
    Ok(Outcome::Passed)
}

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
fn references() -> StepResult {
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
