//! How the shader's answers compare with those of the crates.

use core::fmt;

use light_bounds::LightId;
use light_samplers::{BvhLightSamplerRef, LightSampler};

use crate::query::{Answer, Query};

/// The least share of queries for which the shader has to choose the same light.
const SAME: f64 = 0.99;

/// Differences of a probability, as a part of it, that are counted. The first would be rounding;
/// one part of a node's 2^16 is more.
const DIFFERENCES: [f32; 2] = [1e-4, 1e-2];

/// How many lights are chosen at a receiver.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Choices {
    /// One, from the root.
    Single,
    /// One of four, by a cut.
    OfFour,
}

impl Choices {
    /// That of the shader.
    pub const fn entry_point(self) -> &'static str {
        match self {
            Self::Single => "choose",
            Self::OfFour => "choose_by_cut",
        }
    }
}

impl fmt::Display for Choices {
    /// What a row of the table adds to the name of a set.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Single => "",
            Self::OfFour => ", of four",
        })
    }
}

/// What differs between the answers to so many queries.
#[derive(Clone, Copy, Debug, Default)]
pub struct Tally {
    queries: u32,
    /// Choices of another light, or of one instead of none.
    others: u32,
    /// Probabilities that were compared.
    pmfs: u32,
    /// Those that are not the same bits.
    unlike: u32,
    /// Those of [`DIFFERENCES`] and more.
    beyond: [u32; 2],
    /// The largest relative difference.
    largest: f32,
    /// The sum of all.
    sum: f64,
    /// Probabilities of which one is 0 and the other is not.
    zeros: u32,
    /// Samples whose probability the shader does not find again.
    unequal: u32,
}

impl Tally {
    /// The head of the table.
    pub const HEAD: &str = "\
| set | same light | unlike pmfs | by 1e-4, by 1e-2 | mean, largest difference | zeros | \
not found again | M queries/s |
| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |";

    /// Compares the answer to one query with those of the crates.
    pub fn add(
        &mut self,
        sampler: &BvhLightSamplerRef<'_>,
        choices: Choices,
        query: &Query,
        theirs: &Answer,
    ) {
        self.queries += 1;
        let (count, u) = match choices {
            Choices::Single => (1, query.u()),
            Choices::OfFour => (4, query.u_of_four()),
        };
        let here = sampler.at(&query.context(), count);
        let chosen = here.sample(u).map(|s| s.light);
        let light = LightId(theirs.light);
        let theirs_chosen = (theirs.pmf > 0.0).then_some(light);
        if chosen != theirs_chosen {
            self.others += 1;
        }
        if theirs_chosen.is_some() {
            self.compare(here.pmf(light), theirs.pmf);
            self.unequal += u32::from(theirs.again.to_bits() != theirs.pmf.to_bits());
        }
        self.compare(here.pmf(query.other()), theirs.other);
    }

    fn compare(&mut self, ours: f32, theirs: f32) {
        self.pmfs += 1;
        self.zeros += u32::from((ours > 0.0) != (theirs > 0.0));
        if ours != theirs {
            let difference = (theirs / ours - 1.0).abs();
            self.unlike += 1;
            for (count, least) in self.beyond.iter_mut().zip(DIFFERENCES) {
                *count += u32::from(difference >= least);
            }
            self.largest = self.largest.max(difference);
            self.sum += f64::from(difference);
        }
    }

    /// Whether it is what is promised.
    pub fn holds(&self) -> bool {
        self.zeros == 0 && self.unequal == 0 && self.same() >= SAME
    }

    fn same(&self) -> f64 {
        1.0 - f64::from(self.others) / f64::from(self.queries)
    }

    /// A row of the table.
    pub fn row(&self, set: &str, seconds: f64) -> String {
        let pmfs = f64::from(self.pmfs);
        let percent = |count: u32| 100.0 * f64::from(count) / pmfs;
        let [small, large] = self.beyond.map(percent);
        format!(
            "| {set} | {:.3} % | {:.2} % | {small:.2} %, {large:.3} % | {:.1e}, {:.1e} | {} | {} | {:.2} |",
            100.0 * self.same(),
            percent(self.unlike),
            self.sum / pmfs,
            self.largest,
            self.zeros,
            self.unequal,
            f64::from(self.queries) / seconds / 1e6,
        )
    }
}
