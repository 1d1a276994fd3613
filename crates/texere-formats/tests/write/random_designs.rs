//! Random woven designs, written and read again.

use proptest::prelude::*;
use texere_core::crossings::Set;
use texere_core::settling::Length;
use texere_core::{Material, Section};
use texere_fabric::{
    BySet, COTTON_LEAST_AREA, Crimp, Draft, Drawdown, Finish, Relief, Shape, Shedding, Stretch, Structure,
    Thread, Woven, WovenDesign, firmness_from_twist,
};
use texere_formats::Design;

use crate::designs::{check_toml, check_wif};

/// Names as designers give them, and names with characters that need care in lists and tables.
const NAMES: [&str; 12] = [
    "indigo",
    "red",
    "2 red",
    "3 2 red",
    "",
    "  ",
    " ecru",
    "a\"b\\c\n\u{7f}",
    "colour 3",
    "colour 1",
    "undyed",
    "Wolle, grün [é]",
];

/// Numbers from `least` to below `most`. They are drawn from the range that begins at 0, and
/// smaller ones become `least`. proptest 1.12 may fail an assertion of its own if the lower bound
/// has finer digits than the upper one.
fn numbers(least: f32, most: f32) -> impl Strategy<Value = f32> {
    (0.0..most).prop_map(move |number| number.max(least))
}

fn section() -> impl Strategy<Value = Section> {
    let corners = vec![[1.3_f32, 0.1], [0.0, 0.7], [-1.1, -0.2], [0.3, -0.9]];
    prop_oneof![
        4 => Just(Section::Circle),
        1 => numbers(0.06, 19.0).prop_map(|aspect| Section::Ellipse { aspect }),
        1 => (numbers(0.06, 19.0), -0.89_f32..0.89)
            .prop_map(|(aspect, distortion)| Section::Lenticular { aspect, distortion }),
        1 => (numbers(0.06, 19.0), numbers(0.11, 3.9)).prop_map(|(aspect, exponent)| Section::PowerEllipse { aspect, exponent }),
        1 => (2_u32..=12).prop_map(Section::plied),
        1 => (2_u32..=12, 0.5_f32..=1.0).prop_map(|(plies, valley)| Section::Lobed { plies, valley }),
        1 => Just(Section::Polygon(corners)),
    ]
}

fn material() -> impl Strategy<Value = Material> {
    let tex = prop_oneof![Just(None), numbers(0.002, 9e6).prop_map(Some), Just(Some(30.0))];
    let hairiness = prop_oneof![Just(0.0_f32), Just(5.0), 0.0_f32..30.0];
    let named = (prop::sample::select(&NAMES[..]), any::<[u8; 3]>(), tex, hairiness);
    prop_oneof![
        3 => named.prop_map(|(name, srgb, tex, hairiness)| {
            let bending = tex.filter(|_| hairiness == 0.0).map(|tex| 1e-4 * tex);
            Material { name: name.into(), srgb, tex, hairiness, bending }
        }),
        1 => Just(Material::default()),
    ]
}

/// Threads of one kind, with the number of them side by side.
fn run() -> impl Strategy<Value = (Thread, usize)> {
    let spacing = prop_oneof![0.002_f64..900.0, Just(0.5), Just(10.0 / 12.0), Just(25.4 / 72.0)];
    let one = || prop_oneof![Just(1.0_f32), numbers(0.11, 9.9)];
    let twist = prop_oneof![Just(0.0_f32), -600.0_f32..600.0, Just(500.0 * std::f32::consts::TAU / 1000.0)];
    let least_area = prop_oneof![Just(COTTON_LEAST_AREA), Just(0.0), Just(1.0), 0.0_f32..1.0];
    let firmness = prop_oneof![Just(None), numbers(0.01, 100.0).prop_map(Some)];
    let kinds = (0_u32..4, 0_u32..3, 1_usize..5);
    (spacing, numbers(0.0006, 400.0), one(), one(), (least_area, firmness, twist), kinds).prop_map(
        |(
            spacing_mm,
            radius_mm,
            flatness,
            stiffness,
            (least_area, firmness, twist),
            (material, section, times),
        )| {
            let firmness = firmness.unwrap_or_else(|| firmness_from_twist(twist, radius_mm));
            let sizes =
                Thread { flatness, stiffness, firmness, least_area, ..Thread::new(spacing_mm, radius_mm) };
            (Thread { material, section, twist, ..sizes }, times)
        },
    )
}

fn threads() -> impl Strategy<Value = Vec<Thread>> {
    let repeat = prop::collection::vec(run(), 1..4).prop_map(|runs| {
        runs.into_iter().flat_map(|(thread, times)| vec![thread; times]).collect::<Vec<_>>()
    });
    (repeat, 1_usize..40).prop_map(|(repeat, count)| repeat.into_iter().cycle().take(count).collect())
}

/// `count` lists of different numbers up to `most`.
fn lists(count: usize, most: u32) -> impl Strategy<Value = Vec<Vec<u32>>> {
    let numbers = (1..=most).collect::<Vec<_>>();
    prop::collection::vec(prop::sample::subsequence(numbers, 0..=most.min(3) as usize), count)
}

fn draft(ends: usize, picks: usize) -> impl Strategy<Value = Draft> {
    let shedding = prop_oneof![
        lists(picks, 5).prop_map(Shedding::LiftPlan),
        (lists(4, 5), lists(picks, 4)).prop_map(|(tie_up, treadling)| Shedding::TieUp { tie_up, treadling }),
    ];
    (lists(ends, 5), shedding, any::<bool>()).prop_map(|(threading, shedding, rising_shed)| Draft {
        threading,
        shedding,
        rising_shed,
    })
}

/// A random drawdown, a drawdown from a repeat, or one from a draft.
fn interlacing(ends: usize, picks: usize) -> impl Strategy<Value = (Drawdown, Option<Draft>)> {
    let bits = prop::collection::vec(any::<bool>(), ends * picks);
    let random = (bits, 1..=ends, 1..=picks).prop_map(move |(bits, width, height)| {
        let up = |end, pick| bits[pick * ends + end];
        (Drawdown::repeating(ends, picks, (width, height), up).unwrap(), None)
    });
    let drafted = draft(ends, picks).prop_map(|draft| (draft.drawdown().unwrap(), Some(draft)));
    prop_oneof![random, drafted]
}

fn finish() -> impl Strategy<Value = (Finish, Option<Stretch>)> {
    let times = || prop_oneof![3 => Just(1.0_f32), 1 => 0.0_f32..=10.0];
    let stretch = prop_oneof![
        Just(None),
        (prop_oneof![Just(Set::Warp), Just(Set::Weft)], 0.5_f64..=2.0)
            .prop_map(|(along, by)| Some(Stretch { along, by })),
    ];
    let length = prop_oneof![4 => Just(None), 1 => Just(Some(Length::Held))];
    let press = prop_oneof![4 => Just(None), 1 => Just(Some(0.3_f32))];
    (times(), times(), times(), length, press, stretch).prop_map(
        |(warp, weft, calender, length, press_mm, stretch)| {
            (Finish { taut: BySet { warp, weft }, calender, length, press_mm, ..Finish::default() }, stretch)
        },
    )
}

fn design() -> impl Strategy<Value = Design> {
    let crimp = prop_oneof![Just(Crimp::Stiffness), (0.0_f32..=1.0).prop_map(Crimp::WarpShare)];
    let laid = (any::<bool>(), crimp, any::<bool>(), 0_usize..3);
    let cloth = (threads(), threads()).prop_flat_map(|(warp, weft)| {
        let sizes = (warp.len(), weft.len());
        (Just(warp), Just(weft), interlacing(sizes.0, sizes.1))
    });
    let tables = (prop::collection::vec(material(), 4), prop::collection::vec(section(), 3));
    let named = (prop::sample::select(&NAMES[..]), any::<bool>(), finish());
    (cloth, tables, laid, named).prop_map(
        |(
            (warp, weft, (drawdown, draft)),
            (materials, sections),
            (points, crimp, selvedge, relief),
            named,
        )| {
            let mut cloth = Woven::new(drawdown, warp, weft, materials, sections).unwrap();
            cloth.set_shape(if points { Shape::Crossing } else { Shape::Round });
            cloth.set_crimp(crimp).unwrap();
            cloth.set_selvedge(selvedge);
            let relief = [Relief::Report, Relief::Flatten, Relief::Shrink][relief];
            let relieved = WovenDesign::new(cloth.clone(), draft.clone(), relief);
            // Some cloths can't be relieved.
            let woven = relieved.unwrap_or_else(|_| WovenDesign::new(cloth, draft, Relief::Report).unwrap());
            let (name, settle, (finish, stretch)) = named;
            let mut design = Design::of(name, Structure::Woven(woven));
            (design.settle, design.finish, design.stretch) = (settle, finish, stretch);
            design
        },
    )
}

/// Whether files can hold the design: relief may have made threads thinner than files allow.
fn is_held(design: &Design) -> bool {
    let cloth = design.structure.woven().unwrap().cloth();
    let thickness = |thread: &Thread| (1e-3..=1e3).contains(&(2.0 * f64::from(thread.radius_mm)));
    cloth.warp().iter().chain(cloth.weft()).all(thickness)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn as_a_design_file(design in design().prop_filter("thin threads", is_held)) {
        check_toml(&design);
    }

    #[test]
    fn as_a_wif_draft(design in design().prop_filter("thin threads", is_held)) {
        check_wif(&design);
    }
}
