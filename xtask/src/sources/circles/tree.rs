//! The modules of a crate: what each defines, imports and names.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use proc_macro2::{TokenStream, TokenTree};
use syn::visit::{self, Visit};
use syn::{Attribute, Item, ItemFn, ItemUse, Macro, UseTree, Visibility};

use crate::sources::functions;

/// A crate without its tests.
#[derive(Debug, Default)]
pub(super) struct Crate {
    pub(super) files: Vec<PathBuf>,
    /// The modules. The first is the root.
    pub(super) modules: Vec<Module>,
}

/// A module, in a file of its own or in the file of another module.
#[derive(Debug, Default)]
pub(super) struct Module {
    pub(super) file: usize,
    pub(super) parent: Option<usize>,
    pub(super) children: BTreeMap<String, usize>,
    /// The names of the items that the module defines.
    pub(super) items: BTreeSet<String>,
    pub(super) uses: Vec<Use>,
    /// The paths in the module's code, single names included.
    pub(super) paths: BTreeSet<Vec<String>>,
}

/// One name of a `use`.
#[derive(Debug)]
pub(super) struct Use {
    /// The name in this module; `*` stands for all names of `path`.
    pub(super) name: String,
    pub(super) path: Vec<String>,
    /// Whether the `use` re-exports the name.
    pub(super) passes_on: bool,
}

impl Crate {
    /// Reads the crate whose root file is `root`.
    pub(super) fn read(root: &Path) -> Result<Self, String> {
        let mut read = Self::default();
        let folder = root.parent().unwrap_or(root).to_owned();
        read.file(root, folder, None)?;
        Ok(read)
    }

    /// Reads a file as a module, whose own modules lie in `folder`. Returns its number.
    fn file(&mut self, path: &Path, folder: PathBuf, parent: Option<usize>) -> Result<usize, String> {
        let named = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
        let text = fs::read_to_string(path).map_err(|error| named(&error))?;
        let parsed = syn::parse_file(&text).map_err(|error| named(&error))?;
        self.files.push(path.to_owned());
        self.module(&parsed.items, folder, Module { file: self.files.len() - 1, parent, ..Module::default() })
    }

    fn module(&mut self, items: &[Item], folder: PathBuf, module: Module) -> Result<usize, String> {
        let (number, file) = (self.modules.len(), module.file);
        self.modules.push(module);
        for item in items {
            let Some((name, attributes)) = definition(item) else {
                Paths(&mut self.modules[number]).visit_item(item);
                continue;
            };
            if functions::is_test(attributes) {
                continue;
            }
            let Item::Mod(declared) = item else {
                self.modules[number].items.extend(name);
                Paths(&mut self.modules[number]).visit_item(item);
                continue;
            };
            let name = declared.ident.to_string();
            let inner = folder.join(&name);
            let child = match &declared.content {
                Some((_, items)) => {
                    let module = Module { file, parent: Some(number), ..Module::default() };
                    self.module(items, inner, module)?
                }
                None => {
                    let beside = inner.with_extension("rs");
                    let path = if beside.exists() { beside } else { inner.join("mod.rs") };
                    self.file(&path, inner, Some(number))?
                }
            };
            self.modules[number].children.insert(name, child);
        }
        Ok(number)
    }
}

/// The name that an item defines, if any, and its attributes.
fn definition(item: &Item) -> Option<(Option<String>, &[Attribute])> {
    let (name, attributes) = match item {
        Item::Const(item) => (&item.ident, &item.attrs),
        Item::Enum(item) => (&item.ident, &item.attrs),
        Item::Fn(item) => (&item.sig.ident, &item.attrs),
        Item::Mod(item) => (&item.ident, &item.attrs),
        Item::Static(item) => (&item.ident, &item.attrs),
        Item::Struct(item) => (&item.ident, &item.attrs),
        Item::Trait(item) => (&item.ident, &item.attrs),
        Item::Type(item) => (&item.ident, &item.attrs),
        Item::Union(item) => (&item.ident, &item.attrs),
        Item::Impl(item) => return Some((None, &item.attrs)),
        Item::Use(item) => return Some((None, &item.attrs)),
        Item::Macro(item) => return Some((item.ident.as_ref().map(ToString::to_string), &item.attrs)),
        _ => return None,
    };
    Some((Some(name.to_string()), attributes))
}

/// Collects the names and paths that the items of a module use.
struct Paths<'a>(&'a mut Module);

impl Paths<'_> {
    fn take(&mut self, tree: &UseTree, before: &[String], passes_on: bool) {
        let with = |name: &dyn ToString| [before, &[name.to_string()]].concat();
        let (name, path) = match tree {
            UseTree::Path(tree) => return self.take(&tree.tree, &with(&tree.ident), passes_on),
            UseTree::Group(group) => {
                return group.items.iter().for_each(|tree| self.take(tree, before, passes_on));
            }
            UseTree::Glob(_) => ("*".into(), before.to_vec()),
            UseTree::Name(tree) if tree.ident == "self" => {
                (before.last().cloned().unwrap_or_default(), before.to_vec())
            }
            UseTree::Name(tree) => (tree.ident.to_string(), with(&tree.ident)),
            UseTree::Rename(tree) => (tree.rename.to_string(), with(&tree.ident)),
        };
        self.0.uses.push(Use { name, path, passes_on });
    }

    /// Collects paths among the tokens of a macro, which need not be Rust. A single name may be a
    /// field there, and is ignored.
    fn tokens(&mut self, tokens: TokenStream) {
        let mut path: Vec<String> = Vec::new();
        let mut colons = 0;
        for token in tokens {
            match token {
                TokenTree::Ident(name) if colons == 2 && !path.is_empty() => path.push(name.to_string()),
                TokenTree::Ident(name) => self.end(std::mem::replace(&mut path, vec![name.to_string()])),
                TokenTree::Punct(sign) if sign.as_char() == ':' => {
                    colons += 1;
                    continue;
                }
                TokenTree::Group(group) => {
                    self.end(std::mem::take(&mut path));
                    self.tokens(group.stream());
                }
                _ => self.end(std::mem::take(&mut path)),
            }
            colons = 0;
        }
        self.end(path);
    }

    fn end(&mut self, path: Vec<String>) {
        if path.len() > 1 {
            self.0.paths.insert(path);
        }
    }
}

impl<'ast> Visit<'ast> for Paths<'_> {
    fn visit_item_fn(&mut self, function: &'ast ItemFn) {
        if !functions::is_test(&function.attrs) {
            visit::visit_item_fn(self, function);
        }
    }

    fn visit_item_use(&mut self, item: &'ast ItemUse) {
        self.take(&item.tree, &[], !matches!(item.vis, Visibility::Inherited));
    }

    fn visit_path(&mut self, path: &'ast syn::Path) {
        self.0.paths.insert(path.segments.iter().map(|segment| segment.ident.to_string()).collect());
        visit::visit_path(self, path);
    }

    fn visit_macro(&mut self, called: &'ast Macro) {
        self.tokens(called.tokens.clone());
        visit::visit_macro(self, called);
    }
}
