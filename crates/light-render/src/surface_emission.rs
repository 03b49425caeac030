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

/// Lights of one mesh or sphere with an alpha mask.
#[derive(Clone, Debug)]
pub(crate) struct AlphaMaskedLights {
    /// Their ids.
    pub(crate) ids: Range<u32>,
    /// Index of their material, which has the mask.
    pub(crate) material: usize,
    pub(crate) radiance: MaskedRadiance,
}

/// How the radiance of a light with an alpha mask is stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum MaskedRadiance {
    /// Multiplied with the opacity: the mean over the rays that hit and those that pass.
    TimesOpacity,
    /// That of an opaque surface; samples have to be multiplied with the opacity.
    Unmasked,
}

/// A light and, if it has an alpha mask, how its radiance is stored.
type EmissiveSurface = (LightDesc<Rgb>, Option<MaskedRadiance>);

/// Builds the lights of emissive surfaces; each texture is made once.
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

    /// The light of a mesh, if its material is emissive.
    pub(crate) fn mesh_light(
        &mut self,
        mesh: &WorldMesh,
        material: &Material,
    ) -> Option<EmissiveSurface> {
        let (emission, radiance) = self.emission(material)?;
        let desc = LightDesc::Mesh(MeshLightDesc {
            positions: mesh.positions.clone(),
            indices: mesh.indices.clone(),
            uvs: mesh.uvs.clone(),
            emission,
        });
        Some((desc, radiance))
    }

    /// The light of a sphere, if its material is emissive; the front of the light is the outside.
    pub(crate) fn sphere_light(
        &mut self,
        sphere: &WorldSphere,
        material: &Material,
    ) -> Option<EmissiveSurface> {
        let (mut emission, radiance) = self.emission(material)?;
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
        Some((LightDesc::Area(AreaLightDesc { shape, emission }), radiance))
    }

    /// The emission of a material, if it is emissive.
    fn emission(
        &mut self,
        material: &Material,
    ) -> Option<(DiffuseEmissionDesc<Rgb>, Option<MaskedRadiance>)> {
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

    /// `desc` with the alpha mask; `None` if the surface is masked everywhere. `mapping` is that of
    /// the radiance image, if there is one.
    ///
    /// A constant opacity of 0 without a cutoff makes an invisible light with full emission, as in
    /// pbrt.
    fn masked(
        &mut self,
        desc: DiffuseEmissionDesc<Rgb>,
        mapping: Option<TextureMapping>,
        alpha: &Alpha,
    ) -> Option<(DiffuseEmissionDesc<Rgb>, Option<MaskedRadiance>)> {
        let scaled = |opacity: f32| match &desc.color {
            SurfaceColor::Uniform(radiance) => SurfaceColor::Uniform(*radiance * opacity),
            SurfaceColor::Image { texture, tint } => SurfaceColor::Image {
                texture: texture.clone(),
                tint: *tint * opacity,
            },
        };
        Some(match (&alpha.opacity, alpha.cutoff) {
            (Color::Constant(Vec3 { x, .. }), Some(cutoff)) if *x >= cutoff => (desc, None),
            (Color::Constant(_), Some(_)) => return None,
            (Color::Constant(Vec3 { x, .. }), None) if *x >= 1.0 => (desc, None),
            (Color::Constant(Vec3 { x, .. }), None) if *x > 0.0 => {
                let color = scaled(*x);
                (
                    DiffuseEmissionDesc { color, ..desc },
                    Some(MaskedRadiance::TimesOpacity),
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
                    color: scaled(shown.scale.x),
                    mask: EmissionMask::Alpha(self.texture(shown.image)),
                    mapping: shown.mapping,
                    ..desc
                };
                (desc, Some(MaskedRadiance::TimesOpacity))
            }
            (Color::Image(_), _) => (desc, Some(MaskedRadiance::Unmasked)),
        })
    }

    /// Whether no texel of an image is above 1.
    fn is_mask(&mut self, id: ImageId) -> bool {
        let image = &self.images[id.0 as usize];
        let all_below = || {
            image
                .texels()
                .all(|texel| texel.x <= 1.0 && texel.max_element() <= 1.0)
        };
        *self.is_mask.entry(id).or_insert_with(all_below)
    }
}
