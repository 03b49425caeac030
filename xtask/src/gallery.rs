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

/// A scene of the demo: name, width of its picture, samples a pixel of each half.
const PICTURES: [(&str, u32, u32); 3] = [
    ("cornell-box", 300, 8192),
    ("rotunda", 450, 8192),
    ("night", 480, 4096),
];

/// Halves of a reference: the end of the file's name, and the seed.
const HALVES: [(&str, &str); 2] = [("a", "99"), ("b", "100")];

/// Renders two quiet pictures of every scene of the demo, and that of the README: hours of work for
/// two cores.
///
/// # Errors
/// The command that failed.
fn references() -> StepResult {
    for (scene, width, spp) in PICTURES {
        for (half, seed) in HALVES {
            let exr = root().join(format!("crates/light-render/assets/{scene}-{half}.exr"));
            let mut command = cargo(["run", "--release", "--package", "light-render", "--bin"]);
            command
                .args(["lights", "--", "render", scene, "--half", "--seed", seed])
                .args(["--max-depth", "6", "--width", &width.to_string()])
                .args(["--spp", &spp.to_string(), "-o"])
                .arg(exr);
            if (scene, half) == ("night", "a") {
                command.arg("-o").arg(root().join("docs/images/night.png"));
            }
            run(&mut command)?;
        }
    }
    Ok(Outcome::Passed)
}
