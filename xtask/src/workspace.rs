//! The workspace's packages, from cargo's metadata.

use std::path::PathBuf;

use serde_json::Value;

use crate::steps::command;

/// The keys that the manifest of a published package must have.
const SAID: [&str; 6] = ["description", "license", "repository", "readme", "keywords", "categories"];

/// A package of the workspace.
#[derive(Debug)]
pub(crate) struct Package {
    pub(crate) name: String,
    /// Whether the package is published on crates.io.
    pub(crate) published: bool,
    /// The root files of the package's library and programs. A library for other languages alone
    /// (`cdylib`) is left out.
    pub(crate) roots: Vec<PathBuf>,
    /// The names of the package's integration tests. Those that need a feature are left out, as
    /// `cargo test --all-targets` leaves them out.
    pub(crate) tests: Vec<String>,
    /// The packages of the workspace with which this one is built.
    pub(crate) needs: Vec<String>,
    /// The keys of a published manifest that the package's manifest lacks.
    pub(crate) unsaid: Vec<&'static str>,
    /// Whether the package is a library with features that does not tell docs.rs which of them to
    /// show.
    pub(crate) hides_features: bool,
}

/// All packages of the workspace.
///
/// **Errors**: a sentence, if cargo can't read the manifests.
pub(crate) fn packages() -> Result<Vec<Package>, String> {
    let ask = ["metadata", "--format-version", "1", "--no-deps", "--locked", "--quiet"];
    let told = command("cargo", &ask).output().map_err(|error| format!("cargo metadata: {error}"))?;
    if !told.status.success() {
        return Err(format!("cargo metadata: {}", String::from_utf8_lossy(&told.stderr)));
    }
    let metadata: Value =
        serde_json::from_slice(&told.stdout).map_err(|error| format!("cargo metadata: {error}"))?;
    Ok(list(&metadata["packages"]).iter().map(package).collect())
}

fn package(value: &Value) -> Package {
    let is = |target: &Value, kind: &str| list(&target["kind"]).iter().any(|known| known == kind);
    let targets = list(&value["targets"]);
    let linked = targets.iter().filter(|target| ["lib", "cdylib", "bin"].iter().any(|kind| is(target, kind)));
    let tests = targets.iter().filter(|target| is(target, "test") && target["required-features"].is_null());
    let needed = list(&value["dependencies"]).iter();
    let needed = needed.filter(|needed| needed["path"].is_string() && needed["kind"] != "dev");
    let has_features = value["features"].as_object().is_some_and(|features| !features.is_empty());
    let lacks = |key: &&str| value[*key].is_null() || value[*key].as_array().is_some_and(Vec::is_empty);
    Package {
        name: text(&value["name"]),
        // `null` allows any registry, an empty list none.
        published: value["publish"].is_null(),
        roots: linked.map(|target| text(&target["src_path"]).into()).collect(),
        tests: tests.map(|target| text(&target["name"])).collect(),
        needs: needed.map(|needed| text(&needed["name"])).collect(),
        unsaid: SAID.into_iter().filter(lacks).collect(),
        hides_features: has_features
            && targets.iter().any(|target| is(target, "lib"))
            && value["metadata"]["docs"]["rs"].is_null(),
    }
}

fn list(value: &Value) -> &[Value] {
    value.as_array().map_or(&[], Vec::as_slice)
}

fn text(value: &Value) -> String {
    value.as_str().unwrap_or_default().to_owned()
}
