use alloc::vec::Vec;

use crate::color::ColorModel;
use crate::glam::Affine3A;
use crate::light::Light;
use crate::light_desc::LightDescError;
use crate::light_set::LightSet;
use crate::light_set_builder::LightSetBuilder;
use crate::mesh::{MeshLight, MeshLightDesc};
use crate::placed_mesh::{MeshPrototypeId, PlacedMeshCounts, PlacedMeshError};
use crate::source_table::{SourceId, SourcePlace};
use light_bounds::LightExtent;

/// Emissive meshes that are stored once and placed any number of times.
impl<C: ColorModel> LightSetBuilder<C> {
    /// Stores an emissive mesh in coordinates of its own. It has no lights until it is
    /// [placed](Self::place_mesh).
    ///
    /// # Errors
    /// When the description is invalid; the set is unchanged then.
    pub fn add_mesh_prototype(
        &mut self,
        desc: MeshLightDesc<C>,
    ) -> Result<MeshPrototypeId, LightDescError> {
        let mesh = MeshLight::new(desc).map_err(LightDescError::Mesh)?;
        let id = self.set_mut().placed.add_prototype(mesh);
        id.ok_or(LightDescError::TooMany)
    }

    /// Adds the lights of a prototype where `to_scene` takes it: one source of as many lights as
    /// the prototype has triangles, with ids of their own. It takes 80 bytes, whatever the mesh.
    ///
    /// Any affine map serves. The lights are those of a mesh with the moved vertices, to the bit
    /// where no image and no mask varies the emission. The front of a triangle stays its front,
    /// also where the map mirrors. Radiance stays as well: an amount of the prototype that is a
    /// power is that of the mesh as it was described.
    ///
    /// ```
    /// use light_sources::glam::{Affine3A, Vec3};
    /// use light_sources::light_bounds::LightId;
    /// use light_sources::*;
    ///
    /// let emission = DiffuseEmissionDesc::new(
    ///     SurfaceColor::Uniform(Vec3::ONE),
    ///     RadianceAmount::Radiometric(1.0),
    /// );
    /// let window = MeshLightDesc::new([Vec3::ZERO, Vec3::X, Vec3::Y], [[0, 1, 2]], emission);
    /// let mut lights = LightSetBuilder::<Rgb>::new(SceneSphere::new(Vec3::ZERO, 200.0)?);
    /// let window = lights.add_mesh_prototype(window)?;
    /// for i in 0..100u8 {
    ///     let at = Affine3A::from_translation(Vec3::X * f32::from(i));
    ///     lights.place_mesh(window, &at)?;
    /// }
    /// let lights = lights.build();
    /// assert_eq!(lights.len(), 100);
    /// assert_eq!(lights.source_of(LightId(42)), Some((SourceId(42), 0)));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// An unknown prototype, a transform that does not keep its vertices, areas and powers finite,
    /// or more lights than ids; the set is unchanged then.
    pub fn place_mesh(
        &mut self,
        prototype: MeshPrototypeId,
        to_scene: &Affine3A,
    ) -> Result<SourceId, PlacedMeshError> {
        let set = self.set_mut();
        let lights = set.placed.checked_len(prototype, to_scene)?;
        let number = set.placed.next().ok_or(PlacedMeshError::TooMany)?;
        let source = set.sources.add(SourcePlace::Placed(number), lights);
        let source = source.ok_or(PlacedMeshError::TooMany)?;
        set.placed.place(prototype, to_scene);
        Ok(source)
    }
}

impl<C: ColorModel> LightSet<C> {
    /// How many lights are placed, and how few of them are stored; linear in the placements.
    #[must_use]
    pub fn placed_counts(&self) -> PlacedMeshCounts {
        self.placed.counts()
    }

    /// The prototype of a source that is a placed mesh, and the transform that takes it to the
    /// scene; `None` for other sources.
    #[must_use]
    pub fn placement(&self, source: SourceId) -> Option<(MeshPrototypeId, &Affine3A)> {
        match self.sources.place(source)? {
            SourcePlace::Placed(placement) => self.placed.placement(placement),
            SourcePlace::Listed { .. } => None,
        }
    }

    /// The extents of the triangles of a prototype, in its own coordinates; none of an unknown one.
    #[must_use]
    pub fn prototype_extents(&self, prototype: MeshPrototypeId) -> Vec<LightExtent> {
        let mesh = self.placed.prototype(prototype);
        let triangles = mesh.into_iter().flat_map(|mesh| {
            let numbers = 0..mesh.len();
            numbers.filter_map(|number| mesh.triangle(number))
        });
        triangles.map(|triangle| triangle.extent()).collect()
    }

    /// Moves a source that is a [placed](LightSetBuilder::place_mesh) mesh to where `to_scene`
    /// takes its prototype. No id changes, and no other source is touched.
    ///
    /// # Errors
    /// When the source is none, or the transform does not keep its vertices, areas and powers
    /// finite; the set is unchanged then.
    pub fn update_placement(
        &mut self,
        source: SourceId,
        to_scene: &Affine3A,
    ) -> Result<(), PlacedMeshError> {
        match self.sources.place(source) {
            Some(SourcePlace::Placed(placement)) => self.placed.replace(placement, to_scene),
            _ => Err(PlacedMeshError::OtherSource),
        }
    }
}

#[cfg(test)]
mod tests;
