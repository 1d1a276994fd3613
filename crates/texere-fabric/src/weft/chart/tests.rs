//! Charts against their knitting programs, written out in knitout's notation, and the errors of
//! charts.

use super::{Backing, Beds, CHART_MOVED_MAX, CHART_YARNS_MAX, Cell, Chart, ChartError};
use crate::weft::{Bed, CarrierSet, Instruction, Machine, Program};

/// Operations in knitout's notation, with yarns numbered from 1.
fn text(program: &Program) -> String {
    let each = program.operations.iter().map(|operation| {
        let CarrierSet(set) = operation.carriers;
        let names: Vec<_> = program.carrier_sets[set as usize].iter().map(|carrier| carrier + 1).collect();
        let names = if names.is_empty() { String::new() } else { format!(" {names:?}") };
        format!("{}{names}", operation.instruction)
    });
    each.collect::<Vec<_>>().join("; ")
}

fn knitted(rows: &str, beds: Beds) -> String {
    text(&Chart::parse(rows, beds).unwrap().program().unwrap())
}

#[test]
fn courses_go_to_and_fro() {
    assert_eq!(knitted("tm\nkk\n", Beds::One), "knit + f0 [1]; knit + f1 [1]; miss - f1 [1]; tuck - f0 [1]");
    let chart = Chart::parse("k k\n\n  kk\nkk\nkk", Beds::One).unwrap().with_yarns(&[0, 1, 1, 0]).unwrap();
    assert_eq!(
        text(&chart.program().unwrap()),
        "knit + f0 [1]; knit + f1 [1]; knit + f0 [2]; knit + f1 [2]; knit - f1 [2]; knit - f0 [2]; knit - f1 [1]; \
         knit - f0 [1]"
    );
    let sources: Vec<_> = chart.program().unwrap().operations.iter().map(|each| each.source).collect();
    assert_eq!(sources, [0, 1, 2, 3, 5, 4, 7, 6]);
    // Two rows with three yarns in turn repeat after six courses.
    let chart = Chart::parse("k\nk", Beds::One).unwrap().with_yarns(&[0, 1, 2]).unwrap();
    let carriers: Vec<_> = chart.program().unwrap().operations.iter().map(|each| each.carriers.0).collect();
    assert_eq!(carriers, [1, 2, 3, 1, 2, 3]);
}

/// Every row of up to four of the listed parts is written as it was read. Cells of different parts
/// may be alike: the loop of `>` moves as the left half of `Rr` does.
#[test]
fn symbols_are_written_as_they_were_read() {
    let parts = ["k", "t", "<", ">", "Rr", "lL", "RRr", "Rrr", "llL", "lLL", "RRRrr"];
    let mut rows = vec![String::new()];
    for _ in 0..4 {
        rows = rows.iter().flat_map(|row| parts.iter().map(move |part| format!("{row}{part}"))).collect();
        for row in &rows {
            let chart = Chart::parse(&format!("{row}\n{}", "k".repeat(row.len())), Beds::One).unwrap();
            assert_eq!(chart.symbols(1).as_deref(), Some(row.as_str()));
        }
    }
    let two = Chart::parse("kpbtum", Beds::Two);
    assert_eq!(two.unwrap_err(), ChartError::NeverKnits { wale: 4 });
    let two = Chart::parse("kpbtum\nbbbbbb", Beds::Two).unwrap();
    assert_eq!(two.symbols(1).as_deref(), Some("kpbtum"));
    // Halves of a cable that lack a part, and moves that are no cable.
    let moved = |by, behind| Cell::Moved { by, behind };
    for cells in [
        vec![moved(1, true), Cell::Knit],
        vec![moved(-1, true), moved(1, true)],
        vec![moved(2, false), moved(-1, true)],
        vec![moved(1, false), moved(-1, true), moved(-1, true)],
        vec![moved(0, false)],
    ] {
        let chart = Chart::new(cells.len(), Beds::One, cells).unwrap();
        assert_eq!(chart.symbols(0), None);
    }
}

#[test]
fn loops_are_moved_to_the_bed_that_knits_them() {
    // The first round begins with the beds with which a round ends.
    assert_eq!(knitted("p\nk", Beds::One), "xfer b0 f0; knit + f0 [1]; xfer f0 b0; knit - b0 [1]");
    // Loops of rib do not change beds, and loops of needles that tuck or miss stay on their
    // needles.
    assert_eq!(knitted("mt\nkp", Beds::One), "knit + f0 [1]; knit + b1 [1]; tuck - b1 [1]; miss - f0 [1]");
    // Interlock: both beds hold loops, and nothing moves between them.
    assert_eq!(knitted("pk\nkp", Beds::Two), "knit + f0 [1]; knit + b1 [1]; knit - f1 [1]; knit - b0 [1]");
    assert_eq!(
        knitted("uk\nbb", Beds::Two),
        "rack 0.5; knit + f0 [1]; knit + b0 [1]; knit + f1 [1]; knit + b1 [1]; knit - f1 [1]; tuck - b0 [1]"
    );
}

#[test]
fn lace_goes_to_the_next_needle() {
    assert_eq!(
        knitted(">k<", Beds::One),
        "knit + f0 [1]; knit + f1 [1]; knit + f2 [1]; xfer f0 b0; xfer f2 b2; rack 1; xfer b0 f1; rack -1; xfer b2 f1; \
         rack 0"
    );
    // Beyond the edge lies the next repeat. A loop moves to its first needle, and the loop of the
    // purl wale comes to the front bed first.
    assert_eq!(
        knitted("p>", Beds::One),
        "xfer f0 b0; knit + b0 [1]; knit + f1 [1]; xfer b0 f0; xfer f1 b1; rack 1; xfer b1 f2; rack 0"
    );
}

#[test]
fn cables_cross_the_front_half_first() {
    let knits = "knit + f0 [1]; knit + f1 [1]; knit + f2 [1]; xfer f0 b0; xfer f1 b1; xfer f2 b2; ";
    assert_eq!(
        knitted("RRr", Beds::One),
        format!("{knits}rack 1; xfer b0 f1; xfer b1 f2; rack -2; xfer b2 f0; rack 0")
    );
    assert_eq!(
        knitted("lLL", Beds::One),
        format!("{knits}rack -1; xfer b1 f0; xfer b2 f1; rack 2; xfer b0 f2; rack 0")
    );
    // Cables need no space between them.
    assert_eq!(Chart::parse("RrRr", Beds::One), Chart::parse("Rr Rr", Beds::One));
    assert_ne!(Chart::parse("RrRr", Beds::One), Chart::parse("RRrr", Beds::One));
}

#[test]
fn faults_name_row_and_column() {
    let fault = |rows: &str, beds| Chart::parse(rows, beds).unwrap_err().to_string();
    for (rows, said) in [
        ("", "a chart of 0 wales and 0 rows"),
        ("kk\nkkk", "row 2 of the chart has 3 stitches, the first one 2"),
        ("kk\nkx", "row 2, column 2 of the chart: 'x' is no symbol"),
        ("k\u{1b}", "row 1, column 2 of the chart: '\\u{1b}' is no symbol"),
        ("kkRR", "row 1, column 3 of the chart: RR is half a cable"),
        ("RRk\nkkk", "row 1, column 1 of the chart: RR is half a cable"),
        ("rRR", "row 1, column 1 of the chart: r is half a cable"),
        ("lk", "row 1, column 1 of the chart: l is half a cable"),
        ("kk\nkb", "row 2, column 2 of the chart: this stitch needs two beds"),
        ("kt\nkm", "wale 2 of the chart: its needle gets loops but never knits"),
        (">m", "wale 2 of the chart: its needle gets loops"),
        ("mm", "no stitch of the chart knits"),
    ] {
        assert!(fault(rows, Beds::One).starts_with(said), "{rows}: {}", fault(rows, Beds::One));
    }
    assert!(fault(">k", Beds::Two).ends_with("needs one bed"));
    assert_eq!(fault("ku", Beds::Two), "wale 2 of the chart: its needle gets loops but never knits");
    assert!(matches!(Chart::from_symbols(65_537, 1, Beds::One, |_, _| 'k'), Err(ChartError::Size { .. })));
    assert!(matches!(Chart::from_symbols(5000, 5000, Beds::One, |_, _| 'k'), Err(ChartError::Cells { .. })));
    assert!(Chart::parse("km", Beds::One).is_ok());
}

#[test]
fn numbers_of_yarns_and_needles_have_limits() {
    let plain = || Chart::parse("kk\nkk", Beds::One).unwrap();
    for yarn in [CHART_YARNS_MAX, u32::MAX] {
        let refused = ChartError::Yarn { yarn, limit: CHART_YARNS_MAX };
        assert_eq!(plain().with_yarns(&[0, yarn]).unwrap_err(), refused);
        assert_eq!(Chart::jacquard(2, 2, None, |_, row| yarn * row as u32).unwrap_err(), refused);
    }
    let last = plain().with_yarns(&[CHART_YARNS_MAX - 1, 0]).unwrap().program().unwrap();
    assert!(Machine::default().knit(&last).is_ok());
    let most = CHART_MOVED_MAX as i32;
    for by in [i32::MIN, -most - 1, most + 1, i32::MAX] {
        let cells = vec![Cell::Knit, Cell::Moved { by, behind: false }];
        let refused = ChartError::Moved { row: 1, column: 2, by: by.unsigned_abs(), limit: CHART_MOVED_MAX };
        assert_eq!(Chart::new(2, Beds::One, cells.clone()).unwrap_err(), refused);
        let mut chart = Chart::parse("kk", Beds::One).unwrap();
        assert_eq!(chart.set(1, 0, cells[1]).unwrap_err(), refused);
    }
    let cells = vec![Cell::Moved { by: most, behind: true }, Cell::Moved { by: -most, behind: false }];
    Chart::new(2, Beds::One, cells).unwrap().program().unwrap();
}

#[test]
fn jacquard_has_a_course_for_each_yarn_of_a_row() {
    let picture = [[0, 1], [1, 1]];
    let yarn = |column: usize, row: usize| picture[row][column];
    let program = |backing| Chart::jacquard(2, 2, backing, yarn).unwrap().program().unwrap();
    let single = program(None);
    assert_eq!(
        text(&single),
        "knit + f0 [1]; miss + f1 [1]; miss + f0 [2]; knit + f1 [2]; knit - f1 [2]; knit - f0 [2]"
    );
    let sources: Vec<_> = single.operations.iter().map(|each| each.source).collect();
    assert_eq!(sources, [0, 1, 0, 1, 3, 2]);
    assert_eq!(
        text(&program(Some(Backing::Birdseye))),
        "rack 0.5; knit + f0 [1]; knit + b0 [1]; miss + f1 [1]; miss + f0 [2]; knit + f1 [2]; knit + b1 [2]; \
         knit - b1 [2]; knit - f1 [2]; knit - f0 [2]"
    );
    assert_eq!(
        text(&program(Some(Backing::Ladder))),
        "rack 0.5; knit + f0 [1]; knit + b0 [1]; miss + f1 [1]; miss + f0 [2]; knit + f1 [2]; knit + b1 [2]; \
         knit - b1 [2]; knit - f1 [2]; knit - b0 [2]; knit - f0 [2]"
    );
}

/// On a bird's-eye back the yarns change needles from row to row, so that no wale is of one colour.
#[test]
fn birdseye_has_flecks_of_all_yarns() {
    let chart = Chart::jacquard(4, 4, Some(Backing::Birdseye), |column, row| ((column + row) / 2 % 2) as u32);
    let program = chart.unwrap().program().unwrap();
    let mut of_needle = std::collections::BTreeMap::<i32, std::collections::BTreeSet<u32>>::new();
    for operation in &program.operations {
        if let Instruction::Knit(_, needle) = operation.instruction
            && needle.bed == Bed::Back
        {
            of_needle.entry(needle.number).or_default().insert(operation.carriers.0);
        }
    }
    assert_eq!(of_needle.len(), 4);
    assert!(of_needle.values().all(|yarns| yarns.len() == 2), "{of_needle:?}");
}
