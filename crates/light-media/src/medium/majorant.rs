use super::height_bands::HeightBands;
use super::majorant_grid::MajorantGrid;
use crate::ray::{Ray, Span};
use light_math::glam::Vec3;

/// A part of a ray along which the extinction never exceeds `sigma_maj`, in any channel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MajorantSegment {
    /// The part of the ray.
    pub span: Span,
    /// The bound, per unit length.
    pub sigma_maj: f32,
}

/// Consecutive segments that fill a span, near end first.
#[derive(Clone, Debug)]
pub struct Majorants<'a> {
    rest: Option<Span>,
    sigma: f32,
    walk: Walk<'a>,
}

#[derive(Clone, Debug)]
enum Walk<'a> {
    Constant,
    Bands(HeightBands),
    Cells(CellWalk<'a>),
}

impl<'a> Majorants<'a> {
    /// One segment with one bound.
    #[must_use]
    pub fn constant(span: Span, sigma_maj: f32) -> Self {
        Self::new(span, sigma_maj, Walk::Constant)
    }

    /// The bands of height in which an exponential density stays within a factor of two.
    pub(super) fn bands(span: Span, max_sigma_t: f32, bands: HeightBands) -> Self {
        Self::new(span, max_sigma_t, Walk::Bands(bands))
    }

    /// The cells of coarse grids of maxima over the unit cube, which the ray crosses as `unit_ray`:
    /// the bound is the sum of all layers, each a grid and its factor. Points of the span are off
    /// by `rounding` in the cube.
    pub(super) fn cells(
        span: Span,
        layers: [Layer<'a>; 2],
        unit_ray: &Ray,
        rounding: Vec3,
    ) -> Self {
        let walk = CellWalk::new(layers, unit_ray, span.t0, rounding);
        Self::new(span, 1.0, Walk::Cells(walk))
    }

    fn new(span: Span, sigma: f32, walk: Walk<'a>) -> Self {
        Self {
            rest: Some(span),
            sigma,
            walk,
        }
    }
}

impl Iterator for Majorants<'_> {
    type Item = MajorantSegment;

    fn next(&mut self) -> Option<MajorantSegment> {
        let rest = self.rest?;
        let (density, end) = match &mut self.walk {
            Walk::Constant => (1.0, f32::INFINITY),
            Walk::Bands(bands) => bands.step(),
            Walk::Cells(cells) => cells.step(),
        };
        // Rounding may put the end before the start, which makes an empty segment; the walk
        // itself still goes on.
        let t = end.clamp(rest.t0, rest.t1);
        self.rest = Span::new(t, rest.t1);
        Some(MajorantSegment {
            span: Span { t0: rest.t0, t1: t },
            sigma_maj: self.sigma * density,
        })
    }
}

/// A grid of maxima and its factor.
pub(super) type Layer<'a> = Option<(&'a MajorantGrid, f32)>;

/// A traversal of the cells along a ray.
///
/// # Source
/// `[Amanatides1987]`.
#[derive(Clone, Debug)]
struct CellWalk<'a> {
    layers: [Layer<'a>; 2],
    /// Cells by which rounding may move a point, on each axis.
    reach: [i32; 3],
    cell: [i32; 3],
    step: [i32; 3],
    next_t: Vec3,
    delta_t: Vec3,
}

impl<'a> CellWalk<'a> {
    #[expect(clippy::cast_possible_truncation, reason = "clamped to the cells")]
    fn new(layers: [Layer<'a>; 2], ray: &Ray, t0: f32, rounding: Vec3) -> Self {
        let n = MajorantGrid::CELLS as f32;
        let start = ray.at(t0) * n;
        let mut walk = Self {
            layers,
            reach: (rounding * n).to_array().map(reach),
            cell: [0; 3],
            step: [0; 3],
            next_t: Vec3::INFINITY,
            delta_t: Vec3::INFINITY,
        };
        for axis in 0..3 {
            let cell = start[axis].clamp(0.0, n - 1.0) as i32;
            walk.cell[axis] = cell;
            // In the cube and not in cells, of which a ray may cross more than a float counts.
            let d = ray.d[axis];
            if d != 0.0 {
                walk.step[axis] = if d > 0.0 { 1 } else { -1 };
                let wall = (cell + i32::from(d > 0.0)) as f32 / n;
                walk.next_t[axis] = (wall - ray.o[axis]) / d;
                walk.delta_t[axis] = 1.0 / n / d.abs();
            }
        }
        walk
    }

    /// The maximum in the current cell, and the distance at which the ray leaves it.
    fn step(&mut self) -> (f32, f32) {
        let layers = self.layers.iter().flatten();
        let density = layers
            .map(|(grid, factor)| grid.max_near(self.cell, self.reach) * factor)
            .sum();
        let axis = self.next_t.min_position();
        let end = self.next_t[axis];
        self.cell[axis] += self.step[axis];
        self.next_t[axis] += self.delta_t[axis];
        // Past the last cell, only rounding error remains of the ray.
        let inside = usize::try_from(self.cell[axis]).is_ok_and(|cell| cell < MajorantGrid::CELLS);
        (density, if inside { end } else { f32::INFINITY })
    }
}

/// The cells by which a rounding of so many cells may move a point, beyond their margin.
#[expect(clippy::cast_possible_truncation, reason = "clamped to the cells")]
fn reach(rounding: f32) -> i32 {
    if rounding * f32::from(MajorantGrid::MARGINS_PER_CELL) < 1.0 {
        return 0;
    }
    // As far as there are cells if it is no number.
    let all = MajorantGrid::CELLS as f32;
    rounding.min(all) as i32 + 1
}

#[cfg(test)]
mod tests;
