use core::ops::Range;
use std::collections::HashMap;

use light_scene::{Alpha, Color, EmissionSides, ImageId, Material, SphereFront};
use lights::glam::Vec3;
use lights::sources::{
    AreaLightDesc, DiffuseEmissionDesc, EmissionMask, Image, LightDesc, MediumInterface,
    MeshLightDesc, RadianceAmount, Rgb, Sides, SurfaceColor, Texture, TextureMapping,
};

use crate::world_mesh::WorldMesh;
use crate::world_sphere::WorldSphere;

/// Lights whose surfaces have holes.
#[derive(Clone, Debug)]
pub(crate) struct HoledLights {
    /// Which.
    pub(crate) ids: Range<u32>,
    /// Their material, which says where the holes are.
    pub(crate) material: usize,
    pub(crate) holes: Holes,
}

/// Whether the radiance of a light knows the holes of its surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Holes {
    /// It is that of what is there, as a mean.
    InRadiance,
    /// It is that of a whole surface.
    OnlyInSurface,
}

/// A light, and the holes of its surface.
type Shining = (LightDesc<Rgb>, Option<Holes>);

/// The textures of surfaces that shine, each made once.
pub(crate) struct Textures<'a> {
    images: &'a [Image],
    made: HashMap<ImageId, Texture>,
    /// Whether an image has no texel above 1.
    is_mask: HashMap<ImageId, bool>,
}

impl<'a> Textures<'a> {
    pub(crate) fn new(images: &'a [Image]) -> Self {
        Self {
            images,
            made: HashMap::new(),
            is_mask: HashMap::new(),
        }
    }

    fn texture(&mut self, id: ImageId) -> Texture {
        let make = || Texture::new(self.images[id.0 as usize].clone());
        self.made.entry(id).or_insert_with(make).clone()
    }

    /// The light that a mesh is, if its material shines.
    pub(crate) fn mesh_light(&mut self, mesh: &WorldMesh, material: &Material) -> Option<Shining> {
        let (emission, holes) = self.emission(material)?;
        let desc = LightDesc::Mesh(MeshLightDesc {
            positions: mesh.positions.clone(),
            indices: mesh.indices.clone(),
            uvs: mesh.uvs.clone(),
            emission,
        });
        Some((desc, holes))
    }

    /// The light that a sphere is, if its material shines; the front of the light is the outside.
    pub(crate) fn sphere_light(
        &mut self,
        sphere: &WorldSphere,
        material: &Material,
    ) -> Option<Shining> {
        let (mut emission, holes) = self.emission(material)?;
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
        Some((LightDesc::Area(AreaLightDesc { shape, emission }), holes))
    }

    /// How a material shines, if it does.
    fn emission(
        &mut self,
        material: &Material,
    ) -> Option<(DiffuseEmissionDesc<Rgb>, Option<Holes>)> {
        let emission = material.emission.as_ref()?;
        let (color, mapping) = match &emission.radiance {
            Color::Constant(radiance) => (SurfaceColor::Uniform(*radiance), None),
            Color::Image(shown) => {
                let texture = self.texture(shown.image);
                let tint = shown.scale;
                (SurfaceColor::Image { texture, tint }, Some(shown.mapping))
            }
        };
        let sides = match emission.sides {
            EmissionSides::Front => Sides::Front,
            EmissionSides::Both => Sides::Both,
        };
        let desc = DiffuseEmissionDesc {
            sides,
            mapping: mapping.unwrap_or_default(),
            media: material.media,
            ..DiffuseEmissionDesc::new(color, RadianceAmount::default())
        };
        match &material.alpha {
            Some(alpha) => self.masked(desc, mapping, alpha),
            None => Some((desc, None)),
        }
    }

    /// An emission with holes; `None` if nothing is there. `mapping` is that of the image, if it
    /// has one.
    ///
    /// A surface that is not there at all shines as a whole, and is not seen.
    fn masked(
        &mut self,
        desc: DiffuseEmissionDesc<Rgb>,
        mapping: Option<TextureMapping>,
        alpha: &Alpha,
    ) -> Option<(DiffuseEmissionDesc<Rgb>, Option<Holes>)> {
        let dimmed = |share: f32| match &desc.color {
            SurfaceColor::Uniform(radiance) => SurfaceColor::Uniform(*radiance * share),
            SurfaceColor::Image { texture, tint } => SurfaceColor::Image {
                texture: texture.clone(),
                tint: *tint * share,
            },
        };
        Some(match (&alpha.share, alpha.cutoff) {
            (Color::Constant(Vec3 { x, .. }), Some(cutoff)) if *x >= cutoff => (desc, None),
            (Color::Constant(_), Some(_)) => return None,
            (Color::Constant(Vec3 { x, .. }), None) if *x >= 1.0 => (desc, None),
            (Color::Constant(Vec3 { x, .. }), None) if *x > 0.0 => {
                let color = dimmed(*x);
                (
                    DiffuseEmissionDesc { color, ..desc },
                    Some(Holes::InRadiance),
                )
            }
            (Color::Constant(_), None) => {
                let mask = EmissionMask::Invisible;
                (DiffuseEmissionDesc { mask, ..desc }, None)
            }
            (Color::Image(shown), None)
                if mapping.unwrap_or(shown.mapping) == shown.mapping
                    && (0.0..=1.0).contains(&shown.scale.x)
                    && self.is_mask(shown.image) =>
            {
                let desc = DiffuseEmissionDesc {
                    color: dimmed(shown.scale.x),
                    mask: EmissionMask::Alpha(self.texture(shown.image)),
                    mapping: shown.mapping,
                    ..desc
                };
                (desc, Some(Holes::InRadiance))
            }
            (Color::Image(_), _) => (desc, Some(Holes::OnlyInSurface)),
        })
    }

    fn is_mask(&mut self, id: ImageId) -> bool {
        let image = &self.images[id.0 as usize];
        let look = || {
            image
                .texels()
                .all(|texel| texel.x <= 1.0 && texel.max_element() <= 1.0)
        };
        *self.is_mask.entry(id).or_insert_with(look)
    }
}
