//! Helpers of the tests on a device.

use std::ops::ControlFlow;
use std::sync::Arc;

use texere_core::backend::{Chunk, Engine, Plan, Session};
use texere_core::{ControlPoint, MeshPiece, Settings, Vertex, Yarn, Yarns};
use texere_opencl::{OpenClBackend, Schedule};

/// The first OpenCL device. A missing device fails the test, because it means that the test machine
/// is not set up.
pub(crate) fn device(schedule: Schedule) -> OpenClBackend {
    OpenClBackend::open(0, schedule).expect("an OpenCL device; install a driver, such as pocl-opencl-icd")
}

/// The plan of `yarns` under `settings`.
pub(crate) fn plan(yarns: &Yarns, settings: Settings) -> Arc<Plan> {
    Arc::new(Plan::new(yarns.layout().clone(), settings).unwrap())
}

/// A chunk's mesh, and the number of pieces in which it was read.
pub(crate) fn read<E: Engine + ?Sized>(
    session: &mut Session<E>,
    chunk: &Chunk,
) -> (Vec<Vertex>, Vec<u32>, usize) {
    let (mut all_vertices, mut all_indices, mut pieces) = (Vec::new(), Vec::new(), 0);
    let flow = session.read_mesh(chunk, &mut |piece| {
        pieces += 1;
        match piece {
            MeshPiece::Vertices { first, vertices } => {
                assert_eq!(first as usize, all_vertices.len());
                all_vertices.extend_from_slice(vertices);
            }
            MeshPiece::Indices { first, indices } => {
                assert_eq!(first as usize, all_indices.len());
                all_indices.extend_from_slice(indices);
            }
            _ => {}
        }
        ControlFlow::Continue(())
    });
    assert!(flow.unwrap().is_continue());
    (all_vertices, all_indices, pieces)
}

/// Twelve waving yarns of 40 points: every other one twisted, every third closed.
pub(crate) fn waves() -> Yarns {
    let mut yarns = Yarns::builder();
    for number in 0..12u8 {
        let points: Vec<_> = (0..40u8)
            .map(|k| {
                let (sin, cos) = (f32::from(k) * std::f32::consts::TAU / 40.0).sin_cos();
                let wave = (f32::from(k) * 0.9 + f32::from(number)).sin();
                ControlPoint::new(8.0 * cos, 8.0 * sin + f32::from(number), wave, 0.2 + 0.05 * wave)
            })
            .collect();
        let twist = if number % 2 == 1 { 0.7 } else { 0.0 };
        yarns.yarn(Yarn { closed: number % 3 == 2, twist, ..Yarn::default() }, &points);
    }
    yarns.build().unwrap()
}
