use lights::glam::Affine3A;
use lights::media::phase::{HenyeyGreenstein, Isotropic};
use lights::media::{AnyMedium, Homogeneous, Phase, Region, Substance};
use lights::sources::{MediumId, MediumInterface, Rgb};

use super::file_loc::{FileLoc, Typed};
use super::medium_slot::MediumSlot;
use super::state::Reader;
use super::tokens::{Token, Tokens};
use crate::glam::Vec3;
use crate::text::shown;
use crate::{Diagnostic, Location, MaterialId, NamedMedium};

/// Names of what was measured: reduced scattering and absorption per millimetre, for red, green and
/// blue light.
///
/// # Source
/// `[Jensen2001]`, figure 5.
const PRESETS: [(&str, [f32; 3], [f32; 3]); 12] = [
    ("Apple", [2.29, 2.39, 1.97], [0.003, 0.0034, 0.046]),
    ("Chicken1", [0.15, 0.21, 0.38], [0.015, 0.077, 0.19]),
    ("Chicken2", [0.19, 0.25, 0.32], [0.018, 0.088, 0.2]),
    ("Cream", [7.38, 5.47, 3.15], [0.0002, 0.0028, 0.0163]),
    ("Ketchup", [0.18, 0.07, 0.03], [0.061, 0.97, 1.45]),
    ("Marble", [2.19, 2.62, 3.0], [0.0021, 0.0041, 0.0071]),
    ("Potato", [0.68, 0.7, 0.55], [0.0024, 0.009, 0.12]),
    ("Skimmilk", [0.7, 1.22, 1.9], [0.0014, 0.0025, 0.0142]),
    ("Skin1", [0.74, 0.88, 1.01], [0.032, 0.17, 0.48]),
    ("Skin2", [1.09, 1.59, 1.79], [0.013, 0.07, 0.145]),
    ("Spectralon", [11.6, 20.4, 14.9], [0.0, 0.0, 0.0]),
    ("Wholemilk", [2.55, 3.21, 3.77], [0.0011, 0.0024, 0.014]),
];

impl Reader {
    /// `MakeNamedMedium "name" "string type" ...`.
    pub(super) fn make_medium(&mut self, typed: &Typed<'_>) -> Result<(), Diagnostic> {
        let kind = typed.parameters.string("type").unwrap_or_default();
        let medium = match kind {
            "homogeneous" => self.homogeneous(typed)?,
            "uniformgrid" => self.uniform_grid(typed)?,
            "rgbgrid" => self.rgb_grid(typed)?,
            "cloud" => self.cloud(typed)?,
            "" => return Err(refused(typed, "expected \"string type\"")),
            "nanovdb" => {
                let message = "is not read and was taken as vacuum; `nanovdb2pbrt FILE.nvdb` of \
                               pbrt-v4 prints its grid as a \"uniformgrid\"";
                self.warn(typed.at, "the medium type \"nanovdb\"", message);
                typed.parameters.accept_all();
                vacuum(typed)?
            }
            other => {
                let what = format!("the medium type \"{}\"", shown(other));
                self.warn(typed.at, &what, "is not understood and was taken as vacuum");
                vacuum(typed)?
            }
        };
        let id = self.medium_id(typed.at, &typed.kind);
        let slot = &mut self.media[id.index() as usize];
        if slot.medium.replace(medium).is_some() {
            return Err(refused(typed, "expected one description, found another"));
        }
        Ok(())
    }

    /// `MediumInterface "inside" "outside"`; one name is for both, an empty one for vacuum.
    pub(super) fn medium_interface(
        &mut self,
        at: FileLoc<'_>,
        tokens: &mut Tokens<'_>,
    ) -> Result<(), Diagnostic> {
        let inside = tokens.quoted("a medium's name")?.into_owned();
        let outside = match tokens.peek()? {
            Some(Token::Quoted(name)) => {
                let name = name.into_owned();
                tokens.next()?;
                name
            }
            _ => inside.clone(),
        };
        let [inside, outside] =
            [inside, outside].map(|name| (!name.is_empty()).then(|| self.medium_id(at, &name)));
        self.state.media = MediumInterface { inside, outside };
        Ok(())
    }

    /// The twin of a material that bounds the media in force.
    pub(super) fn with_media(&mut self, material: MaterialId) -> MaterialId {
        let media = self.state.media;
        if media.inside == media.outside {
            return material;
        }
        let bounds = (material, media);
        match self.interfaces.get(&bounds) {
            Some(&twin) => twin,
            None => {
                let twin = self.twin(material, |twin| twin.media = media);
                *self.interfaces.entry(bounds).or_insert(twin)
            }
        }
    }

    /// All media, after the last directive.
    pub(super) fn finished_media(&mut self) -> Result<Vec<NamedMedium>, Diagnostic> {
        let slots = self.media.drain(..).map(|slot| match slot.medium {
            Some(medium) => Ok(NamedMedium {
                name: slot.name,
                medium,
            }),
            None => {
                let (path, line) = slot.first_use;
                let message = format!("expected a named medium, found \"{}\"", shown(&slot.name));
                Err(Diagnostic::at(&path, Location::Line(line), message))
            }
        });
        slots.collect()
    }

    fn medium_id(&mut self, at: FileLoc<'_>, name: &str) -> MediumId {
        let known = self.media_by_name.get(name).copied();
        let index = known.unwrap_or_else(|| {
            let index = self.media.len();
            self.media_by_name.insert(name.to_owned(), index);
            self.media.push(MediumSlot {
                name: name.to_owned(),
                first_use: (at.path.to_path_buf(), at.line),
                medium: None,
            });
            index
        });
        let id = u32::try_from(index).ok().and_then(MediumId::new);
        id.expect("fewer than 2^32 - 1 media")
    }

    fn homogeneous(&mut self, typed: &Typed<'_>) -> Result<AnyMedium<Rgb>, Diagnostic> {
        let [sigma_s, sigma_a] = match self.preset(typed) {
            Some(measured) => measured,
            None => ["sigma_s", "sigma_a"].map(|name| self.coefficient(typed, name, Vec3::ONE)),
        };
        let le = self.glow(typed) * typed.parameters.amount_or("Lescale", 1.0);
        let scale = typed.parameters.amount_or("scale", 1.0);
        everywhere(typed, [sigma_a, sigma_s], scale, le)
    }

    /// Scattering and absorption of the preset that the file names: it counts before the file's own
    /// coefficients.
    fn preset(&mut self, typed: &Typed<'_>) -> Option<[Vec3; 2]> {
        let name = typed.parameters.string("preset")?;
        let found = PRESETS.iter().find(|(preset, ..)| *preset == name);
        if found.is_none() {
            let what = format!("the preset \"{}\"", shown(name));
            self.warn(typed.at, &what, "is not known");
        }
        found.map(|(_, sigma_s, sigma_a)| [Vec3::from(*sigma_s), Vec3::from(*sigma_a)])
    }

    /// A coefficient per unit of length.
    pub(super) fn coefficient(&mut self, typed: &Typed<'_>, name: &str, default: Vec3) -> Vec3 {
        let value = typed.parameters.unbounded(name);
        if value.is_none() && typed.parameters.has(name) {
            let what = format!("the spectrum of `{name}`");
            self.warn(typed.at, &what, "is not understood; the default was taken");
        }
        value.unwrap_or(default)
    }

    /// The emission `Le`, black by default.
    pub(super) fn glow(&mut self, typed: &Typed<'_>) -> Vec3 {
        if typed.parameters.has("Le") {
            self.emission(typed, "Le")
        } else {
            Vec3::ZERO
        }
    }

    /// The transform from medium space to the scene.
    pub(super) fn medium_to_scene(&self) -> Affine3A {
        Affine3A::from_mat4(self.state.transform)
    }
}

/// A homogeneous medium.
fn everywhere(
    typed: &Typed<'_>,
    coefficients: [Vec3; 2],
    scale: f32,
    le: Vec3,
) -> Result<AnyMedium<Rgb>, Diagnostic> {
    Ok(Homogeneous {
        substance: substance(typed, coefficients, scale, le)?,
        phase: phase(typed)?,
        region: Region::UNBOUNDED,
    }
    .into())
}

/// Vacuum.
fn vacuum(typed: &Typed<'_>) -> Result<AnyMedium<Rgb>, Diagnostic> {
    everywhere(typed, [Vec3::ZERO; 2], 1.0, Vec3::ZERO)
}

/// The substance of given absorption and scattering.
pub(super) fn substance(
    typed: &Typed<'_>,
    [sigma_a, sigma_s]: [Vec3; 2],
    scale: f32,
    le: Vec3,
) -> Result<Substance<Rgb>, Diagnostic> {
    Substance::new(sigma_a * scale, sigma_s * scale, le).map_err(|error| refused(typed, error))
}

/// The phase function.
pub(super) fn phase(typed: &Typed<'_>) -> Result<Phase, Diagnostic> {
    let g = typed.parameters.number_or("g", 0.0);
    if g == 0.0 {
        return Ok(Phase::Isotropic(Isotropic));
    }
    let phase = HenyeyGreenstein::new(g).map_err(|error| refused(typed, error))?;
    Ok(Phase::HenyeyGreenstein(phase))
}

/// The error of an invalid medium.
pub(super) fn refused(typed: &Typed<'_>, what: impl core::fmt::Display) -> Diagnostic {
    let name = shown(&typed.kind);
    typed.at.diagnostic(format!("medium \"{name}\": {what}"))
}
