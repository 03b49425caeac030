use super::file_loc::Typed;
use super::parameter::ParameterType;
use super::state::Reader;
use crate::glam::{Vec2, Vec3};
use crate::{Color, Diagnostic, Material, MaterialId, Surface};

/// Name, index of refraction and absorption.
type Metal = (&'static str, [f32; 3], [f32; 3]);

/// Metals by the names of their spectra: index of refraction and absorption for red, green and blue
/// light.
const METALS: [Metal; 5] = [
    ("metal-Ag", [0.155, 0.117, 0.138], [4.828, 3.122, 2.147]),
    ("metal-Al", [1.657, 0.880, 0.521], [9.224, 6.270, 4.837]),
    ("metal-Au", [0.143, 0.375, 1.442], [3.983, 2.386, 1.603]),
    ("metal-CuZn", [0.444, 0.527, 1.094], [3.695, 2.765, 1.829]),
    ("metal-Cu", [0.200, 0.924, 1.102], [3.912, 2.452, 2.142]),
];

impl Reader {
    /// A material of this kind with the parameters of `typed`.
    pub(super) fn make_material(
        &mut self,
        kind: &str,
        typed: &Typed<'_>,
    ) -> Result<MaterialId, Diagnostic> {
        let parameters = &typed.parameters;
        let surface = match kind {
            "mix" => self.mixed(typed)?,
            "diffuse" => Surface::Diffuse {
                reflectance: self.color(typed, "reflectance", 0.5),
            },
            "diffusetransmission" => Surface::DiffuseTransmission {
                reflectance: self.color(typed, "reflectance", 0.25),
                transmittance: self.color(typed, "transmittance", 0.25),
            },
            "coateddiffuse" => Surface::CoatedDiffuse {
                reflectance: self.color(typed, "reflectance", 0.5),
                eta: self.eta(typed, "eta"),
                alpha: self.facets(typed, ""),
            },
            "dielectric" => Surface::Dielectric {
                eta: self.eta(typed, "eta"),
                alpha: self.facets(typed, ""),
            },
            "thindielectric" => Surface::ThinDielectric {
                eta: self.eta(typed, "eta"),
            },
            "conductor" => self.conductor(typed, ""),
            "coatedconductor" => self.coated_conductor(typed),
            "interface" | "" => Surface::Interface,
            other => {
                let what = format!("material \"{other}\"");
                let expected = "is not understood and was taken as diffuse: expected \
                                coatedconductor, coateddiffuse, conductor, dielectric, diffuse, \
                                diffusetransmission, interface, mix or thindielectric";
                self.warn(typed.at, &what, expected);
                Surface::Diffuse {
                    reflectance: self.color(typed, "reflectance", 0.5),
                }
            }
        };
        self.warn_unused(typed.at, &format!("material \"{kind}\""), parameters);
        Ok(self.scene.add_material(Material::new(kind, surface)))
    }

    /// The index of refraction of something clear: a number, a glass by name, or a spectrum seen as
    /// one colour.
    fn eta(&mut self, typed: &Typed<'_>, name: &str) -> f32 {
        const DEFAULT: f32 = 1.5;
        let parameters = &typed.parameters;
        if !parameters.has(name) {
            return DEFAULT;
        }
        if parameters.kind(name) == Some(ParameterType::Float) {
            return parameters.positive_or(name, DEFAULT);
        }
        if let Some(glass) = parameters.spectrum_name(name) {
            return named_glass(glass).unwrap_or_else(|| {
                let what = format!("the glass \"{glass}\"");
                self.warn(typed.at, &what, "is not known; an index of 1.5 was taken");
                DEFAULT
            });
        }
        let mean = parameters
            .unbounded(name)
            .map(|rgb| rgb.element_sum() / 3.0);
        if mean == Some(0.0) {
            parameters.refuse(name, format!("expected `{name}` above 0"));
        }
        mean.unwrap_or(DEFAULT)
    }

    /// A mixture of two named materials; the amount is that of the second.
    fn mixed(&mut self, typed: &Typed<'_>) -> Result<Surface, Diagnostic> {
        let [first, second] = typed.parameters.strings("materials") else {
            let message = "expected \"string materials\" with two names";
            return Err(typed.at.diagnostic(message));
        };
        let materials = [first, second].map(|name| self.named_material(typed.at, name));
        Ok(Surface::Mix {
            materials,
            amount: self.share(typed, "amount", 0.5),
        })
    }

    /// A metal; `prefix` precedes the names of its parameters.
    fn conductor(&mut self, typed: &Typed<'_>, prefix: &str) -> Surface {
        let parameters = &typed.parameters;
        let alpha = self.facets(typed, prefix);
        if parameters.has("reflectance") {
            let reflectance = self.color(typed, "reflectance", 1.0);
            if let Color::Image(_) = reflectance {
                let what = "a conductor's textured `reflectance`";
                self.warn(typed.at, what, "was taken as its mean");
            }
            return Surface::conductor_of_reflectance(self.scene.mean(&reflectance), alpha);
        }
        let eta = self.of_metal(typed, &format!("{prefix}eta"), |(_, eta, _)| *eta);
        let k = self.of_metal(typed, &format!("{prefix}k"), |(_, _, k)| *k);
        Surface::Conductor { eta, k, alpha }
    }

    /// A metal under a coat, whose depth and fog have no part here.
    fn coated_conductor(&mut self, typed: &Typed<'_>) -> Surface {
        for name in ["thickness", "maxdepth", "nsamples"] {
            typed.parameters.accept(name);
        }
        let coat_eta = self.eta(typed, "interface.eta");
        let coat_alpha = self.facets(typed, "interface.");
        match self.conductor(typed, "conductor.") {
            Surface::Conductor { eta, k, alpha } => Surface::CoatedConductor {
                eta,
                k,
                alpha,
                coat_eta,
                coat_alpha,
            },
            other => other,
        }
    }

    /// The optical constants of a metal, by numbers or by name; copper by default.
    fn of_metal(&mut self, typed: &Typed<'_>, name: &str, of: impl Fn(&Metal) -> [f32; 3]) -> Vec3 {
        let copper = Vec3::from(of(&METALS[4]));
        let Some(metal) = typed.parameters.spectrum_name(name) else {
            return typed.parameters.unbounded(name).unwrap_or(copper);
        };
        let known = METALS.iter().find(|(known, ..)| metal.starts_with(known));
        known.map_or_else(
            || {
                let what = format!("the metal \"{metal}\"");
                self.warn(typed.at, &what, "is not known and was taken as copper");
                copper
            },
            |known| Vec3::from(of(known)),
        )
    }

    /// The widths of the microfacet distribution; `prefix` precedes the names of its
    /// parameters.
    fn facets(&mut self, typed: &Typed<'_>, prefix: &str) -> Vec2 {
        let mut roughness = |name| self.plain_number(typed, &format!("{prefix}{name}"));
        let both = roughness("roughness").unwrap_or(0.0);
        let [u, v] = ["uroughness", "vroughness"].map(|name| roughness(name).unwrap_or(both));
        let roughness = Vec2::new(u, v).max(Vec2::ZERO);
        if typed.parameters.is_true("remaproughness", true) {
            roughness.map(f32::sqrt)
        } else {
            roughness
        }
    }
}

/// The index of refraction of a glass at 587.6 nm.
fn named_glass(name: &str) -> Option<f32> {
    Some(match name {
        "glass-BK7" => 1.5168,
        "glass-BAF10" => 1.6700,
        "glass-FK51A" => 1.4866,
        "glass-LASF9" => 1.8503,
        "glass-F5" | "glass-SF5" => 1.6727,
        "glass-F10" | "glass-SF10" => 1.7283,
        "glass-F11" | "glass-SF11" => 1.7847,
        _ => return None,
    })
}
