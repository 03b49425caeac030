use core::fmt;

use serde_json::{Value, json};

use super::laws::Laws;
use super::timing::QueryTime;
use super::variance::{Ceiling, Variance};
use crate::SamplerKind;

/// The measurements of one sampler on one set.
#[derive(Clone, Debug)]
pub struct BenchRow {
    /// Name of the set.
    pub set: String,
    /// Lights of the set.
    pub n_lights: usize,
    /// The sampler.
    pub sampler: SamplerKind,
    /// Samples of one call.
    pub k: u32,
    /// Points that the variance was taken over.
    pub points: usize,
    /// Milliseconds to build.
    pub build_ms: f64,
    /// Milliseconds to refit to lights that moved, if the sampler can.
    pub refit_ms: Option<f64>,
    /// Bytes that a query may touch.
    pub bytes: usize,
    /// Nodes on the longest path from the root.
    pub depth: usize,
    /// Time of the queries.
    pub time: QueryTime,
    /// Variance of the estimate.
    pub variance: Variance,
    /// How well the sampler obeys the laws.
    pub laws: Laws,
}

impl BenchRow {
    /// The title line of a table of rows.
    #[must_use]
    pub fn header() -> String {
        format!(
            "{:<11} {:>8} {:<14} {:>3} {:>10} {:>9} {:>8} {:>5} {:>9} {:>8} {:>9} {:>9} {:>9} \
             {:>9} {:>9} {:>9} {:>8}",
            "set",
            "lights",
            "sampler",
            "k",
            "build ms",
            "refit ms",
            "B/light",
            "depth",
            "ns/sample",
            "ns/pmf",
            "V mean",
            "V median",
            "V 99 %",
            "V within",
            "V best",
            "lost",
            "no light"
        )
    }

    /// The row as one JSON object; V is null where no light reaches a point, and the time of a pmf
    /// where no light is picked.
    #[must_use]
    pub fn json(&self) -> Value {
        // A number that is none, such as NaN, is null in JSON.
        json!({
            "set": self.set,
            "n_lights": self.n_lights,
            "sampler": self.sampler.name(),
            "k": self.k,
            "v_points": self.points,
            "lit_points": self.variance.lit_points,
            "build_ms": self.build_ms,
            "refit_ms": self.refit_ms,
            "bytes": self.bytes,
            "depth": self.depth,
            "ns_sample": self.time.sample,
            "ns_pmf": self.time.pmf,
            "ns_pmf_random_light": self.time.pmf_random_light,
            "v_mean": self.variance.mean,
            "v_median": self.variance.median,
            "v_p99": self.variance.p99,
            "v_flux": self.variance.flux_weighted,
            "v_se": self.variance.standard_error,
            "v_within": self.variance.ceiling.map(|ceiling| ceiling.within),
            "v_best": self.variance.ceiling.map(|ceiling| ceiling.best),
            "arriving": self.variance.ceiling.map(|ceiling| ceiling.arriving),
            "lost_energy": self.variance.lost_energy,
            "no_light": self.laws.no_light,
            "pmf_mismatch": self.laws.pmf_mismatch,
            "pmf_nan": self.laws.pmf_nan,
            "pmf_sum_max_error": self.laws.pmf_sum_max_error,
        })
    }
}

impl fmt::Display for BenchRow {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let v = &self.variance;
        let ceiling = |of: fn(Ceiling) -> f64| match v.ceiling.map(of) {
            Some(value) => format!("{value:.3}"),
            None if v.lit_points == 0 => "-".to_owned(),
            None => String::new(),
        };
        write!(
            f,
            "{:<11} {:>8} {:<14} {:>3} {:>10.2} {:>9} {:>8.1} {:>5} {:>9.0} {:>8} {:>9} {:>9} \
             {:>9} {:>9} {:>9} {:>9} {:>8.4}",
            self.set,
            self.n_lights,
            self.sampler.name(),
            self.k,
            self.build_ms,
            self.refit_ms
                .map_or_else(String::new, |ms| format!("{ms:.2}")),
            self.bytes as f64 / self.n_lights.max(1) as f64,
            self.depth,
            self.time.sample,
            known(self.time.pmf, format_args!("{:.0}", self.time.pmf)),
            known(v.mean, format_args!("{:.3}", v.mean)),
            known(v.median, format_args!("{:.3}", v.median)),
            known(v.p99, format_args!("{:.2}", v.p99)),
            ceiling(|ceiling| ceiling.within),
            ceiling(|ceiling| ceiling.best),
            known(v.lost_energy, format_args!("{:.1e}", v.lost_energy)),
            self.laws.no_light,
        )?;
        let laws = &self.laws;
        if !laws.hold() {
            write!(
                f,
                "  BROKEN: mismatch {:.1e}, nan {:.1e}, sum {:+.1e}",
                laws.pmf_mismatch, laws.pmf_nan, laws.pmf_sum_max_error
            )?;
        }
        Ok(())
    }
}

/// The words for a number of a table, or a dash where it is NaN: where no point is lit.
pub(super) fn known(number: f64, words: fmt::Arguments<'_>) -> String {
    if number.is_nan() {
        "-".to_owned()
    } else {
        words.to_string()
    }
}
