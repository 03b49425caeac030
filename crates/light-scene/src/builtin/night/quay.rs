use super::course::{Bank, Course};
use super::measures::{FRONTS, QUAY, WATER};
use super::palette::Palette;
use crate::builtin::modeller::Modeller;
use crate::glam::{Affine3A, Vec3};

/// Where the built canal begins and ends, along its middle.
const ENDS: [f32; 2] = [-30.0, 165.0];

/// Pieces of which the bend is made.
const PIECES: u16 = 78;

/// Width of the kerb that runs along the water.
const KERB: f32 = 0.45;

/// The water, and on both banks wall, kerb and street.
pub(super) fn water_and_quays(modeller: &mut Modeller, palette: &Palette, course: &Course) {
    let wide = 400.0;
    let corner = |x: f32, z: f32| Vec3::new(x * wide, 0.0, z * wide);
    let corners = [
        corner(-1.0, 1.0),
        corner(1.0, 1.0),
        corner(1.0, -1.0),
        corner(-1.0, -1.0),
    ];
    modeller.quad(palette.water, corners);
    for k in 0..PIECES {
        let at = |k: u16| ENDS[0] + (ENDS[1] - ENDS[0]) * f32::from(k) / f32::from(PIECES);
        for bank in Bank::BOTH {
            piece(
                modeller,
                palette,
                bank,
                &course.at(at(k), 0.0),
                &course.at(at(k + 1), 0.0),
            );
        }
    }
}

/// One straight piece between two cuts across the canal.
fn piece(modeller: &mut Modeller, palette: &Palette, bank: Bank, near: &Affine3A, far: &Affine3A) {
    // The outline of the bank from the water to under the houses, one material per edge.
    let outline = [
        (WATER, -0.5, palette.quay_wall),
        (WATER, QUAY - 0.25, palette.stone),
        (WATER - 0.08, QUAY - 0.25, palette.stone),
        (WATER - 0.08, QUAY + 0.06, palette.stone),
        (WATER + KERB, QUAY + 0.06, palette.stone),
        (WATER + KERB, QUAY, palette.paving),
        (FRONTS + 14.0, QUAY, palette.paving),
    ];
    for edge in outline.windows(2) {
        let (a, b) = (edge[0], edge[1]);
        let point = |cut: &Affine3A, (away, height, _): (f32, f32, _)| {
            cut.transform_point3(Vec3::new(bank.sign() * away, height, 0.0))
        };
        let corners = [point(near, a), point(near, b), point(far, b), point(far, a)];
        let corners = match bank {
            Bank::Left => corners,
            Bank::Right => [corners[3], corners[2], corners[1], corners[0]],
        };
        modeller.quad(a.2, corners);
    }
}
