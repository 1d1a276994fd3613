//! Warp knits: notation, named lappings, laps of guides, Jacquards, copies, run-ins and refusals.

use std::ops::ControlFlow;

use proptest::prelude::*;
use texere_core::settling::Length;
use texere_core::{Material, Origin, Section};
use texere_cpu::SerialBackend;
use texere_fabric::warp::{
    Bar, CHAIN_COURSES, Chain, Displacements, LAPPINGS, Lap, LapKind, NEEDLES_MOST, SPACE_MAX, Threading,
    WarpError, WarpKnitted,
};
use texere_fabric::weft::{Cells, Gauge, KnitYarn, WeftError};
use texere_fabric::{FabricError, Finish, Structure, ThreadError};

fn chain(text: &str) -> Chain {
    Chain::parse(text, 1).unwrap()
}

fn knit(bars: Vec<Bar>, size: [u32; 2], copies: [u32; 2]) -> Result<WarpKnitted, FabricError> {
    let (materials, sections) = (vec![Material::default()], vec![Section::Circle]);
    let yarns = vec![KnitYarn::new(0.05)];
    WarpKnitted::new(bars, Gauge::new(1.0, 0.75), size[0], size[1], yarns, materials, sections, copies)
}

/// For guide 0, course by course: the needle of the loop, whether the lap is open, and the underlap
/// after the lap.
fn laps(name: &str) -> Vec<(i32, bool, i32)> {
    let chain = Chain::named(name).unwrap();
    let lap = |course: usize| (chain.lap(course).needle(), chain.is_open(course), chain.underlap(course));
    (0..chain.courses()).map(lap).collect()
}

#[test]
fn lappings_are_what_their_names_say() {
    assert_eq!(laps("pillar"), [(0, true, 0), (0, true, 0)]);
    assert_eq!(laps("closed pillar"), [(0, false, -1), (0, false, -1)]);
    for (name, needles) in [("tricot", 1), ("cord", 2), ("satin", 3), ("velvet", 4)] {
        // The first loop lies on needle 0, the second one further on by the number of needles of
        // the lapping. The underlap of a closed lap goes back past its own needle.
        assert_eq!(laps(name), [(0, false, needles), (needles, false, -needles)], "{name}");
        let open = format!("open {name}");
        assert_eq!(laps(&open), [(0, true, needles), (needles, true, -needles)], "{open}");
    }
    assert_eq!(laps("atlas 2"), [(0, false, 1), (1, true, 0), (2, false, -1), (1, true, 0)]);
    assert!(laps("open atlas 5").iter().all(|lap| lap.1));
    assert!(laps("closed atlas 5").iter().all(|lap| !lap.1));
    let needles: Vec<_> = laps("closed atlas 3").iter().map(|lap| lap.0).collect();
    assert_eq!(needles, [0, 1, 2, 3, 2, 1]);
    let inlay = Chain::named("inlay 3").unwrap();
    assert!(inlay.laps().iter().all(|lap| lap.kind() == LapKind::Inlay) && inlay.underlap(0) == 3);
    assert!(LAPPINGS.iter().all(|name| Chain::named(name).is_some()));
    let none = [
        "",
        "open",
        "weft",
        "open inlay 2",
        "tricot 3",
        "atlas",
        "atlas 1",
        "atlas 999",
        "inlay -1",
        "open open cord",
    ];
    assert!(none.iter().all(|name| Chain::named(name).is_none()));
}

/// On 1-0/3-4 the loop of guide 2 lies on needle 2 and then on needle 5.
#[test]
fn guides_lap_where_the_notation_says() {
    let knit = knit(vec![Bar::new(chain("1-0/3-4//"))], [8, 2], [1, 1]).unwrap();
    let laps: Vec<_> = knit.laps().filter(|laid| laid.guide == 2).collect();
    assert_eq!(laps.iter().map(|laid| laid.lap.needle()).collect::<Vec<_>>(), [2, 5]);
    assert_eq!(laps.iter().map(|laid| laid.underlap).collect::<Vec<_>>(), [3, -3]);
    assert!(laps.iter().all(|laid| laid.kind() == LapKind::Overlap && !laid.is_open()));
    let two = Lap { from: 3, to: 1 };
    assert_eq!((two.kind(), two.needles().collect::<Vec<_>>()), (LapKind::TwoNeedle, vec![2, 1]));
}

#[test]
fn wrong_notation_is_refused_with_its_column() {
    for (text, step, column) in [
        ("", 1, 1),
        ("1", 1, 2),
        ("1-", 1, 3),
        ("1-0/", 1, 5),
        ("1-0///", 1, 6),
        ("1-0//1-2", 1, 6),
        ("1-0 1-2", 1, 5),
        ("1-0/1-4", 1, 7),
        ("0-0/600-600", 1, 5),
        ("99999999999999999999-0", 1, 1),
        ("-1-0", 1, 1),
        ("1-2/13D-0//", 1, 7),
        ("2-0/2-3", 2, 7),
        ("(1-0/1-2", 1, 9),
        ("(1-0/1-2)", 1, 10),
        ("(1-0/1-2)x0", 1, 11),
        ("((1-0)x2)x2", 1, 2),
        ("(1-0)x4097", 1, 7),
        ("(1-0)x4096/1-2", 1, 15),
        ("1-0", 3, 1),
        ("1-0/é-2", 1, 5),
    ] {
        let error = Chain::parse(text, step).unwrap_err();
        assert_eq!(error.column, column, "{text}: {error}");
    }
    for (dash, name) in [
        ('\u{2010}', "a typographic hyphen (U+2010)"),
        ('\u{2013}', "an en dash (U+2013)"),
        ('\u{2212}', "a minus sign (U+2212)"),
    ] {
        let error = Chain::parse(&format!("1-0/1{dash}2//"), 1).unwrap_err().to_string();
        let said = format!("chain, column 6: found \"{dash}\", {name}, not a hyphen, expected \"-\"");
        assert_eq!(error, said);
    }
    for (slash, name) in
        [('\u{2044}', "a fraction slash (U+2044)"), ('\u{2215}', "a division slash (U+2215)")]
    {
        let error = Chain::parse(&format!("1-0{slash}1-2//"), 1).unwrap_err().to_string();
        assert!(error.contains(&format!("column 4: found \"{slash}\", {name}, not a slash")), "{error}");
    }
    assert_eq!(
        Chain::parse("1-2/13D-0//", 1).unwrap_err().to_string(),
        "chain, column 7: found \"D\", expected \"-\""
    );
    assert_eq!(chain("(1-0/1-2)x2048//").courses(), CHAIN_COURSES);
}

/// Displaced laps of a Jacquard bar with the chain 1-0/1-2. The colours displace no lap, the
/// second, the first, and both.
#[test]
fn jacquards_displace_single_guides() {
    let palette =
        vec![vec![[0, 0], [0, 0]], vec![[0, 0], [1, 1]], vec![[1, 1], [0, 0]], vec![[1, 1], [1, 1]]];
    let colour = |guide: u32, round: u32| ((guide + 2 * round) % 4) as u8;
    let jacquard = Displacements::new([4, 2], palette.clone(), colour);
    let knit = knit(vec![Bar { jacquard, ..Bar::new(chain("1-0/1-2")) }], [8, 4], [1, 1]).unwrap();
    let laps = |guide| {
        let own = knit.laps().filter(move |laid| laid.guide == guide);
        own.map(|laid| [laid.lap.from, laid.lap.to].map(|space| space - guide as i32)).collect::<Vec<_>>()
    };
    let [thin, thick, mesh, both] = [[[1, 0], [1, 2]], [[1, 0], [2, 3]], [[2, 1], [1, 2]], [[2, 1], [2, 3]]];
    assert_eq!(laps(0), [thin, mesh].concat());
    assert_eq!(laps(1), [thick, both].concat());
    assert_eq!(laps(7), [both, thick].concat());
    assert_eq!(knit.repeat().unwrap().copies, [2, 1]);
    assert!(Displacements::new([4, 0], palette.clone(), |_, _| 0).is_none());
    assert!(Displacements::new([1 << 16, 1 << 16], palette.clone(), |_, _| 0).is_none());
    assert!(Displacements::new([4, 1], palette, |_, _| 4).is_none());
    assert!(Displacements::new([4, 1], vec![vec![[0, 2]]], |_, _| 0).is_none());
    assert!(Displacements::new([4, 1], vec![vec![]], |_, _| 0).is_none());
    assert!(Displacements::new([4, 1], vec![vec![[0, 1]], vec![]], |_, _| 0).is_none());
}

/// Origins and sources count guides and courses of the whole cloth. A yarn of the last copy equals
/// that of the first one, moved to its place.
#[test]
fn copies_have_names_of_their_own() {
    let threaded = Threading::of(vec![Some(0), None]);
    let bars = vec![Bar { threading: threaded, ..Bar::new(chain("1-0/1-2")) }, Bar::new(chain("1-2/1-0"))];
    let cloth = knit(bars, [2, 2], [6, 4]).unwrap();
    assert_eq!((cloth.size(), cloth.loops()), ([12, 8], 6 * 8 + 12 * 8));
    let yarns = cloth.yarns().unwrap();
    let mut origins: Vec<_> = yarns
        .layout()
        .yarns()
        .iter()
        .map(|yarn| match yarn.origin {
            Origin::Guide { bar, guide } => (bar, guide),
            other => panic!("{other}"),
        })
        .collect();
    origins.sort_unstable();
    let expected = (1..=12).step_by(2).map(|guide| (1, guide)).chain((1..=12).map(|guide| (2, guide)));
    assert_eq!(origins, expected.collect::<Vec<_>>());
    let sources = yarns.sources().unwrap();
    assert!((0..yarns.layout().yarns().len()).all(|yarn| {
        let own = &sources[yarns.range(yarn).unwrap()];
        own.is_sorted() && own.first() == Some(&1) && own.last() == Some(&8)
    }));
    // Guide 12 lies ten wales to the right of guide 2.
    let points = |guide| {
        let own = Origin::Guide { bar: 2, guide };
        let yarn = yarns.layout().yarns().iter().position(|yarn| yarn.origin == own).unwrap();
        yarns.yarn_points(yarn).unwrap()
    };
    let moved = points(2).iter().zip(points(12)).all(|(one, other)| (other.x - one.x - 10.0).abs() < 1e-5);
    assert!(moved && points(2).len() == points(12).len());
}

/// With [`Cells::Even`] a yarn has 9 control points for each course. The facets are then as many as
/// in figure 7c of the paper that texere implements (README.md).
#[test]
fn even_cells_are_nine_points_a_course() {
    let bars = vec![Bar::new(chain("1-0/1-2")), Bar::new(chain("1-2/1-0"))];
    let cloth = knit(bars, [4, 4], [1, 175]).unwrap().with_cells(Cells::Even);
    let yarns = cloth.yarns().unwrap();
    assert!(yarns.layout().offsets().windows(2).all(|bounds| bounds[1] - bounds[0] == 9 * 700));
    // With six sides and one ring between two control points, an interval has 24 facets.
    let facets = 2520.0 * 24.0 * (9.0 * 700.0 - 1.0);
    assert!((facets / 381.71e6_f64 - 1.0).abs() < 0.01);
}

#[test]
fn run_ins_are_asked_for_and_measured() {
    let bar = |text, run_in_mm| Bar { run_in_mm, ..Bar::new(chain(text)) };
    let held = knit(vec![bar("1-0/2-3", None), bar("1-2/1-0", None)], [4, 4], [1, 3]).unwrap();
    let repeat = held.repeat().unwrap();
    assert_eq!(held.finish_of(&repeat, &Finish::default()).length, Some(Length::Held));
    let found = held.run_ins(&held.yarns().unwrap());
    // The longer underlaps of the front bar take more yarn. Both bars together have the length of
    // the repeat.
    assert!(found[0].reached_mm > found[1].reached_mm && found[0].miss().is_none());
    let whole = (found[0].reached_mm + found[1].reached_mm) * 4.0 * 4.0 / 480.0;
    assert!((whole / repeat.piece.length_mm() - 1.0).abs() < 1e-5, "{whole}");
    let asked = |shares: [f64; 2]| {
        let [front, back] = [0, 1].map(|bar: usize| Some(shares[bar] * found[bar].reached_mm));
        knit(vec![bar("1-0/2-3", front), bar("1-2/1-0", back)], [4, 4], [1, 3]).unwrap()
    };
    // Loops become higher or lower, so that each bar has the run-in that it asks for.
    let higher = asked([1.02, 0.98]);
    let made = higher.run_ins(&higher.yarns().unwrap());
    assert!(made.iter().all(|run_in| run_in.miss().unwrap().abs() < 1e-3), "{made:?}");
    let repeat = higher.repeat().unwrap();
    assert_eq!(higher.finish_of(&repeat, &Finish::default()).length, Some(Length::Held));
    // The bars still have their run-ins at rest.
    let settled =
        higher.settle(&Finish::default(), 0.0, &SerialBackend::new(), |_| ControlFlow::Continue(()));
    let rested = higher.run_ins(&settled.unwrap().yarns);
    assert!(rested.iter().all(|run_in| run_in.miss().unwrap().abs() < 0.02), "{rested:?}");
    // If a run-in is beyond what heights can give, all yarns get the length that is missing.
    let longer = asked([1.2, 1.2]);
    let repeat = longer.repeat().unwrap();
    let Some(Length::Given(factor)) = longer.finish_of(&repeat, &Finish::default()).length else {
        panic!("no length")
    };
    let given = f64::from(factor) * repeat.piece.length_mm() * 480.0 / 16.0;
    let total: f64 = found.iter().map(|run_in| 1.2 * run_in.reached_mm).sum();
    assert!((given / total - 1.0).abs() < 1e-4, "{given} of {total}");
    let made = longer.run_ins(&longer.yarns().unwrap());
    assert!(made.iter().all(|run_in| run_in.miss().unwrap() < -0.05), "{made:?}");
}

#[test]
fn what_is_no_cloth_is_refused() {
    let bar = || Bar::new(chain("1-0/1-2"));
    let refused = |bars: Vec<Bar>, size, copies| knit(bars, size, copies).unwrap_err();
    let four = [4, 4];
    let one = [1, 1];
    assert!(matches!(refused(vec![], four, one), FabricError::Warp(WarpError::Bars { .. })));
    assert!(matches!(refused(vec![bar(); 65], four, one), FabricError::Warp(WarpError::Bars { .. })));
    let other = Bar { threading: Threading::full(u32::MAX), ..bar() };
    assert!(matches!(
        refused(vec![other], four, one),
        FabricError::Warp(WarpError::GuideYarn { bar: 1, .. })
    ));
    let empty = Bar { threading: Threading::of(vec![]), ..bar() };
    assert_eq!(refused(vec![empty], four, one), FabricError::Warp(WarpError::NoLoops));
    let inlay = Bar::new(chain("0-0/1-1"));
    assert_eq!(refused(vec![inlay], four, one), FabricError::Warp(WarpError::NoLoops));
    for offset in [i32::MIN, i32::MAX] {
        let far = Bar { offset, ..bar() };
        assert!(matches!(
            refused(vec![bar(), far], four, one),
            FabricError::Warp(WarpError::BarOffset { bar: 2, .. })
        ));
    }
    for mm in [f64::NAN, f64::INFINITY, 0.0, -1.0] {
        let run_in = Bar { run_in_mm: Some(mm), ..bar() };
        assert!(matches!(
            refused(vec![run_in], four, one),
            FabricError::Warp(WarpError::RunIn { bar: 1, .. })
        ));
    }
    let jacquard = Displacements::new([1, 1], vec![vec![[0, 0]]], |_, _| 0);
    let other = Bar { jacquard, ..bar() };
    let courses = FabricError::Warp(WarpError::JacquardCourses { bar: 1, courses: 1, chain: 2 });
    assert_eq!(refused(vec![other], four, one), courses);
    // A displaced lap must not go round three needles: 2-0 displaced by 1-0 would be 3-0.
    let wide = Displacements::new([1, 1], vec![vec![[1, 0], [0, 0]]], |_, _| 0);
    let wide = Bar { jacquard: wide, ..Bar::new(chain("2-0/1-2//")) };
    let lap = FabricError::Warp(WarpError::JacquardLap {
        bar: 2,
        course: 1,
        lap: Lap { from: 3, to: 0 },
        limit: 2,
    });
    assert_eq!(refused(vec![bar(), wide], four, one), lap);
    // Displaced by 0-1, the lap 2-0 becomes 2-1 and goes round one needle.
    let narrow = Displacements::new([1, 1], vec![vec![[0, 1], [0, 0]]], |_, _| 0);
    let narrow = Bar { jacquard: narrow, ..Bar::new(chain("2-0/1-2//")) };
    knit(vec![narrow], four, one).unwrap().yarns().unwrap();
    let odd = FabricError::Warp(WarpError::WarpRepeat { what: "course", size: 3, multiple: 2 });
    assert_eq!(refused(vec![bar()], [4, 3], one), odd);
    assert!(matches!(refused(vec![bar()], [0, 2], one), FabricError::Warp(WarpError::WarpRepeat { .. })));
    for copies in [[0, 1], [u32::MAX, u32::MAX], [u32::MAX, 1]] {
        knit(vec![bar()], four, copies).unwrap_err();
    }
    knit(vec![bar()], [u32::MAX, 2], one).unwrap_err();
    knit(vec![bar()], [1 << 20, 1 << 20], one).unwrap_err();
    let gauge = Gauge::new(f64::NAN, 1.0);
    let parts = (vec![KnitYarn::new(0.05)], vec![Material::default()], vec![Section::Circle]);
    let made = WarpKnitted::new(vec![bar()], gauge, 4, 2, parts.0, parts.1, parts.2, one);
    assert!(matches!(made.unwrap_err(), FabricError::Weft(WeftError::Gauge { .. })));
    // Yarn 2 has no thickness. The first guide that holds it is guide 2 of the back bar.
    let threading = Threading::of(vec![Some(0), Some(1)]);
    let parts =
        (vec![KnitYarn::new(0.05), KnitYarn::new(0.0)], vec![Material::default()], vec![Section::Circle]);
    let bars = vec![bar(), Bar { threading, ..bar() }];
    let made = WarpKnitted::new(bars, Gauge::new(1.0, 1.0), 4, 2, parts.0, parts.1, parts.2, one);
    let guide = Origin::Guide { bar: 2, guide: 2 };
    assert!(
        matches!(made.unwrap_err(), FabricError::Thread(ThreadError::Radius { thread, .. }) if thread == guide)
    );
}

#[test]
fn structures_know_warp_knits() {
    let structure = Structure::Warp(knit(vec![Bar::new(chain("1-0/1-2"))], [4, 2], [2, 2]).unwrap());
    assert!(structure.warp_knitted().is_some());
    assert!(structure.knitted().is_none() && structure.woven().is_none());
    assert_eq!(structure.size_mm(), [8.0, 3.0]);
    let measures = structure.measures(&structure.yarns().unwrap()).unwrap();
    assert_eq!(measures.knit.unwrap().loops, 32);
}

fn any_chain() -> impl Strategy<Value = Chain> {
    let lap = (0..=SPACE_MAX, -NEEDLES_MOST..=NEEDLES_MOST)
        .prop_map(|(from, overlap)| Lap { from, to: (from + overlap).clamp(0, SPACE_MAX) });
    proptest::collection::vec(lap, 1..40).prop_map(|laps| Chain::new(laps).unwrap())
}

proptest! {
    #[test]
    fn chains_are_read_as_they_are_written(chain in any_chain()) {
        prop_assert_eq!(Chain::parse(&chain.to_string(), 1).unwrap(), chain);
    }

    /// A guide always comes back to its first space.
    #[test]
    fn guides_come_back(chain in any_chain()) {
        let ways = (0..chain.courses()).map(|course| chain.lap(course).overlap() + chain.underlap(course));
        prop_assert_eq!(ways.sum::<i32>(), 0);
    }

    #[test]
    fn any_text_is_read_or_refused(text in "[0-9x()/ -]{0,24}|\\PC{0,12}", step in 0_u32..4) {
        match Chain::parse(&text, step) {
            Ok(chain) => prop_assert_eq!(Chain::parse(&chain.to_string(), 1).unwrap(), chain),
            Err(error) => prop_assert!((1..=text.chars().count() + 1).contains(&error.column)),
        }
    }

    #[test]
    fn any_chain_has_yarns(chain in any_chain(), offset in -300..300_i32) {
        let courses = chain.courses() as u32;
        let bars = vec![Bar::new(pillar()), Bar { offset, ..Bar::new(chain) }];
        let cloth = knit(bars, [2, courses * 2], [2, 1]).unwrap();
        let yarns = cloth.yarns().unwrap();
        prop_assert!(yarns.points().iter().all(|point| point.position().is_finite()));
    }
}

fn pillar() -> Chain {
    Chain::named("pillar").unwrap()
}

/// A guide with a number far beyond the cloth laps at that number. Spaces beyond the range of an
/// `i32` are clamped to it.
#[test]
fn a_guide_of_any_number_laps_to_the_high_numbers() {
    let bar = |offset| Bar { offset, ..Bar::new(Chain::parse("1-0/1-2//", 1).unwrap()) };
    let lap = |offset, guide| bar(offset).lap(guide, 1);
    assert_eq!(lap(0, 2_000_000_000), Lap { from: 2_000_000_001, to: 2_000_000_002 });
    for guide in [1 << 31, u32::MAX - 1, u32::MAX] {
        assert_eq!(lap(0, guide), Lap { from: i32::MAX, to: i32::MAX });
    }
    assert_eq!(lap(i32::MAX, 3), Lap { from: i32::MAX, to: i32::MAX });
    assert_eq!(lap(i32::MIN, 1 << 31), Lap { from: 1, to: 2 });
}
