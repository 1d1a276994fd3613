//! Cloth keeps its mesh when it is moved, put together and taken apart.

use glam::DVec3;
use texere_conformance::cases;
use texere_core::{
    ControlPoint, Frame, Pipeline, Placement, Section, Settings, Vertex, Yarn, YarnError, Yarns,
};
use texere_cpu::SerialBackend;

fn vertices(yarns: &Yarns) -> Vec<Vertex> {
    let settings =
        Settings { frame: Frame::RotationMinimizing, subdivisions: 3, caps: true, ..Settings::default() };
    Pipeline::new(yarns).settings(settings).mesh(&SerialBackend::new()).unwrap().vertices
}

/// A twisted, a closed and a flattened yarn. None of them runs straight up, where the upright frame
/// is not defined.
fn cloth() -> Yarns {
    let twisted = cases::winding(60, Yarn { twist: 3.0, ..Yarn::default() });
    let closed = cases::winding(40, Yarn { closed: true, ..Yarn::default() });
    let mut flattened = Yarns::builder();
    flattened.section(Section::Ellipse { aspect: 1.5 });
    let points: Vec<_> = (0..30)
        .map(|k| ControlPoint::new(k as f32, (k % 3) as f32, (k % 2) as f32, 0.5).flattened(0.75, 0.25))
        .collect();
    flattened.yarn(Yarn::default(), &points);
    Yarns::merged([&twisted, &closed, &flattened.build().unwrap()]).unwrap()
}

#[test]
fn the_mesh_of_placed_yarns_is_the_placed_mesh() {
    let yarns = cloth();
    let sources: Vec<_> = (0..yarns.points().len() as u32).collect();
    let yarns = yarns.with_sources(sources.clone()).unwrap();
    let before = vertices(&yarns);
    // Scaling by a power of two does not round half widths.
    for (turn, scale, at) in
        [(0.0, 1.0, [0.0; 3]), (0.7, 0.5, [1.0, -2.0, 3.0]), (-2.0, 4.0, [0.0, 0.0, -7.0])]
    {
        let placed = yarns.placed(&Placement { turn, scale, at }).unwrap();
        assert_eq!(placed.sources(), Some(&sources[..]));
        let rotation = glam::DQuat::from_rotation_z(turn);
        let reach =
            before.iter().flat_map(|vertex| vertex.position).fold(1.0_f32, |most, x| most.max(x.abs()));
        for (number, (vertex, after)) in before.iter().zip(vertices(&placed)).enumerate() {
            let [position, normal] =
                [vertex.position, vertex.normal].map(|v| DVec3::from_array(v.map(f64::from)));
            let [own, own_normal] =
                [after.position, after.normal].map(|v| DVec3::from_array(v.map(f64::from)));
            let expected = rotation * position * f64::from(scale) + DVec3::from_array(at.map(f64::from));
            let most = 2e-5 * f64::from(reach * scale + 7.0);
            assert!(own.distance(expected) < most, "vertex {number}: {own}, not {expected}");
            let turned = rotation * normal;
            assert!(own_normal.distance(turned) < 2e-3, "vertex {number}: {own_normal}, not {turned}");
        }
    }
}

#[test]
fn cloths_are_put_together_and_taken_apart() {
    let (one, other) = (cloth(), cases::menagerie());
    let both = Yarns::merged([&one, &other, &one]).unwrap();
    let counts = [&one, &other].map(|cloth| cloth.layout().yarns().len());
    assert_eq!(both.layout().yarns().len(), 2 * counts[0] + counts[1]);
    // The third cloth is the first one again. It adds no section.
    assert_eq!(both.layout().sections(), Yarns::merged([&one, &other]).unwrap().layout().sections());
    for (cloth, first) in [(&one, 0), (&other, counts[0]), (&one, counts[0] + counts[1])] {
        let own = both.only(first..first + cloth.layout().yarns().len()).unwrap();
        assert!(vertices(&own) == vertices(cloth));
    }
    let last_first = one.only((0..counts[0]).rev()).unwrap();
    assert_eq!(last_first.yarn_points(0), one.yarn_points(counts[0] - 1));
}

#[test]
fn what_can_not_be_is_named() {
    let yarns = cloth();
    let count = yarns.layout().yarns().len();
    assert!(
        matches!(yarns.only([count]), Err(YarnError::UnknownYarn { yarn, yarns }) if yarn == count && yarns == count)
    );
    assert!(matches!(yarns.only([]), Err(YarnError::NoYarns)));
    assert!(matches!(Yarns::merged([]), Err(YarnError::NoYarns)));
    for scale in [0.0, -1.0, f32::NAN, f32::INFINITY, 1e9] {
        assert!(yarns.placed(&Placement { scale, ..Placement::default() }).is_err(), "{scale}");
    }
    for turn in [f64::NAN, f64::INFINITY] {
        assert!(yarns.placed(&Placement { turn, ..Placement::default() }).is_err(), "{turn}");
    }
    let far = Placement { at: [2e9, 0.0, 0.0], ..Placement::default() };
    assert!(matches!(yarns.placed(&far), Err(YarnError::TooFar { .. })));
}

#[test]
fn yarns_keep_their_tension_wherever_they_go() {
    let slack = cloth();
    assert_eq!(slack.tension(), 0.0);
    let taut = slack.clone().with_tension(0.3).unwrap();
    assert!(vertices(&taut) != vertices(&slack));
    let sources = vec![7; taut.points().len()];
    let places = taut.yarn_points(1).unwrap().to_vec();
    let mut moved = taut.clone();
    moved.set_points(1, &places).unwrap();
    let kept = [
        taut.placed(&Placement { turn: 0.7, scale: 2.0, at: [1.0, 2.0, 3.0] }).unwrap(),
        taut.mapped(|[x, y, z]| [z, x, y]).unwrap(),
        Yarns::merged([&taut, &taut]).unwrap(),
        taut.only([2, 0]).unwrap(),
        taut.clone().with_ups(vec![[0.0, 0.0, 1.0]; taut.points().len()]).unwrap(),
        taut.clone().with_sources(sources).unwrap(),
        moved,
    ];
    assert_eq!(kept.map(|yarns| yarns.tension()), [0.3; 7]);
    // Only the tension has changed: with the first tension back, the mesh equals the first mesh.
    assert!(vertices(&taut.clone().with_tension(0.0).unwrap()) == vertices(&slack));
    let refused = Yarns::merged([&taut, &slack]).unwrap_err();
    assert_eq!(refused, YarnError::OtherTension { given: 0.0, tension: 0.3 });
    assert_eq!(refused.to_string(), "yarns of tension 0 beside yarns of tension 0.3");
}
