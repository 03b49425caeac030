//! The modules of one target: what each defines, and what it imports.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use syn::{Attribute, Expr, ExprLit, Item, ItemMod, Lit, Meta};

use super::paths::{self, Import, Names};

/// One module.
#[derive(Debug, Default)]
pub(super) struct Module {
    /// The file that it stands in.
    pub(super) file: PathBuf,
    /// The modules directly below it.
    pub(super) children: BTreeSet<String>,
    /// The names of the items that it defines.
    pub(super) items: BTreeSet<String>,
    /// The paths of `use` items and of expressions and types.
    pub(super) imports: Vec<Import>,
}

impl Module {
    /// Whether an import can make this module need another file: passing a name on does not, nor
    /// does a variable that has the name of a module.
    pub(super) fn needs(&self, import: &Import) -> bool {
        let is_variable = match (&import.path[..], &import.alias) {
            ([name], None) => self.children.contains(name) && !self.items.contains(name),
            _ => false,
        };
        !import.is_passed_on && !is_variable
    }
}

/// All modules of one target, by their path.
#[derive(Debug, Default)]
pub(super) struct Modules {
    pub(super) modules: BTreeMap<Names, Module>,
}

impl Modules {
    /// Reads the file of a target and those of all its modules, without what is for tests alone.
    ///
    /// # Errors
    /// A file that cannot be read or parsed.
    pub(super) fn read(target: &Path) -> Result<Self, String> {
        let mut modules = Self::default();
        let folder = target.parent().unwrap_or(target);
        modules.read_file(target, folder, Names::new())?;
        Ok(modules)
    }

    /// Reads the file of one module, whose children are files in `folder`.
    fn read_file(&mut self, file: &Path, folder: &Path, path: Names) -> Result<(), String> {
        let error = |e: &dyn std::fmt::Display| format!("{}: {e}", file.display());
        let text = fs::read_to_string(file).map_err(|e| error(&e))?;
        let source = syn::parse_file(&text).map_err(|e| error(&e))?;
        self.add(file, folder, path, &source.items)
    }

    fn add(
        &mut self,
        file: &Path,
        folder: &Path,
        path: Names,
        items: &[Item],
    ) -> Result<(), String> {
        let mut module = Module {
            file: file.to_owned(),
            ..Module::default()
        };
        for item in items.iter().filter(|item| !is_for_tests(attributes(item))) {
            module.items.extend(name(item));
            paths::collect(item, &mut module.imports);
            let Item::Mod(child) = item else { continue };
            module.children.insert(child.ident.to_string());
            let below = [&path[..], &[child.ident.to_string()]].concat();
            self.add_child(file, folder, below, child)?;
        }
        self.modules.insert(path, module);
        Ok(())
    }

    fn add_child(
        &mut self,
        file: &Path,
        folder: &Path,
        path: Names,
        child: &ItemMod,
    ) -> Result<(), String> {
        let name = child.ident.to_string();
        let below = folder.join(&name);
        if let Some((_, items)) = &child.content {
            return self.add(file, &below, path, items);
        }
        if let Some(written) = written_path(&child.attrs) {
            let file = file.with_file_name(written);
            let folder = file.parent().unwrap_or(folder).to_owned();
            return self.read_file(&file, &folder, path);
        }
        let beside = folder.join(name + ".rs");
        let inside = below.join("mod.rs");
        let child = if beside.exists() { beside } else { inside };
        self.read_file(&child, &below, path)
    }
}

/// Whether one of the attributes is `cfg(test)` or `cfg(all(test, ...))`.
fn is_for_tests(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|attribute| {
        let Meta::List(list) = &attribute.meta else {
            return false;
        };
        let condition = list.tokens.to_string().replace(' ', "");
        list.path.is_ident("cfg") && (condition == "test" || condition.starts_with("all(test"))
    })
}

/// The file that an attribute `path` names, from the folder of the file that it stands in.
fn written_path(attributes: &[Attribute]) -> Option<String> {
    attributes.iter().find_map(|attribute| {
        let pair = attribute.meta.require_name_value().ok()?;
        match &pair.value {
            Expr::Lit(ExprLit {
                lit: Lit::Str(text),
                ..
            }) if pair.path.is_ident("path") => Some(text.value()),
            _ => None,
        }
    })
}

fn attributes(item: &Item) -> &[Attribute] {
    match item {
        Item::Const(item) => &item.attrs,
        Item::Enum(item) => &item.attrs,
        Item::Fn(item) => &item.attrs,
        Item::Impl(item) => &item.attrs,
        Item::Macro(item) => &item.attrs,
        Item::Mod(item) => &item.attrs,
        Item::Static(item) => &item.attrs,
        Item::Struct(item) => &item.attrs,
        Item::Trait(item) => &item.attrs,
        Item::Type(item) => &item.attrs,
        Item::Use(item) => &item.attrs,
        _ => &[],
    }
}

/// The name of what an item defines.
fn name(item: &Item) -> Option<String> {
    let name = match item {
        Item::Const(item) => &item.ident,
        Item::Enum(item) => &item.ident,
        Item::Fn(item) => &item.sig.ident,
        Item::Macro(item) => item.ident.as_ref()?,
        Item::Static(item) => &item.ident,
        Item::Struct(item) => &item.ident,
        Item::Trait(item) => &item.ident,
        Item::Type(item) => &item.ident,
        Item::Union(item) => &item.ident,
        _ => return None,
    };
    Some(name.to_string())
}
