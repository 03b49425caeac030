use crate::floor::floor;
use crate::glam::{DVec2, DVec3, Vec3};
use crate::image::Image;
use crate::level_quadrature::{Level, each_node};
use crate::mask_share::MaskShare;
use crate::texture_mapping::Wrap;
use crate::uv_polygon::{Axis, Corner, UvPolygon};

/// One axis of an image between two centres of texels, where its colour is linear: two texels, and
/// the interpolation weight as a function of position.
#[derive(Clone, Copy, Debug)]
struct Span {
    texels: [Option<u32>; 2],
    /// At the place 0.
    start: f64,
    /// Per place.
    slope: f64,
}

/// A bilinear cell of an image: between four centres of texels.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cell {
    x: Span,
    y: Span,
    colors: [[DVec3; 2]; 2],
}

impl Cell {
    /// The cell that contains the position `middle`, not on its edge.
    pub(crate) fn new(image: &Image, wrap: [Wrap; 2], middle: [f64; 2]) -> Self {
        let x = Span::new(wrap[0], image.size()[0], middle[0]);
        let y = Span::new(wrap[1], image.size()[1], middle[1]);
        let color = |x: Option<u32>, y: Option<u32>| match (x, y) {
            (Some(x), Some(y)) => image.texel(x, y).as_dvec3(),
            _ => DVec3::ZERO,
        };
        let colors = y.texels.map(|y| x.texels.map(|x| color(x, y)));
        Self { x, y, colors }
    }

    /// The colour at a position in the cell.
    #[inline]
    pub(crate) fn at(&self, x: f64, y: f64) -> DVec3 {
        let x = self.x.start + self.x.slope * x;
        let row = |[a, b]: [DVec3; 2]| a + (b - a) * x;
        let [top, bottom] = self.colors.map(row);
        let y = self.y.start + self.y.slope * y;
        // Rounding must neither turn light into black nor black into light.
        (top + (bottom - top) * y).max(DVec3::ZERO)
    }
}

impl Span {
    fn new(wrap: Wrap, n: u32, middle: f64) -> Self {
        let count = f64::from(n);
        let (origin, slope) = match wrap {
            Wrap::Clamp | Wrap::Black => (0.0, count),
            Wrap::Repeat => (floor(middle), count),
            Wrap::Mirror => {
                let turn = 2.0 * floor(0.5 * middle);
                if middle - turn <= 1.0 {
                    (turn, count)
                } else {
                    (turn + 2.0, -count)
                }
            }
        };
        let t = (middle - origin) * slope - 0.5;
        let first = match wrap {
            Wrap::Clamp => floor(t).clamp(-1.0, count - 1.0),
            _ => floor(t),
        };
        Self {
            texels: [first, first + 1.0].map(|i| wrap.texel(i, n)),
            start: -origin * slope - 0.5 - first,
            slope,
        }
    }
}

/// The first position after `from` where the colour of an image with `n` texels may have a kink:
/// the centre of a texel.
pub(crate) fn next_bend(wrap: Wrap, n: u32, from: f64) -> f64 {
    let count = f64::from(n);
    let (least, most) = match wrap {
        Wrap::Clamp => (0.0, count - 1.0),
        Wrap::Black => (-1.0, count),
        Wrap::Repeat | Wrap::Mirror => (f64::MIN, f64::MAX),
    };
    let mut k = floor(from * count + 0.5).max(least);
    while k <= most {
        let bend = (k + 0.5) / count;
        if bend > from {
            return bend;
        }
        k += 1.0;
    }
    f64::INFINITY
}

/// The texture on a surface: an image, the opacity of a mask, or the product of both if they have
/// the same mapping.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shown<'a> {
    /// White where there is none.
    pub(crate) image: Option<&'a Image>,
    pub(crate) mask: Option<(&'a Image, MaskShare)>,
    pub(crate) wrap: [Wrap; 2],
}

/// [`Shown`] between neighbouring kinks of all images: a polynomial, unless the opacity of the mask
/// has a kink.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ShownCell {
    image: Option<Cell>,
    mask: Option<(Cell, MaskShare)>,
}

impl<'a> Shown<'a> {
    pub(crate) fn cell(&self, middle: [f64; 2]) -> ShownCell {
        let cell = |image: &Image| Cell::new(image, self.wrap, middle);
        ShownCell {
            image: self.image.map(cell),
            mask: self.mask.map(|(image, share)| (cell(image), share)),
        }
    }

    pub(crate) fn next_bend(&self, axis: Axis, from: f64) -> f64 {
        let axis = axis as usize;
        let bends = self
            .images()
            .map(|image| next_bend(self.wrap[axis], image.size()[axis], from));
        bends.fold(f64::INFINITY, f64::min)
    }

    /// Texels along an axis, of the image that has more of them.
    pub(crate) fn texels(&self, axis: Axis) -> u32 {
        let counts = self.images().map(|image| image.size()[axis as usize]);
        counts.fold(1, u32::max)
    }

    fn images(&self) -> impl Iterator<Item = &'a Image> + use<'a> {
        let mask = self.mask.map(|(image, _)| image);
        self.image.into_iter().chain(mask)
    }

    /// The integral over the rectangle between two positions.
    pub(crate) fn over_rectangle(&self, low: [f64; 2], high: [f64; 2]) -> DVec3 {
        let mut sum = DVec3::ZERO;
        self.each_span(Axis::Y, low[1], high[1], |y0, y1| {
            self.each_span(Axis::X, low[0], high[0], |x0, x1| {
                let cell = self.cell([0.5 * (x0 + x1), 0.5 * (y0 + y1)]);
                sum += cell.mean([x0, y0], [x1, y1]) * ((x1 - x0) * (y1 - y0));
            });
        });
        sum
    }

    /// The parts of an axis between kinks.
    pub(crate) fn each_span(&self, axis: Axis, from: f64, to: f64, mut each: impl FnMut(f64, f64)) {
        let mut start = from;
        while start < to {
            let end = self.next_bend(axis, start).min(to);
            each(start, end);
            start = end;
        }
    }
}

impl ShownCell {
    #[inline]
    pub(crate) fn at(&self, x: f64, y: f64) -> DVec3 {
        let color = self.image.map_or(DVec3::ONE, |image| image.at(x, y));
        let share = |(mask, share): (Cell, MaskShare)| share.of(mask.at(x, y).x);
        self.mask.map_or(color, |mask| color * share(mask))
    }

    /// Where the share of the mask bends, if it does so in this cell.
    pub(crate) fn level(&self) -> Option<Level> {
        let (mask, share) = self.mask.as_ref()?;
        let values = mask.colors.map(|row| row.map(|color| color.x));
        let [least, most] = [f64::min, f64::max].map(|of| {
            let values = values.as_flattened().iter().copied();
            values.reduce(of).unwrap_or_default()
        });
        let bend = share.bend(least, most)?;
        Some(Level {
            start: DVec2::new(mask.x.start, mask.y.start),
            slope: DVec2::new(mask.x.slope, mask.y.slope),
            corners: values.map(|row| row.map(|value| value - bend)),
        })
    }

    /// The mean over a rectangle: exact, as the product of two lines is of degree 2 along each
    /// axis.
    pub(crate) fn mean(&self, low: [f64; 2], high: [f64; 2]) -> DVec3 {
        /// The nodes of Gauss and Legendre, from the middle, in half sizes.
        const NODE: f64 = 0.577_350_269_189_625_8;
        if let Some(level) = self.level() {
            return self.mean_beside(&level, low.into(), high.into());
        }
        let [x, y] = [0, 1].map(|i| 0.5 * (low[i] + high[i]));
        if self.image.is_none() || self.mask.is_none() {
            return self.at(x, y);
        }
        let [dx, dy] = [0, 1].map(|i| 0.5 * NODE * (high[i] - low[i]));
        let sum = self.at(x - dx, y - dy)
            + self.at(x + dx, y - dy)
            + self.at(x - dx, y + dy)
            + self.at(x + dx, y + dy);
        0.25 * sum
    }

    fn mean_beside(&self, level: &Level, low: DVec2, high: DVec2) -> DVec3 {
        let corners = [
            low,
            DVec2::new(high.x, low.y),
            high,
            DVec2::new(low.x, high.y),
        ];
        let rectangle = UvPolygon::new(&corners.map(|place| Corner { uv: place, place }));
        let (mut sum, mut total) = (DVec3::ZERO, 0.0);
        each_node(&rectangle, level, |Corner { place, .. }, weight| {
            sum += self.at(place.x, place.y) * weight;
            total += weight;
        });
        if total > 0.0 {
            sum / total
        } else {
            DVec3::ZERO
        }
    }
}

/// The nearest single-precision colour.
pub(crate) fn single(color: DVec3) -> Vec3 {
    color.as_vec3()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::channels::Channels;

    /// Between neighbouring floats there is no line across.
    #[test]
    fn a_rectangle_of_one_rounding_has_no_mean_beside_a_level() {
        let mask = Image::from_f32([2, 2], Channels::Gray, [0.0, 1.0, 0.0, 1.0]).expect("an image");
        let shown = Shown {
            image: None,
            mask: Some((&mask, MaskShare::Cutoff(0.5))),
            wrap: [Wrap::Clamp; 2],
        };
        let cell = shown.cell([0.5, 0.5]);
        let low = 0.625;
        for (high, expected) in [(0.75, 1.0), (low + f64::EPSILON / 2.0, 0.0)] {
            assert!(low < high, "not empty");
            let mean = cell.mean([low; 2], [high; 2]);
            assert_eq!(mean, DVec3::splat(expected), "up to {high}");
        }
    }
}
