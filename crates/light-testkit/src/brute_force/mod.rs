//! Lights of every kind at random places, compared with quadrature in double precision that is
//! written from their descriptions alone.
//!
//! Of each light are compared: power, amounts in photometric units and watts (of a mesh, those of all
//! its triangles), the rays that leave it (their power, mean direction and mean origin), bounds, the
//! lobe of a picture, and at some receivers the irradiance or fluence by samples, the integral of
//! their density, and the importance, also of segments through the receiver. Receivers may be known
//! to an error only; a quarter of the flat shapes is very thin. Samples and quadrature take two points in
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
mod bodies;
mod kind;
mod lobes;
mod median_cut;
mod model;
mod picture;
mod placement;
mod point_lights;
mod point_truth;
mod power;
mod rays;
mod receiver;
mod shapes;
mod skies;
mod sky_amounts;
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
        Kind::MedianCut => median_cut::check(rng),
        _ => area_lights::check::<M>(kind, rng),
    }
}
