#![doc = include_str!("../README.md")]
#![no_std]
#![cfg_attr(docsrs, feature(doc_cfg))]
#![cfg_attr(
    not(feature = "alloc"),
    allow(
        rustdoc::broken_intra_doc_links,
        reason = "links to what owns memory are plain text where it is left out"
    )
)]
#![forbid(unsafe_code)]
#![warn(clippy::print_stdout, clippy::print_stderr)]

#[cfg(feature = "alloc")]
extern crate alloc;
#[cfg(feature = "std")]
extern crate std;

#[cfg(feature = "half")]
pub use half;
pub use light_bounds;
pub use light_bounds::glam;
pub use light_bounds::light_math;
pub use light_math::spectrum::photometric::{Candela, Lumen, Lux, Nit, Watt};

#[cfg(feature = "alloc")]
mod alpha_mask;
mod amount;
mod amount_scaled;
#[cfg(feature = "alloc")]
mod area;
#[cfg(feature = "alloc")]
mod area_desc;
#[cfg(feature = "alloc")]
mod bilinear_cells;
#[cfg(feature = "alloc")]
mod block_means;
#[cfg(feature = "alloc")]
mod channels;
mod color;
#[cfg(feature = "alloc")]
mod diffuse_emission;
#[cfg(feature = "alloc")]
mod diffuse_emission_desc;
mod distant;
#[cfg(feature = "alloc")]
mod emission_lobe;
#[cfg(feature = "alloc")]
mod environment_table;
#[cfg(feature = "alloc")]
mod equal_area_sky;
#[cfg(feature = "alloc")]
mod floor;
mod flux;
#[cfg(feature = "alloc")]
mod forward_light;
#[cfg(feature = "alloc")]
mod goniometric;
#[cfg(feature = "alloc")]
mod image;
#[cfg(feature = "alloc")]
mod image_behind;
#[cfg(feature = "alloc")]
mod image_error;
#[cfg(feature = "alloc")]
mod image_infinite;
#[cfg(feature = "alloc")]
mod image_infinite_desc;
#[cfg(feature = "alloc")]
mod image_sky;
#[cfg(feature = "alloc")]
mod lat_long_grid;
#[cfg(feature = "alloc")]
mod lat_long_sky;
#[cfg(feature = "alloc")]
mod level_quadrature;
mod light;
#[cfg(feature = "alloc")]
mod light_desc;
#[cfg(feature = "alloc")]
mod light_desc_from;
#[cfg(feature = "alloc")]
mod light_desc_scale;
#[cfg(feature = "alloc")]
mod light_kinds;
mod light_power;
#[cfg(feature = "alloc")]
mod light_ref;
mod light_sample;
#[cfg(feature = "alloc")]
mod light_set;
#[cfg(feature = "alloc")]
mod light_set_builder;
#[cfg(feature = "alloc")]
mod light_set_bytes;
#[cfg(feature = "alloc")]
mod light_set_groups;
#[cfg(feature = "alloc")]
mod light_set_placed;
#[cfg(feature = "alloc")]
mod light_set_update;
mod light_type;
#[cfg(feature = "alloc")]
mod mask_share;
#[cfg(feature = "alloc")]
mod mean_cache;
#[cfg(feature = "alloc")]
mod median_cut;
mod medium_interface;
#[cfg(feature = "alloc")]
mod mesh;
#[cfg(feature = "alloc")]
mod mesh_indices;
#[cfg(feature = "alloc")]
mod mis_compensation;
#[cfg(feature = "alloc")]
mod own_light;
#[cfg(feature = "alloc")]
mod parallel;
mod pdf_coverage;
#[cfg(feature = "alloc")]
mod picture_grid;
#[cfg(feature = "alloc")]
mod placed_mesh;
mod point;
mod point_source;
#[cfg(feature = "alloc")]
mod portal;
#[cfg(feature = "alloc")]
mod portal_infinite;
#[cfg(feature = "alloc")]
mod portal_infinite_desc;
#[cfg(feature = "alloc")]
mod projection;
#[cfg(feature = "alloc")]
mod radiant_powers;
#[cfg(feature = "alloc")]
mod resample;
mod rgb;
#[cfg(feature = "alloc")]
mod rgb_sum;
mod rigid_transform;
#[cfg(feature = "alloc")]
mod row_integral;
mod scaled_emission;
mod scene_sphere;
pub mod shape;
mod sides;
#[cfg(feature = "alloc")]
mod sky_irradiance;
#[cfg(feature = "alloc")]
mod sky_means;
#[cfg(feature = "alloc")]
mod sky_sample;
#[cfg(feature = "alloc")]
mod source_table;
mod spectral;
mod spectral_emission;
#[cfg(feature = "alloc")]
mod sphere_table;
mod spot;
mod spot_desc;
mod sun;
mod sun_desc;
mod surface_point;
#[cfg(feature = "alloc")]
mod surface_texture;
#[cfg(feature = "alloc")]
mod texel_sums;
#[cfg(feature = "alloc")]
mod texture;
#[cfg(feature = "alloc")]
mod texture_integral;
#[cfg(feature = "alloc")]
mod texture_mapping;
#[cfg(feature = "alloc")]
mod triangle_rules;
mod uniform_infinite;
#[cfg(feature = "alloc")]
mod uv_polygon;

#[cfg(feature = "alloc")]
pub use alpha_mask::AlphaMask;
pub use amount::{IntensityAmount, IrradianceAmount, RadianceAmount, SurfaceAmount};
#[cfg(feature = "alloc")]
pub use area::DiffuseAreaLight;
#[cfg(feature = "alloc")]
pub use area_desc::{AreaLightDesc, AreaLightError};
#[cfg(feature = "alloc")]
pub use channels::Channels;
pub use color::{ColorModel, Radiance};
#[cfg(feature = "alloc")]
pub use diffuse_emission::{DiffuseEmission, DiffuseEmissionError};
#[cfg(feature = "alloc")]
pub use diffuse_emission_desc::{DiffuseEmissionDesc, EmissionMask, SurfaceColor};
pub use distant::{DistantLight, DistantLightDesc, DistantLightError};
#[cfg(feature = "alloc")]
pub use environment_table::{ENVIRONMENT_CONSTANTS, EnvironmentTable};
pub use flux::Flux;
#[cfg(feature = "alloc")]
pub use goniometric::{GoniometricLight, GoniometricLightDesc, GoniometricLightError};
#[cfg(feature = "alloc")]
pub use image::Image;
#[cfg(feature = "alloc")]
pub use image_error::ImageError;
#[cfg(feature = "alloc")]
pub use image_infinite::ImageInfiniteLight;
#[cfg(feature = "alloc")]
pub use image_infinite_desc::{EnvironmentMap, ImageInfiniteLightDesc, ImageInfiniteLightError};
pub use light::{AreaLight, InfiniteLight, Light};
#[cfg(feature = "alloc")]
pub use light_desc::{LightDesc, LightDescError};
#[cfg(feature = "alloc")]
pub use light_ref::LightRef;
pub use light_sample::{EmittedRay, LePdf, LightLeSample, LightLiSample};
#[cfg(feature = "alloc")]
pub use light_set::LightSet;
#[cfg(feature = "alloc")]
pub use light_set_builder::LightSetBuilder;
#[cfg(feature = "alloc")]
pub use light_set_bytes::LightSetBytes;
#[cfg(feature = "alloc")]
pub use light_set_update::LightUpdateError;
pub use light_type::LightType;
#[cfg(feature = "alloc")]
pub use median_cut::{
    Centroid, MedianCut, MedianCutError, MedianCutLight, RegionSums, TexelRegion,
};
pub use medium_interface::{MediumId, MediumInterface};
#[cfg(feature = "alloc")]
pub use mesh::{MeshLight, MeshLightDesc, MeshLightError};
#[cfg(feature = "alloc")]
pub use mesh_indices::MeshIndices;
#[cfg(feature = "alloc")]
pub use own_light::{OwnLight, OwnLightError};
pub use pdf_coverage::PdfCoverage;
#[cfg(feature = "alloc")]
pub use placed_mesh::{MeshPrototypeId, PlacedMeshCounts, PlacedMeshError};
pub use point::{PointLight, PointLightDesc, PointLightError};
pub use point_source::{DirectionSample, PointSource};
#[cfg(feature = "alloc")]
pub use portal_infinite::PortalInfiniteLight;
#[cfg(feature = "alloc")]
pub use portal_infinite_desc::{PortalInfiniteLightDesc, PortalInfiniteLightError};
#[cfg(feature = "alloc")]
pub use projection::{ProjectionLight, ProjectionLightDesc, ProjectionLightError};
#[cfg(feature = "alloc")]
pub use resample::equal_area_size;
pub use rgb::Rgb;
pub use rigid_transform::{RigidTransform, RigidTransformError};
pub use scaled_emission::EmissionError;
pub use scene_sphere::{SceneSphere, SceneSphereError};
pub use sides::Sides;
#[cfg(feature = "alloc")]
pub use source_table::SourceId;
pub use spectral::Spectral;
pub use spectral_emission::SpectralEmission;
pub use spot::SpotLight;
pub use spot_desc::{SpotLightDesc, SpotLightError};
pub use sun::{SunLight, SunLightError};
pub use sun_desc::{SunAmount, SunLightDesc};
pub use surface_point::SurfacePoint;
#[cfg(feature = "alloc")]
pub use texture::Texture;
#[cfg(feature = "alloc")]
pub use texture_mapping::{TextureMapping, Wrap};
pub use uniform_infinite::{UniformInfiniteLight, UniformInfiniteLightDesc};
