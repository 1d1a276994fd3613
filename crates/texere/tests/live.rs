//! Tests of a fabric that is edited: how often a mesh is begun, and whether sources, materials,
//! sections and up directions stay known.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use texere::backend::{Engine, Plan};
use texere::mesh::MeshPiece;
use texere::rest::Finish;
use texere::woven::{Drawdown, Thread, Woven};
use texere::yarn::{Material, Section, YarnPlace, YarnsBuilder};
use texere::{
    Backend, BackendError, ControlPoint, DeviceInfo, Live, Pipeline, Settings, Vertex, Yarn, Yarns,
};

/// A device that counts the meshes that are begun on it.
#[derive(Debug)]
struct Counting {
    inner: Box<dyn Backend>,
    meshes: AtomicUsize,
}

impl Backend for Counting {
    fn info(&self) -> &DeviceInfo {
        self.inner.info()
    }

    fn engine(&self, plan: Arc<Plan>) -> Result<Box<dyn Engine>, BackendError> {
        self.meshes.fetch_add(1, Ordering::Relaxed);
        self.inner.engine(plan)
    }
}

fn device() -> Arc<Counting> {
    Arc::new(Counting { inner: texere::open("cpu-serial").unwrap(), meshes: AtomicUsize::new(0) })
}

fn cloth() -> Woven {
    let threads = |count| vec![Thread::new(0.5, 0.1); count];
    let plain = Drawdown::from_fn(40, 36, |end, pick| (end + pick) % 2 == 0).unwrap();
    let materials = vec![Material::default(), Material { srgb: [9, 8, 7], ..Material::default() }];
    let sections = vec![Section::Circle, Section::plied(2)];
    Woven::new(plain, threads(40), threads(36), materials, sections).unwrap()
}

/// `yarns` with `times` as many intervals, each new point with the source of the point before it.
fn finer(yarns: &Yarns, times: usize) -> Yarns {
    let (mut all, mut sources): (YarnsBuilder, Vec<u32>) = (Yarns::builder(), Vec::new());
    yarns.materials().iter().for_each(|material| _ = all.material(material.clone()));
    yarns.layout().sections().iter().for_each(|section| _ = all.section(section.clone()));
    for (number, yarn) in yarns.layout().yarns().iter().enumerate() {
        let own = yarns.yarn_points(number).unwrap();
        let told = &yarns.sources().unwrap()[yarns.range(number).unwrap()];
        let mut points = Vec::new();
        for at in 0..(own.len() - 1) * times + 1 {
            let (from, part) = (at / times, (at % times) as f32 / times as f32);
            let [one, other] = [own[from], own[(from + 1).min(own.len() - 1)]];
            let between = |one: f32, other: f32| one + (other - one) * part;
            points.push(ControlPoint::new(
                between(one.x, other.x),
                between(one.y, other.y),
                between(one.z, other.z),
                0.1,
            ));
            sources.push(told[from]);
        }
        all.yarn(*yarn, &points);
    }
    all.build().unwrap().with_sources(sources).unwrap()
}

#[test]
fn yarns_that_outgrow_their_room_take_one_mesh_together() {
    let (cloth, device) = (cloth(), device());
    let yarns = cloth.yarns().unwrap();
    let mut live = Live::weave(device.clone(), cloth, Settings::default()).unwrap();
    let meshes = || device.meshes.load(Ordering::Relaxed);
    live.set_rest(&finer(&yarns, 3)).unwrap();
    assert_eq!(meshes(), 2, "at rest");
    assert_eq!(live.yarns().unwrap().points(), finer(&yarns, 3).points());
    live.set_yarns(finer(&yarns, 7)).unwrap();
    assert_eq!(meshes(), 3, "others");
    assert!(live.update().unwrap().anew);
    // The mesh stays if all yarns have room.
    live.set_yarns(finer(&yarns, 6)).unwrap();
    assert_eq!(meshes(), 3, "shorter ones");
    assert!(!live.update().unwrap().anew);
    let counted: u64 = live.mesh().plan().layout().point_count();
    assert_eq!(counted, finer(&yarns, 6).points().len() as u64);
}

/// Plies press into one another at rest, so that yarns get other sections. The fabric stays woven
/// and can be edited.
#[test]
fn plied_cloth_at_rest_is_live() {
    let threads = vec![Thread { twist: 4.0, ..Thread::new(0.43, 0.1) }; 12];
    let plain = Drawdown::from_fn(12, 12, |end, pick| (end + pick) % 2 == 0).unwrap();
    let woven = |sections: Vec<Section>| {
        let materials = vec![Material::default()];
        Woven::new(plain.clone(), threads.clone(), threads.clone(), materials, sections).unwrap()
    };
    let (cloth, cpu) = (woven(vec![Section::plied(2)]), texere::open("cpu").unwrap());
    let rest = cloth.at_rest(&Finish::default(), 0.0, &*cpu, |_| ControlFlow::Continue(())).unwrap();
    assert_ne!(rest.yarns.layout().sections(), cloth.sections());

    let mut live = Live::weave(device(), cloth, Settings::default()).unwrap();
    live.update().unwrap();
    live.set_rest(&rest.yarns).unwrap();
    assert!(live.update().unwrap().anew);
    let same = |live: &Live, yarns: &Yarns| {
        let now = live.yarns().unwrap();
        assert_eq!((now.layout().sections(), now.points()), (yarns.layout().sections(), yarns.points()));
        assert_eq!(live.mesh().plan().layout().sections(), yarns.layout().sections());
    };
    same(&live, &rest.yarns);
    // A second call changes nothing, and the other threads stay at rest round a lift.
    live.set_rest(&rest.yarns).unwrap();
    assert!(live.update().unwrap().changes.is_empty());
    live.set_lift(4, 5, true).unwrap();
    let lifted = live.yarns().unwrap();
    assert_eq!(lifted.layout().sections(), rest.yarns.layout().sections());
    assert_eq!(lifted.yarn_points(3), rest.yarns.yarn_points(3));
    live.set_rest(&rest.yarns).unwrap();
    same(&live, &rest.yarns);
    // Yarns at rest with another number of sections are not those of this fabric.
    let other = woven(vec![Section::Circle; 2]).yarns().unwrap();
    let refused = live.set_rest(&other).unwrap_err().to_string();
    assert_eq!(refused, "24 yarns at rest of 2 sections are not the fabric's 24 of 1");
}

#[test]
fn sources_stay_when_yarns_are_set() {
    let cloth = cloth();
    let yarns = cloth.yarns().unwrap();
    let mut live = Live::weave(device(), cloth, Settings::default()).unwrap();
    let rest = finer(&yarns, 3);
    live.set_rest(&rest).unwrap();
    assert_eq!(live.yarns().unwrap().sources(), rest.sources());
    // One yarn is moved without sources.
    let (number, up) = (40 + 30, 0.05);
    let moved: Vec<_> = (rest.yarn_points(number).unwrap().iter())
        .map(|point| ControlPoint::new(point.x, point.y, point.z + up, 0.1))
        .collect();
    live.set_points(number, &moved).unwrap();
    let now = live.yarns().unwrap();
    for end in 0..40 {
        let range = rest.range(end).unwrap();
        assert_eq!(now.sources().unwrap()[range.clone()], rest.sources().unwrap()[range], "end {end}");
    }
    // Places on the moved yarn have the same names among all yarns as on this yarn alone.
    let intervals = yarns.yarn_points(number).unwrap().len();
    let mut crossings = 0;
    for interval in 0..intervals {
        let all = YarnPlace::at(&now, number, interval, 0.0).unwrap();
        let only = live.only(number).unwrap();
        let alone = YarnPlace::at(&only, 0, interval, 0.0).unwrap();
        let woven = live.woven().unwrap();
        let name = woven.place(&now, &all);
        assert_eq!(name.to_string(), woven.place(&only, &alone).to_string());
        crossings += usize::from(name.to_string().starts_with("pick 31 at end "));
    }
    assert!(crossings > intervals / 2, "{crossings} of {intervals}");
}

#[test]
fn a_material_that_yarns_refuse_is_refused() {
    let mut live = Live::weave(device(), cloth(), Settings::default()).unwrap();
    for hairiness in [f32::NAN, -1.0, f32::INFINITY, 1e6] {
        let refused = live.set_material(0, Material { hairiness, ..Material::default() });
        assert!(refused.is_err(), "{hairiness}");
    }
    assert!(live.set_material(2, Material::default()).is_err());
    assert_eq!(live.materials()[0], Material::default());
    live.set_lift(3, 2, true).unwrap();
    live.yarns().unwrap();
    live.update().unwrap();
}

#[test]
fn what_is_set_reaches_the_cloth() {
    let mut live = Live::weave(device(), cloth(), Settings::default()).unwrap();
    let red = Material { srgb: [200, 0, 0], name: "red".into(), ..Material::default() };
    live.set_material(1, red.clone()).unwrap();
    let points = live.yarns().unwrap().yarn_points(5).unwrap().to_vec();
    let before = live.yarns().unwrap().layout().yarns()[5];
    let what = Yarn { material: 1, section: 1, ..before };
    live.set_yarn(5, what, &points).unwrap();
    let woven = live.woven().unwrap();
    assert_eq!(woven.materials()[1], red);
    assert_eq!((woven.warp()[5].material, woven.warp()[5].section), (1, 1));
    assert_eq!((woven.warp()[4].material, woven.warp()[4].section), (0, 0));
    // The yarns of the cloth itself have the new section, too, and lie as before.
    assert_eq!(woven.yarns().unwrap().layout().yarns()[5], what);
    // After a lift, the yarn is that of the weave again.
    live.set_lift(5, 0, !live.woven().unwrap().drawdown().up(5, 0)).unwrap();
    assert_eq!(live.woven().unwrap().warp()[5].material, 0);
    assert_eq!(live.yarns().unwrap().layout().yarns()[5], before);
}

/// Flat threads.
fn ribbons() -> Woven {
    let threads = |count| vec![Thread { flatness: 2.0, ..Thread::new(0.8, 0.1) }; count];
    let plain = Drawdown::from_fn(5, 4, |end, pick| (end + pick) % 2 == 0).unwrap();
    Woven::new(plain, threads(5), threads(4), vec![Material::default()], vec![Section::Circle]).unwrap()
}

/// `yarns` with up directions. The up directions of the yarns that `turn` selects are turned about
/// the y axis, by more the larger x is.
fn turned(yarns: &Yarns, turn: impl Fn(usize) -> bool) -> Yarns {
    let mut ups = Vec::new();
    for yarn in 0..yarns.layout().yarns().len() {
        ups.extend(yarns.yarn_points(yarn).unwrap().iter().map(|point| {
            let (sin, cos) = if turn(yarn) { (0.3 + 0.2 * point.x).sin_cos() } else { (0.0, 1.0) };
            [sin, 0.0, cos]
        }));
    }
    yarns.clone().with_ups(ups).unwrap()
}

/// Asserts that the live mesh equals that of `yarns` made anew, to the bit, and has the same up
/// directions.
fn assert_fresh(live: &mut Live, yarns: &Yarns, what: &str) {
    live.update().unwrap();
    let now = live.yarns().unwrap();
    assert_eq!(now.ups(), yarns.ups(), "{what}");
    let mesh = live.mesh_mut();
    let plan = mesh.plan().clone();
    let mut vertices = vec![Vertex::default(); mesh.chunks()[0].vertices() as usize];
    assert_eq!(mesh.chunks().len(), 1);
    let _ = mesh
        .read_mesh(0, &mut |piece| {
            if let MeshPiece::Vertices { first, vertices: lent } = piece {
                vertices[first as usize..][..lent.len()].copy_from_slice(lent);
            }
            ControlFlow::Continue(())
        })
        .unwrap();
    let device = texere::open("cpu-serial").unwrap();
    let settings = *plan.settings();
    let fresh = Pipeline::new(yarns).settings(settings).mesh(&*device).unwrap();
    let (own, mut first) = (Plan::new(yarns.layout().clone(), settings).unwrap(), 0);
    for yarn in 0..yarns.layout().yarns().len() {
        let count = (own.rings(yarn) * settings.sides) as usize;
        let (_, part) = mesh.parts(yarn).next().unwrap();
        let kept = &vertices[part.first_vertex as usize..][..count];
        assert!(kept == &fresh.vertices[first..first + count], "{what}: yarn {yarn} lies otherwise");
        first += count;
    }
}

fn ups_of(yarns: &Yarns, yarn: usize) -> Option<Vec<glam::Vec3>> {
    yarns.ups().map(|ups| ups[yarns.range(yarn).unwrap()].to_vec())
}

#[test]
fn yarns_that_differ_in_their_ups_alone_are_made_again() {
    let flat = ribbons().yarns().unwrap();
    let (some, all) = (turned(&flat, |yarn| yarn == 2 || yarn == 6), turned(&flat, |_| true));
    let moved = turned(&finer(&flat, 2), |yarn| yarn % 2 == 0);
    let mut given = Live::given(device(), flat.clone(), Settings::default()).unwrap();
    let mut woven = Live::weave(device(), ribbons(), Settings::default()).unwrap();
    for (what, yarns) in
        [("all", &all), ("some", &some), ("flat", &flat), ("some again", &some), ("moved", &moved)]
    {
        given.set_yarns(yarns.clone()).unwrap();
        assert_fresh(&mut given, yarns, &format!("set_yarns, {what}"));
        woven.set_rest(yarns).unwrap();
        assert_fresh(&mut woven, yarns, &format!("set_rest, {what}"));
        for yarn in [2, 3] {
            let only = woven.only(yarn).unwrap();
            assert_eq!(only.ups().map(<[_]>::to_vec), ups_of(yarns, yarn), "{what}: yarn {yarn} alone");
        }
    }
    // Yarns that stay the same are not made again.
    given.set_yarns(moved.clone()).unwrap();
    woven.set_rest(&moved).unwrap();
    for live in [&mut given, &mut woven] {
        let update = live.update().unwrap();
        assert!(update.changes.is_empty() && !update.anew, "{update:?}");
    }
}

/// A yarn that is moved keeps its up directions. A yarn with fewer points, or one that is lifted,
/// stands along z.
#[test]
fn ups_stay_when_yarns_are_set() {
    let (cloth, flat) = (ribbons(), ribbons().yarns().unwrap());
    let rest = turned(&flat, |_| true);
    let mut live = Live::weave(device(), cloth, Settings::default()).unwrap();
    live.set_rest(&rest).unwrap();
    let raised = |points: &[ControlPoint]| -> Vec<_> {
        points.iter().map(|point| ControlPoint { z: point.z + 0.1, ..*point }).collect()
    };
    let moved = raised(rest.yarn_points(3).unwrap());
    live.set_points(3, &moved).unwrap();
    let mut wanted = rest.clone();
    wanted.set_points(3, &moved).unwrap();
    assert_fresh(&mut live, &wanted, "moved");

    let fewer = &rest.yarn_points(6).unwrap()[1..];
    live.set_points(6, fewer).unwrap();
    assert_eq!(live.only(6).unwrap().ups().unwrap(), vec![glam::Vec3::Z; fewer.len()]);
    live.set_lift(2, 1, !live.woven().unwrap().drawdown().up(2, 1)).unwrap();
    let now = live.yarns().unwrap();
    for (yarn, all) in [(2, false), (5 + 1, false), (1, true), (3, true)] {
        let wanted = if all {
            ups_of(&rest, yarn).unwrap()
        } else {
            vec![glam::Vec3::Z; now.range(yarn).unwrap().len()]
        };
        assert_eq!(ups_of(&now, yarn).unwrap(), wanted, "yarn {yarn}");
    }
    assert_fresh(&mut live, &now, "lifted");
}
