//! Material libraries: which of MTL's many parameters mean what here.

use alloc::collections::BTreeSet;
use std::collections::HashMap;
use std::path::Path;

use crate::glam::{Vec2, Vec3};
use crate::image::{is_image_name, read_image_from};
use crate::text::{Line, logical_lines, shown};
use crate::{
    Color, ColorImage, Diagnostic, Emission, EmissionSides, Files, ImageId, Material, MaterialId,
    Scene, Surface,
};

/// Adds the materials of a library to the scene; what comes back is their names and ids.
pub(super) fn parse_mtl(
    path: &Path,
    text: &str,
    files: Files<'_>,
    scene: &mut Scene,
) -> Result<Vec<(String, MaterialId)>, Diagnostic> {
    let mut described: Vec<Description> = Vec::new();
    let mut ignored = BTreeSet::new();
    let mut textures = Textures::default();
    for (number, text) in logical_lines(text) {
        let mut line = Line::new(path, number, &text);
        let Some(keyword) = line.word() else {
            continue;
        };
        if keyword == "newmtl" {
            described.push(Description::new(line.rest("a material's name")?));
            continue;
        }
        let Some(material) = described.last_mut() else {
            let message = format!("expected `newmtl NAME` before `{}`", shown(keyword));
            return Err(line.diagnostic(message));
        };
        if let "map_Kd" | "map_Ke" = keyword {
            let image = textures.load(keyword, &mut line, files, scene)?;
            match keyword {
                "map_Kd" => material.diffuse_map = image,
                _ => material.emitted_map = image,
            }
            continue;
        }
        let understood = material.parameter(keyword, &mut line)?;
        if !understood && ignored.insert(keyword.to_owned()) {
            let message = format!("`{}` is not understood and was ignored", shown(keyword));
            scene.warnings.push(line.diagnostic(message));
        }
    }
    if described.is_empty() {
        let message = "expected at least one material (`newmtl NAME`)";
        return Err(Diagnostic::file(path, message));
    }
    let add = |material: Description| {
        let name = material.name.clone();
        (name, scene.add_material(material.into_material()))
    };
    Ok(described.into_iter().map(add).collect())
}

/// One material as the library writes it.
#[derive(Debug)]
struct Description {
    name: String,
    diffuse: Option<Vec3>,
    diffuse_map: Option<ImageId>,
    specular: Vec3,
    emitted: Vec3,
    emitted_map: Option<ImageId>,
    index_of_refraction: f32,
    roughness: f32,
    metallic: f32,
    illumination: u8,
}

impl Description {
    fn new(name: String) -> Self {
        Self {
            name,
            diffuse: None,
            diffuse_map: None,
            specular: Vec3::ZERO,
            emitted: Vec3::ZERO,
            emitted_map: None,
            index_of_refraction: 1.5,
            roughness: 0.5,
            metallic: 0.0,
            illumination: 2,
        }
    }

    /// Takes in one line; whether its keyword is understood.
    fn parameter(&mut self, keyword: &str, line: &mut Line<'_>) -> Result<bool, Diagnostic> {
        match keyword {
            "Kd" => self.diffuse = Some(color(line)?.clamp(Vec3::ZERO, Vec3::ONE)),
            "Ks" => self.specular = color(line)?.clamp(Vec3::ZERO, Vec3::ONE),
            "Ke" => self.emitted = color(line)?,
            "Ni" => self.index_of_refraction = at_least_zero(line, "an index of refraction")?,
            "Pr" => self.roughness = at_least_zero(line, "a roughness")?.min(1.0),
            "Pm" => self.metallic = at_least_zero(line, "a metalness")?.min(1.0),
            "illum" => self.illumination = illumination(line)?,
            // Ambient light and the exponent of a highlight have no place where light is traced.
            "Ka" | "Ns" => {}
            _ => return Ok(false),
        }
        Ok(true)
    }

    fn into_material(self) -> Material {
        Material {
            emission: self.emission(),
            ..Material::new(self.name.clone(), self.surface())
        }
    }

    fn emission(&self) -> Option<Emission> {
        // Emission of a material that does not emit is written as `Ke 0 0 0` by most exporters.
        let shines = self.emitted != Vec3::ZERO;
        let radiance = match self.emitted_map {
            Some(image) => {
                let scale = if shines { self.emitted } else { Vec3::ONE };
                Color::Image(ColorImage {
                    scale,
                    ..ColorImage::new(image)
                })
            }
            None if shines => Color::Constant(self.emitted),
            None => return None,
        };
        Some(Emission {
            radiance,
            sides: EmissionSides::Front,
        })
    }

    fn surface(&self) -> Surface {
        // Perceived roughness to the width of the microfacet distribution, as exporters of `Pr` mean it.
        let alpha = Vec2::splat(self.roughness * self.roughness);
        let diffuse = self.diffuse.unwrap_or(Vec3::splat(0.5));
        match self.illumination {
            _ if self.metallic >= 0.5 => Surface::conductor_of_reflectance(diffuse, alpha),
            5 => Surface::Mirror {
                reflectance: self.specular,
            },
            4 | 6 | 7 | 9 if self.index_of_refraction > 0.0 => Surface::Dielectric {
                eta: self.index_of_refraction,
                alpha: Vec2::ZERO,
            },
            _ => Surface::Diffuse {
                reflectance: match self.diffuse_map {
                    Some(image) => Color::Image(ColorImage {
                        scale: self.diffuse.unwrap_or(Vec3::ONE),
                        ..ColorImage::new(image)
                    }),
                    None => Color::Constant(diffuse),
                },
            },
        }
    }
}

/// The images of a library, each read once.
#[derive(Debug, Default)]
struct Textures {
    by_name: HashMap<String, ImageId>,
}

impl Textures {
    /// The image that a line names; none, with a warning, where its kind is not read.
    fn load(
        &mut self,
        keyword: &str,
        line: &mut Line<'_>,
        files: Files<'_>,
        scene: &mut Scene,
    ) -> Result<Option<ImageId>, Diagnostic> {
        let mut name = line.rest("a file name")?;
        if name.starts_with('-') {
            let message = format!("options of `{keyword}` were ignored");
            scene.warnings.push(line.diagnostic(message));
            name = name.split(' ').next_back().unwrap_or_default().to_owned();
        }
        if let Some(&image) = self.by_name.get(&name) {
            return Ok(Some(image));
        }
        let file = line.path().with_file_name(name.replace('\\', "/"));
        if !is_image_name(&file) {
            let name = shown(&name);
            let message = format!("`{name}` was ignored: expected .exr, .hdr, .png or .jpg");
            scene.warnings.push(line.diagnostic(message));
            return Ok(None);
        }
        let file =
            read_image_from(&file, files).map_err(|error| line.diagnostic(error.to_string()))?;
        scene.warnings.extend(file.warning);
        let image = scene.add_image(file.image);
        self.by_name.insert(name, image);
        Ok(Some(image))
    }
}

/// Three channels, or one for all of them.
fn color(line: &mut Line<'_>) -> Result<Vec3, Diagnostic> {
    let red = at_least_zero(line, "a colour channel")?;
    let Some(green) = line.optional_number("a colour channel")? else {
        return Ok(Vec3::splat(red));
    };
    let color = Vec3::new(red, green, line.number("a colour channel")?);
    if color.min_element() < 0.0 {
        return Err(line.diagnostic("expected colour channels of at least 0"));
    }
    Ok(color)
}

fn at_least_zero(line: &mut Line<'_>, what: &str) -> Result<f32, Diagnostic> {
    let number = line.number(what)?;
    if number < 0.0 {
        return Err(line.diagnostic(format!("expected {what} of at least 0, found {number}")));
    }
    Ok(number)
}

fn illumination(line: &mut Line<'_>) -> Result<u8, Diagnostic> {
    let word = line.word().unwrap_or_default();
    let model = word.parse::<u8>().ok().filter(|model| *model <= 10);
    model.ok_or_else(|| {
        let message = format!(
            "expected an illumination model of 0 to 10, found `{}`",
            shown(word)
        );
        line.diagnostic(message)
    })
}
