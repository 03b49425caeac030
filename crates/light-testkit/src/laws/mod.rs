//! What every implementation of a trait must obey, written once.

#[cfg(feature = "sources")]
pub mod light;
#[cfg(feature = "samplers")]
pub mod sampler;
#[cfg(feature = "samplers")]
pub mod sampler_contexts;
#[cfg(feature = "samplers")]
mod sampler_laws;
#[cfg(feature = "samplers")]
mod several_choices;

#[cfg(feature = "samplers")]
pub use sampler_laws::sampler_cases;
#[cfg(feature = "samplers")]
pub use several_choices::several_choices_follow_their_pmf;
