//! Chunked output equals whole output. Parts cover every ring once, apart from rings that a cut
//! repeats. The vertices of a part are those of its rings in the whole. The triangles are the same,
//! if each corner is named by yarn, ring and point of the section.

use std::sync::Arc;

use texere_conformance::cases::{mixed, winding};
use texere_conformance::compare::Report;
use texere_conformance::drive::{DeviceOutput, Way, drive};
use texere_conformance::limits::least;
use texere_conformance::schedule::able_devices;
use texere_core::backend::{Block, Chunk, MeshMut, Plan, Session, WINDOW_POINTS};
use texere_core::definitions::Ring;
use texere_core::{
    ControlPoint, End, Frame, Limits, Mesh, Pipeline, Settings, Topology, Vertex, Yarn, Yarns,
};
use texere_cpu::SerialBackend;

const TOPOLOGIES: [Topology; 3] = [Topology::Indexed, Topology::Shared, Topology::None];

/// Open and closed, short and long yarns of many sections in one fabric; and single yarns, open and
/// closed, of 64 to 400 points.
fn fabrics() -> Vec<(String, Yarns)> {
    let mut fabrics = vec![("mixed".into(), mixed())];
    for closed in [false, true] {
        for points in [64, 65, 130, 400] {
            let yarn = Yarn { closed, twist: 0.7, ..Yarn::default() };
            fabrics.push((format!("{points} points, closed: {closed}"), winding(points, yarn)));
        }
    }
    fabrics
}

fn settings() -> Vec<Settings> {
    let mut all = Vec::new();
    for topology in TOPOLOGIES {
        for caps in [false, true] {
            for (subdivisions, sides, frame) in
                [(0, 3, Frame::Upright), (1, 6, Frame::RotationMinimizing), (6, 5, Frame::RotationMinimizing)]
            {
                all.push(Settings { topology, caps, subdivisions, sides, frame, ..Settings::default() });
            }
        }
    }
    all
}

/// Limits down to one block. Each kind of limit is tight by itself, for one block and for a few
/// blocks. The last limits are all tight.
fn limits(plan: &Plan) -> Vec<Limits> {
    let by_blocks = |blocks| Limits { blocks, ..Limits::NONE };
    let by_binding = |binding_bytes| Limits { binding_bytes, ..Limits::NONE };
    let by_memory = |memory_bytes| Limits { memory_bytes, ..Limits::NONE };
    let (binding, memory) = (least(plan, by_binding), least(plan, by_memory));
    let blocks_memory = memory - plan.resident_bytes();
    vec![
        by_blocks(least(plan, by_blocks)),
        by_blocks(3),
        by_blocks(7),
        by_binding(binding),
        by_binding(4 * binding),
        by_memory(memory),
        by_memory(plan.resident_bytes() + 4 * blocks_memory),
        Limits {
            blocks: 5,
            binding_bytes: 2 * binding,
            memory_bytes: plan.resident_bytes() + 3 * blocks_memory,
        },
    ]
}

/// Calls `check` for every fabric, settings and limits.
fn for_all(check: impl Fn(&str, &Yarns, &Arc<Plan>, &Limits)) {
    for (name, yarns) in fabrics() {
        for settings in settings() {
            let plan = Arc::new(Plan::new(yarns.layout().clone(), settings).unwrap());
            for limits in limits(&plan) {
                check(&format!("{name}, {settings:?}, {limits:?}"), &yarns, &plan, &limits);
            }
        }
    }
}

fn chunks(plan: &Plan, limits: &Limits) -> Vec<Chunk> {
    plan.chunks(limits).unwrap().collect()
}

#[test]
fn limits_do_cut() {
    for_all(|name, _, plan, limits| {
        let count = chunks(plan, limits).len() as u64;
        assert!(count <= plan.block_count(), "{name}: {count} chunks");
        let least = plan.block_count().div_ceil(limits.blocks);
        assert!(count >= least, "{name}: {count} chunks");
        assert!(plan.chunks(&Limits::NONE).unwrap().count() == 1, "{name}");
    });
    let (_, yarns) = &fabrics()[0];
    let plan = Plan::new(yarns.layout().clone(), Settings::default()).unwrap();
    assert!(limits(&plan).iter().all(|limits| chunks(&plan, limits).len() > 1));
}

#[test]
fn parts_cover_every_ring_once() {
    for_all(|name, _, plan, limits| {
        let (mut yarn, mut ring) = (0, 0);
        for (number, chunk) in chunks(plan, limits).iter().enumerate() {
            assert_eq!(chunk.index(), number as u64, "{name}");
            let mut rings = 0;
            for (at, part) in chunk.parts().iter().enumerate() {
                assert_eq!((part.yarn, part.first_ring), (yarn, ring), "{name}");
                assert_eq!(part.first_vertex, rings * plan.settings().sides, "{name}");
                rings += part.rings;
                // The ring that a cut repeats is the first of the next chunk, even if it is the
                // last ring of a yarn.
                let again = u32::from(chunk.repeats_ring() && at + 1 == chunk.parts().len());
                assert!(part.rings > again, "{name}");
                ring += part.rings - again;
                if ring == plan.rings(yarn as usize) {
                    (yarn, ring) = (yarn + 1, 0);
                } else {
                    assert_eq!(again, 1, "{name}: yarn {yarn} breaks off at ring {ring}");
                }
            }
            assert_eq!(rings, chunk.rings(), "{name}");
        }
        assert_eq!((yarn as usize, ring), (plan.layout().yarns().len(), 0), "{name}");
    });
}

#[test]
fn caps_come_once_for_each_open_end() {
    for_all(|name, _, plan, limits| {
        let mut caps = Vec::new();
        for chunk in chunks(plan, limits) {
            let mut vertex = chunk.rings() * plan.settings().sides;
            for cap in chunk.caps() {
                assert_eq!(cap.first_vertex, vertex, "{name}: after all tube vertices");
                vertex += plan.settings().sides;
                let ring = cap.chunk_ring;
                let part = chunk.parts().iter().find(|part| part.yarn == cap.yarn).unwrap();
                let own = ring - part.first_vertex / plan.settings().sides + part.first_ring;
                let end = if cap.end == End::Start { 0 } else { plan.rings(cap.yarn as usize) - 1 };
                assert_eq!(own, end, "{name}: {cap:?}");
                caps.push((cap.yarn as usize, cap.end == End::Finish));
            }
            assert_eq!(vertex, chunk.vertices(), "{name}");
        }
        let open = |&yarn: &usize| plan.settings().caps && !plan.layout().yarns()[yarn].closed;
        let yarns = (0..plan.layout().yarns().len()).filter(open);
        let expected: Vec<_> = yarns.flat_map(|yarn| [(yarn, false), (yarn, true)]).collect();
        assert_eq!(caps, expected, "{name}");
    });
}

#[test]
fn chunks_stay_within_their_limits() {
    for_all(|name, _, plan, limits| {
        for chunk in chunks(plan, limits) {
            let bytes = |count: u64, each: usize| count * each as u64;
            let buffers = [
                bytes(chunk.vertices().into(), size_of::<Vertex>()),
                bytes(chunk.indices().into(), 4),
                bytes(chunk.rings().into(), size_of::<Ring>()),
                bytes(chunk.blocks().len() as u64, size_of::<Block>()),
            ];
            let window = bytes(chunk.window().end - chunk.window().start, size_of::<ControlPoint>());
            assert!(buffers.iter().chain([&window]).all(|&buffer| buffer <= limits.binding_bytes), "{name}");
            let memory = plan.resident_bytes() + 2 * buffers.iter().sum::<u64>();
            assert!(memory <= limits.memory_bytes, "{name}: {memory}");
            assert!(chunk.blocks().len() as u64 <= limits.blocks, "{name}");
        }
    });
}

#[test]
fn windows_hold_every_point_that_is_read() {
    for_all(|name, _, plan, limits| {
        let per_interval = plan.settings().subdivisions + 1;
        for chunk in chunks(plan, limits) {
            assert_eq!(chunk.window().start % WINDOW_POINTS, 0, "{name}");
            assert!(chunk.window().end <= *plan.padded_offsets().last().unwrap(), "{name}");
            for part in chunk.parts() {
                let (yarn, padded) = (part.yarn as usize, plan.padded_offsets()[part.yarn as usize]);
                for ring in part.first_ring..part.first_ring + part.rings {
                    let open_end = !plan.yarn(yarn).closed && ring + 1 == plan.rings(yarn);
                    let interval = padded + u64::from(ring / per_interval - u32::from(open_end));
                    let read = interval..interval + 4;
                    let within = chunk.window().start <= read.start && read.end <= chunk.window().end;
                    assert!(
                        within,
                        "{name}: ring {ring} of yarn {yarn} reads {read:?} of {:?}",
                        chunk.window()
                    );
                }
            }
        }
    });
}

#[test]
fn the_block_table_says_the_same_as_the_parts() {
    for_all(|name, _, plan, limits| {
        let (sides, per_interval) = (plan.settings().sides, plan.settings().subdivisions + 1);
        for chunk in chunks(plan, limits) {
            let mut rows = chunk.blocks().iter();
            let (mut ring, mut index) = (0, 0);
            for part in chunk.parts() {
                assert_eq!(part.first_index, index, "{name}");
                let mut own = 0;
                while own < part.rings {
                    let row = rows.next().unwrap();
                    let place = (row.yarn, row.first_ring, row.chunk_ring, row.first_vertex, row.first_index);
                    let first = part.first_ring + own;
                    assert_eq!(place, (part.yarn, first, ring, ring * sides, index), "{name}");
                    let point = plan.padded_offsets()[part.yarn as usize] + u64::from(first / per_interval);
                    assert_eq!(chunk.window().start + u64::from(row.first_point), point, "{name}");
                    assert!((1..=64).contains(&row.rings), "{name}");
                    own += row.rings;
                    ring += row.rings;
                    // Each ring of a part, except the last one, has quads to the ring after it.
                    assert_eq!(row.quads, row.rings - u32::from(own == part.rings), "{name}");
                    if plan.settings().topology == Topology::Indexed {
                        index += row.quads * sides * 6;
                    }
                }
                assert_eq!(own, part.rings, "{name}");
            }
            assert!(rows.next().is_none(), "{name}");
        }
    });
}

fn run(yarns: &Yarns, plan: &Arc<Plan>, limits: &Limits) -> DeviceOutput {
    let mut report = Report::default();
    let output = drive(&SerialBackend::new(), plan, yarns, limits, Way::Into, &mut report).unwrap();
    assert!(report.is_clean(), "{report}");
    output
}

#[test]
fn each_part_holds_its_ring_range_of_the_whole() {
    for_all(|name, yarns, plan, limits| {
        let sides = plan.settings().sides as usize;
        let whole = run(yarns, plan, &Limits::NONE);
        let cut = run(yarns, plan, limits);
        let [mesh] = &whole.meshes[..] else { panic!("{name}: the whole is {} chunks", whole.chunks.len()) };
        for (chunk, own) in cut.chunks.iter().zip(&cut.meshes) {
            for part in chunk.parts() {
                let from = plan.ring_offsets()[part.yarn as usize] as usize + part.first_ring as usize;
                let (rings, vertices) = (part.rings as usize, part.rings as usize * sides);
                let first = part.first_vertex as usize;
                let same = bits(&own.vertices[first..first + vertices])
                    == bits(&mesh.vertices[from * sides..][..vertices])
                    && bits(&own.rings[first / sides..][..rings]) == bits(&mesh.rings[from..][..rings]);
                assert!(same, "{name}: {part:?}");
            }
            for cap in chunk.caps() {
                let twin = whole.chunks[0]
                    .caps()
                    .iter()
                    .find(|other| (other.yarn, other.end) == (cap.yarn, cap.end));
                let from = twin.unwrap().first_vertex as usize;
                let own = &own.vertices[cap.first_vertex as usize..][..sides];
                assert!(bits(own) == bits(&mesh.vertices[from..][..sides]), "{name}: {cap:?}");
            }
        }
    });
}

fn bits<T: bytemuck::Pod>(values: &[T]) -> &[u8] {
    bytemuck::cast_slice(values)
}

/// A corner of a triangle: the yarn, the number of the ring, and the point of the section. Corners
/// of caps have numbers beyond those of all rings.
type Corner = (u32, u64, u64);

/// All triangles, by corners that do not depend on chunks.
fn drawn(mesh: &Mesh) -> Vec<[Corner; 3]> {
    let sides = u64::from(mesh.plan.settings().sides);
    let mut corners = vec![None; mesh.vertices.len()];
    for chunk in &mesh.chunks {
        let mut name = |first: u32, count: u64, corner: &dyn Fn(u64) -> Corner| {
            let first = (chunk.first_vertex() + u64::from(first)) as usize;
            for at in 0..count {
                corners[first + at as usize] = Some(corner(at));
            }
        };
        for part in chunk.parts() {
            let ring = |at: u64| (part.yarn, u64::from(part.first_ring) + at / sides, at % sides);
            name(part.first_vertex, u64::from(part.rings) * sides, &ring);
        }
        for cap in chunk.caps() {
            let end = u64::MAX - u64::from(cap.end == End::Start);
            name(cap.first_vertex, sides, &|at| (cap.yarn, end, at));
        }
    }
    let mut triangles: Vec<_> =
        mesh.triangles().map(|triangle| triangle.map(|vertex| corners[vertex as usize].unwrap())).collect();
    triangles.sort_unstable();
    triangles
}

#[test]
fn draws_make_the_triangles_of_the_whole() {
    for_all(|name, yarns, plan, limits| {
        let mesh = |limits: &Limits| {
            Pipeline::new(yarns)
                .settings(*plan.settings())
                .limits(*limits)
                .mesh(&SerialBackend::new())
                .unwrap()
        };
        let indexed = Settings { topology: Topology::Indexed, ..*plan.settings() };
        let whole = Pipeline::new(yarns).settings(indexed).mesh(&SerialBackend::new()).unwrap();
        let cut = mesh(limits);
        if plan.settings().topology == Topology::None {
            assert_eq!(cut.draws().count(), 0, "{name}");
            return;
        }
        let (expected, actual) = (drawn(&whole), drawn(&cut));
        assert_eq!(actual.len() as u64, plan.counts().triangles, "{name}");
        assert!(expected == actual, "{name}");
        for draw in cut.draws() {
            let indices = &cut.indices[draw.indices.start as usize..draw.indices.end as usize];
            assert!(indices.iter().all(|&index| u64::from(index) < draw.vertices), "{name}: {draw:?}");
        }
    });
}

/// A yarn that has more gaps between rings than the shared pattern covers takes several draws. Its
/// triangles are those of an indexed mesh, which has more than twice as many indices.
#[test]
fn a_yarn_longer_than_the_shared_pattern_is_drawn_in_several_goes() {
    let yarns = winding(1_000, Yarn::default());
    let settings =
        Settings { subdivisions: 19, topology: Topology::Shared, caps: true, ..Settings::default() };
    let shared = Pipeline::new(&yarns).settings(settings).mesh(&SerialBackend::new()).unwrap();
    let indexed = Settings { topology: Topology::Indexed, ..settings };
    let indexed = Pipeline::new(&yarns).settings(indexed).mesh(&SerialBackend::new()).unwrap();
    assert!(shared.draws().count() > 3);
    assert!(shared.indices.len() < indexed.indices.len() / 2);
    assert!(drawn(&shared) == drawn(&indexed));
}

/// A session takes chunks of one cut and then of another, although their numbers are the same.
#[test]
fn chunks_of_two_cuts_do_not_mix() {
    let yarns = winding(400, Yarn { twist: 0.7, ..Yarn::default() });
    let settings = Settings { frame: Frame::RotationMinimizing, ..Settings::default() };
    let plan = Arc::new(Plan::new(yarns.layout().clone(), settings).unwrap());
    for device in able_devices(&yarns, &settings) {
        let cut = |blocks| chunks(&plan, &device.info().limits.min(&Limits { blocks, ..Limits::NONE }));
        let (fine, coarse) = (cut(2), cut(4));
        let mut session = Session::new(&*device, plan.clone()).unwrap();
        session.upload(0, yarns.points()).unwrap();
        session.scan().unwrap();
        let mesh = |session: &mut Session, chunk: &Chunk| {
            let mut vertices = vec![Vertex::default(); chunk.vertices() as usize];
            let mut indices = vec![0; chunk.indices() as usize];
            session.mesh_into(chunk, MeshMut { vertices: &mut vertices, indices: &mut indices }).unwrap();
            vertices
        };
        let number = fine.len().min(coarse.len()) - 1;
        session.trajectory(&fine[number]).unwrap();
        let coarse_vertices = mesh(&mut session, &coarse[number]);
        session.trajectory(&coarse[number]).unwrap();
        let fine_vertices = mesh(&mut session, &fine[number]);
        for (chunk, vertices) in [(&coarse[number], coarse_vertices), (&fine[number], fine_vertices)] {
            let mut fresh = Session::new(&*device, plan.clone()).unwrap();
            fresh.upload(0, yarns.points()).unwrap();
            fresh.scan().unwrap();
            assert!(bits(&vertices) == bits(&mesh(&mut fresh, chunk)), "{}", device.info().name);
        }
    }
}
