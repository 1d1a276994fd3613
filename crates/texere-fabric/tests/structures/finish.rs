//! Settling the yarns of a structure: cloth that pierces itself, results that must not be worse,
//! cancelling and refusals, and repeats laid side by side.

use std::ops::ControlFlow;
use std::sync::Arc;

use texere_contact::clearance;
use texere_core::backend::{Engine, NullBackend, Plan};
use texere_core::settling::{Length, Pass, Place, Settler, SettlingPlan, SettlingSeen};
use texere_core::{
    Backend, BackendError, Boundary, ControlPoint, DeviceInfo, Ends, Material, Origin, Section, Settings,
    Yarn, YarnPlace, Yarns,
};
use texere_cpu::ParallelBackend;
use texere_fabric::{
    FabricError, Finish, FinishError, Piece, Relief, Repeat, Settled, Structure, Thread, Weave, Woven,
    WovenDesign, settle,
};

/// A plain weave of 8 ends and 8 picks, all 0.3 mm thick. In each set a pair of threads, `pitch`
/// diameters apart, alternates with a single thread, 2.6 diameters from its neighbours.
fn plain(pitch: f64) -> Structure {
    let spacing = |number| 0.3 * if number % 3 == 2 { 2.0 * 2.6 - pitch } else { pitch };
    let threads: Vec<_> = (0..8).map(|number| Thread::new(spacing(number), 0.15)).collect();
    let drawdown = Weave::parse("plain").unwrap().drawdown(8, 8).unwrap();
    let (materials, sections) = (vec![Material::default()], vec![Section::Circle]);
    let cloth = Woven::new(drawdown, threads.clone(), threads, materials, sections).unwrap();
    Structure::Woven(WovenDesign::new(cloth, None, Relief::Report).unwrap())
}

fn settled(structure: &Structure, finish: Finish, device: &dyn Backend) -> Result<Settled, FinishError> {
    settle(&structure.repeat().unwrap().piece, &finish, device, |_| ControlFlow::Continue(()))
}

fn piece(pitch: f64) -> Piece {
    plain(pitch).repeat().unwrap().piece
}

fn cpu() -> ParallelBackend {
    ParallelBackend::open().unwrap()
}

const FREE: Length = Length::Free { tension: 0.0 };

#[test]
fn threads_that_are_too_near_come_to_rest() {
    let structure = plain(1.5);
    let before = clearance(&structure.yarns().unwrap(), &Settings::default()).unwrap();
    assert!(before.min < 0.95 && before.curvature_min < 0.6, "{before:?}");
    let settled = settled(&structure, Finish { length: Some(FREE), ..Finish::default() }, &cpu()).unwrap();
    assert!(settled.rest.at_rest && settled.is_linked(), "{:?} {:?}", settled.rest, settled.linking);
    let after = clearance(&settled.yarns, &Settings::default()).unwrap();
    assert!(after.min >= 0.98 && after.curvature_min > 1.16, "{after:?}");
    assert_eq!(after, settled.clearance);
    assert!(settled.course.is_empty());
}

/// Settling changes only positions, and the yarns' ends do not move.
#[test]
fn the_yarns_are_the_same_ones_and_held_at_their_ends() {
    let structure = plain(1.7);
    let (before, settled) =
        (structure.yarns().unwrap(), settled(&structure, Finish::default(), &cpu()).unwrap());
    let after = &settled.yarns;
    assert_eq!((before.layout(), before.materials()), (after.layout(), after.materials()));
    assert_eq!(before.sources(), after.sources());
    let places = |yarns: &Yarns| yarns.points().iter().map(ControlPoint::position).collect::<Vec<_>>();
    let (from, to) = (places(&before), places(after));
    let moved = |point: &u64| from[*point as usize].distance(to[*point as usize]);
    let pinned = structure.repeat().unwrap().piece.pinned;
    assert!(pinned.len() == 32 && pinned.iter().all(|point| moved(point) < 1e-4));
    assert!((0..from.len() as u64).any(|point| moved(&point) > 1e-2));
    // The worst place is named.
    let worst = settled.clearance.worst[0].places[0];
    assert!(matches!(settled.origin(&worst), Origin::End(_)));
    assert_eq!(structure.place(after, &worst).thread, settled.origin(&worst));
}

/// A backend whose settler mirrors the first end when positions are read.
#[derive(Debug)]
struct Flipping(ParallelBackend);

#[derive(Debug)]
struct Flipped(Box<dyn Settler>, usize);

impl Backend for Flipping {
    fn info(&self) -> &DeviceInfo {
        self.0.info()
    }

    fn engine(&self, plan: Arc<Plan>) -> Result<Box<dyn Engine>, BackendError> {
        self.0.engine(plan)
    }

    fn settler(&self, plan: Arc<SettlingPlan>) -> Result<Box<dyn Settler>, BackendError> {
        let first = plan.strands()[0].points as usize;
        Ok(Box::new(Flipped(self.0.settler(plan)?, first)))
    }
}

impl Settler for Flipped {
    fn plan(&self) -> &Arc<SettlingPlan> {
        self.0.plan()
    }

    fn upload(&mut self, places: &[Place]) -> Result<(), BackendError> {
        self.0.upload(places)
    }

    fn list(&mut self, growth: f32) -> Result<u64, BackendError> {
        self.0.list(growth)
    }

    fn pass(&mut self, pass: &Pass) -> Result<SettlingSeen, BackendError> {
        self.0.pass(pass)
    }

    fn keep(&mut self) -> Result<(), BackendError> {
        self.0.keep()
    }

    fn recall(&mut self) -> Result<(), BackendError> {
        self.0.recall()
    }

    fn read(&mut self, places: &mut [Place]) -> Result<(), BackendError> {
        self.0.read(places)?;
        places[..self.1].iter_mut().for_each(|place| place.at[2] = -place.at[2]);
        Ok(())
    }
}

#[test]
fn yarns_that_pass_through_one_another_are_not_given_back() {
    let structure = plain(1.7);
    let settled = settled(&structure, Finish::default(), &Flipping(cpu())).unwrap();
    assert!(!settled.is_linked() && settled.linking.passages > 0);
    assert_eq!(settled.origin(&settled.linking.worst[0].places[0]), Origin::End(1));
    assert_eq!(settled.yarns.points(), structure.yarns().unwrap().points());
    assert!(!settled.rest.at_rest, "{:?}", settled.rest);
    assert_eq!(settled.rest.end, settled.rest.start);
}

#[test]
fn what_finds_no_rest_says_so_and_is_no_worse() {
    let structure = plain(1.3);
    let finish = Finish { passes: 30, record: true, ..Finish::default() };
    let settled = settled(&structure, finish, &cpu()).unwrap();
    let (rest, before) =
        (settled.rest, clearance(&structure.yarns().unwrap(), &Settings::default()).unwrap());
    assert!(!rest.at_rest && settled.is_linked(), "{rest:?}");
    assert!(!rest.start.is_better_than(&rest.end), "{rest:?}");
    assert!(settled.clearance.min > before.min.min(0.985) - 0.002, "{before:?} {:?}", settled.clearance);
    assert_eq!(settled.course.len(), rest.passes as usize);
    assert_eq!(settled.course[0].1, rest.start);
}

#[test]
fn a_cancel_is_seen_within_one_pass() {
    for last in [0, 1, 25, 60] {
        let mut calls = 0;
        let stopped = settle(&piece(1.5), &Finish::default(), &cpu(), |_| {
            calls += 1;
            if calls > last { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        assert!(matches!(stopped, Err(FinishError::Fabric(FabricError::Cancelled))), "{stopped:?}");
        assert_eq!(calls, last + 1);
    }
}

#[test]
fn progress_grows_to_the_end() {
    let mut shares = vec![0.0];
    let followed = settle(&piece(1.7), &Finish::default(), &cpu(), |done| {
        shares.push(done);
        ControlFlow::Continue(())
    });
    assert!(followed.is_ok());
    assert!(shares.is_sorted() && shares.last() == Some(&1.0), "{shares:?}");
}

#[test]
fn a_backend_without_a_settler_and_senseless_finishes_are_refused_by_name() {
    let structure = plain(2.0);
    let refused = |finish, device: &dyn Backend| settled(&structure, finish, device).unwrap_err().to_string();
    assert_eq!(refused(Finish::default(), &NullBackend::default()), "null can't settle yarns");
    let given = Finish { length: Some(Length::Given(3.0)), ..Finish::default() };
    assert_eq!(refused(given, &cpu()), "the length is 3, not between 0.5 and 2");
}

/// A repeat of 2 by 1 mm: a thread that goes on along x, a thread that runs down from the upper
/// edge, a ring, and a piece of yarn.
fn repeat(copies: [u32; 2]) -> Repeat {
    let mut yarns = Yarns::builder();
    let points =
        |places: &[[f32; 2]]| places.iter().map(|[x, y]| ControlPoint::new(*x, *y, 0.0, 0.1)).collect();
    let mut add = |origin, closed, places: &[[f32; 2]]| {
        let points: Vec<_> = points(places);
        yarns.yarn(Yarn { origin, closed, ..Yarn::default() }, &points);
    };
    add(Origin::Pick(1), false, &[[0.0, 0.5], [1.0, 0.5]]);
    add(Origin::End(1), false, &[[0.5, 1.0], [0.5, 0.75], [0.5, 0.25]]);
    add(Origin::Course(1), true, &[[1.0, 0.0], [1.25, 0.0], [1.0, 0.25]]);
    add(Origin::Course(2), false, &[[1.5, 0.0], [1.75, 0.0]]);
    let yarns = yarns.build().unwrap().with_sources((0..10).collect()).unwrap();
    let ends = vec![Ends::Repeats([1, 0]), Ends::Repeats([0, -1]), Ends::Closed, Ends::Open];
    let boundary = Boundary::new(yarns.layout(), [2.0, 1.0], ends).unwrap();
    Repeat { piece: Piece::new(yarns, boundary), copies }
}

#[test]
fn copies_join_what_goes_on() {
    let repeat = repeat([3, 2]);
    let laid = repeat.placed(&repeat.piece.yarns).unwrap();
    let of = |origin| {
        let yarns = laid.layout().yarns().iter().enumerate().filter(move |(_, yarn)| yarn.origin == origin);
        yarns.map(|(yarn, _)| yarn).collect::<Vec<_>>()
    };
    let numbers =
        [Origin::Pick(1), Origin::End(1), Origin::Course(1), Origin::Course(2)].map(|each| of(each).len());
    assert_eq!(numbers, [2, 3, 6, 6]);
    assert_eq!(laid.layout().point_count(), 60);
    let places =
        |yarn| laid.yarn_points(yarn).unwrap().iter().map(|point| [point.x, point.y]).collect::<Vec<_>>();
    let picks = of(Origin::Pick(1));
    assert_eq!(places(picks[1]), [0.0, 1.0, 2.0, 3.0, 4.0, 5.0].map(|x| [x, 1.5]));
    // The thread that runs down begins at the top.
    let ends = of(Origin::End(1));
    assert_eq!(places(ends[2]), [2.0, 1.75, 1.25, 1.0, 0.75, 0.25].map(|y| [4.5, y]));
    assert_eq!(laid.sources().unwrap()[laid.range(ends[2]).unwrap()], [2, 3, 4, 2, 3, 4]);
    assert!(laid.layout().yarns()[of(Origin::Course(1))[5]].closed);
}

#[test]
fn copies_that_can_not_be_are_refused() {
    let one = repeat([1, 1]);
    assert_eq!(one.placed(&one.piece.yarns).unwrap().points(), one.piece.yarns.points());
    let none = repeat([0, 4]);
    assert!(matches!(none.placed(&none.piece.yarns), Err(FabricError::Yarns(_))));
    let all = repeat([u32::MAX; 2]);
    assert!(matches!(all.placed(&all.piece.yarns), Err(FabricError::OutOfMemory(_))));
    let others = plain(2.0).yarns().unwrap();
    assert!(matches!(one.placed(&others), Err(FabricError::OtherYarns { planned: 10, .. })));
}

/// Copies of a settled repeat make settled cloth: the seams between copies of a plain weave's
/// repeat are as clear as the repeat.
#[test]
fn a_settled_repeat_fits_its_copies() {
    let mut yarns = Yarns::builder();
    let mut ends = Vec::new();
    // Four ends and four picks, 1.7 diameters apart. They go straight up and down between
    // crossings, far from rest.
    for along in [true, false] {
        for number in 0..4 {
            let side = |crossing: u8| {
                if (crossing + number + u8::from(along)).is_multiple_of(2) { 0.5 } else { -0.5 }
            };
            let points = (0..8).map(|step: u8| {
                let z = if step.is_multiple_of(2) { side(step / 2) } else { 0.0 };
                let (far, across) = (0.85 * f32::from(step), 1.7 * f32::from(number));
                let [x, y] = if along { [across, far] } else { [far, across] };
                ControlPoint::new(x, y, z, 0.5)
            });
            let points: Vec<_> = points.collect();
            yarns.yarn(Yarn::default(), &points);
            ends.push(Ends::Repeats(if along { [0, 1] } else { [1, 0] }));
        }
    }
    let yarns = yarns.build().unwrap();
    let boundary = Boundary::new(yarns.layout(), [6.8, 6.8], ends).unwrap();
    let repeat = Repeat { piece: Piece::new(yarns, boundary), copies: [3, 3] };
    let finish = Finish { length: Some(FREE), ..Finish::default() };
    let settled = settle(&repeat.piece, &finish, &cpu(), |_| ControlFlow::Continue(())).unwrap();
    let cloth = repeat.placed(&settled.yarns).unwrap();
    let found = clearance(&cloth, &Settings::default()).unwrap();
    assert!(settled.rest.start.clearance < 0.9 && settled.rest.at_rest, "{:?}", settled.rest);
    // The first and the last interval of a cut yarn lack a neighbour, and lie differently from
    // those in the repeat.
    let is_cut = |place: &YarnPlace| {
        let intervals = cloth.yarn_points(place.yarn).unwrap().len() - 1;
        place.interval == 0 || place.interval + 1 == intervals
    };
    let inner: Vec<_> = found.worst.iter().filter(|contact| !contact.places.iter().any(is_cut)).collect();
    assert!(inner.len() > 20 && inner[0].ratio > 0.99, "{:?}", inner[0]);
    // Some of these contacts lie at a seam.
    let seam = |x: f64| (x / 6.8 - (x / 6.8).round()).abs() < 0.1 && x > 3.0 && x < 17.0;
    assert!(inner.iter().any(|contact| seam(contact.places[0].position[0])));
}
