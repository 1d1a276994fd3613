//! The JSON document of a GLB file. It describes the layout of the buffer, and says which yarn each
//! part of the buffer belongs to.

use std::borrow::Borrow;
use std::collections::HashMap;
use std::ops::Range;

use texere_core::backend::{Chunk, Plan};
use texere_core::{End, Material, Vertex};

use super::form::{VertexForm, index_accessor};
use super::grid::Grid;
use super::schema::{self, Accessor, Asset, Gltf, MetallicRoughness, Node, Primitive, Scene};
use crate::write::WriteError;
use crate::write::bounds::widen;
use crate::write::places::{Places, RingForm};
use crate::write::yarn_name::yarn_name;

/// A millimetre in metres, glTF's unit.
const MILLIMETRE: f32 = 0.001;

/// The roughness of yarn, in glTF from 0 (a mirror) to 1 (fully diffuse). It is a little less than
/// 1, because parallel fibres give spun yarn a faint sheen.
const ROUGHNESS: f32 = 0.9;

/// The document of a GLB file. The bounds of its positions are filled in while vertices are
/// written.
///
/// Each tube is one primitive, even if it is in several chunks. A yarn is one tube, from its first
/// ring to its last. If only a box of the cloth is written, each part of a yarn in the box is one
/// tube. Each cap is one primitive, too. Each primitive has accessors of its own for positions,
/// normals and attributes. Tubes with equally many rings share one accessor of indices. Caps share
/// one if they close the same end of yarns with the same section.
#[derive(Debug)]
pub(super) struct Document {
    gltf: Gltf,
    /// The shapes in the order of their vertices.
    shapes: Vec<Shape>,
    /// The number of columns of a vertex: positions, normals and each attribute. Each shape has one
    /// accessor of vertices for each column. The first of them has the shape's positions.
    columns: usize,
    ring: RingForm,
    /// The number of gaps between rings of the longest tube. The index pattern covers as many gaps.
    gaps: u64,
}

/// A tube or a cap.
#[derive(Debug)]
struct Shape {
    yarn: u32,
    /// The shape's vertices in the file.
    vertices: Range<u64>,
    /// The shape's indices in the pattern.
    indices: Range<u64>,
}

/// The tubes of `chunks` and then their caps, and the number of gaps between rings of the longest
/// tube. A tube that is in several chunks is one shape, from its first ring to its last.
fn shapes(
    plan: &Plan,
    chunks: impl Iterator<Item = impl Borrow<Chunk>>,
    ring: RingForm,
) -> (Vec<Shape>, u64) {
    let [sides, corners] = [plan.settings().sides, ring.corners].map(u64::from);
    let (mut tubes, mut caps) = (Vec::<Shape>::new(), Vec::new());
    let mut places = Places::new(plan, ring);
    for chunk in chunks {
        let chunk = chunk.borrow();
        for part in chunk.parts() {
            let first = places.of(chunk, part.first_vertex);
            let vertices = first..first + u64::from(part.rings) * corners;
            match tubes.last_mut() {
                // The tube goes on from the chunk before, whose last ring is the first ring of this
                // part.
                Some(tube) if tube.yarn == part.yarn && tube.vertices.end == first + corners => {
                    tube.vertices.end = vertices.end;
                }
                _ => tubes.push(Shape { yarn: part.yarn, vertices, indices: 0..0 }),
            }
        }
        caps.extend(chunk.caps().iter().map(|cap| {
            let first = places.of(chunk, cap.first_vertex);
            let section = u64::from(plan.yarn(cap.yarn as usize).section);
            let number = section * 2 + u64::from(cap.end == End::Finish);
            let each = (sides - 2) * 3;
            let indices = number * each..(number + 1) * each;
            Shape { yarn: cap.yarn, vertices: first..first + sides, indices }
        }));
        places.pass(chunk);
    }
    // If only a box of the cloth is written, a yarn may have a single ring in the box. A single
    // ring has no triangles, so it gets no shape.
    tubes.retain(|tube| tube.vertices.end - tube.vertices.start > corners);
    let mut most = 0;
    for tube in &mut tubes {
        let gaps = (tube.vertices.end - tube.vertices.start) / corners - 1;
        tube.indices = 0..gaps * sides * 6;
        most = most.max(gaps);
    }
    for cap in &mut caps {
        (cap.indices.start, cap.indices.end) =
            (cap.indices.start + most * sides * 6, cap.indices.end + most * sides * 6);
    }
    tubes.extend(caps);
    (tubes, most)
}

impl Document {
    /// Describes the mesh of `plan`, cut into `chunks`, with vertices and rings of the given
    /// forms. If vertices are packed, there are `grids`, one for each yarn.
    pub(super) fn new(
        plan: &Plan,
        chunks: impl Iterator<Item = impl Borrow<Chunk>>,
        materials: &[Material],
        form: &VertexForm,
        ring: RingForm,
        grids: Option<&[Grid]>,
    ) -> Self {
        let yarns = plan.layout().yarns();
        let mut meshes: Vec<_> = (yarns.iter().enumerate())
            .map(|(number, yarn)| schema::Mesh {
                name: yarn_name(number, yarn.origin),
                primitives: Vec::new(),
            })
            .zip(0..)
            .collect();
        let (shapes, gaps) = shapes(plan, chunks, ring);
        let mut accessors: Vec<_> = shapes.iter().flat_map(|shape| form.accessors(&shape.vertices)).collect();
        let columns = form.columns.len();
        let mut patterns = HashMap::new();
        for (number, shape) in shapes.iter().enumerate() {
            let indices = *patterns.entry(shape.indices.clone()).or_insert_with(|| {
                accessors.push(index_accessor(&shape.indices));
                accessors.len() - 1
            });
            meshes[shape.yarn as usize].0.primitives.push(Primitive {
                attributes: form.attributes(number * columns),
                indices,
                material: yarns[shape.yarn as usize].material,
            });
        }
        // If only a box of the cloth is written, some yarns may lie outside the box. They get no
        // mesh, because a mesh in glTF needs triangles.
        meshes.retain(|(mesh, _)| !mesh.primitives.is_empty());
        let nodes = nodes(&meshes, grids);
        let sides = u64::from(plan.settings().sides);
        let ends = if plan.settings().caps { 2 * plan.layout().sections().len() as u64 } else { 0 };
        let pattern = gaps * sides * 6 + ends * (sides - 2) * 3;
        let (buffer_views, buffers) = form.views(pattern, ring.vertices(plan));
        let gltf = Gltf {
            asset: asset(),
            extensions_used: form.extensions(),
            extensions_required: form.extensions(),
            scene: 0,
            scenes: [Scene { nodes: [0] }],
            nodes,
            meshes: meshes.into_iter().map(|(mesh, _)| mesh).collect(),
            materials: materials.iter().map(surface).collect(),
            accessors,
            buffer_views,
            buffers,
        };
        Self { gltf, shapes, columns, ring, gaps }
    }

    /// Calls `each` with all corners of the index pattern: the quads of the longest tube, gap after
    /// gap. With caps, the triangles of the start cap and of the finish cap of each section follow.
    /// Indices count from the first vertex of a shape.
    pub(super) fn pattern(
        &self,
        plan: &Plan,
        mut each: impl FnMut(&[u32]) -> Result<(), WriteError>,
    ) -> Result<(), WriteError> {
        let mut quads = self.ring.quads();
        for _ in 0..self.gaps {
            each(&quads)?;
            quads.iter_mut().for_each(|corner| *corner += self.ring.corners);
        }
        let sections = if plan.settings().caps { plan.layout().sections().len() } else { 0 };
        for (section, end) in
            (0..sections).flat_map(|section| [End::Start, End::Finish].map(|end| (section, end)))
        {
            each(&plan.cap_indices(section, end).collect::<Vec<_>>())?;
        }
        Ok(())
    }

    pub(super) const fn gltf(&self) -> &Gltf {
        &self.gltf
    }

    /// The size of the file's buffer, bytes. If buffer views are compressed and have no [places] in
    /// the buffer yet, it is the size of the unpacked views.
    ///
    /// [places]: Self::place
    pub(super) fn buffer_bytes(&self) -> u64 {
        self.gltf.buffers[0].byte_length
    }

    /// Places the compressed buffer views in the file's buffer, one after the other. `lengths` are
    /// the lengths of the views, bytes.
    pub(super) fn place(&mut self, lengths: impl Iterator<Item = u64>) {
        let mut end = 0;
        for (view, length) in self.gltf.buffer_views.iter_mut().zip(lengths) {
            if let Some(extensions) = &mut view.extensions {
                (extensions.value.byte_offset, extensions.value.byte_length) = (end, length);
            }
            end += length;
        }
        // A GLB file pads its buffer.
        self.gltf.buffers[0].byte_length = end.next_multiple_of(4);
    }

    /// Widens the bounds of the shapes that `vertices` belong to. `vertices` are those of the file
    /// from number `first` on. Their positions are in mm, or in steps of their yarn's grid.
    pub(super) fn include(&mut self, first: u64, vertices: &[Vertex]) {
        let end = first + vertices.len() as u64;
        let start = self.shapes.partition_point(|shape| shape.vertices.end <= first);
        for (number, shape) in self.shapes.iter().enumerate().skip(start) {
            if shape.vertices.start >= end {
                break;
            }
            let own = (shape.vertices.start.max(first) - first) as usize
                ..(shape.vertices.end.min(end) - first) as usize;
            if let Accessor { min: Some(min), max: Some(max), .. } =
                &mut self.gltf.accessors[number * self.columns]
            {
                widen([min, max], &vertices[own]);
            }
        }
    }
}

/// The version of glTF, and the program that wrote the file.
pub(super) const fn asset() -> Asset {
    Asset { version: "2.0", generator: concat!("texere ", env!("CARGO_PKG_VERSION")) }
}

/// A node for each mesh, under a node that turns millimetres into metres. `meshes` come with the
/// numbers of their yarns. With `grids`, the node of a mesh also turns steps of its yarn's grid
/// into millimetres.
fn nodes(meshes: &[(schema::Mesh, usize)], grids: Option<&[Grid]>) -> Vec<Node> {
    let yarns = meshes.iter().enumerate().map(|(mesh, (of_yarn, yarn))| {
        let grid = grids.and_then(|grids| grids.get(*yarn));
        Node {
            name: of_yarn.name.clone(),
            mesh: Some(mesh),
            translation: grid.map(|grid| grid.middle),
            scale: grid.map(|grid| [grid.step; 3]),
            ..Node::default()
        }
    });
    std::iter::once(root(meshes.len())).chain(yarns).collect()
}

/// The first node: it turns millimetres into metres. The `children` nodes that follow it are under
/// it.
pub(super) fn root(children: usize) -> Node {
    let scale = Some([MILLIMETRE; 3]);
    Node { name: "fabric".into(), scale, children: (1..=children).collect(), ..Node::default() }
}

/// The material of yarns.
pub(super) fn surface(material: &Material) -> schema::Material {
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
