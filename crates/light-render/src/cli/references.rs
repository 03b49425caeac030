use std::path::Path;

use light_scene::{BuiltinScene, Image, parse_exr};

use super::failure::Failure;

/// What a scene that ships looks like at the demo's size, in two pictures of other random numbers:
/// `cargo xtask gallery --references` remakes the files.
///
/// # Errors
/// When a file that is part of the program is no image, or the two differ in size.
pub(crate) fn reference_halves(scene: BuiltinScene) -> Result<[Image; 2], Failure> {
    let (name, files): (_, [&[u8]; 2]) = match scene {
        BuiltinScene::CornellBox => (
            "cornell-box",
            [
                include_bytes!("../../assets/cornell-box-a.exr"),
                include_bytes!("../../assets/cornell-box-b.exr"),
            ],
        ),
        BuiltinScene::Rotunda => (
            "rotunda",
            [
                include_bytes!("../../assets/rotunda-a.exr"),
                include_bytes!("../../assets/rotunda-b.exr"),
            ],
        ),
        _ => (
            "night",
            [
                include_bytes!("../../assets/night-a.exr"),
                include_bytes!("../../assets/night-b.exr"),
            ],
        ),
    };
    let [a, b] = files.map(|bytes| parse_exr(Path::new(name), bytes).map_err(Failure::input));
    let (a, b) = (a?.image, b?.image);
    if [a.width(), a.height()] != [b.width(), b.height()] {
        return Err(Failure::Input(format!("{name}: halves of two sizes")));
    }
    Ok([a, b])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Comparison;

    /// Both show one scene, with other noise, and far less of it than pictures of a few seconds.
    #[test]
    fn halves_are_independent_and_quiet() {
        for (scene, most) in [
            (BuiltinScene::CornellBox, 3e-4),
            (BuiltinScene::Rotunda, 2e-3),
            (BuiltinScene::Night, 6e-3),
        ] {
            let [a, b] = reference_halves(scene).expect("two pictures");
            let apart = Comparison::new(a.texels(), b.texels()).expect("of one size");
            assert!(apart.rel_mse > 1e-5, "{scene}: the same picture twice");
            assert!(apart.rel_mse < most, "{scene}: {}", apart.rel_mse);
            let bias = apart.bias.abs() / apart.bias_error;
            assert!(bias.max_element() < 4.5, "{scene}: {bias}");
        }
    }
}
