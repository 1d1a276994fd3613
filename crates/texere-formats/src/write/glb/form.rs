//! How the vertices of a GLB file are stored.

use std::mem::offset_of;
use std::ops::Range;

use texere_core::Vertex;

use super::schema::{
    ARRAY_BUFFER, Accessor, BYTE, Buffer, BufferExtensions, BufferView, Compression, ELEMENT_ARRAY_BUFFER,
    FLOAT, Fallback, SHORT, UNSIGNED_INT, ViewExtensions,
};

/// The number of the buffer view that holds the index pattern.
const PATTERN: usize = 0;

/// The number of the first buffer view that holds vertices.
const VERTICES: usize = 1;

/// Bytes of an index.
const INDEX_BYTES: u64 = size_of::<u32>() as u64;

/// The extension that allows positions in 16-bit numbers and normals in 8-bit numbers.
const QUANTIZATION: &str = "KHR_mesh_quantization";

/// The extension that compresses buffer views.
const COMPRESSION: &str = "EXT_meshopt_compression";

/// A property of vertices, as accessors describe it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Column {
    /// Bytes of the property of one vertex, with padding.
    pub(super) bytes: u64,
    /// The kind of numbers.
    kind: u32,
    /// Whether whole numbers stand for shares of 1. None for floats.
    normalized: Option<bool>,
    shape: &'static str,
    /// The filter of the compressed property.
    filter: Option<&'static str>,
}

/// The columns of all vertices: first positions, then normals.
#[derive(Debug)]
pub(super) struct VertexForm {
    pub(super) columns: Vec<Column>,
    /// Whether each column has a compressed buffer view of its own. If not, the columns of a vertex
    /// follow one another in a buffer view of all vertices.
    pub(super) compressed: bool,
}

impl VertexForm {
    /// Positions and normals as in [`Vertex`].
    pub(super) fn plain() -> Self {
        const { assert!(offset_of!(Vertex, position) == 0 && offset_of!(Vertex, normal) == 12) };
        let column = Column { bytes: 12, kind: FLOAT, normalized: None, shape: "VEC3", filter: None };
        Self { columns: vec![column; 2], compressed: false }
    }

    /// Positions in steps of a grid, and normals in steps of 1/127. Both are padded to a multiple
    /// of four bytes.
    pub(super) fn packed() -> Self {
        let positions = Column { bytes: 8, kind: SHORT, normalized: None, shape: "VEC3", filter: None };
        let normals = Column { bytes: 4, kind: BYTE, normalized: Some(true), ..positions };
        Self { columns: vec![positions, normals], compressed: false }
    }

    /// The packed form, compressed.
    pub(super) fn compressed() -> Self {
        let mut form = Self { compressed: true, ..Self::packed() };
        form.columns[1].filter = Some("OCTAHEDRAL");
        form
    }

    /// Bytes of a vertex.
    pub(super) fn bytes(&self) -> u64 {
        self.columns.iter().map(|column| column.bytes).sum()
    }

    /// The extensions that a reader has to know.
    pub(super) fn extensions(&self) -> Vec<&'static str> {
        let packed = self.columns[0].kind != FLOAT;
        let extensions = [(packed, QUANTIZATION), (self.compressed, COMPRESSION)];
        extensions.into_iter().filter(|(needed, _)| *needed).map(|(_, extension)| extension).collect()
    }

    /// The accessors of a tube or a cap, one for each column. At first the minimum of its positions
    /// is the largest number and the maximum the smallest, so that the first vertex sets both.
    pub(super) fn accessors(&self, vertices: &Range<u64>) -> Vec<Accessor> {
        let (mut accessors, mut offset) = (Vec::new(), 0);
        for (number, column) in self.columns.iter().enumerate() {
            let (view, byte_offset) = if self.compressed {
                (VERTICES + number, vertices.start * column.bytes)
            } else {
                (VERTICES, vertices.start * self.bytes() + offset)
            };
            offset += column.bytes;
            let bound = |bound| (number == 0).then_some([bound; 3]);
            accessors.push(Accessor {
                buffer_view: view,
                byte_offset,
                component_type: column.kind,
                normalized: column.normalized,
                count: vertices.end - vertices.start,
                shape: column.shape,
                min: bound(f32::MAX),
                max: bound(f32::MIN),
            });
        }
        accessors
    }

    /// The buffer views of `indices` and of `vertices`, and the buffers that they lie in. The
    /// places of compressed views are not known yet.
    pub(super) fn views(&self, indices: u64, vertices: u64) -> (Vec<BufferView>, Vec<Buffer>) {
        let whole = Column { bytes: self.bytes(), filter: None, ..self.columns[0] };
        let columns = if self.compressed { &self.columns[..] } else { &[whole] };
        let mut views = vec![BufferView {
            buffer: 0,
            byte_offset: 0,
            byte_length: indices * INDEX_BYTES,
            byte_stride: None,
            target: ELEMENT_ARRAY_BUFFER,
            extensions: self.compression("TRIANGLES", INDEX_BYTES, indices, None),
        }];
        let mut end = views[0].byte_length;
        for column in columns {
            views.push(BufferView {
                buffer: 0,
                byte_offset: end,
                byte_length: vertices * column.bytes,
                byte_stride: Some(column.bytes),
                target: ARRAY_BUFFER,
                extensions: self.compression("ATTRIBUTES", column.bytes, vertices, column.filter),
            });
            end += vertices * column.bytes;
        }
        let mut buffers = vec![Buffer { byte_length: end, extensions: None }];
        if self.compressed {
            // The views unpacked lie in a buffer that the file doesn't hold. The file's own buffer
            // has the number 0.
            let extensions = Some(BufferExtensions { compression: Fallback { fallback: true } });
            buffers.push(Buffer { byte_length: end, extensions });
            views.iter_mut().for_each(|view| view.buffer = 1);
        }
        (views, buffers)
    }

    fn compression(
        &self,
        mode: &'static str,
        byte_stride: u64,
        count: u64,
        filter: Option<&'static str>,
    ) -> Option<ViewExtensions> {
        let compression =
            Compression { buffer: 0, byte_offset: 0, byte_length: 0, byte_stride, count, mode, filter };
        self.compressed.then_some(ViewExtensions { compression })
    }
}

/// The accessor of indices of the pattern.
pub(super) fn index_accessor(indices: &Range<u64>) -> Accessor {
    Accessor {
        buffer_view: PATTERN,
        byte_offset: indices.start * INDEX_BYTES,
        component_type: UNSIGNED_INT,
        normalized: None,
        count: indices.end - indices.start,
        shape: "SCALAR",
        min: None,
        max: None,
    }
}
