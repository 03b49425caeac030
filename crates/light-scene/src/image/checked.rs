use std::path::Path;

use super::broken_texels::BrokenTexels;
use super::{Image, ImageFile};
use crate::Diagnostic;
use crate::glam::Vec3;

/// The image, if its texels are numbers: NaN, infinities and negative channels become what `broken`
/// says; one warning counts what is changed.
pub(super) fn checked(
    path: &Path,
    [width, height]: [usize; 2],
    mut texels: Vec<Vec3>,
    broken: BrokenTexels,
) -> Result<ImageFile, Diagnostic> {
    let all = texels.len();
    let count = texels.iter().filter(|texel| !texel.is_finite()).count();
    let may_clamp = broken == BrokenTexels::Clamp && count.saturating_mul(100) <= all;
    if count > 0 && !may_clamp {
        return Err(broken_texel(path, width, &texels));
    }
    let clamped = (count > 0).then(|| {
        clamp(&mut texels);
        format!("{count} of {all} texels were not finite and were clamped")
    });
    let mut negative = 0usize;
    for texel in &mut texels {
        if broken != BrokenTexels::KeepNegative && texel.min_element() < 0.0 {
            negative += 1;
            *texel = texel.max(Vec3::ZERO);
        }
    }
    let negative = (negative > 0)
        .then(|| format!("{negative} of {all} texels were negative and were clamped to 0"));
    let messages: Vec<String> = clamped.into_iter().chain(negative).collect();
    let warning = (!messages.is_empty()).then(|| Diagnostic::file(path, messages.join("; ")));
    let size = |n: usize| u32::try_from(n).unwrap_or(0);
    match Image::new(size(width), size(height), texels) {
        Ok(image) => Ok(ImageFile { image, warning }),
        Err(error) => Err(Diagnostic::file(path, error.to_string())),
    }
}

/// The error of the first texel that is not finite.
fn broken_texel(path: &Path, width: usize, texels: &[Vec3]) -> Diagnostic {
    let index = texels.iter().position(|texel| !texel.is_finite());
    let index = index.unwrap_or_default();
    let (x, y) = (index % width, index / width);
    let channels = texels[index].to_array().into_iter().zip(["R", "G", "B"]);
    let broken = channels.into_iter().find(|(value, _)| !value.is_finite());
    let (value, channel) = broken.unwrap_or((f32::NAN, "R"));
    let message =
        format!("pixel ({x}, {y}): expected a finite number in channel {channel}, found {value}");
    Diagnostic::file(path, message)
}

/// Makes NaN 0, and infinity the largest finite number.
fn clamp(texels: &mut [Vec3]) {
    let numbers = texels.iter().flat_map(Vec3::to_array);
    let largest = numbers.filter(|n| n.is_finite()).fold(0.0, f32::max);
    for texel in texels {
        *texel = texel.map(|n| if n.is_nan() { 0.0 } else { n.min(largest) });
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
        let error = checked(path, [3, 2], texels, BrokenTexels::Refuse).expect_err("an error");
        let expected =
            "a.exr: pixel (2, 1): expected a finite number in channel G, found NaN".to_owned();
        assert_eq!(error.to_string(), expected, "pixel and channel");
    }

    #[test]
    fn negative_texels_are_clamped_and_counted_once() {
        let path = Path::new("a.exr");
        let texels = vec![Vec3::new(-1.0, 2.0, -3.0), Vec3::ONE, Vec3::NEG_X];
        let file = checked(path, [3, 1], texels, BrokenTexels::Refuse).expect("an image");
        let expected = [Vec3::Y * 2.0, Vec3::ONE, Vec3::ZERO];
        assert_eq!(file.image.texels(), expected, "clamped");
        let warning = file.warning.expect("a warning").to_string();
        let expected = "a.exr: 2 of 3 texels were negative and were clamped to 0";
        assert_eq!(warning, expected, "one warning");
    }

    #[test]
    fn negative_texels_stay_where_pictures_are_compared() {
        let path = Path::new("a.exr");
        let texels = vec![Vec3::new(-1.0, 2.0, -3.0), Vec3::ONE];
        let file = checked(path, [2, 1], texels.clone(), BrokenTexels::KeepNegative);
        let file = file.expect("an image");
        assert_eq!(file.image.texels(), texels, "as they are");
        assert_eq!(file.warning, None, "nothing is changed");
        let broken = checked(path, [1, 1], vec![Vec3::NAN], BrokenTexels::KeepNegative);
        assert!(broken.is_err(), "no number");
    }

    #[test]
    fn a_few_broken_texels_are_clamped_and_counted() {
        let path = Path::new("a.exr");
        let mut texels = vec![Vec3::splat(2.0); 300];
        texels[0] = Vec3::new(f32::NAN, f32::INFINITY, 5.0);
        texels[7] = Vec3::new(1.0, f32::NEG_INFINITY, 1.0);
        let clamped = |texels| checked(path, [300, 1], texels, BrokenTexels::Clamp);
        let file = clamped(texels.clone()).expect("an image");
        assert_eq!(
            file.image.texels()[0],
            Vec3::new(0.0, 5.0, 5.0),
            "0 and the largest"
        );
        assert_eq!(file.image.texels()[7], Vec3::new(1.0, 0.0, 1.0), "below 0");
        let warning = file.warning.expect("a warning").to_string();
        let expected = "a.exr: 2 of 300 texels were not finite and were clamped; 1 of 300 texels \
            were negative and were clamped to 0";
        assert_eq!(warning, expected, "counted");
        texels[20..22].fill(Vec3::NAN);
        let error = clamped(texels).expect_err("four are not a few").to_string();
        assert!(error.contains("pixel (0, 0)"), "{error}");
    }
}
