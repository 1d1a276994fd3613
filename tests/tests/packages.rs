//! Which package needs which: no GPU backend falls back on the CPU's, and what has no need of a GPU does without.

use std::collections::BTreeSet;
use std::path::Path;
use std::process::Command;

const GPU: [&str; 4] = ["texere-opencl", "texere-wgpu", "opencl3", "wgpu"];

/// Everything that a build of `package` takes in, itself left out.
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
            // Else an empty list would do.
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

#[test]
fn what_needs_no_gpu_has_none() {
    let shared = ["texere-gpu", "texere-kernels", "texere-shaders"];
    let without = ["texere-core", "texere-fabric", "texere-formats", "texere-cpu"];
    assert_without(&without, &[&GPU[..], &shared].concat());
}

/// What both GPU backends share knows neither of them, and both have it.
#[test]
fn what_gpu_backends_share_names_no_interface() {
    let fabrics = ["texere-cpu", "texere-fabric", "texere-formats", "texere-kernels", "texere-shaders"];
    assert_without(&["texere-gpu"], &[&GPU[..], &fabrics].concat());
    for backend in ["texere-opencl", "texere-wgpu"] {
        assert!(needs(backend, "--all-features").contains("texere-gpu"), "{backend}");
    }
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
    assert!(read > 10, "{read} files");
}

/// The facade takes a GPU backend in where its feature is on, and not otherwise.
#[test]
fn the_facade_has_the_backends_that_it_is_asked_for() {
    let all = needs("texere", "--all-features");
    assert!(GPU.iter().all(|name| all.contains(*name)), "{all:?}");
    let none = needs("texere", "--no-default-features");
    assert!(!GPU.iter().any(|name| none.contains(*name)), "{none:?}");
}
