use core::error::Error;
use core::fmt;

use light_scene::{Color, EmissionSides, Image, Material, SceneLight};
use lights::bounds::LightId;
use lights::glam::{Affine3A, Vec3};
use lights::math::Aabb;
use lights::sources::{
    self as sources, Channels, DiffuseEmissionDesc, DistantLightDesc, EnvironmentMap,
    ImageInfiniteLightDesc, IntensityAmount, IrradianceAmount, Light, LightDesc, LightDescError,
    LightSet, LightSetBuilder, LightType, MediumInterface, MeshLightDesc, PointLightDesc,
    RadianceAmount, Rgb, SceneSphere, SceneSphereError, Sides, SurfaceColor,
    UniformInfiniteLightDesc,
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
        scene_lights: &[SceneLight],
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
        for (number, light) in scene_lights.iter().enumerate() {
            let name = format!("light {number}");
            let desc = free_light(light, images).map_err(|error| SceneLightsError::Image {
                name: name.clone(),
                error,
            })?;
            add(&mut builder, &name, desc)?;
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
            let image =
                light_image(image, texture.scale).map_err(|error| SceneLightsError::Image {
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
            ..DiffuseEmissionDesc::new(color, RadianceAmount::default())
        },
    })))
}

/// A light that is no mesh.
fn free_light(light: &SceneLight, images: &[Image]) -> Result<LightDesc<Rgb>, sources::ImageError> {
    Ok(match light {
        SceneLight::Point {
            position,
            intensity,
        } => LightDesc::Point(PointLightDesc {
            position: *position,
            emission: *intensity,
            amount: IntensityAmount::default(),
            media: MediumInterface::default(),
        }),
        SceneLight::Distant {
            direction,
            irradiance,
        } => LightDesc::Distant(DistantLightDesc {
            direction: -*direction,
            emission: *irradiance,
            amount: IrradianceAmount::default(),
        }),
        SceneLight::UniformSky { radiance } => {
            LightDesc::UniformInfinite(UniformInfiniteLightDesc {
                emission: *radiance,
                amount: RadianceAmount::default(),
            })
        }
        SceneLight::ImageSky(sky) => {
            let image = light_image(&images[sky.image.0 as usize], sky.scale)?;
            LightDesc::ImageInfinite(ImageInfiniteLightDesc {
                transform: Affine3A::from_quat(sky.rotation),
                map: EnvironmentMap::LatLong(image),
                amount: RadianceAmount::default(),
            })
        }
        _ => unreachable!("every kind of scene light is handled above"),
    })
}

/// The image as a light holds it, each texel times `scale`.
fn light_image(image: &Image, scale: Vec3) -> Result<sources::Image, sources::ImageError> {
    let texels: Vec<f32> = image
        .texels()
        .iter()
        .flat_map(|&texel| (texel * scale).to_array())
        .collect();
    sources::Image::from_f32([image.width(), image.height()], Channels::Rgb, texels)
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
