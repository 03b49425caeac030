use core::time::Duration;
use std::time::Instant;

use lights::glam::Vec3;

use crate::integrator::PathSettings;
use crate::{
    AnyLightSampler, AnyLightSamplerError, Film, Progress, RenderSettings, SamplerKind, View,
    World, render,
};

/// A picture by one sampler within a time, and how it grew.
#[derive(Debug)]
pub(super) struct Timed {
    pub(super) sampler: AnyLightSampler,
    /// The time to build the sampler, which is part of the whole.
    pub(super) build: Duration,
    /// The picture so far, again and again with twice the samples; the last is the whole.
    pub(super) stages: Vec<Stage>,
    pub(super) rays: u64,
    /// Samples that were not finite.
    pub(super) rejected: u64,
}

/// A picture on its way.
#[derive(Debug)]
pub(super) struct Stage {
    /// Since the beginning, building included.
    pub(super) time: Duration,
    /// Samples a pixel.
    pub(super) samples: u32,
    pub(super) pixels: Vec<Vec3>,
}

impl Timed {
    /// Builds the sampler and renders until `limit`; at least one sample a pixel.
    ///
    /// # Errors
    /// When the sampler refuses the lights.
    pub(super) fn new(
        (world, view): (&World, &View),
        kind: SamplerKind,
        path: &PathSettings,
        seed: u32,
        limit: Duration,
        mut show: impl FnMut(f64, u32),
    ) -> Result<Self, AnyLightSamplerError> {
        let start = Instant::now();
        let sampler = AnyLightSampler::new(kind, world.lights())?;
        let build = start.elapsed();
        let (width, height) = view.crop().size();
        let mut film = Film::new(width, height);
        let mut time = build;
        let (mut stages, mut rays, mut rejected) = (Vec::new(), 0, 0);
        loop {
            let done = film.samples();
            let left = limit.saturating_sub(time);
            // What looking at the picture takes does not count.
            let each = (time - build).checked_div(done).unwrap_or_default();
            if done > 0 && left <= each {
                break;
            }
            let settings = RenderSettings {
                samples: done..done.saturating_add(done.max(1)),
                time_limit: Some(left),
                seed,
                path: *path,
            };
            let report = |p: Progress| {
                let share =
                    (time.as_secs_f64() + p.done * left.as_secs_f64()) / limit.as_secs_f64();
                show(share.min(1.0), done + p.samples);
            };
            let rendering = render(world, view, &sampler, &settings, report);
            time += rendering.elapsed;
            rays += rendering.rays;
            rejected += rendering.rejected;
            film.add(&rendering.film);
            stages.push(Stage {
                time,
                samples: film.samples(),
                pixels: film.develop(),
            });
        }
        Ok(Self {
            sampler,
            build,
            stages,
            rays,
            rejected,
        })
    }
}
