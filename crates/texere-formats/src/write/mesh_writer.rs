//! What the writers of all formats share.

use std::io::{Seek, Write};
use std::ops::Range;

use texere_core::{Cap, Chunk, Part, Vertex};

use super::WriteError;
use super::target::Target;

/// A format's way to write.
pub(super) trait MeshWriter<W: Write + Seek> {
    /// Takes a chunk's vertices from number `first` on. All vertices of all chunks come in order.
    fn vertices(&mut self, chunk: &Chunk, first: u32, vertices: &[Vertex]) -> Result<(), WriteError>;

    /// Completes the file once all vertices have come.
    fn finish(self: Box<Self>) -> Result<Target<W>, WriteError>;
}

/// Which yarn each of `count` vertices of a chunk from number `first` on belongs to: runs of places, counted from
/// `first`, in order.
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
