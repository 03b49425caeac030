use lights::glam::{Mat3, Vec3};

/// Linear sRGB to CIE XYZ, by columns.
///
/// # Source
/// IEC 61966-2-1 with the white point D65.
const TO_XYZ: Mat3 = Mat3::from_cols(
    Vec3::new(
        10_135_552.0 / 24_577_794.0,
        2_613_072.0 / 12_288_897.0,
        1_425_312.0 / 73_733_382.0,
    ),
    Vec3::new(
        8_788_810.0 / 24_577_794.0,
        8_788_810.0 / 12_288_897.0,
        8_788_810.0 / 73_733_382.0,
    ),
    Vec3::new(
        4_435_075.0 / 24_577_794.0,
        887_015.0 / 12_288_897.0,
        70_074_185.0 / 73_733_382.0,
    ),
);

/// The exponent of colour differences.
const QC: f32 = 0.7;

/// The share of the largest difference that takes the share [`PT`] of the scale.
const PC: f32 = 0.4;

/// See [`PC`].
const PT: f32 = 0.95;

/// XYZ relative to white.
fn relative_xyz(rgb: Vec3) -> Vec3 {
    TO_XYZ * rgb / (TO_XYZ * Vec3::ONE)
}

/// The linear opponent colours Y, Cx, Cz of a linear colour.
pub(super) fn opponent(rgb: Vec3) -> Vec3 {
    let xyz = relative_xyz(rgb);
    Vec3::new(
        116.0 * xyz.y - 16.0,
        500.0 * (xyz.x - xyz.y),
        200.0 * (xyz.y - xyz.z),
    )
}

/// The linear colour of opponent colours.
fn linear(opponent: Vec3) -> Vec3 {
    let y = (opponent.x + 16.0) / 116.0;
    let relative = Vec3::new(y + opponent.y / 500.0, y, y - opponent.z / 200.0);
    TO_XYZ.inverse() * (relative * (TO_XYZ * Vec3::ONE))
}

/// CIE L*a*b* of opponent colours, clamped to what a screen shows, with chroma that fades in the
/// dark.
pub(super) fn hunt_lab(opponent: Vec3) -> Vec3 {
    hunt_lab_of(linear(opponent).clamp(Vec3::ZERO, Vec3::ONE))
}

/// [`hunt_lab`] of a linear colour.
fn hunt_lab_of(rgb: Vec3) -> Vec3 {
    /// Where the cube root gives way to a line.
    const DELTA: f32 = 6.0 / 29.0;
    let f = relative_xyz(rgb).map(|t| {
        if t > DELTA * DELTA * DELTA {
            t.cbrt()
        } else {
            t / (3.0 * DELTA * DELTA) + 4.0 / 29.0
        }
    });
    let lightness = 116.0 * f.y - 16.0;
    let chroma = 0.01 * lightness;
    Vec3::new(
        lightness,
        chroma * 500.0 * (f.x - f.y),
        chroma * 200.0 * (f.y - f.z),
    )
}

/// The distance of two colours that also holds for large ones, to the power [`QC`].
fn distance(a: Vec3, b: Vec3) -> f32 {
    let d = a - b;
    (d.x.abs() + d.y.hypot(d.z)).powf(QC)
}

/// The largest distance that counts: that of green and blue.
pub(super) fn max_distance() -> f32 {
    distance(hunt_lab_of(Vec3::Y), hunt_lab_of(Vec3::Z))
}

/// The colour difference in `[0, 1]`, where `max` is [`max_distance`].
pub(super) fn difference(a: Vec3, b: Vec3, max: f32) -> f32 {
    let (distance, knee) = (distance(a, b), PC * max);
    if distance < knee {
        distance * PT / knee
    } else {
        PT + (distance - knee) / (max - knee) * (1.0 - PT)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn white_and_grey_have_no_chroma() {
        for level in [0.0, 0.18, 1.0] {
            let [y, cx, cz] = opponent(Vec3::splat(level)).to_array();
            assert!((y - (116.0 * level - 16.0)).abs() < 1e-3, "{level}: {y}");
            assert!(cx.abs() < 1e-3 && cz.abs() < 1e-3, "{level}: {cx}, {cz}");
        }
        let white = hunt_lab(opponent(Vec3::ONE));
        assert!(white.distance(Vec3::new(100.0, 0.0, 0.0)) < 1e-2, "{white}");
    }

    #[test]
    fn opponent_colors_come_back() {
        let color = Vec3::new(0.2, 0.7, 0.4);
        let back = linear(opponent(color));
        assert!(back.distance(color) < 1e-5, "{back}");
    }

    #[test]
    fn differences_go_from_0_to_1() {
        let [black, green, blue] = [Vec3::ZERO, Vec3::Y, Vec3::Z].map(hunt_lab_of);
        let max = max_distance();
        assert_eq!(difference(green, green, max), 0.0, "the same");
        assert!(
            (difference(green, blue, max) - 1.0).abs() < 1e-6,
            "the largest"
        );
        let dark = difference(black, blue, max);
        assert!(dark > 0.0 && dark < 1.0, "{dark}");
    }
}
