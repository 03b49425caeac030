#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]
#![warn(clippy::print_stdout, clippy::print_stderr)]

extern crate alloc;

pub use lights;
pub use lights::glam;

#[cfg(test)]
mod broken;
mod builtin;
mod camera;
mod diagnostic;
mod emissive_copies;
mod files;
mod gltf;
mod grid;
mod gunzip;
mod ids;
mod image;
mod instance;
pub mod light_set;
mod luminaire;
mod material;
mod mesh;
mod obj;
mod pbrt;
mod polygon;
mod scene;
mod scene_file;
mod sphere;
#[cfg(test)]
mod test_folder;
mod text;
#[cfg(test)]
mod three_formats;
#[cfg(test)]
mod upright;
mod write_whole;

pub use builtin::{BuiltinScene, UnknownScene};
pub use camera::{Camera, CameraError, Crop, Lens};
pub use diagnostic::{Diagnostic, Location};
pub use emissive_copies::MAX_EMISSIVE_COPIES;
pub use files::Files;
pub use gltf::read_gltf;
pub use ids::{ImageId, MaterialId, PrototypeId};
pub use image::{
    ChannelFile, Image, ImageError, ImageFile, parse_exr, parse_image, read_image, write_exr,
    write_exr_half, write_image, write_png,
};
pub use instance::{Instance, Prototype};
pub(crate) use luminaire::goniometric_light;
pub use luminaire::{in_luminaire, parse_luminaire, read_luminaire};
pub use material::{Alpha, Color, ColorImage, Emission, EmissionSides, Material, Surface};
pub use mesh::Mesh;
pub use obj::{parse_obj, read_obj};
pub use pbrt::{parse_ply, read_pbrt};
pub use scene::{NamedMedium, Scene};
pub use scene_file::{parse_scene, read_scene};
pub use sphere::{Sphere, SphereFront};
pub use write_whole::{exit_without_outputs, write_whole};
