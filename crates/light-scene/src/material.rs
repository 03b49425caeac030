use lights::sources::{MediumInterface, TextureMapping};

use crate::glam::{Vec2, Vec3};
use crate::{ImageId, MaterialId};

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
    /// The media behind and in front of the surface; where both are the same, it does not bound a
    /// medium, and rays stay in the one that they come from.
    pub media: MediumInterface,
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

/// A colour over a surface: linear RGB, one value or an image.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub enum Color {
    /// The same everywhere.
    Constant(Vec3),
    /// From an image, by the mesh's texture coordinates.
    Image(ColorImage),
}

/// An alpha mask. Where the opacity is 0, rays pass and nothing is emitted.
///
/// An emissive surface of constant opacity 0 without a cutoff is an exception: it emits as if it
/// were opaque, and rays do not hit it.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Alpha {
    /// The probability, in [0, 1], that a ray hits the surface; the first channel of a colour.
    pub opacity: Color,
    /// If present, the surface is opaque where the opacity is at least this, and fully transparent
    /// elsewhere.
    pub cutoff: Option<f32>,
}

/// An image over texture coordinates, times a factor.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct ColorImage {
    /// The image.
    pub image: ImageId,
    /// Multiplies every texel.
    pub scale: Vec3,
    /// From texture coordinates to the image, with the rule beyond its edges.
    pub mapping: TextureMapping,
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
            media: MediumInterface::default(),
        }
    }
}

impl ColorImage {
    /// The image without scaling, repeated.
    #[must_use]
    pub const fn new(image: ImageId) -> Self {
        Self {
            image,
            scale: Vec3::ONE,
            mapping: TextureMapping::REPEAT,
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
