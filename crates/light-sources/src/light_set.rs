use alloc::vec::Vec;
use core::ops::Range;

use crate::area::DiffuseAreaLight;
use crate::color::ColorModel;
use crate::glam::Vec3;
use crate::light::Light;
use crate::light_kinds::{LightKind, LightLists};
use crate::light_ref::LightRef;
use crate::mesh::MeshLight;
use crate::shape::Triangle;
use light_bounds::{LightExtent, LightId};

/// The last kind that is not at infinity.
const LAST_BOUNDED: LightKind = LightKind::Triangle;

/// All lights of a scene, by kind. Made by a [`LightSetBuilder`](crate::LightSetBuilder).
///
/// Ids run through the kinds one after the other, through the triangles of each mesh in their
/// order, and end with the lights at infinity; a [`SourceId`] identifies a description. A
/// triangle needs no memory here beyond its vertices.
#[derive(Clone, Debug)]
pub struct LightSet<C: ColorModel> {
    pub(crate) lists: LightLists<C>,
    /// The first id behind each kind.
    ends: [u32; LightKind::COUNT],
    /// How many triangles there are up to and with each mesh.
    mesh_ends: Vec<u32>,
    /// The mesh of every [`STRIDE`](Self::STRIDE)th triangle: bounds for the search of the others.
    mesh_of: Vec<u32>,
    /// Where each description went: its kind, and how many lights of that kind came before.
    sources: Vec<(LightKind, u32)>,
}

/// Identifies a description of a set by the order of adding.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SourceId(pub u32);

impl<C: ColorModel> LightSet<C> {
    /// Triangles per entry of the table that bounds the search for a mesh.
    const STRIDE: usize = 64;

    /// The set without lights.
    pub(crate) const fn empty() -> Self {
        Self {
            lists: LightLists::EMPTY,
            ends: [0; LightKind::COUNT],
            mesh_ends: Vec::new(),
            mesh_of: Vec::new(),
            sources: Vec::new(),
        }
    }

    /// Counts the `lights` that the source last added has; `None` where 32 bits do not suffice for
    /// the ids.
    pub(crate) fn count_in(&mut self, kind: LightKind, lights: usize) -> Option<SourceId> {
        let lights = u32::try_from(lights).ok()?;
        let source = u32::try_from(self.sources.len()).ok()?;
        self.ends[LightKind::COUNT - 1].checked_add(lights)?;
        let before = self.ids(kind).len();
        for end in &mut self.ends[kind as usize..] {
            *end += lights;
        }
        self.sources.push((kind, u32::try_from(before).ok()?));
        if kind == LightKind::Triangle {
            let end = self.ids(kind).len();
            let mesh = self.mesh_ends.len().try_into().ok()?;
            self.mesh_of.resize(end.div_ceil(Self::STRIDE), mesh);
            self.mesh_ends.push(end.try_into().ok()?);
        }
        Some(SourceId(source))
    }

    /// The number of lights; their ids are the smaller numbers.
    #[must_use]
    pub const fn len(&self) -> usize {
        self.ends[LightKind::COUNT - 1] as usize
    }

    /// Whether there is no light at all.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The light with the given id; `None` for an unknown one.
    #[inline]
    #[must_use]
    pub fn get(&self, light: LightId) -> Option<LightRef<'_, C>> {
        // Large sets consist mostly of triangles.
        match self.triangle_number(light) {
            Some(number) => Some(LightRef::Triangle(self.triangle(number)?)),
            None => self.get_other(light),
        }
    }

    /// A light other than a triangle.
    fn get_other(&self, light: LightId) -> Option<LightRef<'_, C>> {
        let kind = *LightKind::ALL.get(self.ends.iter().filter(|&&end| end <= light.0).count())?;
        let index = (light.0 - self.ids(kind).start) as usize;
        let lists = &self.lists;
        Some(match kind {
            LightKind::Point => LightRef::Point(&lists.points[index]),
            LightKind::Spot => LightRef::Spot(&lists.spots[index]),
            LightKind::Projection => LightRef::Projection(&lists.projections[index]),
            LightKind::Goniometric => LightRef::Goniometric(&lists.goniometrics[index]),
            LightKind::Area => LightRef::Area(lists.areas[index].light()),
            LightKind::Triangle => LightRef::Triangle(self.triangle(index)?),
            LightKind::Distant => LightRef::Distant(&lists.distants[index]),
            LightKind::Sun => LightRef::Sun(&lists.suns[index]),
            LightKind::UniformInfinite => {
                LightRef::UniformInfinite(&lists.uniform_infinites[index])
            }
            LightKind::ImageInfinite => LightRef::ImageInfinite(&lists.image_infinites[index]),
            LightKind::PortalInfinite => LightRef::PortalInfinite(&lists.portal_infinites[index]),
        })
    }

    /// The memory that sampling of the light waits for, if its address is known without a read:
    /// the corners of a triangle whose mesh has no list of vertices
    /// ([`MeshIndices::Consecutive`](crate::MeshIndices)). Callers may prefetch it.
    #[inline]
    #[must_use]
    pub fn corners(&self, light: LightId) -> Option<&[Vec3; 3]> {
        let (mesh, index) = self.place(self.triangle_number(light)?)?;
        mesh.corners(index)
    }

    /// The number of a light among all triangles; `None` if it is none.
    #[inline]
    fn triangle_number(&self, light: LightId) -> Option<usize> {
        let triangles = self.ids(LightKind::Triangle);
        let is_one = triangles.contains(&light.0);
        is_one.then(|| (light.0 - triangles.start) as usize)
    }

    /// The triangle with the given number.
    #[inline]
    fn triangle(&self, index: usize) -> Option<DiffuseAreaLight<'_, C, Triangle>> {
        let (mesh, index) = self.place(index)?;
        mesh.triangle(index)
    }

    /// The mesh of a triangle, and its number there.
    #[inline]
    fn place(&self, index: usize) -> Option<(&MeshLight<C>, usize)> {
        let block = index / Self::STRIDE;
        let low = *self.mesh_of.get(block)? as usize;
        let next = self.mesh_of.get(block + 1);
        let high = next.map_or(self.mesh_ends.len() - 1, |&mesh| mesh as usize);
        let between = &self.mesh_ends[low..high];
        let mesh = low + between.partition_point(|&end| end as usize <= index);
        let first = mesh.checked_sub(1).map_or(0, |m| self.mesh_ends[m]);
        Some((&self.lists.meshes[mesh], index - first as usize))
    }

    /// The id of the first light that a description became: of its only one, or of the first
    /// triangle of its mesh. Triangle `k` of that mesh has the id that is larger by `k`. `None` for
    /// an unknown source.
    #[inline]
    #[must_use]
    pub fn first_id(&self, source: SourceId) -> Option<LightId> {
        let (kind, before) = *self.sources.get(source.0 as usize)?;
        Some(LightId(self.ids(kind).start + before))
    }

    /// The ids of the lights at infinity, those from one direction included.
    #[must_use]
    pub fn infinite_ids(&self) -> impl ExactSizeIterator<Item = LightId> + Clone + use<C> {
        let first = self.ends[LAST_BOUNDED as usize];
        (first..self.ends[LightKind::COUNT - 1]).map(LightId)
    }

    /// All lights with their ids.
    pub fn iter(&self) -> impl Iterator<Item = (LightId, LightRef<'_, C>)> {
        (0..self.ends[LightKind::COUNT - 1])
            .map(LightId)
            .filter_map(|id| Some((id, self.get(id)?)))
    }

    /// The extents of all lights, by id, for light samplers.
    #[must_use]
    pub fn extents(&self) -> Vec<LightExtent> {
        self.iter().map(|(_, light)| light.extent()).collect()
    }

    /// The powers of all lights in W, by id: the mean over the colour channels or the spectrum.
    #[must_use]
    pub fn powers(&self) -> Vec<f32> {
        let wavelengths = C::reference_wavelengths();
        let power = |light: LightRef<'_, C>| C::mean(light.phi(&wavelengths), &wavelengths);
        self.iter().map(|(_, light)| power(light)).collect()
    }

    /// Bytes of the lists themselves.
    pub(crate) fn own_bytes(&self) -> usize {
        self.lists.bytes()
            + size_of_val(&*self.mesh_ends)
            + size_of_val(&*self.mesh_of)
            + size_of_val(&*self.sources)
    }

    #[inline]
    fn ids(&self, kind: LightKind) -> Range<u32> {
        let kind = kind as usize;
        let start = if kind == 0 { 0 } else { self.ends[kind - 1] };
        start..self.ends[kind]
    }
}

#[cfg(test)]
mod tests;
