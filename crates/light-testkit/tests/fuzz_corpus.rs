//! What the fuzz targets were fed once, and what would be their first random inputs, on stable.

use std::fs;
use std::path::Path;

use light_testkit::Rng;
use light_testkit::fuzz::TARGETS;

#[test]
fn the_committed_corpus_passes() {
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/corpus");
    for (name, target) in TARGETS {
        let folder = corpus.join(name);
        let files = fs::read_dir(&folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
        for file in files {
            let path = file.expect("an entry").path();
            target(&fs::read(path).expect("a readable file"));
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
