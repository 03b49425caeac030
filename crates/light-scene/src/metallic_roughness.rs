use crate::Color;
use crate::glam::Vec3;

/// A metal, a dielectric over a diffuse base, or a mixture of both, as glTF describes surfaces.
///
/// # Source
/// `[GLTF]`, appendix B.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct MetallicRoughness {
    /// The reflectance of the metal at normal incidence, and of the base below the dielectric, in
    /// `[0, 1]`.
    pub base_color: Color,
    /// In the second channel the roughness, the root of the width of the microfacet distribution
    /// (GGX); in the third the share of metal; both in `[0, 1]`. The first has no meaning.
    pub roughness_metallic: Color,
    /// The reflectance of the dielectric at normal incidence, in `[0, 1]`.
    pub f0: Vec3,
    /// The reflectance of the dielectric at grazing incidence, in `[0, 1]`.
    pub f90: f32,
    /// A clear coat of index 1.5 above all.
    pub clearcoat: Option<Clearcoat>,
}

/// A clear coat.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Clearcoat {
    /// In the first channel the share of the surface that is coated, in `[0, 1]`.
    pub weight: Color,
    /// In the second channel the root of the width of its microfacets, in `[0, 1]`.
    pub roughness: Color,
}
