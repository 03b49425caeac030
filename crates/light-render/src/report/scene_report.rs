use core::time::Duration;

use crate::bench::{BenchRow, Measurement, PixelVariance, SceneBenchOptions, bench_scene};
use crate::integrator::PathSettings;
use crate::plot::slope;
use crate::{
    AnyLightSampler, AnyLightSamplerError, Comparison, Flip, LightInventory, SamplerKind, View,
    World, inventory,
};

use super::chosen_pixels::{chosen_pixels, left_out};
use super::reference::Reference;
use super::sampler_row::SamplerRow;
use super::timed::Timed;

/// What is measured, and how long.
#[derive(Clone, Debug)]
pub(crate) struct ReportOptions {
    /// The scene's name.
    pub(crate) scene: String,
    pub(crate) samplers: Vec<SamplerKind>,
    /// For each picture, the building of the sampler included.
    pub(crate) time: Duration,
    pub(crate) path: PathSettings,
    pub(crate) seed: u32,
    /// Pixels that the variance is shown at; none for six of the report's choice.
    pub(crate) pixels: Vec<[u32; 2]>,
    /// What the reader has to know beside the numbers.
    pub(crate) notes: Vec<String>,
}

/// Samplers compared on a scene.
#[derive(Debug)]
pub(crate) struct SceneReport {
    pub(super) options: ReportOptions,
    pub(super) size: (u32, u32),
    /// The left upper corner of the part of the picture that is rendered.
    pub(super) corner: [u32; 2],
    pub(super) threads: usize,
    pub(super) triangles: usize,
    pub(super) quadrics: usize,
    pub(super) lights: usize,
    /// What the lights take beside a sampler, in bytes.
    pub(super) light_bytes: usize,
    pub(super) reference: Reference,
    pub(super) rows: Vec<SamplerRow>,
    pub(super) pixels: Vec<PixelVariance>,
    pub(super) inventory: Vec<LightInventory>,
}

impl SceneReport {
    /// Renders and measures on the threads of the current `rayon` pool; `show` hears of progress:
    /// what is done, its share, and samples a pixel.
    ///
    /// # Errors
    /// The first light that a sampler refuses.
    pub(crate) fn measure(
        (world, view): (&World, &View),
        reference: Reference,
        options: ReportOptions,
        mut show: impl FnMut(&str, f64, u32),
    ) -> Result<Self, AnyLightSamplerError> {
        let mut timed = Vec::new();
        for &kind in &options.samplers {
            let show = |share, samples| show(kind.name(), share, samples);
            let scene = (world, view);
            let picture = Timed::new(scene, kind, &options.path, options.seed, options.time, show)?;
            timed.push((kind, picture));
        }
        show("choices", 0.0, 0);
        let choices = choices(world, &options)?;
        show("pixels", 0.5, 0);
        let samplers: Vec<&AnyLightSampler> = timed.iter().map(|(_, t)| &t.sampler).collect();
        let pixels = chosen_pixels(world, view, &options.pixels, &samplers);
        let (width, _) = view.crop().size();
        let mut choices = choices.into_iter();
        let rows = timed
            .into_iter()
            .map(|(kind, timed)| row(kind, timed, &reference, width, world, choices.next()))
            .collect();
        let bytes = world.lights().bytes();
        Ok(Self {
            size: view.crop().size(),
            corner: view.crop().min,
            threads: rayon::current_num_threads(),
            triangles: world.triangle_count(),
            quadrics: world.quadric_count(),
            lights: world.lights().len(),
            light_bytes: bytes.lights + bytes.images + bytes.vertices,
            inventory: inventory(world.lights()),
            options,
            reference,
            rows,
            pixels,
        })
    }
}

impl SceneReport {
    /// What is said of the wanted pixels that have no variance.
    pub(crate) fn pixels_left_out(&self) -> Vec<String> {
        left_out(&self.options.pixels, &self.pixels)
    }

    /// What the pictures are compared with.
    pub(crate) const fn reference(&self) -> &Reference {
        &self.reference
    }

    /// A line a sampler, as a terminal shows them.
    pub(crate) fn table(&self) -> String {
        let mut table = format!(
            "{:<14} {:>7} {:>8} {:>10} {:>7} {:>8} {:>9}\n",
            "sampler", "spp", "seconds", "relMSE", "slope", "FLIP", "lost"
        );
        for row in &self.rows {
            let number = |x: Option<f64>| x.map_or_else(String::new, |x| format!("{x:.2}"));
            let lost = row.choice(|row| row.variance.lost_energy);
            table += &format!(
                "{:<14} {:>7} {:>8.2} {:>10.3e} {:>7} {:>8.4} {:>9}\n",
                row.kind.name(),
                row.samples,
                row.seconds,
                row.rel_mse,
                number(row.slope),
                row.flip.mean(),
                lost.map_or_else(String::new, |lost| format!("{lost:.1e}"))
            );
        }
        table
    }
}

/// Each sampler's choices at points of surfaces; none where no surface scatters light.
fn choices(world: &World, options: &ReportOptions) -> Result<Vec<BenchRow>, AnyLightSamplerError> {
    let measurement = Measurement {
        samplers: options.samplers.clone(),
        threads: rayon::current_num_threads(),
        ..Measurement::default()
    };
    let mut bench = SceneBenchOptions {
        measurement,
        ..SceneBenchOptions::default()
    };
    // A quarter of the points that `lights bench` takes: the page has pictures as well.
    let points = bench.points_for(world.lights().len()).div_ceil(4);
    bench.measurement.var_points = Some(points);
    bench_scene(&options.scene, world, &bench)
}

fn row(
    kind: SamplerKind,
    timed: Timed,
    reference: &Reference,
    width: u32,
    world: &World,
    choices: Option<BenchRow>,
) -> SamplerRow {
    let same = "pictures have the size of the reference";
    let convergence: Vec<(f64, u32, f64)> = timed
        .stages
        .iter()
        .map(|stage| {
            let error = reference.rel_mse_of(&stage.pixels);
            (stage.time.as_secs_f64(), stage.samples, error)
        })
        .collect();
    let points: Vec<[f64; 2]> = convergence.iter().map(|&(s, _, e)| [s, e]).collect();
    let mut stages = timed.stages;
    let last = stages.pop().expect("at least one sample a pixel");
    let flip = |of: fn(&[_], &[_], u32) -> Option<Flip>| {
        of(&last.pixels, &reference.pixels, width).expect(same)
    };
    SamplerRow {
        kind,
        build_ms: timed.build.as_secs_f64() * 1e3,
        seconds: last.time.as_secs_f64(),
        samples: last.samples,
        rays: timed.rays,
        rejected: timed.rejected,
        rel_mse: reference.rel_mse_of(&last.pixels),
        comparison: Comparison::new(&last.pixels, &reference.pixels).expect(same),
        flip_ldr: flip(Flip::ldr).mean(),
        flip: flip(Flip::hdr),
        slope: slope(&points),
        convergence,
        bytes: timed.sampler.bytes(world.lights().len()),
        choices,
        pixels: last.pixels,
    }
}
