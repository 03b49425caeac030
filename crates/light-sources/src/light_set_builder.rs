use crate::area_desc::AreaSource;
use crate::color::ColorModel;
use crate::distant::DistantLight;
use crate::goniometric::GoniometricLight;
use crate::image_infinite::ImageInfiniteLight;
use crate::light_desc::{LightDesc, LightDescError};
use crate::light_kinds::LightSource;
use crate::light_set::LightSet;
use crate::mesh::MeshLight;
use crate::point::PointLight;
use crate::portal_infinite::PortalInfiniteLight;
use crate::projection::ProjectionLight;
use crate::scene_sphere::SceneSphere;
use crate::source_table::SourceId;
use crate::spot::SpotLight;
use crate::sun::SunLight;
use crate::uniform_infinite::UniformInfiniteLight;

/// Makes a [`LightSet`] from descriptions, one by one.
#[derive(Clone, Debug)]
pub struct LightSetBuilder<C: ColorModel> {
    set: LightSet<C>,
}

impl<C: ColorModel> LightSetBuilder<C> {
    /// Starts a set of lights for a scene inside the given sphere, which lights at infinity
    /// illuminate.
    #[must_use]
    pub const fn new(scene: SceneSphere) -> Self {
        Self {
            set: LightSet::empty(scene),
        }
    }

    /// Adds the light that `desc` describes, a [`LightDesc`] or a description of one kind; the
    /// returned source gives its id once the set is built. Lights of your own types are an
    /// [`OwnLight`](crate::OwnLight).
    ///
    /// # Errors
    /// When the description is invalid; the set is unchanged then.
    pub fn add(&mut self, desc: impl Into<LightDesc<C>>) -> Result<SourceId, LightDescError> {
        let source = LightSource::new(desc.into(), self.set.scene)?;
        self.set.push(source)
    }

    /// The set so far.
    pub(crate) const fn set_mut(&mut self) -> &mut LightSet<C> {
        &mut self.set
    }

    /// The set of all lights that were added.
    #[must_use]
    pub fn build(self) -> LightSet<C> {
        self.set
    }
}

impl<C: ColorModel> LightSource<C> {
    /// The source that `desc` describes.
    pub(crate) fn new(desc: LightDesc<C>, scene: SceneSphere) -> Result<Self, LightDescError> {
        use LightDescError as Error;
        Ok(match desc {
            LightDesc::Point(desc) => Self::Point(PointLight::new(desc).map_err(Error::Point)?),
            LightDesc::Spot(desc) => Self::Spot(SpotLight::new(desc).map_err(Error::Spot)?),
            LightDesc::Projection(desc) => {
                Self::Projection(ProjectionLight::new(desc).map_err(Error::Projection)?)
            }
            LightDesc::Goniometric(desc) => {
                Self::Goniometric(GoniometricLight::new(desc).map_err(Error::Goniometric)?)
            }
            LightDesc::Area(desc) => Self::Area(AreaSource::new(desc).map_err(Error::Area)?),
            LightDesc::Mesh(desc) => Self::Triangle(MeshLight::new(desc).map_err(Error::Mesh)?),
            LightDesc::Own(light) => Self::Own(light.checked().map_err(Error::Own)?),
            LightDesc::Distant(desc) => {
                Self::Distant(DistantLight::new(desc, scene).map_err(Error::Distant)?)
            }
            LightDesc::Sun(desc) => Self::Sun(SunLight::new(desc, scene).map_err(Error::Sun)?),
            LightDesc::UniformInfinite(desc) => {
                let light = UniformInfiniteLight::new(desc, scene);
                Self::UniformInfinite(light.map_err(Error::UniformInfinite)?)
            }
            LightDesc::ImageInfinite(desc) => {
                let light = ImageInfiniteLight::new(desc, scene);
                Self::ImageInfinite(light.map_err(Error::ImageInfinite)?)
            }
            LightDesc::PortalInfinite(desc) => {
                let light = PortalInfiniteLight::new(desc, scene);
                Self::PortalInfinite(light.map_err(Error::PortalInfinite)?)
            }
        })
    }
}
