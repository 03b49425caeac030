//! The committed inputs of the fuzz targets, and their first random inputs, on stable.

use core::num::NonZero;
use core::sync::atomic::{AtomicUsize, Ordering};
use std::fs;
use std::path::Path;
use std::thread;

use light_testkit::Rng;
use light_testkit::fuzz::TARGETS;

/// The inputs of a target that are committed, in the order of their names.
fn corpus(name: &str) -> Vec<Vec<u8>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/corpus");
    let folder = folder.join(name);
    let files = fs::read_dir(&folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
    let mut paths: Vec<_> = files.map(|file| file.expect("an entry").path()).collect();
    paths.sort();
    let read = |path| fs::read(path).expect("a readable file");
    paths.into_iter().map(read).collect()
}

#[test]
fn the_committed_corpus_passes() {
    for (name, target) in TARGETS {
        for input in corpus(name) {
            target(&input);
        }
    }
}

#[test]
fn what_is_near_the_corpus_passes() {
    /// Neighbours of each input.
    const NEIGHBOURS: usize = 40;
    let mut rng = Rng::new(2);
    let mut inputs = Vec::new();
    for (name, target) in TARGETS {
        for input in corpus(name) {
            for _ in 0..NEIGHBOURS {
                let mut bytes = input.clone();
                for _ in 0..=rng.below(4) {
                    change(&mut bytes, &mut rng);
                }
                inputs.push((target, bytes));
            }
        }
    }
    // The longest test of the workspace: all cores share it.
    let next = AtomicUsize::new(0);
    let run = || {
        while let Some((target, bytes)) = inputs.get(next.fetch_add(1, Ordering::Relaxed)) {
            target(bytes);
        }
    };
    let cores = thread::available_parallelism().map_or(1, NonZero::get);
    thread::scope(|scope| {
        for _ in 0..cores {
            scope.spawn(run);
        }
    });
}

/// Replaces a byte, takes some out, repeats some, or cuts.
fn change(bytes: &mut Vec<u8>, rng: &mut Rng) {
    let at = rng.below(bytes.len() + 1);
    let end = (at + rng.below(8)).min(bytes.len());
    match rng.below(8) {
        0 => bytes.truncate(at),
        1 | 2 => drop(bytes.drain(at..end)),
        3 | 4 => {
            let again = bytes[at..end].to_vec();
            bytes.splice(at..at, again);
        }
        _ => {
            if let Some(byte) = bytes.get_mut(at) {
                *byte = rng.u32().to_le_bytes()[3];
            }
        }
    }
}

#[test]
fn random_bytes_pass() {
    let mut rng = Rng::new(1);
    for (_, target) in TARGETS {
        for _ in 0..2000 {
            let n = rng.below(400);
            let bytes: Vec<u8> = (0..n).map(|_| rng.u32().to_le_bytes()[3]).collect();
            target(&bytes);
        }
    }
}
