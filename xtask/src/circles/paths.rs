//! The paths that a source names.

use syn::visit::{self, Visit};
use syn::{Item, ItemMod, ItemUse, Path, UseTree, VisRestricted, Visibility};

/// The names of a path: of a module from the root of its target, or as a source has them.
pub(super) type Names = Vec<String>;

/// A path that a module names.
#[derive(Debug)]
pub(super) struct Import {
    pub(super) path: Names,
    /// The name that a `use` item gives it; `None` for a path elsewhere.
    pub(super) alias: Option<String>,
    /// Whether a `use` item passes it on, which is no need of the file itself.
    pub(super) is_passed_on: bool,
}

/// The name of everything that a module has.
pub(super) const ALL: &str = "*";

/// Adds the paths of an item, but not of the modules in it.
pub(super) fn collect(item: &Item, imports: &mut Vec<Import>) {
    Paths(imports).visit_item(item);
}

struct Paths<'a>(&'a mut Vec<Import>);

impl<'ast> Visit<'ast> for Paths<'_> {
    fn visit_item_mod(&mut self, _: &'ast ItemMod) {}

    /// `pub(super)` names no item.
    fn visit_vis_restricted(&mut self, _: &'ast VisRestricted) {}

    fn visit_item_use(&mut self, item: &'ast ItemUse) {
        self.add_tree(&item.tree, &[], !matches!(item.vis, Visibility::Inherited));
    }

    fn visit_path(&mut self, path: &'ast Path) {
        let names = path
            .segments
            .iter()
            .map(|segment| segment.ident.to_string());
        self.0.push(Import {
            path: names.collect(),
            alias: None,
            is_passed_on: false,
        });
        visit::visit_path(self, path);
    }
}

impl Paths<'_> {
    fn add_tree(&mut self, tree: &UseTree, before: &[String], is_passed_on: bool) {
        let with = |name: String| [before, &[name]].concat();
        let (path, alias) = match tree {
            UseTree::Path(path) => {
                return self.add_tree(&path.tree, &with(path.ident.to_string()), is_passed_on);
            }
            UseTree::Group(group) => {
                let trees = group.items.iter();
                return trees.for_each(|tree| self.add_tree(tree, before, is_passed_on));
            }
            UseTree::Name(name) if name.ident == "self" => {
                (before.to_vec(), before.last().cloned().unwrap_or_default())
            }
            UseTree::Name(name) => (with(name.ident.to_string()), name.ident.to_string()),
            UseTree::Rename(name) => (with(name.ident.to_string()), name.rename.to_string()),
            UseTree::Glob(_) => (with(ALL.to_owned()), ALL.to_owned()),
        };
        self.0.push(Import {
            path,
            alias: Some(alias),
            is_passed_on,
        });
    }
}
