//! Drawing a live mesh in a caller's render pass.

use texere_core::backend::{LiveMesh, Slot};
use texere_core::{Attribute, PackedVertex, Topology, Vertex};

use crate::WgpuEngine;

/// The layout of vertex buffers: position, mm, at location 0 and normal at location 1, three floats
/// each.
pub const VERTEX_LAYOUT: wgpu::VertexBufferLayout<'static> = wgpu::VertexBufferLayout {
    array_stride: size_of::<Vertex>() as u64,
    step_mode: wgpu::VertexStepMode::Vertex,
    attributes: &wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3],
};

/// The layout of attribute buffers: the yarn, a `u32`, at location 2; angle (rad) and length along
/// the yarn (mm) at 3 and 4, a float each; tangent at 5, three floats.
pub const ATTRIBUTE_LAYOUT: wgpu::VertexBufferLayout<'static> = wgpu::VertexBufferLayout {
    array_stride: size_of::<Attribute>() as u64,
    step_mode: wgpu::VertexStepMode::Vertex,
    attributes: &wgpu::vertex_attr_array![2 => Uint32, 3 => Float32, 4 => Float32, 5 => Float32x3],
};

/// The layout of buffers of packed vertices: the two words of the position, `u32`s, at location 0,
/// and the octahedral normal at location 1, two floats from -1 to 1. [`UNPACK`](crate::UNPACK)
/// unpacks them.
pub const PACKED_LAYOUT: wgpu::VertexBufferLayout<'static> = wgpu::VertexBufferLayout {
    array_stride: size_of::<PackedVertex>() as u64,
    step_mode: wgpu::VertexStepMode::Vertex,
    attributes: &wgpu::vertex_attr_array![0 => Uint32x2, 1 => Snorm16x2],
};

/// Draws a whole live mesh in `pass`, with the pipeline that the caller has set. Vertex buffer 0
/// has the vertices ([`VERTEX_LAYOUT`]). Vertex buffer 1 has the attributes ([`ATTRIBUTE_LAYOUT`]),
/// if the mesh [keeps](LiveMesh::keep_attributes) any. The draws are those of
/// [`texere_core::backend::Plan::chunk_draws`], chunk after chunk. In each chunk the caps come
/// last.
///
/// Returns none and draws nothing if the mesh is not on a wgpu device, was never
/// [updated](LiveMesh::update), or has a topology other than [`Topology::Indexed`].
///
/// ```no_run
/// # fn example(mesh: &texere_core::backend::LiveMesh, pass: &mut wgpu::RenderPass<'_>, pipeline: &wgpu::RenderPipeline) {
/// pass.set_pipeline(pipeline); // with buffers: &[Some(VERTEX_LAYOUT)]
/// texere_wgpu::draw(mesh, pass).expect("an indexed mesh on a device of wgpu");
/// # }
/// ```
#[must_use = "none says that nothing was drawn"]
pub fn draw(mesh: &LiveMesh, pass: &mut wgpu::RenderPass<'_>) -> Option<()> {
    if mesh.plan().settings().topology != Topology::Indexed {
        return None;
    }
    let engine = WgpuEngine::of(mesh.engine())?;
    for (number, chunk) in (0..).zip(mesh.chunks()) {
        let slot = Slot::new(number);
        pass.set_vertex_buffer(0, engine.vertex_buffer(slot)?.slice(..));
        if mesh.keeps_attributes() {
            pass.set_vertex_buffer(1, engine.attribute_buffer(slot)?.slice(..));
        }
        pass.set_index_buffer(engine.index_buffer(slot)?.slice(..), wgpu::IndexFormat::Uint32);
        for draw in mesh.plan().chunk_draws(chunk) {
            pass.draw_indexed(draw.indices, draw.base_vertex, 0..1);
        }
    }
    Some(())
}
