use super::corners::corners;
use super::window::Opening;
use crate::MaterialId;
use crate::builtin::modeller::Modeller;
use crate::glam::Affine3A;

/// A wall from `x[0]` to `x[1]` and `y[0]` to `y[1]` in the plane z = 0 of `transform`, with gaps
/// for the openings of one floor, which lie side by side from left to right within it.
pub(super) fn wall(
    modeller: &mut Modeller,
    material: MaterialId,
    transform: &Affine3A,
    x: [f32; 2],
    y: [f32; 2],
    openings: &[Opening],
) {
    let mut panel = |x: [f32; 2], y: [f32; 2]| {
        if x[1] > x[0] && y[1] > y[0] {
            let [min, max] = corners(x, y);
            modeller.panel(material, transform, min, max, 0.0);
        }
    };
    let mut left = x[0];
    for opening in openings {
        panel([left, opening.x[0]], y);
        panel(opening.x, [y[0], opening.y[0]]);
        panel(opening.x, [opening.y[1], y[1]]);
        left = opening.x[1];
    }
    panel([left, x[1]], y);
}
