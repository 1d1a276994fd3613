//! Random yarns, written and read again.

use proptest::prelude::*;
use texere_core::{Boundary, ControlPoint, Ends, Material, Origin, Section, Yarn, Yarns};

use crate::round_trip::same;

/// A yarn, and how it ends.
#[derive(Debug, Clone)]
struct Made {
    points: Vec<ControlPoint>,
    ends: Ends,
    twist: f32,
    origin: Origin,
}

fn point() -> impl Strategy<Value = ControlPoint> {
    let axis = || prop_oneof![-1e9f32..=1e9, -1.0f32..=1.0, Just(-0.0), Just(f32::MIN_POSITIVE)];
    let size = || prop_oneof![1.1e-4f32..=3e4, 0.05f32..0.3];
    (axis(), axis(), axis(), size(), size())
        .prop_map(|(x, y, z, width, height)| ControlPoint::new(x, y, z, width).flattened(width, height))
}

fn made() -> impl Strategy<Value = Made> {
    let repeats = any::<[i32; 2]>().prop_filter("no way on", |repeats| *repeats != [0; 2]);
    let ends = prop_oneof![Just(Ends::Open), Just(Ends::Closed), repeats.prop_map(Ends::Repeats)];
    let origin = prop_oneof![
        Just(Origin::Unknown),
        any::<u32>().prop_map(Origin::End),
        any::<u32>().prop_map(Origin::Pick),
        any::<u32>().prop_map(Origin::Course),
        any::<u32>().prop_map(Origin::Carrier),
        any::<[u32; 2]>().prop_map(|[bar, guide]| Origin::Guide { bar, guide }),
    ];
    (prop::collection::vec(point(), 3..12), ends, -1e3f32..=1e3, origin)
        .prop_map(|(points, ends, twist, origin)| Made { points, ends, twist, origin })
}

fn material() -> impl Strategy<Value = Material> {
    use prop::num::f32::{NORMAL, POSITIVE, SUBNORMAL};
    let tex = prop::option::of(POSITIVE | NORMAL | SUBNORMAL);
    let bending = prop::option::of(1e-9f32..=1e6);
    (any::<String>(), any::<[u8; 3]>(), tex, 0f32..=30.0, bending)
        .prop_map(|(name, srgb, tex, hairiness, bending)| Material { name, srgb, tex, hairiness, bending })
}

fn section() -> impl Strategy<Value = Section> {
    let aspect = || 0.05f32..=20.0;
    prop_oneof![
        Just(Section::Circle),
        aspect().prop_map(|aspect| Section::Ellipse { aspect }),
        (aspect(), -0.9f32..=0.9).prop_map(|(aspect, distortion)| Section::Lenticular { aspect, distortion }),
        (aspect(), 0.1f32..=4.0).prop_map(|(aspect, exponent)| Section::PowerEllipse { aspect, exponent }),
        (2u32..=12).prop_map(Section::plied),
        (2u32..=12, 0.5f32..=1.0).prop_map(|(plies, valley)| Section::Lobed { plies, valley }),
        (0.1f32..100.0, 3u32..=256).prop_map(|(radius, count)| {
            let corner = |corner| (corner as f32 / count as f32 * std::f32::consts::TAU).sin_cos();
            Section::Polygon((0..count).map(corner).map(|(sin, cos)| [radius * cos, radius * sin]).collect())
        }),
    ]
}

fn direction() -> impl Strategy<Value = [f32; 3]> {
    let axis = || prop_oneof![-1f32..=1.0, -1e-20f32..=1e-20, Just(0.0)];
    [axis(), axis(), axis()].prop_filter("points nowhere", |[x, y, z]| x * x + y * y + z * z > 0.0)
}

proptest! {
    #[test]
    fn any_yarns_are_read_as_they_were_written(
        made in prop::collection::vec(made(), 1..6),
        materials in prop::collection::vec(material(), 1..4),
        sections in prop::collection::vec(section(), 1..4),
        repeat in [0.001f32..=1e9, 0.001f32..=1e9],
        ups in prop::option::of(prop::collection::vec(direction(), 72)),
        sources in prop::option::of(prop::collection::vec(any::<u32>(), 72)),
        tension in prop_oneof![Just(0.0f32), Just(-0.0), 0.0f32..1.0],
    ) {
        let mut yarns = Yarns::builder();
        yarns.tension(tension);
        let kinds = [materials.len() as u32, sections.len() as u32];
        for material in materials {
            yarns.material(material);
        }
        for section in sections {
            yarns.section(section);
        }
        for (number, Made { points, ends, twist, origin }) in (0..).zip(&made) {
            let [material, section] = kinds.map(|kinds| number % kinds);
            let closed = *ends == Ends::Closed;
            yarns.yarn(Yarn { material, section, closed, twist: *twist, origin: *origin }, points);
        }
        let mut yarns = yarns.build().unwrap();
        let count = yarns.points().len();
        if let Some(ups) = ups {
            yarns = yarns.with_ups(ups.into_iter().cycle().take(count).collect()).unwrap();
        }
        if let Some(sources) = sources {
            yarns = yarns.with_sources(sources.into_iter().cycle().take(count).collect()).unwrap();
        }
        let ends = made.iter().map(|made| made.ends).collect();
        let boundary = Boundary::new(yarns.layout(), repeat, ends).unwrap();
        same(&yarns, &boundary);
    }
}
