//! Tests of the reader of knitout, with the text of each file in the test.

use std::path::Path;

use texere_contact::ContactError;
use texere_core::{BackendError, Origin, SettlingError};
use texere_fabric::weft::{CarrierSet, Direction, Instruction, Needle, WeftError};
use texere_fabric::{FabricError, FinishError, ThreadError};

use super::knitout_file::{KnitoutFile, parse};
use super::loop_lengths::LoopLengths;
use super::warnings::WARNINGS_MAX;
use crate::read::ReadError;
use Direction::{Left, Right};
use Instruction::{
    Drop, In, InHook, Knit, LoopLength, Miss, Out, OutHook, Rack, ReleaseHook, Split, Transfer, Tuck,
};

const HEAD: &str = ";!knitout-2\n;;Carriers: 1 2 3\n";

fn read(text: impl AsRef<[u8]>) -> Result<KnitoutFile, ReadError> {
    parse(Path::new("a.k"), text.as_ref(), &LoopLengths::new())
}

/// The instructions of lines behind a valid header, with the carriers of each.
fn instructions(lines: &str) -> Vec<(Instruction, Vec<u32>)> {
    let knitout = read(format!("{HEAD}{lines}")).unwrap_or_else(|error| panic!("{lines}: {error}"));
    assert!(knitout.warnings.is_empty(), "{:?}", knitout.warnings);
    let program = knitout.program;
    let carriers = |CarrierSet(set): CarrierSet| program.carrier_sets[set as usize].clone();
    program.operations.iter().map(|each| (each.instruction, carriers(each.carriers))).collect()
}

fn refusal(text: &str) -> String {
    read(text).map(|_| ()).unwrap_err().to_string()
}

fn warnings(text: impl AsRef<[u8]>) -> Vec<String> {
    read(text).unwrap().warnings
}

#[test]
fn each_operation() {
    let f = Needle::front;
    let b = Needle::back;
    let slider = |needle| Needle { slider: true, ..needle };
    for (line, instruction, carriers) in [
        ("in 1", In, vec![0]),
        ("inhook 2", InHook, vec![1]),
        ("releasehook 2", ReleaseHook, vec![1]),
        ("out 3", Out, vec![2]),
        ("outhook 1 2", OutHook, vec![0, 1]),
        ("rack 2", Rack(2.0), vec![]),
        ("rack +1", Rack(1.0), vec![]),
        ("rack -1.0", Rack(-1.0), vec![]),
        ("knit + f1 1", Knit(Right, f(1)), vec![0]),
        ("knit - b-2 2", Knit(Left, b(-2)), vec![1]),
        ("knit + f+3 3 1", Knit(Right, f(3)), vec![2, 0]),
        ("tuck - f0 1", Tuck(Left, f(0)), vec![0]),
        ("split + f1 b1 1", Split(Right, f(1), b(1)), vec![0]),
        ("drop b7", Drop(b(7)), vec![]),
        ("xfer f2 b0", Transfer(f(2), b(0)), vec![]),
        ("xfer fs2 bs0", Transfer(slider(f(2)), slider(b(0))), vec![]),
        ("miss + f9 1", Miss(Right, f(9)), vec![0]),
        ("stitch 10 -7.5", LoopLength(None), vec![]),
        ("x-stitch-number 70", LoopLength(None), vec![]),
        // Without carriers.
        ("knit + f1", Drop(f(1)), vec![]),
        ("split - f1 b1", Transfer(f(1), b(1)), vec![]),
    ] {
        assert_eq!(instructions(line), [(instruction, carriers)], "{line}");
    }
    for nothing in ["amiss f1", "tuck + f1", "miss - f1", "pause", "", "  \t ", "; knit + f1 1", ";;"] {
        assert_eq!(instructions(nothing), [], "{nothing}");
    }
}

#[test]
fn sources_are_lines_and_sets_are_shared() {
    let text = "\u{feff};!knitout-2\n\n; free\n;;Machine: SWGN2\n;;Gauge: 15\n;;Carriers: A B\n;;Yarn-B: 50-50 Rust\n\
                ;;Position: Keep\n\tinhook A;;\n knit + f1 A ; out of it\nrack 0.25;\nknit + f2 A\nknit + f3 B A";
    let KnitoutFile { program, gauge, yarns, warnings, .. } = read(text).unwrap();
    assert!(warnings.is_empty(), "{warnings:?}");
    assert_eq!((gauge, &yarns[..]), (Some(15.0), &[None, Some("50-50 Rust".into())][..]));
    assert_eq!((&program.carriers[..], program.repeat), (&["A".into(), "B".into()][..], None));
    let sources: Vec<_> = program.operations.iter().map(|operation| operation.source).collect();
    assert_eq!(sources, [9, 10, 11, 12, 13]);
    assert_eq!(program.carrier_sets, [vec![], vec![0], vec![1, 0]]);
    let sets: Vec<_> = program.operations.iter().map(|operation| operation.carriers.0).collect();
    assert_eq!(sets, [1, 1, 0, 1, 2]);
}

#[test]
fn half_a_rack_is_what_the_machine_means_by_it() {
    let rack = |machine: &str, rack: &str| {
        let KnitoutFile { program, warnings, .. } =
            read(format!("{HEAD}{machine}rack {rack}\nrack {rack}")).unwrap();
        let Rack(rack) = program.operations[0].instruction else { panic!("no rack") };
        (rack, warnings.len())
    };
    let (shima, other) = (";;Machine: SWG091N2\n", ";;Machine: Kniterate\n");
    assert_eq!(rack(shima, "0.25"), (0.5, 0));
    assert_eq!(rack(shima, "-0.75"), (-0.5, 0));
    assert_eq!(rack(shima, "2.25"), (2.5, 0));
    assert_eq!(rack(shima, "0.5"), (0.5, 1));
    assert_eq!(rack(other, "0.5"), (0.5, 0));
    assert_eq!(rack(other, "-1.5"), (-1.5, 0));
    assert_eq!(rack(other, "0.25"), (0.5, 1));
    assert_eq!((rack("", "0.25"), rack("", "0.5")), ((0.5, 0), (0.5, 0)));
    assert_eq!(rack("", "0.1"), (0.5, 1));
}

#[test]
fn what_is_no_operation_is_refused_with_its_place() {
    for (line, said) in [
        ("knitt + f1 1", "column 1: \"knitt\", expected an operation"),
        ("KNIT + f1 1", "column 1: \"KNIT\", expected an operation"),
        ("  knit * f1 1", "column 8: \"*\", expected a direction"),
        ("knit +f1 1", "column 6: \"+f1\", expected a direction"),
        ("knit + g1 1", "column 8: \"g1\", expected a needle"),
        ("knit + f 1", "column 8: \"f\", expected a needle"),
        ("knit + f1.5 1", "column 8: \"f1.5\", expected a needle"),
        ("knit + é1 1", "column 8: \"é1\", expected a needle"),
        ("knit + f99999999999 1", "column 8: \"f99999999999\", expected a needle"),
        ("knit + f65537 1", "column 8: \"f65537\", expected a needle from -65536 to 65536"),
        ("knit + f1 4", "column 11: \"4\", expected a carrier of the header: 1, 2, 3"),
        ("knit + f1 1 1", "column 13: \"1\", expected each carrier once"),
        ("knit +", "column 7: the line ends, expected a needle"),
        ("split + f1 1", "column 12: \"1\", expected a needle"),
        ("xfer f1 ;b1", "column 8: the line ends, expected a needle"),
        ("xfer f1 b1 1", "column 12: \"1\", expected the end of the operation"),
        ("drop f1 b1", "column 9: \"b1\", expected the end"),
        ("rack one", "column 6: \"one\", expected by how many needles"),
        (
            "rack nan",
            "column 6: \"nan\", expected by how many needles the back bed is moved: a number from -65536 to 65536",
        ),
        ("rack 1e99", "column 6: \"1e99\", expected by how many"),
        ("stitch 10", "column 10: the line ends, expected how far"),
        ("pause 3", "column 7: \"3\", expected the end"),
        ("in", "column 3: the line ends, expected at least one carrier"),
        ("\u{1b}[31m", "column 1: \"\\u{1b}[31m\", expected an operation"),
    ] {
        let refusal = refusal(&format!("{HEAD}knit + f1 1\n{line}\n"));
        let Some(rest) = refusal.strip_prefix("a.k, line 4, ") else { panic!("{line}: {refusal}") };
        assert!(rest.starts_with(said), "{line}: {rest}");
    }
    assert_eq!(refusal(";;Carriers: 1 2 1\n"), "a.k, line 1, column 17: \"1\", expected each carrier once");
}

/// A dash that a word processor has put in place of a hyphen is named by the error, wherever a
/// hyphen belongs.
#[test]
fn dashes_for_hyphens_are_named() {
    for (dash, name) in [
        ('\u{2010}', "a typographic hyphen (U+2010)"),
        ('\u{2011}', "a non-breaking hyphen (U+2011)"),
        ('\u{2012}', "a figure dash (U+2012)"),
        ('\u{2013}', "an en dash (U+2013)"),
        ('\u{2014}', "an em dash (U+2014)"),
        ('\u{2212}', "a minus sign (U+2212)"),
    ] {
        for line in [
            "knit - f1 1",
            "knit + f-1 1",
            "tuck - f1 1",
            "miss + b-3 1",
            "split - f1 b1 1",
            "xfer f-2 b0",
            "drop f-2",
            "rack -1",
            "rack -0.75",
            "stitch 10 -7.5",
            "x-stitch-number -3",
            "inhook - f10 1",
            "amiss f-1",
        ] {
            let line = if line.starts_with("x-") {
                line.replace(" -", &format!(" {dash}"))
            } else {
                line.replace('-', &dash.to_string())
            };
            for head in [HEAD, ";!knitout-2\n"] {
                let refusal = refusal(&format!("{head}{line}\n"));
                assert!(refusal.contains(name) && refusal.contains("not a hyphen"), "{line}: {refusal}");
            }
        }
    }
    // The name of a carrier may have a dash.
    assert_eq!(
        read(";!knitout-2\n;;Carriers: a\u{2013}b\nin a\u{2013}b\n").unwrap().program.carriers,
        ["a\u{2013}b"]
    );
}

#[test]
fn what_is_not_standard_is_warned_of_once() {
    let one = |text: String, said: &str| {
        let warnings = warnings(&text);
        assert!(warnings.len() == 1 && warnings[0].contains(said), "{text}: {warnings:?}");
    };
    one(HEAD.replace("-2", "-3"), "a.k, line 1: knitout 3; it is read as knitout 2");
    one(HEAD.replace(";!knitout-2\n", ""), "no \";!knitout-2\"");
    one(HEAD.replace('\n', "\r\n"), "line 1: a carriage return");
    one(format!("{HEAD};;Width: 530\n;;Width: 540\n"), "line 3: header \"Width\" is not known");
    one(format!("{HEAD};;X-Kickbacks: Explicit\n"), "header \"X-Kickbacks\"");
    one(format!("{HEAD};;Gauge: fine\n"), "Gauge \"fine\" is no number");
    one(format!("{HEAD};;Yarn-9: red\n"), "line 3: a yarn in carrier \"9\", which there is not");
    one(
        format!("{HEAD}in 1\nx-speed-number 10\nx-speed-number 11\n"),
        "line 4: extension \"x-speed-number\"",
    );
    one(format!("{HEAD}in 1\n;;Carriers: 5\n;;Gauge: 3\n"), "line 4: a header behind the first operation");
    one(format!("{HEAD}inhook - f10 1\n"), "direction and needle before the carriers");
    one(";!knitout-2\nin 6\nknit + f1 6 7\n".into(), "no header \";;Carriers: \"");
    // Two sizes give a warning. One size for all loops makes no difference to the cloth.
    one(format!("{HEAD}x-stitch-number 70\nx-stitch-number 71\n"), "line 3: stitch sizes");
    assert_eq!(warnings(format!("{HEAD}x-stitch-number 70\nx-stitch-number 70\n")), [""; 0]);

    let latin = warnings(b";!knitout-2\n;;Carriers: 1\nin 1 ; Andr\xe9\n");
    assert!(latin.len() == 1 && latin[0].contains("line 3: not UTF-8"), "{latin:?}");
    let many: String = (0..100).map(|number| format!("x-{number}\n")).collect();
    let many = warnings(format!("{HEAD}{many}"));
    assert!(many.len() == 21 && many[20].contains("more warnings are left out"), "{many:?}");
}

/// An error of a cloth names a carrier or a size. The error gets the line of the file that has this
/// carrier or size.
#[test]
fn errors_of_the_cloth_have_their_lines() {
    let text = ";!knitout-2\n;;Machine: SWG\n;;Carriers: 1 2 3\n;;Gauge: 7\nin 3\nknit + f1 3\nin 2\ntuck - f1 2\nsplit + f1 b1 2 3\nout 2\nrack 1\n";
    let place = |text: &str, error: FinishError| {
        let place = read(text).unwrap().keys.place(&error, |_| None);
        place.map(|place| format!("{} {}: {}", place.file.display(), place.line, place.field))
    };
    let (low, high) = (0.1, 1.0);
    let radius = |carrier| {
        FabricError::Thread(ThreadError::Radius {
            thread: Origin::Carrier(carrier),
            radius_mm: 9.0,
            low,
            high,
        })
    };
    let twist =
        FabricError::Thread(ThreadError::Twist { thread: Origin::Carrier(2), twist: 9.0, limit: 1.0 });
    let gauge = |what| FabricError::Weft(WeftError::Gauge { what, mm: 0.0, low: 0.1, high: 1.0 });
    let long = SettlingError::LongInterval { yarn: 0, axis: 'x', chords: 9, limit: 1 };
    let crowded = BackendError::Crowded { chords: 9, limit: 1 };
    for (error, line) in [
        (radius(3).into(), "5: in 3"),
        (twist.into(), "7: in 2"),
        (FinishError::Thread { thread: Origin::Carrier(3), source: long.clone() }, "5: in 3"),
        (gauge("wales").into(), "4: ;;Gauge"),
        (gauge("courses").into(), "4: ;;Gauge"),
        (gauge("loops").into(), "4: ;;Gauge"),
        (FinishError::Settling(long), "4: ;;Gauge"),
        (FabricError::Weft(WeftError::KnitPoints { points: 9, limit: 1 }).into(), "9: split + f1 b1 2"),
        (FabricError::Weft(WeftError::KnitRepeat { points: 9, limit: 1 }).into(), "9: split + f1 b1 2"),
        (
            FabricError::Contact(ContactError::ClearancePoints { points: 9, limit: 1 }).into(),
            "9: split + f1 b1 2",
        ),
        (
            FabricError::Contact(ContactError::LinkingSize { intervals: 9, limit: 1 }).into(),
            "9: split + f1 b1 2",
        ),
        (FabricError::Weft(WeftError::Stitches { what: "no loops" }).into(), "9: split + f1 b1 2"),
        (SettlingError::TooMany { what: "chords", count: 9, limit: 1 }.into(), "9: split + f1 b1 2"),
        (crowded.into(), "9: split + f1 b1 2"),
    ] {
        let said = error.to_string();
        assert_eq!(place(text, error), Some(format!("a.k {line}")), "{said}");
    }
    // If nothing is knitted, the error gets the line of the first operation with a carrier.
    let empty = place(
        ";!knitout-2\nin 1\nout 1\n",
        FabricError::Weft(WeftError::Stitches { what: "no loops" }).into(),
    );
    assert_eq!(empty.as_deref(), Some("a.k 2: in 1"));
}

#[test]
fn carriers_that_no_header_lists_are_those_that_occur() {
    let program = read(";!knitout-2\nin yarn\nknit + f1 b yarn\nknit + f2 yarn b\n").unwrap().program;
    assert_eq!(program.carriers, ["yarn", "b"]);
    assert_eq!(program.carrier_sets, [vec![], vec![0], vec![1, 0], vec![0, 1]]);
    assert!(
        refusal(&format!("in {}\n", "x".repeat(41))).contains("the name of a carrier: 40 letters at most")
    );
    assert!(refusal(";;Carriers: a\u{1b}[31m\n").contains("column 13: \"a\\u{1b}[31m\", expected the name"));
    let many: String = (0..257).map(|number| format!("in c{number}\n")).collect();
    assert!(refusal(&many).contains("line 257, column 4: \"c256\", expected one of the 256 carriers"));
}

#[test]
fn stitch_sizes_are_lengths_where_they_are_told() {
    let lengths = LoopLengths::from([("70".into(), 5.5), ("10 20".into(), 6.0)]);
    let text = format!("{HEAD}x-stitch-number 070\nstitch 10.0  +20\n");
    let knitout = parse(Path::new("a.k"), text.as_bytes(), &lengths).unwrap();
    let read: Vec<_> = knitout.program.operations.iter().map(|each| each.instruction).collect();
    assert_eq!(read, [LoopLength(Some(5.5)), LoopLength(Some(6.0))]);
    assert!(knitout.warnings.is_empty() && knitout.unused_sizes.is_empty());
    // Size 71 has no length, while size 70 has one. Size "10 20" has a length, but does not occur.
    let text = format!("{HEAD}x-stitch-number 70\nx-stitch-number 71\nx-stitch-number 71\n");
    let knitout = parse(Path::new("a.k"), text.as_bytes(), &lengths).unwrap();
    assert_eq!(knitout.unused_sizes, ["10 20"]);
    let [said] = &knitout.warnings[..] else { panic!("{:?}", knitout.warnings) };
    assert!(said.starts_with("a.k, line 4: stitch size 71 has no length"), "{said}");
    for (text, name) in
        [("070", Some("70")), (" 7.50 -0 ", Some("7.5 0")), ("1 2 3", None), ("big", None), ("", None)]
    {
        assert_eq!(super::size(text).as_deref(), name, "{text}");
    }
}

#[test]
fn hostile_bytes_are_read_or_refused() {
    for bytes in
        [&b""[..], b"\n", b";", b";!", b";;", b";;:", b";;Carriers:", b"\0", b"\xff\xfe", b"\xef\xbb\xbf"]
    {
        let _ = read(bytes);
    }
    let long = "x".repeat(1 << 22);
    assert!(refusal(&long).chars().count() < 300);
    assert!(refusal(&format!("{HEAD}knit + f1 {long}")).chars().count() < 300);
    // Sets, extensions and headers that differ from line to line.
    let names: String =
        (0..100_000).map(|number| format!(";;H{number}: {number}\n;;Yarn-{number}: {long:.40}\n")).collect();
    let sets: String = (0..200_000)
        .map(|number| format!("knit + f1 {} {}\nx-{number}\n", number % 250, (number + 1) % 250))
        .collect();
    let knitout = read(format!("{names}{sets}")).unwrap();
    // The time that reading takes is in proportion to the number of lines, because each name and
    // each set is looked up in a table.
    assert_eq!((knitout.program.carriers.len(), knitout.program.carrier_sets.len()), (250, 251));
    assert_eq!(knitout.warnings.len(), WARNINGS_MAX + 1);
}
