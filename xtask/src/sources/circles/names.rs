//! Finds the file that defines a name.

use std::collections::{BTreeMap, BTreeSet};

use super::tree::{Crate, Module};

/// The names that one file imports from another, by the numbers of both files.
pub(super) type Imports = BTreeMap<(usize, usize), BTreeSet<String>>;

/// The most re-exports that a name is followed through, so that a circle of re-exports ends.
const PASSED_ON_MOST: usize = 16;

/// The meaning of a name within the crate.
#[derive(Debug, Clone, Copy)]
enum Meaning {
    Module(usize),
    /// An item that this file defines.
    DefinedIn(usize),
}

/// Names that each file of a crate imports from each other file.
pub(super) fn imports(read: &Crate) -> Imports {
    let mut found = Imports::new();
    for (number, module) in read.modules.iter().enumerate() {
        // A re-export is no import, unless a path in the code names it.
        let used =
            module.uses.iter().filter(|used| !used.passes_on && used.name != "*").map(|used| &used.path);
        for path in used.chain(&module.paths) {
            for meaning in read.meanings(number, path, PASSED_ON_MOST) {
                let Meaning::DefinedIn(file) = meaning.0 else { continue };
                if file != module.file {
                    found.entry((module.file, file)).or_default().insert(meaning.1.to_owned());
                }
            }
        }
    }
    found
}

impl Crate {
    /// The meanings of a path in a module, each with the name that led to it. There may be several:
    /// a module and a function may have the same name.
    fn meanings<'a>(&self, module: usize, path: &'a [String], left: usize) -> Vec<(Meaning, &'a str)> {
        let Some((first, mut rest)) = path.split_first() else { return Vec::new() };
        let parent = self.modules[module].parent;
        let mut found: Vec<(Meaning, &str)> = match first.as_str() {
            "crate" => vec![(Meaning::Module(0), first)],
            "self" => vec![(Meaning::Module(module), first)],
            "super" => parent.map(|parent| (Meaning::Module(parent), first.as_str())).into_iter().collect(),
            name => self.named(module, name, left).into_iter().map(|meaning| (meaning, name)).collect(),
        };
        while let Some((next, further)) = rest.split_first() {
            let inner = found.iter().flat_map(|&(meaning, by)| match (meaning, next.as_str()) {
                // The name is a variant, or a function of a type.
                (Meaning::DefinedIn(_), _) => vec![(meaning, by)],
                (Meaning::Module(module), "super") => self.modules[module]
                    .parent
                    .map(|parent| (Meaning::Module(parent), by))
                    .into_iter()
                    .collect(),
                (Meaning::Module(module), name) => {
                    self.named(module, name, left).into_iter().map(|meaning| (meaning, name)).collect()
                }
            });
            // If a module and another item have this name, and further names follow it, the module
            // is meant.
            let mut inner: Vec<_> = inner.collect();
            if !further.is_empty() && inner.iter().any(|inner| matches!(inner.0, Meaning::Module(_))) {
                inner.retain(|inner| matches!(inner.0, Meaning::Module(_)));
            }
            (found, rest) = (inner, further);
        }
        found
    }

    /// The meanings of a name in a module.
    fn named(&self, number: usize, name: &str, left: usize) -> Vec<Meaning> {
        let module: &Module = &self.modules[number];
        let mut found: Vec<_> =
            module.children.get(name).map(|&child| Meaning::Module(child)).into_iter().collect();
        if module.items.contains(name) {
            found.push(Meaning::DefinedIn(module.file));
        }
        let Some(left) = left.checked_sub(1) else { return found };
        // In `use clearance::clearance` the first name is a module, the second an item of it.
        for used in module.uses.iter().filter(|used| used.name == name) {
            found.extend(self.meanings(number, &used.path, left).into_iter().map(|meaning| meaning.0));
        }
        if !found.is_empty() {
            return found;
        }
        // A name that the module has itself hides those that a `*` brings in, so the search ends
        // above if there is such a name. The path before a `*` is looked up by this function, too.
        // If its first name did not end the search, each look-up would follow every `*` again.
        for used in module.uses.iter().filter(|used| used.name == "*") {
            for (meaning, _) in self.meanings(number, &used.path, left) {
                if let Meaning::Module(all) = meaning {
                    found.extend(self.named(all, name, left));
                }
            }
        }
        found
    }
}
