//! Weave notation against matrices drawn by hand, and refusals of wrong notation.

use texere_fabric::{Weave, WovenError};

/// Checks a weave against a drawing. `#` is warp up, and the first pick is at the bottom. A drawing
/// may show several repeats.
#[track_caller]
fn draws(text: &str, repeat: (usize, usize), drawing: &[&str]) {
    let weave: Weave = text.parse().unwrap();
    assert_eq!(weave.repeat(), repeat, "repeat of {text}");
    let (ends, picks) = (drawing[0].len(), drawing.len());
    let drawdown = weave.drawdown(ends, picks).unwrap();
    for (row, line) in drawing.iter().enumerate() {
        let pick = picks - 1 - row;
        for (end, sign) in line.chars().enumerate() {
            assert_eq!(drawdown.up(end, pick), sign == '#', "{text}: end {end}, pick {pick}");
            assert_eq!(weave.up(end, pick), sign == '#', "{text}: end {end}, pick {pick}");
        }
    }
}

#[test]
fn plain() {
    draws("plain", (2, 2), &[".#.#.", "#.#.#", ".#.#.", "#.#.#"]);
    draws("1/1", (2, 2), &[".#.#.", "#.#.#", ".#.#.", "#.#.#"]);
    draws("1/1(1+1)", (2, 2), &[".#.#.", "#.#.#", ".#.#.", "#.#.#"]);
}

#[test]
fn twills() {
    draws("3/1", (4, 4), &["##.#", "#.##", ".###", "###."]);
    draws("2/2(1)", (4, 4), &["#..##..#", "..##..##", ".##..##.", "##..##.."]);
    draws("2/2(-1)", (4, 4), &[".##..##.", "..##..##", "#..##..#", "##..##.."]);
    draws("2/1*1/2", (6, 6), &["#.#..#", ".#..##", "#..##.", "..##.#", ".##.#.", "##.#.."]);
    // An elongated twill: every other pick of 4/3.
    draws(
        "4/3(2)",
        (7, 7),
        &["..####.", "####...", "##...##", "...####", ".####..", "###...#", "#...###", "..####.", "####..."],
    );
    draws("2/2(2)", (4, 2), &["..##", "##..", "..##", "##.."]);
}

#[test]
fn right_hand_twills_climb_to_the_right() {
    // In a Z twill each pick is the pick below it, moved one end to the right. In an S twill it is
    // moved one end to the left.
    let (z, s) = (Weave::parse("3/1").unwrap(), Weave::parse("3/1(-1)").unwrap());
    for pick in 0..8 {
        for end in 0..8 {
            assert_eq!(z.up(end, pick), z.up(end + 1, pick + 1));
            assert_eq!(s.up(end + 1, pick), s.up(end, pick + 1));
        }
    }
}

#[test]
fn satins() {
    draws("satin 5(2)", (5, 5), &["##.##", ".####", "###.#", "#.###", "####."]);
    draws("sateen 5(2)", (5, 5), &["...#.", ".#...", "....#", "..#..", "#...."]);
    draws(
        "sateen 8(3)",
        (8, 8),
        &[".....#..", "..#.....", ".......#", "....#...", ".#......", "......#.", "...#....", "#......."],
    );
    for (short, long) in [
        ("satin 5", "satin 5(2)"),
        ("satin 7", "satin 7(2)"),
        ("satin 8", "satin 8(3)"),
        ("satin 12", "satin 12(5)"),
        (" SATIN8 ( 3 ) ", "satin 8(3)"),
        ("satin 8(-3)", "satin 8(5)"),
    ] {
        assert_eq!(Weave::parse(short).unwrap(), Weave::parse(long).unwrap());
    }
    // A satin has one binding point on each end, and no two of them touch at a corner.
    for ends in [5, 7, 8, 9, 10, 11, 12, 13] {
        let sateen = Weave::parse(&format!("sateen {ends}")).unwrap();
        for end in 0..ends {
            let bound: Vec<_> = (0..ends).filter(|&pick| sateen.up(end, pick)).collect();
            assert_eq!(bound.len(), 1, "end {end} of {ends}");
            let beside = [(end + 1, bound[0] + 1), (end + ends - 1, bound[0] + 1)];
            assert!(beside.iter().all(|&(end, pick)| !sateen.up(end, pick)), "end {end} of {ends}");
        }
    }
}

#[test]
fn matts() {
    // The second drawing is the published picture of gridpattern's "3/2(4+2)".
    draws("2/2(2+2)", (4, 4), &["..##", "..##", "##..", "##.."]);
    draws("3/2(4+2)", (6, 5), &["....##", "....##", "####..", "####..", "####.."]);
    draws("2/2(1+1)", (2, 4), &[".#", ".#", "#.", "#."]);
}

#[test]
fn matts_by_name() {
    for (name, notation) in [
        ("matt 2", "2/2(2+2)"),
        ("basket 2", "2/2(2+2)"),
        ("hopsack 2/2", "2/2(2+2)"),
        ("Hopsack 3 / 2", "3/2(3+2)"),
        ("twill 2/2", "2/2"),
        ("twill 3/1(-1)", "3/1(-1)"),
    ] {
        assert_eq!(Weave::parse(name).unwrap(), Weave::parse(notation).unwrap(), "{name}");
    }
    draws("hopsack 3/2", (5, 5), &["...##", "...##", "###..", "###..", "###.."]);
}

#[test]
fn herringbones() {
    // Each weave is drawn from a threading. The picks lift the shafts 1 and 2, 2 and 3, 3 and 4, 4
    // and 1. This threading is 123412 432143.
    draws("herringbone 2/2(6)", (12, 4), &["#..##.#..##.", "..##..##..##", ".##..#.##..#", "##..##..##.."]);
    // The threading is 1234 2143.
    draws("herringbone 2/2(4)", (8, 4), &["#..#.##.", "..##..##", ".##.#..#", "##..##.."]);
    // The threading is 12 43, the broken twill of denim. The picks lift the shafts 123, 234, 341
    // and 412.
    draws("herringbone 3/1(2)", (4, 4), &["###.", "#.##", ".###", "##.#"]);
    // The threading is 123 132. Half of three ends is no whole number, so that the twill goes on
    // one end further after one cut and two ends further after the other. The picks lift the shafts
    // 12, 23 and 31.
    draws("herringbone 2/1(3)", (6, 3), &["#.###.", ".##.##", "##.#.#"]);
}

#[test]
fn pointed_twills() {
    // The first threading is 1234 32, and picks lift the shafts 12, 23, 34 and 41. The second is
    // 12341 432, and picks lift the shafts 1, 2, 3 and 4.
    draws("pointed 2/2(4)", (6, 4), &["#..#..", "..###.", ".##.##", "##...#"]);
    draws("pointed 1/3(5)", (8, 4), &["...#.#..", "..#...#.", ".#.....#", "#...#..."]);
}

#[test]
fn honeycomb() {
    draws(
        "honeycomb",
        (8, 8),
        &[".#.....#", "#.#...#.", "##.#.#.#", "###.#.##", "##.#.#.#", "#.#...#.", ".#.....#", "#......."],
    );
    // The longest floats are those of the description in the Britannica: five of warp and seven of
    // weft, around a hollow of plain weave.
    let weave = Weave::parse("honeycomb").unwrap();
    let longest = |up: bool, along_pick: bool| {
        let float = |thread: usize| {
            let same = |at: usize| up == if along_pick { weave.up(at, thread) } else { weave.up(thread, at) };
            (0..8).map(|from| (0..8).take_while(|&more| same(from + more)).count()).max().unwrap()
        };
        (0..8).map(float).max().unwrap()
    };
    assert_eq!((longest(true, false), longest(false, true)), (5, 7));
    assert_eq!((longest(true, true), longest(false, false)), (5, 7));
}

#[test]
fn crepe() {
    let weave = Weave::parse("crepe").unwrap();
    assert_eq!(weave.repeat(), (8, 8));
    // The ends are every third end of the twill. No end floats over more than two picks, and no
    // pick over more than three ends.
    let twill = Weave::parse("2/2*1/1*1/1").unwrap();
    for pick in 0..8 {
        for end in 0..8 {
            assert_eq!(weave.up(end, pick), twill.up(3 * end, pick), "end {end}, pick {pick}");
            assert!((0..3).any(|more| weave.up(end, pick + more) != weave.up(end, pick)));
            assert!((0..4).any(|more| weave.up(end + more, pick) != weave.up(end, pick)));
        }
    }
}

#[test]
fn every_thread_of_a_reversed_twill_changes_sides() {
    for base in ["2/2", "3/1", "1/3", "1/2", "3/2*1/2", "1/4"] {
        for (name, ways) in [("herringbone", 4..20), ("pointed", 8..20)] {
            for way in ways {
                let weave = Weave::parse(&format!("{name} {base}({way})")).unwrap();
                let (ends, picks) = weave.repeat();
                let changes = |line: Vec<bool>| line.contains(&true) && line.contains(&false);
                assert!((0..ends).all(|end| changes((0..picks).map(|pick| weave.up(end, pick)).collect())));
                assert!((0..picks).all(|pick| changes((0..ends).map(|end| weave.up(end, pick)).collect())));
            }
        }
    }
}

#[track_caller]
fn refuses(text: &str, position: usize, expected: &str) {
    match Weave::parse(text) {
        Err(WovenError::Notation { text: shown, position: at, expected: wanted }) => {
            assert_eq!((shown.as_str(), at, wanted), (text, position, expected));
        }
        other => panic!("{text}: {other:?}"),
    }
}

#[test]
fn what_is_no_notation_is_refused_where_it_goes_wrong() {
    let number = "a number from 1 to 4096";
    refuses("matt 2/0", 8, number);
    refuses("Velvet", 1, "a weave whose threads all lie in the cloth (pile is not made)");
    refuses(" leno 2", 2, "a weave whose ends do not cross one another (leno is not made)");
    refuses("matt 2/", 8, number);
    refuses("hopsack 2(2)", 10, "the end");
    refuses("herringbone 2/2(16", 19, "\")\"");
    refuses("herringbone 2/2(-16)", 17, number);
    refuses("herringbone 2/2(1)", 17, "a number of at least half the ends of the twill's repeat");
    refuses("pointed 2/2(3)", 13, "a number of at least the ends of the twill's repeat");
    refuses("honeycomb 8", 11, "the end");
    refuses("3", 2, "\"/\"");
    refuses("3/", 3, number);
    refuses("3/0", 3, number);
    refuses("0/3", 1, number);
    refuses("4097/1", 1, number);
    refuses("3/99999999999999999999", 3, number);
    refuses("3/1(", 5, number);
    refuses("3/1(1", 6, "\")\"");
    refuses("3/1(-1+2)", 7, "\")\"");
    refuses("3/1(2+)", 7, number);
    refuses("3/1 x", 5, "the end");
    refuses("3/1(1)*2/2", 7, "the end");
    refuses("plain weave", 7, "the end");
    refuses("satin 5 (2) é", 13, "the end");
    refuses("2/ü", 3, number);
}

/// Errors say in words what may follow a weave's name, with an example.
#[test]
fn a_name_without_what_follows_it_is_told_what_is_missing() {
    for (text, position, words, example) in [
        ("matt", 5, "threads", "matt 2"),
        (" Basket ", 9, "threads", "matt 2"),
        ("herringbone", 12, "reverses", "herringbone 2/2(8)"),
        ("herringbone 2/2", 16, "reverses", "herringbone 2/2(8)"),
        ("herringbone 2/2 8", 17, "reverses", "herringbone 2/2(8)"),
        ("herringbone 3/1*1/3", 20, "reverses", "herringbone 2/2(8)"),
        ("pointed", 8, "reverses", "pointed 2/2(8)"),
        ("point 1/3", 10, "reverses", "pointed 2/2(8)"),
        ("satin", 6, "ends", "satin 8"),
        ("sateen", 7, "ends", "satin 8"),
        ("twill", 6, "up and down", "twill 2/2"),
        ("twill S", 8, "up and down", "twill 2/2"),
        ("left-hand", 10, "up and down", "twill 2/2"),
    ] {
        let told = Weave::parse(text).unwrap_err().to_string();
        let place = format!("character {position}: expected ");
        for part in [&*place, words, example] {
            assert!(told.contains(part), "\"{told}\" lacks \"{part}\"");
        }
        Weave::parse(example).unwrap();
    }
}

#[test]
fn a_sign_that_looks_like_a_slash_is_named() {
    for (sign, name) in [
        ('\u{2044}', "a fraction slash (U+2044)"),
        ('\u{2215}', "a division slash (U+2215)"),
        ('\u{29f8}', "a big slash (U+29F8)"),
        ('\u{ff0f}', "a wide slash (U+FF0F)"),
    ] {
        for (text, position) in [
            (format!("2{sign}2"), 2),
            (format!("twill 3 {sign} 1(-1)"), 9),
            (format!("2/1*1{sign}2"), 6),
            (format!("hopsack 3{sign}2"), 10),
            (format!("herringbone 2{sign}2(8)"), 14),
            (format!("{sign}2"), 1),
        ] {
            let told = Weave::parse(&text).unwrap_err().to_string();
            let said = format!("character {position}: this is {name}, not a slash (/)");
            assert!(told.contains(&said), "{told}");
        }
    }
}

#[test]
fn what_can_not_be_woven_is_refused() {
    for (text, step) in
        [("satin 8(2)", 2), ("satin 8(1)", 1), ("sateen 8(7)", 7), ("satin 8(-1)", -1), ("satin 8(8)", 8)]
    {
        let error = Weave::parse(text).unwrap_err();
        let shown = text.to_owned();
        let position = text.find('(').unwrap() + 2;
        assert_eq!(error, WovenError::SatinMove { text: shown, position, step, ends: 8 });
    }
    for ends in [1, 2, 3, 4, 6] {
        let text = format!("satin {ends}");
        let error = Weave::parse(&text).unwrap_err();
        assert_eq!(error, WovenError::NoSatin { text, position: 7, ends });
    }
    // With a move of 2 the odd ends of 3/1 never go down. With a move of 4 no end ever changes
    // sides.
    for (text, step, end) in [("3/1(2)", 2, 1), ("3/1(4)", 4, 1), ("1/1*3/1(2)", 2, 1), ("2/2(-4)", -4, 1)] {
        let error = Weave::parse(text).unwrap_err();
        let position = text.find('(').unwrap() + 2;
        assert_eq!(error, WovenError::TwillMove { text: text.into(), position, step, end });
    }
}

#[test]
fn hostile_texts_neither_panic_nor_fill_memory() {
    let long = "1/1*".repeat(1_000_000);
    assert!(matches!(Weave::parse(&long), Err(WovenError::Repeat { ends: 4098, .. })));
    assert!(matches!(Weave::parse("4096/4096"), Err(WovenError::Repeat { .. })));
    assert!(matches!(Weave::parse("2/2(4096+4096)"), Err(WovenError::Repeat { ends: 8192, .. })));
    assert!(matches!(Weave::parse("matt 4096"), Err(WovenError::Repeat { ends: 8192, .. })));
    assert!(matches!(Weave::parse("herringbone 2/2(4096)"), Err(WovenError::Repeat { ends: 8192, .. })));
    assert!(matches!(Weave::parse("pointed 2/2(4096)"), Err(WovenError::Repeat { ends: 8190, .. })));
    let Err(WovenError::NoWeave { text, .. }) = Weave::parse(&"é".repeat(1_000_000)) else { panic!() };
    assert_eq!(text.chars().count(), 61);
}

#[test]
fn weaves_go_by_other_names() {
    for (name, other) in [
        ("plain", "Tabby"),
        ("honeycomb", "waffle"),
        ("hopsack 3/2", "panama 3/2"),
        ("pointed 2/2(8)", "point 2/2(8)"),
        ("crepe", "oatmeal"),
        ("2/2(-1)", "2/2 S"),
        ("2/2(-1)", "2/2S"),
        ("2/2(-1)", "twill 2/2 left"),
        ("3/1(-1)", "left-hand twill 3/1"),
        ("3/1(-1)", "S 3/1"),
        ("3/1*1/2(-2)", "twill left 3/1*1/2(2)"),
        ("3/1*1/2(-2)", "3/1*1/2(-2) s"),
        ("2/2", "2/2 z"),
        ("2/1", "Z twill 2/1"),
        ("1/3", "twill 1/3 right-hand"),
    ] {
        assert_eq!(Weave::parse(name), Weave::parse(other), "{other}");
        assert!(Weave::parse(other).is_ok(), "{other}");
    }
    refuses("2/2 S Z", 7, "the end");
    refuses("2/2(-1) Z", 9, "a left-hand twill: its move is negative");
}

#[test]
fn an_unknown_name_is_told_which_there_are() {
    for (text, near) in [
        ("satine 8", "satin"),
        ("herringbon 2/2(4)", "herringbone"),
        ("Honeycmb", "honeycomb"),
        ("twil 2/2", "twill"),
        ("wafle", "waffle"),
    ] {
        let told = Weave::parse(text).unwrap_err().to_string();
        assert!(told.contains(&format!("no weave has this name (did you mean {near}?)")), "{told}");
    }
    for text in ["huckaback", "tweed", "é/1", "mock leno 4", "", "½", "#4", "(2/2)"] {
        let told = Weave::parse(text).unwrap_err().to_string();
        assert!(told.contains("character 1: no weave has this name; there are"), "{told}");
        for name in [
            "plain",
            "tabby",
            "twill",
            "satin",
            "sateen",
            "matt",
            "hopsack",
            "basket",
            "herringbone",
            "pointed",
            "honeycomb",
            "waffle",
            "crepe",
        ] {
            assert!(told.contains(name), "{told} lacks {name}");
        }
    }
}

/// In an irregular satin each pick binds the end that the notation names. An error about a satin
/// without a move shows the irregular one. The notation has to name each end once.
#[test]
fn an_irregular_satin_is_drawn_by_its_binding_points() {
    for (ends, order) in [(6, "1 3 5 2 6 4"), (4, "1 2 4 3")] {
        let told = Weave::parse(&format!("satin {ends}")).unwrap_err().to_string();
        let drawn = format!("satin {ends}({order})");
        assert!(told.contains("no regular satin") && told.contains(&drawn), "{told}");
        let [satin, sateen] =
            ["satin", "sateen"].map(|name| Weave::parse(&format!("{name} {ends}({order})")).unwrap());
        for (pick, bound) in order.split(' ').map(|end| end.parse::<usize>().unwrap() - 1).enumerate() {
            for end in 0..ends {
                assert_eq!((satin.up(end, pick), sateen.up(end, pick)), (end != bound, end == bound));
            }
        }
        assert_eq!(satin.repeat(), (ends, ends));
    }
    assert_eq!(Weave::parse("sateen 5(1,3,5,2,4)"), Weave::parse("sateen 5(2)"));
    let order = "each end of the satin once, in the order in which picks bind them: satin 6(1 3 5 2 6 4)";
    refuses("satin 6(1 3 5 2 6)", 19, order);
    refuses("satin 6(1 3 5 2 6 3)", 19, order);
    refuses("satin 6(1 3 5 2 6 7)", 19, order);
    refuses("satin 6(1 3 5 2 6 4", 20, order);
    assert!(matches!(Weave::parse("satin 3"), Err(WovenError::NoSatin { .. })));
}

#[test]
fn a_dash_that_looks_like_a_hyphen_is_named() {
    for (sign, name) in [
        ('\u{2010}', "U+2010"),
        ('\u{2011}', "U+2011"),
        ('\u{2012}', "U+2012"),
        ('\u{2013}', "an en dash (U+2013)"),
        ('\u{2014}', "an em dash (U+2014)"),
        ('\u{2212}', "a minus sign (U+2212)"),
    ] {
        for (text, position) in [
            (format!("2/2({sign}1)"), 5),
            (format!("satin 8({sign}3)"), 9),
            (format!("left{sign}hand twill 2/2"), 5),
        ] {
            let told = Weave::parse(&text).unwrap_err().to_string();
            let place = format!("character {position}: this is ");
            assert!(
                told.contains(&place) && told.contains(name) && told.contains("not a hyphen (-)"),
                "{told}"
            );
        }
    }
}
