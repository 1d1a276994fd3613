//! A region of a mesh equals that part of the whole mesh to the bit, and is complete.

use std::collections::{HashMap, HashSet};
use std::sync::Arc;

use rayon::prelude::*;
use texere_conformance::cases::{mixed, winding};
use texere_conformance::schedule::able_devices;
use texere_core::backend::{LiveMesh, PaddedPoints, Plan, SessionError};
use texere_core::{
    Backend, Bounds, ControlPoint, End, Frame, Limits, Mesh, Pipeline, Progress, Settings, Topology, Vertex,
    Yarn, Yarns,
};

/// A corner of a triangle: the yarn, the number of the ring, and the point of the section. Corners
/// of caps have numbers beyond those of all rings.
type Corner = (u32, u64, u32);

/// Fabrics whose blocks are scattered over a box: many yarns, and single yarns that wind through
/// the box.
fn fabrics() -> Vec<(&'static str, Yarns)> {
    let straight = |y: usize| {
        let points: Vec<_> = (0..150).map(|x| ControlPoint::new(x as f32, y as f32, 0.0, 0.2)).collect();
        (Yarn { twist: if y.is_multiple_of(2) { 0.0 } else { 0.4 }, ..Yarn::default() }, points)
    };
    let mut cloth = Yarns::builder();
    for (yarn, points) in (0..12).map(straight) {
        cloth.yarn(yarn, &points);
    }
    vec![
        ("mixed", mixed()),
        ("cloth", cloth.build().unwrap()),
        ("open", winding(150, Yarn { twist: 0.7, ..Yarn::default() })),
        ("closed", winding(260, Yarn { closed: true, ..Yarn::default() })),
    ]
}

fn settings() -> [Settings; 4] {
    let paper = Settings::default();
    let caps = Settings { caps: true, topology: Topology::Shared, ..paper };
    let turned = Settings { frame: Frame::RotationMinimizing, subdivisions: 4, sides: 5, ..paper };
    [paper, caps, turned, Settings { caps: true, ..turned }]
}

fn bounds(yarns: &Yarns, settings: Settings) -> Bounds {
    let plan = Plan::new(yarns.layout().clone(), settings).unwrap();
    let mut points = PaddedPoints::new(&plan).unwrap();
    points.upload(&plan, 0, yarns.points());
    plan.bounds(&points)
}

/// Boxes as shares of the fabric: a corner, a strip, an inner box, nothing, and everything.
fn boxes(all: &Bounds) -> [Bounds; 5] {
    let at = |share: [f32; 3]| {
        std::array::from_fn(|axis| all.low[axis] + share[axis] * (all.high[axis] - all.low[axis]))
    };
    let between = |low, high| Bounds { low: at(low), high: at(high) };
    let flat = |low, high| {
        let Bounds { low, high } = between(low, high);
        Bounds::rectangle([low[0], low[1]], [high[0], high[1]])
    };
    [
        flat([0.0; 3], [0.2, 0.3, 1.0]),
        flat([0.45, -1.0, 0.0], [0.5, 2.0, 1.0]),
        between([0.5, 0.5, 0.4], [0.9, 0.6, 0.6]),
        flat([3.0; 3], [4.0; 3]),
        *all,
    ]
}

/// The corner that each vertex is.
fn corners(mesh: &Mesh) -> Vec<Corner> {
    let sides = mesh.plan.settings().sides;
    let mut corners = vec![None; mesh.vertices.len()];
    for chunk in &mesh.chunks {
        for part in chunk.parts() {
            let first = chunk.first_vertex() as usize + part.first_vertex as usize;
            for at in 0..part.rings * sides {
                let corner = (part.yarn, u64::from(part.first_ring + at / sides), at % sides);
                assert_eq!(corners[first + at as usize].replace(corner), None);
            }
        }
        for cap in chunk.caps() {
            let first = chunk.first_vertex() as usize + cap.first_vertex as usize;
            let end = u64::MAX - u64::from(cap.end == End::Start);
            for side in 0..sides {
                assert_eq!(corners[first + side as usize].replace((cap.yarn, end, side)), None);
            }
        }
    }
    corners.into_iter().map(|corner| corner.expect("every vertex is of a ring or of a cap")).collect()
}

/// All triangles, and the bits of all vertices by corner.
fn named(mesh: &Mesh) -> (HashSet<[Corner; 3]>, HashMap<Corner, [u32; 6]>) {
    let corners = corners(mesh);
    let triangles: Vec<_> =
        mesh.triangles().map(|triangle| triangle.map(|vertex| corners[vertex as usize])).collect();
    let named: HashSet<_> = triangles.iter().copied().collect();
    assert_eq!(named.len(), triangles.len(), "a triangle comes twice");
    let bits = |vertex: &Vertex| bytemuck::cast::<Vertex, [u32; 6]>(*vertex);
    let mut vertices = HashMap::new();
    for (corner, vertex) in corners.into_iter().zip(&mesh.vertices) {
        // A ring that a cut repeats is equal in both chunks.
        assert_eq!(*vertices.entry(corner).or_insert(bits(vertex)), bits(vertex), "{corner:?}");
    }
    (named, vertices)
}

fn whole(device: &dyn Backend, yarns: &Yarns, settings: Settings) -> Mesh {
    Pipeline::new(yarns).settings(settings).mesh(device).unwrap()
}

/// Compares all regions of a cloth with the whole. Returns the number of those that are neither
/// empty nor all of it.
fn partial_regions(name: &str, yarns: &Yarns, settings: Settings) -> usize {
    let mut partial = 0;
    for device in able_devices(yarns, &settings) {
        let name = format!("{name}, {settings:?}: {}", device.info().name);
        let mesh = whole(&*device, yarns, settings);
        let (all, vertices) = named(&mesh);
        for bounds in boxes(&bounds(yarns, settings)) {
            for limits in [Limits::NONE, Limits { blocks: 4, ..Limits::NONE }] {
                let mut progress = Vec::new();
                let part = Pipeline::new(yarns)
                    .settings(settings)
                    .limits(limits)
                    .within(bounds)
                    .progress(|done| {
                        progress.push(done);
                        std::ops::ControlFlow::Continue(())
                    })
                    .mesh(&*device)
                    .unwrap();
                let (made, own) = named(&part);
                for (corner, bits) in &own {
                    assert_eq!(vertices[corner], *bits, "{name}: {corner:?}");
                }
                assert!(made.is_subset(&all), "{name}");
                let holds = |corner: &Corner| {
                    let [x, y, z, ..] = vertices[corner].map(f32::from_bits);
                    bounds.holds([x, y, z])
                };
                for triangle in all.difference(&made) {
                    assert!(!triangle.iter().any(holds), "{name}: {triangle:?} is missing");
                }
                let counts = part.plan.counts();
                assert_eq!(counts.triangles, made.len() as u64, "{name}");
                let repeated = part.chunks.iter().filter(|chunk| chunk.repeats_ring()).count() as u64;
                let sides = u64::from(settings.sides);
                assert_eq!(counts.vertices + repeated * sides, part.vertices.len() as u64, "{name}");
                let last = *progress.last().unwrap();
                assert_eq!(last, Progress { rings: counts.rings, total: counts.rings }, "{name}");
                partial += usize::from(!made.is_empty() && made.len() < all.len());
            }
        }
    }
    partial
}

#[test]
fn regions_are_parts_of_the_whole_and_lack_nothing() {
    let fabrics = fabrics();
    let regions = fabrics.par_iter().flat_map(|(name, yarns)| {
        settings().into_par_iter().map(move |settings| partial_regions(name, yarns, settings))
    });
    let partial: usize = regions.sum();
    assert!(partial > 100, "{partial} regions were neither empty nor all");
}

#[test]
fn all_of_a_cloth_is_the_whole_and_the_whole_of_a_region_is_the_cloth() {
    for (name, yarns) in fabrics() {
        let settings = Settings { caps: true, ..Settings::default() };
        let plan = Plan::new(yarns.layout().clone(), settings).unwrap();
        let mut points = PaddedPoints::new(&plan).unwrap();
        points.upload(&plan, 0, yarns.points());
        let all = plan.within(&points, &plan.bounds(&points));
        let none = plan.within(&points, &Bounds::NOTHING);
        assert!(plan.is_whole() && all.is_whole() && !none.is_whole(), "{name}");
        assert_eq!((all.counts(), none.whole().counts()), (plan.counts(), plan.counts()), "{name}");
        assert_eq!((none.counts().triangles, none.chunks(&Limits::NONE).unwrap().count()), (0, 0), "{name}");
        let limits = Limits { blocks: 3, ..Limits::NONE };
        let cut = |plan: &Plan| plan.chunks(&limits).unwrap().collect::<Vec<_>>();
        assert!(cut(&plan) == cut(&all), "{name}");
    }
}

#[test]
fn attributes_of_a_region_are_those_of_its_vertices() {
    let settings = Settings { caps: true, subdivisions: 4, ..Settings::default() };
    for (name, yarns) in fabrics() {
        let bounds = boxes(&bounds(&yarns, settings))[0];
        for device in texere_conformance::near_devices() {
            let pipeline = || Pipeline::new(&yarns).settings(settings);
            let (mesh, all) = (whole(&**device, &yarns, settings), pipeline().attributes(&**device).unwrap());
            let of: HashMap<_, _> = corners(&mesh).into_iter().zip(all).collect();
            let part = pipeline().within(bounds).mesh(&**device).unwrap();
            let own = pipeline().within(bounds).attributes(&**device).unwrap();
            assert_eq!(own.len(), part.vertices.len(), "{name}");
            for (corner, attribute) in corners(&part).iter().zip(own) {
                assert_eq!(of[corner], attribute, "{name} on {}: {corner:?}", device.info().name);
            }
        }
    }
}

#[test]
fn what_is_edited_is_a_whole_cloth() {
    let (_, yarns) = fabrics().swap_remove(1);
    let plan = Plan::new(yarns.layout().clone(), Settings::default()).unwrap();
    let mut points = PaddedPoints::new(&plan).unwrap();
    points.upload(&plan, 0, yarns.points());
    let part = plan.within(&points, &Bounds::rectangle([0.0; 2], [9.0; 2]));
    let refused = LiveMesh::new(&texere_cpu::ParallelBackend::open().unwrap(), Arc::new(part));
    assert!(matches!(refused, Err(SessionError::Region)));
}
