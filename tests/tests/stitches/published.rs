//! Loop lengths and thicknesses of knits at rest, against published figures. docs/BENCHMARKS.md has
//! the sources.

use texere_fabric::weft::{Beds, Chart, Machine};
use texere_fabric::{Piece, thickness_mm};

use super::{D, knitted, settled};

const JERSEY: &str = "kkkk\nkkkk\nkkkk\nkkkk";
const RIB: &str = "kpkp\nkpkp\nkpkp\nkpkp";
const INTERLOCK: &str = "pkpk\nkpkp\npkpk\nkpkp\npkpk\nkpkp\npkpk\nkpkp";

/// Lengths of Peirce's loop with these distances of wales and courses, in diameters. Its round
/// parts are 5.94 diameters long for yarn as dense as he assumes, and 4.56 for measured diameters.
fn peirce(wale: f64, course: f64) -> [f64; 2] {
    [4.56, 5.94].map(|round| 2.0 * course + wale + round)
}

/// Length of Munden's loop: 4.2 wales.
fn munden(wale: f64) -> f64 {
    4.2 * wale
}

/// Loop length and thickness of a chart at rest, in diameters.
fn at_rest(chart: &str, beds: Beds, wale: f64, course: f64) -> [f64; 2] {
    let program = Chart::parse(chart, beds).unwrap().program().unwrap();
    let knit = knitted(Machine::default().knit(&program).unwrap().stitches, wale, course);
    let piece = knit.piece().unwrap();
    let after = settled(&piece);
    assert!(after.is_linked() && after.rest.end.clearance > 0.98, "{chart} {wale}: {:?}", after.rest);
    let piece = Piece { yarns: after.yarns, ..piece };
    let [length, thickness] =
        [piece.length_mm() / knit.stitches().loops.len() as f64 / D, thickness_mm(&piece.yarns) / D];
    println!("{wale} {course:.2}: {length:.2} d a loop, {thickness:.2} d thick");
    [length, thickness]
}

#[test]
fn jersey_has_the_loop_length_and_thickness_of_the_books() {
    for wale in [4.2, 4.6, 5.0, 5.8] {
        let course = 4.2 / 5.5 * wale;
        let [length, thickness] = at_rest(JERSEY, Beds::One, wale, course);
        let [_, least] = peirce(wale, course);
        assert!((least..munden(wale)).contains(&length), "{wale}: {length}, {least} to {}", munden(wale));
        assert!((1.8..2.5).contains(&thickness), "{wale}: {thickness}");
    }
}

/// Rib that has drawn in, with its front wales side by side, is as thick as two layers of jersey.
#[test]
fn rib_has_the_loop_length_and_thickness_of_the_books() {
    for (wale, course) in [(2.5, 3.2), (2.5, 3.75), (3.0, 3.75)] {
        let [length, thickness] = at_rest(RIB, Beds::One, wale, course);
        let [least, most] = peirce(wale, course);
        assert!((least..most).contains(&length), "{wale}, {course}: {length}, {least} to {most}");
        assert!((3.6..5.0).contains(&thickness), "{wale}, {course}: {thickness}");
    }
}

#[test]
fn interlock_is_twice_as_thick_as_jersey() {
    let [_, jersey] = at_rest(JERSEY, Beds::One, 4.4, 3.3);
    let [_, interlock] = at_rest(INTERLOCK, Beds::Two, 4.4, 3.3);
    assert!((1.8..2.4).contains(&(interlock / jersey)), "{interlock} of {jersey}");
}
