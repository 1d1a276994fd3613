//! Dependencies between packages: no GPU backend depends on the CPU backend, and packages that need
//! no GPU depend on no GPU backend.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::process::Command;

use serde_json::Value;

const GPU: [&str; 4] = ["texere-opencl", "texere-wgpu", "opencl3", "wgpu"];

/// The oldest Rust version with which texere's own code builds.
const OWN: [u64; 3] = [1, 89, 0];

/// The three numbers of a version.
fn version(text: &str) -> [u64; 3] {
    let mut numbers = text.split('.').map(|number| number.parse().unwrap());
    std::array::from_fn(|_| numbers.next().unwrap_or(0))
}

/// Cargo's metadata of the workspace and of all its dependencies on this system, with all features.
fn metadata() -> Value {
    let rustc = Command::new("rustc").arg("-vV").output().unwrap();
    let said = String::from_utf8(rustc.stdout).unwrap();
    let host = said.lines().find_map(|line| line.strip_prefix("host: ")).unwrap();
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let output = Command::new(cargo)
        .args(["metadata", "--format-version", "1", "--locked", "--all-features", "--filter-platform", host])
        .current_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join(".."))
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

fn list(value: &Value) -> &[Value] {
    value.as_array().unwrap()
}

fn text(value: &Value) -> &str {
    value.as_str().unwrap()
}

/// The `rust-version` of a package is the newest Rust that its own code or one of its dependencies
/// needs. The workflow checks the package with that version.
#[test]
fn each_package_names_the_oldest_rust_that_builds_it() {
    let metadata = metadata();
    let packages: BTreeMap<_, _> =
        list(&metadata["packages"]).iter().map(|package| (text(&package["id"]), package)).collect();
    let nodes: BTreeMap<_, _> =
        list(&metadata["resolve"]["nodes"]).iter().map(|node| (text(&node["id"]), node)).collect();
    let members: BTreeSet<_> = list(&metadata["workspace_members"]).iter().map(text).collect();
    let mut newer = BTreeSet::new();
    for &member in &members {
        let (mut seen, mut left) = (BTreeSet::new(), vec![member]);
        let mut oldest = (OWN, "its own code");
        while let Some(id) = left.pop() {
            if !seen.insert(id) {
                continue;
            }
            if let (false, Some(asked)) = (members.contains(id), packages[id]["rust_version"].as_str()) {
                oldest = oldest.max((version(asked), text(&packages[id]["name"])));
            }
            let is_built = |kind: &Value| kind["kind"].as_str() != Some("dev");
            let built = list(&nodes[id]["deps"])
                .iter()
                .filter(|needed| list(&needed["dep_kinds"]).iter().any(is_built));
            left.extend(built.map(|needed| text(&needed["pkg"])));
        }
        let (name, claimed) = (text(&packages[member]["name"]), text(&packages[member]["rust_version"]));
        assert_eq!(version(claimed), oldest.0, "{name} says {claimed}, {} needs another", oldest.1);
        if oldest.0 > OWN {
            newer.insert((name, claimed));
        }
    }
    // A dependency of texere-view needs a newer Rust than texere's own code. If texere-view is not
    // in the list, the loop above has not followed dependencies.
    assert!(newer.contains(&("texere-view", "1.95")), "{newer:?}");
    let workflow = Path::new(env!("CARGO_MANIFEST_DIR")).join("../.github/workflows/ci.yml");
    let workflow = std::fs::read_to_string(workflow).unwrap();
    let words = |line: &str| line.split_whitespace().map(str::to_owned).collect::<Vec<_>>();
    let named = |rust: &str, option: &str| -> BTreeSet<String> {
        let lines = workflow.lines().filter(|line| line.contains(&format!("cargo +{rust} check")));
        let pairs = lines.flat_map(|line| words(line).windows(2).map(<[String]>::to_vec).collect::<Vec<_>>());
        pairs.filter(|pair| pair[0] == option).map(|pair| pair[1].clone()).collect()
    };
    let all: BTreeSet<_> = newer.iter().map(|(name, _)| (*name).to_owned()).collect();
    assert_eq!(named("1.89", "--exclude"), all);
    for (name, rust) in newer {
        assert!(named(rust, "--package").contains(name), "{name} is not checked with {rust}");
    }
}

/// The names of all packages that a build of `package` needs.
fn needs(package: &str, features: &str) -> BTreeSet<String> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let output = Command::new(cargo)
        .args(["tree", "--locked", "--offline", "--edges", "normal", "--prefix", "none", "--format", "{p}"])
        .args(["--package", package, features])
        .current_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join(".."))
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let tree = String::from_utf8(output.stdout).unwrap();
    let names = tree.lines().filter_map(|line| line.split_whitespace().next()).map(str::to_owned);
    names.filter(|name| name != package).collect()
}

fn assert_without(packages: &[&str], unwanted: &[&str]) {
    for package in packages {
        for features in ["--all-features", "--no-default-features"] {
            let needs = needs(package, features);
            // Every tree has bytemuck. A list that could not be read has not.
            assert!(needs.contains("bytemuck"), "{package} {features}: {needs:?}");
            for unwanted in unwanted.iter().filter(|unwanted| unwanted != &package) {
                assert!(!needs.contains(*unwanted), "{package} {features} needs {unwanted}");
            }
        }
    }
}

#[test]
fn no_gpu_backend_needs_a_cpu_backend_or_the_other_gpu_backend() {
    assert_without(&["texere-opencl"], &["texere-cpu", "texere-wgpu", "wgpu"]);
    assert_without(&["texere-wgpu"], &["texere-cpu", "texere-opencl", "opencl3"]);
}

/// Packages that need no GPU depend on no GPU backend, and on no crate that GPU backends share.
#[test]
fn what_needs_no_gpu_has_none() {
    let shared = ["texere-gpu", "texere-kernels", "texere-shaders"];
    let without = ["texere-core", "texere-contact", "texere-fabric", "texere-formats", "texere-cpu"];
    assert_without(&without, &[&GPU[..], &shared].concat());
}

/// The crate that both GPU backends share depends on neither of them, and both depend on it.
#[test]
fn what_gpu_backends_share_names_no_interface() {
    let fabrics = [
        "texere-cpu",
        "texere-contact",
        "texere-fabric",
        "texere-formats",
        "texere-kernels",
        "texere-shaders",
    ];
    assert_without(&["texere-gpu"], &[&GPU[..], &fabrics].concat());
    for backend in ["texere-opencl", "texere-wgpu"] {
        assert!(needs(backend, "--all-features").contains("texere-gpu"), "{backend}");
    }
}

/// The crate that measures yarns does not depend on the crate of structures. The core is the only
/// one of texere's packages on which it depends.
#[test]
fn contacts_know_no_structure() {
    let needs = needs("texere-contact", "--all-features");
    let own: Vec<_> = needs.iter().filter(|name| name.starts_with("texere")).collect();
    assert_eq!(own, ["texere-core"]);
}

#[test]
fn the_cores_sources_name_no_gpu_interface() {
    let mut folders = vec![Path::new(env!("CARGO_MANIFEST_DIR")).join("../crates/texere-core")];
    let mut read = 0;
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
                continue;
            }
            let text = std::fs::read_to_string(&path).unwrap().to_lowercase();
            for name in ["opencl", "wgpu", "vulkan", "metal", "cuda", "direct3d"] {
                assert!(!text.contains(name), "{} names {name}", path.display());
            }
            read += 1;
        }
    }
    // If the walk had failed, no file would have been read.
    assert!(read > 10, "{read} files");
}

/// The facade depends on a GPU backend exactly if that backend's feature is on.
#[test]
fn the_facade_has_the_backends_that_it_is_asked_for() {
    let all = needs("texere", "--all-features");
    assert!(GPU.iter().all(|name| all.contains(*name)), "{all:?}");
    let none = needs("texere", "--no-default-features");
    assert!(!GPU.iter().any(|name| none.contains(*name)), "{none:?}");
}
