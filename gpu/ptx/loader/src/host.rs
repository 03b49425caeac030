//! The same queries on the host.

use std::hint::black_box;
use std::thread;
use std::time::Instant;

use light_bvh::LightBvhRef;

use crate::work::{Kernel, Work};

/// About how many queries a thread is timed by.
const TIMED: usize = 1 << 15;

/// The cores of this machine.
pub fn cores() -> usize {
    thread::available_parallelism().map_or(1, usize::from)
}

/// The answers, one behind the other.
pub fn answers(kernel: Kernel, tree: &LightBvhRef<'_>, work: &Work) -> Vec<u32> {
    let mut answers = vec![0; kernel.words * work.queries.len()];
    let each = work.queries.len().div_ceil(cores());
    thread::scope(|scope| {
        let answers = answers.chunks_mut(each * kernel.words);
        for (queries, answers) in work.queries.chunks(each).zip(answers) {
            scope.spawn(move || {
                for (query, answer) in queries.iter().zip(answers.chunks_mut(kernel.words)) {
                    (kernel.host)(tree, query, answer);
                }
            });
        }
    });
    answers
}

/// Millions of queries a second by so many threads.
pub fn rate(kernel: Kernel, tree: &LightBvhRef<'_>, work: &Work, threads: usize) -> f64 {
    let step = work.queries.len().div_ceil(TIMED);
    let queries: &Vec<_> = &work.queries.iter().step_by(step.max(1)).collect();
    let start = Instant::now();
    thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(move || {
                let mut answer = vec![0; kernel.words];
                for query in queries {
                    (kernel.host)(tree, query, &mut answer);
                    black_box(&answer);
                }
            });
        }
    });
    (threads * queries.len()) as f64 / start.elapsed().as_secs_f64() / 1e6
}
