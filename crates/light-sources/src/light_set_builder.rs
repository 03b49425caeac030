use alloc::vec::Vec;

use crate::area_desc::AreaSource;
use crate::color::ColorModel;
use crate::distant::DistantLight;
use crate::goniometric::GoniometricLight;
use crate::image_infinite::ImageInfiniteLight;
use crate::light_desc::{LightDesc, LightDescError};
use crate::light_kinds::{LightKind as Kind, LightLists};
use crate::light_set::{LightSet, SourceId};
use crate::mesh::MeshLight;
use crate::point::PointLight;
use crate::portal_infinite::PortalInfiniteLight;
use crate::projection::ProjectionLight;
use crate::scene_sphere::SceneSphere;
use crate::spot::SpotLight;
use crate::sun::SunLight;
use crate::uniform_infinite::UniformInfiniteLight;

/// Makes a [`LightSet`] from descriptions, one by one.
#[derive(Clone, Debug)]
pub struct LightSetBuilder<C: ColorModel> {
    scene: SceneSphere,
    set: LightSet<C>,
}

impl<C: ColorModel> LightSetBuilder<C> {
    /// Starts a set of lights for a scene inside the given sphere, which lights at infinity
    /// illuminate.
    #[must_use]
    pub const fn new(scene: SceneSphere) -> Self {
        Self {
            scene,
            set: LightSet::empty(),
        }
    }

    /// Adds the light that `desc` describes; the returned source gives its id once the set is
    /// built.
    ///
    /// # Errors
    /// When the description is invalid; the set is unchanged then.
    pub fn add(&mut self, desc: LightDesc<C>) -> Result<SourceId, LightDescError> {
        use LightDescError as Error;
        let scene = self.scene;
        match desc {
            LightDesc::Point(desc) => {
                let light = PointLight::new(desc).map_err(Error::Point)?;
                self.keep(Kind::Point, 1, light, |lists| &mut lists.points)
            }
            LightDesc::Spot(desc) => {
                let light = SpotLight::new(desc).map_err(Error::Spot)?;
                self.keep(Kind::Spot, 1, light, |lists| &mut lists.spots)
            }
            LightDesc::Projection(desc) => {
                let light = ProjectionLight::new(desc).map_err(Error::Projection)?;
                self.keep(Kind::Projection, 1, light, |lists| &mut lists.projections)
            }
            LightDesc::Goniometric(desc) => {
                let light = GoniometricLight::new(desc).map_err(Error::Goniometric)?;
                self.keep(Kind::Goniometric, 1, light, |lists| &mut lists.goniometrics)
            }
            LightDesc::Area(desc) => {
                let light = AreaSource::new(desc).map_err(Error::Area)?;
                self.keep(Kind::Area, 1, light, |lists| &mut lists.areas)
            }
            LightDesc::Mesh(desc) => {
                let light = MeshLight::new(desc).map_err(Error::Mesh)?;
                self.keep(Kind::Triangle, light.len(), light, |lists| {
                    &mut lists.meshes
                })
            }
            LightDesc::Distant(desc) => {
                let light = DistantLight::new(desc, scene).map_err(Error::Distant)?;
                self.keep(Kind::Distant, 1, light, |lists| &mut lists.distants)
            }
            LightDesc::Sun(desc) => {
                let light = SunLight::new(desc, scene).map_err(Error::Sun)?;
                self.keep(Kind::Sun, 1, light, |lists| &mut lists.suns)
            }
            LightDesc::UniformInfinite(desc) => {
                let light =
                    UniformInfiniteLight::new(desc, scene).map_err(Error::UniformInfinite)?;
                self.keep(Kind::UniformInfinite, 1, light, |lists| {
                    &mut lists.uniform_infinites
                })
            }
            LightDesc::ImageInfinite(desc) => {
                let light = ImageInfiniteLight::new(desc, scene).map_err(Error::ImageInfinite)?;
                self.keep(Kind::ImageInfinite, 1, light, |lists| {
                    &mut lists.image_infinites
                })
            }
            LightDesc::PortalInfinite(desc) => {
                let light = PortalInfiniteLight::new(desc, scene).map_err(Error::PortalInfinite)?;
                self.keep(Kind::PortalInfinite, 1, light, |lists| {
                    &mut lists.portal_infinites
                })
            }
        }
    }

    /// The set of all lights that were added.
    #[must_use]
    pub fn build(self) -> LightSet<C> {
        self.set
    }

    /// Puts a source that is `lights` lights of a kind into the list of that kind.
    fn keep<T>(
        &mut self,
        kind: Kind,
        lights: usize,
        source: T,
        list: impl FnOnce(&mut LightLists<C>) -> &mut Vec<T>,
    ) -> Result<SourceId, LightDescError> {
        let id = self.set.count_in(kind, lights);
        let id = id.ok_or(LightDescError::TooMany)?;
        list(&mut self.set.lists).push(source);
        Ok(id)
    }
}
