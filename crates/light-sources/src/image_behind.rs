use crate::bilinear_cells::Shown;
use crate::block_means::BlockMeans;
use crate::glam::DVec2;
use crate::texture_mapping::TextureMapping;
use crate::uv_polygon::{Corner, UvPolygon};

/// The image of a surface of which the mask has a mapping of its own.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ImageBehind<'a> {
    pub(crate) shown: &'a Shown<'a>,
    pub(crate) blocks: &'a BlockMeans,
    pub(crate) mapping: &'a TextureMapping,
}

/// Where the surface parameters of one polygon lie in an image.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Places {
    x: DVec2,
    y: DVec2,
    origin: DVec2,
}

impl Places {
    /// Those of three corners, of which the surface parameters lie on no line.
    pub(crate) fn new([a, b, c]: [Corner; 3]) -> Self {
        let (ab, ac) = (b.uv - a.uv, c.uv - a.uv);
        let inv = 1.0 / ab.perp_dot(ac);
        let (db, dc) = (b.place - a.place, c.place - a.place);
        let x = (db * ac.y - dc * ab.y) * inv;
        let y = (dc * ab.x - db * ac.x) * inv;
        Self {
            x,
            y,
            origin: a.place - x * a.uv.x - y * a.uv.y,
        }
    }

    pub(crate) fn at(&self, uv: DVec2) -> DVec2 {
        self.origin + self.x * uv.x + self.y * uv.y
    }

    /// The same part of the surface, in this image.
    pub(crate) fn of(&self, polygon: &UvPolygon) -> UvPolygon {
        polygon.with_places(|uv| self.at(uv))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_those_of_the_corners() {
        let corners = [
            ([0.5, 0.25], [3.0, -1.0]),
            ([1.0, 0.25], [3.0, 4.0]),
            ([0.75, 0.5], [-2.0, 0.5]),
        ];
        let corners = corners.map(|(uv, place)| Corner {
            uv: uv.into(),
            place: place.into(),
        });
        let places = Places::new(corners);
        for corner in corners {
            assert_eq!(places.at(corner.uv), corner.place, "{corner:?}");
        }
        let middle = places.at(DVec2::new(0.75, 0.25));
        assert_eq!(middle, DVec2::new(3.0, 1.5), "between two corners");
    }
}
