#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]
#![warn(clippy::print_stdout, clippy::print_stderr)]

mod accel;
pub mod bench;
mod compare;
mod false_color;
mod film;
mod ray;
mod sample_stream;
mod surface;
mod tone_map;

pub use accel::{Accel, Hit, TriangleId};
pub use compare::Comparison;
pub use false_color::difference;
pub use film::Film;
pub use ray::Ray;
pub use sample_stream::{CameraNumbers, SampleStream, VertexNumbers};
pub use surface::Surface;
pub use tone_map::{ToneMap, luminance};
