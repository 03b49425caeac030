//! Long runs: very many choices of lights and samples of lights, each of them held against the
//! query for its probability or density; and every octahedral code.

mod choices;
mod described_lights;
mod light_samples;
pub mod octahedral_codes;
mod receivers;
mod report;
mod sets;

pub use report::{Report, Row};

use core::sync::atomic::{AtomicU64, Ordering};

use rayon::prelude::*;

/// Samples that a thread takes of one case before it continues with another.
const CHUNK: u64 = 1 << 17;

/// How much is sampled, from which random numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Soak {
    /// Choices of a light, over all sets, samplers and receivers.
    pub choices: u64,
    /// Samples of a light, over all kinds.
    pub light_samples: u64,
    /// Equal seeds give equal samples, on any number of threads.
    pub seed: u64,
}

impl Soak {
    /// Runs on all threads of rayon, and calls `progress` now and then with the number of samples
    /// done and the number of all.
    #[must_use]
    pub fn run(&self, progress: impl Fn(u64, u64) + Sync) -> Report {
        let done = AtomicU64::new(0);
        let total = self.choices + self.light_samples;
        let tell = |count: u64| progress(done.fetch_add(count, Ordering::Relaxed) + count, total);
        let mut report = Report::default();
        let sets = sets::sets();
        let lights = described_lights::lights();
        report.rows = sets::rows(&sets);
        report.rows.extend(light_samples::rows(&lights));
        let first_light = sets.len();
        let chunks = (0..self.choices.div_ceil(CHUNK)).map(|i| {
            let row = (i % sets.len() as u64) as usize;
            (row, i, CHUNK.min(self.choices - i * CHUNK))
        });
        let light_chunks = (0..self.light_samples.div_ceil(CHUNK)).map(|i| {
            let row = first_light + (i % lights.len() as u64) as usize;
            (row, i, CHUNK.min(self.light_samples - i * CHUNK))
        });
        let work: Vec<(usize, u64, u64)> = chunks.chain(light_chunks).collect();
        let parts: Vec<(usize, Row)> = work
            .into_par_iter()
            .map(|(row, chunk, count)| {
                let seed = self.seed ^ (row as u64) << 48 ^ chunk << 8;
                let part = match row.checked_sub(first_light) {
                    None => choices::soak(&sets[row], count, seed),
                    Some(light) => light_samples::soak(&lights, light, count, seed),
                };
                tell(count);
                (row, part)
            })
            .collect();
        for (row, part) in parts {
            report.rows[row].add(part);
        }
        report
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_short_soak_finds_nothing_and_repeats() {
        let soak = Soak {
            choices: 20 * CHUNK / 16,
            light_samples: CHUNK,
            seed: 1,
        };
        let (report, again) = (soak.run(|_, _| ()), soak.run(|_, _| ()));
        assert_eq!(report.mismatches(), 0, "{report}");
        assert_eq!(report.to_string(), again.to_string(), "the same seed");
    }
}
