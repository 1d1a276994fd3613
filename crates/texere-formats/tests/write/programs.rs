//! Knits as knitout files: a knit that is written and read again has the same stitches, and the
//! file has the operations of the file that the knit came from, word by word.

use texere_core::Material;
use texere_fabric::Finish;
use texere_fabric::weft::{KnitYarn, Knitted, Step, Stitches};
use texere_formats::{Design, WriteError, read, read_from, write};

use crate::designs::again;
use crate::knits::from_text;

/// Stitches without the numbers of lines, and without lengths if a file does not hold them.
fn bare(stitches: &Stitches, with_lengths: bool) -> Stitches {
    let mut stitches = stitches.clone();
    for stitch in &mut stitches.loops {
        stitch.source = 0;
        stitch.length_mm = stitch.length_mm.filter(|_| with_lengths);
    }
    for step in stitches.strands.iter_mut().flat_map(|strand| &mut strand.steps) {
        if let Step::Float { source, .. } = step {
            *source = 0;
        }
    }
    stitches
}

/// The operations of a knitout file that make a difference to the cloth, in one spelling. Nothing
/// of texere's reader is used.
fn operations(text: &str) -> Vec<String> {
    let number =
        |word: &str| word.parse::<f64>().map_or(word.to_owned(), |number| (number + 0.0).to_string());
    let needle = |word: &str| word.replace('+', "");
    let mut found = Vec::new();
    for line in text.lines() {
        let words: Vec<&str> = line.split(';').next().unwrap().split_whitespace().collect();
        let joined = |from: usize| words[from..].iter().map(|word| format!(" {word}")).collect::<String>();
        let written = match words[..] {
            [] | ["amiss" | "pause", ..] | ["tuck" | "miss", _, _] => continue,
            [code, ..] if code.starts_with("x-") && code != "x-stitch-number" => continue,
            ["knit", _, at] => format!("drop {}", needle(at)),
            ["split", _, from, to] => format!("xfer {} {}", needle(from), needle(to)),
            ["rack", by] => {
                let by: f64 = by.parse().unwrap();
                let half = if by == by.floor() { 0.0 } else { 0.5 };
                format!("rack {}", by.floor() + half + 0.0)
            }
            [code @ ("stitch" | "x-stitch-number"), ref sizes @ ..] => {
                sizes.iter().fold(code.to_owned(), |line, size| format!("{line} {}", number(size)))
            }
            ["split", way, from, to, ..] => {
                format!("split {way} {} {}{}", needle(from), needle(to), joined(4))
            }
            [code @ ("knit" | "tuck" | "miss"), way, at, ..] => {
                format!("{code} {way} {}{}", needle(at), joined(3))
            }
            [code @ ("drop" | "xfer"), ref needles @ ..] => {
                needles.iter().fold(code.to_owned(), |line, at| format!("{line} {}", needle(at)))
            }
            ["inhook" | "releasehook" | "outhook" | "in" | "out", "+" | "-", _, ..] => {
                format!("{}{}", words[0], joined(3))
            }
            _ => words.join(" "),
        };
        found.push(written);
    }
    found
}

/// The value of a header.
fn header<'a>(text: &'a str, name: &str) -> Option<&'a str> {
    text.lines().find_map(|line| line.strip_prefix(&format!(";;{name}:"))).map(str::trim)
}

/// Compares everything that a knitout file holds. `source` is the text that the knit came from.
pub(crate) fn check_knitout(given: &Design, source: &str) -> Vec<String> {
    let (read, left_out, text) = again(given, "a.k", |design, path| write::knitout(design, path));
    let (own, other) = (given.structure.knitted().unwrap(), read.structure.knitted().unwrap());
    let said = |what: &str| left_out.iter().any(|line| line.starts_with(what));
    let with_lengths = !said("knit.stitch_lengths_mm");
    assert!(bare(own.stitches(), with_lengths) == bare(other.stitches(), true), "{text}");
    assert_eq!(operations(&text), operations(source), "{text}");
    for name in ["Machine", "Position"] {
        assert_eq!(header(&text, name), header(source, name), "{text}");
    }
    let [one, two] = [own, other].map(|knit| *knit.gauge());
    let carriers = || own.carriers().iter().zip(other.carriers());
    let any = |unlike: &dyn Fn(&KnitYarn, &Material, &KnitYarn, &Material) -> bool| {
        carriers().any(|(one, two)| {
            let material = |knit: &Knitted, yarn: &KnitYarn| knit.materials()[yarn.material as usize].clone();
            unlike(one, &material(own, one), two, &material(other, two))
        })
    };
    let usual = Finish::default();
    for (key, is_left_out) in [
        ("knit.wales_per_cm", one.wale_mm != two.wale_mm),
        ("knit.courses_per_cm", one.course_mm != two.course_mm),
        ("knit.loop_length_mm", one.loop_length_mm != two.loop_length_mm),
        ("knit.cells", own.cells() != other.cells()),
        ("names of yarns", any(&|_, one, _, two| one.name != two.name)),
        ("yarns.diameter_mm", any(&|one, _, two, _| one.radius_mm != two.radius_mm)),
        ("yarns.color", any(&|_, one, _, two| one.srgb != two.srgb)),
        ("yarns.tex", any(&|_, one, _, two| one.tex != two.tex)),
        ("yarns.hairiness", any(&|_, one, _, two| one.hairiness != two.hairiness)),
        ("yarns.bending_stiffness", any(&|_, one, _, two| one.bending != two.bending)),
        ("yarns.twist_per_m", any(&|one, _, two, _| one.twist != two.twist)),
        ("finish.settle", given.settle != read.settle),
        ("finish.length", given.finish.length != usual.length),
        ("finish.press", given.finish.press_mm != usual.press_mm),
    ] {
        assert_eq!(said(key), is_left_out, "{key}: {left_out:?}\n{text}");
    }
    let warned = read.remarks().iter().find(|remark| {
        ["header", "extension", "stitch size", "Gauge", "knitout 3"].iter().any(|word| remark.contains(word))
            && !remark.contains("stitch sizes, which")
    });
    assert_eq!(warned, None, "{text}");
    assert_eq!(again(&read, "a.knitout", |design, path| write::knitout(design, path)).2, text);
    left_out
}

/// A small program with every operation, headers, comments, and spellings that are not the usual
/// ones.
pub(crate) const PROGRAM: &str = ";!knitout-2\n;;Machine: SWG091N2\n;;Gauge: 12.7\n;;Carriers: 1 2 5 a:b\n;;Yarn-5: 50-50 Rust\n\
    ;;Position: Right\n; cast on\ninhook 5\ntuck - f3 5\ntuck - f+1 5 ;first\n\ntuck + f2 5\nreleasehook 5\n\
    x-stitch-number 070\nx-speed-number 3\nknit - f3 5\nknit - f2 5\nknit - f1 5\nin + f1 2\nstitch 10 -2.5\n\
    knit + f1 5 2\nsplit + f2 b2 5\nmiss + f3 5\ntuck + f3\npause\namiss f1\nrack -0.75\nxfer b2 f1\nrack +1\nrack -1.0\n\
    xfer f3 bs4\nxfer bs4 f3\nknit - f3 5\nknit - f1 5\nouthook 5\nout 2\nknit + f3\nsplit + f1 b2\n\tdrop b2\ndrop f2\n";

#[test]
fn a_program_of_all_operations_is_written_again() {
    let design = from_text("PROGRAM.k", PROGRAM).unwrap();
    assert_eq!(check_knitout(&design, PROGRAM), [""; 0]);
    let mut written = Vec::new();
    assert_eq!(write::knitout_to(&design, &mut written).unwrap(), [""; 0]);
    let written = String::from_utf8(written).unwrap();
    let head = ";!knitout-2\n;;Machine: SWG091N2\n;;Gauge: 12.7\n;;Carriers: 1 2 5 a:b\n;;Yarn-5: 50-50 Rust\n;;Position: Right\ninhook 5\n";
    assert!(written.starts_with(head), "{written}");
    for line in ["rack -0.75", "x-stitch-number 70", "stitch 10 -2.5", "xfer f3 bs4", "drop f3", "xfer f1 b2"]
    {
        assert!(written.lines().any(|other| other == line), "{line}: {written}");
    }
    // Half a rack is written as the machine of the file writes it.
    let other = PROGRAM.replace("SWG091N2", "Kniterate");
    check_knitout(&from_text("a.k", &other).unwrap(), &other);
    let mut written = Vec::new();
    write::knitout_to(&from_text("a.k", &other).unwrap(), &mut written).unwrap();
    assert!(String::from_utf8(written).unwrap().contains("\nrack -0.5\n"));
}

#[test]
fn what_a_program_does_not_hold_is_named() {
    let toml = "name = \"Vest\"\n[knit]\nknitout = \"a.k\"\nyarns = [\"wool\"]\nwales_per_cm = 5\ncourses_per_cm = 9\n\
                cells = \"even\"\nfloat_max = 3\nloop_length_mm = 5.0\n[knit.stitch_lengths_mm]\n70 = 5.5\n\
                [finish]\nsettle = false\nlength = 1.05\npress = 0.8\n[yarns.wool]\ntex = 50\ntwist_per_m = 300\nplies = 2\n";
    let design = read_from("vest.toml", toml, |_| Ok(PROGRAM.into())).unwrap();
    let left_out = check_knitout(&design, PROGRAM);
    let keys: Vec<_> = left_out.iter().map(|line| line.split(':').next().unwrap()).collect();
    let expected = [
        "name",
        "knit.wales_per_cm",
        "knit.courses_per_cm",
        "knit.loop_length_mm",
        "knit.stitch_lengths_mm",
        "knit.cells",
        "knit.float_max",
        "names of yarns that can't be kept",
        "yarns.diameter_mm",
        "yarns.color",
        "yarns.tex",
        "yarns.hairiness",
        "yarns.twist_per_m",
        "yarns.section",
        "finish.settle",
        "finish.length",
        "finish.press",
    ];
    // 5 wales to the cm are 12.7 needles to the inch.
    let expected: Vec<_> = expected.into_iter().filter(|key| *key != "knit.wales_per_cm").collect();
    assert_eq!(keys, expected, "{left_out:?}");
}

#[test]
fn endings_of_programs() {
    let folder = tempfile::tempdir().unwrap();
    let design = from_text("a.k", PROGRAM).unwrap();
    for name in ["a.k", "a.knitout", "A.K"] {
        write::knitout(&design, folder.path().join(name)).unwrap();
        read(folder.path().join(name)).unwrap();
    }
    let before = std::fs::read_dir(folder.path()).unwrap().count();
    let error = write::knitout(&design, folder.path().join("a.toml")).unwrap_err();
    assert!(matches!(error, WriteError::NotEnding { .. }), "{error:?}");
    let chart =
        from_text("a.toml", "knit = { chart = \"kp\", loop_length_mm = 3 }\nyarns.a.tex = 20\n").unwrap();
    assert!(write::knitout(&chart, folder.path().join("chart.k")).is_err());
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), before);
}
