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

/// A kind of place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// Panels in the ceiling of one large room.
    Offices,
    /// Panels under the ceilings of many storeys, with receivers on the floors between.
    Storeys,
    /// Racks with a strip of light under each board.
    Shelves,
    /// Lights on the risers and under the nosings of stairs.
    Stairs,
    /// Rows of seats that rise, with lights at the feet of each row.
    Tribune,
    /// Windows on both facades of a street.
    Canyon,
    /// Small emitters all over one wall, seen from near.
    Facade,
    /// Head lamps of cars on crossing roads.
    HeadLamps,
    /// Lamps on walls that shine up and down.
    WallLamps,
    /// Narrow beams from masts, aimed over a field.
    Stadium,
    /// Spots of unlike widths at one height, straight down.
    Downlights,
    /// Narrow spots and a few wide ones at one height, straight down.
    Accents,
    /// Spots without a rim, of any direction.
    HardSpots,
    /// Spots with rims of any width.
    SoftSpots,
    /// Isotropic points in a cube.
    Points,
    /// Tessellated spheres.
    Bulbs,
    /// Tessellated tubes, some two-sided.
    Tubes,
    /// Leaves that shine to both sides, one in a hundred bright.
    Foliage,
    /// Ground that shines upward.
    Terrain,
    /// Clusters of clusters of triangles.
    NestedClusters,
    /// A few very bright triangles among dim ones.
    FewBright,
    /// Triangles of sizes over three decades.
    Sizes,
    /// Lights and receivers near one plane.
    Grazing,
}

impl Family {
    /// All families, in the order of the table.
    pub const ALL: [Self; 23] = [
        Self::Offices,
        Self::Storeys,
        Self::Shelves,
        Self::Stairs,
        Self::Tribune,
        Self::Canyon,
        Self::Facade,
        Self::HeadLamps,
        Self::WallLamps,
        Self::Stadium,
        Self::Downlights,
        Self::Accents,
        Self::HardSpots,
        Self::SoftSpots,
        Self::Points,
        Self::Bulbs,
        Self::Tubes,
        Self::Foliage,
        Self::Terrain,
        Self::NestedClusters,
        Self::FewBright,
        Self::Sizes,
        Self::Grazing,
    ];

    /// The family's name on the command line.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Offices => "offices",
            Self::Storeys => "storeys",
            Self::Shelves => "shelves",
            Self::Stairs => "stairs",
            Self::Tribune => "tribune",
            Self::Canyon => "canyon",
            Self::Facade => "facade",
            Self::HeadLamps => "head-lamps",
            Self::WallLamps => "wall-lamps",
            Self::Stadium => "stadium",
            Self::Downlights => "downlights",
            Self::Accents => "accents",
            Self::HardSpots => "hard-spots",
            Self::SoftSpots => "soft-spots",
            Self::Points => "points",
            Self::Bulbs => "bulbs",
            Self::Tubes => "tubes",
            Self::Foliage => "foliage",
            Self::Terrain => "terrain",
            Self::NestedClusters => "nested-clusters",
            Self::FewBright => "few-bright",
            Self::Sizes => "sizes",
            Self::Grazing => "grazing",
        }
    }

    /// A place of `n` lights.
    pub(super) fn generate(self, r: &mut Random, n: usize) -> BenchSet {
        let mut place = Place::new(n);
        let rotation = if r.unit() < 0.5 {
            Quat::IDENTITY
        } else {
            let axis = r.direction();
            Quat::from_axis_angle(axis, core::f32::consts::TAU * r.unit())
        };
        let build = match self {
            Self::Offices => rooms::offices,
            Self::Storeys => rooms::storeys,
            Self::Shelves => rooms::shelves,
            Self::Stairs => rooms::stairs,
            Self::Tribune => rooms::tribune,
            Self::Canyon => streets::canyon,
            Self::Facade => streets::facade,
            Self::HeadLamps => streets::head_lamps,
            Self::WallLamps => streets::wall_lamps,
            Self::Stadium => halls::stadium,
            Self::Downlights => halls::downlights,
            Self::Accents => halls::accents,
            Self::HardSpots => halls::hard_spots,
            Self::SoftSpots => halls::soft_spots,
            Self::Points => scatter::points,
            Self::Bulbs => lamps::bulbs,
            Self::Tubes => lamps::tubes,
            Self::Foliage => scatter::foliage,
            Self::Terrain => scatter::terrain,
            Self::NestedClusters => scatter::nested_clusters,
            Self::FewBright => scatter::few_bright,
            Self::Sizes => scatter::sizes,
            Self::Grazing => scatter::grazing,
        };
        build(r, &mut place);
        place.turned(rotation)
    }
}
