//! Colours of other primaries than those of Rec. 709.

use exr::meta::attribute::Chromaticities;

use crate::glam::{DMat3, DVec3, Vec3};

/// Chromaticities (x, y) of red, green, blue and white.
type Primaries = [[f64; 2]; 4];

/// Those of Rec. 709, with the white of D65.
const REC_709: Primaries = [[0.64, 0.33], [0.3, 0.6], [0.15, 0.06], [0.3127, 0.329]];

/// From XYZ to what cones see, in rows.
///
/// # Source
/// `[Lam1985]`, the Bradford transform.
const BRADFORD: [[f64; 3]; 3] = [
    [0.8951, 0.2664, -0.1614],
    [-0.7502, 1.7135, 0.0367],
    [0.0389, -0.0685, 1.0296],
];

/// The matrix from linear colours of a file to those of Rec. 709, where white stays white; `None`
/// where there is nothing to do, or the primaries make no colours.
pub(super) fn to_rec_709(file: &Chromaticities) -> Option<DMat3> {
    let pair = |at: exr::math::Vec2<f32>| [f64::from(at.0), f64::from(at.1)];
    let primaries = [file.red, file.green, file.blue, file.white].map(pair);
    let pairs = primaries.as_flattened().iter().zip(REC_709.as_flattened());
    if pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) < 1e-3 {
        return None;
    }
    let matrix = to_xyz(&REC_709).inverse() * adaptation(primaries[3]) * to_xyz(&primaries);
    matrix.is_finite().then_some(matrix)
}

/// Colours under a matrix.
pub(super) fn convert(texels: &mut [Vec3], matrix: &DMat3) {
    for texel in texels {
        *texel = (*matrix * texel.as_dvec3()).as_vec3();
    }
}

/// From linear colours to XYZ, where white has Y = 1.
fn to_xyz(primaries: &Primaries) -> DMat3 {
    let [red, green, blue, white] = primaries.map(xyz);
    let columns = DMat3::from_cols(red, green, blue);
    let amounts = columns.inverse() * white;
    columns * DMat3::from_diagonal(amounts)
}

/// From XYZ under a white to XYZ under D65.
fn adaptation(white: [f64; 2]) -> DMat3 {
    let cones = DMat3::from_cols_array_2d(&BRADFORD).transpose();
    let [from, to] = [white, REC_709[3]].map(|white| cones * xyz(white));
    cones.inverse() * DMat3::from_diagonal(to / from) * cones
}

/// XYZ of a chromaticity, with Y = 1.
fn xyz([x, y]: [f64; 2]) -> DVec3 {
    DVec3::new(x / y, 1.0, (1.0 - x - y) / y)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::glam::DVec2;

    fn chromaticities(primaries: Primaries) -> Chromaticities {
        let [red, green, blue, white] = primaries.map(|at| {
            let at = DVec2::from(at).as_vec2();
            exr::math::Vec2(at.x, at.y)
        });
        Chromaticities {
            red,
            green,
            blue,
            white,
        }
    }

    /// AP0 of ACES: the published matrix to Rec. 709 with the Bradford transform.
    #[test]
    fn aces_becomes_rec_709() {
        let ap0 = [
            [0.7347, 0.2653],
            [0.0, 1.0],
            [0.0001, -0.077],
            [0.32168, 0.33767],
        ];
        let matrix = to_rec_709(&chromaticities(ap0)).expect("other primaries");
        let published = [
            [2.521_686, -1.134_131, -0.387_555],
            [-0.276_48, 1.372_719, -0.096_239],
            [-0.015_378, -0.152_975, 1.168_354],
        ];
        let off = matrix - DMat3::from_cols_array_2d(&published).transpose();
        let off = off
            .to_cols_array()
            .into_iter()
            .fold(0.0, |most: f64, x| most.max(x.abs()));
        assert!(off < 1e-3, "{matrix}");
        let mut white = [Vec3::ONE];
        convert(&mut white, &matrix);
        assert!(white[0].distance(Vec3::ONE) < 1e-5, "white stays white");
    }

    #[test]
    fn rec_709_and_what_is_no_color_stay() {
        assert_eq!(to_rec_709(&chromaticities(REC_709)), None, "nothing to do");
        assert_eq!(
            to_rec_709(&chromaticities([[0.3, 0.3]; 4])),
            None,
            "one colour"
        );
    }
}
