use core::ops::Range;
use std::collections::HashMap;

use light_scene::{Alpha, Color, EmissionSides, ImageId, Material, QuadricFront};
use lights::glam::Vec3;
use lights::sources::{
    AlphaMask, AreaLightDesc, DiffuseEmissionDesc, EmissionMask, Image, LightDesc, MediumInterface,
    MeshLightDesc, RadianceAmount, Rgb, Sides, SurfaceColor, Texture, TextureMapping,
};

use crate::world_mesh::WorldMesh;
use crate::world_quadric::WorldQuadric;

/// Lights of one mesh or sphere with an alpha mask, of which the radiance is multiplied with the
/// opacity: the mean over the rays that hit and those that pass.
#[derive(Clone, Debug)]
pub(crate) struct AlphaMaskedLights {
    /// Their ids.
    pub(crate) ids: Range<u32>,
    /// Index of their material, which has the mask.
    pub(crate) material: usize,
}

/// A light, and whether it has an alpha mask.
pub(crate) type DescribedSurface = (LightDesc<Rgb>, bool);

/// Builds the lights of emissive surfaces; each texture is made once.
pub(crate) struct Textures<'a> {
    images: &'a [Image],
    made: HashMap<ImageId, Texture>,
}

impl<'a> Textures<'a> {
    pub(crate) fn new(images: &'a [Image]) -> Self {
        Self {
            images,
            made: HashMap::new(),
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
    ) -> Option<DescribedSurface> {
        let (emission, is_masked) = self.emission(material)?;
        let desc = LightDesc::Mesh(MeshLightDesc {
            positions: mesh.positions.clone(),
            indices: mesh.indices.clone(),
            uvs: mesh.uvs.clone(),
            emission,
        });
        Some((desc, is_masked))
    }

    /// The light of a quadric, if its material is emissive; the front of the light is the outside.
    pub(crate) fn quadric_light(
        &mut self,
        quadric: &WorldQuadric,
        material: &Material,
    ) -> Option<DescribedSurface> {
        let (mut emission, is_masked) = self.emission(material)?;
        if quadric.described.front == QuadricFront::Inside {
            if emission.sides == Sides::Front {
                emission.sides = Sides::Back;
            }
            let MediumInterface { inside, outside } = emission.media;
            emission.media = MediumInterface {
                inside: outside,
                outside: inside,
            };
        }
        let shape = quadric.described.shape();
        Some((
            LightDesc::Area(AreaLightDesc { shape, emission }),
            is_masked,
        ))
    }

    /// The emission of a material, if it is emissive.
    fn emission(&mut self, material: &Material) -> Option<(DiffuseEmissionDesc<Rgb>, bool)> {
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
        let desc = DiffuseEmissionDesc {
            sides,
            mapping,
            media: material.media,
            ..DiffuseEmissionDesc::new(color, RadianceAmount::default())
        };
        match &material.alpha {
            Some(alpha) => self.masked(desc, alpha),
            None => Some((desc, false)),
        }
    }

    /// `desc` with the alpha mask; `None` if the surface is masked everywhere.
    ///
    /// A constant opacity of 0 without a cutoff makes an invisible light with full emission, as in
    /// pbrt: the reason is that of [`Alpha`].
    fn masked(
        &mut self,
        desc: DiffuseEmissionDesc<Rgb>,
        alpha: &Alpha,
    ) -> Option<(DiffuseEmissionDesc<Rgb>, bool)> {
        let scaled = |opacity: f32| match &desc.color {
            SurfaceColor::Uniform(radiance) => SurfaceColor::Uniform(*radiance * opacity),
            SurfaceColor::Image { texture, tint } => SurfaceColor::Image {
                texture: texture.clone(),
                tint: *tint * opacity,
            },
        };
        Some(match (&alpha.opacity, alpha.cutoff) {
            (Color::Constant(Vec3 { x, .. }), Some(cutoff)) if *x >= cutoff => (desc, false),
            (Color::Constant(_), Some(_)) => return None,
            (Color::Constant(Vec3 { x, .. }), None) if *x >= 1.0 => (desc, false),
            (Color::Constant(Vec3 { x, .. }), None) if *x > 0.0 => {
                let color = scaled(*x);
                (DiffuseEmissionDesc { color, ..desc }, true)
            }
            (Color::Constant(_), None) => {
                let mask = EmissionMask::Invisible;
                (DiffuseEmissionDesc { mask, ..desc }, false)
            }
            (Color::Image(shown), cutoff) => {
                let mask = EmissionMask::Alpha(AlphaMask {
                    texture: self.texture(shown.image),
                    scale: shown.scale.x.max(0.0),
                    mapping: Some(shown.mapping),
                    cutoff,
                });
                (DiffuseEmissionDesc { mask, ..desc }, true)
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::world_mesh::ShadingAttributes;
    use light_scene::glam::{Affine2, Vec2};
    use light_scene::{ColorImage, Emission};
    use lights::bounds::LightId;
    use lights::sources::{Channels, Light, LightSetBuilder, SceneSphere, Wrap};

    /// The power is that of the part that emits, where the mask has a cutoff, a mapping that is not
    /// that of the image of emission, or values above 1.
    #[test]
    fn the_power_is_that_of_the_part_that_emits() {
        let halves = Image::from_f32([2, 1], Channels::Gray, vec![0.0, 1.0]).expect("an image");
        let ramp = Image::from_f32([1, 2], Channels::Gray, vec![1.0, 0.5]).expect("an image");
        let images = [halves, ramp];
        let image = |id, scale, turn| {
            Color::Image(ColorImage {
                scale: Vec3::splat(scale),
                mapping: TextureMapping {
                    transform: Affine2::from_angle(turn),
                    wrap: [Wrap::Repeat; 2],
                },
                ..ColorImage::new(ImageId(id))
            })
        };
        let one = Color::Constant(Vec3::ONE);
        let quarter = core::f32::consts::FRAC_PI_2;
        for (what, radiance, share, cutoff, expected) in [
            ("a cutoff", one, image(0, 1.0, 0.0), Some(0.5), 0.5),
            ("a high cutoff", one, image(0, 1.0, 0.0), Some(0.75), 0.25),
            (
                "a mapping",
                image(1, 1.0, 0.0),
                image(1, 1.0, quarter),
                None,
                0.75 * 0.75,
            ),
            ("above 1", one, image(0, 2.0, 0.0), None, 0.75),
            (
                "both",
                image(1, 1.0, 0.0),
                image(0, 1.0, 0.0),
                Some(0.5),
                0.375,
            ),
        ] {
            let material = Material {
                emission: Some(Emission {
                    radiance,
                    sides: EmissionSides::Front,
                }),
                alpha: Some(Alpha {
                    opacity: share,
                    cutoff,
                }),
                ..Material::diffuse("lamp", Vec3::ZERO)
            };
            let corners = [Vec3::ZERO, Vec3::X, Vec3::X + Vec3::Y, Vec3::Y];
            let mesh = WorldMesh {
                name: String::new(),
                positions: corners.into(),
                indices: [[0, 1, 2], [0, 2, 3]].into(),
                uvs: Some(corners.map(|p| Vec2::new(p.x, p.y)).into()),
                normals: None,
                shading: ShadingAttributes::default(),
                material: 0,
            };
            let light = Textures::new(&images).mesh_light(&mesh, &material);
            let (desc, is_masked) = light.expect("a light");
            assert!(is_masked, "{what}");
            let sphere = SceneSphere::new(Vec3::ZERO, 2.0).expect("a sphere");
            let mut builder = LightSetBuilder::<Rgb>::new(sphere);
            builder.add(desc).expect("a light");
            let set = builder.build();
            let power = |id| set.get(LightId(id)).expect("a triangle").phi(&()).x;
            let mean = (power(0) + power(1)) / core::f32::consts::PI;
            assert!((mean - expected).abs() < 1e-5, "{what}: {mean}");
        }
    }
}
