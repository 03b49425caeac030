//! The files that the paths of a source lead to.

use std::path::PathBuf;

use super::module::Modules;
use super::paths::{ALL, Import, Names};

/// Over how many modules and imports a path is followed.
const LONGEST_WAY: usize = 32;

impl Modules {
    /// Each pair of a file and another one that it needs.
    pub(super) fn imports(&self) -> Vec<(PathBuf, PathBuf)> {
        let mut pairs = Vec::new();
        for (at, module) in &self.modules {
            let own = module.imports.iter().filter(|import| module.needs(import));
            for import in own {
                let needed = self.file(at, &import.path, &mut Vec::new());
                pairs.extend(
                    needed
                        .filter(|needed| *needed != module.file)
                        .map(|needed| (module.file.clone(), needed)),
                );
            }
        }
        pairs
    }

    /// The file that defines what `path` means in the module `at`, if it is one of this target.
    /// `seen` are the questions that led here: globs can lead back, and `use a::a` for ever on.
    fn file(&self, at: &Names, path: &[String], seen: &mut Vec<(Names, Names)>) -> Option<PathBuf> {
        let question = (at.clone(), path.to_vec());
        if seen.contains(&question) || seen.len() == LONGEST_WAY {
            return None;
        }
        seen.push(question);
        let module = self.modules.get(at)?;
        let Some((name, rest)) = path.split_first() else {
            return Some(module.file.clone());
        };
        let below = || [&at[..], core::slice::from_ref(name)].concat();
        let above = || at.split_last().map(|(_, above)| above.to_vec());
        match name.as_str() {
            "crate" => self.file(&Names::new(), rest, seen),
            "self" => self.file(at, rest, seen),
            "super" => self.file(&above()?, rest, seen),
            ALL => Some(module.file.clone()),
            _ if module.children.contains(name) => self.file(&below(), rest, seen),
            _ if module.items.contains(name) => Some(module.file.clone()),
            _ => self.imported(at, name, rest, seen),
        }
    }

    /// The file of a name that the module `at` imports, by itself or among all of another module.
    fn imported(
        &self,
        at: &Names,
        name: &str,
        rest: &[String],
        seen: &mut Vec<(Names, Names)>,
    ) -> Option<PathBuf> {
        let imports = &self.modules.get(at)?.imports;
        let named = |import: &&Import| import.alias.as_deref() == Some(name);
        if let Some(import) = imports.iter().find(named) {
            return self.file(at, &[&import.path[..], rest].concat(), seen);
        }
        let all = |import: &&Import| import.alias.as_deref() == Some(ALL);
        imports.iter().filter(all).find_map(|import| {
            let (_, module) = import.path.split_last()?;
            self.file(at, &[module, &[name.to_owned()], rest].concat(), seen)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;
    use std::{env, fs, process};

    /// What the files of a target need, by their names.
    fn needs(name: &str, files: &[(&str, &str)]) -> Vec<String> {
        let folder = env::temp_dir().join(format!("lights-{name}-{}", process::id()));
        fs::create_dir_all(&folder).expect("a folder");
        for (file, text) in files {
            fs::write(folder.join(file), text).expect("written");
        }
        let modules = Modules::read(&folder.join("lib.rs")).expect("read");
        let short = |path: &Path| path.file_stem().expect("a name").display().to_string();
        let pairs = modules.imports().into_iter();
        let mut pairs: Vec<_> = pairs.map(|(a, b)| short(&a) + " " + &short(&b)).collect();
        pairs.sort();
        pairs.dedup();
        fs::remove_dir_all(&folder).expect("removed");
        pairs
    }

    #[test]
    fn imports_lead_to_the_file_that_defines_the_item() {
        let files = [
            ("lib.rs", "mod a; mod b; pub use b::B; use other::other;"),
            ("a.rs", "use crate::B; fn a(b: B) { other::other() }"),
            (
                "b.rs",
                "use super::a::*; pub(super) struct B; fn b() { a(B) }",
            ),
        ];
        assert_eq!(needs("through", &files), ["a b", "b a"]);
    }

    #[test]
    fn tests_and_variables_are_no_needs() {
        let files = [
            ("lib.rs", "mod a; struct S; fn f(a: u32) -> u32 { a }"),
            ("a.rs", "#[cfg(test)] mod tests { use crate::S; }"),
        ];
        assert_eq!(needs("none", &files), [""; 0]);
    }
}
