//! The box that each yarn's vertices lie in.

use texere_core::backend::{Chunk, Plan, SessionError, room_for};
use texere_core::{PipelineError, Vertex};

use super::WriteError;
use super::mesh_writer::yarn_runs;

/// The box of each yarn's vertices, mm.
#[derive(Debug)]
pub(super) struct Bounds {
    sides: u32,
    /// The least and the greatest coordinates of each yarn. A yarn without vertices has the largest
    /// number as its least and the smallest as its greatest.
    yarns: Vec<[[f32; 3]; 2]>,
}

impl Bounds {
    /// Boxes for the mesh of `plan`, before its first vertex.
    ///
    /// **Errors**: [`WriteError::Pipeline`] if memory is short.
    pub(super) fn new(plan: &Plan) -> Result<Self, WriteError> {
        let (mut yarns, count) = (Vec::new(), plan.layout().yarns().len());
        room_for(&mut yarns, count, "boxes of yarns")
            .map_err(|short| PipelineError::from(SessionError::from(short)))?;
        yarns.resize(count, [[f32::MAX; 3], [f32::MIN; 3]]);
        Ok(Self { sides: plan.settings().sides, yarns })
    }

    /// Widens the boxes of the yarns that `vertices` belong to. They are vertices of `chunk` from
    /// number `first` on.
    pub(super) fn include(&mut self, chunk: &Chunk, first: u32, vertices: &[Vertex]) {
        for (yarn, run) in yarn_runs(chunk, self.sides, first, vertices.len()) {
            let [low, high] = &mut self.yarns[yarn as usize];
            widen([low, high], &vertices[run]);
        }
    }

    /// The least and the greatest coordinates of each yarn.
    pub(super) fn yarns(&self) -> &[[[f32; 3]; 2]] {
        &self.yarns
    }
}

/// Widens a box, given by its least and its greatest coordinates, so that `vertices` lie in it.
pub(super) fn widen([low, high]: [&mut [f32; 3]; 2], vertices: &[Vertex]) {
    for vertex in vertices {
        for (axis, &value) in vertex.position.iter().enumerate() {
            low[axis] = low[axis].min(value);
            high[axis] = high[axis].max(value);
        }
    }
}
