//! The workspace's packages, as cargo tells them.

use std::path::PathBuf;

use serde_json::Value;

use crate::steps::command;

/// A package of the workspace.
#[derive(Debug)]
pub(crate) struct Package {
    pub(crate) name: String,
    /// Whether it goes to crates.io.
    pub(crate) published: bool,
    /// The root files of its library and its programs.
    pub(crate) roots: Vec<PathBuf>,
}

/// All packages of the workspace.
///
/// **Errors**: a sentence, where cargo can't read the manifests.
pub(crate) fn packages() -> Result<Vec<Package>, String> {
    let ask = ["metadata", "--format-version", "1", "--no-deps", "--locked", "--quiet"];
    let told = command("cargo", &ask).output().map_err(|error| format!("cargo metadata: {error}"))?;
    if !told.status.success() {
        return Err(format!("cargo metadata: {}", String::from_utf8_lossy(&told.stderr)));
    }
    let metadata: Value =
        serde_json::from_slice(&told.stdout).map_err(|error| format!("cargo metadata: {error}"))?;
    list(&metadata["packages"]).iter().map(package).collect()
}

fn package(value: &Value) -> Result<Package, String> {
    let name = value["name"].as_str().ok_or("cargo metadata has a package without a name")?.to_owned();
    let linked = |target: &&Value| {
        let is = |kind: &str| list(&target["kind"]).iter().any(|known| known == kind);
        is("lib") || is("bin")
    };
    let roots = list(&value["targets"]).iter().filter(linked);
    let roots = roots.filter_map(|target| target["src_path"].as_str()).map(PathBuf::from).collect();
    // `null` says that it may go to any registry, an empty list to none.
    Ok(Package { name, published: value["publish"].is_null(), roots })
}

fn list(value: &Value) -> &[Value] {
    value.as_array().map_or(&[], Vec::as_slice)
}
