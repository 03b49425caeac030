use core::time::Duration;
use std::path::PathBuf;
use std::time::Instant;

use lights::glam::Vec3;

use crate::integrator::PathSettings;
use crate::{
    AnyLightSampler, AnyLightSamplerError, Comparison, Film, Progress, RenderSettings, SamplerKind,
    View, World, render,
};

/// What pictures are compared with.
#[derive(Debug)]
pub(crate) struct Reference {
    /// Linear RGB, row by row from the top.
    pub(crate) pixels: Vec<Vec3>,
    pub(crate) source: ReferenceSource,
}

/// Where a reference comes from.
#[derive(Debug)]
pub(crate) enum ReferenceSource {
    /// A file.
    Given(PathBuf),
    /// It was rendered.
    Made {
        sampler: SamplerKind,
        /// Samples a pixel.
        samples: u32,
        time: Duration,
        /// Its own relMSE, from the difference of two halves of it.
        rel_mse: Option<f64>,
    },
}

impl Reference {
    /// Renders a reference for about `time`, in two halves of other seeds than `seed`.
    ///
    /// # Errors
    /// When the default sampler refuses the lights.
    pub(crate) fn make(
        (world, view): (&World, &View),
        path: &PathSettings,
        seed: u32,
        time: Duration,
        show: impl Fn(f64, u32),
    ) -> Result<Self, AnyLightSamplerError> {
        let start = Instant::now();
        let sampler = AnyLightSampler::new(SamplerKind::DEFAULT, world.lights())?;
        let half = |seed: u32, samples: u32, time_limit, before: f64| -> Film {
            let settings = RenderSettings {
                samples: 0..samples,
                time_limit,
                seed,
                path: *path,
            };
            let report = |p: Progress| show(before + 0.5 * p.done, p.samples);
            render(world, view, &sampler, &settings, report).film
        };
        let mut whole = half(seed.wrapping_add(1), u32::MAX, Some(time / 2), 0.0);
        let one = whole.develop();
        whole.add(&half(seed.wrapping_add(2), whole.samples(), None, 0.5));
        let pixels = whole.develop();
        Ok(Self {
            source: ReferenceSource::Made {
                sampler: SamplerKind::DEFAULT,
                samples: whole.samples(),
                time: start.elapsed(),
                // A half is as far from the whole as the whole is from the truth, on average.
                rel_mse: Comparison::new(&one, &pixels).map(|c| c.rel_mse),
            },
            pixels,
        })
    }

    /// Its own relMSE, if it is known.
    pub(crate) const fn rel_mse(&self) -> Option<f64> {
        match self.source {
            ReferenceSource::Given(_) => None,
            ReferenceSource::Made { rel_mse, .. } => rel_mse,
        }
    }
}
