//! The JSON document of a GLB file: the layout of its buffer, and the yarn of each part.

use std::borrow::Borrow;
use std::collections::HashMap;
use std::ops::Range;

use texere_core::{Chunk, Draw, Material, Origin, Plan, Vertex};

use super::json::Json;
use super::schema::{
    self, ARRAY_BUFFER, Accessor, Asset, Attributes, Buffer, BufferView, ELEMENT_ARRAY_BUFFER, FLOAT, Gltf,
    MetallicRoughness, Node, Primitive, Scene, UNSIGNED_INT,
};

/// The two views of the buffer: the index pattern, and every vertex.
const PATTERN: usize = 0;
const VERTICES: usize = 1;

const INDEX_BYTES: u64 = size_of::<u32>() as u64;
const VERTEX_BYTES: u64 = size_of::<Vertex>() as u64;

/// A millimetre in metres, glTF's unit.
const MILLIMETRE: f32 = 0.001;

/// Spun yarn is almost as rough as chalk; the rest to 1 is the faint sheen of fibres lying side by side.
const ROUGHNESS: f32 = 0.9;

/// A document whose bounds are filled in as vertices pass.
///
/// Each draw of the plan is a primitive with two accessors of its own, for positions and for normals; that of its
/// indices it shares with all draws of the same length.
#[derive(Debug)]
pub(super) struct Document {
    gltf: Gltf,
    /// The vertices of each draw, in order. The accessor of its positions is number 2 i.
    draws: Vec<Range<u64>>,
}

impl Document {
    /// Describes the mesh of `plan`, which is of shared topology, cut into `chunks`.
    pub(super) fn new(
        plan: &Plan,
        chunks: impl Iterator<Item = impl Borrow<Chunk>>,
        materials: &[Material],
    ) -> Self {
        let yarns = plan.layout().yarns();
        let mut meshes: Vec<_> = (yarns.iter().enumerate())
            .map(|(number, yarn)| schema::Mesh { name: name(number, yarn.origin), primitives: Vec::new() })
            .collect();
        let (mut all_draws, mut vertices) = (Vec::new(), 0);
        for chunk in chunks {
            vertices += u64::from(chunk.borrow().vertices());
            all_draws.extend(plan.draws(chunk.borrow()));
        }
        let mut accessors: Vec<_> = all_draws.iter().flat_map(vertex_accessors).collect();
        let mut patterns = HashMap::new();
        for (number, draw) in all_draws.iter().enumerate() {
            let indices = *patterns.entry(draw.indices.clone()).or_insert_with(|| {
                accessors.push(index_accessor(draw));
                accessors.len() - 1
            });
            meshes[draw.yarn as usize].primitives.push(Primitive {
                attributes: Attributes { position: 2 * number, normal: 2 * number + 1 },
                indices,
                material: yarns[draw.yarn as usize].material,
            });
        }
        // A region may have nothing of a yarn, and glTF has no mesh without triangles.
        meshes.retain(|mesh| !mesh.primitives.is_empty());
        let views = buffer_views(plan.counts().indices * INDEX_BYTES, vertices * VERTEX_BYTES);
        let gltf = Gltf {
            asset: Asset { version: "2.0", generator: concat!("texere ", env!("CARGO_PKG_VERSION")) },
            scene: 0,
            scenes: [Scene { nodes: [0] }],
            nodes: nodes(&meshes),
            meshes,
            materials: materials.iter().map(surface).collect(),
            accessors,
            buffers: [Buffer { byte_length: views.iter().map(|view| view.byte_length).sum() }],
            buffer_views: views,
        };
        let draws = all_draws.iter().map(|draw| draw.base_vertex..draw.base_vertex + draw.vertices).collect();
        Self { gltf, draws }
    }

    /// Bytes of the buffer.
    pub(super) fn buffer_bytes(&self) -> u64 {
        self.gltf.buffers[0].byte_length
    }

    /// Widens the bounds of the draws that `vertices`, from number `first` on, belong to.
    pub(super) fn include(&mut self, first: u64, vertices: &[Vertex]) {
        let end = first + vertices.len() as u64;
        let start = self.draws.partition_point(|draw| draw.end <= first);
        for (number, draw) in self.draws.iter().enumerate().skip(start) {
            if draw.start >= end {
                break;
            }
            let own = (draw.start.max(first) - first) as usize..(draw.end.min(end) - first) as usize;
            if let Accessor { min: Some(min), max: Some(max), .. } = &mut self.gltf.accessors[2 * number] {
                for vertex in &vertices[own] {
                    for (axis, &value) in vertex.position.iter().enumerate() {
                        min[axis] = min[axis].min(value);
                        max[axis] = max[axis].max(value);
                    }
                }
            }
        }
    }

    /// The document as text, of a length that is a multiple of four and does not depend on the bounds.
    pub(super) fn to_json(&self) -> String {
        let mut text = String::new();
        self.gltf.write(&mut text);
        let padding = text.len().next_multiple_of(4) - text.len();
        text.extend(std::iter::repeat_n(' ', padding));
        text
    }
}

/// A yarn's name, which is not always unique: a yarn of no known origin is called by its number, from 1.
fn name(number: usize, origin: Origin) -> String {
    match origin {
        Origin::Unknown => format!("yarn {}", number + 1),
        known => known.to_string(),
    }
}

/// A node for each mesh, under one that turns millimetres into metres.
fn nodes(meshes: &[schema::Mesh]) -> Vec<Node> {
    let root = Node {
        name: "fabric".into(),
        mesh: None,
        scale: Some([MILLIMETRE; 3]),
        children: (1..=meshes.len()).collect(),
    };
    let yarns = meshes.iter().enumerate().map(|(mesh, yarn)| Node {
        name: yarn.name.clone(),
        mesh: Some(mesh),
        scale: None,
        children: Vec::new(),
    });
    std::iter::once(root).chain(yarns).collect()
}

fn surface(material: &Material) -> schema::Material {
    let [red, green, blue] = material.linear_rgb();
    schema::Material {
        name: material.name.clone(),
        pbr_metallic_roughness: MetallicRoughness {
            base_color_factor: [red, green, blue, 1.0],
            metallic_factor: 0.0,
            roughness_factor: ROUGHNESS,
        },
    }
}

/// Positions and normals of a draw. Bounds start inside out, so that the first vertex sets them.
fn vertex_accessors(draw: &Draw) -> [Accessor; 2] {
    let of = |offset, [min, max]: [Option<[f32; 3]>; 2]| Accessor {
        buffer_view: VERTICES,
        byte_offset: draw.base_vertex * VERTEX_BYTES + offset,
        component_type: FLOAT,
        count: draw.vertices,
        shape: "VEC3",
        min,
        max,
    };
    let inside_out = [f32::MAX, f32::MIN].map(|bound| Some([bound; 3]));
    [of(0, inside_out), of(std::mem::offset_of!(Vertex, normal) as u64, [None; 2])]
}

fn index_accessor(draw: &Draw) -> Accessor {
    Accessor {
        buffer_view: PATTERN,
        byte_offset: draw.indices.start * INDEX_BYTES,
        component_type: UNSIGNED_INT,
        count: draw.indices.end - draw.indices.start,
        shape: "SCALAR",
        min: None,
        max: None,
    }
}

fn buffer_views(pattern_bytes: u64, vertices_bytes: u64) -> [BufferView; 2] {
    let pattern = BufferView {
        buffer: 0,
        byte_offset: 0,
        byte_length: pattern_bytes,
        byte_stride: None,
        target: ELEMENT_ARRAY_BUFFER,
    };
    let vertices = BufferView {
        buffer: 0,
        byte_offset: pattern_bytes,
        byte_length: vertices_bytes,
        byte_stride: Some(VERTEX_BYTES),
        target: ARRAY_BUFFER,
    };
    // In the order of PATTERN and VERTICES.
    [pattern, vertices]
}
