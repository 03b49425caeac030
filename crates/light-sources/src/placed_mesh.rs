use alloc::vec::Vec;
use core::error::Error;
use core::fmt;

use crate::area::DiffuseAreaLight;
use crate::color::ColorModel;
use crate::glam::{Affine3A, Vec3};
use crate::mesh::{MeshLight, MeshLightError};
use crate::shape::Triangle;
use light_math::Aabb;

/// Identifies an emissive mesh that a set stores once and places any number of times, by the order
/// of adding.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct MeshPrototypeId(pub u32);

/// Why a set does not place a mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum PlacedMeshError {
    /// The set has no such prototype.
    UnknownPrototype,
    /// The source is not a placed mesh.
    OtherSource,
    /// The transform is not finite, or moves a vertex out of the range of `f32`.
    Transform,
    /// The transform makes a mesh that is no light, such as one of infinite power.
    Mesh(MeshLightError),
    /// With this source the set would have more lights than 32 bits can count.
    TooMany,
}

/// How many lights of a set are placed, and how few of them are stored.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PlacedMeshCounts {
    /// The meshes that are stored once.
    pub prototypes: usize,
    /// Their triangles, each stored once.
    pub stored_lights: usize,
    /// The places of all of them, each a source.
    pub placements: usize,
    /// The lights of all places.
    pub lights: usize,
}

/// Emissive meshes in coordinates of their own, and where they are placed. 80 bytes a placement.
#[derive(Clone, Debug)]
pub(crate) struct PlacedMeshes<C: ColorModel> {
    prototypes: Vec<MeshPrototype<C>>,
    placements: Vec<MeshPlacement>,
}

#[derive(Clone, Debug)]
struct MeshPrototype<C: ColorModel> {
    mesh: MeshLight<C>,
    bounds: Aabb,
    largest_area: f32,
}

#[derive(Clone, Copy, Debug)]
struct MeshPlacement {
    to_scene: Affine3A,
    prototype: u32,
    side: Side,
}

/// Whether a transform turns counter-clockwise triangles into clockwise ones.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Side {
    Kept,
    Mirrored,
}

impl<C: ColorModel> PlacedMeshes<C> {
    pub(crate) const EMPTY: Self = Self {
        prototypes: Vec::new(),
        placements: Vec::new(),
    };

    /// Adds a mesh without a place; `None` where 32 bits do not suffice for its id.
    pub(crate) fn add_prototype(&mut self, mesh: MeshLight<C>) -> Option<MeshPrototypeId> {
        let id = u32::try_from(self.prototypes.len()).ok()?;
        let (bounds, largest_area) = (mesh.bounds(), mesh.largest_area());
        self.prototypes.push(MeshPrototype {
            mesh,
            bounds,
            largest_area,
        });
        Some(MeshPrototypeId(id))
    }

    /// The number of triangles of a prototype, once `to_scene` has been checked for it.
    pub(crate) fn checked_len(
        &self,
        prototype: MeshPrototypeId,
        to_scene: &Affine3A,
    ) -> Result<usize, PlacedMeshError> {
        let found = self.prototypes.get(prototype.0 as usize);
        let MeshPrototype {
            mesh,
            bounds,
            largest_area,
        } = found.ok_or(PlacedMeshError::UnknownPrototype)?;
        // Every vertex lies between the corners of the box, and so does its image.
        let is_near = |corner| to_scene.transform_point3(corner).is_finite();
        let are_near = bounds.is_empty() || corners(bounds).into_iter().all(is_near);
        if !(to_scene.is_finite() && are_near) {
            return Err(PlacedMeshError::Transform);
        }
        // At least the product of the two largest stretches.
        let m = to_scene.matrix3;
        let stretches = [m.x_axis, m.y_axis, m.z_axis].map(|axis| axis.length_squared());
        let growth = stretches.into_iter().sum();
        let place = |corner| to_scene.transform_point3(corner);
        let check = mesh.check_placed(*largest_area, growth, place);
        check.map_err(PlacedMeshError::Mesh)?;
        Ok(mesh.len())
    }

    /// The number that the next placement gets.
    pub(crate) fn next(&self) -> Option<u32> {
        u32::try_from(self.placements.len()).ok()
    }

    /// Adds a placement with a transform that has been checked.
    pub(crate) fn place(&mut self, prototype: MeshPrototypeId, to_scene: &Affine3A) {
        self.placements
            .push(MeshPlacement::new(prototype, to_scene));
    }

    /// Moves a placement of a set, to where its mesh stays finite.
    pub(crate) fn replace(
        &mut self,
        placement: u32,
        to_scene: &Affine3A,
    ) -> Result<(), PlacedMeshError> {
        let at = placement as usize;
        let prototype = MeshPrototypeId(self.placements[at].prototype);
        self.checked_len(prototype, to_scene)?;
        self.placements[at] = MeshPlacement::new(prototype, to_scene);
        Ok(())
    }

    /// A triangle of a placement in scene space.
    #[inline]
    pub(crate) fn triangle(
        &self,
        placement: u32,
        number: u32,
    ) -> Option<DiffuseAreaLight<'_, C, Triangle>> {
        let placed = self.placements.get(placement as usize)?;
        let MeshPrototype { mesh, .. } = self.prototypes.get(placed.prototype as usize)?;
        let place = |corner| placed.to_scene.transform_point3(corner);
        mesh.triangle_by(number as usize, |vertices| placed.oriented(vertices), place)
    }

    /// The corners of a triangle of a placement as the prototype stores them.
    #[inline]
    pub(crate) fn stored_corners(&self, placement: u32, number: u32) -> Option<&[Vec3; 3]> {
        let placed = self.placements.get(placement as usize)?;
        let MeshPrototype { mesh, .. } = self.prototypes.get(placed.prototype as usize)?;
        mesh.corners(number as usize)
    }

    /// The prototype and the transform of a placement.
    pub(crate) fn placement(&self, placement: u32) -> Option<(MeshPrototypeId, &Affine3A)> {
        let placed = self.placements.get(placement as usize)?;
        Some((MeshPrototypeId(placed.prototype), &placed.to_scene))
    }

    /// A prototype.
    pub(crate) fn prototype(&self, prototype: MeshPrototypeId) -> Option<&MeshLight<C>> {
        let found = self.prototypes.get(prototype.0 as usize);
        found.map(|prototype| &prototype.mesh)
    }

    pub(crate) fn counts(&self) -> PlacedMeshCounts {
        let len = |prototype: u32| self.prototypes[prototype as usize].mesh.len();
        let placements = self.placements.iter();
        PlacedMeshCounts {
            prototypes: self.prototypes.len(),
            stored_lights: self.meshes().map(MeshLight::len).sum(),
            placements: self.placements.len(),
            lights: placements.map(|placed| len(placed.prototype)).sum(),
        }
    }

    /// The prototypes.
    pub(crate) fn meshes(&self) -> impl Iterator<Item = &MeshLight<C>> {
        self.prototypes.iter().map(|prototype| &prototype.mesh)
    }

    /// Bytes of the lists themselves.
    pub(crate) fn bytes(&self) -> usize {
        size_of_val(&*self.prototypes) + size_of_val(&*self.placements)
    }
}

impl MeshPlacement {
    fn new(prototype: MeshPrototypeId, to_scene: &Affine3A) -> Self {
        let is_mirrored = to_scene.matrix3.determinant() < 0.0;
        Self {
            to_scene: *to_scene,
            prototype: prototype.0,
            side: if is_mirrored {
                Side::Mirrored
            } else {
                Side::Kept
            },
        }
    }

    /// The vertices of a triangle, so that its front stays its front.
    #[inline]
    const fn oriented(&self, [a, b, c]: [u32; 3]) -> [u32; 3] {
        match self.side {
            Side::Kept => [a, b, c],
            Side::Mirrored => [a, c, b],
        }
    }
}

/// The corners of a box.
fn corners(bounds: &Aabb) -> [Vec3; 8] {
    let [low, high] = [bounds.min, bounds.max];
    let corner = |x: f32, y: f32| [Vec3::new(x, y, low.z), Vec3::new(x, y, high.z)];
    let [[a, b], [c, d]] = [corner(low.x, low.y), corner(low.x, high.y)];
    let [[e, f], [g, h]] = [corner(high.x, low.y), corner(high.x, high.y)];
    [a, b, c, d, e, f, g, h]
}

impl fmt::Display for PlacedMeshError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::UnknownPrototype => f.write_str("the set has no such prototype"),
            Self::OtherSource => f.write_str("the source is not a placed mesh"),
            Self::Transform => f.write_str("the transform does not keep all vertices finite"),
            Self::Mesh(error) => error.fmt(f),
            Self::TooMany => f.write_str("too many lights: ids have 32 bits"),
        }
    }
}

impl Error for PlacedMeshError {}
