//! Sets made by rules of real places. Sizes, counts and powers are drawn by the seed, so that each
//! seed is another place; every second place is turned by any rotation. Lengths are metres, z is
//! up.

mod halls;
mod lamps;
mod place;
mod rooms;
mod scatter;
mod streets;

use glam::Quat;

use crate::bench_set::BenchSet;
use crate::random::Random;
use place::Place;

/// Makes [`Family`] from a table: what a family is, its name on the command line, and what builds
/// a place of it.
macro_rules! families {
    ($(#[doc = $doc:literal] $family:ident, $name:literal, $build:path;)*) => {
        /// A kind of place.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Family {
            $(#[doc = $doc] $family,)*
        }

        impl Family {
            /// All families, in the order of the table.
            pub const ALL: [Self; [$($name),*].len()] = [$(Self::$family),*];

            /// The family's name on the command line.
            #[must_use]
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$family => $name,)*
                }
            }

            const fn build(self) -> fn(&mut Random, &mut Place) {
                match self {
                    $(Self::$family => $build,)*
                }
            }
        }
    };
}

families! {
    /// Panels in the ceiling of one large room.
    Offices, "offices", rooms::offices;
    /// Panels under the ceilings of many storeys, with receivers on the floors between.
    Storeys, "storeys", rooms::storeys;
    /// Racks with a strip of light under each board.
    Shelves, "shelves", rooms::shelves;
    /// Lights on the risers and under the nosings of stairs.
    Stairs, "stairs", rooms::stairs;
    /// Rows of seats that rise, with lights at the feet of each row.
    Tribune, "tribune", rooms::tribune;
    /// Windows on both facades of a street.
    Canyon, "canyon", streets::canyon;
    /// Small emitters all over one wall, seen from near.
    Facade, "facade", streets::facade;
    /// Head lamps of cars on crossing roads.
    HeadLamps, "head-lamps", streets::head_lamps;
    /// Lamps on walls that shine up and down.
    WallLamps, "wall-lamps", streets::wall_lamps;
    /// Narrow beams from masts, aimed over a field.
    Stadium, "stadium", halls::stadium;
    /// Spots of unlike widths at one height, straight down.
    Downlights, "downlights", halls::downlights;
    /// Narrow spots and a few wide ones at one height, straight down.
    Accents, "accents", halls::accents;
    /// Spots without a rim, of any direction.
    HardSpots, "hard-spots", halls::hard_spots;
    /// Spots with rims of any width.
    SoftSpots, "soft-spots", halls::soft_spots;
    /// Isotropic points in a cube.
    Points, "points", scatter::points;
    /// Tessellated spheres.
    Bulbs, "bulbs", lamps::bulbs;
    /// Tessellated tubes, some two-sided.
    Tubes, "tubes", lamps::tubes;
    /// Leaves that shine to both sides, one in a hundred bright.
    Foliage, "foliage", scatter::foliage;
    /// Ground that shines upward.
    Terrain, "terrain", scatter::terrain;
    /// Clusters of clusters of triangles.
    NestedClusters, "nested-clusters", scatter::nested_clusters;
    /// A few very bright triangles among dim ones.
    FewBright, "few-bright", scatter::few_bright;
    /// Triangles of sizes over three decades.
    Sizes, "sizes", scatter::sizes;
    /// Lights and receivers near one plane.
    Grazing, "grazing", scatter::grazing;
    /// Lamps in one row, along a street or up a slope.
    StreetLamps, "street-lamps", streets::street_lamps;
}

impl Family {
    /// A place of `n` lights.
    pub(crate) fn generate(self, r: &mut Random, n: usize) -> BenchSet {
        let mut place = Place::new(n);
        let rotation = if r.unit() < 0.5 {
            Quat::IDENTITY
        } else {
            let axis = r.direction();
            Quat::from_axis_angle(axis, core::f32::consts::TAU * r.unit())
        };
        self.build()(r, &mut place);
        place.turned(rotation)
    }
}
