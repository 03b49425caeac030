use core::num::NonZeroU32;

use light_render::integrator::PathSettings;
use light_render::{SamplerKind, Visibility};

/// A way to choose lights at the first vertex.
#[derive(Debug)]
pub(super) struct Method {
    pub(super) name: &'static str,
    pub(super) sampler: SamplerKind,
    pub(super) choices: NonZeroU32,
    /// Whether cells guide the choices of the default tree.
    pub(super) visibility: Visibility,
}

/// What is compared; the others are set against the first.
pub(super) static METHODS: [Method; 6] = [
    Method {
        name: "one choice",
        sampler: SamplerKind::Bvh,
        choices: NonZeroU32::MIN,
        visibility: Visibility::Off,
    },
    Method {
        name: "two choices",
        sampler: SamplerKind::Bvh,
        choices: PathSettings::DEFAULT_LIGHT_SAMPLES,
        visibility: Visibility::Off,
    },
    Method {
        name: "reference tree",
        sampler: SamplerKind::BvhReference,
        choices: NonZeroU32::MIN,
        visibility: Visibility::Off,
    },
    Method {
        name: "default",
        sampler: SamplerKind::Bvh,
        choices: PathSettings::DEFAULT_LIGHT_SAMPLES,
        visibility: Visibility::Share,
    },
    Method {
        name: "cells",
        sampler: SamplerKind::Bvh,
        choices: NonZeroU32::MIN,
        visibility: Visibility::Cells,
    },
    Method {
        name: "cells, two elsewhere",
        sampler: SamplerKind::Bvh,
        choices: PathSettings::DEFAULT_LIGHT_SAMPLES,
        visibility: Visibility::Cells,
    },
];

/// One of [`METHODS`].
pub(super) fn method(text: &str) -> Result<&'static Method, String> {
    let method = text.parse().ok().and_then(|i: usize| METHODS.get(i));
    method.ok_or_else(|| format!("expected a number from 0 to {}", METHODS.len() - 1))
}
