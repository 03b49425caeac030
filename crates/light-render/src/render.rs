use core::ops::{ControlFlow, Range};
use core::sync::atomic::{AtomicU64, Ordering};
use core::time::Duration;
use std::time::Instant;

use light_scene::Crop;
use lights::samplers::LightSampler;
use rayon::prelude::*;

use crate::integrator::{LayerSums, LightSum, PathSettings, Total, add_li};
use crate::{Film, FilmRow, LightLayers, SampleStream, View, World};

/// What to render.
#[derive(Clone, Debug, PartialEq)]
pub struct RenderSettings {
    /// The numbers of the samples of each pixel.
    pub samples: Range<u32>,
    /// When to stop before the last sample: no pass is begun that is not expected to end in time.
    pub time_limit: Option<Duration>,
    /// Chooses the random numbers: equal seeds, equal pictures.
    pub seed: u32,
    /// How paths are traced.
    pub path: PathSettings,
}

/// The progress of a rendering, reported after each pass over the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// The share of the work that is done, in `[0, 1]`.
    pub done: f64,
    /// Samples a pixel so far.
    pub samples: u32,
}

/// A finished picture and what it took.
#[derive(Clone, Debug)]
pub struct Rendering {
    /// The picture.
    pub film: Film,
    /// Wall-clock time of the rendering alone.
    pub elapsed: Duration,
    /// Rays, shadow rays included.
    pub rays: u64,
    /// Samples left out because they were not finite: 0 unless something is wrong.
    pub rejected: u64,
}

/// A picture by groups of lights: the sum of the layers, and the layers.
#[derive(Clone, Debug)]
pub struct LayerRendering {
    /// The sum of all layers.
    pub whole: Rendering,
    /// One picture for each layer, in the order of their names.
    pub layers: Vec<Film>,
}

/// Renders `view` of `world` with lights chosen by `sampler`, on the threads of the current `rayon`
/// pool.
///
/// The picture depends on the arguments alone, never on the number of threads; with a time limit it
/// depends on how many samples fit into it.
#[must_use]
pub fn render<S: LightSampler + Sync>(
    world: &World,
    view: &View,
    sampler: &S,
    settings: &RenderSettings,
    mut report: impl FnMut(Progress),
) -> Rendering {
    render_while(world, view, sampler, settings, |progress, _| {
        report(progress);
        ControlFlow::Continue(())
    })
}

/// As [`render`], until `watch` breaks: after each pass over the picture it hears of the progress
/// and sees the film so far. What was rendered until then is the picture.
#[must_use]
pub fn render_while<S: LightSampler + Sync>(
    world: &World,
    view: &View,
    sampler: &S,
    settings: &RenderSettings,
    mut watch: impl FnMut(Progress, &Film) -> ControlFlow<()>,
) -> Rendering {
    let (width, height) = view.crop().size();
    let mut film = Film::new(width, height);
    let films = core::slice::from_mut(&mut film);
    let scene = (world, view, sampler);
    let watch = |progress, films: &[Film]| watch(progress, &films[0]);
    let taken = expose(films, scene, settings, Total::default, watch);
    taken.rendering(film)
}

/// As [`render`], with the light of each of `layers` in a film of its own. The paths are those of
/// the whole picture, so that layers cost hardly more time, and share its noise. Integrators of
/// single scattering put all light into the last.
///
/// ```
/// use light_render::integrator::{Estimator, Integrator, PathSettings};
/// use light_render::light_scene::BuiltinScene;
/// use light_render::{
///     AnyLightSampler, LightGroupPattern, LightLayers, RenderSettings, SamplerKind, View, World,
///     render_layers,
/// };
///
/// let scene = BuiltinScene::CornellBox.load();
/// let view = View::new(&scene.camera_or_default(), 4, 4)?;
/// let world = World::new(scene)?;
/// let sampler = AnyLightSampler::new(SamplerKind::Bvh, world.lights())?;
/// let lamps: LightGroupPattern = "lamps=*".parse()?;
/// let layers = LightLayers::new(&world, &[lamps])?;
/// let path = PathSettings {
///     max_depth: 2,
///     estimator: Estimator::default(),
///     light_samples: PathSettings::DEFAULT_LIGHT_SAMPLES,
///     integrator: Integrator::default(),
/// };
/// let settings = RenderSettings { samples: 0..1, time_limit: None, seed: 1, path };
/// let picture = render_layers(&world, &view, &sampler, &settings, &layers, |_| {});
/// assert_eq!(layers.names(), ["lamps"], "no layer `LightLayers::REST`");
/// assert_eq!(picture.layers.len(), 1);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[must_use]
pub fn render_layers<S: LightSampler + Sync>(
    world: &World,
    view: &View,
    sampler: &S,
    settings: &RenderSettings,
    layers: &LightLayers,
    mut report: impl FnMut(Progress),
) -> LayerRendering {
    let (width, height) = view.crop().size();
    let film = Film::new(width, height);
    let mut films = vec![film; layers.names().len()];
    let scene = (world, view, sampler);
    let sum = || LayerSums::new(layers);
    let watch = |progress, _: &[Film]| {
        report(progress);
        ControlFlow::Continue(())
    };
    let taken = expose(&mut films, scene, settings, sum, watch);
    let mut whole = films[0].clone();
    for layer in &films[1..] {
        whole.add_light(layer);
    }
    LayerRendering {
        whole: taken.rendering(whole),
        layers: films,
    }
}

/// What a rendering took.
struct Taken {
    elapsed: Duration,
    rays: u64,
    rejected: u64,
}

impl Taken {
    fn rendering(self, film: Film) -> Rendering {
        let Self {
            elapsed,
            rays,
            rejected,
        } = self;
        Rendering {
            film,
            elapsed,
            rays,
            rejected,
        }
    }
}

/// Adds the samples of `settings` to `films`, one for each layer of a `sum`, until `watch` breaks.
fn expose<S: LightSampler + Sync, L: LightSum>(
    films: &mut [Film],
    (world, view, sampler): (&World, &View, &S),
    settings: &RenderSettings,
    sum: impl Fn() -> L + Sync,
    mut watch: impl FnMut(Progress, &[Film]) -> ControlFlow<()>,
) -> Taken {
    let Crop { min, max } = view.crop();
    let (rays, rejected) = (AtomicU64::new(0), AtomicU64::new(0));
    let start = Instant::now();
    let Range { start: first, end } = settings.samples;
    let mut next = first;
    while next < end {
        let pass = next..pass_end(settings, next, start.elapsed());
        if pass.is_empty() {
            break;
        }
        let count = pass.end - pass.start;
        let mut rows: Vec<Vec<&mut FilmRow>> = (min[1]..max[1]).map(|_| Vec::new()).collect();
        for film in &mut *films {
            for (rows, row) in rows.iter_mut().zip(film.expose(count)) {
                rows.push(row);
            }
        }
        rows.par_iter_mut()
            .zip(min[1]..max[1])
            .for_each(|(rows, y)| {
                let (mut row_rays, mut sum) = (0, sum());
                for (pixel, x) in (min[0]..max[0]).enumerate() {
                    for sample in pass.clone() {
                        let stream = SampleStream::new(settings.seed, (x, y), sample);
                        let numbers = stream.camera();
                        let corner = lights::glam::Vec2::new(x as f32, y as f32);
                        let ray = view.ray(corner + numbers.film, numbers.lens);
                        sum.clear();
                        let traced = add_li(world, sampler, &settings.path, ray, &stream, &mut sum);
                        row_rays += u64::from(traced);
                        if sum.layers().iter().all(|radiance| radiance.is_finite()) {
                            for (row, &radiance) in rows.iter_mut().zip(sum.layers()) {
                                row.add(pixel, radiance);
                            }
                        } else {
                            rejected.fetch_add(1, Ordering::Relaxed);
                        }
                    }
                }
                rays.fetch_add(row_rays, Ordering::Relaxed);
            });
        next = pass.end;
        let progress = Progress {
            done: done(settings, next, start.elapsed()),
            samples: next - first,
        };
        if watch(progress, films).is_break() {
            break;
        }
    }
    Taken {
        elapsed: start.elapsed(),
        rays: rays.into_inner(),
        rejected: rejected.into_inner(),
    }
}

/// The end of the pass that begins at sample `next`: passes double, and shrink to what the time
/// limit leaves.
fn pass_end(settings: &RenderSettings, next: u32, elapsed: Duration) -> u32 {
    /// Longer passes would report the progress too rarely.
    const LONGEST: u32 = 8;
    let before = next - settings.samples.start;
    let mut count = before.clamp(1, LONGEST);
    if let Some(limit) = settings.time_limit
        && before > 0
    {
        let each = elapsed.as_secs_f64() / f64::from(before);
        let left = limit.as_secs_f64() - elapsed.as_secs_f64();
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "saturates at 0 and at the longest"
        )]
        let fits = (left / each) as u32;
        count = count.min(fits);
    }
    settings.samples.end.min(next.saturating_add(count))
}

/// The share of the samples or of the time, whichever is further.
fn done(settings: &RenderSettings, next: u32, elapsed: Duration) -> f64 {
    let total = settings.samples.end - settings.samples.start;
    let of_samples = f64::from(next - settings.samples.start) / f64::from(total);
    let of_time = settings
        .time_limit
        .map_or(0.0, |limit| elapsed.as_secs_f64() / limit.as_secs_f64());
    of_samples.max(of_time).min(1.0)
}
