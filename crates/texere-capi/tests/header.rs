//! include/texere.h is what cbindgen makes of the sources, and csharp/Native.cs is what csbindgen
//! makes of them.

#![allow(clippy::unwrap_used, reason = "a test ends at what it did not expect")]

use std::path::Path;

/// Makes sure that the file at `path` has the contents `made`. If `TEXERE_HEADER` is set, the
/// contents are first written to the file.
fn is_kept(path: &str, made: &str) {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join(path);
    if std::env::var_os("TEXERE_HEADER").is_some() {
        std::fs::write(&file, made).unwrap();
    }
    let kept = std::fs::read_to_string(&file).unwrap_or_default();
    assert!(kept == made, "{path} is old: `TEXERE_HEADER=write cargo test --test header` makes it anew");
}

fn config() -> cbindgen::Config {
    cbindgen::Config::from_file(Path::new(env!("CARGO_MANIFEST_DIR")).join("cbindgen.toml")).unwrap()
}

fn header() -> String {
    let (folder, mut made) = (env!("CARGO_MANIFEST_DIR"), Vec::new());
    cbindgen::Builder::new().with_crate(folder).with_config(config()).generate().unwrap().write(&mut made);
    String::from_utf8(made).unwrap()
}

#[test]
fn the_header_is_that_of_the_sources() {
    is_kept("include/texere.h", &header());
}

#[test]
fn the_calls_for_c_sharp_are_those_of_the_sources() {
    let sources = std::fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("src")).unwrap();
    let mut sources: Vec<_> = sources.map(|entry| entry.unwrap().path()).collect();
    sources.sort();
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("Native.cs");
    sources
        .into_iter()
        .fold(csbindgen::Builder::default(), csbindgen::Builder::input_extern_file)
        .always_included_types(config().export.include)
        .csharp_dll_name("texere_c")
        .csharp_namespace("Texere")
        .csharp_class_name("Native")
        // Mono's compiler knows neither function pointers nor `nint`.
        .csharp_use_function_pointer(false)
        .csharp_use_nint_types(false)
        .csharp_generate_const_filter(|name| name.starts_with("TEXERE_"))
        .generate_csharp_file(&file)
        .unwrap();
    let made = std::fs::read_to_string(file).unwrap();
    // csbindgen leaves out what it does not understand, or marks it in a comment.
    assert!(
        !made.contains("this length is invalid"),
        "an array in a struct has elements that C# does not take"
    );
    let (header, mut calls) = (header(), 0);
    for name in header.lines().filter_map(called) {
        assert!(made.contains(&format!("EntryPoint = \"{name}\"")), "{name} is missing");
        calls += 1;
    }
    assert_eq!(made.matches("[DllImport(").count(), calls);
    for constant in header.lines().filter_map(|line| line.strip_prefix("#define TEXERE_")?.split_once(' ')) {
        let (name, value) = constant;
        assert!(made.contains(&format!(" TEXERE_{name} = {value};")), "TEXERE_{name} is missing");
    }
    is_kept("csharp/Native.cs", &made);
}

/// The name of the function that a line of the header declares.
fn called(line: &str) -> Option<&str> {
    let declared = !line.starts_with("//") && !line.starts_with(' ') && !line.starts_with("typedef");
    let head = declared.then(|| line.split_once('('))??.0;
    head.rsplit([' ', '*']).next().filter(|name| name.starts_with("texere_"))
}
