//! Knits as design files: a knit that is written and read again has the same stitches, yarns and
//! sizes. What a format can't hold is refused by name.

use std::io::ErrorKind;

use image::{Rgb, RgbImage};
use texere_core::settling::Length;
use texere_core::{Material, Section};
use texere_fabric::weft::{Chart, Gauge, KnitYarn, Knitted, Machine};
use texere_fabric::{Along, Finish, Relief, RestBy, Structure, Thread, Weave, Woven, WovenDesign};
use texere_formats::{Design, ReadError, WriteError, read_from, write};

use crate::designs::again;
use crate::programs::PROGRAM;

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
    // A knit that was not read from a file, and designs whose knit was replaced.
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

/// Stripes whose list of yarns can't be shortened without changing the number of courses, names
/// that need care in lists, and numbers of wales that only inches give to the bit.
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

/// A reader refuses plates and free lengths with rest by energy.
#[test]
fn what_rest_by_energy_does_not_know_is_left_out() {
    let mut design = from_text("a.toml", CHART).unwrap();
    design.finish.by = RestBy::Energy;
    (design.finish.press_mm, design.finish.length) = (Some(0.4), Some(Length::Free { tension: 0.01 }));
    let (read, left_out, _) = as_toml(&design);
    let finish = ["finish.length = \"free\", which", "finish.press, which"];
    assert!(finish.iter().all(|key| left_out.iter().any(|line| line.starts_with(key))), "{left_out:?}");
    assert_eq!(read.finish, Finish { by: RestBy::Energy, ..Finish::default() });
}

#[test]
fn the_way_along_which_a_knit_is_held_is_written() {
    let mut design = from_text("a.toml", CHART).unwrap();
    for along in Along::ALL {
        design.finish = Finish { by: RestBy::Energy, hold: Some(along), ..Finish::default() };
        check_toml(&design);
    }
    design.finish.by = RestBy::Contact;
    let (read, left_out, _) = as_toml(&design);
    assert!(left_out.iter().any(|line| line.starts_with("finish.hold, which")), "{left_out:?}");
    assert_eq!(read.finish, Finish::default());
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
