//! Programs that were built with the header of the last release can use the library of today, as
//! long as `TEXERE_ABI` is the same.

#![allow(clippy::unwrap_used, reason = "a test ends at what it did not expect")]

use std::collections::BTreeMap;
use std::path::Path;

/// The declarations of a header: for each name the text on which programs rely.
type Declarations = BTreeMap<String, String>;

/// Reads a header as cbindgen writes it: comments begin with two slashes, all macros are constants,
/// and no declaration lies within another one.
fn declarations(header: &str) -> Declarations {
    let mut found = Declarations::new();
    let mut code = String::new();
    for line in header.lines().map(|line| line.split("//").next().unwrap().trim()) {
        match line.strip_prefix("#define ").and_then(|line| line.split_once(' ')) {
            Some((name, value)) => drop(found.insert(name.into(), value.into())),
            None if line.starts_with('#') => {}
            None => code = code + line + " ",
        }
    }
    code = code.replace("extern \"C\" {", "");
    while let Some(end) = end_of_declaration(&code) {
        declare(code[..end].trim(), &mut found);
        code.drain(..=end);
    }
    assert_eq!(code.trim(), "}", "what is left of the header");
    found
}

/// The place of the semicolon that ends the first declaration: the first semicolon outside braces.
fn end_of_declaration(code: &str) -> Option<usize> {
    let mut depth = 0;
    code.find(|letter| {
        depth += i32::from(letter == '{') - i32::from(letter == '}');
        letter == ';' && depth == 0
    })
}

fn declare(code: &str, found: &mut Declarations) {
    if let Some((head, body)) = code.split_once('{') {
        let (body, name) = body.rsplit_once('}').unwrap();
        let name = name.trim();
        if head.starts_with("typedef enum") {
            // Each value of an enum is a declaration of its own, because a later header may add
            // values.
            for value in body.split(',').map(str::trim).filter(|value| !value.is_empty()) {
                let (value, number) = value.split_once(" = ").unwrap();
                found.insert(value.into(), format!("{number} of {name}"));
            }
        } else {
            // A struct is one declaration, because its size and the places of its fields depend on
            // all fields and their order.
            found.insert(name.into(), body.split_whitespace().collect::<Vec<_>>().join(" "));
        }
    } else if let Some((head, callback)) = code.split_once("(*").filter(|_| code.starts_with("typedef")) {
        let (name, parameters) = callback.split_once(")(").unwrap();
        found.insert(name.into(), format!("{head}({})", types(parameters)));
    } else if let Some((head, parameters)) = code.split_once('(') {
        let name = head.rsplit([' ', '*']).next().unwrap();
        found.insert(name.into(), format!("{}({})", head.strip_suffix(name).unwrap(), types(parameters)));
    } else {
        let name = code.rsplit(' ').next().unwrap();
        found.insert(name.into(), code.into());
    }
}

/// The types of parameters. A program does not depend on their names.
fn types(parameters: &str) -> String {
    let parameters = parameters.strip_suffix(')').unwrap().split(',').map(str::trim);
    parameters.map(unnamed).collect::<Vec<_>>().join(", ")
}

/// A parameter without its last word, which is its name: `float (*low)[3]` becomes `float (*)[3]`.
fn unnamed(parameter: &str) -> String {
    let is_word = |letter: char| letter.is_alphanumeric() || letter == '_';
    let mut words = parameter.split(|letter| !is_word(letter));
    match words.rfind(|word| word.starts_with(char::is_alphabetic)) {
        Some(name) if name != parameter => {
            let (before, behind) = parameter.rsplit_once(name).unwrap();
            before.trim().to_owned() + behind
        }
        _ => parameter.to_owned(),
    }
}

/// Whether a struct of these members begins with its size. Members may be added at its end.
fn says_its_size(body: &str) -> bool {
    body.starts_with("uint32_t struct_size;")
}

/// The declarations of `kept` that are missing or different in `now`, one on each line. The text is
/// empty if the number of the binary interface is higher in `now`.
fn broken(kept: &str, now: &str) -> String {
    let (kept, now) = (declarations(kept), declarations(now));
    let abi = |header: &Declarations| header["TEXERE_ABI"].parse::<u32>().unwrap();
    if abi(&now) > abi(&kept) {
        return String::new();
    }
    let holds = |was: &str, is: &str| was == is || says_its_size(was) && is.starts_with(was);
    let broken = kept.iter().filter(|(name, was)| !now.get(*name).is_some_and(|is| holds(was, is)));
    broken
        .map(|(name, was)| format!("{name}: was {was}, is {}\n", now.get(name).map_or("gone", |is| is)))
        .collect()
}

fn header(path: &str) -> String {
    std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(path)).unwrap()
}

#[test]
fn what_was_released_is_still_there() {
    let broken = broken(&header("abi/released.h"), &header("include/texere.h"));
    assert!(broken.is_empty(), "programs that were built with the last release break:\n{broken}");
}

#[test]
fn names_of_parameters_are_nothing_to_a_program() {
    for (parameter, kind) in [
        ("void", "void"),
        ("uint32_t number", "uint32_t"),
        ("const struct texere_run *run", "const struct texere_run *"),
        ("struct texere_run **out", "struct texere_run **"),
        ("float (*low)[3]", "float (*)[3]"),
    ] {
        assert_eq!(unnamed(parameter), kind);
    }
}

#[test]
fn each_kind_of_change_is_seen() {
    let now = header("include/texere.h");
    assert_eq!(broken(&now, &now), "");
    for (old, new, name) in [
        ("uint32_t texere_abi(void);", "", "texere_abi"),
        ("uint32_t texere_abi(void);", "uint64_t texere_abi(void);", "texere_abi"),
        ("double *share", "float *share", "texere_run_progress"),
        ("uint32_t subdivisions;\n", "", "texere_settings"),
        ("uint32_t subdivisions;", "uint64_t subdivisions;", "texere_settings"),
        ("uint32_t subdivisions;", "uint32_t later;\nuint32_t subdivisions;", "texere_settings"),
        ("} texere_view;", "uint64_t later;\n} texere_view;", "texere_view"),
        ("TEXERE_IO = 5", "TEXERE_IO = 6", "TEXERE_IO"),
        ("#define TEXERE_REFUSED 3", "#define TEXERE_REFUSED 4", "TEXERE_REFUSED"),
        ("typedef struct texere_run texere_run;", "", "texere_run"),
        (
            "typedef int32_t (*texere_file_callback)",
            "typedef void (*texere_file_callback)",
            "texere_file_callback",
        ),
        ("TEXERE_ABI 1", "TEXERE_ABI 0", "TEXERE_ABI"),
    ] {
        assert!(now.contains(old), "{old}");
        let changed = now.replacen(old, new, 1);
        let told = broken(&now, &changed);
        assert!(told.starts_with(&format!("{name}: ")) && told.lines().count() == 1, "{old}: {told}");
        let raised = changed.replace("#define TEXERE_ABI 1", "#define TEXERE_ABI 2");
        assert_eq!(broken(&now, &raised).is_empty(), !changed.contains("ABI 0"));
    }
    let more = now.replace("TEXERE_PANIC = 8,", "TEXERE_PANIC = 8,\nTEXERE_LATER = 9,");
    let more = more.replace("double *share", "double *part") + "\n";
    let more = more.replace("} texere_settings;", "uint32_t later;\n} texere_settings;");
    assert_eq!(
        broken(&now, &more.replace("uint32_t texere_abi", "void texere_later(void);\nuint32_t texere_abi")),
        ""
    );
}

/// A struct that grows must not move what lies behind it in another struct. No member that is added
/// may lie where an earlier program's struct has padding, because that program never sets padding.
#[test]
#[cfg(target_os = "linux")]
fn structs_that_say_their_size_can_grow() {
    let now = declarations(&header("include/texere.h"));
    let sized: BTreeMap<_, _> = now.iter().filter(|(_, body)| says_its_size(body)).collect();
    assert!(sized.len() > 15, "only {} structs were found in the header", sized.len());
    let mut code = "#include <texere.h>\n".to_owned();
    for (name, body) in &sized {
        for (holder, other) in now.iter().filter(|(_, other)| other.contains(';')) {
            let held = format!("struct {name} ");
            let held = other.split(';').any(|member| member.contains(&held) && !member.contains('*'));
            assert!(!held, "{holder} holds {name}, which can't grow there");
        }
        let last = body.trim_end_matches(';').rsplit([' ', '*']).next().unwrap();
        let last = last.split('[').next().unwrap();
        let end = format!("offsetof({name}, {last}) + sizeof(({name} *)0)->{last}");
        code += &format!("_Static_assert(sizeof({name}) == {end}, \"{name} ends with padding\");\n");
    }
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("sizes.c");
    std::fs::write(&file, code).unwrap();
    let include = Path::new(env!("CARGO_MANIFEST_DIR")).join("include");
    let mut compiler = std::process::Command::new("cc");
    let checked =
        compiler.args(["-std=c11", "-fsyntax-only", "-I"]).arg(include).arg(&file).output().unwrap();
    assert!(checked.status.success(), "{}", String::from_utf8_lossy(&checked.stderr));
}
