//! Each example is linked from the page of the item that it shows, and listed on the first page.

use std::fs;
use std::path::{Path, PathBuf};

/// Where a page finds the examples.
const ADDRESS: &str = "https://github.com/lights-rs/lights/blob/main/crates/lights/examples/";

/// The names of the examples.
fn examples() -> Vec<String> {
    let files = fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("examples"));
    let files = files
        .expect("a folder of examples")
        .map(|file| file.expect("a file").path());
    let programs = files.filter(|path| path.extension().is_some_and(|e| e == "rs"));
    let name = |path: PathBuf| path.file_stem()?.to_str().map(str::to_owned);
    programs.filter_map(name).collect()
}

/// The documentation in the sources below `folder`, added to `pages`.
fn read_pages(folder: &Path, pages: &mut String) {
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            read_pages(&path, pages);
        } else {
            let text = fs::read_to_string(&path).expect("a source file");
            let lines = text
                .lines()
                .filter(|line| line.trim_start().starts_with("///"));
            lines.for_each(|line| pages.extend([line, "\n"]));
        }
    }
}

#[test]
fn every_example_is_linked_from_a_page_and_every_link_leads_to_one() {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut pages = String::new();
    for name in ["bounds", "bvh", "media", "samplers", "sources"] {
        read_pages(&crates.join(format!("light-{name}/src")), &mut pages);
    }
    let first_page = fs::read_to_string(crates.join("lights/README.md")).expect("a first page");
    let examples = examples();
    assert!(examples.len() > 12, "{examples:?}");
    for name in &examples {
        assert!(
            pages.contains(&format!("{ADDRESS}{name}.rs\n")),
            "{name} is on no page"
        );
        assert!(
            first_page.contains(&format!("(examples/{name}.rs)")),
            "{name} is in no row"
        );
    }
    for link in pages.split(ADDRESS).skip(1) {
        let name = link.split('.').next().unwrap_or_default();
        assert!(
            examples.iter().any(|example| example == name),
            "there is no {name}"
        );
    }
}
