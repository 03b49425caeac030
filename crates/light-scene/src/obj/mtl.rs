//! Material libraries: which of MTL's many parameters mean what here.

use alloc::collections::BTreeSet;
use std::path::Path;

use crate::glam::{Vec2, Vec3};
use crate::text::{Line, logical_lines, shown};
use crate::{Color, Diagnostic, Emission, Material, MaterialId, Scene, Surface};

/// Adds the materials of a library to the scene; what comes back is their names and ids.
pub(super) fn parse_mtl(
    path: &Path,
    text: &str,
    scene: &mut Scene,
) -> Result<Vec<(String, MaterialId)>, Diagnostic> {
    let mut described: Vec<Description> = Vec::new();
    let mut ignored = BTreeSet::new();
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
    diffuse: Vec3,
    specular: Vec3,
    emitted: Vec3,
    index_of_refraction: f32,
    roughness: f32,
    metallic: f32,
    illumination: u8,
}

impl Description {
    fn new(name: String) -> Self {
        Self {
            name,
            diffuse: Vec3::splat(0.5),
            specular: Vec3::ZERO,
            emitted: Vec3::ZERO,
            index_of_refraction: 1.5,
            roughness: 0.5,
            metallic: 0.0,
            illumination: 2,
        }
    }

    /// Takes in one line; whether its keyword is understood.
    fn parameter(&mut self, keyword: &str, line: &mut Line<'_>) -> Result<bool, Diagnostic> {
        match keyword {
            "Kd" => self.diffuse = color(line)?.clamp(Vec3::ZERO, Vec3::ONE),
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
        // Emission of a material that does not emit is written as `Ke 0 0 0` by most exporters.
        let emission = (self.emitted != Vec3::ZERO).then(|| Emission::one_sided(self.emitted));
        Material {
            emission,
            ..Material::new(self.name.clone(), self.surface())
        }
    }

    fn surface(&self) -> Surface {
        // Perceived roughness to the width of the microfacet distribution, as exporters of `Pr` mean it.
        let alpha = Vec2::splat(self.roughness * self.roughness);
        match self.illumination {
            _ if self.metallic >= 0.5 => Surface::conductor_of_reflectance(self.diffuse, alpha),
            5 => Surface::Mirror {
                reflectance: self.specular,
            },
            4 | 6 | 7 | 9 if self.index_of_refraction > 0.0 => Surface::Dielectric {
                eta: self.index_of_refraction,
                alpha: Vec2::ZERO,
            },
            _ => Surface::Diffuse {
                reflectance: Color::Constant(self.diffuse),
            },
        }
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
