//! Many yarns are edited at once.

use std::collections::BTreeMap;
use std::sync::Arc;

use texere_core::backend::{LiveMesh, Plan};
use texere_core::{ControlPoint, Frame, Settings, Vertex, Yarn};

use super::{Edit, Fabric, ROOM, editing, edits_of, ends_as_fresh, read, yarns_of};

/// `count` points at `y` along x. With `climbs` they rise in a helix: the yarn is steep if it is
/// round, and leans if it is flattened.
fn laid(y: f32, count: usize, climbs: bool, halves: (f32, f32)) -> Vec<ControlPoint> {
    let place = |k: usize| {
        let t = k as f32 * 0.4;
        if climbs { (0.3 * t.cos(), y + 0.3 * t.sin(), t) } else { (t, y, 0.0) }
    };
    let point = |(x, y, z)| ControlPoint::new(x, y, z, 0.1).flattened(halves.0, halves.1);
    (0..count).map(place).map(point).collect()
}

/// Some yarns get fewer points, some get more, some become steep, and some begin to lean. The yarns
/// between them stay.
#[test]
fn yarns_that_are_edited_together_end_as_a_fresh_mesh() {
    let (round, flat) = ((0.1, 0.1), (0.2, 0.05));
    let lines: Fabric = (0..14).map(|y| (Yarn::default(), laid(y as f32, 20, false, round))).collect();
    let other =
        |yarn: usize, count: usize, halves| (yarn, 0.0, 0, laid(yarn as f32, count, yarn % 2 == 1, halves));
    let together = [0, 1, 2, 5, 6, 9, 11, 13]
        .map(|yarn| other(yarn, [5, 33, 120, ROOM][yarn % 4], if yarn % 3 == 0 { flat } else { round }));
    let back = [1, 2, 3, 9, 13].map(|yarn| (yarn, 0.0, 1, laid(yarn as f32, 12 + yarn, false, round)));
    let layout = yarns_of(&together.iter().map(|other| (Yarn::default(), other.3.clone())).collect());
    let stand = |at: usize| (layout.layout().is_steep(at), layout.layout().ups(at).is_some());
    // Whether yarns 0, 1 and 9 are steep, and whether they lean.
    assert_eq!([0, 1, 5].map(stand), [(false, false), (true, false), (false, true)]);
    for device in editing() {
        for frame in [Frame::Upright, Frame::RotationMinimizing] {
            let settings = Settings { frame, caps: true, ..Settings::default() };
            for edits in [
                &[Edit::Yarns(together.to_vec())][..],
                &[Edit::Update, Edit::Yarns(together.to_vec()), Edit::Update, Edit::Yarns(back.to_vec())],
            ] {
                ends_as_fresh(&*device, lines.clone(), settings, 5, edits).unwrap();
            }
        }
    }
}

/// If one of many yarns is refused, none is edited.
#[test]
fn one_yarn_that_is_refused_leaves_all_as_they_were() {
    let round = (0.1, 0.1);
    let lines: Fabric = (0..4).map(|y| (Yarn::default(), laid(y as f32, 20, false, round))).collect();
    let yarns = yarns_of(&lines);
    let line = |yarn: usize, count: usize| (Yarn::default(), laid(yarn as f32, count, false, round));
    let mut nowhere = line(3, 20);
    nowhere.1[19].z = f32::NAN;
    let refusals = [
        ((3, line(3, 41)), "yarn 3 of 41 control points, but the plan has room for 40"),
        ((3, line(3, 1)), "yarn 3 of 1 control point, fewer than 2"),
        ((4, line(4, 20)), "there is no yarn 4: there are 4, numbered from 0"),
        ((3, nowhere), "z of point 19 of yarn 3 is NaN"),
        (
            (3, (Yarn { twist: 1.0, ..Yarn::default() }, line(3, 20).1)),
            "yarn 3 can't be twisted, where no other yarn is: that takes a new plan",
        ),
    ];
    for device in editing() {
        let plan = Plan::with_room(yarns.layout().clone(), Settings::default(), |_| 40).unwrap();
        let mut live = LiveMesh::new(&*device, Arc::new(plan)).unwrap();
        live.upload(0, yarns.points()).unwrap();
        live.update().unwrap();
        let (plan, sent, mesh) = (live.plan().clone(), live.traffic().uploaded, read(&mut live));
        for ((yarn, refused), said) in &refusals {
            let edits = [
                (0, line(0, 33)),
                (1, (Yarn::default(), laid(1.0, 30, true, (0.2, 0.05)))),
                (*yarn, refused.clone()),
            ];
            let edits = BTreeMap::from(edits);
            assert_eq!(live.set_yarns(&edits_of(&edits)).unwrap_err().to_string(), *said);
            assert!(Arc::ptr_eq(live.plan(), &plan), "{said}");
            assert_eq!((live.traffic().uploaded, live.update().unwrap()), (sent, Vec::new()), "{said}");
        }
        // Bits are compared, because memory may hold NaN where a yarn has room and no rings yet.
        let bits = |vertices: &[Vertex]| bytemuck::cast_slice::<_, u32>(vertices).to_vec();
        assert!(bits(&read(&mut live).vertices) == bits(&mesh.vertices));
        // The two valid yarns are accepted without the third.
        let edits = BTreeMap::from([(0, line(0, 33)), (2, line(2, 7))]);
        live.set_yarns(&edits_of(&edits)).unwrap();
        live.update().unwrap();
        assert_eq!([0, 1, 2, 3].map(|yarn| live.plan().rings(yarn)), [65, 39, 13, 39]);
    }
}
