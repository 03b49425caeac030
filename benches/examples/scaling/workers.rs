//! Render throughput over the workers of a farm. Each part and each merge of a picture is done on
//! one thread and timed; workers are simulated: a part begins as soon as one of them is free, and a
//! merge when its parts are there.

use core::ops::Range;

use light_render::integrator::{Estimator, Integrator, PathSettings};
use light_render::light_scene::BuiltinScene;
use light_render::plot::PlotSeries;
use light_render::{
    AnyLightSampler, PartialPicture, RenderSettings, SamplerKind, SceneDigest, View, Visibility,
    World, render,
};

use benches::thread_time::ThreadTimer;

/// Workers that are simulated.
const WORKERS: [usize; 5] = [1, 2, 4, 8, 16];

/// Parts that one merge takes, as by `lights farm`.
const GROUP: usize = light_render::farm::FarmPlan::GROUP as usize;

/// How large the picture is.
#[derive(Clone, Copy, Debug)]
pub(super) struct Job {
    width: u32,
    height: u32,
    samples: u32,
    parts: u32,
}

impl Job {
    pub(super) const FULL: Self = Self {
        width: 480,
        height: 270,
        samples: 256,
        parts: 64,
    };

    /// For tests.
    pub(super) const QUICK: Self = Self {
        width: 16,
        height: 9,
        samples: 40,
        parts: 40,
    };
}

/// Seconds of the tasks of a job.
#[derive(Clone, Debug, PartialEq)]
struct Tasks {
    parts: Vec<f64>,
    groups: Vec<f64>,
    merge: f64,
}

/// What so many workers render.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Throughput {
    pub(super) workers: usize,
    /// From the first part to the picture.
    pub(super) seconds: f64,
    /// Samples of pixels a second, in millions.
    pub(super) samples: f64,
    /// The share of what one worker would render in as many times the seconds.
    pub(super) efficiency: f64,
}

/// Renders the night scene in parts, and simulates the workers.
///
/// # Errors
/// A part that cannot be rendered or merged.
pub(super) fn measure(job: Job, progress: impl Fn(&str) + Sync) -> Result<Vec<Throughput>, String> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    let pool = pool.map_err(|e| format!("a thread: {e}"))?;
    let tasks = pool.install(|| timed(job, &progress))?;
    let pixels = f64::from(job.width) * f64::from(job.height);
    let all = pixels * f64::from(job.samples) * 1e-6;
    let alone = tasks.seconds(1);
    Ok(WORKERS
        .iter()
        .map(|&workers| {
            let seconds = tasks.seconds(workers);
            Throughput {
                workers,
                seconds,
                samples: all / seconds,
                efficiency: alone / seconds / workers as f64,
            }
        })
        .collect())
}

/// Does each task once. Parts pass through their bytes, as through files.
fn timed(job: Job, progress: impl Fn(&str)) -> Result<Tasks, String> {
    let mut parts = Vec::new();
    let mut files = Vec::new();
    for part in 0..job.parts {
        progress(&format!("part {part} of {}", job.parts));
        let start = |part: u32| job.samples * part / job.parts;
        let timer = ThreadTimer::start();
        files.push(bytes(&rendered(job, start(part)..start(part + 1))?)?);
        parts.push(timer.seconds());
    }
    let mut groups = Vec::new();
    if files.len() > GROUP {
        let mut joined = Vec::new();
        for members in files.chunks(GROUP) {
            let timer = ThreadTimer::start();
            let group = PartialPicture::join(read(members)?).map_err(|e| e.to_string())?;
            joined.push(bytes(&group)?);
            groups.push(timer.seconds());
        }
        files = joined;
    }
    let timer = ThreadTimer::start();
    let film = PartialPicture::merge(read(&files)?).map_err(|e| e.to_string())?;
    core::hint::black_box(film.develop());
    let merge = timer.seconds();
    Ok(Tasks {
        parts,
        groups,
        merge,
    })
}

/// A part as a worker makes it, which begins with the scene.
fn rendered(job: Job, samples: Range<u32>) -> Result<PartialPicture, String> {
    let scene = BuiltinScene::Night.load();
    let view = View::new(&scene.camera_or_default(), job.width, job.height);
    let view = view.map_err(|e| e.to_string())?;
    let digest = SceneDigest::new(&scene).map_err(|e| e.to_string())?;
    let world = World::new(scene).map_err(|e| e.to_string())?;
    let settings = RenderSettings {
        samples: samples.clone(),
        time_limit: None,
        seed: 0,
        path: PathSettings {
            max_depth: 8,
            estimator: Estimator::default(),
            light_samples: PathSettings::DEFAULT_LIGHT_SAMPLES,
            integrator: Integrator::default(),
        },
    };
    let sampler =
        AnyLightSampler::new(SamplerKind::DEFAULT, world.lights()).map_err(|e| e.to_string())?;
    let sampler = sampler.by_estimates(&world, &view, settings.path.max_depth);
    let film = render(&world, &view, &sampler, &settings, |_| {}).film;
    let kind = SamplerKind::DEFAULT;
    let identity = digest.identity(&world, &view, &settings, kind, Visibility::Share);
    Ok(PartialPicture {
        film,
        samples,
        identity,
    })
}

fn bytes(part: &PartialPicture) -> Result<Vec<u8>, String> {
    part.to_bytes("part.exr".as_ref())
        .map_err(|e| e.to_string())
}

fn read(files: &[Vec<u8>]) -> Result<Vec<PartialPicture>, String> {
    let parse = |file: &Vec<u8>| PartialPicture::parse("part.exr".as_ref(), file);
    let parts: Result<_, _> = files.iter().map(parse).collect();
    parts.map_err(|e| e.to_string())
}

impl Tasks {
    /// Seconds until the picture is there, with so many workers.
    fn seconds(&self, workers: usize) -> f64 {
        let mut free = vec![0.0_f64; workers];
        let mut run = |seconds: f64, after: f64| {
            let next = free.iter_mut().min_by(|a, b| a.total_cmp(b));
            next.map_or(f64::INFINITY, |free| {
                *free = free.max(after) + seconds;
                *free
            })
        };
        let parts: Vec<f64> = self.parts.iter().map(|&part| run(part, 0.0)).collect();
        let last = |ends: &[f64]| ends.iter().copied().fold(0.0, f64::max);
        let members = parts.chunks(GROUP).map(last);
        let groups: Vec<f64> = members
            .zip(&self.groups)
            .map(|(after, &group)| run(group, after))
            .collect();
        let after = last(if groups.is_empty() { &parts } else { &groups });
        run(self.merge, after)
    }
}

/// The table of `rows`, as Markdown.
pub(super) fn table(rows: &[Throughput]) -> String {
    let mut table = "| workers | seconds | million samples a second | efficiency |\n\
                     | --- | --- | --- | --- |\n"
        .to_owned();
    for row in rows {
        table += &format!(
            "| {} | {:.1} | {:.2} | {:.0} % |\n",
            row.workers,
            row.seconds,
            row.samples,
            100.0 * row.efficiency
        );
    }
    table
}

/// What is plotted: the throughput, and that of one worker times their number.
pub(super) fn series(rows: &[Throughput]) -> Vec<PlotSeries> {
    let one = rows.first().map_or(0.0, |row| row.samples);
    let line = |name: &str, of: &dyn Fn(&Throughput) -> f64| PlotSeries {
        name: name.into(),
        points: rows
            .iter()
            .map(|row| [row.workers as f64, of(row)])
            .collect(),
    };
    vec![
        line("parts of a farm", &|row| row.samples),
        line("one worker, times the workers", &|row| {
            one * row.workers as f64
        }),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn workers_wait_for_what_a_merge_needs() {
        let tasks = Tasks {
            parts: vec![1.0, 4.0, 2.0, 2.0],
            groups: Vec::new(),
            merge: 0.5,
        };
        assert_eq!(tasks.seconds(1), 9.5, "one after the other");
        // The second worker has the long part, the first all others.
        assert_eq!(tasks.seconds(2), 5.5, "5 and 4 seconds");
        assert_eq!(tasks.seconds(16), 4.5, "as long as the longest");
        let tasks = Tasks {
            parts: vec![1.0; 40],
            groups: vec![0.25, 0.25],
            merge: 0.5,
        };
        assert_eq!(tasks.seconds(40), 1.75, "both groups at once");
        assert_eq!(tasks.seconds(1), 41.0, "one after the other");
    }

    #[test]
    fn more_workers_render_more() {
        let rows = measure(Job::QUICK, |_| {}).expect("a picture");
        let workers: Vec<usize> = rows.iter().map(|row| row.workers).collect();
        assert_eq!(workers, WORKERS, "a row each");
        for pair in rows.windows(2) {
            assert!(pair[1].samples > pair[0].samples, "{pair:?}");
            assert!(pair[1].efficiency <= 1.0 + 1e-9, "{pair:?}");
        }
        assert_eq!(table(&rows).lines().count(), 2 + WORKERS.len(), "a table");
        assert_eq!(
            series(&rows)[1].points[0],
            series(&rows)[0].points[0],
            "one"
        );
    }
}
