use core::error::Error;
use core::fmt;
use core::str::FromStr;
use std::path::PathBuf;

use clap::Args;
use light_render::SamplerKind;
use light_render::bench::{BenchOptions, BenchRow, DriftRow, ReceiverKind, Truth, bench, drift};
use light_scene::light_set::{LightSetFile, SetKind};
use serde_json::Value;

/// Steps of moving lights: each goes twice as far.
const MAX_DRIFT: u32 = 20;

/// Measure light samplers side by side on a set of lights.
#[derive(Args, Debug)]
pub(crate) struct BenchArgs {
    /// Lights of the set to read; needs --points.
    #[arg(long, value_name = "FILE", requires = "points")]
    lights: Option<PathBuf>,
    /// Shading points of the set to read; needs --lights.
    #[arg(long, value_name = "FILE", requires = "lights")]
    points: Option<PathBuf>,
    /// Make a set: uniform, clusters, spots or mixed; adversarial ones are one-point, line, nested, large-world and magnitudes.
    #[arg(long, value_name = "KIND", conflicts_with_all = ["lights", "points"])]
    generate: Option<SetKind>,
    /// Lights of the set to make.
    #[arg(long, value_name = "N", default_value_t = 10_000)]
    n: usize,
    /// Seed of the set to make.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Keep the set as PREFIX.lights and PREFIX.points.
    #[arg(long, value_name = "PREFIX")]
    write: Option<PathBuf>,
    /// Samplers to measure, with commas between.
    #[arg(long, value_name = "LIST", default_value_t = default_samplers())]
    samplers: String,
    /// Samples of one call.
    #[arg(long, default_value_t = 1)]
    k: u32,
    /// Points that the variance is taken over: all, or 256 above 10 thousand lights, unless told.
    #[arg(long, value_name = "M")]
    var_points: Option<usize>,
    /// Threads for building.
    #[arg(long, value_name = "T", default_value_t = 1)]
    threads: usize,
    /// Contribution of a triangle: `centroid`, or `area` for the mean over sixteen points of it.
    #[arg(long, default_value = "centroid")]
    truth: Truth,
    /// Who asks: `diffuse`, `two-sided`, `medium`, or `glossy:ROUGHNESS` for half diffuse, half microfacets.
    #[arg(long, default_value = "diffuse")]
    receiver: ReceiverKind,
    /// Spheres that block light, a tenth of the set's volume together.
    #[arg(long, value_name = "N", default_value_t = 0)]
    occluders: usize,
    /// Move the lights in N steps, and compare hierarchies that follow with ones built anew.
    #[arg(long, value_name = "N", conflicts_with = "k")]
    drift: Option<u32>,
    /// One JSON object a line instead of a table.
    #[arg(long)]
    json: bool,
}

impl BenchArgs {
    /// Measures, and prints one line a sampler.
    ///
    /// # Errors
    /// A file that cannot be read or written, or arguments that do not fit together.
    pub(crate) fn run(&self) -> Result<(), Box<dyn Error>> {
        let samplers: Vec<SamplerKind> = self
            .samplers
            .split(',')
            .map(SamplerKind::from_str)
            .collect::<Result<_, _>>()?;
        if self.k == 0 {
            return Err("expected --k of at least 1".into());
        }
        let (name, set) = self.set()?;
        if let Some(prefix) = &self.write {
            set.write(prefix)?;
        }
        let options = BenchOptions {
            samplers,
            k: self.k,
            var_points: self.var_points,
            threads: self.threads.max(1),
            truth: self.truth,
            receiver: self.receiver,
            occluders: self.occluders,
        };
        if let Some(steps) = self.drift {
            if steps > MAX_DRIFT {
                return Err("expected --drift of at most 20".into());
            }
            let rows = drift(&name, &set, &options, steps);
            self.print(&DriftRow::header(), &rows, DriftRow::json);
        } else {
            let rows = bench(&name, &set, &options);
            self.print(&BenchRow::header(), &rows, BenchRow::json);
        }
        Ok(())
    }

    /// A table, or one JSON object a row.
    fn print<R: fmt::Display>(&self, header: &str, rows: &[R], json: impl Fn(&R) -> Value) {
        if !self.json {
            println!("{header}");
        }
        for row in rows {
            if self.json {
                println!("{}", json(row));
            } else {
                println!("{row}");
            }
        }
    }

    fn set(&self) -> Result<(String, LightSetFile), Box<dyn Error>> {
        if let (Some(lights), Some(points)) = (&self.lights, &self.points) {
            let name = lights
                .file_stem()
                .map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
            return Ok((name, LightSetFile::read(lights, points)?));
        }
        let kind = self
            .generate
            .ok_or("expected --generate KIND, or --lights FILE --points FILE")?;
        if self.n == 0 || u32::try_from(self.n).is_err() {
            return Err("expected --n of at least 1 and below 2^32".into());
        }
        Ok((
            kind.name().to_owned(),
            LightSetFile::generate(kind, self.n, self.seed),
        ))
    }
}

fn default_samplers() -> String {
    SamplerKind::SUBLINEAR.map(SamplerKind::name).join(",")
}
