//! Files of a crate that import one another, directly or in a circle.
//!
//! A file imports another file if it names an item that is defined there, in a `use` or in a path
//! in its code. A name is followed through re-exports, so a `mod.rs` that only declares and
//! re-exports is part of no circle. Each circle is listed once, as the largest set of files from
//! each of which all others are reached.

mod names;
mod tree;

use std::collections::BTreeSet;
use std::path::Path;

use self::names::{Imports, imports};
use self::tree::Crate;
use super::files::{is_test, shown};
use crate::workspace::Package;

/// All circles outside tests, each with the imports that make it.
///
/// **Errors**: a sentence that names a file that can't be read or parsed as Rust.
pub(crate) fn find(packages: &[Package]) -> Result<Vec<String>, String> {
    let mut found = Vec::new();
    let roots = packages.iter().flat_map(|package| &package.roots);
    for root in roots.filter(|root| !is_test(shown(root))) {
        found.extend(of_crate(root)?);
    }
    Ok(found)
}

/// The circles of the crate whose root file is `root`.
fn of_crate(root: &Path) -> Result<Vec<String>, String> {
    let read = Crate::read(root)?;
    let imports = imports(&read);
    Ok(circles(read.files.len(), &imports).iter().map(|circle| told(&read, &imports, circle)).collect())
}

fn told(read: &Crate, imports: &Imports, circle: &BTreeSet<usize>) -> String {
    let name = |file: usize| shown(&read.files[file]).display();
    let mut told = format!("{} files:", circle.len());
    for (&(from, to), names) in imports {
        if circle.contains(&from) && circle.contains(&to) {
            let names = names.iter().map(String::as_str).collect::<Vec<_>>().join(", ");
            told += &format!("\n    {} takes {names} of {}", name(from), name(to));
        }
    }
    told
}

/// The strongly connected components of `files` files that have more than one file.
fn circles(files: usize, imports: &Imports) -> BTreeSet<BTreeSet<usize>> {
    let reached: Vec<_> = (0..files).map(|file| reached(file, imports)).collect();
    let reached = &reached;
    let circle =
        |file: usize| reached[file].iter().copied().filter(move |&other| reached[other].contains(&file));
    (0..files).map(|file| circle(file).collect::<BTreeSet<_>>()).filter(|circle| circle.len() > 1).collect()
}

/// All files that a file imports, directly or through others.
fn reached(file: usize, imports: &Imports) -> BTreeSet<usize> {
    let (mut seen, mut left) = (BTreeSet::new(), vec![file]);
    while let Some(from) = left.pop() {
        for &(_, to) in imports.range((from, 0)..=(from, usize::MAX)).map(|(edge, _)| edge) {
            if seen.insert(to) {
                left.push(to);
            }
        }
    }
    seen
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    /// The circles of a crate of files, each with its text; the first one is the root.
    fn of(files: &[(&str, &str)]) -> Vec<String> {
        let folder = tempfile::tempdir().unwrap();
        for (name, text) in files {
            let path = folder.path().join(name);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, text).unwrap();
        }
        let found = of_crate(&folder.path().join(files[0].0)).unwrap();
        found.iter().map(|told| told.replace(&format!("{}/", folder.path().display()), "")).collect()
    }

    #[test]
    fn two_files_that_name_each_other_are_a_circle() {
        let root = ("lib.rs", "mod end;\nmod pick;\npub use end::End;\npub use pick::{Pick, lift};");
        let pick = ("pick.rs", "use crate::End;\npub struct Pick(End);\npub fn lift() {}");
        for end in [
            "use crate::Pick;\npub struct End;",
            "use super::pick::{self, Pick as Weft};\npub struct End;",
            "pub struct End;\nfn a(_: crate::Pick) {}",
            "use crate::pick;\npub struct End;\nfn a(_: pick::Pick) {}",
            "use super::*;\npub struct End;\nfn a(_: Pick) {}",
            "pub struct End;\nfn a() {\n    use super::Pick;\n}",
            "pub struct End;\nfn a() {\n    format!(\"{}\", crate::Pick);\n}",
            "pub struct End;\nmod a {\n    use super::super::Pick;\n}",
        ] {
            let found = of(&[root, pick, ("end.rs", end)]);
            let told = "2 files:\n    end.rs takes Pick of pick.rs\n    pick.rs takes End of end.rs";
            assert_eq!(found, [told], "{end}");
        }
    }

    #[test]
    fn one_way_is_no_circle() {
        let root = ("lib.rs", "mod end;\nmod pick;\npub use end::End;\npub use pick::Pick;");
        let pick = ("pick.rs", "use crate::End;\npub struct Pick(End);");
        for end in [
            "pub struct End;",
            "pub struct End;\n#[cfg(test)]\nmod tests {\n    use crate::Pick;\n}",
            "pub struct End;\n#[cfg(test)]\nuse crate::Pick;",
            "use std::fs::File as Pick;\npub struct End(Pick);",
            "/// As a [`crate::Pick`].\npub struct End;",
        ] {
            assert_eq!(of(&[root, pick, ("end.rs", end)]), Vec::<String>::new(), "{end}");
        }
    }

    /// A module is part of a circle if it names an item of an inner module, and the inner module
    /// names an item that it defines. A module that only re-exports or imports is not.
    #[test]
    fn what_only_passes_on_is_no_part() {
        let passes_on = "mod a;\nmod b;\nuse a::A;\npub use b::B;";
        let (root, a) = (("main.rs", "mod set;"), ("set/a.rs", "pub struct A;"));
        let b = ("set/b/mod.rs", "use super::A;\npub struct B(A);");
        assert_eq!(of(&[root, ("set/mod.rs", passes_on), a, b]), Vec::<String>::new());
        let defines = "mod a;\nmod b;\npub struct A;\nfn f(_: b::B) {}";
        let told = "2 files:\n    set/mod.rs takes B of set/b/mod.rs\n    set/b/mod.rs takes A of set/mod.rs";
        assert_eq!(of(&[root, ("set/mod.rs", defines), a, b]), [told]);
    }

    #[test]
    fn a_round_of_three_is_one_circle() {
        let file = |other: &str, name: &str| format!("use crate::{other}::*;\npub struct {name}({other});");
        let root = ("lib.rs", "mod A;\nmod B;\nmod C;\nmod D;");
        let found = of(&[
            root,
            ("A.rs", &file("B", "A")),
            ("B.rs", &file("C", "B")),
            ("C.rs", &file("A", "C")),
            ("D.rs", &file("A", "D")),
        ]);
        assert_eq!(found.len(), 1, "{found:?}");
        assert!(found[0].starts_with("3 files:"), "{found:?}");
    }
}
