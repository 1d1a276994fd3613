//! How the vertices of a GLB file are stored.

use std::ops::Range;

use super::column::{
    COORDINATES, Column, NORMALS, OCTAHEDRAL_NORMALS, OCTAHEDRAL_TANGENTS, PACKED_NORMALS, PACKED_POSITIONS,
    PACKED_TANGENTS, POSITIONS, TANGENTS, YARNS,
};
use super::meshopt::Meshopt;
use super::schema::{
    self, ARRAY_BUFFER, Accessor, Buffer, BufferView, Compression, ELEMENT_ARRAY_BUFFER, Extension, FLOAT,
    Fallback, UNSIGNED_INT,
};
use crate::write::Format;
use crate::write::mesh_form::{Attributes, MeshForm};

/// The number of the buffer view that holds the index pattern.
const PATTERN: usize = 0;

/// The number of the first buffer view that holds vertices.
const VERTICES: usize = 1;

/// Bytes of an index.
const INDEX_BYTES: u64 = size_of::<u32>() as u64;

/// The extension that allows positions in 16-bit numbers and normals in 8-bit numbers.
const QUANTIZATION: &str = "KHR_mesh_quantization";

/// The columns of all vertices: first positions, then normals, then attributes.
#[derive(Debug)]
pub(super) struct VertexForm {
    pub(super) columns: Vec<Column>,
    /// The extension that compresses the columns, each in a buffer view of its own. Without an
    /// extension, the columns of a vertex follow one another in a buffer view of all vertices.
    pub(super) compression: Option<Meshopt>,
}

impl VertexForm {
    /// The columns of a mesh of `form`.
    pub(super) fn new(form: MeshForm) -> Self {
        let [positions, normals, tangents] = match form.format {
            Format::PackedGlb => [PACKED_POSITIONS, PACKED_NORMALS, PACKED_TANGENTS],
            Format::CompressedGlb | Format::KhrCompressedGlb => {
                [PACKED_POSITIONS, OCTAHEDRAL_NORMALS, OCTAHEDRAL_TANGENTS]
            }
            _ => [POSITIONS, NORMALS, TANGENTS],
        };
        let Attributes { uv, tangent, yarn } = form.attributes;
        let columns =
            [(true, positions), (true, normals), (uv, COORDINATES), (tangent, tangents), (yarn, YARNS)];
        let columns = columns.into_iter().filter(|(asked, _)| *asked).map(|(_, column)| column).collect();
        let compression = match form.format {
            Format::CompressedGlb => Some(Meshopt::Ext),
            Format::KhrCompressedGlb => Some(Meshopt::Khr),
            _ => None,
        };
        Self { columns, compression }
    }

    /// Whether a vertex is stored as [`Vertex`](texere_core::Vertex) is in memory.
    pub(super) fn is_as_in_memory(&self) -> bool {
        self.columns.len() == 2 && !self.is_packed()
    }

    fn is_packed(&self) -> bool {
        self.columns[0].kind != FLOAT
    }

    /// Bytes of a vertex.
    pub(super) fn bytes(&self) -> u64 {
        self.columns.iter().map(|column| column.bytes).sum()
    }

    /// The extensions that a reader has to know.
    pub(super) fn extensions(&self) -> Vec<&'static str> {
        let quantization = self.is_packed().then_some(QUANTIZATION);
        quantization.into_iter().chain(self.compression.map(Meshopt::name)).collect()
    }

    /// The accessors of a primitive's vertices, of which `first` has the positions.
    pub(super) fn attributes(&self, first: usize) -> schema::Attributes {
        schema::Attributes(self.columns.iter().map(|column| column.semantic).zip(first..).collect())
    }

    /// The accessors of a tube or a cap, one for each column. At first the minimum of its positions
    /// is the largest number and the maximum the smallest, so that the first vertex sets both.
    pub(super) fn accessors(&self, vertices: &Range<u64>) -> Vec<Accessor> {
        let (mut accessors, mut offset) = (Vec::new(), 0);
        for (number, column) in self.columns.iter().enumerate() {
            let (view, byte_offset) = if self.compression.is_some() {
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
        let columns = if self.compression.is_some() { &self.columns[..] } else { &[whole] };
        let mut views = vec![BufferView {
            buffer: 0,
            byte_offset: 0,
            byte_length: indices * INDEX_BYTES,
            byte_stride: None,
            target: Some(ELEMENT_ARRAY_BUFFER),
            extensions: self.compression("TRIANGLES", INDEX_BYTES, indices, None),
        }];
        let mut end = views[0].byte_length;
        for column in columns {
            views.push(BufferView {
                buffer: 0,
                byte_offset: end,
                byte_length: vertices * column.bytes,
                byte_stride: Some(column.bytes),
                target: Some(ARRAY_BUFFER),
                extensions: self.compression("ATTRIBUTES", column.bytes, vertices, column.filter),
            });
            end += vertices * column.bytes;
        }
        let mut buffers = vec![Buffer { byte_length: end, extensions: None }];
        if let Some(extension) = self.compression {
            // The views unpacked lie in a buffer that the file doesn't hold. The file's own buffer
            // has the number 0.
            let extensions = Some(Extension { name: extension.name(), value: Fallback { fallback: true } });
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
    ) -> Option<Extension<Compression>> {
        let value =
            Compression { buffer: 0, byte_offset: 0, byte_length: 0, byte_stride, count, mode, filter };
        self.compression.map(|extension| Extension { name: extension.name(), value })
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
