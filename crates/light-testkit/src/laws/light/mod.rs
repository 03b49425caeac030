//! The laws of lights, each a function of a light and of what is known about it by other means.

mod arrival;
mod bounds;
mod case;
mod emission;
mod power;
mod rays;

pub use arrival::{dirac_li_is, li_adds_up, li_follows_its_density};
pub use bounds::{bounds_hold, edges_are_survived};
pub use case::LightCase;
pub use emission::{flux_is_phi, infinite_flux_is_phi, le_adds_up_to_phi, le_has_no_variance};
pub use power::phi_is_exact;
pub use rays::{
    le_directions_are_diffuse, le_directions_follow_their_density, le_origins_are_even,
    rays_and_samples_light_alike,
};

/// Samples that an estimate takes.
const SAMPLES: u32 = 1 << 14;

/// How far two ways to compute one density may differ, relatively: rounding of grazing and of tiny
/// shapes.
const DENSITY_ROUNDING: f32 = 2e-3;

/// Fraction of samples that may lie so close to a silhouette, or to the edge of a texel, that by
/// rounding their density is that of the other side.
const STRAY: f64 = 1e-3;
