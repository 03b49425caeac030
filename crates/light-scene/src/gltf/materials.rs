use lights::math::spectrum::photometric::K_M;

use super::item::Item;
use super::known_materials::KnownMaterial;
use super::reader::Reader;
use super::texture_images::Texture;
use super::uv_sets::UvSets;
use crate::glam::Vec3;
use crate::{
    Alpha, BackFaces, Color, ColorImage, Diagnostic, Emission, EmissionSides, Material, Surface,
    UvSet,
};

/// The base colour of a material.
pub(super) struct Base {
    pub(super) color: Color,
    pub(super) opacity: f32,
    pub(super) texture: Option<Texture>,
}

impl<'a> Reader<'a> {
    /// The material of a primitive.
    pub(super) fn material(&mut self, primitive: &Item<'a>) -> Result<KnownMaterial, Diagnostic> {
        let Some(reference) = primitive.get("material")? else {
            let scene = &mut self.scene;
            let make = || scene.add_material(Material::diffuse("default", Vec3::splat(0.5)));
            return Ok(KnownMaterial {
                id: *self.materials.default.get_or_insert_with(make),
                uv_sets: UvSets::default(),
                normal_map_uvs: None,
                uses_alpha: false,
            });
        };
        let (index, item) = reference.target("materials")?;
        if let Some(&known) = self.materials.known.get(&index) {
            return Ok(known);
        }
        let mut uv_sets = UvSets::default();
        let material = self.make_material(&item, &mut uv_sets)?;
        let mode = item.get("alphaMode")?;
        let mode = mode.map(|mode| mode.text()).transpose()?;
        let made = KnownMaterial {
            uses_alpha: mode.is_some_and(|mode| mode != "OPAQUE"),
            normal_map_uvs: material.normal_map.as_ref().map(|map| map.uv_set),
            id: self.scene.add_material(material),
            uv_sets,
        };
        self.materials.known.insert(index, made);
        Ok(made)
    }

    fn make_material(
        &mut self,
        item: &Item<'a>,
        uv_sets: &mut UvSets,
    ) -> Result<Material, Diagnostic> {
        let two_sided = item.is_true("doubleSided")?;
        // Lights know the first texture coordinates alone.
        let emission = self.emission(item, uv_sets, two_sided)?;
        let base = self.base(item, uv_sets)?;
        let surface = self.surface(item, &base, uv_sets)?;
        let alpha = self.alpha(item, &base, emission.is_some())?;
        let is_hidden = alpha.as_ref().is_some_and(Alpha::hides_all);
        let normal_map = self.normal_map(item, uv_sets)?;
        // What a renderer computes itself.
        self.document.pass_over(item, "occlusionTexture");
        let transmits = matches!(
            surface,
            Surface::Dielectric { .. } | Surface::ThinDielectric { .. }
        );
        Ok(Material {
            emission: emission.filter(|_| !is_hidden),
            alpha,
            normal_map,
            // Light leaves glass through its back faces.
            back_faces: if two_sided || transmits {
                BackFaces::Visible
            } else {
                BackFaces::Culled
            },
            ..Material::new(item.name(), surface)
        })
    }

    /// The base colour, white without one.
    fn base(&mut self, item: &Item<'a>, uv_sets: &mut UvSets) -> Result<Base, Diagnostic> {
        let Some(pbr) = item.get("pbrMetallicRoughness")? else {
            return Ok(Base {
                color: Color::Constant(Vec3::ONE),
                opacity: 1.0,
                texture: None,
            });
        };
        let [r, g, b, opacity] = pbr.shares_or("baseColorFactor", [1.0; 4])?;
        let factor = Vec3::new(r, g, b);
        let texture = self.texture(&pbr, "baseColorTexture", uv_sets)?;
        Ok(Base {
            color: match texture {
                None => Color::Constant(factor),
                Some(texture) => Color::Image(self.color_image(texture, factor)),
            },
            opacity,
            texture,
        })
    }

    /// Emission is in nits where its colour is white.
    fn emission(
        &mut self,
        item: &Item<'a>,
        uv_sets: &mut UvSets,
        two_sided: bool,
    ) -> Result<Option<Emission>, Diagnostic> {
        let factor = Vec3::from(item.numbers_or("emissiveFactor", [0.0; 3])?);
        if factor.min_element() < 0.0 {
            return Err(item.error("expected an `emissiveFactor` of at least 0"));
        }
        let strength = match item.extension("KHR_materials_emissive_strength")? {
            Some(extension) => extension.amount_or("emissiveStrength", 1.0)?,
            None => 1.0,
        };
        let scale = factor * strength / K_M;
        if scale == Vec3::ZERO {
            self.document.pass_over(item, "emissiveTexture");
            return Ok(None);
        }
        let texture = self.texture(item, "emissiveTexture", uv_sets)?;
        Ok(Some(Emission {
            radiance: match texture {
                None => Color::Constant(scale),
                Some(texture) => Color::Image(self.color_image(texture, scale)),
            },
            sides: if two_sided {
                EmissionSides::Both
            } else {
                EmissionSides::Front
            },
        }))
    }

    fn alpha(
        &mut self,
        item: &Item<'a>,
        base: &Base,
        emits: bool,
    ) -> Result<Option<Alpha>, Diagnostic> {
        let cutoff = item.amount_or("alphaCutoff", 0.5)?;
        let cutoff = match item.get("alphaMode")? {
            None => return Ok(None),
            Some(mode) => match mode.text()? {
                "OPAQUE" => return Ok(None),
                "MASK" => Some(cutoff),
                "BLEND" => None,
                _ => return Err(mode.expected("OPAQUE, MASK or BLEND")),
            },
        };
        let scale = Vec3::splat(base.opacity);
        let opacity = base
            .texture
            .and_then(|texture| self.alpha_image(texture, scale));
        let opacity = match opacity {
            Some(image) if emits && image.uv_set == UvSet::Second => {
                self.warn(
                    item,
                    "has an alpha mask that was ignored: its coordinates are not those of the \
                     `emissiveTexture`",
                );
                return Ok(None);
            }
            Some(image) => Color::Image(image),
            None if base.opacity == 1.0 => return Ok(None),
            None => Color::Constant(scale),
        };
        Ok(Some(Alpha { opacity, cutoff }))
    }

    fn normal_map(
        &mut self,
        item: &Item<'a>,
        uv_sets: &mut UvSets,
    ) -> Result<Option<ColorImage>, Diagnostic> {
        let Some(texture) = self.texture(item, "normalTexture", uv_sets)? else {
            return Ok(None);
        };
        let info = item.require("normalTexture")?;
        let scale = info.number_or("scale", 1.0)?;
        let scale = Vec3::new(scale, scale, 1.0);
        Ok(Some(self.data_image(texture, scale)))
    }
}
