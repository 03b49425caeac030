use std::path::Path;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use light_scene::{Diagnostic, Image, encode_png};
use lights::glam::Vec3;

use crate::{ToneMap, difference};

/// A picture in the page itself; `path` names the page in messages.
pub(super) fn data_uri(path: &Path, pixels: Vec<Vec3>, width: u32) -> Result<String, Diagnostic> {
    let height = u32::try_from(pixels.len() / width.max(1) as usize).unwrap_or(u32::MAX);
    let image = Image::new(width, height, pixels);
    let image = image.map_err(|error| Diagnostic::file(path, error.to_string()))?;
    let png = encode_png(path, &image)?;
    Ok(format!("data:image/png;base64,{}", STANDARD.encode(png)))
}

/// What a screen shows of linear radiance.
pub(super) fn shown(pixels: &[Vec3], tone_map: &ToneMap) -> Vec<Vec3> {
    pixels.iter().map(|&pixel| tone_map.apply(pixel)).collect()
}

/// Where a picture is too bright (red) and too dark (blue).
pub(super) fn signed_error(pixels: &[Vec3], reference: &[Vec3]) -> Vec<Vec3> {
    let pairs = pixels.iter().zip(reference);
    pairs.map(|(&x, &r)| difference(x, r)).collect()
}

/// Differences in `[0, 1]` as colours from black over red and yellow to white.
pub(super) fn heat(map: &[f32]) -> Vec<Vec3> {
    /// Linear colours at equal distances.
    const SCALE: [Vec3; 5] = [
        Vec3::new(0.0, 0.0, 0.004),
        Vec3::new(0.10, 0.006, 0.18),
        Vec3::new(0.47, 0.04, 0.12),
        Vec3::new(0.96, 0.30, 0.03),
        Vec3::new(0.98, 0.98, 0.55),
    ];
    let color = |&x: &f32| {
        let at = x.clamp(0.0, 1.0) * (SCALE.len() - 1) as f32;
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "from 0 to 4"
        )]
        let below = (at as usize).min(SCALE.len() - 2);
        SCALE[below].lerp(SCALE[below + 1], at - below as f32)
    };
    map.iter().map(color).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heat_rises_from_dark_to_bright() {
        let colors = heat(&[0.0, 0.3, 0.6, 0.9, 1.0, 2.0]);
        let lightness: Vec<f32> = colors.iter().map(|c| c.element_sum()).collect();
        assert!(
            lightness.windows(2).all(|pair| pair[0] <= pair[1]),
            "{lightness:?}"
        );
        assert_eq!(colors[4], colors[5], "the end");
    }

    #[test]
    fn pictures_are_png() {
        let uri = data_uri(Path::new("page"), vec![Vec3::ONE; 6], 3).expect("a picture");
        assert!(
            uri.starts_with("data:image/png;base64,iVBORw0KGgo"),
            "{uri}"
        );
    }
}
