//! Three thousand inputs for each reader; `cargo run -p texere-fuzz --example fuzz` feeds as many as are wanted. A failure tells the
//! input's number, which makes it again.

use std::path::Path;

use peak_alloc::PeakAlloc;
use texere_fuzz::{Reader, fuzz};

#[global_allocator]
static HEAP: PeakAlloc = PeakAlloc;

fn three_thousand(reader: Reader) {
    let taken = fuzz(reader, 0..3_000, &HEAP, Path::new(env!("CARGO_TARGET_TMPDIR")));
    // Mutations are small, so that much of what is fed gets far; least where a design and its image are both mutated.
    assert!(taken > 90, "only {taken} were taken");
}

#[test]
fn wif_drafts() {
    three_thousand(Reader::Wif);
}

#[test]
fn design_files() {
    three_thousand(Reader::Design);
}

#[test]
fn notations() {
    three_thousand(Reader::Notation);
}

#[test]
fn images() {
    three_thousand(Reader::Image);
}

#[test]
fn designs_with_images_and_drafts() {
    three_thousand(Reader::Paper);
}

#[test]
fn knitout_files() {
    three_thousand(Reader::Knitout);
}

#[test]
fn designs_of_knits() {
    three_thousand(Reader::Knit);
}
