//! Bad input gives a named error: never a panic, and never much memory before the error.

use std::sync::Arc;

use texere_conformance::schedule::able_devices;
use texere_core::backend::{NullBackend, Plan};
use texere_core::{
    Boundary, BoundaryError, ControlPoint, Ends, Frame, Layout, Limits, Material, Pipeline, PipelineError,
    PlanError, Section, SectionError, Settings, Topology, Yarn, YarnError, Yarns,
};

fn straight(count: u16) -> Vec<ControlPoint> {
    (0..count).map(|k| ControlPoint::new(k.into(), 0.0, 0.0, 0.1)).collect()
}

fn one_yarn(yarn: Yarn, points: &[ControlPoint]) -> Result<Yarns, YarnError> {
    let mut yarns = Yarns::builder();
    yarns.yarn(yarn, points);
    yarns.build()
}

/// The error of two yarns, of which the first is good and the second has `point` in its middle.
fn with_point(point: ControlPoint) -> YarnError {
    let mut yarns = Yarns::builder();
    let mut spoilt = straight(5);
    spoilt[2] = point;
    yarns.yarn(Yarn::default(), &straight(3)).yarn(Yarn::default(), &spoilt);
    yarns.build().unwrap_err()
}

fn with_section(section: Section) -> SectionError {
    let mut yarns = Yarns::builder();
    yarns.section(section);
    yarns.yarn(Yarn::default(), &straight(3));
    match yarns.build().unwrap_err() {
        YarnError::Section { section: 0, source } => source,
        other => panic!("{other:?}"),
    }
}

fn with_settings(settings: Settings) -> PlanError {
    let yarns = one_yarn(Yarn::default(), &straight(100)).unwrap();
    let planned = Pipeline::new(&yarns).settings(settings).mesh(&NullBackend::default()).unwrap_err();
    match planned {
        PipelineError::Plan(error) => error,
        other => panic!("{other:?}"),
    }
}

const NOT_NUMBERS: [f32; 3] = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY];

#[test]
fn control_points_that_are_not_finite() {
    for bad in NOT_NUMBERS {
        for field in ["x", "y", "z"] {
            let mut point = ControlPoint::new(2.0, 0.0, 0.0, 0.1);
            match field {
                "x" => point.x = bad,
                "y" => point.y = bad,
                _ => point.z = bad,
            }
            let YarnError::NotFinite { yarn: 1, point: 2, field: named, value } = with_point(point) else {
                panic!("{field} = {bad}");
            };
            assert_eq!((named, value.to_bits()), (field, bad.to_bits()));
        }
    }
    for (field, width, height) in [("half width", f32::NAN, 0.1), ("half height", 0.1, f32::NAN)] {
        let error = with_point(ControlPoint::new(2.0, 0.0, 0.0, 0.1).flattened(width, height));
        let YarnError::NotFinite { yarn: 1, point: 2, field: named, value } = error else {
            panic!("{error}")
        };
        assert!(named == field && value.is_nan(), "{named}: {value}");
    }
}

#[test]
fn control_points_out_of_range() {
    for far in [1.1e9, -1.1e9, f32::MAX] {
        let error = with_point(ControlPoint::new(2.0, far, 0.0, 0.1));
        assert!(matches!(error, YarnError::TooFar { yarn: 1, point: 2, field: "y", .. }), "{error:?}");
    }
    for half in
        [0.0, -0.0, -0.1, 1e-7, 9.9e-5, f32::MIN_POSITIVE, 3.01e4, 1.1e6, f32::INFINITY, f32::NEG_INFINITY]
    {
        for (named, width, height) in [("half width", half, 0.1), ("half height", 0.1, half)] {
            let error = with_point(ControlPoint::new(2.0, 0.0, 0.0, 0.1).flattened(width, height));
            let YarnError::Size { yarn: 1, point: 2, field, .. } = error else { panic!("{half}: {error:?}") };
            assert_eq!(field, named, "{half}");
        }
    }
    for half in [1e-4, 3e4] {
        let mut yarns = Yarns::builder();
        yarns.yarn(Yarn::default(), &[0.0, 1.0].map(|x| ControlPoint::new(x * half, 0.0, 0.0, half)));
        yarns.build().unwrap();
    }
}

#[test]
fn too_few_points() {
    assert_eq!(Yarns::builder().build().unwrap_err(), YarnError::NoYarns);
    for (closed, points, least) in [(false, 0, 2), (false, 1, 2), (true, 0, 3), (true, 1, 3), (true, 2, 3)] {
        let error = one_yarn(Yarn { closed, ..Yarn::default() }, &straight(points)).unwrap_err();
        assert_eq!(error, YarnError::TooFewPoints { yarn: 0, points: points.into(), least, closed });
    }
}

#[test]
fn offsets_that_are_no_prefix_sums() {
    let layout = |yarns: usize, offsets: Vec<u64>| {
        Layout::new(vec![Yarn::default(); yarns], offsets, vec![Section::Circle]).unwrap_err()
    };
    assert_eq!(layout(2, vec![0, 5]), YarnError::OffsetCount { offsets: 2, yarns: 2 });
    assert_eq!(layout(1, vec![]), YarnError::OffsetCount { offsets: 0, yarns: 1 });
    assert!(matches!(layout(1, vec![3, 5]), YarnError::OffsetOrder { yarn: 0, .. }));
    assert_eq!(layout(2, vec![0, 5, 2]), YarnError::OffsetOrder { yarn: 1, start: 5, end: 2 });
}

#[test]
fn boundaries_that_are_not_those_of_the_yarns() {
    let mut yarns = Yarns::builder();
    yarns.yarn(Yarn::default(), &straight(3)).yarn(Yarn { closed: true, ..Yarn::default() }, &straight(3));
    let yarns = yarns.build().unwrap();
    let refused = |repeat, ends: &[Ends]| Boundary::new(yarns.layout(), repeat, ends.to_vec()).unwrap_err();
    let (both, on) = ([Ends::Open, Ends::Closed], Ends::Repeats([1, 0]));
    for (axis, repeat) in
        [('x', [f32::NAN, 0.0]), ('y', [1.0, f32::INFINITY]), ('x', [-1.0, 1.0]), ('y', [0.0, 2e9])]
    {
        let BoundaryError::Repeat { axis: told, limit: 1e9, .. } = refused(repeat, &both) else {
            panic!("{repeat:?}")
        };
        assert_eq!(told, axis, "{repeat:?}");
    }
    assert_eq!(refused([0.0; 2], &both[..1]), BoundaryError::EndsCount { ends: 1, yarns: 2 });
    assert_eq!(refused([0.0; 2], &[Ends::Closed; 2]), BoundaryError::Closed { yarn: 0, closed: false });
    assert_eq!(refused([0.0; 2], &[Ends::Open; 2]), BoundaryError::Closed { yarn: 1, closed: true });
    assert_eq!(refused([1.0; 2], &[Ends::Open, on]), BoundaryError::Closed { yarn: 1, closed: true });
    assert_eq!(refused([0.0, 1.0], &[on, Ends::Closed]), BoundaryError::NoRepeat { yarn: 0, axis: 'x' });
    let diagonal = Ends::Repeats([1, -2]);
    assert_eq!(
        refused([1.0, 0.0], &[diagonal, Ends::Closed]),
        BoundaryError::NoRepeat { yarn: 0, axis: 'y' }
    );
    assert_eq!(refused([1.0; 2], &[Ends::Repeats([0; 2]), Ends::Closed]), BoundaryError::NoWayOn { yarn: 0 });

    let boundary = Boundary::new(yarns.layout(), [1.5, 2.0], vec![diagonal, Ends::Closed]).unwrap();
    assert_eq!((boundary.onward_mm(0), boundary.onward_mm(1)), ([1.5, -4.0], [0.0; 2]));
    assert_eq!(Boundary::without_repeat(yarns.layout()).ends(), both);
    let other = one_yarn(Yarn::default(), &straight(3)).unwrap();
    assert_eq!(boundary.check(other.layout()), Err(BoundaryError::EndsCount { ends: 2, yarns: 1 }));
}

#[test]
fn references_to_what_is_not_there() {
    let error = one_yarn(Yarn { material: 3, ..Yarn::default() }, &straight(3)).unwrap_err();
    assert_eq!(error, YarnError::UnknownMaterial { yarn: 0, material: 3, materials: 1 });
    let error = one_yarn(Yarn { section: u32::MAX, ..Yarn::default() }, &straight(3)).unwrap_err();
    assert_eq!(error, YarnError::UnknownSection { yarn: 0, section: u32::MAX, sections: 1 });
    let mut yarns = one_yarn(Yarn::default(), &straight(3)).unwrap();
    assert_eq!(
        yarns.set_materials(vec![]),
        Err(YarnError::UnknownMaterial { yarn: 0, material: 0, materials: 0 })
    );
    assert_eq!(yarns.set_points(1, &straight(3)), Err(YarnError::UnknownYarn { yarn: 1, yarns: 1 }));
    assert_eq!(yarns.set_points(0, &straight(4)), Err(YarnError::PointCount { points: 4, planned: 3 }));
    let error = yarns.with_sources(vec![0; 4]).unwrap_err();
    assert_eq!(error, YarnError::SourceCount { sources: 4, points: 3 });
}

#[test]
fn fewer_points_than_the_layout_says() {
    let layout = Layout::new(vec![Yarn::default()], vec![0, 1 << 40], vec![Section::Circle]).unwrap();
    let error = Yarns::new(layout, vec![Material::default()], straight(3)).unwrap_err();
    assert_eq!(error, YarnError::PointCount { points: 3, planned: 1 << 40 });
}

#[test]
fn twists_out_of_range() {
    for twist in [f32::NAN, f32::INFINITY, 1001.0, -1001.0] {
        let error = one_yarn(Yarn { twist, ..Yarn::default() }, &straight(3)).unwrap_err();
        assert!(matches!(error, YarnError::Twist { yarn: 0, .. }), "{twist}: {error:?}");
    }
}

#[test]
fn hairiness_out_of_range() {
    for hairiness in [f32::NAN, f32::INFINITY, -0.1, 30.1] {
        let hairy = || vec![Material::default(), Material { hairiness, ..Material::default() }];
        let layout = Layout::new(vec![Yarn::default()], vec![0, 3], vec![Section::Circle]).unwrap();
        let given = Yarns::new(layout, hairy(), straight(3)).unwrap_err();
        assert!(matches!(given, YarnError::Hairiness { material: 1, limit: 30.0, .. }), "{given:?}");
        let mut yarns = one_yarn(Yarn::default(), &straight(3)).unwrap();
        let set = yarns.set_materials(hairy()).unwrap_err();
        assert!(matches!(set, YarnError::Hairiness { material: 1, .. }), "{set:?}");
    }
}

#[test]
fn linear_densities_out_of_range() {
    for tex in [f32::NAN, f32::INFINITY, -30.0, 0.0] {
        let materials = vec![Material::default(), Material { tex: Some(tex), ..Material::default() }];
        let layout = Layout::new(vec![Yarn::default()], vec![0, 3], vec![Section::Circle]).unwrap();
        let given = Yarns::new(layout, materials, straight(3)).unwrap_err();
        assert!(matches!(given, YarnError::LinearDensity { material: 1, .. }), "{given:?}");
    }
}

#[test]
fn sections_out_of_range() {
    let named = |section: Section, expected: &str| {
        let error = with_section(section.clone());
        assert!(
            matches!(error, SectionError::OutOfRange { field, .. } if field == expected),
            "{section:?}: {error:?}"
        );
    };
    for bad in [0.0, -1.0, 1e6, f32::NAN, f32::INFINITY] {
        named(Section::Ellipse { aspect: bad }, "aspect");
        named(Section::Lenticular { aspect: bad, distortion: 0.0 }, "aspect");
        named(Section::PowerEllipse { aspect: bad, exponent: 1.0 }, "aspect");
        named(Section::PowerEllipse { aspect: 1.0, exponent: bad }, "exponent");
    }
    for distortion in [1.0, -1.0, f32::NAN] {
        named(Section::Lenticular { aspect: 2.0, distortion }, "distortion");
    }
    for plies in [0, 1, 13, u32::MAX] {
        named(Section::plied(plies), "plies");
    }
    for valley in [0.49, 1.01, 0.0, f32::NAN] {
        named(Section::Lobed { plies: 2, valley }, "valley");
    }
    for bad in NOT_NUMBERS.into_iter().chain([1e9]) {
        named(Section::Polygon(vec![[0.0, 0.0], [1.0, 0.0], [bad, 1.0]]), "corner");
    }
}

#[test]
fn polygons_that_enclose_nothing() {
    let polygon = |corners: &[[f32; 2]]| with_section(Section::Polygon(corners.to_vec()));
    assert!(matches!(polygon(&[]), SectionError::Corners { corners: 0, .. }));
    assert!(matches!(polygon(&[[0.0, 0.0], [1.0, 0.0]]), SectionError::Corners { corners: 2, .. }));
    assert!(matches!(polygon(&vec![[0.0, 0.0]; 300]), SectionError::Corners { corners: 300, .. }));
    assert_eq!(
        polygon(&[[0.0, 0.0], [1.0, 0.0], [1.0, 0.0], [0.0, 1.0]]),
        SectionError::RepeatedCorner { corner: 1 }
    );
    assert_eq!(polygon(&[[0.0, 0.0], [0.0, 1.0], [1.0, 0.0]]), SectionError::Clockwise);
    let crossed = [[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]];
    assert_eq!(polygon(&crossed), SectionError::SelfIntersecting { first: 0, second: 2 });
    let flat = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]];
    assert!(matches!(polygon(&flat), SectionError::SelfIntersecting { .. } | SectionError::Clockwise));
}

#[test]
fn settings_out_of_range() {
    let usual = Settings::default();
    for tension in [-0.1, 1.0, 2.0, f32::NAN, f32::INFINITY] {
        let mut yarns = Yarns::builder();
        yarns.yarn(Yarn::default(), &straight(100)).tension(tension);
        let built = yarns.build().map(|_| ());
        let taken = one_yarn(Yarn::default(), &straight(100)).unwrap().with_tension(tension).map(|_| ());
        let layout = Layout::new(vec![Yarn::default()], vec![0, 100], vec![Section::Circle]).unwrap();
        for refused in [built, taken, layout.with_tension(tension).map(|_| ())] {
            let error = refused.unwrap_err();
            assert!(matches!(error, YarnError::Tension { .. }), "{tension}: {error:?}");
            assert_eq!(error.to_string(), format!("tension is {tension}, outside 0 to below 1"));
            assert_eq!(error.subject(), None);
        }
    }
    for sides in [0, 1, 2, 257, u32::MAX] {
        let error = with_settings(Settings { sides, ..usual });
        assert_eq!(error, PlanError::Sides { sides, low: 3, high: 256 });
    }
    for subdivisions in [1024, u32::MAX] {
        let error = with_settings(Settings { subdivisions, ..usual });
        assert_eq!(error, PlanError::Subdivisions { subdivisions, limit: 1023 });
    }
}

#[test]
fn a_polygon_needs_its_own_number_of_sides() {
    let mut yarns = Yarns::builder();
    yarns.section(Section::Polygon(vec![[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]]));
    yarns.yarn(Yarn::default(), &straight(3));
    let yarns = yarns.build().unwrap();
    assert_eq!(Pipeline::new(&yarns).plan().unwrap().settings().sides, 4);
    let error = Pipeline::new(&yarns).sides(6).plan().unwrap_err();
    let expected = PlanError::PolygonSides { section: 0, corners: 4, sides: 6 };
    assert!(matches!(error, PipelineError::Plan(error) if error == expected));
}

/// A plan needs only a layout, so these yarns take no memory for their points.
#[test]
fn more_rings_than_can_be_counted() {
    let plan = |offsets: Vec<u64>, subdivisions| {
        let yarns = vec![Yarn::default(); offsets.len() - 1];
        let layout = Layout::new(yarns, offsets, vec![Section::Circle]).unwrap();
        Plan::new(Arc::new(layout), Settings { subdivisions, ..Settings::default() }).unwrap_err()
    };
    let rings = (1_000_000_000 - 1) * 1000 + 1;
    assert_eq!(
        plan(vec![0, 1_000_000_000], 999),
        PlanError::YarnRings { yarn: 0, rings, limit: u32::MAX.into() }
    );
    assert!(matches!(plan(vec![0, u64::MAX], 0), PlanError::YarnRings { yarn: 0, .. }));
    assert!(matches!(plan(vec![0, 2, u64::MAX], 1023), PlanError::YarnRings { yarn: 1, .. }));
    // Each yarn can be counted, but all together can't.
    let many = (0..=40).map(|yarn| yarn * 4_000_000).collect();
    assert!(matches!(plan(many, 1000), PlanError::Rings { limit, .. } if limit == 1 << 36));
}

#[test]
fn limits_that_hold_no_block() {
    let yarns = one_yarn(Yarn::default(), &straight(100)).unwrap();
    for topology in [Topology::Indexed, Topology::Shared, Topology::None] {
        let settings = Settings { topology, caps: true, ..Settings::default() };
        let plan = Plan::new(yarns.layout().clone(), settings).unwrap();
        for limits in [
            Limits { blocks: 0, ..Limits::NONE },
            Limits { blocks: 1, ..Limits::NONE },
            Limits { binding_bytes: 0, ..Limits::NONE },
            Limits { binding_bytes: 1000, ..Limits::NONE },
            Limits { memory_bytes: 0, ..Limits::NONE },
            Limits { memory_bytes: plan.resident_bytes(), ..Limits::NONE },
        ] {
            let error = plan.chunks(&limits).unwrap_err();
            let (needed, limit) = match error {
                PlanError::BlockTooLarge { needed, limit, .. } if limits.blocks == u64::MAX => {
                    (needed, limit)
                }
                PlanError::BlockOverCount { needed, limit, what: "blocks", .. } => (needed, limit),
                other => panic!("{limits:?}: {other}"),
            };
            assert!(needed > limit, "{limits:?}");
            let through = Pipeline::new(&yarns).settings(settings).limits(limits);
            let Err(PipelineError::Plan(refusal)) = through.mesh(&NullBackend::default()) else {
                panic!("{error}")
            };
            assert_eq!(refusal, error);
        }
    }
}

/// The largest and the smallest numbers that are allowed give finite output, and normals of length
/// 1.
#[test]
fn the_edges_of_what_is_taken() {
    let line = |points: &[(f32, f32)]| -> Vec<ControlPoint> {
        points.iter().map(|&(at, radius)| ControlPoint::new(at, -at, at, radius)).collect()
    };
    let vast = line(&[(1e9, 3e4), (-1e9, 3e4), (1e9, 1e-4), (1e9, 3e4), (-1e9, 3e4)]);
    let tiny = line(&[(0.0, 1e-4), (1e-30, 1e-4), (1e-20, 1e-4), (1.0, 1e-4)]);
    // A step in the radius: a growth of up to 2.6e19, whose square f32 can't hold.
    let steep = line(&[(0.0, 1e-4), (1e-15, 3e4), (2e-15, 1e-4), (3e-15, 3e4)]);
    // Yarns as flat as allowed, lying flat and on edge.
    let flat = |points: &[ControlPoint], height: f32| -> Vec<ControlPoint> {
        points.iter().map(|point| point.flattened(point.half_width(), height)).collect()
    };
    let flattened = [&vast, &tiny, &steep].map(|points| [flat(points, 1e-4), flat(points, 3e4)]);
    for points in [vast, tiny, steep].into_iter().chain(flattened.into_iter().flatten()) {
        for twist in [1e3, -1e3] {
            let yarns = one_yarn(Yarn { twist, ..Yarn::default() }, &points).unwrap();
            let settings = Settings {
                subdivisions: 7,
                frame: Frame::RotationMinimizing,
                caps: true,
                ..Settings::default()
            };
            for device in able_devices(&yarns, &settings) {
                let mesh = Pipeline::new(&yarns).settings(settings).mesh(&*device).unwrap();
                for vertex in &mesh.vertices {
                    let [x, y, z] = vertex.normal.map(f64::from);
                    let length = (x * x + y * y + z * z).sqrt();
                    let sound =
                        vertex.position.iter().all(|at| at.is_finite()) && (length - 1.0).abs() < 1e-5;
                    assert!(sound, "{}: {vertex:?}", device.info().name);
                }
            }
        }
    }
}
