use super::item::Item;
use super::materials::Base;
use super::reader::Reader;
use super::uv_sets::UvSets;
use crate::glam::{Vec2, Vec3};
use crate::{Clearcoat, Color, Diagnostic, MetallicRoughness, Surface};

/// The dielectric above a diffuse base.
struct Specular {
    f0: Vec3,
    f90: f32,
}

impl<'a> Reader<'a> {
    /// How a material scatters light.
    pub(super) fn surface(
        &mut self,
        item: &Item<'a>,
        base: &Base,
        uv_sets: &mut UvSets,
    ) -> Result<Surface, Diagnostic> {
        let roughness_metallic = self.roughness_metallic(item, uv_sets)?;
        let eta = match item.extension("KHR_materials_ior")? {
            Some(ior) => ior.amount_or("ior", 1.5)?,
            None => 1.5,
        };
        let specular = specular(item, eta)?;
        let clearcoat = self.clearcoat(item, uv_sets)?;
        let mean = self.scene.mean(&roughness_metallic);
        let is_metal = mean.z >= 0.5;
        if let Some(transmission) = item.extension("KHR_materials_transmission")? {
            let factor = transmission.share_or("transmissionFactor", 0.0)?;
            if factor != 0.0 && factor != 1.0 {
                self.warn(
                    &transmission,
                    "was rounded to a `transmissionFactor` of 0 or 1",
                );
            }
            if factor >= 0.5 && !is_metal {
                if self.scene.mean(&base.color) != Vec3::ONE {
                    self.warn(item, "transmits light and was taken as clear");
                }
                return Ok(glass(item, eta, mean.y));
            }
        }
        let is_matt = specular.f0 == Vec3::ZERO && specular.f90 == 0.0;
        let is_never_metal = roughness_metallic == Color::Constant(mean) && mean.z == 0.0;
        if is_matt && is_never_metal && clearcoat.is_none() {
            let reflectance = base.color;
            return Ok(Surface::Diffuse { reflectance });
        }
        Ok(Surface::MetallicRoughness(Box::new(MetallicRoughness {
            base_color: base.color,
            roughness_metallic,
            f0: specular.f0,
            f90: specular.f90,
            clearcoat,
        })))
    }

    /// Roughness in the second channel, metalness in the third.
    fn roughness_metallic(
        &mut self,
        item: &Item<'a>,
        uv_sets: &mut UvSets,
    ) -> Result<Color, Diagnostic> {
        let Some(pbr) = item.get("pbrMetallicRoughness")? else {
            return Ok(Color::Constant(Vec3::ONE));
        };
        let metallic = pbr.share_or("metallicFactor", 1.0)?;
        let roughness = pbr.share_or("roughnessFactor", 1.0)?;
        let factors = Vec3::new(1.0, roughness, metallic);
        let texture = self.texture(&pbr, "metallicRoughnessTexture", uv_sets)?;
        Ok(match texture {
            Some(texture) => Color::Image(self.data_image(texture, factors)),
            // Factors alone make a textured surface a metal, as 1 is what they are by default.
            None if pbr.get("metallicRoughnessTexture")?.is_some() => {
                Color::Constant(factors.with_z(0.0))
            }
            None => Color::Constant(factors),
        })
    }

    fn clearcoat(
        &mut self,
        item: &Item<'a>,
        uv_sets: &mut UvSets,
    ) -> Result<Option<Clearcoat>, Diagnostic> {
        let Some(coat) = item.extension("KHR_materials_clearcoat")? else {
            return Ok(None);
        };
        let weight = coat.share_or("clearcoatFactor", 0.0)?;
        let roughness = coat.share_or("clearcoatRoughnessFactor", 0.0)?;
        if weight == 0.0 {
            for texture in [
                "clearcoatTexture",
                "clearcoatRoughnessTexture",
                "clearcoatNormalTexture",
            ] {
                self.document.pass_over(&coat, texture);
            }
            return Ok(None);
        }
        let mut of = |name, factor| {
            let texture = self.texture(&coat, name, uv_sets)?;
            let factor = Vec3::splat(factor);
            Ok(match texture {
                Some(texture) => Color::Image(self.data_image(texture, factor)),
                None => Color::Constant(factor),
            })
        };
        Ok(Some(Clearcoat {
            weight: of("clearcoatTexture", weight)?,
            roughness: of("clearcoatRoughnessTexture", roughness)?,
        }))
    }
}

/// The dielectric of index `eta`, with its strength and colour.
fn specular(item: &Item<'_>, eta: f32) -> Result<Specular, Diagnostic> {
    let mut factor = 1.0;
    let mut color = Vec3::ONE;
    if let Some(specular) = item.extension("KHR_materials_specular")? {
        factor = specular.share_or("specularFactor", 1.0)?;
        let found = specular.numbers_or("specularColorFactor", [1.0; 3])?;
        color = Vec3::from(found);
        if color.min_element() < 0.0 {
            return Err(specular.error("expected a `specularColorFactor` of at least 0"));
        }
    }
    if eta == 1.0 {
        factor = 0.0;
    }
    let root = (eta - 1.0) / (eta + 1.0);
    Ok(Specular {
        f0: (root * root * color).min(Vec3::ONE) * factor,
        f90: factor,
    })
}

/// A thin pane, or solid glass where it bounds a volume.
fn glass(item: &Item<'_>, eta: f32, roughness: f32) -> Surface {
    if item_is_solid(item) {
        let alpha = Vec2::splat(roughness * roughness);
        Surface::Dielectric { eta, alpha }
    } else {
        Surface::ThinDielectric { eta }
    }
}

/// Whether light is bent by what is behind a surface that transmits it.
fn item_is_solid(item: &Item<'_>) -> bool {
    let volume = item.extension("KHR_materials_volume").ok().flatten();
    volume.is_some_and(|volume| {
        volume
            .number_or("thicknessFactor", 0.0)
            .is_ok_and(|t| t > 0.0)
    })
}
