#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]
#![warn(clippy::print_stdout, clippy::print_stderr)]

extern crate alloc;

pub use light_sets;
pub use lights;
pub use lights::glam;

mod atomic_file;
mod builtin;
mod builtin_sky;
mod camera;
mod coincident_emitters;
mod color;
#[cfg(test)]
mod corrupted_files;
mod diagnostic;
mod emissive_copies;
mod extent_fault;
mod files;
#[cfg(test)]
mod format_agreement;
mod generated_tangents;
mod gltf;
mod gunzip;
mod ids;
mod image;
#[cfg(test)]
mod image_orientation;
mod instance;
mod light_set;
mod luminaire;
mod material;
mod mesh;
mod mesh_grid;
mod metallic_roughness;
mod named_medium;
mod obj;
mod pbrt;
mod polygon;
mod quadric;
mod quadric_kind;
mod quadric_part;
mod read_files;
mod scene;
mod scene_bounds;
mod scene_file;
mod scene_light;
#[cfg(test)]
mod test_folder;
mod text;

pub use atomic_file::{exit_without_outputs, link_target, write_atomically};
pub use builtin::{BuiltinScene, OcclusionKind, OcclusionScene, OcclusionSize, UnknownScene};
pub use builtin_sky::BuiltinSky;
pub use camera::{Camera, CameraError, Crop, Lens, Projection, ScreenWindow};
pub use color::{Color, ColorImage, UvSet};
pub use diagnostic::{Diagnostic, Location};
pub use emissive_copies::{MAX_EMISSIVE_COPIES, MAX_EMISSIVE_PRIMITIVES};
pub use files::Files;
pub use gltf::read_gltf;
pub use ids::{ImageId, MaterialId, PrototypeId};
pub use image::{
    ChannelFile, Image, ImageError, ImageFile, encode_png, parse_exr, parse_image,
    read_environment, read_image, read_signed_image, write_exr, write_exr_half, write_image,
    write_png,
};
pub use instance::{Instance, Prototype};
pub use light_set::{LightSetError, LightSetProblem, read_light_set, write_light_set};
pub(crate) use luminaire::goniometric_light;
pub use luminaire::{in_luminaire, parse_luminaire, read_luminaire};
pub use material::{Alpha, BackFaces, Emission, EmissionSides, Material, Surface};
pub use mesh::Mesh;
pub use metallic_roughness::{Clearcoat, MetallicRoughness};
pub use named_medium::NamedMedium;
pub use obj::{parse_obj, read_obj};
pub use pbrt::{parse_ply, read_pbrt};
pub use quadric::{Quadric, QuadricFront};
pub use quadric_kind::QuadricKind;
pub use quadric_part::QuadricPart;
pub use read_files::{record_read_files, recorded_read_files};
pub use scene::Scene;
pub use scene_file::{is_scene_name, parse_scene, read_scene};
