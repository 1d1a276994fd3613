//! The trait that the writers of all mesh formats implement.

use std::io::{Seek, Write};
use std::ops::Range;

use texere_core::backend::{Chunk, Part};
use texere_core::{Cap, Vertex};

use super::WriteError;
use super::places::Places;
use super::target::Target;

/// Vertices that follow one another both in a chunk and in the file.
pub(super) struct Run<'a> {
    pub(super) chunk: &'a Chunk,
    /// Whether the chunk begins with a ring that the chunk before repeats.
    pub(super) goes_on: bool,
    /// The number of the first vertex in its chunk.
    pub(super) first: u32,
    /// The number of the first vertex in the file.
    pub(super) place: u64,
    pub(super) vertices: &'a [Vertex],
}

/// A mesh file of any format that is being written.
pub(super) trait MeshWriter<W: Write + Seek> {
    /// Writes vertices. Each vertex of the file comes once. The vertices of rings come in order,
    /// and so do the vertices of caps.
    fn vertices(&mut self, run: Run<'_>) -> Result<(), WriteError>;

    /// Writes the triangles of `chunk`. The chunk's vertices have come, except for a ring that the
    /// next chunk repeats.
    fn triangles(&mut self, chunk: &Chunk, places: &Places) -> Result<(), WriteError>;

    /// Completes the file once everything has come.
    fn finish(self: Box<Self>) -> Result<Target<W>, WriteError>;
}

/// The yarns of `count` vertices of a chunk, from number `first` on. Returns runs of vertices of
/// one yarn in order, each with its yarn. The runs count vertices from `first`.
pub(super) fn yarn_runs(
    chunk: &Chunk,
    sides: u32,
    first: u32,
    count: usize,
) -> impl Iterator<Item = (u32, Range<usize>)> {
    let end = u64::from(first) + count as u64;
    let tube = move |part: &Part| (part.yarn, part.first_vertex..part.first_vertex + part.rings * sides);
    let cap = move |cap: &Cap| (cap.yarn, cap.first_vertex..cap.first_vertex + sides);
    // The first part and the first cap are found by binary search, because a chunk may hold
    // thousands of parts, and may come in thousands of pieces.
    let tubes = &chunk.parts()[chunk.parts().partition_point(|part| tube(part).1.end <= first)..];
    let caps = &chunk.caps()[chunk.caps().partition_point(|each| cap(each).1.end <= first)..];
    let runs = tubes.iter().map(tube).chain(caps.iter().map(cap));
    runs.take_while(move |(_, run)| u64::from(run.start) < end).map(move |(yarn, run)| {
        let from = run.start.max(first) - first;
        (yarn, from as usize..((run.end - first) as usize).min(count))
    })
}
