//! The names of hits, in the words of weavers and knitters.

use texere_conformance::cases;
use texere_core::{Origin, Ray, Settings, YarnPlace};
use texere_fabric::{BySet, Crossing, StitchPlace, ThreadPlace};
use texere_formats::Design;

use super::judge::{mesh_of, picker_of};

/// The thread and the name of what a ray from above hits first at each of `points`, mm. None if it
/// hits nothing.
fn named(design: &Design, points: &[[f64; 2]]) -> Vec<Option<(ThreadPlace, String)>> {
    let yarns = design.yarns().unwrap();
    let picker = picker_of(&mesh_of(&yarns, Settings::default()), &yarns);
    let name = |[x, y]: &[f64; 2]| {
        let hit = picker.pick(&Ray { origin: [*x, *y, 50.0], direction: [0.0, 0.0, -1.0] })?;
        let place = YarnPlace::at(&yarns, hit.place.yarn as usize, hit.interval as usize, hit.t).unwrap();
        Some((design.structure.place(&yarns, &place), design.named(&yarns, &place).to_string()))
    };
    points.iter().map(name).collect()
}

#[test]
fn crossings_of_a_weave_are_named_by_the_thread_on_top() {
    let design = cases::design("plain.toml");
    let cloth = design.structure.woven().unwrap().cloth();
    let BySet { warp: ends, weft: picks } = cloth.middles_mm();
    let all: Vec<_> = (0..ends.len()).flat_map(|end| (0..picks.len()).map(move |pick| (end, pick))).collect();
    let points: Vec<_> = all.iter().map(|&(end, pick)| [ends[end], picks[pick]]).collect();
    for ((end, pick), found) in all.into_iter().zip(named(&design, &points)) {
        let (place, said) = found.unwrap();
        let up = cloth.drawdown().up(end, pick);
        let (end, pick) = (end as u32 + 1, pick as u32 + 1);
        assert_eq!(place.crossing, Some(Crossing { end, pick }));
        assert_eq!(place.thread, if up { Origin::End(end) } else { Origin::Pick(pick) });
        let thread =
            if up { format!("end {end} at pick {pick}") } else { format!("pick {pick} at end {end}") };
        assert!(said == thread || said.starts_with(&format!("{thread}, ")), "{said}");
    }
}

/// Each yarn of these knits is one course, and goes through its wales in order. The courses of a
/// repeat lie above those of the repeat below.
#[test]
fn stitches_are_where_their_yarns_go() {
    // Reach of a stitch from the middle of its wale, in wales. It is larger where loops are
    // transferred.
    for (name, reach) in
        [("jersey", 0.6), ("garter", 0.8), ("rib", 1.2), ("tuck", 1.2), ("miss", 1.2), ("lace", 2.5)]
    {
        let name = &format!("{name}.toml");
        let design = cases::design(name);
        let knit = design.structure.knitted().unwrap();
        let repeat = knit.repeat().unwrap();
        let (yarns, [wales, courses]) = (design.yarns().unwrap(), knit.size());
        let (own, of_repeat) = (repeat.piece.yarns.layout().yarns(), courses / repeat.copies[1]);
        let (mut told, mut places) = (0, 0);
        for (yarn, what) in yarns.layout().yarns().iter().enumerate() {
            let Origin::Course(in_repeat) = what.origin else { panic!("{name}: {what:?}") };
            let below = (yarn / own.len()) as u32 * of_repeat;
            for interval in 0..yarns.yarn_points(yarn).unwrap().len() - 1 {
                let place = YarnPlace::at(&yarns, yarn, interval, 0.5).unwrap();
                places += 1;
                let Some(StitchPlace { wale, course }) = design.structure.place(&yarns, &place).stitch else {
                    continue;
                };
                told += 1;
                assert_eq!(course, in_repeat + below, "{name}: {place:?}");
                // Yarns are cut beyond the edges of the cloth. There the nearest stitch of the
                // cloth may be a repeat away.
                let at = place.position[0] / knit.gauge().wale_mm;
                let (off, inside) =
                    (at - (f64::from(wale) - 0.5), (1.0..f64::from(wales) - 1.0).contains(&at));
                assert!(off.abs() < reach || !inside, "{name}: {place:?} in wale {wale}");
            }
        }
        assert!(told > places / 2, "{name}: {told} stitches of {places} places");
    }
}

/// A stitch that a ray from above hits is named by wale and course and by the chart's cell. In a
/// warp knit it is named by its guide and its wale.
#[test]
fn stitches_are_told_with_what_made_them() {
    let design = cases::design("rib.toml");
    let knit = design.structure.knitted().unwrap();
    let (wale_mm, course_mm) = (knit.gauge().wale_mm, knit.gauge().course_mm);
    let grid =
        |x: f64, y: f64| (0..40).map(move |k| [x + 0.05 * f64::from(k % 8), y + 0.05 * f64::from(k / 8)]);
    let points: Vec<_> = grid(4.0 * wale_mm, 6.0 * course_mm).collect();
    let hits: Vec<_> = named(&design, &points).into_iter().flatten().collect();
    assert!(!hits.is_empty());
    for (place, said) in hits {
        let stitch = place.stitch.unwrap();
        assert!((3..=7).contains(&stitch.wale) && (4..=9).contains(&stitch.course), "{said}");
        assert!(said.contains("rib.toml, row ") && said.contains("knit "), "{said}");
        assert!(said.starts_with(&format!("wale {}, course {}, ", stitch.wale, stitch.course)), "{said}");
    }
    let design = cases::design("locknit.toml");
    let hits: Vec<_> = named(&design, &points).into_iter().flatten().collect();
    assert!(!hits.is_empty());
    for (place, said) in hits {
        let Origin::Guide { bar, guide } = place.thread else { panic!("{said}") };
        let stitch = place.stitch.unwrap();
        assert!(
            said.starts_with(&format!("guide bar {bar}, guide {guide}, wale {}, ", stitch.wale)),
            "{said}"
        );
    }
}

#[test]
fn places_that_there_are_not_have_no_name() {
    let yarns = cases::design("plain.toml").yarns().unwrap();
    let points = yarns.yarn_points(0).unwrap().len();
    let at = |yarn, interval, t| YarnPlace::at(&yarns, yarn, interval, t);
    assert!(at(0, points - 2, 1.0).is_some());
    assert!(at(0, points - 1, 0.0).is_none() && at(usize::MAX, 0, 0.0).is_none());
    assert!(at(0, 0, 1.5).is_none() && at(0, 0, f64::NAN).is_none());
}
