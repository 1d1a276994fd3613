//! What the writers of all formats share.

use std::io::{Seek, Write};
use std::ops::Range;

use texere_core::backend::{Chunk, Part};
use texere_core::{Cap, Vertex};

use super::WriteError;
use super::places::Places;
use super::target::Target;

/// Vertices that follow one another in a chunk and in the file.
pub(super) struct Run<'a> {
    pub(super) chunk: &'a Chunk,
    /// Number of the first in its chunk.
    pub(super) first: u32,
    /// Number of the first in the file.
    pub(super) place: u64,
    pub(super) vertices: &'a [Vertex],
}

/// A format's way to write.
pub(super) trait MeshWriter<W: Write + Seek> {
    /// Takes vertices. Each of the file comes once: those of rings in order, and those of caps in
    /// order.
    fn vertices(&mut self, run: Run<'_>) -> Result<(), WriteError>;

    /// Takes the triangles of `chunk`, whose vertices have come but for a ring that is repeated.
    fn triangles(&mut self, chunk: &Chunk, places: &Places) -> Result<(), WriteError>;

    /// Completes the file once everything has come.
    fn finish(self: Box<Self>) -> Result<Target<W>, WriteError>;
}

/// Which yarn each of `count` vertices of a chunk from number `first` on belongs to: runs of
/// places, counted from `first`, in order.
pub(super) fn yarn_runs(
    chunk: &Chunk,
    sides: u32,
    first: u32,
    count: usize,
) -> impl Iterator<Item = (u32, Range<usize>)> {
    let end = u64::from(first) + count as u64;
    let tube = move |part: &Part| (part.yarn, part.first_vertex..part.first_vertex + part.rings * sides);
    let cap = move |cap: &Cap| (cap.yarn, cap.first_vertex..cap.first_vertex + sides);
    // A chunk may hold thousands of parts and be lent in as many pieces.
    let tubes = &chunk.parts()[chunk.parts().partition_point(|part| tube(part).1.end <= first)..];
    let caps = &chunk.caps()[chunk.caps().partition_point(|each| cap(each).1.end <= first)..];
    let runs = tubes.iter().map(tube).chain(caps.iter().map(cap));
    runs.take_while(move |(_, run)| u64::from(run.start) < end).map(move |(yarn, run)| {
        let from = run.start.max(first) - first;
        (yarn, from as usize..((run.end - first) as usize).min(count))
    })
}
