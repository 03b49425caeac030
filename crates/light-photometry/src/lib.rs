#![doc = include_str!("../README.md")]
#![no_std]
#![cfg_attr(docsrs, feature(doc_cfg))]
#![forbid(unsafe_code)]
#![warn(clippy::print_stdout, clippy::print_stderr)]

extern crate alloc;

pub use light_math::glam;

mod axis;
mod diagnostic;
mod eulumdat;
mod lm63;
mod luminaire;
mod numbers;
mod photometric_web;
mod tilt;
mod unfolded_axis;
mod web_type;

pub use diagnostic::Diagnostic;
pub use eulumdat::parse_eulumdat;
pub use lm63::parse_lm63;
pub use luminaire::{Luminaire, LuminaireFormat};
pub use photometric_web::{PhotometricWeb, PhotometricWebError};
pub use tilt::LampTilt;
pub use web_type::WebType;
