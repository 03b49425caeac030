use crate::glam::Vec3;

/// The luminance of a linear colour with the primaries of Rec. 709 (those of sRGB); 1 of white.
///
/// # Source
/// ITU-R BT.709-6, item 3.2.
#[inline]
#[must_use]
pub fn rec709_luminance(rgb: Vec3) -> f32 {
    rgb.dot(Vec3::new(0.2126, 0.7152, 0.0722))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn primaries_add_up_to_white() {
        let primaries = [Vec3::X, Vec3::Y, Vec3::Z].map(rec709_luminance);
        assert_eq!(primaries, [0.2126, 0.7152, 0.0722], "primaries");
        assert_eq!(rec709_luminance(Vec3::ONE), 1.0, "white");
    }
}
