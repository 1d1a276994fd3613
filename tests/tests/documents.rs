//! What documents show is what runs.

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
