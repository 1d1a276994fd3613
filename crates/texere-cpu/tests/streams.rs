//! Outputs too large for the caches are written past them in whole lines. They have the same bits,
//! wherever they start in a line.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::sync::Arc;

use texere_core::backend::{MeshMut, Plan, Session};
use texere_core::{Backend, ControlPoint, Frame, Limits, Pipeline, Settings, Topology, Vertex, Yarn, Yarns};
use texere_cpu::{ParallelBackend, SerialBackend};

/// Two short coils, a long one, one with a growing radius and a closed one. With one ring inserted
/// between points, they have 60,000 rings.
fn yarns() -> Yarns {
    let coil = |count: usize, growth: f32| -> Vec<_> {
        let point = |k: usize| {
            let angle = k as f32 * 0.37;
            ControlPoint::new(angle.cos(), angle.sin(), k as f32 * 0.05, 0.1 + growth * k as f32)
        };
        (0..count).map(point).collect()
    };
    let mut yarns = Yarns::builder();
    // With one ring inserted between points, these have 3 and 5 rings, fewer than AVX2 has lanes.
    yarns.yarn(Yarn::default(), &coil(2, 0.0));
    yarns.yarn(Yarn::default(), &coil(3, 0.0));
    yarns.yarn(Yarn::default(), &coil(25_003, 0.0));
    yarns.yarn(Yarn { twist: 1.5, ..Yarn::default() }, &coil(3_001, 1e-4));
    yarns.yarn(Yarn { closed: true, ..Yarn::default() }, &coil(2_000, 0.0));
    yarns.build().unwrap()
}

/// Vertices and indices, written from position `skew` of larger buffers on. The rest of the buffers
/// must stay as it was.
fn mesh(device: &ParallelBackend, yarns: &Yarns, settings: Settings, skew: usize) -> (Vec<u32>, Vec<u32>) {
    let plan = Arc::new(Plan::new(yarns.layout().clone(), settings).unwrap());
    let chunks: Vec<_> = plan.chunks(&Limits::NONE).unwrap().collect();
    let (count, indices) = (plan.counts().vertices as usize, plan.counts().indices as usize);
    let untouched = Vertex { position: [-7.0; 3], normal: [-7.0; 3] };
    let mut vertex_room = vec![untouched; count + 2 * skew];
    let mut index_room = vec![u32::MAX; indices + 2 * skew];
    let mut session = Session::new(device, plan).unwrap();
    session.upload(0, yarns.points()).unwrap();
    session.scan().unwrap();
    let out =
        MeshMut { vertices: &mut vertex_room[skew..][..count], indices: &mut index_room[skew..][..indices] };
    session.mesh_into(&chunks[0], out).unwrap();
    assert!(
        vertex_room[..skew].iter().chain(&vertex_room[skew + count..]).all(|vertex| *vertex == untouched)
    );
    assert!(index_room[..skew].iter().chain(&index_room[skew + indices..]).all(|index| *index == u32::MAX));
    (bits(&vertex_room[skew..][..count]), index_room[skew..][..indices].to_vec())
}

fn bits(vertices: &[Vertex]) -> Vec<u32> {
    let floats = vertices.iter().flat_map(|vertex| vertex.position.into_iter().chain(vertex.normal));
    floats.map(f32::to_bits).collect()
}

#[test]
fn streamed_meshes_equal_serial_ones_to_the_bit() {
    let yarns = yarns();
    let cases = [(6, Frame::Upright, 3), (12, Frame::Upright, 1), (13, Frame::RotationMinimizing, 1)];
    for (sides, frame, subdivisions) in cases {
        let settings = Settings { sides, frame, subdivisions, ..Settings::default() };
        let gold = Pipeline::new(&yarns).settings(settings).mesh(&SerialBackend::new()).unwrap();
        assert!(size_of_val(&gold.vertices[..]) + size_of_val(&gold.indices[..]) > 32 << 20);
        for (device, skew) in
            ParallelBackend::each().iter().flat_map(|device| [0, 1, 2, 4, 6].map(|skew| (device, skew)))
        {
            let (vertices, indices) = mesh(device, &yarns, settings, skew);
            let name = &device.info().name;
            assert!(
                vertices == bits(&gold.vertices),
                "{name}: vertices, {sides} sides, {skew} vertices into the buffer"
            );
            assert!(
                indices == gold.indices,
                "{name}: indices, {sides} sides, {skew} indices into the buffer"
            );
        }
    }
}

#[test]
fn meshes_without_indices_stream_too() {
    let yarns = yarns();
    let settings = Settings { sides: 25, topology: Topology::None, ..Settings::default() };
    let gold = Pipeline::new(&yarns).settings(settings).mesh(&SerialBackend::new()).unwrap();
    for device in ParallelBackend::each() {
        assert!(mesh(&device, &yarns, settings, 1).0 == bits(&gold.vertices), "{}", device.info().name);
    }
}
