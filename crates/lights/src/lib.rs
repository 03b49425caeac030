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

pub mod guide;

pub use light_bounds as bounds;
pub use light_bvh as bvh;
pub use light_math as math;
pub use light_math::glam;
pub use light_media as media;
pub use light_photometry as photometry;
pub use light_samplers as samplers;
pub use light_sources as sources;

/// The example of the project's first page.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct FirstPage;
