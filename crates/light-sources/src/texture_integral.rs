use crate::bilinear_cells::{Shown, ShownCell};
use crate::block_means::{Block, BlockMeans};
use crate::floor::floor;
use crate::glam::{DVec2, DVec3, Vec2, Vec3};
use crate::image_behind::{ImageBehind, Places};
use crate::level_quadrature::each_node;
use crate::row_integral::mean_by_rows;
use crate::shape::{UvArea, UvDensity};
use crate::texture_mapping::{TextureMapping, Wrap};
use crate::triangle_rules::{DEGREE_2, DEGREE_5};
use crate::uv_polygon::{Axis, Corner, UvPolygon, doubled_area};

/// The mean of a texture over the area of a surface.
///
/// Exact: the surface is cut at the kinks of the colour, which are at the centres of texels;
/// between them it is a polynomial. The means of blocks of texels that the surface covers as a
/// whole are stored. Above 0 if any visible texel is.
///
/// Only a surface of more than [`FINEST`] blocks along an axis is cut more coarsely.
///
/// `behind` is an image of which `shown` is the mask, where they have different mappings; it is
/// exact up to [`FINEST_APART`] blocks.
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
            integral.density = density;
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

/// As [`FINEST`], for a mask with a mapping of its own: in smaller blocks that are partly masked,
/// it is replaced by its mean, independent of the image behind.
const FINEST_APART: u32 = 5;

/// The most repetitions of an image that are integrated: more do not change the mean.
const MOST_REPEATED: f64 = 1024.0;

/// The size in surface parameters below which a density counts as uniform within a block.
const EVEN: f64 = 1.0 / 1024.0;

/// Weight of neighbouring texels that rounding may make visible: far below single precision.
const NEARBY: f64 = 1.0 / (1u64 << 40) as f64;

struct Integral<'a> {
    shown: &'a Shown<'a>,
    blocks: &'a BlockMeans,
    density: UvDensity,
    sum: DVec3,
    total: f64,
    nearby: DVec3,
    behind: Option<ImageBehind<'a>>,
    /// Where the polygon that is added lies in the image, and in the image behind.
    places: Option<[Places; 2]>,
}

impl<'a> Integral<'a> {
    fn new(shown: &'a Shown<'a>, blocks: &'a BlockMeans, density: UvDensity) -> Self {
        Self {
            shown,
            blocks,
            density,
            sum: DVec3::ZERO,
            total: 0.0,
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
        let corners = self.folded(corners, shown, mapping);
        let polygon = UvPolygon::new(&corners);
        let mut nearby = self.near(&polygon);
        if let Some(behind) = self.behind {
            let image = Integral::new(behind.shown, behind.blocks, self.density);
            let uvs = corners.map(|corner| corner.uv.as_vec2());
            let corners_behind = image.folded(uvs, shown, behind.mapping);
            nearby *= image.near(&UvPolygon::new(&corners_behind));
            let places = |c: &[Corner; N]| Places::new([c[0], c[1], c[2]]);
            self.places = Some([places(&corners), places(&corners_behind)]);
        }
        self.nearby += nearby;
        self.polygon(polygon);
    }

    /// Where surface parameters `corners` lie that show what lies at `shown`, moved to where the
    /// image repeats itself.
    fn folded<const N: usize>(
        &self,
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
        self.fold(&mut corners);
        corners
    }

    fn mean(self) -> Vec3 {
        if !(self.total > 0.0) {
            return Vec3::ZERO;
        }
        let exact = self.sum / self.total;
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

    /// Shifts the corners by whole periods of the image, near to the origin.
    fn fold(&self, corners: &mut [Corner]) {
        let [min, max] = UvPolygon::new(corners).place_bounds();
        for corner in corners {
            for axis in Axis::BOTH {
                if self.ends(axis) {
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
    fn ends(&self, axis: Axis) -> bool {
        matches!(self.shown.wrap[axis as usize], Wrap::Clamp | Wrap::Black)
    }

    fn polygon(&mut self, polygon: UvPolygon) {
        let mut inside = polygon;
        for axis in Axis::BOTH {
            if !self.ends(axis) {
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
        let (level, [low, high]) = self.covering(inside.place_bounds());
        let most = self.behind.map_or(FINEST, |_| FINEST_APART);
        let finest = level.saturating_sub(most);
        let mut rows = inside;
        for y in low[1]..=high[1] {
            let [mut row, above] = rows.split(Axis::Y, self.edge(Axis::Y, level, y + 1));
            rows = above;
            for x in low[0]..=high[0] {
                let [part, right] = row.split(Axis::X, self.edge(Axis::X, level, x + 1));
                row = right;
                let index = [x, y];
                self.block(Block { level, index }, finest, &part);
            }
        }
    }

    /// The lower edge of a block.
    fn edge(&self, axis: Axis, level: u32, index: i64) -> f64 {
        index as f64 * (1u64 << level) as f64 / self.blocks.count(axis)
    }

    /// The finest level of which at most two blocks along each axis cover a rectangle, with the
    /// first and the last of them.
    fn covering(&self, [min, max]: [DVec2; 2]) -> (u32, [[i64; 2]; 2]) {
        let index = |p: DVec2| Axis::BOTH.map(|axis| whole(axis.of(p) * self.blocks.count(axis)));
        let (mut low, mut high) = (index(min), index(max));
        let mut level = 0;
        while (0..2).any(|i| high[i] - low[i] > 1) {
            (low, high) = (low.map(|i| i >> 1), high.map(|i| i >> 1));
            level += 1;
        }
        (level, [low, high])
    }

    /// Adds `part`, the intersection of the polygon with a block.
    fn block(&mut self, block: Block, finest: u32, part: &UvPolygon) {
        if part.is_empty() {
            return;
        }
        let Block { level, index } = block;
        let mean = self.blocks.mean(block, self.shown.wrap);
        if let (Some(mean), Some([_, behind])) = (mean, self.places) {
            let is_coarse = level > 0 && level <= finest;
            if is_coarse || mean.x == 0.0 || mean.x == 1.0 {
                return self.add_behind(mean.x, &behind.of(part));
            }
        } else if let Some(mean) = mean {
            let side = |axis: Axis| {
                let edge = |i| self.edge(axis, level, index[axis as usize] + i);
                // The last block may extend beyond the image.
                let [low, high] = [edge(0), edge(1)];
                if self.ends(axis) {
                    high.min(1.0) - low
                } else {
                    high - low
                }
            };
            let area = side(Axis::X) * side(Axis::Y);
            let is_covered = part.place_area() >= (1.0 - 1e-9) * area;
            if (is_covered && self.is_even(part)) || (level > 0 && level <= finest) {
                let weight = self.weight(part);
                self.sum += mean * weight;
                self.total += weight;
                return;
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
            self.edge(Axis::X, level, x + 1),
            self.edge(Axis::Y, level, y + 1),
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
        let mut image = Integral::new(behind.shown, behind.blocks, self.density);
        image.polygon(*polygon);
        self.sum += image.sum * share;
        self.total += image.total;
    }

    /// Adds a small polygon of uniform density on one image; returns whether it could.
    fn rows(&mut self, polygon: &UvPolygon) -> bool {
        let (Some(image), None) = (self.shown.image, self.shown.mask) else {
            return false;
        };
        if self.density != UvDensity::Even {
            return false;
        }
        let mean = mean_by_rows(image, self.shown.wrap, polygon);
        if let Some(mean) = mean {
            let weight = self.weight(polygon);
            self.sum += mean * weight;
            self.total += weight;
        }
        mean.is_some()
    }

    /// Adds any polygon, piece by piece between the kinks of the colour.
    fn cells(&mut self, polygon: &UvPolygon) {
        let shown = self.shown;
        each_strip(shown, Axis::X, polygon, |x, column| {
            each_strip(shown, Axis::Y, column, |y, piece| {
                self.piece(&shown.cell([x, y]), piece);
            });
        });
    }

    /// Adds a polygon between the bends of what is shown.
    fn piece(&mut self, cell: &ShownCell, piece: &UvPolygon) {
        let (Some(behind), Some([here, there])) = (self.behind, self.places) else {
            return self.product(cell, piece, |_| DVec3::ONE);
        };
        let image = behind.shown;
        each_strip(image, Axis::X, &there.of(piece), |x, column| {
            each_strip(image, Axis::Y, column, |y, part| {
                let color = image.cell([x, y]);
                self.product(cell, &here.of(part), |uv| {
                    let place = there.at(uv);
                    color.at(place.x, place.y)
                });
            });
        });
    }

    /// Adds a polygon between the kinks of the texture, whose colour is multiplied with `color`.
    fn product(&mut self, cell: &ShownCell, piece: &UvPolygon, color: impl Fn(DVec2) -> DVec3) {
        let mut add = |Corner { uv, place }: Corner, area: f64| {
            let weight = area * self.density.at(uv);
            self.sum += cell.at(place.x, place.y) * color(uv) * weight;
            self.total += weight;
        };
        if let Some(level) = cell.level() {
            return each_node(piece, &level, add);
        }
        let is_simple =
            self.behind.is_none() && self.shown.mask.is_none() && self.density == UvDensity::Even;
        let rule: &[_] = if is_simple { &DEGREE_2 } else { &DEGREE_5 };
        for corners in piece.triangles() {
            let area = 0.5 * doubled_area(corners);
            for ([a, b, c], share) in rule {
                let [p, q, r] = corners;
                let at = |of: fn(&Corner) -> DVec2| of(&p) * *a + of(&q) * *b + of(&r) * *c;
                let corner = Corner {
                    uv: at(|corner| corner.uv),
                    place: at(|corner| corner.place),
                };
                add(corner, share * area);
            }
        }
    }

    /// The area of a polygon, by the density.
    fn weight(&self, polygon: &UvPolygon) -> f64 {
        let triangles = polygon.triangles();
        let even = |corners| 0.5 * doubled_area(corners);
        if self.density == UvDensity::Even {
            return triangles.map(even).sum();
        }
        let triangles = triangles.map(|corners| {
            let [p, q, r] = corners.map(|corner| corner.uv);
            let density = DEGREE_5
                .iter()
                .map(|([a, b, c], share)| share * self.density.at(p * *a + q * *b + r * *c));
            even(corners) * density.sum::<f64>()
        });
        triangles.sum()
    }

    /// Whether the density hardly changes over a polygon.
    fn is_even(&self, polygon: &UvPolygon) -> bool {
        let uvs = || polygon.corners().iter().map(|corner| corner.uv);
        let min = uvs().fold(DVec2::INFINITY, DVec2::min);
        let max = uvs().fold(DVec2::NEG_INFINITY, DVec2::max);
        self.density == UvDensity::Even || (max - min).max_element() <= EVEN
    }

    /// The sum of nearby texels: above 0 if a lookup in single precision in the polygon may find
    /// any light.
    fn near(&self, polygon: &UvPolygon) -> DVec3 {
        let [min, max] = polygon.place_bounds();
        let size = Axis::BOTH.map(|axis| f64::from(self.shown.texels(axis)));
        let reach = 1.0 / DVec2::from_array(size) + 1e-6 * (1.0 + min.abs().max(max.abs()));
        let bounds = [min - reach, max + reach];
        let is_beyond = |axis: Axis| {
            let [min, max] = bounds.map(|p| axis.of(p));
            self.shown.wrap[axis as usize] == Wrap::Black
                && (min > 1.0 + axis.of(reach) || max < -axis.of(reach))
        };
        if Axis::BOTH.into_iter().any(is_beyond) {
            return DVec3::ZERO;
        }
        let (level, [low, high]) = self.covering(bounds);
        let mut sum = DVec3::ZERO;
        for y in low[1]..=high[1] {
            for x in low[0]..=high[0] {
                let index = [x, y];
                sum += self.blocks.stored(Block { level, index }, self.shown.wrap);
            }
        }
        sum
    }
}

/// The parts of a polygon between the kinks of the colour along an axis, each with a position
/// inside.
fn each_strip(
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
        (start, rest) = (bend, above);
        if rest.is_empty() {
            return;
        }
    }
}

/// The whole number at or below a position near to the origin.
#[expect(
    clippy::cast_possible_truncation,
    reason = "saturates where there is nothing any more"
)]
fn whole(x: f64) -> i64 {
    floor(x) as i64
}

#[cfg(test)]
mod tests;
