use crate::glam::DVec2;

/// A corner of a [`UvPolygon`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Corner {
    /// Surface parameters.
    pub(crate) uv: DVec2,
    /// Image coordinates.
    pub(crate) place: DVec2,
}

/// A convex part of a surface: its area is that of the surface parameters, its cuts are lines of
/// the image.
///
/// A part that the mapping shrinks to a line or a point of the image keeps its area on the surface.
#[derive(Clone, Copy, Debug)]
pub(crate) struct UvPolygon {
    corners: [Corner; Self::MOST],
    count: usize,
}

/// An axis of the image.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Axis {
    X,
    Y,
}

impl Axis {
    pub(crate) const BOTH: [Self; 2] = [Self::X, Self::Y];

    pub(crate) const fn of(self, p: DVec2) -> f64 {
        match self {
            Self::X => p.x,
            Self::Y => p.y,
        }
    }
}

impl UvPolygon {
    /// A parallelogram that is cut by two lines along each axis of two images has twelve corners;
    /// rounding adds few.
    pub(crate) const MOST: usize = 16;

    pub(crate) fn new(corners: &[Corner]) -> Self {
        let mut polygon = Self::empty();
        corners.iter().for_each(|&corner| polygon.push(corner));
        polygon
    }

    const fn empty() -> Self {
        let nowhere = Corner {
            uv: DVec2::ZERO,
            place: DVec2::ZERO,
        };
        Self {
            corners: [nowhere; Self::MOST],
            count: 0,
        }
    }

    fn push(&mut self, corner: Corner) {
        debug_assert!(
            self.count < Self::MOST,
            "a convex polygon, cut by rectangles"
        );
        if let Some(place) = self.corners.get_mut(self.count) {
            *place = corner;
            self.count += 1;
        }
    }

    pub(crate) fn corners(&self) -> &[Corner] {
        &self.corners[..self.count]
    }

    /// The same surface with other image coordinates.
    pub(crate) fn with_places(mut self, place: impl Fn(DVec2) -> DVec2) -> Self {
        for corner in &mut self.corners[..self.count] {
            corner.place = place(corner.uv);
        }
        self
    }

    /// Whether it has no corners.
    pub(crate) const fn is_empty(&self) -> bool {
        self.count < 3
    }

    /// The triangles around the first corner.
    pub(crate) fn triangles(&self) -> impl Iterator<Item = [Corner; 3]> + '_ {
        let corners = self.corners();
        corners
            .windows(2)
            .skip(1)
            .map(|pair| [corners[0], pair[0], pair[1]])
    }

    /// Lower and upper corner of its bounds in the image.
    pub(crate) fn place_bounds(&self) -> [DVec2; 2] {
        let places = self.corners().iter().map(|corner| corner.place);
        places.fold([DVec2::INFINITY, DVec2::NEG_INFINITY], |[min, max], p| {
            [min.min(p), max.max(p)]
        })
    }

    /// Its area in the image.
    pub(crate) fn place_area(&self) -> f64 {
        let doubled = |[a, b, c]: [Corner; 3]| (b.place - a.place).perp_dot(c.place - a.place);
        0.5 * self.triangles().map(doubled).sum::<f64>().abs()
    }

    /// The part below the line where `axis` has the value `at`, and the part above.
    pub(crate) fn split(&self, axis: Axis, at: f64) -> [Self; 2] {
        let height = |corner: &Corner| axis.of(corner.place) - at;
        let (mut below, mut above) = (Self::empty(), Self::empty());
        let Some(mut last) = self.corners().last() else {
            return [below, above];
        };
        for corner in self.corners() {
            let (from, to) = (height(last), height(corner));
            if (from < 0.0 && to > 0.0) || (from > 0.0 && to < 0.0) {
                let part = from / (from - to);
                let between = Corner {
                    uv: last.uv.lerp(corner.uv, part),
                    place: last.place.lerp(corner.place, part),
                };
                below.push(between);
                above.push(between);
            }
            if to <= 0.0 {
                below.push(*corner);
            }
            if to >= 0.0 {
                above.push(*corner);
            }
            last = corner;
        }
        // A polygon on the line belongs to one side.
        if self.corners().iter().all(|corner| height(corner) == 0.0) {
            above = Self::empty();
        }
        [below, above]
    }
}

/// Twice the area of a triangle of surface parameters.
pub(crate) fn doubled_area([a, b, c]: [Corner; 3]) -> f64 {
    (b.uv - a.uv).perp_dot(c.uv - a.uv).abs()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn polygon(corners: &[[f64; 4]]) -> UvPolygon {
        let corners = corners.iter().map(|&[u, v, x, y]| Corner {
            uv: DVec2::new(u, v),
            place: DVec2::new(x, y),
        });
        UvPolygon::new(&corners.collect::<alloc::vec::Vec<_>>())
    }

    fn area(polygon: &UvPolygon) -> f64 {
        0.5 * polygon.triangles().map(doubled_area).sum::<f64>()
    }

    #[test]
    fn both_parts_of_a_split_are_the_whole() {
        let square = polygon(&[
            [0.0, 0.0, 0.0, 0.0],
            [1.0, 0.0, 2.0, 0.0],
            [1.0, 1.0, 2.0, 4.0],
            [0.0, 1.0, 0.0, 4.0],
        ]);
        assert_eq!((area(&square), square.place_area()), (1.0, 8.0), "areas");
        let [left, right] = square.split(Axis::X, 0.5);
        assert_eq!((area(&left), area(&right)), (0.25, 0.75), "along x");
        let [low, high] = right.split(Axis::Y, 1.0);
        assert_eq!((area(&low), area(&high)), (0.1875, 0.5625), "along y");
        assert_eq!(
            high.place_bounds(),
            [DVec2::new(0.5, 1.0), DVec2::new(2.0, 4.0)],
            "the upper right"
        );
        let [none, all] = square.split(Axis::X, 0.0);
        assert!(none.is_empty() && area(&all) == 1.0, "at the edge");
    }

    #[test]
    fn a_point_of_the_image_keeps_its_surface() {
        let point = polygon(&[
            [0.0, 0.0, 0.5, 0.5],
            [1.0, 0.0, 0.5, 0.5],
            [0.0, 1.0, 0.5, 0.5],
        ]);
        let parts = point.split(Axis::X, 0.5);
        let areas = parts.map(|part| area(&part));
        assert_eq!(areas[0] + areas[1], 0.5, "on one side of the line alone");
    }
}
