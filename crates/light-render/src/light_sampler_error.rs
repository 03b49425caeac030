use core::error::Error;
use core::fmt;

use lights::bvh::visibility::CellTableError;
use lights::bvh::{InstancedLightBvhError, LightBvhError};
use lights::samplers::{InstancedBvhLightSamplerError, PowerLightSamplerError};

use crate::SamplerKind;

/// Why lights cannot be sampled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum AnyLightSamplerError {
    /// A power is no power.
    Power(PowerLightSamplerError),
    /// Bounds are invalid.
    Bvh(LightBvhError),
    /// Placed lights have no tree.
    Placements(InstancedLightBvhError),
    /// Placed lights have no sampler.
    Placed(InstancedBvhLightSamplerError),
    /// The cells of visibility are too many.
    Cells(CellTableError),
    /// Lights are not chosen by the default hierarchy: only that one has cells of visibility.
    NoCells,
    /// The lists of a sampler do not fit into memory.
    Memory {
        /// Which sampler.
        kind: SamplerKind,
        /// Of how many lights.
        lights: usize,
        /// Bytes that it needs.
        needed: u64,
        /// Bytes that are available.
        available: u64,
    },
}

impl From<PowerLightSamplerError> for AnyLightSamplerError {
    fn from(error: PowerLightSamplerError) -> Self {
        Self::Power(error)
    }
}

impl From<LightBvhError> for AnyLightSamplerError {
    fn from(error: LightBvhError) -> Self {
        Self::Bvh(error)
    }
}

impl From<InstancedLightBvhError> for AnyLightSamplerError {
    fn from(error: InstancedLightBvhError) -> Self {
        Self::Placements(error)
    }
}

impl From<InstancedBvhLightSamplerError> for AnyLightSamplerError {
    fn from(error: InstancedBvhLightSamplerError) -> Self {
        Self::Placed(error)
    }
}

impl From<CellTableError> for AnyLightSamplerError {
    fn from(error: CellTableError) -> Self {
        Self::Cells(error)
    }
}

impl fmt::Display for AnyLightSamplerError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Power(error) => error.fmt(f),
            Self::Bvh(error) => error.fmt(f),
            Self::Placements(error) => error.fmt(f),
            Self::Placed(error) => error.fmt(f),
            Self::Cells(error) => error.fmt(f),
            Self::NoCells => f.write_str("cells of visibility: expected the default hierarchy"),
            Self::Memory {
                kind,
                lights,
                needed,
                available,
            } => write!(
                f,
                "{kind} over {lights} lights: needs {:.1} GB of memory, {:.1} GB are available",
                *needed as f64 * 1e-9,
                *available as f64 * 1e-9
            ),
        }
    }
}

impl Error for AnyLightSamplerError {}
