use std::path::Path;

use light_scene::{BuiltinScene, Image, parse_exr};

use super::failure::Failure;

/// What a scene that ships looks like without noise, at the demo's size:
/// `cargo xtask gallery --references` remakes the files.
///
/// # Errors
/// When the file that is part of the program is no image.
pub(crate) fn reference(scene: BuiltinScene) -> Result<Image, Failure> {
    let (name, bytes): (_, &[u8]) = match scene {
        BuiltinScene::CornellBox => (
            "cornell-box.exr",
            include_bytes!("../../assets/cornell-box.exr"),
        ),
        BuiltinScene::Rotunda => ("rotunda.exr", include_bytes!("../../assets/rotunda.exr")),
        _ => ("night.exr", include_bytes!("../../assets/night.exr")),
    };
    let file = parse_exr(Path::new(name), bytes).map_err(Failure::input)?;
    Ok(file.image)
}
