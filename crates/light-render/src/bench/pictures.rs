use lights::glam::{DVec3, Vec3};
use lights::samplers::LightSampler;

use super::cpu_time::CpuTimer;
use super::unlit_pixels::pixels_without_lights;
use crate::integrator::PathSettings;
use crate::{AnyLightSamplerError, RenderSettings, View, World, render};

/// A scene whose pictures are timed, and compared where they show no light.
#[derive(Debug)]
pub struct PictureBench {
    world: World,
    view: View,
    measured: Vec<bool>,
}

/// A picture, and what it took.
#[derive(Clone, Debug)]
pub struct TimedPicture {
    /// Linear RGB, row by row from the top.
    pub pixels: Vec<Vec3>,
    /// Seconds of all threads together, as [`CpuTimer`] counts them.
    pub seconds: f64,
}

/// Weighs squared differences of pictures: relMSE, the mean over measured pixels and channels of
/// the squared difference over the squared reference plus a floor.
#[derive(Clone, Debug)]
pub struct RelativeError {
    /// One over the denominator of each pixel; 0 where none is measured.
    weights: Vec<DVec3>,
}

impl PictureBench {
    /// The bench for pictures of `view` in `world`.
    ///
    /// # Errors
    /// When the lights are more than ids.
    pub fn new(world: World, view: View) -> Result<Self, AnyLightSamplerError> {
        let measured = pixels_without_lights(&world, &view)?;
        Ok(Self {
            world,
            view,
            measured,
        })
    }

    /// The scene.
    #[must_use]
    pub const fn world(&self) -> &World {
        &self.world
    }

    /// Its camera.
    #[must_use]
    pub const fn view(&self) -> &View {
        &self.view
    }

    /// Renders `samples` samples a pixel. The time is that of the rendering alone: preparations of
    /// `sampler` are the caller's to count.
    #[must_use]
    pub fn picture<S: LightSampler + Sync>(
        &self,
        sampler: &S,
        path: PathSettings,
        samples: u32,
        seed: u32,
    ) -> TimedPicture {
        let settings = RenderSettings {
            samples: 0..samples,
            time_limit: None,
            seed,
            path,
        };
        let timer = CpuTimer::start();
        let film = render(&self.world, &self.view, sampler, &settings, |_| ()).film;
        TimedPicture {
            seconds: timer.seconds(),
            pixels: film.develop(),
        }
    }

    /// Errors relative to `reference` plus `floor`, a squared radiance.
    #[must_use]
    pub fn error(&self, reference: &[Vec3], floor: f64) -> RelativeError {
        let measured = self.measured.iter().copied();
        RelativeError::new(reference, floor, measured)
    }

    /// The floor that keeps dark pixels from ruling: the square of a tenth of the mean of the
    /// measured pixels of `reference`.
    #[must_use]
    pub fn tenth_of_mean(&self, reference: &[Vec3]) -> f64 {
        let measured = || self.measured.iter().zip(reference).filter(|(m, _)| **m);
        let sum: DVec3 = measured().map(|(_, r)| r.as_dvec3()).sum();
        let mean = sum.element_sum() / (3 * measured().count().max(1)) as f64;
        0.01 * mean * mean
    }
}

impl RelativeError {
    /// That of all pixels, relative to `reference` plus `floor`, a squared radiance.
    pub(crate) fn of_all(reference: &[Vec3], floor: f64) -> Self {
        let measured = core::iter::repeat_n(true, reference.len());
        Self::new(reference, floor, measured)
    }

    /// That of the pixels that are `measured`.
    fn new(reference: &[Vec3], floor: f64, measured: impl Iterator<Item = bool> + Clone) -> Self {
        let count = measured.clone().filter(|&measured| measured).count();
        let weight = |(r, measured): (&Vec3, bool)| {
            if measured {
                let r = r.as_dvec3();
                1.0 / (r * r + floor) / (3.0 * count as f64)
            } else {
                DVec3::ZERO
            }
        };
        let weights = reference.iter().zip(measured).map(weight).collect();
        Self { weights }
    }

    /// What relMSE of pictures such as `a` and `b`, which differ by their seeds alone, would be
    /// against a perfect one: that of half their squared difference.
    #[must_use]
    pub fn of_pair(&self, a: &[Vec3], b: &[Vec3]) -> f64 {
        let pixels = a.iter().zip(b);
        0.5 * self.mean(pixels.map(|(a, b)| [a.as_dvec3() - b.as_dvec3(); 2]))
    }

    /// relMSE of `picture` against two independent halves of a reference: the product of the
    /// differences to both, in which the noise of the reference cancels on average.
    #[must_use]
    pub fn against(&self, picture: &[Vec3], [a, b]: [&[Vec3]; 2]) -> f64 {
        let pixels = picture.iter().zip(a.iter().zip(b));
        self.mean(pixels.map(|(x, (a, b))| [a, b].map(|r| x.as_dvec3() - r.as_dvec3())))
    }

    /// The weighed sum of products.
    fn mean(&self, products: impl Iterator<Item = [DVec3; 2]>) -> f64 {
        let weighed = self.weights.iter().zip(products);
        weighed.map(|(w, [a, b])| (*w * a * b).element_sum()).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use light_scene::BuiltinScene;

    fn bench() -> PictureBench {
        let scene = BuiltinScene::CornellBox.load();
        let view = View::new(&scene.camera_or_default(), 2, 1).expect("two pixels");
        let world = World::new(scene).expect("valid");
        PictureBench {
            world,
            view,
            measured: vec![true, false],
        }
    }

    #[test]
    fn only_measured_pixels_count() {
        let bench = bench();
        let reference = [Vec3::splat(2.0), Vec3::splat(100.0)];
        assert!(
            (bench.tenth_of_mean(&reference) - 0.04).abs() < 1e-12,
            "of 2"
        );
        let error = bench.error(&reference, 1.0);
        let picture = [Vec3::splat(3.0), Vec3::ZERO];
        let halves = [Vec3::splat(1.5), Vec3::splat(2.5)].map(|half| [half, Vec3::ZERO]);
        let against = error.against(&picture, [&halves[0], &halves[1]]);
        assert!((against - 0.75 / 5.0).abs() < 1e-12, "1.5 x 0.5: {against}");
        let pair = error.of_pair(&halves[0], &halves[1]);
        assert!((pair - 0.5 / 5.0).abs() < 1e-12, "half of 1: {pair}");
    }
}
