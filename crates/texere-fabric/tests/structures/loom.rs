//! Cloth whose lifts are edited. Every changed yarn equals the same yarn of the whole cloth woven
//! anew, and no other yarn changes.

use proptest::prelude::*;
use texere_core::{Material, Section, Yarns};
use texere_fabric::{Drawdown, Loom, Shape, Thread, Woven};

/// A cloth of unevenly spaced threads, of two thicknesses and two materials.
fn cloth(raised: &[bool], [ends, picks]: [usize; 2], selvedge: bool, shape: Shape) -> Woven {
    let thread = |number: usize| Thread {
        spacing_mm: [0.9, 0.9, 2.5, 1.1][number % 4],
        material: (number / 5 % 2) as u32,
        ..Thread::new(1.0, [0.2, 0.25][number / 3 % 2])
    };
    let drawdown =
        Drawdown::from_fn(ends, picks, |end, pick| raised[(pick * ends + end) % raised.len()]).unwrap();
    let [warp, weft] = [ends, picks].map(|count| (0..count).map(thread).collect());
    let materials = vec![Material::default(); 2];
    let mut cloth = Woven::new(drawdown, warp, weft, materials, vec![Section::Circle]).unwrap();
    cloth.set_selvedge(selvedge);
    cloth.set_shape(shape);
    cloth
}

fn laid(loom: &Loom, yarns: &Yarns) -> bool {
    let mut points = Vec::new();
    (0..yarns.layout().yarns().len()).all(|yarn| {
        loom.lay(yarn, &mut points);
        yarns.yarn_points(yarn) == Some(&points[..])
    })
}

proptest! {
    #[test]
    fn yarns_are_those_of_the_cloth_woven_anew(
        raised in prop::collection::vec(any::<bool>(), 150),
        size in [2usize..16, 2usize..14],
        selvedge: bool,
        crossing: bool,
        edits in prop::collection::vec((0usize..14, 0usize..12, 1usize..4, 1usize..4, any::<u16>()), 1..8),
    ) {
        let shape = if crossing { Shape::Crossing } else { Shape::Round };
        let mut loom = Loom::new(cloth(&raised, size, selvedge, shape));
        let mut before = loom.cloth().yarns().unwrap();
        prop_assert!(laid(&loom, &before));
        for (end, pick, width, height, bits) in edits {
            let (ends, picks) = (end..end + width, pick..pick + height);
            let outside = ends.end > size[0] || picks.end > size[1];
            let changed = loom.set_lifts(ends, picks, |end, pick| bits >> ((end * 3 + pick) % 16) & 1 == 1);
            if outside {
                prop_assert!(changed.is_err());
                continue;
            }
            let changed = changed.unwrap();
            let after = loom.cloth().yarns().unwrap();
            prop_assert!(laid(&loom, &after));
            let differ: Vec<_> = (0..after.layout().yarns().len())
                .filter(|&yarn| before.yarn_points(yarn) != after.yarn_points(yarn))
                .collect();
            prop_assert!(differ.iter().all(|yarn| changed.contains(yarn)), "{:?} of {:?}", differ, changed);
            before = after;
        }
    }
}

/// A lift that is already set changes nothing. A lift that is taken back leaves the cloth
/// unchanged.
#[test]
fn a_lift_back_and_forth_changes_nothing() {
    let mut loom = Loom::new(cloth(&[true, false, false], [9, 7], false, Shape::Round));
    let (cloth, up) = (loom.cloth().clone(), loom.cloth().drawdown().up(4, 3));
    assert!(loom.set_lift(4, 3, up).unwrap().is_empty());
    assert_eq!(loom.set_lift(4, 3, !up).unwrap(), [4, 9 + 3]);
    assert_ne!(*loom.cloth(), cloth);
    assert_eq!(loom.set_lift(4, 3, up).unwrap(), [4, 9 + 3]);
    assert_eq!(loom.into_cloth(), cloth);
}

#[test]
fn a_crossing_outside_the_cloth_is_named() {
    let mut loom = Loom::new(cloth(&[true, false], [9, 7], false, Shape::Round));
    for (end, pick) in [(9, 0), (0, 7), (usize::MAX, 0)] {
        let said = loom.set_lift(end, pick, true).unwrap_err().to_string();
        assert!(said.contains("9") && said.contains("7"), "{said}");
    }
}
