//! The table of statistical laws in the README names every kind that the sources have, and tests
//! that exist.

use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};

use light_testkit::PROGRAMS;

fn crates() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn read(path: &str) -> String {
    let path = crates().join(path);
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// Kinds and their tests, `file::function` each.
fn table() -> HashMap<String, Vec<String>> {
    let readme = read("light-testkit/README.md");
    let (_, statistics) = readme.split_once("| kind | laws |").expect("a table");
    let rows = statistics.lines().filter_map(|line| {
        let names: Vec<String> = line
            .split('`')
            .skip(1)
            .step_by(2)
            .map(String::from)
            .collect();
        let (kind, tests) = names.split_first()?;
        Some((kind.clone(), tests.to_vec()))
    });
    rows.collect()
}

/// The variants of an enum of a source file.
fn variants(path: &str, name: &str) -> Vec<String> {
    let source = read(path);
    let (_, body) = source
        .split_once(&format!("pub enum {name}"))
        .expect("an enum");
    let (body, _) = body.split_once("\n}").expect("its end");
    let is_variant =
        |line: &&str| line.starts_with("    ") && line[4..].starts_with(char::is_uppercase);
    let names = body.lines().filter(is_variant).map(|line| {
        let end = line[4..].find(|c: char| !c.is_alphanumeric());
        line[4..]
            .split_at(end.unwrap_or(line.len() - 4))
            .0
            .to_string()
    });
    names.collect()
}

/// What follows `before` up to the next character that no name has, in every line that holds it.
fn names_after(source: &str, before: &str) -> Vec<String> {
    let names = source.lines().filter_map(|line| {
        let (_, rest) = line.split_once(before)?;
        let end = rest.find(|c: char| !(c.is_alphanumeric() || c == '_'));
        Some(rest.split_at(end.unwrap_or(rest.len())).0.to_string())
    });
    names.filter(|name| !name.is_empty()).collect()
}

/// Source files below a folder, without those of tests.
fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder").flatten() {
        let path = entry.path();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|e| e == "rs") {
            found.push(path);
        }
    }
}

/// Every kind that something is drawn from.
fn kinds() -> Vec<String> {
    let mut kinds = variants(
        "light-sources/src/light_desc.rs",
        "LightDesc<C: ColorModel>",
    );
    kinds.extend(variants("light-sources/src/shape/any.rs", "ShapeDesc"));
    kinds.extend(variants("light-media/src/phase/mod.rs", "Phase"));
    // Implementations for types, generic ones too; that for references has no name.
    let mut files = Vec::new();
    sources(&crates().join("light-samplers/src"), &mut files);
    for path in files {
        let text = fs::read_to_string(&path).expect("a source");
        let implementations = text.lines().filter(|line| line.starts_with("impl"));
        kinds.extend(implementations.flat_map(|line| names_after(line, " LightSampler for ")));
    }

    let warps = read("light-math/src/warp/mod.rs");
    kinds.extend(names_after(&warps, "pub mod "));
    kinds.extend(names_after(&warps, "pub use equiangular::"));
    kinds.extend(names_after(&warps, "pub use spherical_rectangle::"));
    kinds.extend(names_after(&warps, "pub use spherical_triangle::"));
    assert_eq!(
        warps.matches("pub use ").count(),
        3,
        "another warp: name it here"
    );

    let mut files = Vec::new();
    sources(&crates().join("light-math/src/distribution"), &mut files);
    for path in files {
        let text = fs::read_to_string(&path).expect("a source");
        let types = names_after(&text, "pub struct ");
        let drawn = text.contains("    pub fn sample(");
        kinds.extend(
            types
                .into_iter()
                .filter(|name| drawn && !name.starts_with("Sample") && !name.ends_with("Bin")),
        );
    }
    // Every file of the media that takes random numbers.
    let mut files = Vec::new();
    sources(&crates().join("light-media/src"), &mut files);
    for path in files {
        let text = fs::read_to_string(&path).expect("a source");
        if text.contains("next_u: &mut impl FnMut() -> f32") {
            kinds.push(
                path.file_stem()
                    .expect("a name")
                    .to_string_lossy()
                    .into_owned(),
            );
        }
    }
    // What is drawn by none of the names above.
    let others = [
        "discrete",
        "equal_area",
        "SampledWavelengths",
        "WeightedReservoir",
        "LightChoices::resampled",
    ];
    kinds.extend(others.map(String::from));
    kinds
}

#[test]
fn every_kind_has_its_law() {
    let (table, kinds) = (table(), kinds());
    assert!(kinds.len() > 50, "{kinds:?}");
    for kind in &kinds {
        let tests = table.get(kind).map_or(&[][..], Vec::as_slice);
        assert!(
            !tests.is_empty(),
            "{kind} has no statistical law in README.md"
        );
    }
    for kind in table.keys() {
        assert!(
            kinds.contains(kind),
            "{kind} of README.md is no kind of the sources"
        );
    }
}

#[test]
fn every_law_is_a_test() {
    for (kind, tests) in table() {
        for test in tests {
            let (file, function) = test.split_once("::").expect("a file and a test");
            let source = read(file);
            let found = source.contains(&format!("#[test]\nfn {function}()"))
                || source.contains(&format!("#[test]\n    fn {function}()"))
                || source.contains(&format!("    mod {function} {{"));
            assert!(found, "{kind}: there is no test {test}");
        }
    }
}

/// No more programs take statistical tests than the level was divided among.
#[test]
fn programs_are_as_many_as_stated() {
    let takes_tests = |text: &str| {
        [
            "DensityTest",
            "Estimate",
            "chi_squared",
            "kolmogorov",
            "sampler_laws!",
            "laws::light",
        ]
        .iter()
        .any(|name| text.contains(name))
    };
    let takes = |path: &Path| {
        let mut files = Vec::new();
        if path.is_dir() {
            sources(path, &mut files);
        } else if path.is_file() {
            files.push(path.to_path_buf());
        }
        let mut texts = files
            .iter()
            .map(|path| fs::read_to_string(path).expect("a source"));
        texts.any(|text| takes_tests(&text))
    };
    let mut programs = 0u32;
    for entry in fs::read_dir(crates()).expect("the crates").flatten() {
        // All unit tests of a crate are one program; of the integration tests each file and each
        // folder is one.
        let mut targets = vec![entry.path().join("src")];
        if let Ok(tests) = fs::read_dir(entry.path().join("tests")) {
            targets.extend(tests.flatten().map(|target| target.path()));
        }
        let taking = targets.iter().filter(|target| takes(target)).count();
        programs += u32::try_from(taking).expect("few");
    }
    assert!(
        (10..=PROGRAMS).contains(&programs),
        "{programs} programs take statistical tests: raise PROGRAMS"
    );
}
