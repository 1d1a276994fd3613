//! `cargo xtask install --prefix DIR`: the C library where compilers look for it.
//!
//! The task installs headers for C and C++, the shared and the static library, a file for
//! pkg-config, a package for CMake, the files of a NuGet package, and examples. No file contains
//! the prefix, so the whole folder may be moved.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use crate::build::Build;
use crate::steps::{Steps, command, root};

/// Builds the library and lays it under the prefix that `arguments` name.
pub(crate) fn run(steps: &mut Steps, arguments: &[String]) {
    let [option, prefix] = arguments else {
        return steps.fail("usage: cargo xtask install --prefix DIR".into());
    };
    if option != "--prefix" {
        return steps.fail(format!("{option} is no option: cargo xtask install --prefix DIR"));
    }
    if !cfg!(target_os = "linux") {
        return steps.fail("cargo xtask install knows the libraries of Linux alone".into());
    }
    install(steps, Path::new(prefix), Build::Released);
    if steps.succeed() {
        println!("\npkg-config --cflags --libs texere, with PKG_CONFIG_PATH={prefix}/lib/pkgconfig");
    }
}

/// Builds the library and lays it under `prefix`.
pub(crate) fn install(steps: &mut Steps, prefix: &Path, build: Build) {
    build.libraries(steps);
    let assembly = assembly(steps);
    if !steps.succeed() {
        return;
    }
    let laid =
        std::path::absolute(prefix).and_then(|prefix| lay(&prefix, &root().join(build.folder()), assembly));
    if let Err(error) = laid {
        steps.fail(format!("{}: {error}", prefix.display()));
    }
}

/// The assembly for C# and its docs, from the repository's root.
const ASSEMBLY: [&str; 2] = ["target/csharp/Texere.dll", "target/csharp/Texere.xml"];

/// Builds the assembly for C#. Returns its files, or none if there is no Mono to compile it.
fn assembly(steps: &mut Steps) -> &'static [&'static str] {
    if !steps.succeeds("mcs", &["--version"]) {
        println!("\nTexere.dll: left out, there is no mcs to build it");
        return &[];
    }
    if let Err(error) = fs::create_dir_all(root().join("target/csharp")) {
        steps.fail(format!("target/csharp: {error}"));
    }
    let [out, docs] = [format!("-out:{}", ASSEMBLY[0]), format!("-doc:{}", ASSEMBLY[1])];
    let library = ["-target:library", "-unsafe", "-optimize", "-langversion:latest", "-warnaserror"];
    let build = [&["mcs"][..], &library, &[&out, &docs, "-recurse:crates/texere-capi/csharp/*.cs"]].concat();
    steps.run("the C# library", &build, &[]);
    &ASSEMBLY
}

/// The example programs and their designs: the folder, from the repository's root, and the file in
/// that folder.
const EXAMPLES: [(&str, &str); 9] = [
    ("crates/texere-capi/examples", "mesh.c"),
    ("crates/texere-capi/examples", "yarns.c"),
    ("crates/texere-capi/examples", "edit.c"),
    ("crates/texere-capi/examples", "obj/CMakeLists.txt"),
    ("crates/texere-capi/examples", "obj/obj.cpp"),
    ("crates/texere-capi/examples", "weave.cs"),
    ("crates/texere-capi/examples", "picture.cs"),
    ("designs", "poplin.toml"),
    ("designs", "herringbone.wif"),
];

/// The number of the binary interface, as the header states it.
fn abi(header: &str) -> io::Result<&str> {
    let number = header.lines().find_map(|line| line.strip_prefix("#define TEXERE_ABI "));
    number.ok_or_else(|| io::Error::other("the header has no TEXERE_ABI"))
}

/// Copies the libraries from the folder `built` to `prefix`, with all files that belong to them.
fn lay(prefix: &Path, built: &Path, assembly: &[&str]) -> io::Result<()> {
    let (include, lib) = (prefix.join("include"), prefix.join("lib"));
    let headers = root().join("crates/texere-capi/include");
    let header = fs::read_to_string(headers.join("texere.h"))?;
    let abi = abi(&header)?;
    let fill = |text: &str| {
        text.replace("@VERSION@", env!("CARGO_PKG_VERSION"))
            .replace("@ABI@", abi)
            .replace("@REPOSITORY@", env!("CARGO_PKG_REPOSITORY"))
    };
    for (path, text) in [
        ("lib/pkgconfig/texere.pc", include_str!("install/texere.pc")),
        ("lib/cmake/texere/texere-config.cmake", include_str!("install/texere-config.cmake")),
        ("lib/cmake/texere/texere-config-version.cmake", include_str!("install/texere-config-version.cmake")),
        ("share/texere/nuget/Texere.nuspec", include_str!("install/texere.nuspec")),
    ] {
        put(&prefix.join(path), |beside| fs::write(beside, fill(text)))?;
    }
    let copied = |from: PathBuf, to: PathBuf| put(&to, |beside| fs::copy(&from, beside).map(drop));
    for name in ["texere.h", "texere.hpp"] {
        copied(headers.join(name), include.join(name))?;
    }
    for example in EXAMPLES {
        copied(root().join(example.0).join(example.1), prefix.join("share/texere/examples").join(example.1))?;
    }
    copied(built.join("libtexere_c.a"), lib.join("libtexere_c.a"))?;
    // Programs load the library by this name. Linkers look for the name without a number.
    let numbered = format!("libtexere_c.so.{abi}");
    copied(built.join("libtexere_c.so"), lib.join(&numbered))?;
    put(&lib.join("libtexere_c.so"), |beside| link(&numbered, beside))?;
    let nuget = prefix.join("share/texere/nuget");
    let native = nuget.join(format!("runtimes/linux-{}/native/libtexere_c.so", processor()));
    put(&native, |beside| link(&format!("../../../../../../lib/{numbered}"), beside))?;
    for file in assembly.iter().map(Path::new) {
        let name = file.file_name().unwrap_or_default();
        copied(root().join(file), nuget.join("lib/netstandard2.1").join(name))?;
    }
    Ok(())
}

/// What NuGet calls the processor that the library is built for.
const fn processor() -> &'static str {
    if cfg!(target_arch = "aarch64") { "arm64" } else { "x64" }
}

/// Makes a symbolic link at `path`.
fn link(to: &str, path: &Path) -> io::Result<()> {
    let made = command("ln", &["-s", to]).arg(path).status()?;
    if made.success() { Ok(()) } else { Err(io::Error::other("ln makes no link")) }
}

/// Makes the file at `path`, and the folders that it lies in. `write` writes to a path beside it,
/// and the finished file is then renamed. No file at `path` is thus ever half written, and a
/// running program keeps the library that it has loaded.
fn put(path: &Path, write: impl FnOnce(&Path) -> io::Result<()>) -> io::Result<()> {
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder)?;
    }
    let mut beside = path.as_os_str().to_owned();
    beside.push(format!(".{}.tmp", std::process::id()));
    let beside = PathBuf::from(beside);
    let put = write(&beside).and_then(|()| fs::rename(&beside, path));
    if put.is_err() {
        // The caller gets the first error, not one of the removal.
        let _ = fs::remove_file(&beside);
    }
    put
}
