use alloc::vec::Vec;
use core::ops::Range;

use crate::area::DiffuseAreaLight;
use crate::area_desc::AreaSource;
use crate::color::ColorModel;
use crate::distant::DistantLight;
use crate::glam::Vec3;
use crate::goniometric::GoniometricLight;
use crate::image_infinite::ImageInfiniteLight;
use crate::light::Light;
use crate::light_ref::LightRef;
use crate::mesh::MeshLight;
use crate::point::PointLight;
use crate::portal_infinite::PortalInfiniteLight;
use crate::projection::ProjectionLight;
use crate::shape::Triangle;
use crate::spot::SpotLight;
use crate::sun::SunLight;
use crate::uniform_infinite::UniformInfiniteLight;
use light_bounds::{LightExtent, LightId};

/// All lights of a scene, by kind. Made by a [`LightSetBuilder`](crate::LightSetBuilder).
///
/// Ids run through the kinds one after the other, through the triangles of each mesh in their
/// order, and end with the lights at infinity; a [`SourceId`] tells where a description went. A
/// triangle costs nothing here but its vertices.
#[derive(Clone, Debug)]
pub struct LightSet<C: ColorModel> {
    pub(crate) points: Vec<PointLight<C>>,
    pub(crate) spots: Vec<SpotLight<C>>,
    pub(crate) projections: Vec<ProjectionLight<C>>,
    pub(crate) goniometrics: Vec<GoniometricLight<C>>,
    pub(crate) areas: Vec<AreaSource<C>>,
    pub(crate) meshes: Vec<MeshLight<C>>,
    pub(crate) distants: Vec<DistantLight<C>>,
    pub(crate) suns: Vec<SunLight<C>>,
    pub(crate) uniform_infinites: Vec<UniformInfiniteLight<C>>,
    pub(crate) image_infinites: Vec<ImageInfiniteLight<C>>,
    pub(crate) portal_infinites: Vec<PortalInfiniteLight<C>>,
    /// The first id behind each kind.
    ends: [u32; Kind::COUNT],
    /// How many triangles there are up to and with each mesh.
    mesh_ends: Vec<u32>,
    /// The mesh of every [`STRIDE`](Self::STRIDE)th triangle, between which those of the others
    /// lie.
    mesh_of: Vec<u32>,
    /// Where each description went: its kind, and how many lights of that kind came before.
    sources: Vec<(Kind, u32)>,
}

/// Which description of those that a set was built from, in the order of adding.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SourceId(pub u32);

/// The kinds of light, in the order of their ids; those at infinity come last.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Point,
    Spot,
    Projection,
    Goniometric,
    Area,
    Triangle,
    Distant,
    Sun,
    UniformInfinite,
    ImageInfinite,
    PortalInfinite,
}

impl Kind {
    const COUNT: usize = 11;
    const ALL: [Self; Self::COUNT] = [
        Self::Point,
        Self::Spot,
        Self::Projection,
        Self::Goniometric,
        Self::Area,
        Self::Triangle,
        Self::Distant,
        Self::Sun,
        Self::UniformInfinite,
        Self::ImageInfinite,
        Self::PortalInfinite,
    ];
    const LAST_BOUNDED: Self = Self::Triangle;
}

impl<C: ColorModel> LightSet<C> {
    /// Among so many triangles there are few meshes to search.
    const STRIDE: usize = 64;

    /// The set without lights.
    pub(crate) const fn empty() -> Self {
        Self {
            points: Vec::new(),
            spots: Vec::new(),
            projections: Vec::new(),
            goniometrics: Vec::new(),
            areas: Vec::new(),
            meshes: Vec::new(),
            distants: Vec::new(),
            suns: Vec::new(),
            uniform_infinites: Vec::new(),
            image_infinites: Vec::new(),
            portal_infinites: Vec::new(),
            ends: [0; Kind::COUNT],
            mesh_ends: Vec::new(),
            mesh_of: Vec::new(),
            sources: Vec::new(),
        }
    }

    /// Counts the `lights` that the source last added has; `None` where 32 bits do not suffice for
    /// the ids.
    pub(crate) fn count_in(&mut self, kind: Kind, lights: usize) -> Option<SourceId> {
        let lights = u32::try_from(lights).ok()?;
        let source = u32::try_from(self.sources.len()).ok()?;
        self.ends[Kind::COUNT - 1].checked_add(lights)?;
        let before = self.ids(kind).len();
        for end in &mut self.ends[kind as usize..] {
            *end += lights;
        }
        self.sources.push((kind, u32::try_from(before).ok()?));
        if kind == Kind::Triangle {
            let end = self.ids(kind).len();
            let mesh = self.mesh_ends.len().try_into().ok()?;
            self.mesh_of.resize(end.div_ceil(Self::STRIDE), mesh);
            self.mesh_ends.push(end.try_into().ok()?);
        }
        Some(SourceId(source))
    }

    /// How many lights there are; their ids are the numbers below.
    #[must_use]
    pub const fn len(&self) -> usize {
        self.ends[Kind::COUNT - 1] as usize
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
        // Where there are many lights they are triangles.
        match self.triangle_number(light) {
            Some(number) => Some(LightRef::Triangle(self.triangle(number)?)),
            None => self.get_other(light),
        }
    }

    /// A light that is no triangle.
    fn get_other(&self, light: LightId) -> Option<LightRef<'_, C>> {
        let kind = *Kind::ALL.get(self.ends.iter().filter(|&&end| end <= light.0).count())?;
        let index = (light.0 - self.ids(kind).start) as usize;
        Some(match kind {
            Kind::Point => LightRef::Point(&self.points[index]),
            Kind::Spot => LightRef::Spot(&self.spots[index]),
            Kind::Projection => LightRef::Projection(&self.projections[index]),
            Kind::Goniometric => LightRef::Goniometric(&self.goniometrics[index]),
            Kind::Area => LightRef::Area(self.areas[index].light()),
            Kind::Triangle => LightRef::Triangle(self.triangle(index)?),
            Kind::Distant => LightRef::Distant(&self.distants[index]),
            Kind::Sun => LightRef::Sun(&self.suns[index]),
            Kind::UniformInfinite => LightRef::UniformInfinite(&self.uniform_infinites[index]),
            Kind::ImageInfinite => LightRef::ImageInfinite(&self.image_infinites[index]),
            Kind::PortalInfinite => LightRef::PortalInfinite(&self.portal_infinites[index]),
        })
    }

    /// What sampling the light reads last and waits for, where that is known without reading it:
    /// the corners of a triangle whose mesh has no list of vertices
    /// ([`MeshIndices::Consecutive`](crate::MeshIndices)). Callers may ask their memory for it
    /// while they do other work.
    #[inline]
    #[must_use]
    pub fn corners(&self, light: LightId) -> Option<&[Vec3; 3]> {
        let (mesh, index) = self.place(self.triangle_number(light)?)?;
        mesh.corners(index)
    }

    /// The number of a light among all triangles; `None` if it is none.
    #[inline]
    fn triangle_number(&self, light: LightId) -> Option<usize> {
        let triangles = self.ids(Kind::Triangle);
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
        Some((&self.meshes[mesh], index - first as usize))
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
        let first = self.ends[Kind::LAST_BOUNDED as usize];
        (first..self.ends[Kind::COUNT - 1]).map(LightId)
    }

    /// All lights with their ids.
    pub fn iter(&self) -> impl Iterator<Item = (LightId, LightRef<'_, C>)> {
        (0..self.ends[Kind::COUNT - 1])
            .map(LightId)
            .filter_map(|id| Some((id, self.get(id)?)))
    }

    /// What a light sampler is built from: the extents of all lights, by id.
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
        size_of_val(&*self.points)
            + size_of_val(&*self.spots)
            + size_of_val(&*self.projections)
            + size_of_val(&*self.goniometrics)
            + size_of_val(&*self.areas)
            + size_of_val(&*self.meshes)
            + size_of_val(&*self.distants)
            + size_of_val(&*self.suns)
            + size_of_val(&*self.uniform_infinites)
            + size_of_val(&*self.image_infinites)
            + size_of_val(&*self.portal_infinites)
            + size_of_val(&*self.mesh_ends)
            + size_of_val(&*self.mesh_of)
            + size_of_val(&*self.sources)
    }

    #[inline]
    fn ids(&self, kind: Kind) -> Range<u32> {
        let kind = kind as usize;
        let start = if kind == 0 { 0 } else { self.ends[kind - 1] };
        start..self.ends[kind]
    }
}

#[cfg(test)]
mod tests;
