//! `cargo xtask install --prefix DIR`: the C library where compilers look for it.
//!
//! Header, shared and static library, a file for pkg-config and a package for CMake.

use std::fs;
use std::io;
use std::path::Path;

use crate::steps::{Steps, root};

/// The number of the binary interface, `TEXERE_ABI` of the header.
const ABI: &str = "1";

/// Builds the library and lays it under the prefix that `arguments` name.
pub(crate) fn run(steps: &mut Steps, arguments: &[String]) {
    let [option, prefix] = arguments else {
        return steps.fail("usage: cargo xtask install --prefix DIR".into());
    };
    if option != "--prefix" {
        return steps.fail(format!("{option} is no option: cargo xtask install --prefix DIR"));
    }
    steps.cargo("the C library", &["build", "--release", "--locked", "--package", "texere-capi"], &[]);
    if !steps.succeed() {
        return;
    }
    match std::path::absolute(prefix).and_then(|prefix| lay(&prefix)) {
        Ok(()) => {
            println!("\npkg-config --cflags --libs texere, with PKG_CONFIG_PATH={prefix}/lib/pkgconfig")
        }
        Err(error) => steps.fail(format!("{prefix}: {error}")),
    }
}

fn lay(prefix: &Path) -> io::Result<()> {
    let [include, lib] = ["include", "lib"].map(|inner| prefix.join(inner));
    let [pkgconfig, cmake] = ["pkgconfig", "cmake/texere"].map(|inner| lib.join(inner));
    for folder in [&include, &pkgconfig, &cmake] {
        fs::create_dir_all(folder)?;
    }
    let (built, crate_folder) = (root().join("target/release"), root().join("crates/texere-capi"));
    fs::copy(crate_folder.join("include/texere.h"), include.join("texere.h"))?;
    fs::copy(built.join("libtexere_c.a"), lib.join("libtexere_c.a"))?;
    // Linkers look for the first name, and programs for the second one.
    for name in ["libtexere_c.so".into(), format!("libtexere_c.so.{ABI}")] {
        fs::copy(built.join("libtexere_c.so"), lib.join(name))?;
    }
    let version = env!("CARGO_PKG_VERSION");
    let fill = |text: &str| {
        text.replace("@PREFIX@", &prefix.to_string_lossy())
            .replace("@VERSION@", version)
            .replace("@ABI@", ABI)
    };
    fs::write(pkgconfig.join("texere.pc"), fill(include_str!("install/texere.pc")))?;
    fs::write(cmake.join("texere-config.cmake"), fill(include_str!("install/texere-config.cmake")))?;
    fs::write(
        cmake.join("texere-config-version.cmake"),
        fill(include_str!("install/texere-config-version.cmake")),
    )
}
