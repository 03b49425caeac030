//! What the benches in `benches/`, the counts in `bin/counts.rs` and the tables of the pages
//! share: queries, memory and times, and where tables are written.

pub mod city;
pub mod exact_variance;
pub mod page;
pub mod peak_memory;
pub mod thread_time;

use light_testkit::{Rng, SamplerCase};
use lights::bounds::LightSampleContext;
use lights::glam::Vec2;

/// Queries in a cycle long enough to defeat branch prediction.
#[derive(Clone, Debug)]
pub struct Queries<T> {
    queries: Vec<T>,
    next: usize,
}

impl<T: Copy> Queries<T> {
    /// This many queries, each made from random numbers.
    pub fn new(make: impl FnMut(&mut Rng) -> T) -> Self {
        const COUNT: usize = 4096;
        let (mut rng, mut make) = (Rng::new(71), make);
        Self {
            queries: (0..COUNT).map(|_| make(&mut rng)).collect(),
            next: 0,
        }
    }

    /// The next query; after the last one the first.
    #[inline]
    pub fn next_query(&mut self) -> T {
        let query = self.queries[self.next];
        self.next = (self.next + 1) % self.queries.len();
        query
    }
}

/// Random contexts among the lights of a set, each with a random number to choose a light by.
#[must_use]
pub fn queries_of(set: &SamplerCase) -> Queries<(LightSampleContext, u64)> {
    let asked = SamplerCase::new("asked", set.emitters.clone(), 4096, 72);
    let mut contexts = asked.contexts.into_iter().cycle();
    Queries::new(|rng| (contexts.next().expect("a context"), rng.u64()))
}

/// Random points of the unit square.
#[must_use]
pub fn squares() -> Queries<Vec2> {
    Queries::new(Rng::vec2)
}
