use core::error::Error;
use core::fmt;
use std::collections::HashMap;

use light_scene::{Color, EmissionSides, ImageId, Material, SphereFront};
use lights::bounds::LightId;
use lights::glam::Vec3;
use lights::math::Aabb;
use lights::sources::{
    self as sources, AreaLightDesc, DiffuseEmissionDesc, Image, Light, LightDesc, LightDescError,
    LightSet, LightSetBuilder, LightType, MediumInterface, MeshLightDesc, RadianceAmount, Rgb,
    SceneSphere, SceneSphereError, Sides, SurfaceColor, Texture, TextureMapping,
};

use crate::world::{WorldMesh, WorldSphere};

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
    /// An image has texels that are no light.
    Image {
        /// Which image.
        name: String,
        /// What is wrong with it.
        error: sources::ImageError,
    },
}

impl SceneLights {
    /// Builds all lights, and tells each shining mesh the id of its first triangle, each shining sphere its own.
    pub(crate) fn new(
        meshes: &mut [WorldMesh],
        spheres: &mut [WorldSphere],
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
        let mut textures = Textures {
            images,
            made: HashMap::new(),
        };
        let mut shining = Vec::new();
        for (index, mesh) in meshes.iter().enumerate() {
            let material = &materials[mesh.material];
            if let Some(desc) = textures.mesh_light(mesh, material) {
                let source = add(&mut builder, &material.name, desc)?;
                shining.push((index, source));
            }
        }
        let mut shining_spheres = Vec::new();
        for (index, sphere) in spheres.iter().enumerate() {
            let material = &materials[sphere.material];
            if let Some(desc) = textures.sphere_light(sphere, material) {
                let source = add(&mut builder, &material.name, desc)?;
                shining_spheres.push((index, source));
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
        for (index, source) in shining_spheres {
            spheres[index].light = lights.first_id(source);
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

/// The images of a scene, as lights and surfaces hold them.
pub(crate) fn shown_images(
    images: Vec<light_scene::Image>,
) -> Result<Vec<Image>, SceneLightsError> {
    let shown = |(number, image): (usize, light_scene::Image)| {
        image.to_light().map_err(|error| SceneLightsError::Image {
            name: format!("image {number}"),
            error,
        })
    };
    images.into_iter().enumerate().map(shown).collect()
}

/// The textures of surfaces that shine, each made once.
struct Textures<'a> {
    images: &'a [Image],
    made: HashMap<ImageId, Texture>,
}

impl Textures<'_> {
    fn texture(&mut self, id: ImageId) -> Texture {
        let make = || Texture::new(self.images[id.0 as usize].clone());
        self.made.entry(id).or_insert_with(make).clone()
    }

    /// The light that a mesh is, if its material shines.
    fn mesh_light(&mut self, mesh: &WorldMesh, material: &Material) -> Option<LightDesc<Rgb>> {
        Some(LightDesc::Mesh(MeshLightDesc {
            positions: mesh.positions.clone(),
            indices: mesh.indices.clone(),
            uvs: mesh.uvs.clone(),
            emission: self.emission(material)?,
        }))
    }

    /// The light that a sphere is, if its material shines; the front of the light is the outside.
    fn sphere_light(
        &mut self,
        sphere: &WorldSphere,
        material: &Material,
    ) -> Option<LightDesc<Rgb>> {
        let mut emission = self.emission(material)?;
        if sphere.front == SphereFront::Inside {
            if emission.sides == Sides::Front {
                emission.sides = Sides::Back;
            }
            let MediumInterface { inside, outside } = emission.media;
            emission.media = MediumInterface {
                inside: outside,
                outside: inside,
            };
        }
        let shape = sphere.shape.into();
        Some(LightDesc::Area(AreaLightDesc { shape, emission }))
    }

    /// How a material shines, if it does.
    fn emission(&mut self, material: &Material) -> Option<DiffuseEmissionDesc<Rgb>> {
        let emission = material.emission.as_ref()?;
        let (color, mapping) = match &emission.radiance {
            Color::Constant(radiance) => {
                (SurfaceColor::Uniform(*radiance), TextureMapping::default())
            }
            Color::Image(shown) => {
                let texture = self.texture(shown.image);
                let tint = shown.scale;
                (SurfaceColor::Image { texture, tint }, shown.mapping)
            }
        };
        let sides = match emission.sides {
            EmissionSides::Front => Sides::Front,
            EmissionSides::Both => Sides::Both,
        };
        Some(DiffuseEmissionDesc {
            sides,
            mapping,
            media: material.media,
            ..DiffuseEmissionDesc::new(color, RadianceAmount::default())
        })
    }
}

impl fmt::Display for SceneLightsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Bounds(error) => error.fmt(f),
            Self::Light { name, error } => write!(f, "{name}: {error}"),
            Self::Image { name, error } => write!(f, "{name}: {error}"),
        }
    }
}

impl Error for SceneLightsError {}
