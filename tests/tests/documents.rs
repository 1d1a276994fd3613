//! The code in docs/BACKENDS.md is code that runs, and the files and names in docs/ARCHITECTURE.md
//! exist.

use std::path::Path;

/// The Rust code of docs/BACKENDS.md, piece after piece, is the backend that the suite is run on.
#[test]
fn the_backend_of_the_document_is_the_one_that_is_proved() {
    let document = include_str!("../../docs/BACKENDS.md");
    let mut inside = false;
    let shown = document.lines().filter(|line| {
        let was_inside = inside;
        inside = if inside { *line != "```" } else { *line == "```rust" };
        was_inside && inside
    });
    let run = include_str!("backend/host.rs").lines().chain(include_str!("backend/main.rs").lines());
    // A piece ends where the file has an empty line.
    let code = |line: &&str| !line.is_empty();
    assert_eq!(shown.filter(code).collect::<Vec<_>>(), run.filter(code).collect::<Vec<_>>());
}

/// The paths that `path` stands for, which may have alternatives in braces.
fn alternatives(path: &str) -> Vec<String> {
    let Some((before, rest)) = path.split_once('{') else { return vec![path.into()] };
    let (inside, after) = rest.split_once('}').unwrap();
    inside.split(',').flat_map(|one| alternatives(&format!("{before}{one}{after}"))).collect()
}

/// Whether `path` is a file or a folder. A star in its last part stands for any letters.
fn is_there(path: &Path) -> bool {
    let name = path.file_name().unwrap().to_str().unwrap();
    let Some((start, end)) = name.split_once('*') else { return path.exists() };
    let entries = path.parent().unwrap().read_dir().into_iter().flatten();
    let mut names = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap());
    names.any(|name| name.starts_with(start) && name.ends_with(end))
}

/// A path in the map begins at the root of the repository or in `crates`.
#[test]
fn every_path_of_the_map_is_there() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let map = include_str!("../../docs/ARCHITECTURE.md");
    // If a line is cut at its backticks, every second piece is code. Code with a space, a
    // parenthesis or a double colon is no path.
    let code = map.lines().flat_map(|line| line.split('`').skip(1).step_by(2));
    let paths: Vec<_> = code
        .filter(|code| code.contains('/') && !code.contains([' ', '(']) && !code.contains("::"))
        .flat_map(alternatives)
        .collect();
    assert!(paths.len() > 200, "{} paths are not all of the map", paths.len());
    let is_lost = |path: &&String| !is_there(&root.join(path)) && !is_there(&root.join("crates").join(path));
    let lost: Vec<_> = paths.iter().filter(is_lost).collect();
    assert!(lost.is_empty(), "not there: {lost:?}");
    assert!(!is_there(&root.join("docs/NOWHERE.md")) && !is_there(&root.join("docs/NO*.md")));
}

/// Where the map says "`name` in `path`", the file has that name.
#[test]
fn every_name_of_the_map_is_in_its_file() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../crates");
    let map = include_str!("../../docs/ARCHITECTURE.md");
    let mut seen = 0;
    for line in map.lines() {
        let pieces: Vec<_> = line.split('`').collect();
        for piece in pieces.windows(3).filter(|piece| piece[1] == " in " && piece[2].ends_with(".rs")) {
            let name = piece[0].rsplit("::").next().unwrap();
            for path in alternatives(piece[2]) {
                let text = std::fs::read_to_string(root.join(&path)).unwrap_or_default();
                let mut words = text.split(|letter: char| !letter.is_alphanumeric() && letter != '_');
                assert!(words.any(|word| word == name), "{name} is not in {path}");
                seen += 1;
            }
        }
    }
    assert!(seen > 8, "{seen} names are not all of the map");
}
