use lights::math::spectrum::photometric::K_M;

use super::item::{Item, share};
use super::reader::Reader;
use super::texture_images::Texture;
use crate::glam::{Vec2, Vec3};
use crate::{Alpha, Color, Diagnostic, Emission, EmissionSides, Material, MaterialId, Surface};

/// The scattering parameters of a material.
struct Finish {
    base: Color,
    metallic: f32,
    roughness: f32,
    eta: f32,
    /// Whether there is a coat above the base.
    specular: bool,
    transmission: f32,
}

impl<'a> Reader<'a> {
    /// The material of a primitive and the number of its texture coordinates.
    pub(super) fn material(
        &mut self,
        primitive: &Item<'a>,
    ) -> Result<(MaterialId, usize), Diagnostic> {
        let Some(reference) = primitive.get("material")? else {
            let scene = &mut self.scene;
            let make = || scene.add_material(Material::diffuse("default", Vec3::splat(0.5)));
            return Ok((*self.materials.default.get_or_insert_with(make), 0));
        };
        let (index, item) = reference.target("materials")?;
        if let Some(&known) = self.materials.known.get(&index) {
            return Ok(known);
        }
        let (material, uv_set) = self.make_material(&item)?;
        let made = (self.scene.add_material(material), uv_set);
        self.materials.known.insert(index, made);
        Ok(made)
    }

    fn make_material(&mut self, item: &Item<'a>) -> Result<(Material, usize), Diagnostic> {
        let two_sided = item.is_true("doubleSided")?;
        let emissive = self.texture(item, "emissiveTexture")?;
        let (mut finish, base, opacity) = self.finish(item)?;
        let uv_set = base.or(emissive).map_or(0, |texture| texture.uv_set);
        let emissive = emissive.filter(|texture| texture.uv_set == uv_set);
        if emissive.is_none() && item.get("emissiveTexture")?.is_some() {
            self.warn(
                item,
                "has an `emissiveTexture` that was ignored: its coordinates are not \
                             those of the base colour",
            );
        }
        if let Some(ior) = item.extension("KHR_materials_ior")? {
            finish.eta = ior.amount_or("ior", 1.5)?;
        }
        if let Some(specular) = item.extension("KHR_materials_specular")? {
            let factor = specular.share_or("specularFactor", 1.0)?;
            finish.specular = factor >= 0.5;
            if factor != 0.0 && factor != 1.0 {
                self.warn(&specular, "was rounded to a `specularFactor` of 0 or 1");
            }
        }
        if let Some(transmission) = item.extension("KHR_materials_transmission")? {
            finish.transmission = transmission.share_or("transmissionFactor", 0.0)?;
            if finish.transmission != 0.0 && finish.transmission != 1.0 {
                self.warn(
                    &transmission,
                    "was rounded to a `transmissionFactor` of 0 or 1",
                );
            }
        }
        let surface = self.surface(item, &finish);
        let material = Material {
            emission: self.emission(item, emissive, two_sided)?,
            alpha: self.alpha(item, base, opacity)?,
            ..Material::new(item.name(), surface)
        };
        Ok((material, uv_set))
    }

    /// The metallic-roughness part of a material, its base texture and the opacity of its base.
    fn finish(&mut self, item: &Item<'a>) -> Result<(Finish, Option<Texture>, f32), Diagnostic> {
        let mut finish = Finish {
            base: Color::Constant(Vec3::ONE),
            metallic: 1.0,
            roughness: 1.0,
            eta: 1.5,
            specular: true,
            transmission: 0.0,
        };
        let Some(pbr) = item.get("pbrMetallicRoughness")? else {
            return Ok((finish, None, 1.0));
        };
        let factor = pbr.numbers_or("baseColorFactor", [1.0; 4])?.map(share);
        let [Some(r), Some(g), Some(b), Some(opacity)] = factor else {
            return Err(pbr.error("expected a `baseColorFactor` from 0 to 1"));
        };
        let factor = Vec3::new(r, g, b);
        let base = self.texture(&pbr, "baseColorTexture")?;
        finish.base = match base {
            None => Color::Constant(factor),
            Some(texture) => Color::Image(self.color_image(texture, factor)),
        };
        finish.metallic = pbr.share_or("metallicFactor", 1.0)?;
        finish.roughness = pbr.share_or("roughnessFactor", 1.0)?;
        if let Some(texture) = self.texture(&pbr, "metallicRoughnessTexture")? {
            // Roughness is in green, metalness in blue.
            let mean = self.mean_of_data(texture);
            finish.roughness *= mean.y;
            finish.metallic *= mean.z;
            if let Some(member) = pbr.get("metallicRoughnessTexture")? {
                self.warn(&member, "was taken as its mean");
            }
        }
        Ok((finish, base, opacity))
    }

    /// The closest surface model to a mixture of metal, glass and lacquer.
    fn surface(&mut self, item: &Item<'a>, finish: &Finish) -> Surface {
        // Perceived roughness to the width of the microfacet distribution.
        let alpha = Vec2::splat(finish.roughness * finish.roughness);
        let reflectance = finish.base;
        if finish.metallic != 0.0 && finish.metallic != 1.0 {
            self.warn(
                item,
                "is partly metallic and was taken as the nearer of metal and none",
            );
        }
        if finish.metallic >= 0.5 {
            return Surface::conductor_of_reflectance(self.one_color(item, reflectance), alpha);
        }
        if finish.transmission >= 0.5 {
            if self.one_color(item, reflectance) != Vec3::ONE {
                self.warn(item, "transmits light and was taken as clear");
            }
            return if item_is_solid(item) {
                Surface::Dielectric {
                    eta: finish.eta,
                    alpha,
                }
            } else {
                Surface::ThinDielectric { eta: finish.eta }
            };
        }
        if finish.specular && finish.eta != 1.0 {
            Surface::CoatedDiffuse {
                reflectance,
                eta: finish.eta,
                alpha,
            }
        } else {
            Surface::Diffuse { reflectance }
        }
    }

    /// One colour, for a surface model that takes no texture.
    fn one_color(&mut self, item: &Item<'a>, color: Color) -> Vec3 {
        if let Color::Image(_) = color {
            self.warn(
                item,
                "has a base colour whose texture was taken as its mean",
            );
        }
        self.scene.mean(&color)
    }

    /// Emission is in nits where its colour is white.
    fn emission(
        &mut self,
        item: &Item<'a>,
        texture: Option<Texture>,
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
            return Ok(None);
        }
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
        base: Option<Texture>,
        opacity: f32,
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
        let scale = Vec3::splat(opacity);
        let opacity = match base.and_then(|texture| self.alpha_image(texture, scale)) {
            Some(image) => Color::Image(image),
            None if opacity == 1.0 => return Ok(None),
            None => Color::Constant(scale),
        };
        Ok(Some(Alpha { opacity, cutoff }))
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
