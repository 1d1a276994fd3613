//! A repeat that settles once and is copied, against copies that settle together.

use std::ops::ControlFlow;

use texere_conformance::rest::{self, Chart, Gauge, Length, Start, weft_knit, yarns};
use texere_contact::{Clearance, clearance, length_mm};
use texere_core::{Boundary, Ends, Settings, Yarns};
use texere_cpu::ParallelBackend;
use texere_fabric::{Finish, Piece, Repeat, Settled, settle};

/// Garter of this many wales and courses. Its loops pierce one another at the start.
fn garter(size: usize) -> Start {
    let courses: Vec<_> = (0..size).map(|course| ["k", "p"][course % 2].repeat(size)).collect();
    weft_knit("garter", &Chart::new(&courses), Gauge::new(4.4), Length::Held)
}

fn piece(start: &Start) -> Piece {
    let yarns = yarns(start);
    let ends = start.yarns.iter().map(|yarn| match yarn.ends {
        rest::Ends::Repeats(onward) => Ends::Repeats(onward),
        rest::Ends::Open => Ends::Open,
        rest::Ends::Closed => Ends::Closed,
    });
    let repeat = start.repeat.map(|repeat| repeat as f32);
    let boundary = Boundary::new(yarns.layout(), repeat, ends.collect()).expect("a boundary");
    Piece::new(yarns, boundary)
}

fn settled(piece: &Piece) -> Settled {
    let cpu = ParallelBackend::open().expect("the CPU");
    settle(piece, &Finish::default(), &cpu, |_| ControlFlow::Continue(())).expect("a settling")
}

/// The ratio of the nearest contact that is not at a cut end.
fn inner(yarns: &Yarns, found: &Clearance) -> f64 {
    let is_cut = |place: &texere_core::YarnPlace| {
        let points = yarns.yarn_points(place.yarn).map_or(0, <[_]>::len);
        place.interval == 0 || place.interval + 2 >= points
    };
    let inner = found.worst.iter().find(|contact| !contact.places.iter().any(is_cut));
    inner.map_or(f64::INFINITY, |contact| contact.ratio)
}

#[test]
fn a_copied_repeat_lies_as_one_that_settled_whole() {
    let repeat = Repeat { piece: piece(&garter(2)), copies: [2, 2] };
    let (one, whole) = (settled(&repeat.piece), settled(&piece(&garter(4))));
    for each in [&one, &whole] {
        assert!(each.rest.start.clearance < 0.85 && each.rest.at_rest && each.is_linked(), "{:?}", each.rest);
    }
    let copied = repeat.placed(&one.yarns).expect("copies");
    assert_eq!(copied.layout().offsets(), whole.yarns.layout().offsets());
    // Any clear cloth without tight bends is at rest, so both cloths need not end in the same
    // place. At the start each point is moved by up to 0.01 diameters along each axis, in its own
    // direction. Equal points of both cloths may therefore be up to 0.035 mm apart.
    let apart = |one: &Yarns, other: &Yarns| {
        let pairs = one.points().iter().zip(other.points());
        pairs.map(|(one, other)| one.position().distance(other.position())).fold(0.0, f32::max)
    };
    let (moved, off) = (apart(&whole.yarns, &piece(&garter(4)).yarns), apart(&whole.yarns, &copied));
    assert!(moved > 0.5 && off < 0.05, "moved {moved} mm, {off} mm apart");
    // Lengths are equal, up to the tolerance of either.
    let lengths = [&copied, &whole.yarns].map(length_mm);
    assert!((lengths[0] / lengths[1] - 1.0).abs() < 0.01, "{lengths:?}");
    // At the seams nothing comes nearer than in the repeat.
    let found = clearance(&copied, &Settings::default()).expect("clearance");
    let nearest = inner(&copied, &found);
    assert!(
        nearest > 0.99 && nearest > f64::from(one.rest.end.clearance) - 0.002,
        "{nearest}, {:?}",
        one.rest
    );
}
