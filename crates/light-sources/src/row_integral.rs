use crate::floor::floor;
use crate::glam::{DVec2, DVec3};
use crate::image::Image;
use crate::texture_mapping::Wrap;
use crate::uv_polygon::UvPolygon;

/// The most texels of a polygon along each axis.
const SIDE: usize = 32;

/// The least area of a polygon relative to its bounds, which count as no smaller than a texel:
/// rounding errors scale with them.
const FILLED: f64 = 1e-7;

/// The mean of an image over a polygon, exact.
///
/// By Green's theorem it is an integral along the edges of the integrals along the rows of the
/// image, so that only texels on edges are clipped. `None` for polygons larger than [`SIDE`] or
/// almost without area.
pub(crate) fn mean_by_rows(image: &Image, wrap: [Wrap; 2], polygon: &UvPolygon) -> Option<DVec3> {
    // Texels have their centres at whole numbers.
    let size = DVec2::from_array(image.size().map(f64::from));
    let [min, max] = polygon.place_bounds().map(|place| place * size - 0.5);
    let origin = DVec2::new(floor(min.x), floor(min.y));
    let extent = max - origin;
    let bounds = extent.max(DVec2::ONE);
    let least = FILLED * bounds.x * bounds.y;
    let is_small = extent.max_element() <= SIDE as f64;
    if !(is_small && polygon.place_area() * size.x * size.y > least) {
        return None;
    }
    let corners = polygon.corners().iter();
    let points = || {
        let relative = |place: DVec2| place * size - 0.5 - origin;
        corners.clone().map(move |corner| relative(corner.place))
    };
    let [width, height] = image.size();
    let count = column(extent.x) + 2;
    let mut columns = [None; SIDE + 2];
    for (i, x) in columns[..count].iter_mut().enumerate() {
        *x = wrap[0].texel_anywhere(origin.x + i as f64, width);
    }
    let row = |y: f64| {
        let y = wrap[1].texel_anywhere(origin.y + y, height);
        Row::new(image, &columns[..count], y)
    };
    let (mut sum, mut area) = (DVec3::ZERO, 0.0);
    let (mut y, mut upper) = (0.0, row(0.0));
    while y < extent.y {
        let lower = core::mem::replace(&mut upper, row(y + 1.0));
        let strip = Strip {
            y,
            rows: [&lower, &upper],
        };
        for (from, to) in points().zip(points().cycle().skip(1)) {
            strip.add_edge(from, to, &mut sum, &mut area);
        }
        y += 1.0;
    }
    // Far from the image the places are rounded so much that another area may be left.
    (area.abs() > 0.5 * least).then(|| sum / area)
}

/// The texels of a row and the integrals from the first of them.
struct Row {
    texels: [DVec3; SIDE + 2],
    integrals: [DVec3; SIDE + 2],
}

impl Row {
    /// The integrals over these texels of a row; `None` is black.
    fn new(image: &Image, columns: &[Option<u32>], y: Option<u32>) -> Self {
        let mut row = Self {
            texels: [DVec3::ZERO; SIDE + 2],
            integrals: [DVec3::ZERO; SIDE + 2],
        };
        let Some(y) = y else {
            return row;
        };
        let mut integral = DVec3::ZERO;
        let mut last = None;
        let places = row.texels.iter_mut().zip(&mut row.integrals);
        for (x, (texel, up_to)) in columns.iter().zip(places) {
            *texel = x.map_or(DVec3::ZERO, |x| image.texel(x, y).as_dvec3());
            integral += last.map_or(DVec3::ZERO, |last: DVec3| 0.5 * (last + *texel));
            *up_to = integral;
            last = Some(*texel);
        }
        row
    }

    /// The integral up to a position.
    #[inline]
    fn integral(&self, x: f64) -> DVec3 {
        let i = column(x);
        let (t, a) = (x - i as f64, self.texels[i]);
        self.integrals[i] + (a + (self.texels[i + 1] - a) * (0.5 * t)) * t
    }
}

/// The strip between two rows.
struct Strip<'a> {
    y: f64,
    rows: [&'a Row; 2],
}

impl Strip<'_> {
    /// Adds the part in the strip of the integral along an edge, and of that of the area.
    fn add_edge(&self, from: DVec2, to: DVec2, sum: &mut DVec3, area: &mut f64) {
        /// The nodes of Gauss and Legendre, exact for degree 3: of the integral along rows, times
        /// the place between them.
        const NODES: [f64; 2] = [0.211_324_865_405_187_12, 0.788_675_134_594_812_9];
        let step = to - from;
        if step.y == 0.0 {
            return;
        }
        let at_y = |y: f64| ((y - from.y) / step.y).clamp(0.0, 1.0);
        let [a, b] = [at_y(self.y), at_y(self.y + 1.0)];
        let (mut start, last) = (a.min(b), a.max(b));
        if !(start < last) {
            return;
        }
        let [first_column, last_column] = [start, last].map(|t| floor(from.x + step.x * t));
        let mut bend = if step.x > 0.0 {
            first_column + 1.0
        } else {
            first_column
        };
        loop {
            let is_beyond = if step.x > 0.0 {
                bend > last_column
            } else {
                bend <= last_column
            };
            let end = if is_beyond {
                last
            } else {
                ((bend - from.x) / step.x).clamp(start, last)
            };
            for node in NODES {
                let p = from + step * (start + (end - start) * node);
                let weight = 0.5 * (end - start) * step.y;
                let t = p.y - self.y;
                let [lower, upper] = self.rows.map(|row| row.integral(p.x));
                *sum += (lower + (upper - lower) * t) * weight;
                *area += p.x * weight;
            }
            if is_beyond {
                return;
            }
            start = end;
            bend += step.x.signum();
        }
    }
}

/// The texel at or before a position that is not far outside of the polygon.
#[inline]
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "clamped to what there is"
)]
fn column(x: f64) -> usize {
    (x as usize).min(SIDE)
}
