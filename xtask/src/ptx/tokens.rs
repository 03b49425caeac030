//! What a compiler of the kernels reads of a crate: its tokens, without comments, documentation,
//! tests, lints, and what the features of the kernels leave out.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use proc_macro2::{Delimiter, Group, TokenStream, TokenTree};
use syn::Meta;

use super::condition::{holds, text_of};

/// Attributes that make no code.
const WITHOUT_CODE: [&str; 3] = ["doc", "allow", "expect"];

/// The tokens of a crate, each behind a space.
#[derive(Debug)]
pub(super) struct Tokens<'a> {
    pub(super) text: String,
    /// The features that are on.
    features: &'a BTreeSet<String>,
    /// The modules that are files of their own, of those that were read.
    modules: Vec<Module>,
}

/// A module in a file of its own.
#[derive(Debug)]
struct Module {
    /// Where it can be: its file, and the folder of its children.
    places: Vec<(PathBuf, PathBuf)>,
}

impl<'a> Tokens<'a> {
    /// Reads the file of a crate and those of its modules.
    ///
    /// # Errors
    /// A file that cannot be read or has no tokens of Rust.
    pub(super) fn of_crate(file: &Path, features: &'a BTreeSet<String>) -> Result<Self, String> {
        let folder = file.parent().unwrap_or(file);
        let mut tokens = Self {
            text: String::new(),
            features,
            modules: Vec::new(),
        };
        tokens.modules.push(Module {
            places: vec![(file.to_owned(), folder.to_owned())],
        });
        while let Some(module) = tokens.modules.pop() {
            let mut places = module.places.iter();
            let place = places.find(|(file, _)| file.is_file());
            let (file, folder) =
                place.ok_or_else(|| format!("{}: no such module", module.places[0].0.display()))?;
            let error = |e: &dyn std::fmt::Display| format!("{}: {e}", file.display());
            let text = fs::read_to_string(file).map_err(|e| error(&e))?;
            let stream = text.parse().map_err(|e| error(&e))?;
            tokens.add(stream, file, folder);
        }
        Ok(tokens)
    }

    /// Adds what is compiled of a part of `file`, whose modules are in `folder`.
    fn add(&mut self, stream: TokenStream, file: &Path, folder: &Path) {
        let trees: Vec<TokenTree> = stream.into_iter().collect();
        let mut rest = &trees[..];
        let mut written_path = None;
        while let [tree, after @ ..] = rest {
            if let Some((attribute, after)) = attribute(rest) {
                let is_cfg = attribute.path().is_ident("cfg");
                if is_cfg && holds(&attribute, self.features) == Some(false) {
                    rest = after_item(after);
                    continue;
                }
                if attribute.path().is_ident("path") {
                    written_path = text_of(&attribute);
                }
                if WITHOUT_CODE.iter().any(|n| attribute.path().is_ident(n)) {
                    rest = after;
                    continue;
                }
            }
            match rest {
                [
                    TokenTree::Ident(word),
                    TokenTree::Ident(name),
                    TokenTree::Punct(end),
                    ..,
                ] if word == "mod" && end.as_char() == ';' => {
                    let module = Module::new(&name.to_string(), written_path.take(), file, folder);
                    self.modules.push(module);
                }
                [
                    TokenTree::Ident(word),
                    TokenTree::Ident(name),
                    TokenTree::Group(items),
                    ..,
                ] if word == "mod" => {
                    self.text += &format!(" mod {name}");
                    self.add_group(items, file, &folder.join(name.to_string()));
                    rest = &rest[3..];
                    continue;
                }
                _ => {}
            }
            match tree {
                TokenTree::Group(group) => self.add_group(group, file, folder),
                _ => self.text += &format!(" {tree}"),
            }
            rest = after;
        }
    }

    fn add_group(&mut self, group: &Group, file: &Path, folder: &Path) {
        let (open, close) = match group.delimiter() {
            Delimiter::Parenthesis => (" (", " )"),
            Delimiter::Brace => (" {", " }"),
            Delimiter::Bracket => (" [", " ]"),
            Delimiter::None => ("", ""),
        };
        self.text += open;
        self.add(group.stream(), file, folder);
        self.text += close;
    }
}

impl Module {
    /// A module that is declared in `file`, whose modules are in `folder`.
    fn new(name: &str, written_path: Option<String>, file: &Path, folder: &Path) -> Self {
        let below = folder.join(name);
        let places = match written_path {
            Some(path) => {
                let file = file.with_file_name(path);
                let folder = file.parent().unwrap_or(folder).to_owned();
                vec![(file, folder)]
            }
            None => vec![
                (folder.join(format!("{name}.rs")), below.clone()),
                (below.join("mod.rs"), below),
            ],
        };
        Self { places }
    }
}

/// The attribute that `trees` begin with, and what is behind it.
fn attribute(trees: &[TokenTree]) -> Option<(Meta, &[TokenTree])> {
    let [TokenTree::Punct(mark), rest @ ..] = trees else {
        return None;
    };
    let (group, after) = match rest {
        [TokenTree::Group(group), after @ ..] => (group, after),
        [TokenTree::Punct(inner), TokenTree::Group(group), after @ ..]
            if inner.as_char() == '!' =>
        {
            (group, after)
        }
        _ => return None,
    };
    if mark.as_char() != '#' || group.delimiter() != Delimiter::Bracket {
        return None;
    }
    // In a macro it may be no attribute yet.
    Some((syn::parse2(group.stream()).ok()?, after))
}

/// What is behind an item, a statement, a field or a variant. Too little is left out rather than
/// too much: the body of a function whose `where` has a comma stays.
fn after_item(trees: &[TokenTree]) -> &[TokenTree] {
    let mut open_angles = 0;
    let mut before = ' ';
    for (i, tree) in trees.iter().enumerate() {
        let mut mark = ' ';
        match tree {
            TokenTree::Group(group) if group.delimiter() == Delimiter::Brace => {
                return &trees[i + 1..];
            }
            TokenTree::Punct(punct) => mark = punct.as_char(),
            _ => {}
        }
        match mark {
            ';' => return &trees[i + 1..],
            ',' if open_angles == 0 => return &trees[i + 1..],
            '<' => open_angles += 1,
            // Not that of an arrow.
            '>' if before != '-' && before != '=' => open_angles -= 1,
            _ => {}
        }
        before = mark;
    }
    &[]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn compiled(text: &str) -> String {
        let features = BTreeSet::from(["libm".to_owned()]);
        let mut tokens = Tokens {
            text: String::new(),
            features: &features,
            modules: Vec::new(),
        };
        let file = Path::new("src/lib.rs");
        tokens.add(text.parse().expect("tokens"), file, Path::new("src"));
        tokens.text
    }

    #[test]
    fn comments_and_tests_are_left_out() {
        let code = "#[inline]\nfn f(x: f32) -> f32 { x }";
        let dressed = "//! A crate.\n\n/// Doc.\n#[allow(dead_code, reason = \"\")]\n#[inline]\n\
                       fn f(x: f32) -> f32 {\n    // Why.\n    /* What. */ x\n}\n\
                       #[cfg(test)]\nmod tests { fn g() {} }\n#[cfg(test)] mod more;";
        assert_eq!(compiled(dressed), compiled(code), "the same code");
        for other in [
            "fn f(x: f32) -> f32 { x }",
            "#[inline]\nfn f(x: f32) -> f32 { -x }",
        ] {
            assert_ne!(compiled(other), compiled(code), "{other}");
        }
        assert_ne!(compiled("f(\"// a\")"), compiled("f(\"// b\")"), "strings");
    }

    #[test]
    fn what_the_features_leave_out_is_left_out() {
        for off in [
            "#[cfg(feature = \"std\")] #[inline] pub fn f<A, B>(a: A) -> Vec<B> { a }",
            "#[cfg(all(test, feature = \"libm\"))] mod tests;",
            "#[cfg(not(feature = \"libm\"))] use a::b;",
            "#[cfg(feature = \"std\")] impl<A> B for C<A> { fn d() {} }",
        ] {
            assert_eq!(
                compiled(&format!("{off} struct E;")),
                " struct E ;",
                "{off}"
            );
        }
        let on = compiled("#[cfg(feature = \"libm\")] fn f() {}");
        assert!(on.ends_with(" fn f ( ) { }"), "{on}");
        let fields = "struct A { #[cfg(test)] b: B<C, D>, e: E }";
        assert_eq!(compiled(fields), " struct A { e : E }", "fields");
    }

    #[test]
    fn modules_are_found_as_by_the_compiler() {
        let folder = crate::steps::root().join("crates/light-math/src");
        let features = BTreeSet::from(["libm".to_owned()]);
        let tokens = Tokens::of_crate(&folder.join("lib.rs"), &features).expect("a crate");
        assert!(
            tokens.text.contains(" fn decode ( self ) - > Vec3"),
            "a file of a module"
        );
        assert!(!tokens.text.contains(" # [ test ]"), "no test");
        let missing = Tokens::of_crate(&folder.join("missing.rs"), &features);
        assert!(missing.is_err_and(|e| e.contains("missing.rs")), "its name");
    }
}
