//! Places in which most lights are hidden from any one point, made from a seed in the size that is
//! asked for, and an open field as the control.
//!
//! A lamp is a rectangle of two triangles that emit to one side, of one of many radiances over 2.5
//! decades. Lengths are metres, the y axis points up.

mod boxes;
mod camera;
mod lamps;
mod louvres;
mod open;
mod rooms;
mod size;
mod slabs;
mod street;
mod trunks;

use core::fmt;

use super::dice::Dice;
use crate::Scene;

/// A place of a kind, with any number of lamps.
///
/// ```
/// use light_scene::{OcclusionKind, OcclusionScene, OcclusionSize};
///
/// let lamps = 3 * OcclusionSize::Small.lamps();
/// let place = OcclusionScene { kind: OcclusionKind::Rooms, lamps, seed: 7 };
/// assert_eq!(place.load().emissive_triangle_count(), 600);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct OcclusionScene {
    /// What hides the lamps.
    pub kind: OcclusionKind,
    /// How many lamps there are, two emissive triangles each; more lamps also take more space.
    pub lamps: u32,
    /// The choice of all places, sizes and radiances.
    pub seed: u64,
}

/// What hides the lamps of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum OcclusionKind {
    /// Rooms joined by doors. Every fifth is dark, and the camera is in a dark one.
    Rooms,
    /// A house of twenty slabs around an atrium, with lamps in every storey.
    Slabs,
    /// A hall below grilles and slanted slats, with lamps above and behind them.
    Louvres,
    /// Boxes in the air, each open on one side, with a lamp at its bottom.
    Boxes,
    /// Streets of houses by night: windows, lanterns, strings of lamps.
    Street,
    /// Lamps among the trunks of a forest.
    Trunks,
    /// Lamps over an open field: nothing hides them but their own backs.
    Open,
}

/// How many lamps a scene that ships has.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum OcclusionSize {
    /// A hundred lamps.
    Small,
    /// Fifty thousand lamps, a hundred thousand lights.
    Large,
}

impl OcclusionKind {
    /// All kinds.
    pub const ALL: [Self; 7] = [
        Self::Rooms,
        Self::Slabs,
        Self::Louvres,
        Self::Boxes,
        Self::Street,
        Self::Trunks,
        Self::Open,
    ];

    /// The names on the command line, of the small scene and of the large one.
    pub(super) const fn names(self) -> [&'static str; 2] {
        match self {
            Self::Rooms => ["rooms", "rooms-large"],
            Self::Slabs => ["slabs", "slabs-large"],
            Self::Louvres => ["louvres", "louvres-large"],
            Self::Boxes => ["boxes", "boxes-large"],
            Self::Street => ["street", "street-large"],
            Self::Trunks => ["trunks", "trunks-large"],
            Self::Open => ["open", "open-large"],
        }
    }
}

impl fmt::Display for OcclusionKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.names()[0])
    }
}

impl OcclusionSize {
    /// Both sizes.
    pub(super) const ALL: [Self; 2] = [Self::Small, Self::Large];

    /// The number of lamps.
    #[must_use]
    pub const fn lamps(self) -> u32 {
        match self {
            Self::Small => 100,
            Self::Large => 50_000,
        }
    }
}

impl OcclusionScene {
    /// Makes the scene; the same one each time.
    #[must_use]
    pub fn load(self) -> Scene {
        let lamps = self.lamps as usize;
        let mut dice = Dice::new(self.seed);
        match self.kind {
            OcclusionKind::Rooms => rooms::rooms(lamps, &mut dice),
            OcclusionKind::Slabs => slabs::slabs(lamps, &mut dice),
            OcclusionKind::Louvres => louvres::louvres(lamps, &mut dice),
            OcclusionKind::Boxes => boxes::boxes(lamps, &mut dice),
            OcclusionKind::Street => street::street(lamps, &mut dice),
            OcclusionKind::Trunks => trunks::trunks(lamps, &mut dice),
            OcclusionKind::Open => open::open(lamps, &mut dice),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn load(kind: OcclusionKind, lamps: u32, seed: u64) -> Scene {
        OcclusionScene { kind, lamps, seed }.load()
    }

    #[test]
    fn every_kind_has_the_requested_lamps() {
        for kind in OcclusionKind::ALL {
            for lamps in [1, 2, 37, 100, 1009, 50_000] {
                let triangles = load(kind, lamps, 1).emissive_triangle_count();
                assert_eq!(triangles, 2 * lamps as usize, "{kind} of {lamps}");
            }
        }
    }

    #[test]
    fn the_same_seed_makes_the_same_scene() {
        for kind in OcclusionKind::ALL {
            let scene = load(kind, 300, 1);
            let again = load(kind, 300, 1);
            assert_eq!(scene.meshes, again.meshes, "{kind}: meshes");
            assert_eq!(scene.materials, again.materials, "{kind}: materials");
            assert_eq!(scene.camera, again.camera, "{kind}: camera");
            let other = load(kind, 300, 2);
            assert_ne!(scene.meshes, other.meshes, "{kind}: another seed");
        }
    }

    #[test]
    fn radiances_span_two_and_a_half_decades() {
        let scene = load(OcclusionKind::Open, 300, 1);
        let lamps = scene.meshes.iter().map(|mesh| mesh.material);
        let radiances = lamps.filter_map(|id| scene.material(id).emission.as_ref());
        let green = radiances.map(|emission| scene.mean(&emission.radiance).y);
        let (low, high) = green.fold((f32::MAX, 0.0f32), |(low, high), x| {
            (low.min(x), high.max(x))
        });
        let decades = (high / low).log10();
        assert!((decades - 2.5).abs() < 0.1, "{decades} decades");
    }
}
