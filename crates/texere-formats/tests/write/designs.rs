//! Designs as files: a design that is written and read again is equal, and a second reader of WIF,
//! which shares no code with texere's, agrees.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use texere_core::{Material, Section};
use texere_fabric::warp::Bar;
use texere_fabric::{COTTON_LEAST_AREA, Drawdown, Relief, Structure, Thread, Weave, Woven, WovenDesign};
use texere_formats::{Design, WriteError, read, write};

use crate::knits::check_toml as check_knit;

/// The woven design in `design`.
pub(crate) fn woven(design: &Design) -> &WovenDesign {
    design.structure.woven().unwrap()
}

/// The design that is read again after `write` to a file of this name, the parts that the file left
/// out, and the file's text.
pub(crate) fn again(
    design: &Design,
    name: &str,
    write: impl Fn(&Design, &Path) -> Result<Vec<String>, WriteError>,
) -> (Design, Vec<String>, String) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    let left_out = write(design, &path).unwrap();
    let text = std::fs::read_to_string(&path).unwrap();
    let design = read(&path).unwrap_or_else(|error| panic!("{error}\n{}", text.get(..3000).unwrap_or(&text)));
    (design, left_out, text)
}

pub(crate) fn as_wif(design: &Design) -> (Design, Vec<String>, String) {
    again(design, "a.wif", |design, path| write::wif(design, path))
}

pub(crate) fn as_toml(design: &Design) -> (Design, Vec<String>, String) {
    again(design, "a.toml", |design, path| write::toml(design, path))
}

/// A thread's properties except the spacing and the material's name. Section and material are
/// looked up, because the tables of two cloths may be in different order.
fn thread<'a>(cloth: &'a Woven, thread: &Thread) -> ([u32; 8], &'a Section, [u8; 3], Option<f32>) {
    let Thread { radius_mm, flatness, stiffness, firmness, least_area, twist, .. } = *thread;
    let material = &cloth.materials()[thread.material as usize];
    let section = &cloth.sections()[thread.section as usize];
    let (hairiness, bending) = (material.hairiness, material.bending.unwrap_or(0.0));
    (
        [radius_mm, flatness, stiffness, firmness, least_area, twist, hairiness, bending].map(f32::to_bits),
        section,
        material.srgb,
        material.tex,
    )
}

fn name<'a>(cloth: &'a Woven, thread: &Thread) -> &'a str {
    &cloth.materials()[thread.material as usize].name
}

/// Compares everything that a design file holds.
pub(crate) fn check_toml(given: &Design) {
    let (read, left_out, text) = as_toml(given);
    let (own, other) = (woven(given), woven(&read));
    let relieved = given.settle && own.relief() != Relief::Report;
    let cloth = if relieved { own.cloth() } else { own.as_given() };
    let made = other.as_given();
    assert!(cloth.drawdown() == made.drawdown());
    for (set, [one, two]) in
        [[cloth.warp(), made.warp()], [cloth.weft(), made.weft()]].into_iter().enumerate()
    {
        for (number, (one, two)) in one.iter().zip(two).enumerate() {
            assert_eq!(one.spacing_mm, two.spacing_mm, "{set}, {number}: {text}");
            assert_eq!(thread(cloth, one), thread(made, two), "{set}, {number}: {text}");
        }
    }
    let mut same_names = cloth.warp().iter().zip(made.warp()).chain(cloth.weft().iter().zip(made.weft()));
    let same_names = same_names.all(|(one, two)| name(cloth, one) == name(made, two));
    let said = |what: &str| left_out.iter().any(|line| line.starts_with(what));
    assert_eq!(said("names of yarns"), !same_names, "{left_out:?}");
    assert_eq!(
        (cloth.shape(), cloth.crimp(), cloth.selvedge()),
        (made.shape(), made.crimp(), made.selvedge())
    );
    assert_eq!(other.relief(), if given.settle { Relief::Report } else { own.relief() });
    assert_eq!(said("cloth.jam"), relieved);
    assert_eq!(said("the draft"), own.draft().is_some());
    assert_eq!((&given.name, given.settle, given.stretch), (&read.name, read.settle, read.stretch));
    let finish =
        texere_fabric::Finish { length: None, press_mm: None, passes: 250, record: false, ..given.finish };
    assert_eq!(finish, read.finish);
    assert_eq!(said("finish.length"), given.finish.length.is_some());
    assert_eq!(said("finish.press"), given.finish.press_mm.is_some());
    // A design that is read again is written with the same text.
    assert_eq!(as_toml(&read).2, text);
}

/// Compares everything that a WIF draft holds.
pub(crate) fn check_wif(given: &Design) {
    let (mut read, left_out, text) = as_wif(given);
    let (own, other) = (woven(given), woven(&read));
    let (cloth, made) = (own.cloth(), other.cloth());
    assert!(cloth.drawdown() == made.drawdown());
    if let Some(draft) = own.draft() {
        assert_eq!(Some(draft), other.draft());
    }
    let said = |what: &str| left_out.iter().any(|line| line.starts_with(what));
    let mut names = false;
    for (one, two) in cloth.warp().iter().zip(made.warp()).chain(cloth.weft().iter().zip(made.weft())) {
        let off = (one.spacing_mm - two.spacing_mm).abs() / one.spacing_mm;
        assert!(off <= f64::EPSILON, "{} {}", one.spacing_mm, two.spacing_mm);
        assert_eq!(one.radius_mm, two.radius_mm, "{text}");
        assert_eq!(thread(cloth, one).2, thread(made, two).2, "{text}");
        names |= name(cloth, one) != name(made, two);
        assert_eq!(two.twist, 0.0);
    }
    assert_eq!(said("names of yarns"), names, "{left_out:?}");
    let any = |what: &dyn Fn(&Thread) -> bool| cloth.warp().iter().chain(cloth.weft()).any(what);
    for (key, is_used) in [
        ("yarns.tex", any(&|each| thread(cloth, each).3.is_some())),
        ("yarns.section", any(&|each| *thread(cloth, each).1 != Section::Circle)),
        ("yarns.flatness", any(&|each| each.flatness != 1.0)),
        ("yarns.stiffness", any(&|each| each.stiffness != 1.0)),
        ("yarns.firmness", any(&|each| each.firmness != 1.0)),
        ("yarns.least_area", any(&|each| each.least_area != COTTON_LEAST_AREA)),
        ("yarns.twist_per_m", any(&|each| each.twist != 0.0)),
        ("yarns.hairiness", any(&|each| cloth.materials()[each.material as usize].hairiness != 0.0)),
        ("cloth.selvedge", cloth.selvedge()),
        ("cloth.shape", cloth.shape() != made.shape()),
        ("cloth.warp_crimp", cloth.crimp() != made.crimp()),
        ("cloth.jam", own.relief() != Relief::Report),
        ("finish.settle", given.settle),
        ("finish.warp_tension", given.finish.taut.warp != 1.0),
        ("finish.weft_tension", given.finish.taut.weft != 1.0),
        ("finish.calender", given.finish.calender != 1.0),
        ("finish.stretch", given.stretch.is_some()),
        ("finish.length", given.finish.length.is_some()),
        ("finish.press", given.finish.press_mm.is_some()),
        ("name: ", given.name != read.name),
    ] {
        assert_eq!(said(key), is_used, "{key}: {left_out:?}");
    }
    second_reader(&text, cloth);
    // A draft without a title has the name of its file.
    read.name.clone_from(&given.name);
    assert_eq!(as_wif(&read).2, text);
}

/// Reads a WIF file by the standard, and compares the cloth.
fn second_reader(text: &str, cloth: &Woven) {
    let mut sections: BTreeMap<&str, BTreeMap<&str, &str>> = BTreeMap::new();
    let mut open = "";
    for line in text.lines().filter(|line| !line.is_empty()) {
        match line.strip_prefix('[').and_then(|rest| rest.strip_suffix(']')) {
            Some(name) => open = name,
            None => {
                let (key, value) = line.split_once('=').unwrap();
                assert!(
                    sections.entry(open).or_default().insert(key, value).is_none(),
                    "{key} twice in {open}"
                );
            }
        }
    }
    assert_eq!(sections["WIF"]["Version"], "1.1");
    let listed: Vec<_> = sections["CONTENTS"].keys().copied().collect();
    let there: Vec<_> = sections.keys().copied().filter(|name| !["WIF", "CONTENTS"].contains(name)).collect();
    assert_eq!(listed, there);
    let list = |section: &str, key: usize| -> Vec<usize> {
        let value = sections[section].get(&*key.to_string()).copied().unwrap_or("0");
        value.split(',').map(|number| number.parse().unwrap()).filter(|number| *number > 0).collect()
    };
    let count = |section: &str, key: &str| sections[section][key].parse::<usize>().unwrap();
    let (ends, picks) = (count("WARP", "Threads"), count("WEFT", "Threads"));
    assert_eq!((ends, picks), (cloth.drawdown().ends(), cloth.drawdown().picks()));
    let rises = sections["WEAVING"]["Rising Shed"] == "true";
    let threading: Vec<_> = (1..=ends).map(|end| list("THREADING", end)).collect();
    let on_loom =
        |number: &usize, key: &str| assert!((1..=count("WEAVING", key)).contains(number), "{key} {number}");
    threading.iter().flatten().for_each(|shaft| on_loom(shaft, "Shafts"));
    for pick in 1..=picks {
        let mut lifted: Vec<usize> = if sections.contains_key("LIFTPLAN") {
            list("LIFTPLAN", pick)
        } else {
            let treadles = list("TREADLING", pick);
            treadles.iter().for_each(|treadle| on_loom(treadle, "Treadles"));
            treadles.into_iter().flat_map(|treadle| list("TIEUP", treadle)).collect()
        };
        lifted.iter().for_each(|shaft| on_loom(shaft, "Shafts"));
        lifted.sort_unstable();
        for (end, shafts) in threading.iter().enumerate() {
            let up = shafts.iter().any(|shaft| lifted.binary_search(shaft).is_ok());
            assert_eq!(up == rises, cloth.drawdown().up(end, pick - 1), "end {end}, pick {pick}");
        }
    }
    for (set, threads) in [("WARP", cloth.warp()), ("WEFT", cloth.weft())] {
        let unit = match sections[set]["Units"] {
            "Centimeters" => 10.0,
            "Inches" => 25.4,
            "Decipoints" => 25.4 / 720.0,
            other => panic!("{other}"),
        };
        let of = |what: &str, single: &str, number: usize| {
            let own = sections.get(&*format!("{set} {single}")).and_then(|own| own.get(&*number.to_string()));
            own.or_else(|| sections[set].get(what)).copied()
        };
        for (thread, number) in threads.iter().zip(1..) {
            let length = |what, single| of(what, single, number).unwrap().parse::<f64>().unwrap() * unit;
            assert!((length("Spacing", "SPACING") / thread.spacing_mm - 1.0).abs() < 1e-14);
            let diameter = 2.0 * f64::from(thread.radius_mm);
            assert!((length("Thickness", "THICKNESS") / diameter - 1.0).abs() < 1e-7);
            let material = &cloth.materials()[thread.material as usize];
            match of("Color", "COLORS", number) {
                Some(color) => {
                    let rgb: Vec<u8> =
                        sections["COLOR TABLE"][color].split(',').map(|rgb| rgb.parse().unwrap()).collect();
                    assert_eq!(rgb, material.srgb);
                }
                None => assert_eq!(*material, Material::default()),
            }
        }
    }
    if let Some(palette) = sections.get("COLOR PALETTE") {
        assert_eq!(palette["Entries"], sections["COLOR TABLE"].len().to_string());
    }
}

/// All files with one of these endings in a folder and its subfolders.
fn files(folder: &Path, endings: &[&str]) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(files(&path, endings));
        } else if path.extension().is_some_and(|ending| endings.iter().any(|one| ending == *one)) {
            found.push(path);
        }
    }
    found.sort_unstable();
    found
}

#[test]
fn our_own_designs_are_read_again() {
    let (mut woven, mut knits) = (0, 0);
    for path in files(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../../designs"), &["toml", "wif"]) {
        let design = read(&path).unwrap();
        if let Structure::Woven(_) = design.structure {
            println!("{}", path.display());
            check_toml(&design);
            // The other cloths of the paper are all 3/1 twill and differ in size alone, so they are
            // not written as WIF.
            if path.to_string_lossy().contains("figure") || !path.to_string_lossy().contains("paper") {
                check_wif(&design);
            }
            woven += 1;
            continue;
        }
        let refused = write::wif_to(&design, Vec::new());
        assert!(matches!(refused, Err(WriteError::Unheld { .. })), "{}: {refused:?}", path.display());
        println!("{}", path.display());
        let is_jacquard = |bar: &Bar| bar.jacquard.is_some();
        if matches!(&design.structure, Structure::Warp(knit) if knit.bars().iter().any(is_jacquard)) {
            let refused = write::toml_to(&design, Vec::new()).unwrap_err().to_string();
            assert!(refused.contains("can't hold bar 1, a Jacquard bar"), "{refused}");
        } else {
            check_knit(&design);
            knits += 1;
        }
    }
    assert!(woven > 20 && knits > 20, "{woven} {knits}");
}

/// A cloth with all ends like `warp`, and a red weft.
fn small(drawdown: Drawdown, warp: Thread) -> Woven {
    let red = Material { name: "red".into(), srgb: [200, 0, 0], ..Material::default() };
    let (ends, picks) = (drawdown.ends(), drawdown.picks());
    let warp = vec![warp; ends];
    let weft = vec![Thread { material: 1, ..Thread::new(0.5, 0.1) }; picks];
    Woven::new(drawdown, warp, weft, vec![Material::default(), red], vec![Section::Circle]).unwrap()
}

fn design(cloth: Woven) -> Design {
    Design::of("small", Structure::Woven(WovenDesign::new(cloth, None, Relief::Report).unwrap()))
}

#[test]
fn cloth_that_is_one_side_alone_is_held() {
    for up in [true, false] {
        let cloth = small(Drawdown::from_fn(3, 2, |_, _| up).unwrap(), Thread::new(0.5, 0.1));
        check_wif(&design(cloth.clone()));
        check_toml(&design(cloth));
    }
}

#[test]
fn many_kinds_of_picks_take_a_lift_plan() {
    let cloth = |side: usize| {
        // Every end and every pick differs.
        let drawdown = Drawdown::from_fn(side, side, |end, pick| end < pick).unwrap();
        small(drawdown, Thread::new(0.5, 0.1))
    };
    for (side, section) in [(100, "[TREADLING]"), (102, "[LIFTPLAN]")] {
        let design = design(cloth(side));
        check_wif(&design);
        assert!(as_wif(&design).2.contains(section), "{side}");
    }
}

#[test]
fn threads_as_thick_as_their_spacing_stay_so() {
    // If the text names another program as its source, thicknesses that equal spacings are taken
    // for the widths at which that program draws threads. The threads are then made thinner.
    let cloth = small(Weave::parse("plain").unwrap().drawdown(4, 4).unwrap(), Thread::new(0.2, 0.1));
    let (read, _, text) = as_wif(&design(cloth));
    assert_eq!(woven(&read).cloth().warp()[0].radius_mm, 0.1);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("other.wif");
    std::fs::write(&path, text.replace("Source Program=texere", "Source Program=other")).unwrap();
    assert_ne!(woven(&texere_formats::read(&path).unwrap()).cloth().warp()[0].radius_mm, 0.1);
}

#[test]
fn sizes_that_no_unit_holds_to_the_bit_have_the_same_text_again() {
    // No unit writes more than one of these three spacings to the bit, so decipoints are taken,
    // which need the fewest digits. The sizes that are then read are exact in centimetres, too,
    // with as many digits. Centimetres are tried first, so a writer that looked at the given sizes
    // alone would change the unit the second time.
    let sizes = [(819.4922889486355, 214.85893), (10.0 / 12.0, 305.75195), (232.13929242082267, 159.15794)];
    let warp = sizes.map(|(spacing_mm, radius_mm)| Thread::new(spacing_mm, radius_mm)).to_vec();
    let drawdown = Weave::parse("plain").unwrap().drawdown(3, 2).unwrap();
    let weft = vec![Thread::new(0.5, 0.1); 2];
    let cloth = Woven::new(drawdown, warp, weft, vec![Material::default()], vec![Section::Circle]);
    check_wif(&design(cloth.unwrap()));
}

#[test]
fn what_no_reader_takes_is_refused_by_name() {
    let plain = || Weave::parse("plain").unwrap().drawdown(4, 4).unwrap();
    for (thread, said) in [
        (Thread::new(1e-4, 0.1), "spacing_mm, number 1, is 0.0001; a design file takes 0.001 to 1000"),
        (Thread::new(0.5, 2000.0), "yarns.undyed.diameter_mm is 4000; a design file takes 0.001 to 1000"),
        (Thread { twist: 900.0, ..Thread::new(0.5, 0.1) }, "yarns.undyed.twist_per_m is 143239"),
    ] {
        let error = write::toml_to(&design(small(plain(), thread)), Vec::new()).unwrap_err();
        assert!(error.to_string().contains(said), "{error}");
    }
    let threads = vec![Thread::new(0.5, 0.1); 4];
    let hairy = Material { hairiness: 31.0, ..Material::default() };
    let hairy = Woven::new(plain(), threads.clone(), threads, vec![hairy], vec![Section::Circle]).unwrap();
    let error = write::toml_to(&design(hairy), Vec::new()).unwrap_err();
    assert!(
        error.to_string().contains("yarns.undyed.hairiness is 31; a design file takes 0 to 30"),
        "{error}"
    );
    let thin = design(small(plain(), Thread::new(0.5, 4e-4)));
    let error = write::wif_to(&thin, Vec::new()).unwrap_err();
    assert!(error.to_string().starts_with("[WARP THICKNESS] 1, in "), "{error}");
    // A cloth without a repeat, with more crossings than a design file may have bytes.
    let mut bits = 1_u64;
    let noise = Drawdown::from_fn(4200, 4200, |_, _| {
        bits ^= bits << 13;
        bits ^= bits >> 7;
        bits ^= bits << 17;
        bits & 1 == 1
    });
    let error =
        write::toml_to(&design(small(noise.unwrap(), Thread::new(0.5, 0.1))), Vec::new()).unwrap_err();
    assert!(matches!(error, WriteError::TextTooLarge { limit: 16_777_216, .. }), "{error}");
}

#[test]
fn endings_are_checked_before_anything_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let design = design(small(Weave::parse("plain").unwrap().drawdown(4, 4).unwrap(), Thread::new(0.5, 0.1)));
    for refused in
        [write::wif(&design, folder.path().join("a.toml")), write::toml(&design, folder.path().join("a.wif"))]
    {
        assert!(matches!(refused, Err(WriteError::NotEnding { .. })), "{refused:?}");
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn a_writer_gets_the_bytes_of_the_file() {
    let design = read(Path::new(env!("CARGO_MANIFEST_DIR")).join("../../designs/herringbone.wif")).unwrap();
    let (mut wif, mut toml) = (Vec::new(), Vec::new());
    assert_eq!(write::wif_to(&design, &mut wif).unwrap(), as_wif(&design).1);
    assert_eq!(write::toml_to(&design, &mut toml).unwrap(), as_toml(&design).1);
    assert!(wif == as_wif(&design).2.as_bytes() && toml == as_toml(&design).2.as_bytes());
}

#[test]
fn rows_of_a_drawdown_are_checked_one_by_one() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("rows.toml");
    let read = |weave: &str| {
        let threads = "yarns.a.diameter_mm = 0.3\nwarp = { yarns = [\"a\"], per_cm = 8 }\nweft = { yarns = [\"a\"], per_cm = 8 }\n";
        std::fs::write(&path, format!("{threads}[weave]\n{weave}\n")).unwrap();
        read(&path)
    };
    // The last pick is on top. Trailing spaces and empty lines have no meaning.
    let design = read("drawdown = \"\"\"\n001  \n\n  110\n\"\"\"\nends = 5").unwrap();
    let drawdown = woven(&design).cloth().drawdown().clone();
    assert_eq!((drawdown.ends(), drawdown.picks()), (5, 2));
    let up = |pick| (0..5).map(|end| drawdown.up(end, pick)).collect::<Vec<_>>();
    assert_eq!(up(0), [true, true, false, true, true]);
    assert_eq!(up(1), [false, false, true, false, false]);
    for (weave, said) in [
        ("drawdown = \"\"", "weave.drawdown is \"\", expected a row of 1 and 0"),
        ("drawdown = \"101\\n10\"", "row 2 from the top, is \"10\", expected 3 digits"),
        ("drawdown = \"101\\n1x1\"", "row 2 from the top, is \"1x1\", expected 1 where the warp is up"),
        ("drawdown = \"1\"\nnotation = \"plain\"", "exactly one of weave.notation, weave.drawdown"),
        ("drawdown = \"1\"\nends = 0", "weave.ends is 0, outside 1 to"),
        ("drawdown = \"1\"\nrepeat = [1, 1]", "weave.repeat"),
    ] {
        let error = read(weave).unwrap_err().to_string();
        assert!(error.contains(said), "{error}");
    }
}
