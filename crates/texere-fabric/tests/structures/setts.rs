//! The greatest sett against worked examples from textbooks.

use texere_core::{Material, Section};
use texere_fabric::{BySet, Drawdown, Thread, Woven};

/// A twill. `floats` are the lengths of a pick's floats, in ends, with the warp up and down in
/// turn. The floats of each pick lie one end further right than those of the pick before.
fn cloth(floats: &[usize], per_inch: f64, diameters_per_inch: f64) -> Woven {
    let thread = Thread::new(25.4 / per_inch, (0.5 * 25.4 / diameters_per_inch) as f32);
    let repeat: Vec<bool> =
        floats.iter().enumerate().flat_map(|(number, &float)| vec![number % 2 == 0; float]).collect();
    let up = |end: usize, pick: usize| repeat[(end + 40 - pick) % repeat.len()];
    let drawdown = Drawdown::from_fn(40, 40, up).unwrap();
    let (materials, sections) = (vec![Material::default()], vec![Section::Circle]);
    Woven::new(drawdown, vec![thread; 40], vec![thread; 40], materials, sections).unwrap()
}

fn greatest_per_inch(cloth: &Woven) -> f64 {
    2.54 * cloth.setts().warp.greatest_per_cm
}

/// "Ashenhurst's formula", <http://www.faena.medievaltextiles.org/ash.html>: 8/2 cotton has 52
/// diameters to the inch, 26 ends in plain weave and 34 in 2/2 twill.
#[test]
fn ashenhursts_example_of_two_ply_cotton() {
    assert!((greatest_per_inch(&cloth(&[1, 1], 20.0, 52.0)) - 26.0).abs() < 1e-3);
    let twill = greatest_per_inch(&cloth(&[2, 2], 20.0, 52.0));
    assert!((twill - 52.0 * 4.0 / 6.0).abs() < 1e-3 && (34.0..35.0).contains(&twill), "{twill}");
}

/// J. T. Taylor, "Cotton weaving and designing", 6th edition, "The firmness of cloth": a plain
/// cloth of 103 threads is as firm as a 2/2 twill of 137 1/3 threads. The numbers of threads at
/// which a 2/2 twill and a twill of 5 up, 2 down, 1 up, 2 down are equally firm are as 40 + 16 to
/// 40 + 20.
#[test]
fn taylors_examples_of_cloths_as_firm() {
    let plain = greatest_per_inch(&cloth(&[1, 1], 20.0, 206.0));
    let twill = greatest_per_inch(&cloth(&[2, 2], 20.0, 206.0));
    let long = greatest_per_inch(&cloth(&[5, 2, 1, 2], 20.0, 206.0));
    assert!((plain - 103.0).abs() < 1e-2 && (twill - 137.0 - 1.0 / 3.0).abs() < 1e-2, "{plain}, {twill}");
    assert!((long / twill - 60.0 / 56.0).abs() < 1e-5, "{long}");
}

fn square(weave: fn(usize, usize) -> bool, warp: Thread, weft: Thread) -> [Option<f64>; 2] {
    let drawdown = Drawdown::from_fn(8, 8, weave).unwrap();
    let (materials, sections) = (vec![Material::default()], vec![Section::Circle]);
    let cloth = Woven::new(drawdown, vec![warp; 8], vec![weft; 8], materials, sections).unwrap();
    cloth.setts().map(|sett| sett.jammed_per_cm).into_array()
}

fn plain(end: usize, pick: usize) -> bool {
    (end + pick).is_multiple_of(2)
}

/// "Fabric geometry", "Square cloth - jammed structure",
/// <http://business.vsnl.com/balasubramanian/YarnCloth.html>: in a jammed square cloth θ = 60° and
/// p/D = 0.866, where θ is the greatest angle between a thread and the cloth's plane, p is the
/// distance from thread to thread, and D is the sum of both diameters.
#[test]
fn peirces_square_cloth_jams_where_the_textbook_has_it() {
    let thread = Thread::new(0.866 * 0.4, 0.1);
    for jammed in square(plain, thread, thread) {
        assert!((10.0 / jammed.unwrap() / 0.4 - 0.866).abs() < 1e-4, "{jammed:?}");
    }
    // A jammed sett is given for plain weave alone.
    assert_eq!(square(|end, pick| (end + 8 - pick) % 4 < 2, thread, thread), [None; 2]);
}

/// If both sets jam, cos θ₁ + cos θ₂ = 1, where θ₁ and θ₂ are the greatest angles of warp and weft
/// to the cloth's plane (Peirce). The test tries threads of unequal thickness, first round and then
/// flat.
#[test]
fn each_set_jams_by_the_other_ones_sett() {
    for flatness in [1.0_f32, 1.6] {
        for degrees in [40.0_f64, 60.0, 75.0] {
            let angles = [degrees.to_radians(), (1.0 - degrees.to_radians().cos()).acos()];
            let radii = [0.12, 0.09];
            let halves = radii.map(|radius: f64| {
                [radius * f64::from(flatness).sqrt(), radius / f64::from(flatness).sqrt()]
            });
            let both = 2.0 * (halves[0][1] + halves[1][1]);
            // The pitch of a jammed set of round threads is D sin θ, with θ of the other set. Flat
            // threads need the difference of their width and height in addition.
            let pitches =
                [0, 1].map(|set: usize| both * angles[set].sin() + 2.0 * (halves[set][0] - halves[set][1]));
            let threads =
                [0, 1].map(|set: usize| Thread { flatness, ..Thread::new(pitches[set], radii[set] as f32) });
            for (set, jammed) in square(plain, threads[0], threads[1]).into_iter().enumerate() {
                assert!((10.0 / jammed.unwrap() / pitches[set] - 1.0).abs() < 1e-5, "{degrees} {flatness}");
            }
        }
    }
    // If picks are far apart, ends may lie side by side.
    let [ends, _] = square(plain, Thread::new(0.3, 0.1), Thread::new(2.0, 0.1));
    assert!((ends.unwrap() - 50.0).abs() < 1e-3, "{ends:?}");
}

#[test]
fn threads_of_other_sets_take_their_own_room() {
    let (thin, thick) = (Thread::new(0.5, 0.05), Thread::new(0.5, 0.1));
    let plain = Drawdown::from_fn(6, 6, |end, pick| (end + pick) % 2 == 0).unwrap();
    let cloth =
        Woven::new(plain, vec![thin; 6], vec![thick; 6], vec![Material::default()], vec![Section::Circle])
            .unwrap();
    let BySet { warp: ends, weft: picks } = cloth.setts();
    // A pick of 0.2 mm passes between any two ends of 0.1 mm.
    assert!(
        (ends.greatest_per_cm - 10.0 / 0.3).abs() < 1e-4 && (picks.greatest_per_cm - 10.0 / 0.3).abs() < 1e-4
    );
    assert!((ends.share() - 20.0 / (10.0 / 0.3)).abs() < 1e-4);
    // Doubled ends change sides together.
    let ribs = Drawdown::from_fn(6, 6, |end, pick| (end / 2 + pick) % 2 == 0).unwrap();
    let doubled = vec![thin; 6];
    let cloth =
        Woven::new(ribs, doubled, vec![thick; 6], vec![Material::default()], vec![Section::Circle]).unwrap();
    // The repeat has four ends. Picks change sides at two of its four steps from end to end.
    let BySet { warp: ends, weft: picks } = cloth.setts();
    assert!((ends.interlacings - 0.5).abs() < 1e-9 && (picks.interlacings - 1.0).abs() < 1e-9, "{ends:?}");
}

/// Each layer of a double cloth has the sett of a single cloth, whether the layers change places or
/// not.
#[test]
fn double_cloth_has_room_for_twice_as_many_threads() {
    let greatest = |figure: usize| {
        let up = |end: usize, pick: usize| {
            let turned = !(end / figure + pick / figure).is_multiple_of(2);
            let [face_end, face_pick] = [end, pick].map(|thread| thread.is_multiple_of(2) != turned);
            if face_end == face_pick { (end / 2 + pick / 2).is_multiple_of(2) } else { face_end }
        };
        let thread = Thread::new(0.5, 0.1);
        let (materials, sections) = (vec![Material::default()], vec![Section::Circle]);
        let drawdown = Drawdown::from_fn(96, 96, up).unwrap();
        let cloth = Woven::new(drawdown, vec![thread; 96], vec![thread; 96], materials, sections).unwrap();
        cloth.setts().warp.greatest_per_cm
    };
    // A plain layer of threads of 0.2 mm has 25 to the cm.
    assert!((greatest(96) - 50.0).abs() < 1e-3, "{}", greatest(96));
    assert!((greatest(24) - 50.0).abs() < 2.5, "{}", greatest(24));
}
