use core::time::Duration;
use std::path::PathBuf;
use std::time::Instant;

use lights::glam::Vec3;

use crate::bench::RelativeError;
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
        /// Its two halves, linear RGB as the whole.
        halves: [Vec<Vec3>; 2],
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
        // Building the sampler is a part of the time.
        let left = time.saturating_sub(start.elapsed());
        let mut whole = half(seed.wrapping_add(1), u32::MAX, Some(left / 2), 0.0);
        let other = half(seed.wrapping_add(2), whole.samples(), None, 0.5);
        let halves = [whole.develop(), other.develop()];
        whole.add(&other);
        Ok(Self {
            pixels: whole.develop(),
            source: ReferenceSource::Made {
                sampler: SamplerKind::DEFAULT,
                samples: whole.samples(),
                time: start.elapsed(),
                halves,
            },
        })
    }

    /// Its own relMSE, if it is known: that of the mean of two pictures such as its halves.
    pub(crate) fn rel_mse(&self) -> Option<f64> {
        let (error, [a, b]) = self.halves()?;
        // The mean of two has half the variance of each.
        Some(0.5 * error.of_pair(a, b))
    }

    /// relMSE of `picture`, of the same size. The noise of a reference that was rendered cancels on
    /// average; for a picture as good as perfect the result may be below 0.
    pub(crate) fn rel_mse_of(&self, picture: &[Vec3]) -> f64 {
        match self.halves() {
            Some((error, halves)) => error.against(picture, halves),
            None => {
                let comparison = Comparison::new(picture, &self.pixels);
                comparison.map_or(f64::NAN, |comparison| comparison.rel_mse)
            }
        }
    }

    /// The two halves of one that was rendered, and the error that is measured by them.
    fn halves(&self) -> Option<(RelativeError, [&[Vec3]; 2])> {
        let ReferenceSource::Made { halves: [a, b], .. } = &self.source else {
            return None;
        };
        let error = RelativeError::of_all(&self.pixels, Comparison::FLOOR);
        Some((error, [a, b]))
    }
}

#[cfg(test)]
mod tests {
    use crate::sobol;

    use super::*;

    const PIXELS: u32 = 1 << 14;

    /// Grey pixels of radiance 1 with noise of the variance `1 / 12` times `scale` squared.
    fn noisy(seed: u32, scale: f32) -> Vec<Vec3> {
        let noise = |i| {
            let hash = sobol::hash(i ^ sobol::hash(seed));
            ((hash >> 8) as f32 / (1u32 << 24) as f32 - 0.5) * scale
        };
        (0..PIXELS).map(|i| Vec3::splat(1.0 + noise(i))).collect()
    }

    fn made(halves: [Vec<Vec3>; 2]) -> Reference {
        let [a, b] = &halves;
        let pixels = a.iter().zip(b).map(|(a, b)| (a + b) * 0.5).collect();
        let source = ReferenceSource::Made {
            sampler: SamplerKind::DEFAULT,
            samples: 2,
            time: Duration::ZERO,
            halves,
        };
        Reference { pixels, source }
    }

    #[test]
    fn noise_of_a_reference_cancels() {
        // As noisy as the picture.
        let reference = made([1, 2].map(|seed| noisy(seed, 0.5)));
        let picture = noisy(3, 0.5);
        let expected = 0.25 / 12.0 / 1.01;
        let error = reference.rel_mse_of(&picture);
        assert!(
            (error / expected - 1.0).abs() < 0.05,
            "{error}, not {expected}"
        );
        let own = reference.rel_mse().expect("known");
        assert!((own / expected - 0.5).abs() < 0.03, "{own}: half of that");
    }

    #[test]
    fn a_given_reference_counts_as_the_truth() {
        let pixels = noisy(1, 0.0);
        let source = ReferenceSource::Given("a.exr".into());
        let reference = Reference { pixels, source };
        assert_eq!(reference.rel_mse(), None, "of its own");
        let picture = vec![Vec3::splat(1.5); PIXELS as usize];
        let error = reference.rel_mse_of(&picture);
        assert!((error - 0.25 / 1.01).abs() < 1e-9, "{error}");
    }
}
