//! The record of the default tree: its layout, the moments that it holds, and their codes.

pub(crate) mod child_codes;
#[cfg(feature = "alloc")]
pub(crate) mod children_soa;
#[cfg(feature = "alloc")]
pub(crate) mod covariance;
#[cfg(feature = "alloc")]
pub(crate) mod encode;
#[cfg(feature = "alloc")]
pub(crate) mod encode_emission;
#[cfg(feature = "alloc")]
pub(crate) mod light_emission;
#[cfg(feature = "alloc")]
pub(crate) mod moments;
pub(crate) mod sheet_code;
pub(crate) mod spread_code;
pub(crate) mod wide_node;
