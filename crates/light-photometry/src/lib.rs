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

pub use light_math::glam;

mod axis;
#[cfg(feature = "alloc")]
mod axis_weights;
#[cfg(feature = "alloc")]
mod diagnostic;
#[cfg(feature = "alloc")]
mod eulumdat;
#[cfg(feature = "alloc")]
mod lm63;
#[cfg(feature = "alloc")]
mod luminaire;
#[cfg(feature = "alloc")]
mod numbers;
#[cfg(feature = "alloc")]
mod photometric_web;
mod photometric_web_error;
mod photometric_web_ref;
#[cfg(feature = "alloc")]
mod tilt;
#[cfg(feature = "alloc")]
mod unfolded_axis;
mod web_type;

#[cfg(feature = "alloc")]
pub use diagnostic::Diagnostic;
#[cfg(feature = "alloc")]
pub use eulumdat::parse_eulumdat;
#[cfg(feature = "alloc")]
pub use lm63::parse_lm63;
#[cfg(feature = "alloc")]
pub use luminaire::{Luminaire, LuminaireFormat};
#[cfg(feature = "alloc")]
pub use photometric_web::PhotometricWeb;
pub use photometric_web_error::PhotometricWebError;
pub use photometric_web_ref::PhotometricWebRef;
#[cfg(feature = "alloc")]
pub use tilt::LampTilt;
pub use web_type::WebType;
