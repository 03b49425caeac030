use crate::floor::floor;
use crate::glam::{DVec2, Vec2};
use crate::texture_mapping::{TextureMapping, Wrap};
use crate::uv_polygon::{Axis, Corner, UvPolygon};

/// The most repetitions of an image that are integrated: more do not change the mean.
const MOST_REPEATED: f64 = 1024.0;

/// Where surface parameters `corners` lie that show what lies at `shown`, moved to where the
/// image repeats itself.
pub(super) fn image_corners<const N: usize>(
    wrap: [Wrap; 2],
    corners: [Vec2; N],
    shown: [Vec2; N],
    mapping: &TextureMapping,
) -> [Corner; N] {
    let transform = &mapping.transform;
    let [x, y] = [transform.x_axis, transform.y_axis].map(|axis| axis.as_dvec2());
    let offset = transform.translation.as_dvec2();
    let corner = |i: usize| {
        let (uv, at) = (corners[i].as_dvec2(), shown[i].as_dvec2());
        let place = x * at.x + y * at.y + offset;
        let place = DVec2::new(place.x, 1.0 - place.y);
        // NaN is treated as a lookup treats it.
        let place = if place.is_finite() {
            place
        } else {
            DVec2::ZERO
        };
        Corner { uv, place }
    };
    let mut corners: [Corner; N] = core::array::from_fn(corner);
    fold(wrap, &mut corners);
    corners
}

/// Shifts the corners by whole periods of the image, near to the origin.
fn fold(wrap: [Wrap; 2], corners: &mut [Corner]) {
    let [min, max] = UvPolygon::new(corners).place_bounds();
    for corner in corners {
        for axis in Axis::BOTH {
            if is_single(wrap, axis) {
                // Beyond its edges the colour does not change.
                let place = &mut corner.place[axis as usize];
                *place = place.clamp(-1e9, 1e9);
                continue;
            }
            let (min, max) = (axis.of(min), axis.of(max));
            let place = &mut corner.place[axis as usize];
            let origin = 2.0 * floor(0.5 * min);
            *place -= if origin.abs() < 1e15 { origin } else { min };
            if max - min > MOST_REPEATED {
                *place *= MOST_REPEATED / (max - min);
            }
        }
    }
}

/// Whether there is only one image along an axis.
pub(super) fn is_single(wrap: [Wrap; 2], axis: Axis) -> bool {
    matches!(wrap[axis as usize], Wrap::Clamp | Wrap::Black)
}
