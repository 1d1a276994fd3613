//! Random charts, pictures, guide bars and programs of knitting machines, written and read again.

use proptest::prelude::*;
use texere_formats::read_from;

use crate::knits::{check_toml, colors, from_text, picture};
use crate::programs::check_knitout;

/// Yarns with names and numbers that need care.
const YARNS: &str = "[yarns.a]\ntex = 20\n[yarns.\"2 a\"]\ntex = 31.7\ndensity = 1.3\nplies = 2\n\
                     [yarns.\"grün [é]\"]\ndiameter_mm = 0.21\ntwist_per_m = 430\ncolor = \"#a01060\"\n";

/// Names of [`YARNS`].
const NAMES: [&str; 3] = ["a", "2 a", "grün [é]"];

/// How close stitches lie.
fn close() -> impl Strategy<Value = String> {
    let number = || prop_oneof![0.5_f64..90.0, (1_u32..60).prop_map(f64::from)];
    prop_oneof![
        (number(), number())
            .prop_map(|(wales, courses)| format!("wales_per_cm = {wales:?}\ncourses_per_cm = {courses:?}")),
        (number(), number()).prop_map(|(needles, courses)| format!(
            "needles_per_inch = {needles:?}\ncourses_per_cm = {courses:?}"
        )),
        number().prop_map(|length| format!("loop_length_mm = {length:?}")),
        (number(), number(), number()).prop_map(|(wales, courses, length)| {
            format!("wales_per_cm = {wales:?}\ncourses_per_cm = {courses:?}\nloop_length_mm = {length:?}")
        }),
    ]
}

/// Keys that charts and pictures share.
fn shared() -> impl Strategy<Value = String> {
    let more = prop_oneof![
        Just(""),
        Just("repeat = [3, 2]\n"),
        Just("cells = \"even\"\nfloat_max = 2\n"),
        Just("compression = 0.85\n"),
    ];
    (close(), more).prop_map(|(close, more)| format!("{close}\n{more}"))
}

fn turn() -> impl Strategy<Value = String> {
    let item = (1_usize..4, prop::sample::select(&NAMES[..]));
    prop::collection::vec(item, 1..4).prop_map(|items| {
        let items: Vec<_> =
            items.iter().map(|(times, name)| format!("{:?}", format!("{times} {name}"))).collect();
        format!("yarns = [{}]\n", items.join(", "))
    })
}

/// A row of symbols of one bed, `wales` long.
fn row(wales: usize) -> impl Strategy<Value = String> {
    let part =
        prop::sample::select(&["k", "k", "p", "t", "m", "<", ">", "Rr", "lL", "RRr", "lLL", "RRrr"][..]);
    prop::collection::vec(part, wales).prop_map(move |parts| {
        let mut row = String::new();
        for part in parts {
            row.push_str(if row.len() + part.len() > wales { "k" } else { part });
            if row.len() == wales {
                break;
            }
        }
        row
    })
}

/// A chart on one bed or two.
fn chart() -> impl Strategy<Value = String> {
    let one = (1_usize..8, 1_usize..6)
        .prop_flat_map(|(wales, rows)| prop::collection::vec(row(wales), rows))
        .prop_map(|rows| (rows, ""));
    let symbols = || prop::sample::select(&['k', 'p', 'b', 't', 'u', 'm'][..]);
    let two = (1_usize..6, 1_usize..6)
        .prop_flat_map(move |(wales, rows)| {
            prop::collection::vec(prop::collection::vec(symbols(), wales), rows)
        })
        .prop_map(|rows| {
            (rows.iter().map(|row| row.iter().collect()).collect::<Vec<String>>(), "beds = 2\n")
        });
    (prop_oneof![one, two], any::<bool>()).prop_map(|((mut rows, beds), ends_knit)| {
        // Most random rows have needles that never knit, and are refused. A row that knits on all
        // needles makes most charts sound.
        if ends_knit {
            rows.push(if beds.is_empty() { "k" } else { "b" }.repeat(rows[0].len()));
        }
        format!("chart = '''\n{}\n'''\n{beds}", rows.join("\n"))
    })
}

/// Rows of a picture of three colours.
fn rows() -> impl Strategy<Value = Vec<String>> {
    (1_usize..9, 1_usize..6).prop_flat_map(|(wales, rows)| {
        let row = prop::collection::vec(prop::sample::select(&['a', 'b', 'c'][..]), wales);
        prop::collection::vec(row.prop_map(|row| row.into_iter().collect::<String>()), rows)
    })
}

fn guide_bar() -> impl Strategy<Value = String> {
    let lap = (0_i32..5, -2_i32..=2).prop_map(|(from, by)| format!("{from}-{}", (from + by).max(0)));
    let chain = prop::sample::select(&[1_usize, 2, 3, 6][..]).prop_flat_map(move |courses| {
        prop::collection::vec(lap.clone(), courses).prop_map(|laps| laps.join("/"))
    });
    let guide = prop::sample::select(&["a", "2 a", "3 2 a", "grün [é]", "out", "2 out"][..]);
    let threading = prop::collection::vec(guide, 1..3);
    (chain, threading, -3_i32..4, prop::option::of(1.0_f64..900.0)).prop_map(|(chain, threading, offset, run_in)| {
        let run_in = run_in.map_or(String::new(), |mm| format!("run_in_mm = {mm:?}\n"));
        format!("[[warp_knit.bars]]\nlapping = \"{chain}\"\nthreading = {threading:?}\noffset = {offset}\n{run_in}")
    })
}

/// A line of a program for carriers 1, 2 and `c:3`.
fn line() -> impl Strategy<Value = String> {
    let way = || prop::sample::select(&["+", "-"][..]);
    let needle = || {
        (prop::sample::select(&["f", "f", "f", "b", "fs", "bs"][..]), -2_i32..5)
            .prop_map(|(bed, number)| format!("{bed}{number}"))
    };
    let carriers = || prop::sample::select(&["1", "1", "1", "2", "c:3", "2 1", ""][..]);
    let stitch =
        (prop::sample::select(&["knit", "knit", "knit", "tuck", "miss"][..]), way(), needle(), carriers());
    let sizes = || prop_oneof![-3.0_f64..80.0, (0_u32..3).prop_map(f64::from)];
    prop_oneof![
        12 => stitch.prop_map(|(code, way, needle, carriers)| format!("{code} {way} {needle} {carriers}")),
        2 => (way(), needle(), needle(), carriers())
            .prop_map(|(way, from, to, carriers)| format!("split {way} {from} {to} {carriers}")),
        2 => (needle(), needle()).prop_map(|(from, to)| format!("xfer {from} {to}")),
        1 => needle().prop_map(|needle| format!("drop {needle}")),
        2 => prop::sample::select(&["0", "1", "-1", "+2", "0.25", "-0.75", "1.5", "-2.0"][..])
            .prop_map(|rack| format!("rack {rack}")),
        1 => sizes().prop_map(|size| format!("x-stitch-number {size}")),
        1 => (sizes(), sizes()).prop_map(|(one, other)| format!("stitch {one} {other} ; loops")),
        1 => prop::sample::select(
            &["pause", "amiss f1", "; a comment", "", "x-speed-number 3", "in 2", "inhook c:3", "releasehook c:3", "out 2"][..]
        )
            .prop_map(str::to_owned),
    ]
}

fn program() -> impl Strategy<Value = String> {
    let head = prop::sample::select(
        &[
            ";!knitout-2\n;;Carriers: 1 2 c:3 4\n",
            ";!knitout-2\n;;Machine: SWGN2\n;;Gauge: 7.3\n;;Carriers: 4 c:3 2 1\n;;Yarn-1:  wool, red \n;;Position: Keep\n",
            ";;Machine: Kniterate\n;;Gauge: 15\n;;Yarn-2: 2-30 red\n",
            ";!knitout-3\n; free\n;;Yarn-4: none\n;;Gauge: fine\n;;Yarn-2:\n",
        ][..],
    );
    // A loop of carrier 1 to begin with: a program without loops is no design.
    (head, prop::collection::vec(line(), 1..40))
        .prop_map(|(head, lines)| format!("{head}in 1\nknit + f0 1\nknit + f2 1\n{}\n", lines.join("\n")))
}

/// Most random texts are designs. The others are drawn again.
fn read(text: &str) -> Result<texere_formats::Design, TestCaseError> {
    from_text("a.toml", text).map_err(|error| TestCaseError::reject(error.to_string()))
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 300,
        max_global_rejects: 3000,
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn charts(chart in chart(), turn in turn(), shared in shared()) {
        check_toml(&read(&format!("[knit]\n{chart}{turn}{shared}{YARNS}"))?);
    }

    #[test]
    fn letters(
        rows in rows(),
        backing in prop::sample::select(&["", "backing = \"birdseye\"\n", "backing = \"ladder\"\n"][..]),
        names in Just(NAMES).prop_shuffle(),
        shared in shared(),
    ) {
        let [a, b, c] = names;
        let colors = format!("colors = {{ a = {a:?}, b = {b:?}, c = {c:?} }}\n");
        let chart = rows.join("\n");
        check_toml(&read(&format!("[knit]\nchart = '''\n{chart}\n'''\n{backing}{colors}{shared}{YARNS}"))?);
    }

    #[test]
    fn pictures(
        rows in rows(),
        order in prop::sample::select(&["", "rows = \"first-pick-first\"\n"][..]),
        meant in prop::sample::select(&[NAMES, ["k", "p", "t"], ["a", "a", "2 a"], ["<", "k", "m"]][..]),
        turn in turn(),
        shared in shared(),
    ) {
        let turn = if meant.contains(&"k") { turn } else { String::new() };
        let table = colors(&[('a', meant[0]), ('b', meant[1]), ('c', meant[2])]);
        let text = format!("[knit]\nimage = \"a.png\"\n{order}{turn}{shared}{table}{YARNS}");
        let rows: Vec<&str> = rows.iter().map(String::as_str).collect();
        let design = read_from("a.toml", text, |_| Ok(picture(&rows)));
        check_toml(&design.map_err(|error| TestCaseError::reject(error.to_string()))?);
    }

    #[test]
    fn guide_bars(
        bars in prop::collection::vec(guide_bar(), 1..4),
        close in close().prop_filter("warp knits have no loop length", |close| !close.contains("loop")),
        draw_in in prop::option::of(0.2_f64..1.9),
        repeat in (1_u32..4, 1_u32..3),
    ) {
        let draw_in = draw_in.filter(|_| close.contains("inch")).map_or(String::new(), |share| format!("draw_in = {share:?}\n"));
        let size = format!("wales = 24\ncourses = 6\nrepeat = [{}, {}]\n", repeat.0, repeat.1);
        check_toml(&read(&format!("[warp_knit]\n{size}{close}\n{draw_in}{}{YARNS}", bars.concat()))?);
    }

    #[test]
    fn programs(program in program()) {
        let design = from_text("a.k", &program).map_err(|error| TestCaseError::reject(error.to_string()))?;
        prop_assert_eq!(check_knitout(&design, &program), [""; 0]);
    }
}
