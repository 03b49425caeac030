use alloc::vec::Vec;

use crate::area::DiffuseAreaLight;
use crate::color::ColorModel;
use crate::glam::Vec3;
use crate::light_desc::LightDescError;
use crate::light_kinds::{LightKind, LightLists, LightSource};
use crate::light_ref::LightRef;
use crate::placed_mesh::PlacedMeshes;
use crate::radiant_powers::RadiantPowers;
use crate::scene_sphere::SceneSphere;
use crate::shape::Triangle;
use crate::source_table::{SourceId, SourcePlace, SourceTable};
use light_bounds::{LightExtent, LightId};

/// All lights of a scene, by kind. Made by a [`LightSetBuilder`](crate::LightSetBuilder).
///
/// # Ids
/// A [`SourceId`] counts descriptions, a [`LightId`] lights, both in the order of adding. A mesh
/// has one light for each triangle, in the order of its triangles; any other description has one.
/// What is added later moves no id.
///
/// A renderer keeps the [`SourceId`] of each emissive mesh. Where a ray hits triangle `k` of it,
/// [`id_of`](Self::id_of) gives the light, and a light sampler the probability with which light
/// sampling would have chosen it; [`source_of`](Self::source_of) leads back. The ids of lights at
/// infinity lie among the others: a ray that leaves the scene meets those of
/// [`infinite_ids`](Self::infinite_ids). The example [`mis`][1] is that path in full.
///
/// [1]: https://github.com/lights-rs/lights/blob/main/crates/lights/examples/mis.rs
///
/// ```
/// use light_sources::glam::Vec3;
/// use light_sources::light_bounds::LightId;
/// use light_sources::*;
///
/// let emission = DiffuseEmissionDesc::new(
///     SurfaceColor::Uniform(Vec3::ONE),
///     RadianceAmount::Radiometric(1.0),
/// );
/// let corners = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::ONE];
/// let mesh = MeshLightDesc::new(corners, vec![[0, 1, 2], [1, 3, 2]], emission);
/// let mut lights = LightSetBuilder::<Rgb>::new(SceneSphere::new(Vec3::ZERO, 2.0)?);
/// let first = lights.add(mesh.clone())?;
/// let second = lights.add(mesh)?;
/// let lights = lights.build();
///
/// assert_eq!(lights.id_of(first, 1), Some(LightId(1)));
/// assert_eq!(lights.id_of(second, 1), Some(LightId(3)));
/// assert_eq!(lights.source_of(LightId(3)), Some((second, 1)));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct LightSet<C: ColorModel> {
    pub(crate) lists: LightLists<C>,
    pub(crate) placed: PlacedMeshes<C>,
    pub(crate) sources: SourceTable,
    /// The lights at infinity, in ascending order.
    infinite: Vec<LightId>,
    pub(crate) scene: SceneSphere,
}

impl<C: ColorModel> LightSet<C> {
    /// The set without lights.
    pub(crate) const fn empty(scene: SceneSphere) -> Self {
        Self {
            lists: LightLists::EMPTY,
            placed: PlacedMeshes::EMPTY,
            sources: SourceTable::EMPTY,
            infinite: Vec::new(),
            scene,
        }
    }

    /// Adds a source behind all others.
    pub(crate) fn push(&mut self, source: LightSource<C>) -> Result<SourceId, LightDescError> {
        let too_many = LightDescError::TooMany;
        let kind = source.kind();
        let index = u32::try_from(self.lists.len(kind)).map_err(|_| too_many)?;
        let first = LightId(self.sources.lights());
        let id = self
            .sources
            .add(SourcePlace::Listed { kind, index }, source.lights());
        let id = id.ok_or(too_many)?;
        if source.is_infinite() {
            self.infinite.push(first);
        }
        self.lists.push(source);
        Ok(id)
    }

    /// The number of lights; their ids are the smaller numbers.
    #[must_use]
    pub fn len(&self) -> usize {
        self.sources.lights() as usize
    }

    /// Whether there is no light at all.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The sphere of the scene that the set was made for.
    #[must_use]
    pub const fn scene(&self) -> SceneSphere {
        self.scene
    }

    /// The light with the given id; `None` for an unknown one.
    #[inline]
    #[must_use]
    pub fn get(&self, light: LightId) -> Option<LightRef<'_, C>> {
        let (source, number) = self.sources.find(light)?;
        match self.sources.place(source)? {
            // Large sets consist mostly of triangles.
            SourcePlace::Listed {
                kind: LightKind::Triangle,
                index,
            } => Some(LightRef::Triangle(self.triangle(index as usize, number)?)),
            SourcePlace::Listed { kind, index } => self.get_other(kind, index as usize),
            SourcePlace::Placed(placement) => {
                let triangle = self.placed.triangle(placement, number)?;
                Some(LightRef::Triangle(triangle))
            }
        }
    }

    /// A light other than a triangle.
    fn get_other(&self, kind: LightKind, index: usize) -> Option<LightRef<'_, C>> {
        let lists = &self.lists;
        Some(match kind {
            LightKind::Point => LightRef::Point(&lists.points[index]),
            LightKind::Spot => LightRef::Spot(&lists.spots[index]),
            LightKind::Projection => LightRef::Projection(&lists.projections[index]),
            LightKind::Goniometric => LightRef::Goniometric(&lists.goniometrics[index]),
            LightKind::Area => LightRef::Area(lists.areas[index].light()),
            LightKind::Triangle => LightRef::Triangle(self.triangle(index, 0)?),
            LightKind::Own => LightRef::Own(&lists.owns[index]),
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
    /// ([`MeshIndices::Consecutive`](crate::MeshIndices)), in the coordinates that it is stored in.
    /// Callers may prefetch it.
    #[inline]
    #[must_use]
    pub fn corners(&self, light: LightId) -> Option<&[Vec3; 3]> {
        let (source, triangle) = self.sources.find(light)?;
        match self.sources.place(source)? {
            SourcePlace::Listed {
                kind: LightKind::Triangle,
                index,
            } => self.lists.meshes[index as usize].corners(triangle as usize),
            SourcePlace::Listed { .. } => None,
            SourcePlace::Placed(placement) => self.placed.stored_corners(placement, triangle),
        }
    }

    /// A triangle of a mesh.
    #[inline]
    fn triangle(&self, mesh: usize, number: u32) -> Option<DiffuseAreaLight<'_, C, Triangle>> {
        self.lists.meshes[mesh].triangle(number as usize)
    }

    /// The id of the first light of a source: of its only one, or of the first triangle of its
    /// mesh. `None` for an unknown source.
    ///
    /// Triangle `k` of the mesh has the id that is larger by `k`; [`id_of`](Self::id_of) checks
    /// that there is one.
    #[inline]
    #[must_use]
    pub fn first_id(&self, source: SourceId) -> Option<LightId> {
        Some(LightId(self.sources.ids(source)?.start))
    }

    /// The id of a triangle of a mesh, or of the only light, 0, of another source. `None` for an
    /// unknown source, or one that has fewer lights.
    #[inline]
    #[must_use]
    pub fn id_of(&self, source: SourceId, triangle: u32) -> Option<LightId> {
        let mut ids = self.sources.ids(source)?;
        ids.nth(triangle as usize).map(LightId)
    }

    /// The source of a light, and the number of its triangle there, 0 without a mesh. `None` for an
    /// unknown light.
    #[inline]
    #[must_use]
    pub fn source_of(&self, light: LightId) -> Option<(SourceId, u32)> {
        self.sources.find(light)
    }

    /// The ids of the lights at infinity in ascending order, those from one direction included.
    #[must_use]
    pub fn infinite_ids(&self) -> impl ExactSizeIterator<Item = LightId> + Clone + use<'_, C> {
        self.infinite.iter().copied()
    }

    /// All lights with their ids.
    pub fn iter(&self) -> impl Iterator<Item = (LightId, LightRef<'_, C>)> {
        (0..self.sources.lights())
            .map(LightId)
            .filter_map(|id| Some((id, self.get(id)?)))
    }

    /// The extents of all lights, by id, for light samplers.
    #[must_use]
    pub fn extents(&self) -> Vec<LightExtent> {
        let mut extents = Vec::with_capacity(self.len());
        self.extents_into(&mut extents);
        extents
    }

    /// The powers of all lights in W, by id: the mean over the colour channels, or the integral over
    /// the spectrum. Above 0 for every light that emits at some wavelength.
    ///
    /// Of a light of your own type in the spectral model the integral is not known: its power is
    /// estimated at a few wavelengths, or if it is black at those by its extent. The power of a light
    /// at infinity grows with the square of the scene's radius: where no float holds it, it is
    /// infinite, which a sampler by power refuses.
    #[must_use]
    pub fn powers(&self) -> Vec<f32> {
        let mut powers = RadiantPowers::new(self.scene);
        self.iter().map(|(_, light)| powers.of(&light)).collect()
    }

    /// Bytes of the lists themselves.
    pub(crate) fn own_bytes(&self) -> usize {
        self.lists.bytes()
            + self.placed.bytes()
            + self.sources.bytes()
            + size_of_val(&*self.infinite)
    }
}

#[cfg(test)]
mod tests;
