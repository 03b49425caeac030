use core::fmt;
use std::path::{Path, PathBuf};

use crate::SamplerKind;
use crate::bench::{
    BenchOptions, BenchRow, Measurement, RefitRow, SceneBenchOptions, Shadows, bench, bench_scene,
    refits,
};
use light_sets::BenchSet;
use serde_json::Value;

use super::bench_args::BenchArgs;
use super::failure::Failure;
use super::memory_check::check_memory;
use super::output_file::{expect_another, refuse};
use super::sampler_list::samplers;
use super::scene_input::SceneInput;
use super::stdout::say;

/// What a light takes while samplers are built over it one after another and measured side by side:
/// itself, its bounds, and a node in each of them.
const BYTES_PER_LIGHT: u64 = 400;

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
            let is_dark = |row: &RefitRow| row.refitted.lit_points == 0;
            self.print(&RefitRow::header(), &rows, RefitRow::json)?;
            self.say_dark(rows.first().is_some_and(is_dark))
        } else {
            let rows = bench(&name, &set, &options).map_err(Failure::input)?;
            self.print(&BenchRow::header(), &rows, BenchRow::json)?;
            self.say_dark(rows.first().is_some_and(is_dark))
        }
    }

    /// Says why there is no V, below a table of points that `are_dark`.
    fn say_dark(&self, are_dark: bool) -> Result<(), Failure> {
        if self.json || !are_dark {
            return Ok(());
        }
        say!("No light reaches any of the points: V is not defined there, and shown as -.")
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
            let path = Path::new(&path);
            if path.file_stem() == path.file_name() {
                let words = "cannot be written: expected --write to end in a file's name";
                return Err(refuse(prefix, words));
            }
            expect_another(path, &inputs, "--lights and --points for --write")
        })
    }

    fn measurement(&self, samplers: Vec<SamplerKind>) -> Measurement {
        Measurement {
            samplers,
            k: self.k,
            var_points: self.var_points.map(|points| points as usize),
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
        let rows = bench_scene(&name, &world, &options);
        let rows = rows.map_err(|error| input.refuse_choice(&error))?;
        let Some(row) = rows.first() else {
            let message = "no point that lights could be seen from: expected a surface that \
                           scatters light into more than single directions";
            return Err(refuse(path, message));
        };
        self.print(&BenchRow::header(), &rows, BenchRow::json)?;
        if self.json || is_dark(row) {
            return self.say_dark(is_dark(row));
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

/// Whether no light reaches any of the points, so that there is no V.
const fn is_dark(row: &BenchRow) -> bool {
    row.variance.lit_points == 0
}
