//! Drafts of Fiberworks and WeavePoint: the cloth of their WIF twins, and files that are refused.

use std::io::ErrorKind;

use proptest::collection::vec;
use proptest::prelude::*;
use texere_fabric::{Drawdown, Shedding, Woven};
use texere_formats::{Design, ReadError, read_from};

fn read(name: &str, bytes: impl Into<Vec<u8>>) -> Result<Design, ReadError> {
    read_from(name, bytes, |_| Err(ErrorKind::NotFound.into()))
}

fn cloth(name: &str, bytes: impl Into<Vec<u8>>) -> Woven {
    read(name, bytes).unwrap().structure.woven().unwrap().cloth().clone()
}

/// The drawdown as a weaver draws it: the last pick on top, and end 1 on the left.
fn drawn(drawdown: &Drawdown) -> String {
    let row = |pick| (0..drawdown.ends()).map(move |end| if drawdown.up(end, pick) { '1' } else { '0' });
    (0..drawdown.picks()).rev().flat_map(|pick| row(pick).chain(['\n'])).collect()
}

/// How picks lift their shafts.
#[derive(Debug, Clone)]
enum Lifts {
    /// The shafts of each pick.
    Plan(Vec<Vec<bool>>),
    /// The shafts of each treadle, and the treadles of each pick.
    Treadles(Vec<Vec<bool>>, Vec<Vec<bool>>),
}

/// A draft that each kind of file can hold.
#[derive(Debug, Clone)]
struct Plan {
    shafts: usize,
    /// The shaft of each end, 0 for none.
    threading: Vec<usize>,
    lifts: Lifts,
    rising: bool,
    /// The colour of each end and of each pick, counted from 0.
    colors: [Vec<u8>; 2],
    palette: Vec<[u8; 3]>,
}

/// The numbers of the flags that are set, counted from 1, with commas between them. If no flag is
/// set, the text is 0.
fn set(flags: &[bool]) -> String {
    let set = (1..).zip(flags).filter(|(_, is)| **is).map(|(number, _): (usize, _)| number.to_string());
    let set: Vec<_> = set.collect();
    if set.is_empty() { "0".into() } else { set.join(",") }
}

impl Plan {
    fn picks(&self) -> usize {
        match &self.lifts {
            Lifts::Plan(rows) | Lifts::Treadles(_, rows) => rows.len(),
        }
    }

    /// Whether an end is up. In a rising shed an end is up if the pick lifts its shaft, or presses
    /// a treadle that is tied to its shaft. In a sinking shed such an end is down, and all others
    /// are up.
    fn up(&self, end: usize, pick: usize) -> bool {
        let shaft = self.threading[end];
        let lifted = shaft > 0
            && match &self.lifts {
                Lifts::Plan(rows) => rows[pick][shaft - 1],
                Lifts::Treadles(tied, pressed) => pressed[pick]
                    .iter()
                    .zip(tied)
                    .any(|(is_pressed, shafts)| *is_pressed && shafts[shaft - 1]),
            };
        lifted == self.rising
    }

    fn drawdown(&self) -> String {
        let row = |pick| {
            let up = move |end| if self.up(end, pick) { '1' } else { '0' };
            (0..self.threading.len()).map(up).chain(['\n'])
        };
        (0..self.picks()).rev().flat_map(row).collect()
    }

    fn wif(&self) -> String {
        let list = |rows: &[Vec<bool>]| -> String {
            (1..).zip(rows).map(|(number, row): (usize, _)| format!("{number}={}\n", set(row))).collect()
        };
        let each = |items: &mut dyn Iterator<Item = usize>| -> String {
            (1..).zip(items).map(|(number, item): (usize, _)| format!("{number}={item}\n")).collect()
        };
        let lifts = match &self.lifts {
            Lifts::Plan(rows) => format!("[LIFTPLAN]\n{}", list(rows)),
            Lifts::Treadles(tied, pressed) => {
                format!("[TIEUP]\n{}[TREADLING]\n{}", list(tied), list(pressed))
            }
        };
        let [warp, weft] =
            self.colors.each_ref().map(|colors| each(&mut colors.iter().map(|&c| usize::from(c) + 1)));
        let palette = (1..).zip(&self.palette);
        let palette: String =
            palette.map(|(number, [r, g, b]): (usize, _)| format!("{number}={r},{g},{b}\n")).collect();
        format!(
            "[WEAVING]\nRising Shed={}\n[WARP]\nThreads={}\nUnits=cm\nSpacing=0.212\n[WEFT]\nThreads={}\nSpacing=0.212\n\
             [COLOR PALETTE]\nRange=0,255\n[COLOR TABLE]\n{palette}[WARP COLORS]\n{warp}[WEFT COLORS]\n{weft}\
             [THREADING]\n{}{lifts}",
            self.rising,
            self.threading.len(),
            self.picks(),
            each(&mut self.threading.iter().copied()),
        )
    }

    fn dtx(&self) -> String {
        let digits =
            |row: &[bool]| row.iter().map(|is| if *is { '1' } else { '0' }).chain(['\n']).collect::<String>();
        let sinking = if self.rising { "" } else { "%%%%sinking\n" };
        let (lifts, treadles) = match &self.lifts {
            Lifts::Plan(rows) => {
                let rows: String = rows.iter().map(|row| digits(row)).collect();
                (format!("@@Liftplan\n{sinking}{rows}\n"), 0)
            }
            Lifts::Treadles(tied, pressed) => {
                let row = |shaft| digits(&tied.iter().map(|shafts| shafts[shaft]).collect::<Vec<_>>());
                let rows: String = (0..self.shafts).rev().map(row).collect();
                let picks: Vec<_> = pressed.iter().map(|row| set(row)).collect();
                (
                    format!("@@Tieup\n{sinking}{rows}\n@@Treadling\n%%compound\n{}\n\n", picks.join("  ")),
                    tied.len(),
                )
            }
        };
        let spaced = |items: &mut dyn Iterator<Item = String>| items.collect::<Vec<_>>().join("  ");
        let [warp, weft] = self.colors.each_ref().map(|colors| spaced(&mut colors.iter().map(u8::to_string)));
        let palette: String = self.palette.iter().map(|[r, g, b]| format!("{r},{g},{b}\n")).collect();
        format!(
            "@@StartDTX\n%%version 1\n\n@@Description\nA \u{e9}tude\n\n@@Contents\nImprint\nEndDTX\n\n@@Info\n%%shafts {} \n\
             %%treadles {treadles} \n%%ends {}   \n%%picks {}   \n\n@@Threading\n{}\n\n{lifts}@@Color Palet\n{palette}\n\
             @@Warp Colors\n{warp}\n\n@@Weft Colors\n{weft}\n\n@@EndDTX\n",
            self.shafts,
            self.threading.len(),
            self.picks(),
            spaced(&mut self.threading.iter().map(usize::to_string)),
        )
    }

    fn wpo(&self) -> Vec<u8> {
        let mask = |row: &Vec<bool>| {
            let mut bytes = vec![0_u8; row.len().div_ceil(8)];
            (0..row.len()).filter(|&bit| row[bit]).for_each(|bit| bytes[bit / 8] |= 1 << (bit % 8));
            bytes
        };
        let short = |count: usize| (count as u16).to_be_bytes();
        let treadles = if let Lifts::Treadles(tied, _) = &self.lifts { tied.len() } else { 1 };
        let is_single =
            |pressed: &[Vec<bool>]| pressed.iter().all(|row| row.iter().filter(|is| **is).count() < 2);
        let kind = match &self.lifts {
            Lifts::Plan(_) => 100,
            Lifts::Treadles(_, pressed) if is_single(pressed) => 101,
            Lifts::Treadles(..) => 102,
        };
        let sinking = u8::from(!self.rising);
        let mut bytes =
            vec![123, 7, kind, 10, self.shafts as u8, treadles as u8, 0, sinking, 1, 5, 5, 1, 0x86];
        bytes.extend([4, 0xb0, 4, 0xb0, 1, 3, 6, 7, 7, 0, 0]);
        bytes.extend(
            short(self.threading.len()).into_iter().chain(self.threading.iter().map(|&shaft| shaft as u8)),
        );
        for colors in &self.colors {
            bytes.extend(short(colors.len()).iter().chain(colors));
        }
        match &self.lifts {
            Lifts::Plan(rows) => {
                bytes.extend(short(rows.len()).into_iter().chain(rows.iter().flat_map(mask)))
            }
            Lifts::Treadles(tied, pressed) => {
                bytes.extend(tied.iter().flat_map(mask).chain(short(pressed.len())));
                if kind == 101 {
                    let one = |row: &Vec<bool>| row.iter().position(|is| *is).map_or(0, |at| at as u8 + 1);
                    bytes.extend(pressed.iter().map(one));
                } else {
                    bytes.extend(pressed.iter().flat_map(mask));
                }
            }
        }
        bytes.extend([0; 66].into_iter().chain([self.palette.len() as u8]));
        bytes.extend(self.palette.iter().flatten().copied());
        bytes.extend(b"\x04text");
        bytes
    }
}

fn plan() -> impl Strategy<Value = Plan> {
    let sizes = (1_usize..20, 1_usize..20, 1_usize..18, 1_usize..18, 1_usize..5);
    sizes.prop_flat_map(|(shafts, treadles, ends, picks, colors)| {
        let rows = |count, width| vec(vec(any::<bool>(), width), count);
        let one = vec(0..=treadles, picks).prop_map(move |all| {
            all.iter().map(|one| (1..=treadles).map(|at| at == *one).collect()).collect()
        });
        let lifts = prop_oneof![
            rows(picks, shafts).prop_map(Lifts::Plan),
            (rows(treadles, shafts), rows(picks, treadles))
                .prop_map(|(tied, pressed)| Lifts::Treadles(tied, pressed)),
            (rows(treadles, shafts), one).prop_map(|(tied, pressed)| Lifts::Treadles(tied, pressed)),
        ];
        let of = |count| vec(0..colors as u8, count);
        let palette = vec(any::<[u8; 3]>(), colors);
        (vec(0..=shafts, ends), lifts, any::<bool>(), [of(ends), of(picks)], palette).prop_map(
            move |(threading, lifts, rising, colors, palette)| Plan {
                shafts,
                threading,
                lifts,
                rising,
                colors,
                palette,
            },
        )
    })
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn each_kind_gives_the_cloth_of_its_wif_twin(plan in plan()) {
        let twin = cloth("twin.wif", plan.wif());
        prop_assert_eq!(drawn(twin.drawdown()), plan.drawdown());
        let files = [("draft.dtx", plan.dtx().into_bytes()), ("draft.WPO", plan.wpo()), ("draft.wifw", plan.wif().into())];
        for (name, bytes) in files {
            let design = read(name, bytes).unwrap();
            let woven = design.structure.woven().unwrap();
            let cloth = woven.cloth();
            prop_assert_eq!(drawn(cloth.drawdown()), plan.drawdown(), "{}", name);
            prop_assert_eq!(woven.draft().unwrap().drawdown().unwrap(), cloth.drawdown().clone());
            let colors = |woven: &Woven| {
                let all = woven.warp().iter().chain(woven.weft());
                all.map(|thread| woven.materials()[thread.material as usize].srgb).collect::<Vec<_>>()
            };
            prop_assert_eq!(colors(cloth), colors(&twin), "{}", name);
            if name == "draft.dtx" {
                prop_assert_eq!((cloth.warp(), cloth.weft()), (twin.warp(), twin.weft()));
                prop_assert_eq!(&design.name, "A \u{e9}tude");
            }
        }
    }
}

/// A file as Fiberworks 4.2 writes it.
const TWILL: &str = "@@StartDTX\r\n%%version 1\r\n\r\n@@Description\r\nTwill\r\n\r\n@@Info\r\n%%shafts 4 \r\n%%treadles 4 \r\n\
    %%ends 5   \r\n%%picks 4   \r\n\r\n@@Threading\r\n1  2  3\r\n4  1  \r\n\r\n@@Tieup\r\n0011\r\n0110\r\n1100\r\n1001\r\n\r\n\
    @@Treadling\r\n1  2  3  4\r\n\r\n@@Color Palet\r\n255,255,255\r\n10, 20, 30\r\n\r\n@@Warp Spacing\r\n4  8  1  0\r\n\r\n\
    @@EndDTX\r\n";

/// The drawdown of `TWILL`. Each treadle lifts two neighbouring shafts.
const TWILL_DRAWDOWN: &str = "10011\n00110\n01100\n11001\n";

fn dtx(from: &str, to: &str) -> Result<Design, ReadError> {
    assert!(TWILL.contains(from), "{from}");
    read("twill.dtx", TWILL.replacen(from, to, 1))
}

fn woven(design: &Design) -> &Woven {
    design.structure.woven().unwrap().cloth()
}

#[test]
fn a_fiberworks_file_has_spacings_colours_and_a_title() {
    let design = dtx("", "").unwrap();
    let cloth = woven(&design);
    assert_eq!((design.name.as_str(), drawn(cloth.drawdown()).as_str()), ("Twill", TWILL_DRAWDOWN));
    let spacings: Vec<_> = cloth.warp().iter().map(|end| end.spacing_mm).collect();
    for (spacing, expected) in spacings.iter().zip([2.12, 4.24, 0.53, 2.12, 2.12]) {
        assert!((spacing - expected).abs() < 1e-9, "{spacings:?}");
    }
    assert!(cloth.weft().iter().all(|pick| (pick.spacing_mm - 2.12).abs() < 1e-9));
    // Without a list of colours the warp has the first colour, and the weft has the second.
    let of = |thread: &texere_fabric::Thread| cloth.materials()[thread.material as usize].srgb;
    assert!(cloth.warp().iter().all(|end| of(end) == [255; 3]));
    assert!(cloth.weft().iter().all(|pick| of(pick) == [10, 20, 30]));
    // Threads beyond a list have the colour of its first.
    let design = dtx("@@EndDTX", "@@Weft Colors\n0 1\n").unwrap();
    let colors: Vec<_> = woven(&design).weft().iter().map(|pick| pick.material).collect();
    assert_eq!((colors[0] == colors[1], colors[0] == colors[2]), (false, true));
    assert!(!design.settle);
}

#[test]
fn a_fiberworks_file_may_be_written_in_several_ways() {
    let same =
        |from, to| assert_eq!(drawn(woven(&dtx(from, to).unwrap()).drawdown()), TWILL_DRAWDOWN, "{to}");
    same("\r\n1  2  3  4\r\n\r\n@@Color", "\n 1,  1 ,0  2\n 3, \n3 4 \n@@Color");
    same("%%treadles 4", "%%treadles 2");
    same("%%shafts 4", "%%shafts");
    same("@@Tieup", "@@Liftplan\n1111\n@@TIEUP");
    same("@@Info", "@@Threading\n9 9\n@@Info");
    let utf_16 = |unit: fn(u16) -> [u8; 2]| TWILL.encode_utf16().flat_map(unit).collect::<Vec<_>>();
    for bytes in [utf_16(u16::to_le_bytes), utf_16(u16::to_be_bytes)] {
        assert_eq!(drawn(cloth("twill.dtx", bytes).drawdown()), TWILL_DRAWDOWN);
    }
    let sinking = dtx("@@Tieup\r\n", "@@Tieup\r\n%%%%sinking\r\n").unwrap();
    let inverted: String = TWILL_DRAWDOWN
        .chars()
        .map(|up| {
            if up == '1' {
                '0'
            } else if up == '0' {
                '1'
            } else {
                up
            }
        })
        .collect();
    assert_eq!(drawn(woven(&sinking).drawdown()), inverted);
}

#[test]
fn what_a_fiberworks_file_leaves_open_is_told() {
    let told = |from, to| dtx(from, to).unwrap().warnings().join("\n");
    assert!(
        told("%%ends 5", "%%ends 3")
            .contains("@@Threading has 2 values beyond the 3 threads of @@Info; they are left out")
    );
    assert!(told("%%picks 4", "%%picks 3").contains("@@Treadling has 1 value beyond the 3 threads"));
    assert!(told("%%shafts 4", "%%shafts 3").contains("%%shafts is 3, but @@Threading goes up to 4"));
    assert!(
        told("@@Tieup", "@@Liftplan\n1\n@@Tieup").contains("lift plan and treadling give different cloths")
    );
    assert!(told("@@Color Palet", "@@Other").contains("in the warp 5 of 5 threads have no colour"));
    // Ends beyond the threading are on no shaft.
    let longer = dtx("%%ends 5", "%%ends 6").unwrap();
    assert_eq!(drawn(woven(&longer).drawdown()), TWILL_DRAWDOWN.replace('\n', "0\n"));
}

#[test]
fn refusals_of_fiberworks_files_name_line_and_column() {
    for (from, to, said) in [
        (
            "@@StartDTX",
            "% \\iffalse",
            "twill.dtx, line 1, column 1: \"% \\iffalse\", expected @@StartDTX, with which",
        ),
        ("%%ends 5", "%%ends 0", "twill.dtx: @@Info %%ends is missing or empty; it says how many threads"),
        ("%%ends 5", "%%ends 1000001", "line 10: @@Info %%ends is 1000001, outside 0 to 1000000"),
        ("%%picks 4", "%%picks 99999999999", "line 11: @@Info %%picks is 99999999999, outside 0 to 1000000"),
        ("%%picks 4", "%%picks many", "line 11: @@Info %%picks is \"many\", expected a whole number"),
        (
            "@@Threading",
            "@@Threa",
            "twill.dtx: @@Threading is missing or empty; it says which shaft each end is on",
        ),
        ("@@Tieup", "@@Tie", "twill.dtx: @@Tieup is missing or empty; it says what each treadle"),
        ("@@Treadling", "@@T", "twill.dtx: @@Treadling is missing or empty; it says which treadles"),
        ("2  3\r\n4", "2  3\r\n  4,", "line 15, column 3: \"4,\", expected a shaft from 0 to 100000"),
        ("2  3\r\n4", "2  100001\r\n4", "line 14, column 7: \"100001\", expected a shaft from 0 to 100000"),
        ("0110", "0120", "line 19, column 3: \"2\", expected 1 or 0"),
        (
            "0110",
            "010",
            "line 19, column 1: \"010\", expected 100000 rows at most, each of 4 digits as the first",
        ),
        ("\r\n1  2  3  4", "\r\n1  2  3  4,5", "line 24, column 12: \"5\", expected a treadle from 0 to 4"),
        ("255,255,255", "255,256,255", "line 27, column 1: \"255,256,255\", expected red, green and blue"),
        (
            "@@EndDTX",
            "@@Warp Colors\n1 2",
            "line 34, column 3: \"2\", expected a colour of @@Color Palette from 0 to 1",
        ),
        (
            "@@Color Palet\r\n255,255,255\r\n10, 20, 30",
            "@@Warp Colors\n0",
            "twill.dtx: @@Color Palette is missing or empty",
        ),
        (
            "4  8  1",
            "4  1887  1",
            "line 31, column 4: \"1887\", expected a spacing in units of 0.53 mm from 0 to 1886",
        ),
    ] {
        let error = dtx(from, to).expect_err(to).to_string();
        assert!(error.contains(said), "\"{error}\" lacks \"{said}\"");
    }
    // A cloth that is too large is refused by the key of its size.
    let large = TWILL.replace("%%ends 5", "%%ends 1000000").replace("%%picks 4", "%%picks 1000000");
    let error = read("twill.dtx", large).unwrap_err().to_string();
    assert!(error.contains("twill.dtx, line 10: @@Info %%ends"), "{error}");
    let long = TWILL.replace("0110", &"1".repeat(100_001));
    assert!(read("twill.dtx", long).unwrap_err().to_string().contains("line 19, column 1: \"111"));
    let long = TWILL.replace("1  2  3\r\n4", &"1 ".repeat(1_000_001));
    assert!(read("twill.dtx", long).unwrap_err().to_string().contains("line 14, column 2000001"));
}

/// A draft of three ends and two picks on ten shafts and two treadles.
fn wpo() -> Vec<u8> {
    let tied = vec![vec![false, true, false, false, false, false, false, false, true, false], vec![true; 10]];
    let plan = Plan {
        shafts: 10,
        threading: vec![2, 9, 1],
        lifts: Lifts::Treadles(tied, vec![vec![true, false], vec![false, true]]),
        rising: true,
        colors: [vec![0, 1, 0], vec![1, 0]],
        palette: vec![[1, 2, 63], [40, 50, 60]],
    };
    plan.wpo()
}

#[test]
fn a_weavepoint_file_has_setts_and_colours_of_its_version() {
    let design = read("twill.wpo", wpo()).unwrap();
    assert_eq!((design.name.as_str(), drawn(woven(&design).drawdown()).as_str()), ("twill", "111\n110\n"));
    // Five threads to the centimetre.
    assert!(woven(&design).warp().iter().chain(woven(&design).weft()).all(|thread| thread.spacing_mm == 2.0));
    let mut inches = wpo();
    inches[17] = 0;
    assert!((cloth("a.wpo", inches).warp()[0].spacing_mm - 5.08).abs() < 1e-12);
    let mut bare = wpo();
    (bare[9], bare[1]) = (0, 3);
    let design = read("a.wpo", bare).unwrap();
    assert!(design.warnings().join("\n").contains("in the warp no spacing is given; 2.0000 mm is taken"));
    let colors: Vec<_> = woven(&design).materials().iter().map(|material| material.srgb).collect();
    assert_eq!(colors, [[4, 8, 255], [162, 202, 243]]);
    let mut later = wpo();
    later[1] = 8;
    assert!(read("a.wpo", later).unwrap().warnings()[0].contains("version 8"));
    // The mask of the first treadle names shaft 11, which the loom lacks.
    let mut stray = wpo();
    stray[39] |= 1 << 2;
    let design = read("a.wpo", stray).unwrap();
    assert!(design.warnings().join("\n").contains("names shafts or treadles 1 time that the loom lacks"));
    let Shedding::TieUp { tie_up, .. } = &design.structure.woven().unwrap().draft().unwrap().shedding else {
        panic!("a tie-up");
    };
    assert_eq!(tie_up[0], [2, 9]);
}

#[test]
fn refusals_of_weavepoint_files_name_the_byte() {
    let whole = wpo();
    for (at, byte, said) in [
        (0, 122, "a.wpo, byte 0: the sign is 122, expected 123, with which drafts of WeavePoint begin"),
        (2, 99, "byte 2: the kind of draft is 99, expected 100 to 102"),
        (4, 0, "byte 4: the number of shafts is 0, expected 1 to 255"),
        (5, 0, "byte 5: the number of treadles is 0, expected 1 to 255"),
        (24, 255, "byte 24: the number of ends is 65283, expected"),
        (25, 0, "byte 24: the number of ends is 0, expected 1 to 65535"),
        (27, 11, "byte 27: the shaft of an end is 11, expected 0 to 10"),
        (29, 255, "byte 29: the number of colours of threads is 65283, expected"),
        (32, 2, "byte 32: the colour of a thread is 2, expected below 2, the number of colours"),
        (42, 255, "byte 42: the number of picks is 65282, expected"),
        (44, 3, "byte 44: the treadle of a pick is 3, expected 0 to 2"),
    ] {
        let mut bytes = whole.clone();
        bytes[at] = byte;
        let error = read("a.wpo", bytes).expect_err(said).to_string();
        assert!(error.contains(said), "\"{error}\" lacks \"{said}\"");
    }
    // A file that ends too early is refused wherever it ends, up to its last colour.
    for end in 0..whole.len() - b"\x04text".len() {
        assert!(matches!(read("a.wpo", &whole[..end]), Err(ReadError::Bytes { .. })), "{end}");
    }
}

#[test]
fn a_design_file_names_drafts_of_all_kinds() {
    let design = |name: &str| {
        let toml = format!(
            "weave.wif = \"{name}\"\nyarns.a.diameter_mm = 0.3\n[weft]\nyarns = [\"a\"]\nper_cm = 10\n"
        );
        read_from("cloth.toml", toml, |path| match path.to_str().unwrap() {
            "twill.dtx" => Ok(TWILL.into()),
            "twill.wpo" => Ok(wpo()),
            _ => Err(ErrorKind::NotFound.into()),
        })
    };
    assert_eq!(drawn(woven(&design("twill.dtx").unwrap()).drawdown()), TWILL_DRAWDOWN);
    let design_of_wpo = design("twill.wpo").unwrap();
    assert_eq!(drawn(woven(&design_of_wpo).drawdown()), "111\n110\n");
    assert!((woven(&design_of_wpo).weft()[0].spacing_mm - 1.0).abs() < 1e-9);
    let error = design("twill.png").unwrap_err().to_string();
    assert!(
        error.contains(
            "line 1: weave.wif is \"twill.png\", expected the path of a .dtx, .wpo, .wifw or .wif file"
        ),
        "{error}"
    );
}
