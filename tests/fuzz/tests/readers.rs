//! Ten thousand inputs for each reader; `cargo run -p texere-fuzz --example fuzz` feeds any number.
//! A failure gives the number of its input, which makes it again.

use std::path::Path;

use peak_alloc::PeakAlloc;
use texere_fuzz::{Reader, fuzz};

#[global_allocator]
static HEAP: PeakAlloc = PeakAlloc;

fn ten_thousand(reader: Reader) {
    let taken = fuzz(reader, 0..10_000, &HEAP, Path::new(env!("CARGO_TARGET_TMPDIR")));
    // Mutations are small, so many inputs are accepted. The fewest are accepted if a design and its
    // image are both mutated.
    assert!(taken > 300, "only {taken} were taken");
}

#[test]
fn wif_drafts() {
    ten_thousand(Reader::Wif);
}

#[test]
fn fiberworks_drafts() {
    ten_thousand(Reader::Dtx);
}

#[test]
fn weavepoint_drafts() {
    ten_thousand(Reader::Wpo);
}

#[test]
fn design_files() {
    ten_thousand(Reader::Design);
}

#[test]
fn notations() {
    ten_thousand(Reader::Notation);
}

#[test]
fn images() {
    ten_thousand(Reader::Image);
}

#[test]
fn designs_with_images_and_drafts() {
    ten_thousand(Reader::Paper);
}

#[test]
fn knitout_files() {
    ten_thousand(Reader::Knitout);
}

#[test]
fn designs_of_knits() {
    ten_thousand(Reader::Knit);
}

#[test]
fn saved_yarns() {
    ten_thousand(Reader::Yarns);
}

#[test]
fn polylines() {
    ten_thousand(Reader::Polylines);
}

#[test]
fn stages() {
    ten_thousand(Reader::Stage);
}

#[test]
fn texgen_files() {
    ten_thousand(Reader::Texgen);
}

#[test]
fn curves() {
    ten_thousand(Reader::Curves);
}

#[test]
fn designs_of_warp_knits() {
    ten_thousand(Reader::WarpKnit);
}
