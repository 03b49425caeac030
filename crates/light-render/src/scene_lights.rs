use core::error::Error;
use core::fmt;

use light_scene::{Color, EmissionSides, Image, Material};
use lights::bounds::LightId;
use lights::glam::Vec3;
use lights::math::Aabb;
use lights::sources::{
    self as sources, DiffuseEmissionDesc, Light, LightDesc, LightDescError, LightSet,
    LightSetBuilder, LightType, MeshLightDesc, RadianceAmount, Rgb, SceneSphere, SceneSphereError,
    Sides, SurfaceColor,
};

use crate::world::WorldMesh;

/// The lights of a scene.
#[derive(Debug)]
pub(crate) struct SceneLights {
    pub(crate) lights: LightSet<Rgb>,
    /// Those that rays find by leaving the scene.
    pub(crate) infinite: Vec<LightId>,
}

/// Why the lights of a scene cannot be built.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum SceneLightsError {
    /// The scene's box is not finite.
    Bounds(SceneSphereError),
    /// A light makes no sense; the name is that of its material, or its kind and number.
    Light {
        /// Which light.
        name: String,
        /// What is wrong with it.
        error: LightDescError,
    },
    /// An image that shines has texels that are no light.
    Image {
        /// Which light.
        name: String,
        /// What is wrong with its image.
        error: sources::ImageError,
    },
}

impl SceneLights {
    /// Builds all lights, and tells each shining mesh the id of its first triangle.
    pub(crate) fn new(
        meshes: &mut [WorldMesh],
        materials: &[Material],
        images: &[Image],
        scene_lights: Vec<LightDesc<Rgb>>,
        bounds: &Aabb,
    ) -> Result<Self, SceneLightsError> {
        let sphere = if bounds.is_empty() {
            SceneSphere::new(Vec3::ZERO, 1.0)
        } else {
            // A scene of a single point still has an outside.
            let (center, radius) = bounds.bounding_sphere();
            SceneSphere::new(center, radius.max(f32::MIN_POSITIVE))
        };
        let mut builder = LightSetBuilder::new(sphere.map_err(SceneLightsError::Bounds)?);
        let mut shining = Vec::new();
        for (index, mesh) in meshes.iter().enumerate() {
            let material = &materials[mesh.material];
            if let Some(desc) = mesh_light(mesh, material, images)? {
                let source = add(&mut builder, &material.name, desc)?;
                shining.push((index, source));
            }
        }
        for (number, light) in scene_lights.into_iter().enumerate() {
            let name = format!("light {number}");
            add(&mut builder, &name, light)?;
        }
        let lights = builder.build();
        for (index, source) in shining {
            meshes[index].first_light = lights.first_id(source);
        }
        let found_by_rays = |id: &LightId| {
            lights
                .get(*id)
                .is_some_and(|light| light.light_type() == LightType::Infinite)
        };
        Ok(Self {
            infinite: lights.infinite_ids().filter(found_by_rays).collect(),
            lights,
        })
    }
}

fn add(
    builder: &mut LightSetBuilder<Rgb>,
    name: &str,
    desc: LightDesc<Rgb>,
) -> Result<sources::SourceId, SceneLightsError> {
    builder.add(desc).map_err(|error| SceneLightsError::Light {
        name: name.into(),
        error,
    })
}

/// The light that a mesh is, if its material shines.
fn mesh_light(
    mesh: &WorldMesh,
    material: &Material,
    images: &[Image],
) -> Result<Option<LightDesc<Rgb>>, SceneLightsError> {
    let Some(emission) = &material.emission else {
        return Ok(None);
    };
    let color = match &emission.radiance {
        Color::Constant(radiance) => SurfaceColor::Uniform(*radiance),
        Color::Image(texture) => {
            let image = &images[texture.image.0 as usize];
            let image = image
                .to_light(texture.scale)
                .map_err(|error| SceneLightsError::Image {
                    name: material.name.clone(),
                    error,
                })?;
            SurfaceColor::Image(image)
        }
    };
    let sides = match emission.sides {
        EmissionSides::Front => Sides::Front,
        EmissionSides::Both => Sides::Both,
    };
    Ok(Some(LightDesc::Mesh(MeshLightDesc {
        positions: mesh.positions.clone(),
        indices: mesh.indices.clone(),
        uvs: mesh.uvs.clone(),
        emission: DiffuseEmissionDesc {
            sides,
            media: material.media,
            ..DiffuseEmissionDesc::new(color, RadianceAmount::default())
        },
    })))
}

impl fmt::Display for SceneLightsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Bounds(error) => error.fmt(f),
            Self::Light { name, error } => write!(f, "{name}: {error}"),
            Self::Image { name, error } => write!(f, "{name}: image: {error}"),
        }
    }
}

impl Error for SceneLightsError {}
