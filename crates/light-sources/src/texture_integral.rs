mod bend_strips;
mod block_grid;
mod color_sum;
mod image_corners;

use crate::bilinear_cells::{Shown, ShownCell};
use crate::block_means::{Block, BlockMeans};
use crate::glam::{DVec3, Vec2, Vec3};
use crate::image_behind::{ImageBehind, Places};
use crate::row_integral::mean_by_rows;
use crate::shape::{UvArea, UvDensity};
use crate::texture_mapping::{TextureMapping, Wrap};
use crate::triangle_rules::{DEGREE_2, DEGREE_5};
use crate::uv_polygon::{Axis, Corner, UvPolygon};
use bend_strips::each_strip;
use block_grid::BlockGrid;
use color_sum::ColorSum;
use image_corners::{image_corners, is_single};

/// The mean of a texture over the area of a surface.
///
/// Exact: the surface is cut at the kinks of the colour, which are at the centres of texels;
/// between them it is a polynomial. The means of blocks of texels that the surface covers as a
/// whole are stored. Above 0 if any visible texel is.
///
/// Only a surface of more than [`FINEST`] blocks along an axis is cut more coarsely.
///
/// `behind` is an image of which `shown` is the mask, where they have different mappings. All of a
/// mask is visited then; one that repeats itself on the surface, up to [`FINEST_REPEATED`] blocks.
pub(crate) fn mean(
    shown: &Shown<'_>,
    blocks: &BlockMeans,
    mapping: &TextureMapping,
    behind: Option<ImageBehind<'_>>,
    area: &UvArea,
) -> Vec3 {
    let mut integral = Integral {
        behind,
        ..Integral::new(shown, blocks, UvDensity::Even)
    };
    match *area {
        // The area is uniform for any surface parameters, so that any others do as well.
        UvArea::Triangle(shown) => integral.add([Vec2::ZERO, Vec2::X, Vec2::Y], shown, mapping),
        UvArea::Square(density) => {
            integral.colors.density = density;
            for [low, high] in pieces(&density) {
                let corners = [
                    low,
                    Vec2::new(high.x, low.y),
                    high,
                    Vec2::new(low.x, high.y),
                ];
                integral.add(corners, corners, mapping);
            }
        }
    }
    integral.mean()
}

/// Parts of the unit square on which a density is nearly a polynomial of low degree.
fn pieces(density: &UvDensity) -> impl Iterator<Item = [Vec2; 2]> {
    let [columns, rows] = match density {
        UvDensity::Even => [1, 1],
        UvDensity::Sine => [1, 16],
        UvDensity::Length(_) => [8, 8],
    };
    let count = Vec2::new(f32::from(columns), f32::from(rows));
    (0..columns * rows).map(move |i: u8| {
        let low = Vec2::new(f32::from(i % columns), f32::from(i / columns));
        [low / count, (low + 1.0) / count]
    })
}

/// The most blocks of a surface along an axis, as a power of two.
const FINEST: u32 = 12;

/// As [`FINEST`], for a mask with a mapping of its own that a surface shows more than twice along an
/// axis: in smaller blocks that are partly masked, it is replaced by its mean, independent of the
/// image behind.
const FINEST_REPEATED: u32 = 7;

/// Weight of neighbouring texels that rounding may make visible: far below single precision.
const NEARBY: f64 = 1.0 / (1u64 << 40) as f64;

struct Integral<'a> {
    grid: BlockGrid<'a>,
    colors: ColorSum,
    /// Texels near the polygons, above 0 where any of them is.
    nearby: DVec3,
    behind: Option<ImageBehind<'a>>,
    /// Where the polygon that is added lies in the image, and in the image behind.
    places: Option<[Places; 2]>,
}

impl<'a> Integral<'a> {
    fn new(shown: &'a Shown<'a>, blocks: &'a BlockMeans, density: UvDensity) -> Self {
        Self {
            grid: BlockGrid { shown, blocks },
            colors: ColorSum::new(density),
            nearby: DVec3::ZERO,
            behind: None,
            places: None,
        }
    }

    /// Adds the polygon with these surface parameters and image coordinates.
    fn add<const N: usize>(
        &mut self,
        corners: [Vec2; N],
        shown: [Vec2; N],
        mapping: &TextureMapping,
    ) {
        let corners = image_corners(self.wrap(), corners, shown, mapping);
        let polygon = UvPolygon::new(&corners);
        let mut nearby = self.grid.near(&polygon);
        if let Some(behind) = self.behind {
            let image = BlockGrid {
                shown: behind.shown,
                blocks: behind.blocks,
            };
            let uvs = corners.map(|corner| corner.uv.as_vec2());
            let corners_behind = image_corners(behind.shown.wrap, uvs, shown, behind.mapping);
            nearby *= image.near(&UvPolygon::new(&corners_behind));
            let places = |c: &[Corner; N]| Places::new([c[0], c[1], c[2]]);
            self.places = Some([places(&corners), places(&corners_behind)]);
        }
        self.nearby += nearby;
        self.polygon(polygon);
    }

    fn mean(self) -> Vec3 {
        if !(self.colors.total > 0.0) {
            return Vec3::ZERO;
        }
        let exact = self.colors.sum / self.colors.total;
        debug_assert!(!exact.is_nan(), "the mean of finite colours");
        // A mean below the float range is not quite black.
        let darkest = self.nearby.map(|x| {
            if x > 0.0 {
                f64::from(f32::MIN_POSITIVE)
            } else {
                0.0
            }
        });
        exact.max(self.nearby * NEARBY).max(darkest).as_vec3()
    }

    fn wrap(&self) -> [Wrap; 2] {
        self.grid.shown.wrap
    }

    fn polygon(&mut self, polygon: UvPolygon) {
        let mut inside = polygon;
        for axis in Axis::BOTH {
            if !is_single(self.wrap(), axis) {
                continue;
            }
            let [below, rest] = inside.split(axis, 0.0);
            let [middle, above] = rest.split(axis, 1.0);
            self.cells(&below);
            self.cells(&above);
            inside = middle;
        }
        if inside.is_empty() || self.rows(&inside) {
            return;
        }
        let (level, [low, high]) = self.grid.covering(inside.place_bounds());
        let most = match self.behind {
            None => FINEST,
            Some(_) => FINEST.min(FINEST_REPEATED.max(self.grid.blocks.levels() + 1)),
        };
        let finest = level.saturating_sub(most);
        let mut rows = inside;
        for y in low[1]..=high[1] {
            let [mut row, above] = rows.split(Axis::Y, self.grid.edge(Axis::Y, level, y + 1));
            rows = above;
            for x in low[0]..=high[0] {
                let [part, right] = row.split(Axis::X, self.grid.edge(Axis::X, level, x + 1));
                row = right;
                let index = [x, y];
                self.block(Block { level, index }, finest, &part);
            }
        }
    }

    /// Adds `part`, the intersection of the polygon with a block.
    fn block(&mut self, block: Block, finest: u32, part: &UvPolygon) {
        if part.is_empty() {
            return;
        }
        let Block { level, index } = block;
        let mean = self.grid.blocks.mean(block, self.wrap());
        if let (Some(mean), Some([_, behind])) = (mean, self.places) {
            let is_coarse = level > 0 && level <= finest;
            if is_coarse || mean.x == 0.0 || mean.x == 1.0 {
                return self.add_behind(mean.x, &behind.of(part));
            }
        } else if let Some(mean) = mean {
            let side = |axis: Axis| {
                let edge = |i| self.grid.edge(axis, level, index[axis as usize] + i);
                // The last block may extend beyond the image.
                let [low, high] = [edge(0), edge(1)];
                if is_single(self.wrap(), axis) {
                    high.min(1.0) - low
                } else {
                    high - low
                }
            };
            let area = side(Axis::X) * side(Axis::Y);
            let is_covered = part.place_area() >= (1.0 - 1e-9) * area;
            if (is_covered && self.colors.is_even(part)) || (level > 0 && level <= finest) {
                return self.colors.add(mean, part);
            }
        }
        if self.rows(part) {
            return;
        }
        if level == 0 {
            return self.cells(part);
        }
        let [x, y] = index.map(|i| 2 * i);
        let level = level - 1;
        let middle = [
            self.grid.edge(Axis::X, level, x + 1),
            self.grid.edge(Axis::Y, level, y + 1),
        ];
        for (dy, row) in (0..).zip(part.split(Axis::Y, middle[1])) {
            let columns = row.split(Axis::X, middle[0]);
            for (dx, child) in (0..).zip(columns) {
                let index = [x + dx, y + dy];
                self.block(Block { level, index }, finest, &child);
            }
        }
    }

    /// Adds a polygon of the image behind, times `share`.
    fn add_behind(&mut self, share: f64, polygon: &UvPolygon) {
        let Some(behind) = self.behind else {
            return;
        };
        let mut image = Integral::new(behind.shown, behind.blocks, self.colors.density);
        image.polygon(*polygon);
        self.colors.sum += image.colors.sum * share;
        self.colors.total += image.colors.total;
    }

    /// Adds a small polygon of uniform density on one image; returns whether it could.
    fn rows(&mut self, polygon: &UvPolygon) -> bool {
        let (Some(image), None) = (self.grid.shown.image, self.grid.shown.mask) else {
            return false;
        };
        if self.colors.density != UvDensity::Even {
            return false;
        }
        let mean = mean_by_rows(image, self.wrap(), polygon);
        if let Some(mean) = mean {
            self.colors.add(mean, polygon);
        }
        mean.is_some()
    }

    /// Adds any polygon, piece by piece between the kinks of the colour.
    fn cells(&mut self, polygon: &UvPolygon) {
        let shown = self.grid.shown;
        each_strip(shown, Axis::X, polygon, |x, column| {
            each_strip(shown, Axis::Y, column, |y, piece| {
                self.piece(&shown.cell([x, y]), piece);
            });
        });
    }

    /// Adds a polygon between the bends of what is shown.
    fn piece(&mut self, cell: &ShownCell, piece: &UvPolygon) {
        let (Some(behind), Some([here, there])) = (self.behind, self.places) else {
            let Shown { mask, .. } = self.grid.shown;
            let is_simple = mask.is_none() && self.colors.density == UvDensity::Even;
            let rule: &[_] = if is_simple { &DEGREE_2 } else { &DEGREE_5 };
            return self.colors.add_cell(cell, piece, rule, |_| DVec3::ONE);
        };
        let image = behind.shown;
        each_strip(image, Axis::X, &there.of(piece), |x, column| {
            each_strip(image, Axis::Y, column, |y, part| {
                let color = image.cell([x, y]);
                self.colors.add_cell(cell, &here.of(part), &DEGREE_5, |uv| {
                    let place = there.at(uv);
                    color.at(place.x, place.y)
                });
            });
        });
    }
}

#[cfg(test)]
mod tests;
