//! The C examples are compiled by the system's compiler and run. They make the same meshes as Rust.

#![allow(clippy::unwrap_used, reason = "a test ends at what it did not expect")]
#![cfg(target_os = "linux")]

use std::path::{Path, PathBuf};
use std::process::Command;

use texere::Pipeline;
use texere::mesh::Limits;

/// Compiles an example against the header and the shared library in `folder`.
fn compiled(example: &str, folder: &Path) -> PathBuf {
    let (crate_folder, program) = (Path::new(env!("CARGO_MANIFEST_DIR")), folder.join(example));
    // The program of a test lies beside the libraries that it was built with.
    let libraries = std::env::current_exe().unwrap().parent().unwrap().to_owned();
    // A program loads the library by a name with the number of the binary interface.
    let shared = folder.join(format!("libtexere_c.so.{}", texere_c::TEXERE_ABI));
    if !shared.exists() {
        std::os::unix::fs::symlink(libraries.join("libtexere_c.so"), &shared).unwrap();
    }
    let built = Command::new("cc")
        .args(["-std=c99", "-Wall", "-Wextra", "-Werror", "-pedantic", "-o"])
        .arg(&program)
        .arg(crate_folder.join(format!("examples/{example}.c")))
        .arg("-I")
        .arg(crate_folder.join("include"))
        .arg("-L")
        .arg(&libraries)
        .arg("-ltexere_c")
        .arg(format!("-Wl,-rpath,{}", folder.display()))
        .output()
        .unwrap();
    assert!(built.status.success(), "{}", String::from_utf8_lossy(&built.stderr));
    program
}

/// The output of a program, which has to succeed.
fn printed(program: &Path, arguments: &[&Path]) -> String {
    let output = Command::new(program).args(arguments).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn a_weave_a_knit_and_a_warp_knit_have_the_meshes_of_rust() {
    let folder = tempfile::tempdir().unwrap();
    let program = compiled("mesh", folder.path());
    let designs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../designs");
    for design in ["poplin.toml", "jersey.toml", "tricot.toml"] {
        let (path, output) = (designs.join(design), folder.path().join("c.ply"));
        let said = printed(&program, &[&path, Path::new("cpu"), &output]);
        let device = texere::open("cpu").unwrap();
        let cloth = texere::read(&path).unwrap().rest(&*device).run().unwrap();
        let own = folder.path().join("rust.ply");
        texere::write::stream(Pipeline::new(cloth.yarns()), &*device, &own).unwrap();
        assert!(std::fs::read(&output).unwrap() == std::fs::read(&own).unwrap(), "{design}: {said}");
        // The mesh is cut into the library's chunks, because a ring at which two chunks meet
        // counts twice.
        let cores = std::thread::available_parallelism().unwrap().get() as u64;
        let limits = Limits { binding_bytes: (cores << 24).clamp(32 << 20, 64 << 20), ..Limits::NONE };
        let mesh = Pipeline::new(cloth.yarns()).limits(limits).mesh(&*device).unwrap();
        let (vertices, triangles) = (mesh.vertices.len(), mesh.triangles().count());
        let (report, draws) = (cloth.report(), mesh.draws().count());
        assert_eq!(said, format!("{report}: {vertices} vertices, {triangles} triangles in {draws} draws\n"));
    }
}

#[test]
fn a_programs_own_yarns_are_meshed_and_saved() {
    let folder = tempfile::tempdir().unwrap();
    let program = compiled("yarns", folder.path());
    // The closed yarn has 4 intervals of 2 rings each and 9 rings, since its last ring is its first
    // again. The straight yarn has 5 rings. A gap between two rings of 12 sides has 24 triangles,
    // and each of the two caps has 10.
    assert_eq!(printed(&program, &[&folder.path().join("two.yarns")]), "14 rings, 308 triangles\n");
}

#[test]
fn a_design_that_is_refused_is_named_with_its_line() {
    let folder = tempfile::tempdir().unwrap();
    let program = compiled("mesh", folder.path());
    let design = folder.path().join("wrong.toml");
    std::fs::write(&design, "weave = { notation = \"plain\", ends = 4, picks = 4 }\nyarns.a.tex = -3\n")
        .unwrap();
    let output = Command::new(&program).arg(&design).args(["cpu", "none.ply"]).output().unwrap();
    let said = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(texere_c::texere_status::TEXERE_DESIGN as i32), "{said}");
    assert!(said.starts_with(&format!("{}:2: ", design.display())), "{said}");
    assert!(said.contains("yarns.a.tex"), "{said}");
}
