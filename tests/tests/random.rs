//! Random yarns: parallel output equals serial, and chunked equals whole, to the bit; and nothing
//! panics.

use std::sync::Arc;

use proptest::prelude::*;
use texere_conformance::DeferredBackend;
use texere_core::backend::{PaddedPoints, Plan, Trajectory};
use texere_core::{
    Backend, ControlPoint, Frame, Limits, Mesh, Pipeline, Quantum, Section, Settings, Topology, Vertex, Yarn,
    Yarns,
};
use texere_cpu::{ParallelBackend, SerialBackend};

/// Mostly round numbers, so that points often repeat, line up and double back.
fn coordinate() -> impl Strategy<Value = f32> {
    prop_oneof![6 => (-3i8..=3).prop_map(f32::from), 3 => -10.0f32..10.0, 1 => -1e6f32..1e6, 1 => Just(0.0)]
}

/// Numbers from the least to below the most. proptest 1.12 may fail an assertion of its own where
/// the lower bound of a range has finer binary digits than the upper one. Numbers are therefore
/// drawn from 0 on.
fn numbers(least: f32, most: f32) -> impl Strategy<Value = f32> {
    (0.0..most).prop_map(move |number| number.max(least))
}

fn point() -> impl Strategy<Value = ControlPoint> {
    let radius = prop_oneof![3 => Just(0.25f32), 2 => numbers(0.01, 2.0), 1 => numbers(1e-4, 3e4)];
    (coordinate(), coordinate(), coordinate(), radius)
        .prop_map(|(x, y, z, radius)| ControlPoint::new(x, y, z, radius))
}

fn section() -> impl Strategy<Value = Section> {
    prop_oneof![
        Just(Section::Circle),
        numbers(0.05, 20.0).prop_map(|aspect| Section::Ellipse { aspect }),
        (numbers(0.05, 20.0), -0.9f32..0.9)
            .prop_map(|(aspect, distortion)| Section::Lenticular { aspect, distortion }),
        (numbers(0.05, 20.0), numbers(0.1, 4.0))
            .prop_map(|(aspect, exponent)| Section::PowerEllipse { aspect, exponent }),
        (2u32..=12).prop_map(Section::plied),
        (2u32..=12, 0.5f32..=1.0).prop_map(|(plies, valley)| Section::Lobed { plies, valley }),
    ]
}

fn yarns() -> impl Strategy<Value = Yarns> {
    let twist = prop_oneof![3 => Just(0.0f32), 2 => -5.0f32..5.0, 1 => -1e3f32..1e3];
    let points = prop_oneof![4 => prop::collection::vec(point(), 3..20), 1 => prop::collection::vec(point(), 100..300)];
    let yarn = (points, any::<bool>(), twist, 0u32..2);
    let tension = prop_oneof![Just(0.0f32), 0.0f32..1.0];
    (prop::collection::vec(yarn, 1..6), [section(), section()], tension).prop_map(
        |(all, sections, tension)| {
            let mut yarns = Yarns::builder();
            yarns.tension(tension);
            for section in sections {
                yarns.section(section);
            }
            for (points, closed, twist, section) in all {
                yarns.yarn(Yarn { closed, twist, section, ..Yarn::default() }, &points);
            }
            yarns.build().unwrap()
        },
    )
}

fn settings() -> impl Strategy<Value = Settings> {
    let frame = prop_oneof![Just(Frame::Upright), Just(Frame::RotationMinimizing)];
    let topology = prop_oneof![Just(Topology::Indexed), Just(Topology::Shared), Just(Topology::None)];
    let quantum = prop_oneof![Just(Quantum::USUAL), numbers(1e-2, 1e7).prop_map(Quantum::reaching)];
    (0u32..9, 3u32..20, frame, topology, any::<bool>(), quantum).prop_map(
        |(subdivisions, sides, frame, topology, caps, quantum)| Settings {
            subdivisions,
            sides,
            frame,
            topology,
            caps,
            quantum,
        },
    )
}

fn run(yarns: &Yarns, settings: Settings, limits: Limits, device: &dyn Backend) -> (Mesh, Trajectory) {
    let pipeline = || Pipeline::new(yarns).settings(settings).limits(limits);
    (pipeline().mesh(device).unwrap(), pipeline().trajectory(device).unwrap())
}

/// Vertices in the order of the whole, and the corners of all triangles, as bits.
fn normal_form(mesh: &Mesh) -> (Vec<u8>, Vec<Vec<u8>>) {
    let sides = mesh.plan.settings().sides as usize;
    let offsets = mesh.plan.ring_offsets();
    let mut whole = vec![Vertex::default(); mesh.plan.counts().rings as usize * sides];
    for chunk in &mesh.chunks {
        for part in chunk.parts() {
            let from = (chunk.first_vertex() + u64::from(part.first_vertex)) as usize;
            let to = (offsets[part.yarn as usize] + u64::from(part.first_ring)) as usize * sides;
            let count = part.rings as usize * sides;
            whole[to..to + count].copy_from_slice(&mesh.vertices[from..from + count]);
        }
    }
    let corner = |vertex: u64| bytemuck::bytes_of(&mesh.vertices[vertex as usize]).to_vec();
    let mut triangles: Vec<_> = mesh.triangles().map(|triangle| triangle.map(corner).concat()).collect();
    triangles.sort_unstable();
    (bytemuck::cast_slice(&whole).to_vec(), triangles)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn parallel_and_deferred_equal_serial(yarns in yarns(), settings in settings()) {
        let (mesh, trajectory) = run(&yarns, settings, Limits::NONE, &SerialBackend::new());
        let bytes = |trajectory: &Trajectory| bytemuck::cast_slice::<_, u8>(&trajectory.rings).to_vec();
        for device in ParallelBackend::each() {
            let (other, other_trajectory) = run(&yarns, settings, Limits::NONE, &device);
            prop_assert!(bytemuck::cast_slice::<_, u8>(&mesh.vertices) == bytemuck::cast_slice::<_, u8>(&other.vertices));
            prop_assert_eq!(&mesh.indices, &other.indices);
            let packed = |device: &dyn Backend| Pipeline::new(&yarns).settings(settings).packed(device).unwrap();
            prop_assert!(packed(&SerialBackend::new()) == packed(&device));
            prop_assert!(bytes(&trajectory) == bytes(&other_trajectory));
        }
        let (other, other_trajectory) = run(&yarns, settings, Limits::NONE, &DeferredBackend::new());
        prop_assert!(normal_form(&mesh) == normal_form(&other));
        prop_assert!(bytes(&trajectory) == bytes(&other_trajectory));
    }

    #[test]
    fn chunked_equals_whole(yarns in yarns(), settings in settings(), blocks in 2u64..9, squeeze in 1u64..4) {
        let plan = Plan::new(yarns.layout().clone(), settings).unwrap();
        // Limits that suffice for any single block, and by chance for a few blocks.
        let block = 66 * u64::from(settings.sides) * 24 * squeeze;
        let limits = Limits { blocks, memory_bytes: plan.resident_bytes() + 6 * block + 20_000, ..Limits::NONE };
        for device in [&SerialBackend::new() as &dyn Backend, &ParallelBackend::open().unwrap()] {
            let (whole, trajectory) = run(&yarns, settings, Limits::NONE, device);
            let (cut, cut_trajectory) = run(&yarns, settings, limits, device);
            prop_assert!(normal_form(&whole) == normal_form(&cut));
            let bytes = |trajectory: &Trajectory| bytemuck::cast_slice::<_, u8>(&trajectory.rings).to_vec();
            prop_assert!(bytes(&trajectory) == bytes(&cut_trajectory));
        }
    }

    /// Boxes that are made from control points alone hold every vertex: of the cloth, of its yarns,
    /// and of any part of a yarn.
    #[test]
    fn bounds_hold_every_vertex(yarns in yarns(), settings in settings(), from in 0.0f64..1.0, to in 0.0f64..=1.0) {
        let device = ParallelBackend::open().unwrap();
        let mesh = Pipeline::new(&yarns).settings(settings).mesh(&device).unwrap();
        let (plan, sides) = (&mesh.plan, settings.sides as usize);
        let mut points = PaddedPoints::new(plan).unwrap();
        points.upload(plan, 0, yarns.points());
        let cloth = plan.bounds(&points);
        let chunk = &mesh.chunks[0];
        for vertex in &mesh.vertices {
            prop_assert!(cloth.holds(vertex.position), "{:?} is not in {:?}", vertex, cloth);
        }
        for part in chunk.parts() {
            let (yarn, rings) = (part.yarn as usize, f64::from(part.rings));
            let bounds = plan.yarn_bounds(&points, yarn);
            let vertices = &mesh.vertices[part.first_vertex as usize..][..part.rings as usize * sides];
            for vertex in vertices {
                prop_assert!(bounds.holds(vertex.position), "{:?} is not in {:?} of yarn {}", vertex, bounds, yarn);
            }
            let [one, other] = [from, to].map(|share| (share * rings) as u32);
            for rings in [one.min(other)..one.max(other), one..one + 1, part.rings - 1..part.rings] {
                let bounds = plan.part_bounds(&points, yarn, rings.clone());
                let vertices = vertices.chunks_exact(sides).enumerate().filter(|(ring, _)| rings.contains(&(*ring as u32)));
                for vertex in vertices.flat_map(|(_, ring)| ring) {
                    prop_assert!(bounds.holds(vertex.position), "{:?} is not in {:?} of {}, {:?}", vertex, bounds, yarn, rings);
                }
            }
        }
        for cap in chunk.caps() {
            let bounds = plan.yarn_bounds(&points, cap.yarn as usize);
            let vertices = &mesh.vertices[cap.first_vertex as usize..][..sides];
            prop_assert!(vertices.iter().all(|vertex| bounds.holds(vertex.position)));
        }
    }

    /// Any yarns that are allowed give finite numbers, tangents and normals of length 1, and radii
    /// above zero.
    #[test]
    fn output_is_sound(yarns in yarns(), settings in settings()) {
        let (mesh, trajectory) = run(&yarns, settings, Limits::NONE, &ParallelBackend::open().unwrap());
        let length = |v: [f32; 3]| v.map(f64::from).iter().map(|x| x * x).sum::<f64>().sqrt();
        for ring in &trajectory.rings {
            prop_assert!(ring.centre.iter().all(|x| x.is_finite()) && ring.half_width.is_finite() && ring.half_width > 0.0);
            prop_assert!((length(ring.tangent) - 1.0).abs() < 1e-5, "{:?}", ring);
        }
        for vertex in &mesh.vertices {
            prop_assert!(vertex.position.iter().all(|x| x.is_finite()));
            prop_assert!((length(vertex.normal) - 1.0).abs() < 1e-5, "{:?}", vertex);
        }
        let plan = Arc::clone(&mesh.plan);
        prop_assert_eq!(mesh.triangles().count() as u64, match settings.topology {
            Topology::None => 0,
            _ => plan.counts().triangles,
        });
    }
}
