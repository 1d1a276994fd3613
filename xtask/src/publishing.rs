//! Checks that crates.io would accept the packages that are published, and that docs.rs would show
//! them.

use std::collections::BTreeSet;

use crate::steps::Steps;
use crate::workspace::{Package, packages};

/// The files that each package must have beside its sources.
const BESIDE: [&str; 4] = ["Cargo.toml", "LICENSE-APACHE", "LICENSE-MIT", "README.md"];

/// Packs all packages that are published, in the order of their dependencies, and checks the files
/// in each. Nothing is built, because the lints have built the same sources.
pub(crate) fn check(steps: &mut Steps) {
    let packages = match packages() {
        Ok(packages) => packages,
        Err(error) => return steps.fail(error),
    };
    let published: Vec<_> = packages.iter().filter(|package| package.published).collect();
    let names: BTreeSet<_> = published.iter().map(|package| package.name.as_str()).collect();
    let chosen = names.iter().flat_map(|name| ["--package", name]);
    let pack = ["package", "--no-verify", "--allow-dirty", "--locked", "--quiet"];
    steps.cargo("packages", &pack.into_iter().chain(chosen).collect::<Vec<_>>(), &[]);
    for package in published {
        let list = ["package", "--list", "--allow-dirty", "--quiet", "--package", &package.name];
        let list = steps.output("cargo", &list, &[]).unwrap_or_default();
        if let Some(lack) = lack(package, &names, &list.lines().collect()) {
            steps.fail(format!("package {}: {lack}", package.name));
        }
    }
}

/// The first reason why a package can't be published as it is; none if it can.
fn lack(package: &Package, published: &BTreeSet<&str>, files: &BTreeSet<&str>) -> Option<String> {
    if let Some(missing) = BESIDE.iter().find(|name| !files.contains(*name)) {
        return Some(format!("has no {missing}"));
    }
    // A header is a source, too: C programs include it to link the package.
    let is_source =
        |path: &str| ["src/", "examples/", "include/"].iter().any(|folder| path.starts_with(folder));
    let cargos = ["build.rs", "Cargo.lock", "Cargo.toml.orig", ".cargo_vcs_info.json"];
    let known = |path: &&&str| is_source(path) || BESIDE.contains(*path) || cargos.contains(*path);
    if let Some(path) = files.iter().find(|path| !known(path)) {
        return Some(format!("holds {path}, which nobody who links it needs"));
    }
    if let Some(needed) = package.needs.iter().find(|needed| !published.contains(needed.as_str())) {
        return Some(format!("needs {needed}, which is not published"));
    }
    if let Some(key) = package.unsaid.first() {
        return Some(format!("its manifest has no {key}"));
    }
    (package.hides_features).then(|| "docs.rs would leave its features out: no metadata.docs.rs".into())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn package() -> Package {
        Package {
            name: "texere-a".into(),
            published: true,
            tests: Vec::new(),
            roots: Vec::new(),
            needs: vec!["texere-b".into()],
            unsaid: Vec::new(),
            hides_features: false,
        }
    }

    #[test]
    fn each_lack_is_told() {
        let whole =
            || ["src/lib.rs", "examples/a.rs", "build.rs"].into_iter().chain(BESIDE).collect::<BTreeSet<_>>();
        let told = |package: &Package, files: &BTreeSet<&str>| {
            lack(package, &BTreeSet::from(["texere-a", "texere-b"]), files).unwrap_or_default()
        };
        assert_eq!(told(&package(), &whole()), "");
        for name in BESIDE {
            let files = whole().into_iter().filter(|&file| file != name).collect();
            assert!(told(&package(), &files).contains(name));
        }
        let files = whole().into_iter().chain(["tests/a.rs"]).collect();
        assert!(told(&package(), &files).contains("tests/a.rs"));
        let lone = Package { needs: vec!["texere-bench".into()], ..package() };
        assert!(told(&lone, &whole()).contains("texere-bench"));
        let unsaid = Package { unsaid: vec!["keywords"], ..package() };
        assert!(told(&unsaid, &whole()).contains("keywords"));
        let hidden = Package { hides_features: true, ..package() };
        assert!(told(&hidden, &whole()).contains("docs.rs"));
    }
}
