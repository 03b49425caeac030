use std::path::Path;

use super::{Image, ImageFile};
use crate::Diagnostic;
use crate::glam::Vec3;

/// The image, if its texels can be light: NaN and infinities are refused, negative channels become
/// 0 with one warning.
pub(super) fn checked(
    path: &Path,
    [width, height]: [usize; 2],
    mut texels: Vec<Vec3>,
) -> Result<ImageFile, Diagnostic> {
    if let Some(index) = texels.iter().position(|texel| !texel.is_finite()) {
        let (x, y) = (index % width, index / width);
        let channels = texels[index].to_array().into_iter().zip(["R", "G", "B"]);
        let broken = channels.into_iter().find(|(value, _)| !value.is_finite());
        let (value, channel) = broken.unwrap_or((f32::NAN, "R"));
        let message = format!(
            "pixel ({x}, {y}): expected a finite number in channel {channel}, found {value}"
        );
        return Err(Diagnostic::file(path, message));
    }
    let mut negative = 0usize;
    for texel in &mut texels {
        if texel.min_element() < 0.0 {
            negative += 1;
            *texel = texel.max(Vec3::ZERO);
        }
    }
    let warning = (negative > 0).then(|| {
        let all = texels.len();
        let message = format!("{negative} of {all} texels were negative and were clamped to 0");
        Diagnostic::file(path, message)
    });
    let size = |n: usize| u32::try_from(n).unwrap_or(0);
    match Image::new(size(width), size(height), texels) {
        Ok(image) => Ok(ImageFile { image, warning }),
        Err(error) => Err(Diagnostic::file(path, error.to_string())),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn not_a_number_is_refused_with_pixel_and_channel() {
        let path = Path::new("a.exr");
        let mut texels = vec![Vec3::ONE; 6];
        texels[5].y = f32::NAN;
        let error = checked(path, [3, 2], texels).expect_err("an error");
        let expected =
            "a.exr: pixel (2, 1): expected a finite number in channel G, found NaN".to_owned();
        assert_eq!(error.to_string(), expected, "pixel and channel");
    }

    #[test]
    fn negative_texels_are_clamped_and_counted_once() {
        let path = Path::new("a.exr");
        let texels = vec![Vec3::new(-1.0, 2.0, -3.0), Vec3::ONE, Vec3::NEG_X];
        let file = checked(path, [3, 1], texels).expect("an image");
        let expected = [Vec3::Y * 2.0, Vec3::ONE, Vec3::ZERO];
        assert_eq!(file.image.texels(), expected, "clamped");
        let warning = file.warning.expect("a warning").to_string();
        let expected = "a.exr: 2 of 3 texels were negative and were clamped to 0";
        assert_eq!(warning, expected, "one warning");
    }
}
