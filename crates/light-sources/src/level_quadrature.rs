use crate::glam::DVec2;
use crate::uv_polygon::{Axis, Corner, UvPolygon, doubled_area};
use light_math::float;

/// A bilinear function of the place in an image, as far as it is above a level.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Level {
    /// Local coordinates of the place 0, and how they grow with the place.
    pub(crate) start: DVec2,
    pub(crate) slope: DVec2,
    /// The function at the four corners of the unit square of local coordinates, less the level:
    /// by y, then by x.
    pub(crate) corners: [[f64; 2]; 2],
}

impl Level {
    fn at(&self, place: DVec2) -> f64 {
        let local = self.start + self.slope * place;
        let row = |[a, b]: [f64; 2]| a + (b - a) * local.x;
        let [low, high] = self.corners.map(row);
        low + (high - low) * local.y
    }

    /// Where along an axis the function does not change along the other.
    fn pole(&self, axis: Axis) -> f64 {
        let [[a, b], [c, d]] = self.corners;
        let (low, high) = match axis {
            Axis::X => (c - a, d - b),
            Axis::Y => (b - a, d - c),
        };
        (low / (low - high) - axis.of(self.start)) / axis.of(self.slope)
    }
}

/// Nodes of Gauss and Legendre in `[0, 1]` with weights: five, and three.
const ALONG: [(f64, f64); 5] = [
    (0.046_910_077_030_668, 0.118_463_442_528_094_54),
    (0.230_765_344_947_158_45, 0.239_314_335_249_683_24),
    (0.5, 0.284_444_444_444_444_4),
    (0.769_234_655_052_841_5, 0.239_314_335_249_683_24),
    (0.953_089_922_969_332, 0.118_463_442_528_094_54),
];
const ACROSS: [(f64, f64); 3] = [
    (0.112_701_665_379_258_31, 5.0 / 18.0),
    (0.5, 4.0 / 9.0),
    (0.887_298_334_620_741_7, 5.0 / 18.0),
];

/// Calls `each` with places in a convex polygon and their weights, of which the sum is its area by
/// surface parameters: a quadrature of what is smooth on each side of the line where `level` is 0.
///
/// Lines across the polygon are cut where they meet that line, which bends like a hyperbola: it is
/// followed from one side of the polygon to another, in pieces that grow with the distance from
/// its asymptote. For polynomials up to degree 5 the error is below 1e-7.
pub(crate) fn each_node(polygon: &UvPolygon, level: &Level, mut each: impl FnMut(Corner, f64)) {
    let [min, max] = polygon.place_bounds();
    let extent = max - min;
    let axis = if extent.x > extent.y {
        Axis::X
    } else {
        Axis::Y
    };
    if !(axis.of(extent) > 0.0) {
        // In one point of the image.
        for corners in polygon.triangles() {
            each(corners[0], 0.5 * doubled_area(corners));
        }
        return;
    }
    let mut heights = [0.0; UvPolygon::MOST];
    let heights = &mut heights[..polygon.corners().len()];
    for (height, corner) in heights.iter_mut().zip(polygon.corners()) {
        *height = axis.of(corner.place);
    }
    heights.sort_unstable_by(f64::total_cmp);
    for ends in heights.windows(2) {
        if let Some(strip) = Strip::new(polygon, axis, [ends[0], ends[1]]) {
            strip.each_node(level, &mut each);
        }
    }
}

/// A part of a polygon between two lines across it: between two of its sides.
struct Strip {
    axis: Axis,
    ends: [f64; 2],
    /// Both sides, each from its lower to its upper end.
    sides: [[Corner; 2]; 2],
}

impl Strip {
    fn new(polygon: &UvPolygon, axis: Axis, ends: [f64; 2]) -> Option<Self> {
        let middle = 0.5 * (ends[0] + ends[1]);
        if !(ends[0] < middle && middle < ends[1]) {
            return None;
        }
        let mut last = *polygon.corners().last()?;
        let mut sides = [None; 2];
        for &corner in polygon.corners() {
            let [from, to] = [last, corner].map(|c| axis.of(c.place));
            if (from < middle) != (to < middle) {
                let at = |height: f64| lerp(&last, &corner, (height - from) / (to - from));
                let side = Some(ends.map(at));
                let free = sides.iter_mut().find(|side| side.is_none());
                if let Some(free) = free {
                    *free = side;
                }
            }
            last = corner;
        }
        // A closed line crosses the middle as often upwards as downwards.
        let [left, right] = sides;
        Some(Self {
            axis,
            ends,
            sides: [left?, right?],
        })
    }

    /// The ends of the line across that is `part` of the way up.
    fn across(&self, part: f64) -> [Corner; 2] {
        self.sides.map(|[low, high]| lerp(&low, &high, part))
    }

    fn each_node(&self, level: &Level, each: &mut impl FnMut(Corner, f64)) {
        // Where the level meets a side.
        let mut cuts = [1.0; 6];
        cuts[0] = 0.0;
        for (i, [low, high]) in self.sides.iter().enumerate() {
            let [start, middle, end] =
                [0.0, 0.5, 1.0].map(|part| level.at(low.place.lerp(high.place, part)));
            let roots = roots(start, middle, end);
            cuts[1 + 2 * i..3 + 2 * i].copy_from_slice(&roots);
        }
        cuts.sort_unstable_by(f64::total_cmp);
        let [low, high] = self.ends;
        let pole = (level.pole(self.axis) - low) / (high - low);
        for cut in cuts.windows(2) {
            let [start, end] = [cut[0], cut[1]];
            if !(start < end) {
                continue;
            }
            let [a, b] = self
                .across(0.5 * (start + end))
                .map(|c| level.at(c.place) < 0.0);
            if a == b {
                self.piece([start, end], level, each);
            } else {
                pieces([start, end], pole, |piece| self.piece(piece, level, each));
            }
        }
    }

    /// The nodes of a part of the strip in which the level meets both sides or none.
    fn piece(&self, [start, end]: [f64; 2], level: &Level, each: &mut impl FnMut(Corner, f64)) {
        let [low, high] = self.sides[0];
        let up = high.uv - low.uv;
        for (node, weight) in ALONG {
            let [a, b] = self.across(start + (end - start) * node);
            let area = (b.uv - a.uv).perp_dot(up).abs() * (end - start) * weight;
            let [fa, fb] = [a, b].map(|c| level.at(c.place));
            let cut = if (fa < 0.0) == (fb < 0.0) {
                1.0
            } else {
                fa / (fa - fb)
            };
            for [from, to] in [[0.0, cut], [cut, 1.0]] {
                if !(from < to) {
                    continue;
                }
                for (node, weight) in ACROSS {
                    let at = lerp(&a, &b, from + (to - from) * node);
                    each(at, area * (to - from) * weight);
                }
            }
        }
    }
}

/// Cuts an interval into pieces that are no longer than they are far from `pole`.
fn pieces([start, end]: [f64; 2], pole: f64, mut each: impl FnMut([f64; 2])) {
    let length = end - start;
    let distance = (start - pole).max(pole - end).max(1e-9 * length);
    let rises = pole < 0.5 * (start + end);
    let at = |way: f64| if rises { start + way } else { end - way };
    let mut done = 0.0;
    // A pole that is nowhere near is infinite or no number.
    while done < length {
        let next = (2.0 * done + distance).min(length);
        let next = if next > done { next } else { length };
        let [a, b] = [at(done), at(next)];
        each([a.min(b), a.max(b)]);
        done = next;
    }
}

/// Where in `[0, 1]` a parabola through three values, at 0, 1/2 and 1, is 0; 1 for none.
fn roots(start: f64, middle: f64, end: f64) -> [f64; 2] {
    let square = 2.0 * (start - 2.0 * middle + end);
    let line = end - start - square;
    let discriminant = line * line - 4.0 * square * start;
    if !(discriminant >= 0.0) {
        return [1.0; 2];
    }
    // Both with all of their digits.
    let q = -0.5 * (line + sqrt(discriminant).copysign(line));
    [q / square, start / q].map(|root| if root > 0.0 && root < 1.0 { root } else { 1.0 })
}

/// The square root in double precision, which `core` lacks: one step of Newton's from that in
/// single precision doubles its digits.
#[expect(clippy::cast_possible_truncation, reason = "a first guess")]
fn sqrt(x: f64) -> f64 {
    let guess = f64::from(float::sqrt(x as f32));
    let is_usable = guess > 0.0 && guess.is_finite();
    if is_usable {
        0.5 * (guess + x / guess)
    } else {
        guess
    }
}

fn lerp(a: &Corner, b: &Corner, part: f64) -> Corner {
    Corner {
        uv: a.uv.lerp(b.uv, part),
        place: a.place.lerp(b.place, part),
    }
}

#[cfg(test)]
mod tests;
