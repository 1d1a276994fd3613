//! Weft knits: loops are drawn through the right loops, and settle. The checks of topology,
//! distances and linking share no code with texere's crates. The library's own check of linking has
//! to agree with them.

mod topology;

use std::ops::ControlFlow;

use texere_conformance::rest::{CROSSED, Report, check, linking, piece_points, piece_start};
use texere_core::{Material, Section, settling};
use texere_cpu::ParallelBackend;
use texere_fabric::weft::{Backing, Beds, Chart, Gauge, KnitYarn, Knitted, Machine, Step, Stitches};
use texere_fabric::{Finish, Piece, Settled, settle};

/// The diameter of all yarns, mm.
const D: f64 = 0.2;

/// Distance of courses, as a share of the distance of wales.
const COURSE: f64 = 0.75;

/// The stitches of a chart, each with a source of its own.
fn stitches(chart: &Chart) -> Stitches {
    let knit = Machine::default().knit(&chart.program().expect("a program")).expect("a knit");
    assert!(knit.faults.is_empty(), "{:?}", knit.faults);
    let mut stitches = knit.stitches;
    let mut sources = 0..;
    for step in stitches.strands.iter_mut().flat_map(|strand| &mut strand.steps) {
        let own = sources.next().expect("numbers");
        match step {
            Step::Loop { number, .. } => stitches.loops[*number as usize].source = own,
            Step::Float { source, .. } => *source = own,
        }
    }
    stitches
}

/// Charts of every kind of stitch, each a repeat of its own.
fn charts() -> Vec<(&'static str, Chart)> {
    let one = |text: &str| Chart::parse(text, Beds::One).expect("a chart");
    let two = |text: &str| Chart::parse(text, Beds::Two).expect("a chart");
    let picture = |backing| Chart::jacquard(6, 4, backing, |x, y| ((x / 2 + y) % 2) as u32).expect("a chart");
    vec![
        ("jersey", one("kkkk\nkkkk\nkkkk\nkkkk")),
        ("rib", one("kpkp\nkpkp\nkpkp\nkpkp")),
        ("garter", one("kkkk\npppp\nkkkk\npppp")),
        ("tuck", one("tktk\nkkkk\nktkt\nkkkk")),
        ("two tucks", one("kkkk\nktkk\nktkk\nkkkk")),
        ("miss", one("mkmk\nkkkk\nkmkm\nkkkk")),
        ("lace", one("kkkkkkkk\nk>kkkk<k\nkkkkkkkk\nkk>kk<kk\nkkkkkkkk\nkkk><kkk")),
        ("cable", one("ppkkkkpp\nppkkkkpp\nppkkkkpp\nppRRrrpp")),
        ("interlock", two("pkpk\nkpkp\npkpk\nkpkp\npkpk\nkpkp\npkpk\nkpkp")),
        ("milano", two("pppp\nkkkk\nbbbb\npppp\nkkkk\nbbbb")),
        ("tube", two("pppp\nkkkk\npppp\nkkkk\npppp\nkkkk\npppp\nkkkk")),
        ("jacquard", picture(None)),
        ("birdseye", picture(Some(Backing::Birdseye))),
    ]
}

fn knitted(stitches: Stitches, gauge: Gauge) -> Knitted {
    let yarns = vec![KnitYarn::new(D as f32 / 2.0); 2];
    Knitted::new(stitches, gauge, yarns, vec![Material::default()], vec![Section::Circle], [1, 1])
        .expect("a knit")
}

fn gauge(wale: f64) -> Gauge {
    Gauge::new(wale * D, COURSE * wale * D)
}

/// Settles a piece. Returns the result, its measures by the test's own check, and the largest
/// change of linking.
fn settled(name: &str, piece: &Piece, length: settling::Length) -> (Settled, Report, f64) {
    let finish = Finish { length: Some(length), ..Finish::default() };
    let device = ParallelBackend::open().expect("the CPU");
    let settled = settle(piece, &finish, &device, |_| ControlFlow::Continue(())).expect("a settling");
    let start = piece_start(name, piece, D / 2.0);
    let after = piece_points(&settled.yarns);
    let report = check(&start, &after);
    let linked = linking(&start, &start.points(), &after).change;
    println!(
        "{name}: clearance {:.3}, radius {:.3} d, {:.2} d thick, {:+.1} % long, {} passes",
        report.clearance,
        report.bend,
        report.thickness / D,
        100.0 * report.growth,
        settled.rest.passes
    );
    (settled, report, linked)
}

const FREE: settling::Length = settling::Length::Free { tension: 0.0 };

#[test]
fn loops_are_drawn_through_what_the_chart_says() {
    for wale in [4.4, 6.0, 10.0] {
        for (name, chart) in charts() {
            let knit = knitted(stitches(&chart), gauge(wale));
            let piece = knit.piece().expect("a piece");
            let faults = topology::faults(knit.stitches(), &piece, &piece.yarns);
            assert!(faults.is_empty(), "{name} {wale}: {faults:?}");
        }
    }
}

/// The check of topology reports a head that is no longer held by the loop which was drawn through
/// it.
#[test]
fn a_dropped_stitch_is_seen() {
    let chart = Chart::parse("kkkk\nkkkk\nkkkk\nkkkk", Beds::One).expect("a chart");
    let knit = knitted(stitches(&chart), gauge(5.0));
    let piece = knit.piece().expect("a piece");
    let mut yarns = piece.yarns.clone();
    let mut moved = yarns.yarn_points(1).expect("a yarn").to_vec();
    // Shoulders and head of the first loop come in front of the legs of the loop above.
    for point in &mut moved[5..=7] {
        point.z = 2.0 * D as f32;
    }
    yarns.set_points(1, &moved).expect("points");
    let faults = topology::faults(knit.stitches(), &piece, &yarns);
    assert!(faults.iter().any(|fault| fault.contains("is drawn through")), "{faults:?}");
}

#[test]
fn knits_come_to_rest() {
    let mut failed = Vec::new();
    for (name, chart) in charts() {
        for wale in [4.4, 6.0, 10.0] {
            let name = format!("{name} {wale}");
            let piece = knitted(stitches(&chart), gauge(wale)).piece().expect("a piece");
            let (settled, report, linked) = settled(&name, &piece, FREE);
            if report.clearance < 0.98 || report.bend < 0.58 || linked > CROSSED || !settled.is_linked() {
                failed.push(format!("{name}: {report:?}, linking {linked}"));
            }
        }
    }
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}

/// Plain jersey by Munden's constants, from loose to tight. Tightness is √tex over the loop length
/// in cm, and a cotton yarn is 0.0373 √tex mm thick.
#[test]
fn jersey_of_any_tightness_has_the_loop_length_asked_for() {
    let chart = Chart::parse("kkkk\nkkkk\nkkkk\nkkkk", Beds::One).expect("a chart");
    for tightness in [11.0, 13.0, 15.0, 17.0] {
        let loop_length = 10.0 * D / (0.0373 * tightness);
        let knit = knitted(stitches(&chart), Gauge::munden(loop_length));
        let piece = knit.piece().expect("a piece");
        let factor = loop_length * 16.0 / piece.length_mm();
        let given = settling::Length::Given(factor as f32);
        let (settled, report, linked) = settled(&format!("jersey of tightness {tightness}"), &piece, given);
        assert!(
            report.clearance >= 0.98 && report.bend >= 0.58 && linked < CROSSED,
            "{tightness}: {report:?}"
        );
        let after = Piece { yarns: settled.yarns, ..piece };
        let off = after.length_mm() / (16.0 * loop_length) - 1.0;
        assert!(off.abs() < 0.03, "{tightness}: loops are off by {off}");
        assert!((2.0..3.0).contains(&(report.thickness / D)), "{tightness}: {report:?}");
    }
}
