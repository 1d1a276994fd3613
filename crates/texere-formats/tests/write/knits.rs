//! Knits as files: a knit that is written and read again has the same stitches, and a knitout file
//! has the same operations as the file that the knit came from, word by word.

use std::io::ErrorKind;

use image::{Rgb, RgbImage};
use texere_core::settling::Length;
use texere_core::{Material, Section};
use texere_fabric::weft::{Chart, Gauge, KnitYarn, Knitted, Machine, Step, Stitches};
use texere_fabric::{Finish, Relief, Structure, Thread, Weave, Woven, WovenDesign};
use texere_formats::{Design, ReadError, WriteError, read, read_from, write};

use crate::designs::again;

/// A design in memory that names no other file.
pub(crate) fn from_text(name: &str, text: &str) -> Result<Design, ReadError> {
    read_from(name, text, |_| Err(ErrorKind::NotFound.into()))
}

fn as_toml(design: &Design) -> (Design, Vec<String>, String) {
    again(design, "a.toml", |design, path| write::toml(design, path))
}

/// A yarn with its section and its material. They are looked up, because the tables of two cloths
/// may be in different order.
fn yarn<'a>(
    yarn: &KnitYarn,
    materials: &'a [Material],
    sections: &'a [Section],
) -> ([u32; 2], &'a Material, &'a Section) {
    let KnitYarn { radius_mm, material, section, twist } = *yarn;
    ([radius_mm, twist].map(f32::to_bits), &materials[material as usize], &sections[section as usize])
}

fn yarns(knit: &Knitted) -> Vec<([u32; 2], &Material, &Section)> {
    knit.carriers().iter().map(|each| yarn(each, knit.materials(), knit.sections())).collect()
}

/// Compares everything that a design file holds of a knit.
pub(crate) fn check_toml(given: &Design) {
    let (read, left_out, text) = as_toml(given);
    assert_eq!(left_out, [""; 0], "{text}");
    match (&given.structure, &read.structure) {
        (Structure::Weft(own), Structure::Weft(other)) => {
            assert!(own.stitches() == other.stitches(), "{text}");
            assert_eq!(yarns(own), yarns(other), "{text}");
            assert_eq!((own.gauge(), own.copies()), (other.gauge(), other.copies()), "{text}");
            assert_eq!(own.cells(), other.cells());
            let instructions = |design: &Design, source| design.program_place(source).unwrap().instructions;
            for source in own.stitches().loops.iter().map(|stitch| stitch.source).take(50) {
                assert_eq!(instructions(given, source), instructions(&read, source), "{text}");
            }
        }
        (Structure::Warp(own), Structure::Warp(other)) => {
            assert_eq!((own.gauge(), own.copies()), (other.gauge(), other.copies()), "{text}");
            assert_eq!((own.lapped_size(), own.cells()), (other.lapped_size(), other.cells()));
            for (one, two) in own.bars().iter().zip(other.bars()) {
                assert_eq!((&one.chain, one.offset, one.run_in_mm), (&two.chain, two.offset, two.run_in_mm));
                let held = |knit: &texere_fabric::warp::WarpKnitted, guide: &Option<u32>| {
                    let all = knit.guide_yarns().to_vec();
                    let (materials, sections) = (knit.materials().to_vec(), knit.sections().to_vec());
                    guide.map(|guide| format!("{:?}", yarn(&all[guide as usize], &materials, &sections)))
                };
                let guides = one.threading.guides().iter().zip(two.threading.guides());
                assert_eq!(one.threading.period(), two.threading.period());
                guides.for_each(|(one, two)| assert_eq!(held(own, one), held(other, two), "{text}"));
            }
            assert_eq!(own.bars().len(), other.bars().len());
        }
        _ => panic!("another structure: {text}"),
    }
    assert_eq!((&given.name, given.settle, given.finish), (&read.name, read.settle, read.finish), "{text}");
    let faults = |design: &Design| design.faults().iter().map(|fault| fault.is_error).collect::<Vec<_>>();
    assert_eq!(faults(given), faults(&read), "{text}");
    // A design that is read again is written with the same text.
    assert_eq!(as_toml(&read).2, text);
}

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
const PROGRAM: &str = ";!knitout-2\n;;Machine: SWG091N2\n;;Gauge: 12.7\n;;Carriers: 1 2 5 a:b\n;;Yarn-5: 50-50 Rust\n\
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

fn refused(outcome: Result<Vec<String>, WriteError>, said: &str) {
    let error = outcome.unwrap_err();
    assert!(matches!(error, WriteError::Unheld { .. }), "{error:?}");
    assert_eq!(error.to_string(), said);
}

const CHART: &str = "[knit]\nchart = \"kp\"\nloop_length_mm = 3.0\n[yarns.a]\ntex = 20\n";

#[test]
fn what_a_format_does_not_hold_says_which_one_does() {
    let sink = std::io::sink;
    let program = from_text("a.k", PROGRAM).unwrap();
    let chart = from_text("a.toml", CHART).unwrap();
    let threads = || vec![Thread::new(1.0, 0.2); 4];
    let plain = Weave::parse("plain").unwrap().drawdown(4, 4).unwrap();
    let woven = Woven::new(plain, threads(), threads(), vec![Material::default()], vec![Section::Circle]);
    let woven = WovenDesign::new(woven.unwrap(), None, Relief::Report).unwrap();
    let woven = Design::of("plain", Structure::Woven(woven));
    refused(
        write::toml_to(&program, sink()),
        "a design file can't hold a program of a knitting machine; a knitout file holds it",
    );
    refused(
        write::knitout_to(&chart, sink()),
        "a knitout file can't hold a repeat, which goes on beyond its edges; a design file holds it",
    );
    refused(write::knitout_to(&woven, sink()), "a knitout file can't hold woven cloth");
    refused(write::wif_to(&chart, sink()), "a WIF draft can't hold a weft knit");
    // A knit that a program made itself, and a design whose knit was replaced.
    let made = Chart::parse("kk", Default::default()).unwrap().program().unwrap();
    let made = Machine::default().knit(&made).unwrap().stitches;
    let (yarns, materials) = (vec![KnitYarn::new(0.1)], vec![Material::default()]);
    let made = Knitted::new(made, Gauge::munden(3.0), yarns, materials, vec![Section::Circle], [1, 1]);
    let made = Design::of("made", Structure::Weft(made.unwrap()));
    for write in [write::toml_to(&made, sink()), write::knitout_to(&made, sink())] {
        let error = write.unwrap_err().to_string();
        assert!(error.ends_with("can't hold a weft knit whose program is not known"), "{error}");
    }
    for mut replaced in [program, chart] {
        replaced.structure = made.structure.clone();
        for write in [write::toml_to(&replaced, sink()), write::knitout_to(&replaced, sink())] {
            let error = write.unwrap_err().to_string();
            assert!(error.ends_with("with other stitches than its own program makes"), "{error}");
        }
    }
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
    let chart = from_text("a.toml", CHART).unwrap();
    assert!(write::knitout(&chart, folder.path().join("chart.k")).is_err());
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), before);
}

/// The bytes of a PNG of these rows, the first one on top. Each letter is a colour.
pub(crate) fn picture(rows: &[&str]) -> Vec<u8> {
    let color = |letter: u8| Rgb([letter, 255 - letter, 7]);
    let image = RgbImage::from_fn(rows[0].len() as u32, rows.len() as u32, |x, y| {
        color(rows[y as usize].as_bytes()[x as usize])
    });
    let mut bytes = std::io::Cursor::new(Vec::new());
    image.write_to(&mut bytes, image::ImageFormat::Png).unwrap();
    bytes.into_inner()
}

/// A table of colours for [`picture`]: what each letter stands for.
pub(crate) fn colors(meant: &[(char, &str)]) -> String {
    let line = |&(letter, meant): &(char, &str)| {
        format!("\"#{:02x}{:02x}07\" = {meant:?}\n", letter as u8, 255 - letter as u8)
    };
    format!("[knit.colors]\n{}", meant.iter().map(line).collect::<String>())
}

/// A picture as a Jacquard, one whose top row is knitted first, one with a backing, and one whose
/// colours are symbols.
#[test]
fn pictures_become_charts() {
    let rows = ["abca", "bbbb", "caac"];
    let close = "wales_per_cm = 9\ncourses_per_cm = 13.5\nrepeat = [2, 3]\n";
    let yarns = "[yarns.zebra]\ntex = 20\n[yarns.ant]\ntex = 20\n[yarns.cat]\ndiameter_mm = 0.3\nsection = { shape = \"ellipse\", aspect = 1.5 }\n";
    let jacquard = colors(&[('a', "zebra"), ('b', "ant"), ('c', "cat")]);
    let symbols = colors(&[('a', "k"), ('b', "p"), ('c', "t")]);
    let stripes = "yarns = [\"2 cat\", \"ant\"]\n";
    for (more, table) in [
        ("", &jacquard),
        ("rows = \"first-pick-first\"\n", &jacquard),
        ("backing = \"birdseye\"\n", &jacquard),
        ("backing = \"ladder\"\ncells = \"even\"\n", &jacquard),
        (stripes, &symbols),
        ("yarns = [\"cat\"]\nbeds = 2\nrows = \"first-pick-first\"\nfloat_max = 2\n", &symbols),
    ] {
        let text = format!("[knit]\nimage = \"motif.png\"\n{close}{more}{table}{yarns}");
        let design = read_from("motif.toml", text, |_| Ok(picture(&rows))).unwrap();
        check_toml(&design);
    }
    // A chart whose letters are yarns is the picture whose colours are these yarns.
    let text = |pattern: &str| format!("[knit]\n{pattern}{yarns}");
    let letters = "chart = '''\nz n c z\nnnnn\n\nczzc\n'''\nbacking = \"ladder\"\n";
    let letters =
        format!("{letters}{close}colors = {{ z = \"zebra\", n = \"ant\", c = \"cat\", d = \"cat\" }}\n");
    let chart = from_text("a.toml", &text(&letters)).unwrap();
    assert!(
        chart.remarks()[0].contains("knit.colors has letters that the chart does not have: \"d\""),
        "{:?}",
        chart.remarks()
    );
    let image = format!("image = \"motif.png\"\n{close}backing = \"ladder\"\n{jacquard}");
    let image = read_from("a.toml", text(&image), |_| Ok(picture(&rows))).unwrap();
    let [one, two] = [&chart, &image].map(|design| design.structure.knitted().unwrap());
    assert!(one.stitches() == two.stitches());
    assert_eq!(yarns_of(one), yarns_of(two));
    check_toml(&chart);
}

fn yarns_of(knit: &Knitted) -> Vec<String> {
    yarns(knit).iter().map(|yarn| format!("{yarn:?}")).collect()
}

#[test]
fn faults_of_letters_are_named() {
    let read = |chart: &str, more: &str| {
        let text = format!(
            "[knit]\nchart = \"\"\"\n{chart}\n\"\"\"\nwales_per_cm = 9\ncourses_per_cm = 9\n{more}\n[yarns.red]\ntex = 20\n"
        );
        let error = from_text("a.toml", &text).unwrap_err();
        format!("{error}: {}", std::error::Error::source(&error).map(ToString::to_string).unwrap_or_default())
    };
    for (chart, more, said) in [
        (
            "rr\nrx",
            "colors = { r = \"red\" }",
            "line 2: knit.chart, row 2 from the top, column 2, is \"x\", expected a letter of [knit.colors]: \"r\"",
        ),
        ("rr\nr", "colors = { r = \"red\" }", "row 2 of the chart has 1 stitches, the first one 2"),
        ("", "colors = { r = \"red\" }", "a chart of 0 wales and 0 rows"),
        (
            "r",
            "colors = { rr = \"red\" }",
            "a letter of [knit.colors] is \"rr\", expected a letter of the chart",
        ),
        ("r", "colors = { \" \" = \"red\" }", "a letter of [knit.colors] is \" \", expected a letter"),
        ("r", "colors = { r = \"blue\" }", "knit.colors.r is \"blue\", expected a yarn of [yarns]: \"red\""),
        ("r", "colors = { r = \"red\" }\nbeds = 1", "knit.beds is given without a chart of symbols"),
        ("r", "colors = { r = \"red\" }\nyarns = [\"red\"]", "is given without a chart of symbols"),
        ("r", "colors = { r = \"red\" }\nbacking = \"plain\"", "knit.backing is \"plain\", expected"),
        (
            "r",
            "colors = { r = \"red\" }\nrows = \"last-pick-first\"",
            "knit.rows is given without knit.image",
        ),
        ("k", "backing = \"ladder\"", "knit.backing is given without knit.colors"),
    ] {
        let error = read(chart, more);
        assert!(error.contains(said), "{chart}, {more}: {error}");
    }
}

/// Stripes of which a shorter list of yarns would give other courses, names that need care in
/// lists, and numbers of wales that only inches give to the bit.
#[test]
fn charts_with_stripes_and_odd_names() {
    for (chart, yarns, close) in [
        ("k", "\"a\", \"a\"", "loop_length_mm = 3.1"),
        ("k", "\"a\", \"1 b\", \"a\", \"b\"", "needles_per_inch = 14\ncourses_per_cm = 11"),
        ("kp\\nkk", "\"2 a\", \"b\"", "wales_per_cm = 6.7\ncourses_per_cm = 0.3\nloop_length_mm = 4.4"),
        ("kp\\nkk", "\"b\", \"b\", \"b\"", "needles_per_inch = 99.1\ncourses_per_cm = 900"),
        (
            ">k\\nRr\\nkk",
            "\"2 a\", \"3 2 a\", \"out\"",
            "needles_per_inch = 0.3\ncourses_per_cm = 11\ncompression = 0.87",
        ),
        ("bu\\nkb\\nbb", "\"a\"", "beds = 2\ncells = \"even\"\nloop_length_mm = 999.5"),
    ] {
        let text = format!(
            "name = \"x\\\"y\"\n[knit]\nchart = \"{chart}\"\nyarns = [{yarns}]\n{close}\n[finish]\nlength = \"free\"\n\
             tension = 0.1\npress = 0.001\n[yarns.a]\ntex = 20\n[yarns.b]\ntex = 30.5\ndensity = 1.1\nhairiness = 3\n\
             [yarns.\"2 a\"]\ndiameter_mm = 0.123\ntwist_per_m = -500\n[yarns.out]\ndiameter_mm = 0.2\n"
        );
        check_toml(&from_text("a.toml", &text).unwrap());
    }
    let mut design = from_text("a.toml", CHART).unwrap();
    for length in [Length::Held, Length::Given(0.5), Length::Given(1.05), Length::Free { tension: 0.0 }] {
        design.finish.length = Some(length);
        check_toml(&design);
    }
    design.finish.length = Some(Length::Given(3.0));
    let error = write::toml_to(&design, std::io::sink()).unwrap_err().to_string();
    assert_eq!(error, "finish.length is 3; a design file takes 0.5 to 2");
}

#[test]
fn guide_bars_are_written_again() {
    for close in ["wales_per_cm = 10", "needles_per_inch = 24\ndraw_in = 0.83", "needles_per_inch = 28"] {
        let text = format!(
            "[warp_knit]\nwales = 8\ncourses = 24\nrepeat = [2, 1]\n{close}\ncourses_per_cm = 13.333\ncells = \"even\"\n\
             [[warp_knit.bars]]\nlapping = \"closed atlas 3\"\nthreading = [\"2 b\", \"out\", \"b\", \"3 out\", \"a b\"]\n\
             offset = -3\nrun_in_mm = 1600.5\n\
             [[warp_knit.bars]]\nlapping = \"2-0/(4-2/2-4)x3/2-4//\"\nstep = 2\nthreading = [\"a b\"]\n\
             [yarns.\"a b\"]\ndiameter_mm = 0.08\n[yarns.b]\ntex = 4\ncolor = \"#123456\"\nplies = 3\n"
        );
        check_toml(&from_text("a.toml", &text).unwrap());
    }
    // The only yarn of a bar may have the name that stands for an empty guide.
    let text = "[warp_knit]\nwales = 2\ncourses = 2\nwales_per_cm = 10\ncourses_per_cm = 13\n[[warp_knit.bars]]\n\
                lapping = \"tricot\"\n[yarns.\"3 out\"]\ndiameter_mm = 0.08\n";
    let (read, left_out, text) = as_toml(&from_text("a.toml", text).unwrap());
    assert_eq!(left_out, ["names of yarns that can't be kept: \"3 out\" becomes \"3 out (2)\""]);
    let Structure::Warp(knit) = &read.structure else { panic!("{text}") };
    assert_eq!(knit.bars()[0].threading.guides(), [Some(0)], "{text}");
}
