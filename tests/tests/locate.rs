//! The yarn, ring and side of a vertex or a triangle, against a walk over all parts and against the
//! corners of the triangles themselves.

use std::collections::BTreeSet;
use std::ops::ControlFlow;
use std::sync::Arc;

use texere_core::backend::{LiveMesh, Plan};
use texere_core::{
    Backend, ControlPoint, End, Limits, MeshPiece, MeshPlace, Settings, Topology, Yarn, Yarns,
};
use texere_cpu::SerialBackend;

fn yarns() -> Yarns {
    let mut yarns = Yarns::builder();
    for (count, closed) in
        [(3, false), (64, true), (65, false), (130, false), (4, true), (200, true), (2, false)]
    {
        let points: Vec<_> =
            (0..count).map(|k| ControlPoint::new(k as f32, (k * k % 7) as f32, 0.0, 0.1)).collect();
        yarns.yarn(Yarn { closed, ..Yarn::default() }, &points);
    }
    yarns.build().unwrap()
}

/// Calls `check` for plans with room and without, in chunks of a few blocks and in one chunk.
fn each(check: impl Fn(&Plan, &Limits)) {
    for (subdivisions, sides, caps) in [(0, 3, true), (1, 6, false), (4, 5, true)] {
        let settings = Settings { subdivisions, sides, caps, ..Settings::default() };
        let layout = yarns().layout().clone();
        for plan in [
            Plan::new(layout.clone(), settings).unwrap(),
            Plan::with_room(layout.clone(), settings, |yarn| 90 + 31 * yarn as u64).unwrap(),
        ] {
            for blocks in [2, 5, u64::MAX] {
                let limits = Limits { blocks, ..Limits::NONE };
                check(&plan, &limits);
            }
        }
    }
}

#[test]
fn every_vertex_is_where_its_part_has_it() {
    each(|plan, limits| {
        let sides = plan.settings().sides;
        for chunk in &plan.chunks(limits).unwrap().collect::<Vec<_>>() {
            let mut places = vec![None; chunk.vertices() as usize];
            for part in chunk.parts() {
                for own in 0..part.rings * sides {
                    let (ring, side) = (part.first_ring + own / sides, own % sides);
                    places[(part.first_vertex + own) as usize] =
                        Some(MeshPlace { yarn: part.yarn, ring, side, cap: None });
                }
            }
            for cap in chunk.caps() {
                let ring = if cap.end == End::Start { 0 } else { plan.rings(cap.yarn as usize) - 1 };
                for side in 0..sides {
                    places[(cap.first_vertex + side) as usize] =
                        Some(MeshPlace { yarn: cap.yarn, ring, side, cap: Some(cap.end) });
                }
            }
            for (vertex, place) in (0..).zip(places) {
                assert_eq!(plan.place_of_vertex(chunk, vertex), place, "vertex {vertex}");
            }
            assert_eq!(plan.place_of_vertex(chunk, chunk.vertices()), None);
            assert_eq!(plan.place_of_vertex(chunk, u32::MAX), None);
        }
    });
}

#[test]
fn every_triangle_is_between_its_corners() {
    each(|plan, limits| {
        let (yarns, sides) = (yarns(), plan.settings().sides);
        let device = &SerialBackend::new();
        let plan = Arc::new(plan.clone());
        let engine = device.engine(plan.clone()).unwrap();
        let mut mesh = LiveMesh::with_engine(engine, limits, plan.clone()).unwrap();
        mesh.upload(0, yarns.points()).unwrap();
        mesh.update().unwrap();
        let mut found = 0;
        for (number, chunk) in mesh.chunks().to_vec().iter().enumerate() {
            let mut indices = Vec::new();
            let _ = mesh
                .read_mesh(number, &mut |piece| {
                    if let MeshPiece::Indices { indices: lent, .. } = piece {
                        indices.extend_from_slice(lent);
                    }
                    ControlFlow::Continue(())
                })
                .unwrap();
            let drawn: BTreeSet<u32> = plan
                .chunk_draws(chunk)
                .flat_map(|draw| draw.indices.step_by(3))
                .map(|index| index / 3)
                .collect();
            for triangle in 0..chunk.indices() / 3 {
                let place = plan.place_of_triangle(chunk, triangle);
                assert_eq!(place.is_some(), drawn.contains(&triangle), "triangle {triangle}");
                let Some(place) = place else { continue };
                found += 1;
                let corners = [0, 1, 2].map(|corner| {
                    plan.place_of_vertex(chunk, indices[3 * triangle as usize + corner]).unwrap()
                });
                assert!(corners.iter().all(|corner| (corner.yarn, corner.cap) == (place.yarn, place.cap)));
                if place.cap.is_none() {
                    let quad = [(0, 0), (0, 1), (1, 0), (1, 1)]
                        .map(|(ring, side)| (place.ring + ring, (place.side + side) % sides));
                    assert!(
                        corners.iter().all(|corner| quad.contains(&(corner.ring, corner.side))),
                        "{place:?}"
                    );
                    assert_eq!(corners.iter().map(|corner| corner.ring).min(), Some(place.ring));
                }
            }
        }
        assert_eq!(found, plan.counts().triangles);
    });
}

#[test]
fn triangles_without_indices_have_no_place() {
    let settings = Settings { topology: Topology::Shared, ..Settings::default() };
    let plan = Plan::new(yarns().layout().clone(), settings).unwrap();
    let chunk = plan.chunks(&Limits::NONE).unwrap().next().unwrap();
    assert_eq!(plan.place_of_triangle(&chunk, 0), None);
    assert!(plan.place_of_vertex(&chunk, 0).is_some());
}
