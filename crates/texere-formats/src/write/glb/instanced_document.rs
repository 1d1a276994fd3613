//! The JSON document of an instanced GLB file: a mesh for each part of a yarn, and a node with all
//! places at which it recurs.

use std::collections::HashMap;
use std::ops::Range;

use texere_core::Material;
use texere_core::backend::Plan;

use super::document::{asset, root, surface};
use super::form::{VertexForm, index_accessor};
use super::parts::{Part, Triangles};
use super::schema::{
    Accessor, Attributes, BufferView, FLOAT, Gltf, Instancing, Mesh, Node, NodeExtensions, Primitive, Scene,
};
use crate::write::bounds::widen;
use crate::write::places::RingForm;

/// The extension that draws a mesh at many places.
const INSTANCING: &str = "EXT_mesh_gpu_instancing";

/// Bytes of a place.
const PLACE_BYTES: u64 = size_of::<[f32; 3]>() as u64;

/// The index pattern of an instanced file.
#[derive(Debug)]
pub(super) struct Pattern {
    /// The corners of the quads of the longest tube, followed by those of each kind of cap.
    pub(super) corners: Vec<u32>,
    /// Where in the corners the triangles of each kind of part lie.
    ranges: Vec<Range<u64>>,
    /// The numbers of the ranges.
    numbers: HashMap<Triangles, usize>,
}

impl Pattern {
    /// The pattern of a file with these parts.
    pub(super) fn new(plan: &Plan, parts: &[Part]) -> Self {
        let (mut corners, ring) = (Vec::new(), RingForm::new(plan, false));
        let quads = ring.quads();
        let gaps = |part: &Part| if let Triangles::Tube { gaps } = part.kind.triangles { gaps } else { 0 };
        for gap in 0..parts.iter().map(gaps).max().unwrap_or(0) {
            corners.extend(quads.iter().map(|corner| corner + gap * ring.corners));
        }
        let (mut ranges, mut numbers) = (Vec::new(), HashMap::new());
        for part in parts {
            numbers.entry(part.kind.triangles).or_insert_with(|| {
                ranges.push(match part.kind.triangles {
                    Triangles::Tube { gaps } => 0..u64::from(gaps) * quads.len() as u64,
                    Triangles::Cap { section, end } => {
                        let start = corners.len() as u64;
                        corners.extend(plan.cap_indices(section as usize, end));
                        start..corners.len() as u64
                    }
                });
                ranges.len() - 1
            });
        }
        Self { corners, ranges, numbers }
    }
}

/// The document of a file with these parts. Its buffer has the pattern first, then the vertices of
/// all parts, and then the places of those that recur.
pub(super) fn document(materials: &[Material], form: &VertexForm, parts: &[Part], pattern: &Pattern) -> Gltf {
    let vertices = parts.iter().map(|part| part.vertices.len() as u64).sum();
    let (mut buffer_views, mut buffers) = form.views(pattern.corners.len() as u64, vertices);
    let mut accessors: Vec<_> = pattern.ranges.iter().map(index_accessor).collect();
    let (mut nodes, mut meshes) = (vec![root(parts.len())], Vec::new());
    let (mut next_vertex, mut next_place) = (0, 0);
    for (number, part) in parts.iter().enumerate() {
        let end = next_vertex + part.vertices.len() as u64;
        let attributes = form.attributes(accessors.len());
        accessors.append(&mut of_vertices(form, part, next_vertex..end));
        next_vertex = end;
        let (indices, material) = (pattern.numbers[&part.kind.triangles], part.kind.material);
        let name = format!("part {}", number + 1);
        meshes
            .push(Mesh { name: name.clone(), primitives: vec![Primitive { attributes, indices, material }] });
        let mut node = Node { name, mesh: Some(number), ..Node::default() };
        if let [place] = part.places[..] {
            node.translation = Some(place);
        } else {
            let attributes = Attributes(vec![("TRANSLATION", accessors.len())]);
            node.extensions = Some(NodeExtensions { instancing: Instancing { attributes } });
            accessors.push(of_places(buffer_views.len(), next_place, part.places.len() as u64));
            next_place += part.places.len() as u64;
        }
        nodes.push(node);
    }
    let mut extensions = Vec::new();
    if next_place > 0 {
        extensions.push(INSTANCING);
        let (byte_offset, byte_length) = (buffers[0].byte_length, next_place * PLACE_BYTES);
        buffers[0].byte_length += byte_length;
        buffer_views.push(BufferView {
            buffer: 0,
            byte_offset,
            byte_length,
            byte_stride: None,
            target: None,
            extensions: None,
        });
    }
    Gltf {
        asset: asset(),
        extensions_used: extensions.clone(),
        extensions_required: extensions,
        scene: 0,
        scenes: [Scene { nodes: [0] }],
        nodes,
        meshes,
        materials: materials.iter().map(surface).collect(),
        accessors,
        buffer_views,
        buffers,
    }
}

/// The accessors of a part's vertices.
fn of_vertices(form: &VertexForm, part: &Part, vertices: Range<u64>) -> Vec<Accessor> {
    let mut accessors = form.accessors(&vertices);
    if let Accessor { min: Some(min), max: Some(max), .. } = &mut accessors[0] {
        widen([min, max], &part.vertices);
    }
    accessors
}

/// The accessor of `count` places from number `first` on.
fn of_places(view: usize, first: u64, count: u64) -> Accessor {
    Accessor {
        buffer_view: view,
        byte_offset: first * PLACE_BYTES,
        component_type: FLOAT,
        normalized: None,
        count,
        shape: "VEC3",
        min: None,
        max: None,
    }
}
