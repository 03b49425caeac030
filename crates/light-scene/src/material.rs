use lights::sources::MediumInterface;

use crate::glam::{Vec2, Vec3};
use crate::{Color, ColorImage, MaterialId, MetallicRoughness};

/// How a surface scatters and emits light.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Material {
    /// The name in the file.
    pub name: String,
    /// How it scatters light.
    pub surface: Surface,
    /// The light it emits, if any.
    pub emission: Option<Emission>,
    /// The alpha mask; `None` for an opaque surface.
    pub alpha: Option<Alpha>,
    /// Normals in tangent space: an image of colours `c` stands for vectors `2 c - 1`, each channel
    /// times the scale of the image, along the tangent (toward u), the bitangent (toward v) and the
    /// normal. It does not move the surface, and lights do not know it.
    pub normal_map: Option<ColorImage>,
    /// What becomes of rays that arrive from behind.
    pub back_faces: BackFaces,
    /// The media behind and in front of the surface; where both are the same, it does not bound a
    /// medium, and rays stay in the one that they come from.
    pub media: MediumInterface,
}

/// Whether a surface is there for rays that arrive at its back.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub enum BackFaces {
    /// It is.
    #[default]
    Visible,
    /// Such rays pass, be they from the camera, from other surfaces, or toward lights. Spheres have
    /// no back faces that are culled.
    Culled,
}

/// How a surface scatters light. Reflectances lie in [0, 1], channel by channel.
///
/// `alpha` are the widths of the microfacet distribution (GGX) along u and v; (0, 0) is perfectly
/// smooth. `eta` is the index of refraction on the back side of the surface over that on its front.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub enum Surface {
    /// Scatters alike in all directions of the hemisphere (Lambert), on both sides.
    Diffuse {
        /// Reflected share.
        reflectance: Color,
    },
    /// Scatters alike in all directions of both hemispheres, as paper or a leaf does.
    DiffuseTransmission {
        /// Share that leaves on the side it came from.
        reflectance: Color,
        /// Share that leaves on the other side.
        transmittance: Color,
    },
    /// Reflects as a plane mirror, the same share at every angle.
    Mirror {
        /// Reflected share.
        reflectance: Vec3,
    },
    /// A metal: GGX microfacets with the Fresnel factor of a conductor.
    Conductor {
        /// Real part of the index of refraction.
        eta: Vec3,
        /// Imaginary part (absorption).
        k: Vec3,
        /// Roughness.
        alpha: Vec2,
    },
    /// Glass or water: GGX microfacets that reflect and refract.
    Dielectric {
        /// Relative index of refraction.
        eta: f32,
        /// Roughness.
        alpha: Vec2,
    },
    /// A thin pane: reflects and lets through without bending.
    ThinDielectric {
        /// Index of refraction of the pane.
        eta: f32,
    },
    /// A diffuse base under a clear coat, as lacquered wood or plastic.
    CoatedDiffuse {
        /// Reflected share of the base.
        reflectance: Color,
        /// Index of refraction of the coat.
        eta: f32,
        /// Roughness of the coat.
        alpha: Vec2,
    },
    /// A metal, a dielectric over a diffuse base, or a mixture of both.
    MetallicRoughness(Box<MetallicRoughness>),
    /// A metal under a clear coat, as lacquered brass.
    CoatedConductor {
        /// Real part of the index of refraction of the metal, relative to the outside.
        eta: Vec3,
        /// Imaginary part (absorption).
        k: Vec3,
        /// Roughness of the metal.
        alpha: Vec2,
        /// Index of refraction of the coat.
        coat_eta: f32,
        /// Roughness of the coat.
        coat_alpha: Vec2,
    },
    /// The surface of one of two materials at each point, chosen at random: paint that comes off,
    /// dust on a metal.
    Mix {
        /// The two; only their surfaces are used. One that does not come before this material in
        /// the scene's list counts as black.
        materials: [MaterialId; 2],
        /// The probability of the second, in [0, 1]; the first channel of a colour.
        amount: Color,
    },
    /// Invisible: light passes unchanged. It only bounds a medium.
    Interface,
}

/// An alpha mask. Where the opacity is 0, rays pass and nothing is emitted.
///
/// An emissive surface of constant opacity 0 without a cutoff is an exception, for the sake of pbrt
/// files: it is an invisible light, which emits as if it were opaque and which no ray hits. Like a
/// point light it is found by light samples alone, and weighted against no other strategy. Files of
/// other formats make none of it: there a lamp that is wholly transparent emits nothing.
///
/// # Source
/// `DiffuseAreaLight` of `[PBRT4]`, which takes the mask away from such a light and gives it the
/// type of a point light.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Alpha {
    /// The probability, in [0, 1], that a ray hits the surface; the first channel of a colour.
    pub opacity: Color,
    /// If present, the surface is opaque where the opacity is at least this, and fully transparent
    /// elsewhere.
    pub cutoff: Option<f32>,
}

/// Light that a surface emits, the same in all directions.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Emission {
    /// Radiance, in W m^-2 sr^-1 per channel of linear RGB.
    pub radiance: Color,
    /// Which sides emit.
    pub sides: EmissionSides,
}

/// Which sides of a surface emit light.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
pub enum EmissionSides {
    /// Only the side from which the vertices run counter-clockwise.
    Front,
    /// Both, each with the full radiance.
    Both,
}

impl Alpha {
    /// Whether the surface is nowhere: constant opacity 0 without a cutoff.
    pub(crate) fn hides_all(&self) -> bool {
        let opacity = match self.opacity {
            Color::Constant(opacity) => opacity.x,
            Color::Image(_) => return false,
        };
        opacity <= 0.0 && self.cutoff.is_none()
    }
}

impl Material {
    /// A diffuse material of one colour without emission.
    #[must_use]
    pub fn diffuse(name: impl Into<String>, reflectance: Vec3) -> Self {
        let reflectance = Color::Constant(reflectance);
        Self::new(name, Surface::Diffuse { reflectance })
    }

    /// A material with this surface, without emission and alpha mask.
    #[must_use]
    pub fn new(name: impl Into<String>, surface: Surface) -> Self {
        Self {
            name: name.into(),
            surface,
            emission: None,
            alpha: None,
            normal_map: None,
            back_faces: BackFaces::default(),
            media: MediumInterface::default(),
        }
    }
}

impl Surface {
    /// The conductor of reflectance `reflectance` at normal incidence, with index of
    /// refraction 1.
    ///
    /// Reflectances are clamped to 0.9999, as 1 would need infinite absorption.
    #[must_use]
    pub(crate) fn conductor_of_reflectance(reflectance: Vec3, alpha: Vec2) -> Self {
        let r = reflectance.clamp(Vec3::ZERO, Vec3::splat(0.9999));
        // With eta = 1 the normal reflectance is k^2 / (4 + k^2).
        let k = r.map(|r| 2.0 * (r / (1.0 - r)).sqrt());
        Self::Conductor {
            eta: Vec3::ONE,
            k,
            alpha,
        }
    }
}

impl Emission {
    /// Emission of one radiance on the front side.
    #[must_use]
    pub const fn one_sided(radiance: Vec3) -> Self {
        Self {
            radiance: Color::Constant(radiance),
            sides: EmissionSides::Front,
        }
    }

    /// Emission of one radiance on both sides.
    #[must_use]
    pub const fn two_sided(radiance: Vec3) -> Self {
        Self {
            radiance: Color::Constant(radiance),
            sides: EmissionSides::Both,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn conductor_has_the_requested_reflectance() {
        let requested = Vec3::new(0.0, 0.5, 1.0);
        let Surface::Conductor { eta, k, .. } =
            Surface::conductor_of_reflectance(requested, Vec2::ZERO)
        else {
            panic!("a conductor");
        };
        let got = ((eta - 1.0) * (eta - 1.0) + k * k) / ((eta + 1.0) * (eta + 1.0) + k * k);
        assert!(got.abs_diff_eq(requested, 2e-4), "got {got}");
    }
}
