use crate::bilinear_cells::Shown;
use crate::uv_polygon::{Axis, UvPolygon};

/// The parts of a polygon between the kinks of the colour along an axis, each with a position
/// inside.
pub(super) fn each_strip(
    shown: &Shown<'_>,
    axis: Axis,
    polygon: &UvPolygon,
    mut each: impl FnMut(f64, &UvPolygon),
) {
    if polygon.is_empty() {
        return;
    }
    let [mut start, end] = polygon.place_bounds().map(|p| axis.of(p));
    let mut rest = *polygon;
    loop {
        let bend = shown.next_bend(axis, start);
        if bend >= end {
            return each(0.5 * (start + end), &rest);
        }
        let [strip, above] = rest.split(axis, bend);
        if !strip.is_empty() {
            each(0.5 * (start + bend), &strip);
        }
        // Above lies at least the highest corner, between two sides.
        (start, rest) = (bend, above);
    }
}
