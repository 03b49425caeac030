use core::fmt;
use std::path::{Path, PathBuf};

use crate::SamplerKind;
use crate::bench::{
    BenchOptions, BenchReceiverKind, BenchRow, GroundTruth, Measurement, RefitRow,
    SceneBenchOptions, Shadows, bench, bench_scene, refits,
};
use clap::Args;
use light_sets::{BenchSet, SetKind};
use serde_json::Value;

use super::arguments::{named, threads};
use super::failure::Failure;
use super::memory_check::check_memory;
use super::output_file::{expect_another, refuse};
use super::sampler_list::{list, samplers};
use super::scene_input::{SceneChanges, SceneInput};
use super::stdout::say;

/// What a light takes while samplers are built over it one after another and measured side by side:
/// itself, its bounds, and a node in each of them.
const BYTES_PER_LIGHT: u64 = 400;

/// What is said of a scene, and not of a set.
const OF_A_SCENE: [&str; 7] = [
    "scene",
    "env",
    "env_rotate",
    "sky",
    "env_scale",
    "light_scale",
    "emit",
];

/// Measure light samplers side by side on the lights of a scene, or on a set of lights.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lights bench room.obj --shadows
  lights bench chair.glb --sky clear-noon
  lights bench --generate clusters --n 100000 --samplers bvh-reference,bvh
  lights bench --lights a.lights --points a.points --json

Columns:
  set, lights     name of the set or scene, and its number of lights
  sampler, k      how lights are chosen, and how many a call chooses
  build ms        milliseconds to build the sampler, with --threads threads
  bytes, B/light  bytes that a choice may touch, in all and a light
  depth           nodes on the longest path from the root of a tree
  ns/sample       nanoseconds to choose a light
  ns/pmf          nanoseconds to find the probability of a light
  V mean, median  variance of the estimate of one choice, over the square of what all lights give
                  at the point; mean and median over the points. With --k it is K times the
                  variance of the mean of K choices
  V 99 %          what 99 of 100 points stay below
  V within        variance that is left within lights whichever is chosen, for lights with an area
  V best          variance of the best choice there is; --shadows shows how much of it they cause
  lost            share of the light that comes from lights that are never chosen: 0 if right
  no light        share of choices that choose none, where bounds grow tighter on the way down")]
pub(crate) struct BenchArgs {
    /// The scene, whose lights are seen from points on its surfaces: an .obj, .pbrt, .gltf or .glb
    /// file, or one that ships, as for lights render.
    scene: Option<PathBuf>,
    #[command(flatten)]
    changes: SceneChanges,
    /// Let the surfaces of the scene hide its lights.
    #[arg(long, requires = "scene", conflicts_with_all = ["generate", "lights"])]
    shadows: bool,
    /// Lights of the set to read; needs --points.
    #[arg(
        long,
        value_name = "FILE",
        requires = "points",
        conflicts_with_all = OF_A_SCENE
    )]
    lights: Option<PathBuf>,
    /// Shading points of the set to read; needs --lights.
    #[arg(long, value_name = "FILE", requires = "lights")]
    points: Option<PathBuf>,
    /// Make a set: of plain lights, a place, or an adversarial set.
    #[arg(
        long,
        value_name = "KIND",
        conflicts_with_all = ["lights", "points"].into_iter().chain(OF_A_SCENE),
        value_parser = named::<SetKind>(SetKind::all().map(SetKind::name))
    )]
    generate: Option<SetKind>,
    /// Lights of the set to make.
    #[arg(
        long,
        value_name = "N",
        default_value_t = 10_000,
        conflicts_with = "scene",
        value_parser = clap::value_parser!(u32).range(1..)
    )]
    n: u32,
    /// Seed of the set to make, or of the points on surfaces.
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Keep the set as PREFIX.lights and PREFIX.points.
    #[arg(long, value_name = "PREFIX", conflicts_with = "scene")]
    write: Option<PathBuf>,
    /// Samplers to measure, with commas between: uniform, power, exhaustive, bvh-reference, bvh,
    /// bvh-morton.
    #[arg(long, value_name = "LIST", default_value_t = list(&SamplerKind::SUBLINEAR))]
    samplers: String,
    /// Samples of one call, at most 4096.
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=1 << 12))]
    k: u32,
    /// Points that the variance is taken over. By default all, or 256 above 10 thousand lights; in
    /// a scene 4096, or fewer of more than 512 lights.
    #[arg(long, value_name = "M")]
    var_points: Option<usize>,
    /// Threads for building, at most 1024.
    #[arg(long, value_name = "T", default_value_t = 1, value_parser = threads)]
    threads: usize,
    /// Contribution of a triangle: `centroid`, or `area` for the mean over sixteen points of it.
    #[arg(long = "truth", default_value = "centroid", conflicts_with = "scene")]
    ground_truth: GroundTruth,
    /// The receivers: `diffuse`, `two-sided`, `medium`, or `glossy:ROUGHNESS` for half diffuse,
    /// half microfacets.
    #[arg(long, default_value = "diffuse", conflicts_with = "scene")]
    receiver: BenchReceiverKind,
    /// Spheres that block light, a tenth of the set's volume together; at most 65536.
    #[arg(
        long,
        value_name = "N",
        default_value_t = 0,
        conflicts_with = "scene",
        value_parser = clap::value_parser!(u32).range(..=1 << 16)
    )]
    occluders: u32,
    /// Move the lights in N steps, at most 20, each twice as far as the last, and compare
    /// hierarchies that follow with new ones.
    #[arg(
        long,
        value_name = "N",
        conflicts_with_all = ["k", "scene"],
        value_parser = clap::value_parser!(u32).range(..=20)
    )]
    refits: Option<u32>,
    /// One JSON object a line instead of a table.
    #[arg(long)]
    json: bool,
}

impl BenchArgs {
    /// Measures, and prints one line a sampler.
    ///
    /// # Errors
    /// A file that cannot be read or written, or arguments that do not fit together.
    pub(crate) fn run(&self) -> Result<(), Failure> {
        let samplers = samplers(&self.samplers)?;
        // The measurement starts its threads as if that could not fail.
        rayon::ThreadPoolBuilder::new()
            .num_threads(self.threads)
            .build()
            .map_err(|error| Failure::Input(format!("--threads: {error}")))?;
        if let Some(scene) = &self.scene {
            let input = SceneInput {
                scene: scene.clone(),
                changes: self.changes.clone(),
            };
            return self.run_scene(&input, self.measurement(samplers));
        }
        self.expect_outputs()?;
        let (name, set) = self.set()?;
        if let Some(prefix) = &self.write {
            light_scene::write_light_set(&set, prefix).map_err(Failure::input)?;
        }
        let options = BenchOptions {
            measurement: self.measurement(samplers),
            ground_truth: self.ground_truth,
            receiver: self.receiver,
            occluders: self.occluders as usize,
        };
        if let Some(steps) = self.refits {
            let rows = refits(&name, &set, &options, steps).map_err(Failure::input)?;
            self.print(&RefitRow::header(), &rows, RefitRow::json)
        } else {
            let rows = bench(&name, &set, &options).map_err(Failure::input)?;
            self.print(&BenchRow::header(), &rows, BenchRow::json)
        }
    }

    /// Makes sure that --write keeps the set beside the files that are read.
    fn expect_outputs(&self) -> Result<(), Failure> {
        let Some(prefix) = &self.write else {
            return Ok(());
        };
        let inputs: Vec<PathBuf> = self.lights.iter().chain(&self.points).cloned().collect();
        ["lights", "points"].into_iter().try_for_each(|ending| {
            let mut path = prefix.clone().into_os_string();
            path.push(format!(".{ending}"));
            expect_another(
                Path::new(&path),
                &inputs,
                "--lights and --points for --write",
            )
        })
    }

    fn measurement(&self, samplers: Vec<SamplerKind>) -> Measurement {
        Measurement {
            samplers,
            k: self.k,
            var_points: self.var_points,
            is_timed: true,
            threads: self.threads.max(1),
        }
    }

    /// Measures on the lights of a scene.
    fn run_scene(&self, input: &SceneInput, measurement: Measurement) -> Result<(), Failure> {
        let world = input.build(input.read_lit(false)?)?;
        input.expect_light(&world)?;
        input.expect_few_lights(&world, "bench")?;
        let lights = world.lights().len();
        let path = &input.scene;
        let options = SceneBenchOptions {
            measurement,
            seed: self.seed,
            shadows: if self.shadows {
                Shadows::Cast
            } else {
                Shadows::Off
            },
        };
        let name = path
            .file_stem()
            .map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
        let rows = bench_scene(&name, &world, &options).map_err(Failure::input)?;
        let Some(row) = rows.first() else {
            let message = "no point that lights could be seen from: expected a surface that \
                           scatters light into more than single directions";
            return Err(refuse(path, message));
        };
        self.print(&BenchRow::header(), &rows, BenchRow::json)?;
        if self.json {
            return Ok(());
        }
        let strata = SceneBenchOptions::strata_for(lights);
        let way = if self.shadows {
            "what surfaces hide does not count"
        } else {
            "nothing in the way"
        };
        let how = if self.k == 1 { "exact" } else { "estimated" };
        say!(
            "V at {} points of surfaces, {how}, over all {lights} lights: each by {} points of it, \
             {way}.",
            row.points,
            strata * strata
        )
    }

    /// A table, or one JSON object a row.
    fn print<R: fmt::Display>(
        &self,
        header: &str,
        rows: &[R],
        json: impl Fn(&R) -> Value,
    ) -> Result<(), Failure> {
        if !self.json {
            say!("{header}")?;
        }
        for row in rows {
            if self.json {
                say!("{}", json(row))?;
            } else {
                say!("{row}")?;
            }
        }
        Ok(())
    }

    fn set(&self) -> Result<(String, BenchSet), Failure> {
        if let (Some(lights), Some(points)) = (&self.lights, &self.points) {
            let name = lights
                .file_stem()
                .map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
            let set = light_scene::read_light_set(lights, points).map_err(Failure::input)?;
            return Ok((name, set));
        }
        let kind = self.generate.ok_or_else(|| {
            Failure::Input(
                "expected a SCENE, --generate KIND, or --lights FILE --points FILE".into(),
            )
        })?;
        check_memory(
            &format!("--n {}", self.n),
            u64::from(self.n) * BYTES_PER_LIGHT,
        )?;
        Ok((
            kind.name().to_owned(),
            BenchSet::generate(kind, self.n as usize, self.seed),
        ))
    }
}
