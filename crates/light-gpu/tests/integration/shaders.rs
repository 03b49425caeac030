//! The shaders are those that the constants and modules give, and valid.

use std::fs;
use std::path::{Path, PathBuf};

use light_gpu::{LIGHTS_WGSL, constants, flat};
use naga::valid::{Capabilities, ValidationFlags, Validator};

/// The function that the user writes.
const ROW: &str = "fn light_row(i: u32) -> vec4<u32> { return vec4<u32>(i); }";

fn wesl(file: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("wesl")
        .join(file)
}

fn read(file: &str) -> String {
    fs::read_to_string(wesl(file)).expect("a module that can be read")
}

/// The names of a module's functions, structs and constants.
fn names(module: &str) -> Vec<&str> {
    let declared = module.lines().filter_map(|line| {
        ["fn ", "struct ", "const "]
            .iter()
            .find_map(|word| line.strip_prefix(word))
    });
    let is_part = |c: char| c.is_alphanumeric() || c == '_';
    declared
        .filter_map(|rest| rest.split(|c| !is_part(c)).next())
        .collect()
}

#[test]
fn generated_files_are_current() {
    let again = "cargo run -p light-gpu --example generate";
    assert_eq!(LIGHTS_WGSL, flat(), "{again}");
    assert_eq!(read("constants.wesl"), constants(), "{again}");
}

#[test]
fn the_flat_text_is_valid() {
    let text = [LIGHTS_WGSL, ROW].concat();
    let module = naga::front::wgsl::parse_str(&text)
        .unwrap_or_else(|error| panic!("{}", error.emit_to_string(&text)));
    let mut validator = Validator::new(ValidationFlags::all(), Capabilities::empty());
    validator.validate(&module).expect("a valid module");
    assert!(module.global_variables.is_empty(), "no bindings");
}

#[test]
fn names_do_not_collide_with_those_of_a_user() {
    for name in names(LIGHTS_WGSL) {
        let is_ours = ["light_", "Light", "LIGHT_"]
            .iter()
            .any(|prefix| name.starts_with(prefix));
        assert!(is_ours || name == "SampledLight", "{name}");
    }
}

/// Each module imports what it uses of others, and only what they declare.
#[test]
fn modules_import_what_they_use() {
    let folder = fs::read_dir(wesl("")).expect("a folder");
    let files = folder.map(|entry| entry.expect("an entry").file_name());
    let files: Vec<String> = files.map(|f| f.into_string().expect("UTF-8")).collect();
    let modules: Vec<(String, String)> = files
        .iter()
        .map(|file| (file.trim_end_matches(".wesl").to_owned(), read(file)))
        .collect();
    for (module, text) in &modules {
        let (mut imported, mut body) = (Vec::new(), text.as_str());
        while let Some((before, rest)) = body.split_once("import package::") {
            assert!(!before.contains("fn "), "{module}: imports come first");
            let (import, rest) = rest.split_once(';').expect("an end of the import");
            let (from, list) = import.split_once("::").expect("names");
            let from = &modules.iter().find(|m| m.0 == from).expect("a module").1;
            for name in list.trim_matches(['{', '}', '\n']).split(',') {
                let name = name.trim();
                assert!(
                    name.is_empty() || names(from).contains(&name),
                    "{module}: {name}"
                );
                imported.push(name);
            }
            body = rest;
        }
        for (other, text) in modules.iter().filter(|other| &other.0 != module) {
            for name in names(text) {
                let uses = words(body).any(|word| word == name);
                assert_eq!(
                    uses,
                    imported.contains(&name),
                    "{module}: {name} of {other}"
                );
            }
        }
    }
}

/// The words of the code, without comments.
fn words(text: &str) -> impl Iterator<Item = &str> {
    let code = text
        .lines()
        .map(|line| line.split("//").next().unwrap_or(""));
    code.flat_map(|line| line.split(|c: char| !(c.is_alphanumeric() || c == '_')))
}
