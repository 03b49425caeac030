//! Lights of every kind at random places, compared with quadrature in double precision that is
//! written from their descriptions alone.
//!
//! Of each light are compared: power, amounts in photometric units and watts, the rays that leave it
//! (their power, mean direction and mean origin), bounds, and at some receivers the irradiance or
//! fluence by samples, and the integral of their density. Samples and quadrature take two points in
//! each of many equal cells, so that the pairs say how far chance may move both. What is left has to
//! be within the rounding of single precision, or to be right for a receiver that is moved by four
//! roundings of the coordinates.
//!
//! A difference counts only if larger independent samples show it again: the chance that a fault is
//! reported although all code is right is far below [`SIGNIFICANCE`](crate::SIGNIFICANCE).

mod amounts;
mod area;
mod area_checks;
mod area_lights;
mod arrival;
mod kind;
mod model;
mod picture;
mod placement;
mod point_lights;
mod point_truth;
mod power;
mod rays;
mod receiver;
mod skies;
mod sky_checks;
mod sky_truth;
mod sphere_maps;
mod stratified;
mod surface;

pub use kind::Kind;

use light_sources::{Rgb, Spectral};

use crate::Rng;
use model::Model;

/// Compares one light of this kind with its description; equal seeds draw equal lights.
///
/// # Errors
/// What differs, and of which light.
pub fn check(kind: Kind, seed: u64) -> Result<(), String> {
    let mut rng = Rng::new(seed << 8 | kind as u64);
    let outcome = if rng.below(2) == 0 {
        check_in::<Rgb>(kind, &mut rng)
    } else {
        check_in::<Spectral<4>>(kind, &mut rng)
    };
    outcome.map_err(|fault| format!("{kind:?}, seed {seed}: {fault}"))
}

fn check_in<M: Model>(kind: Kind, rng: &mut Rng) -> Result<(), String> {
    match kind {
        Kind::Point | Kind::Spot | Kind::Projection | Kind::Goniometric => {
            point_lights::check::<M>(kind, rng)
        }
        Kind::Distant
        | Kind::Sun
        | Kind::UniformInfinite
        | Kind::ImageInfinite
        | Kind::PortalInfinite => skies::check::<M>(kind, rng),
        _ => area_lights::check::<M>(kind, rng),
    }
}
