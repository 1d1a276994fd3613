//! Errors of writing files.

use std::io;
use std::path::{Path, PathBuf};

use texere_core::{BoundaryError, PipelineError, counted};
use thiserror::Error;

/// The most vertices of a PLY file.
const PLY_VERTICES: u64 = u32::MAX as u64;

/// Errors of writers. After an error there is no new file, and an old file at the path is as it
/// was.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum WriteError {
    /// The extension of the path stands for no format. The error names the extensions that do.
    #[error("{} has no known extension; there are: {}", .path.display(), .known)]
    UnknownFormat {
        /// The path.
        path: PathBuf,
        /// All extensions that stand for a format.
        known: String,
    },
    /// A kind of file that this build was made without.
    #[error("this build writes no {format}; texere's feature `{feature}` adds it")]
    Feature {
        /// The kind of file.
        format: &'static str,
        /// The feature that writes it.
        feature: &'static str,
    },
    /// The file system refused: no such folder, no permission, no room. A target is refused before
    /// any work is done if it is a folder, a device, a link that leads nowhere, or a file without
    /// permission to write.
    #[error("can't {action} {}", .path.display())]
    Io {
        /// The action: create, write, rename or look at.
        action: &'static str,
        /// The file that was to be written.
        path: PathBuf,
        /// The error of the system.
        source: io::Error,
    },
    /// The caller's writer refused. The bytes that the writer got are not a whole file.
    #[error("the writer refused")]
    Writer {
        /// The error of the writer.
        source: io::Error,
    },
    /// The output is a file that must not be replaced, under this name or another.
    #[error("writing {} would replace {}, which must stay", .path.display(), .spared.display())]
    Spared {
        /// The file that was to be written.
        path: PathBuf,
        /// The file that must not be replaced.
        spared: PathBuf,
    },
    /// The mesh could not be made, or progress asked to stop.
    #[error("{}", if matches!(.0, PipelineError::Cancelled) { "writing was stopped" } else { "the mesh could not be made" })]
    Pipeline(#[from] PipelineError),
    /// GLB counts its bytes with 32 bits. PLY has no such limit. Fewer sides or subdivisions make a
    /// smaller file. The bytes of a compressed file are counted unpacked: readers hold each buffer
    /// view in one piece, and many number its bytes with 32 bits, too.
    #[error(
        "GLB of {bytes} bytes or more, but the format ends at {limit}; write PLY, or fewer sides or subdivisions"
    )]
    GlbTooLarge {
        /// Bytes that the file would have at least.
        bytes: u64,
        /// The most bytes that the format can have.
        limit: u64,
    },
    /// Packed positions have 16 bits, whose steps would be too long for this yarn. A plain GLB has
    /// no such limit.
    #[error(
        "yarn {yarn} takes {length_mm} mm of the cloth, but packed GLB holds {limit_mm} mm of a yarn; write plain GLB"
    )]
    TooLongToPack {
        /// The yarn, counted from 0.
        yarn: usize,
        /// The largest side of the box that the yarn lies in, mm.
        length_mm: f32,
        /// The largest side that can be packed, mm.
        limit_mm: f32,
    },
    /// An instanced GLB holds different parts of yarns once each. Too many of this cloth's parts
    /// are different.
    #[error(
        "too few parts of the yarns recur: {parts} different ones take more than the {limit} bytes of instanced GLB; write packed or compressed GLB"
    )]
    TooFewRepeats {
        /// Number of different parts that came.
        parts: usize,
        /// The most bytes of different parts: their vertices, and 2 KiB for each part.
        limit: u64,
    },
    /// PLY numbers vertices with 32 bits. Programs that read OBJ number them with 31, and USD
    /// numbers those of a yarn with 31. Fewer sides or subdivisions make fewer vertices.
    #[error(
        "{format} of {vertices} vertices or more, but the format ends at {limit}; {}use fewer sides or subdivisions",
        // A mesh with more vertices than PLY can number gets no advice to write PLY.
        if *.format == "OBJ" && *.vertices <= PLY_VERTICES { "write a PLY file, or " } else { "" }
    )]
    TooManyVertices {
        /// The format.
        format: &'static str,
        /// Vertices that the file would have at least.
        vertices: u64,
        /// The most vertices that the format can have.
        limit: u64,
    },
    /// STL counts facets with 32 bits. PLY counts vertices, of which there are half as many. Fewer
    /// sides or subdivisions make fewer facets.
    #[error(
        "STL of {facets} facets or more, but the format ends at {limit}; write PLY, or fewer sides or subdivisions"
    )]
    TooManyFacets {
        /// Facets that the file would have at least.
        facets: u64,
        /// The most facets that the format can have.
        limit: u64,
    },
    /// The mesh has no triangles, such as that of a region without yarns.
    #[error("the mesh has no triangles: nothing lies in the box that it is of")]
    Empty,
    /// The mesh has another number of vertices than its plan says, or its vertices come out of
    /// order.
    #[error("mesh has {given} vertices in order; {planned} were planned")]
    VertexCount {
        /// Number of vertices that came in order.
        given: u64,
        /// Number of vertices that should have come.
        planned: u64,
    },
    /// A vertex has NaN or infinity in it, which would make the file unreadable.
    #[error("vertex {vertex}, of yarn {yarn}, is not finite")]
    NotFinite {
        /// The vertex, counted from 0 among all.
        vertex: u64,
        /// The yarn of the vertex, counted from 0.
        yarn: u32,
    },
    /// The path of a PNG picture does not end in `.png`.
    #[error("{} does not end in .png, as a picture does", .path.display())]
    NotPng {
        /// The path.
        path: PathBuf,
    },
    /// The path does not end as its format asks.
    #[error("{} does not end in .{expected}", .path.display())]
    NotEnding {
        /// The path.
        path: PathBuf,
        /// The ending, without its dot.
        expected: &'static str,
    },
    /// The format can't hold the design, or a part of it.
    #[error("{format} can't hold {what}")]
    Unheld {
        /// The format.
        format: &'static str,
        /// The part that the format can't hold.
        what: String,
    },
    /// A number outside the limits of readers of the format.
    #[error("{field} is {value}; {format} takes {low} to {high}")]
    OutOfRange {
        /// The format.
        format: &'static str,
        /// Section and key, as the format writes them.
        field: String,
        /// The number.
        value: f64,
        /// The least number that readers allow.
        low: f64,
        /// The greatest number that readers allow.
        high: f64,
    },
    /// The file would be larger than readers of the format allow.
    #[error("{format} of {bytes} bytes or more; {limit} at most are read")]
    TextTooLarge {
        /// The format.
        format: &'static str,
        /// Bytes that the file would have at least.
        bytes: u64,
        /// The most bytes that readers allow.
        limit: u64,
    },
    /// A cloth of more threads than a picture has pixels for.
    #[error(
        "draft of {ends} and {picks} takes {width} × {height} pixels; each side may have {limit} at most", ends = counted(*.ends, "end"), picks = counted(*.picks, "pick"))]
    DraftTooLarge {
        /// Ends of the cloth.
        ends: usize,
        /// Picks of the cloth.
        picks: usize,
        /// Width of the picture, pixels.
        width: usize,
        /// Height of the picture, pixels.
        height: usize,
        /// The most pixels of a side.
        limit: usize,
    },
    /// A warp knit whose chains are so long, or whose bars are so many, that a picture has too few
    /// pixels to hold them below the lappings.
    #[error(
        "lapping diagram of {bars} takes {width} × {height} pixels, because their chains are written below it; each side may have {limit} at most", bars = counted(*.bars, "bar"))]
    LappingTooLarge {
        /// Guide bars of the knit.
        bars: usize,
        /// Width of the picture, pixels.
        width: usize,
        /// Height of the picture, pixels.
        height: usize,
        /// The most pixels of a side.
        limit: usize,
    },
    /// A knit that is too large for a chart.
    #[error(
        "a chart of {wales} and {courses}; {side} of each are drawn at most, and {squares} squares", wales = counted(*.wales, "wale"), courses = counted(*.courses, "course"))]
    ChartTooLarge {
        /// Wales of the chart.
        wales: usize,
        /// Courses of the chart.
        courses: usize,
        /// The most wales, and the most courses, that are drawn.
        side: usize,
        /// The most squares that are drawn.
        squares: usize,
    },
    /// The boundary is that of other yarns.
    #[error("the boundary is not that of the yarns")]
    Boundary(#[from] BoundaryError),
    /// A yarn refers to a material that the mesh does not have.
    #[error("yarn {yarn} is of material {material}, but there are {materials}")]
    UnknownMaterial {
        /// The yarn, counted from 0.
        yarn: usize,
        /// The number of the yarn's material, counted from 0.
        material: u32,
        /// Number of materials of the mesh.
        materials: usize,
    },
}

impl WriteError {
    /// The refusal of the file system to `action` the file at `path`.
    pub(super) fn io(action: &'static str, path: &Path, source: io::Error) -> Self {
        Self::Io { action, path: path.to_owned(), source }
    }
}
