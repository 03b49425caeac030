use crate::color::ColorModel;
use crate::desc::{LightDesc, LightDescError};
use crate::distant::DistantLight;
use crate::image_infinite::ImageInfiniteLight;
use crate::light_set::{Kind, LightSet, SourceId};
use crate::mesh::MeshLight;
use crate::point::PointLight;
use crate::scene_sphere::SceneSphere;
use crate::uniform_infinite::UniformInfiniteLight;

/// Makes a [`LightSet`] from descriptions, one by one.
#[derive(Clone, Debug)]
pub struct LightSetBuilder<C: ColorModel> {
    scene: SceneSphere,
    set: LightSet<C>,
}

impl<C: ColorModel> LightSetBuilder<C> {
    /// Starts a set of lights for a scene inside the given sphere: what lights at infinity have to illuminate.
    #[must_use]
    pub const fn new(scene: SceneSphere) -> Self {
        Self {
            scene,
            set: LightSet::empty(),
        }
    }

    /// Adds the light that `desc` describes; the answer is a name for it, by which its id is known once the set is built.
    ///
    /// # Errors
    /// When the description makes no sense; the set is unchanged then.
    pub fn add(&mut self, desc: LightDesc<C>) -> Result<SourceId, LightDescError> {
        let set = &mut self.set;
        let too_many = LightDescError::TooMany;
        match desc {
            LightDesc::Point(desc) => {
                let light = PointLight::new(desc).map_err(LightDescError::Point)?;
                let source = set.count_in(Kind::Point, 1).ok_or(too_many)?;
                set.points.push(light);
                Ok(source)
            }
            LightDesc::Mesh(desc) => {
                let light = MeshLight::new(desc).map_err(LightDescError::Mesh)?;
                let source = set.count_in(Kind::Triangle, light.len()).ok_or(too_many)?;
                set.meshes.push(light);
                Ok(source)
            }
            LightDesc::Distant(desc) => {
                let light = DistantLight::new(desc, self.scene).map_err(LightDescError::Distant)?;
                let source = set.count_in(Kind::Distant, 1).ok_or(too_many)?;
                set.distants.push(light);
                Ok(source)
            }
            LightDesc::UniformInfinite(desc) => {
                let light = UniformInfiniteLight::new(desc, self.scene)
                    .map_err(LightDescError::UniformInfinite)?;
                let source = set.count_in(Kind::UniformInfinite, 1).ok_or(too_many)?;
                set.uniform_infinites.push(light);
                Ok(source)
            }
            LightDesc::ImageInfinite(desc) => {
                let light = ImageInfiniteLight::new(desc, self.scene)
                    .map_err(LightDescError::ImageInfinite)?;
                let source = set.count_in(Kind::ImageInfinite, 1).ok_or(too_many)?;
                set.image_infinites.push(light);
                Ok(source)
            }
        }
    }

    /// The set of all lights that were added.
    #[must_use]
    pub fn build(self) -> LightSet<C> {
        self.set
    }
}
