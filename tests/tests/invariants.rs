//! Properties of every tube: closed where it should be, facing outward, and of the right volume.

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::{PI, TAU};

use glam::DVec3;
use texere_conformance::cases::{sections, winding};
use texere_core::backend::Session;
use texere_core::{ControlPoint, Frame, Mesh, Pipeline, Section, Settings, Topology, Yarn, Yarns};
use texere_cpu::{ParallelBackend, SerialBackend};

const FRAMES: [Frame; 2] = [Frame::Upright, Frame::RotationMinimizing];

fn mesh(yarns: &Yarns, settings: Settings) -> Mesh {
    Pipeline::new(yarns).settings(settings).mesh(&ParallelBackend::open().unwrap()).unwrap()
}

fn place(position: [f32; 3]) -> DVec3 {
    DVec3::from_array(position.map(f64::from))
}

/// Triangles in which corners that coincide to the bit are one. The yarns of these tests never
/// touch: only the last ring of a closed yarn and the rim of a cap coincide with anything.
fn welded(mesh: &Mesh) -> Vec<[usize; 3]> {
    let mut numbers = BTreeMap::new();
    let weld: Vec<usize> = mesh
        .vertices
        .iter()
        .map(|vertex| {
            let next = numbers.len();
            *numbers.entry(vertex.position.map(f32::to_bits)).or_insert(next)
        })
        .collect();
    mesh.triangles().map(|triangle| triangle.map(|corner| weld[corner as usize])).collect()
}

/// Euler characteristic: vertices less edges plus faces. It is 2 for a ball and 0 for a ring.
///
/// # Panics
///
/// If the surface has an open edge, an edge of more than two triangles, or neighbours that face
/// differently.
fn euler_number(triangles: &[[usize; 3]]) -> i64 {
    let mut edges = BTreeSet::new();
    for &[a, b, c] in triangles {
        for edge in [(a, b), (b, c), (c, a)] {
            assert!(edges.insert(edge), "edge {edge:?} is there twice the same way");
        }
    }
    for &(a, b) in &edges {
        assert!(edges.contains(&(b, a)), "edge {a} to {b} is open");
    }
    let vertices: BTreeSet<_> = triangles.iter().flatten().collect();
    vertices.len() as i64 - edges.len() as i64 / 2 + triangles.len() as i64
}

/// Settings that together have both topologies with indices, both frames, few and many sides.
fn settings() -> Vec<Settings> {
    let mut all = Vec::new();
    for frame in FRAMES {
        for topology in [Topology::Indexed, Topology::Shared] {
            for (sides, subdivisions) in [(3, 0), (6, 1), (17, 4)] {
                let usual = Settings { caps: true, ..Settings::default() };
                all.push(Settings { frame, topology, sides, subdivisions, ..usual });
            }
        }
    }
    all
}

#[test]
fn a_capped_yarn_is_a_ball_and_a_closed_one_a_ring() {
    for (closed, expected) in [(false, 2), (true, 0)] {
        for twist in [0.0, 0.9] {
            let yarns = winding(40, Yarn { closed, twist, ..Yarn::default() });
            for settings in settings() {
                let euler = euler_number(&welded(&mesh(&yarns, settings)));
                assert_eq!(euler, expected, "closed: {closed}, {settings:?}");
            }
        }
    }
}

#[test]
fn every_section_is_closed_by_its_caps() {
    for (name, section) in sections() {
        for sides in [3, 4, 11, 48, 256] {
            let mut yarns = Yarns::builder();
            yarns.section(section.clone());
            yarns.yarn(Yarn::default(), winding(9, Yarn::default()).points());
            let settings = Settings { sides, caps: true, ..Settings::default() };
            let mesh = mesh(&yarns.build().unwrap(), settings);
            assert_eq!(euler_number(&welded(&mesh)), 2, "{name}, {sides} sides");
        }
    }
}

#[test]
#[should_panic(expected = "is open")]
fn an_uncapped_yarn_is_open() {
    let yarns = winding(10, Yarn::default());
    euler_number(&welded(&mesh(&yarns, Settings::default())));
}

#[test]
fn triangles_and_normals_face_outward_and_have_area() {
    for closed in [false, true] {
        let yarns = winding(60, Yarn { closed, twist: 0.4, ..Yarn::default() });
        for settings in settings() {
            let mesh = mesh(&yarns, settings);
            // Bound for a triangle as wide as a side and as long as the step from ring to ring,
            // with a large margin.
            let least = 1e-4 / f64::from(settings.sides * (settings.subdivisions + 1));
            for triangle in mesh.triangles() {
                let corners = triangle.map(|corner| &mesh.vertices[corner as usize]);
                let [a, b, c] = corners.map(|corner| place(corner.position));
                let twice_area = (b - a).cross(c - a);
                assert!(twice_area.length() > least, "{settings:?}: {triangle:?} has no area");
                for corner in corners {
                    let normal = place(corner.normal);
                    assert!(twice_area.dot(normal) > 0.0, "{settings:?}: {triangle:?} faces inward");
                }
            }
        }
    }
}

/// Volume by the divergence theorem.
fn volume(mesh: &Mesh) -> f64 {
    let corner = |number: u64| place(mesh.vertices[number as usize].position);
    mesh.triangles().map(|[a, b, c]| corner(a).dot(corner(b).cross(corner(c))) / 6.0).sum()
}

#[test]
fn a_straight_tube_holds_its_sections_area_times_its_length() {
    let ends = [ControlPoint::new(1.0, 2.0, 3.0, 0.25), ControlPoint::new(3.0, 5.0, 9.0, 0.25)];
    let (length, radius) = (7.0, 0.25);
    let polygon = vec![[-1.0, -1.0], [1.0, -1.0], [1.0, -0.25], [-0.25, -0.25], [-0.25, 1.0], [-1.0, 1.0]];
    let straight = |section: Section, sides| {
        let mut yarns = Yarns::builder();
        yarns.section(section);
        yarns.yarn(Yarn::default(), &ends);
        let settings = Settings { sides, caps: true, subdivisions: 3, ..Settings::default() };
        volume(&mesh(&yarns.build().unwrap(), settings)) / (length * radius * radius)
    };
    for sides in [3u32, 6, 7, 64] {
        // Area of a regular polygon in the unit circle.
        let area = f64::from(sides) / 2.0 * (TAU / f64::from(sides)).sin();
        assert!((straight(Section::Circle, sides) - area).abs() < 1e-5, "{sides} sides");
        let ellipse = straight(Section::Ellipse { aspect: 3.0 }, sides);
        assert!((ellipse - area).abs() < 1e-5, "{sides} sides, squeezed");
    }
    assert!((straight(Section::Polygon(polygon), 6) - 2.4375).abs() < 1e-5);
    // Every other section has the area of the round one, so that a yarn keeps its weight.
    for (name, section) in sections() {
        let area = straight(section, 256);
        assert!((area / PI - 1.0).abs() < 2e-3, "{name}: {area}");
    }
}

/// Twist turns the section about the yarn by its angle. It leaves the first ring as it is, and all
/// vertices at the same distance from the yarn's axis.
#[test]
fn twist_keeps_volume_and_rings() {
    let straight: Vec<_> = (0..40).map(|k| ControlPoint::new(k as f32 * 0.25, 0.0, 0.0, 0.25)).collect();
    let build = |twist: f32| {
        let mut yarns = Yarns::builder();
        yarns.yarn(Yarn { twist, ..Yarn::default() }, &straight);
        mesh(&yarns.build().unwrap(), Settings { caps: true, ..Settings::default() })
    };
    let (plain, twisted) = (build(0.0), build(0.5));
    assert_eq!(plain.vertices[..6], twisted.vertices[..6]);
    let radius = |vertex: &texere_core::Vertex| place(vertex.position).with_x(0.0).length();
    assert!(twisted.vertices.iter().all(|vertex| (radius(vertex) - 0.25).abs() < 1e-6));
    let ring = 8;
    let (before, after) = (place(plain.vertices[ring * 6].normal), place(twisted.vertices[ring * 6].normal));
    let turned = before.cross(after).x.atan2(before.dot(after));
    // Eight rings, an eighth of a millimetre apart: 1 mm, half a radian, right-handed about +x.
    assert!((turned - 0.5).abs() < 1e-5, "{turned}");
}

/// Edits that each send the points of one yarn give the output of a fresh session with the same
/// points.
#[test]
fn an_edited_yarn_is_as_good_as_a_new_one() {
    use std::sync::Arc;
    use texere_core::backend::{MeshMut, Plan};
    use texere_core::{Backend, Limits, Vertex};

    let mut yarns = texere_conformance::cases::mixed();
    let settings = Settings { frame: Frame::RotationMinimizing, ..Settings::default() };
    let plan = Arc::new(Plan::new(yarns.layout().clone(), settings).unwrap());
    let chunk = plan.chunks(&Limits::NONE).unwrap().next().unwrap();
    let run = |session: &mut Session| {
        session.scan().unwrap();
        let mut vertices = vec![Vertex::default(); chunk.vertices() as usize];
        let mut indices = vec![0; chunk.indices() as usize];
        session.mesh_into(&chunk, MeshMut { vertices: &mut vertices, indices: &mut indices }).unwrap();
        vertices
    };
    for device in [&SerialBackend::new() as &dyn Backend, &ParallelBackend::open().unwrap()] {
        let mut edited = Session::new(device, plan.clone()).unwrap();
        edited.upload(0, yarns.points()).unwrap();
        let before = run(&mut edited);
        for yarn in [0, 9, 20] {
            let range = yarns.range(yarn).unwrap();
            let moved: Vec<_> = yarns.points()[range.clone()]
                .iter()
                .map(|point| {
                    ControlPoint { z: point.z * 1.5 + 0.25, ..*point }
                        .flattened(point.half_width() * 0.75, point.half_height() * 0.75)
                })
                .collect();
            yarns.set_points(yarn, &moved).unwrap();
            edited.upload(range.start as u64, &moved).unwrap();
        }
        let mut fresh = Session::new(device, plan.clone()).unwrap();
        fresh.upload(0, yarns.points()).unwrap();
        let (edited, fresh) = (run(&mut edited), run(&mut fresh));
        assert!(bytemuck::cast_slice::<Vertex, u8>(&edited) == bytemuck::cast_slice::<Vertex, u8>(&fresh));
        assert!(bytemuck::cast_slice::<Vertex, u8>(&before) != bytemuck::cast_slice::<Vertex, u8>(&fresh));
    }
}

#[test]
fn sixteen_bits_hold_all_shared_indices_or_there_are_none() {
    // More gaps than the pattern covers, so that its highest index depends on the sides alone.
    let yarns = winding(5_000, Yarn::default());
    for (sides, fit) in [(6, true), (7, true), (8, false), (12, false)] {
        let settings = Settings { sides, topology: Topology::Shared, ..Settings::default() };
        let plan = Pipeline::new(&yarns).settings(settings).plan().unwrap();
        let wide = plan.shared_indices();
        assert_eq!(wide.iter().all(|index| *index < 1 << 16), fit, "{sides} sides");
        let narrow = plan.shared_indices_u16();
        assert_eq!(narrow.is_some(), fit, "{sides} sides");
        assert!(narrow.is_none_or(|narrow| narrow.into_iter().map(u32::from).eq(wide)), "{sides} sides");
    }
}
