//! What an edit has changed in the mesh of a live cloth.

use std::ops::ControlFlow;

use bytemuck::cast_slice;
use numpy::PyArray2;
use numpy::ndarray::{ArrayView2, s};
use pyo3::prelude::*;
use pyo3::types::PySlice;
use texere::mesh::{LiveError, MeshPiece};
use texere::{Live, Vertex};

use crate::arrays::view;
use crate::error::Raise;
use crate::watch::Run;

/// Vertices of a yarn that edits have changed: :meth:`texere.Live.changes` gives them.
///
/// >>> live = texere.read("designs/plain.toml").placed().edit(device="cpu")
/// >>> live.changes() is None
/// True
/// >>> live.set_lift(30, 23, True)
/// >>> live.changes()
/// [<texere.Change of yarn 30, 2214 vertices>, <texere.Change of yarn 87, 2982 vertices>]
#[pyclass(frozen, module = "texere")]
#[derive(Debug)]
pub(crate) struct Change {
    yarn: u32,
    /// How many vertices the whole yarn has.
    count: usize,
    /// The number, within the yarn, of the first vertex that has changed.
    first: usize,
    vertices: Vec<Vertex>,
}

#[pymethods]
impl Change {
    /// The number of the yarn, from 0.
    ///
    /// >>> live = texere.read("designs/plain.toml").placed().edit(device="cpu")
    /// >>> live.changes() is None
    /// True
    /// >>> live.set_lift(30, 23, True)
    /// >>> [change.yarn for change in live.changes() or []]
    /// [30, 87]
    #[getter]
    fn yarn(&self) -> u32 {
        self.yarn
    }

    /// How many vertices the yarn has now.
    ///
    /// >>> live = texere.read("designs/plain.toml").placed().edit(device="cpu")
    /// >>> live.changes() is None
    /// True
    /// >>> live.set_lift(30, 23, True)
    /// >>> mesh = live.mesh()
    /// >>> for change in live.changes() or []:
    /// ...     assert change.count == (mesh.yarn_ids == change.yarn).sum()
    #[getter]
    fn count(&self) -> usize {
        self.count
    }

    /// Which of the yarn's vertices have changed, as a slice. The other vertices keep their numbers
    /// and positions.
    ///
    /// >>> live = texere.read("designs/plain.toml").placed().edit(device="cpu")
    /// >>> live.changes() is None
    /// True
    /// >>> live.set_lift(30, 23, True)
    /// >>> mesh = live.mesh()
    /// >>> for change in live.changes() or []:
    /// ...     yarn = mesh.positions[mesh.yarn_ids == change.yarn]
    /// ...     assert (yarn[change.vertices] == change.positions).all()
    #[getter]
    fn vertices<'py>(&self, py: Python<'py>) -> Bound<'py, PySlice> {
        PySlice::new(py, self.first as isize, (self.first + self.vertices.len()) as isize, 1)
    }

    /// Positions of the changed vertices, mm: float32 of shape (n, 3). Does not copy.
    ///
    /// >>> live = texere.read("designs/plain.toml").placed().edit(device="cpu")
    /// >>> live.changes() is None
    /// True
    /// >>> live.set_lift(30, 23, True)
    /// >>> [change.positions.shape[1] for change in live.changes() or []]
    /// [3, 3]
    #[getter]
    fn positions<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyArray2<f32>>> {
        column(slf, 0)
    }

    /// Unit normals of the changed vertices, which point out of the yarn: float32 of shape (n, 3).
    /// Does not copy.
    ///
    /// >>> live = texere.read("designs/plain.toml").placed().edit(device="cpu")
    /// >>> live.changes() is None
    /// True
    /// >>> live.set_lift(30, 23, True)
    /// >>> [change.normals.dtype.name for change in live.changes() or []]
    /// ['float32', 'float32']
    #[getter]
    fn normals<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyArray2<f32>>> {
        column(slf, 3)
    }

    fn __repr__(&self) -> String {
        format!("<texere.Change of yarn {}, {} vertices>", self.yarn, self.vertices.len())
    }
}

/// Three of the six numbers of each vertex: the position if `first` is 0, the normal if it is 3.
fn column<'py>(slf: &Bound<'py, Change>, first: usize) -> PyResult<Bound<'py, PyArray2<f32>>> {
    let vertices = &slf.get().vertices[..];
    let words = ArrayView2::from_shape((vertices.len(), 6), cast_slice(vertices)).raise(slf.py())?;
    // SAFETY: the vertices belong to `slf`, and never change.
    unsafe { view(slf.as_any(), words.slice(s![.., first..first + 3])) }
}

/// Makes the parts of the mesh again that edits have changed since the last call, and returns the
/// changed vertices. None says that the whole mesh counts as changed: in the first call, after a
/// yarn has outgrown its room, and after a call that failed or was stopped. `is_known` says whether
/// the last call reported all changes up to it.
pub(crate) fn changes(
    live: &mut Live,
    is_known: &mut bool,
    run: &Run,
) -> Result<Option<Vec<Change>>, LiveError> {
    // `is_known` stays false if this call fails or is stopped.
    let was_known = std::mem::take(is_known);
    let ControlFlow::Continue(update) = live.update_watched(&mut || run.tell(0.0))? else { return Ok(None) };
    if update.anew || !was_known {
        *is_known = true;
        return Ok(None);
    }
    let plan = live.mesh().plan().clone();
    let sides = plan.settings().sides as usize;
    let mut made = Vec::new();
    for change in &update.changes {
        let mut places = Vec::new();
        for part in live.mesh().chunks()[change.chunk].parts() {
            let (own, wanted) = (part.first_vertex as usize, &change.vertices);
            let from = own.max(wanted.start as usize);
            let to = (own + part.rings as usize * sides).min(wanted.end as usize);
            if from < to {
                let count = plan.rings(part.yarn as usize) as usize * sides;
                let first = part.first_ring as usize * sides + from - own;
                let vertices = vec![Vertex::default(); to - from];
                places.push((from, Change { yarn: part.yarn, count, first, vertices }));
            }
        }
        read(live, change.chunk, &mut places)?;
        made.extend(places.into_iter().map(|(_, change)| change));
    }
    *is_known = true;
    Ok(Some(made))
}

/// Reads ranges of a chunk's vertices into the changes in `wanted`. The number beside each change
/// is the number, within the chunk, of the first vertex of its range.
fn read(live: &mut Live, chunk: usize, wanted: &mut [(usize, Change)]) -> Result<(), LiveError> {
    let end = wanted.iter().map(|(from, change)| from + change.vertices.len()).max().unwrap_or(0);
    let _ = live.mesh_mut().read_mesh(chunk, &mut |piece| {
        let MeshPiece::Vertices { first, vertices } = piece else { return ControlFlow::Break(()) };
        let first = first as usize;
        for (from, change) in &mut *wanted {
            let start = first.max(*from);
            let stop = (first + vertices.len()).min(*from + change.vertices.len());
            if start < stop {
                change.vertices[start - *from..stop - *from]
                    .copy_from_slice(&vertices[start - first..stop - first]);
            }
        }
        if first + vertices.len() < end { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    })?;
    Ok(())
}
