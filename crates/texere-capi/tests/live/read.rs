//! Reading live cloth, from C and from Rust.

use std::ops::ControlFlow;
use std::ptr::null;

use texere::mesh::MeshPiece;
use texere::{ControlPoint, Live, Vertex};
use texere_c::*;

use crate::calls::done;
use crate::common::sized;

const BLANK: Vertex = Vertex { position: [0.0; 3], normal: [0.0; 3] };

/// A mesh in the test's memory.
#[derive(Clone, Default)]
pub(crate) struct Mesh {
    pub(crate) vertices: Vec<Vertex>,
    pub(crate) indices: Vec<u32>,
}

pub(crate) fn counts(live: *const texere_live) -> texere_counts {
    let mut counts = sized();
    // SAFETY: all pointers are those of values that live as long as the calls.
    done(unsafe { texere_live_counts(live, &mut counts) });
    counts
}

/// The changes of an update, and whether the mesh was begun again.
pub(crate) fn update(live: *const texere_live) -> (Vec<texere_change>, bool) {
    let mut update: texere_update = sized();
    // SAFETY: all pointers are those of values that live as long as the calls.
    unsafe {
        done(texere_live_update(live, null(), &mut update));
        (std::slice::from_raw_parts(update.changes, update.change_count as usize).to_vec(), update.anew == 1)
    }
}

/// Reads the whole mesh into `mesh`.
pub(crate) fn read(live: *const texere_live, mesh: &mut Mesh) {
    let sizes = counts(live);
    mesh.vertices.resize(sizes.vertices as usize, BLANK);
    mesh.indices.resize(sizes.indices as usize, 0);
    let (vertices, indices) = (mesh.vertices.as_mut_ptr().cast(), mesh.indices.as_mut_ptr());
    // SAFETY: all pointers are those of values that live as long as the calls.
    done(unsafe { texere_live_mesh(live, null(), vertices, sizes.vertices, indices, sizes.indices) });
}

/// Reads only the changes into `mesh`.
pub(crate) fn follow(live: *const texere_live, changes: &[texere_change], mesh: &mut Mesh) {
    let sizes = counts(live);
    mesh.vertices.resize(sizes.vertices as usize, BLANK);
    mesh.indices.resize(sizes.indices as usize, 0);
    for change in changes {
        let vertices = mesh.vertices[change.first_vertex as usize..].as_mut_ptr().cast();
        let indices = mesh.indices[change.first_index as usize..].as_mut_ptr();
        let (vertex_count, index_count) = (change.vertex_count, change.index_count);
        // SAFETY: all pointers are those of values that live as long as the calls.
        done(unsafe { texere_live_read(live, change, vertices, vertex_count, indices, index_count) });
    }
}

/// The corners of all triangles that are drawn, draw by draw, with their yarns.
pub(crate) fn drawn(live: *const texere_live, mesh: &Mesh) -> Vec<(u32, Vec<Vertex>)> {
    let mut draws = null();
    // SAFETY: all pointers are those of values that live as long as the calls.
    let draws: &[texere_draw] = unsafe {
        done(texere_live_draws(live, &mut draws));
        std::slice::from_raw_parts(draws, counts(live).draws as usize)
    };
    let corners = |draw: &texere_draw| {
        let of = &mesh.indices[draw.first_index as usize..][..draw.index_count as usize];
        (
            draw.yarn,
            of.iter().map(|index| mesh.vertices[(draw.base_vertex + u64::from(*index)) as usize]).collect(),
        )
    };
    draws.iter().map(corners).collect()
}

/// The corners of all triangles that Rust draws, draw by draw, with their yarns. Room between yarns
/// is left out, because its contents are undefined.
pub(crate) fn rust_drawn(live: &mut Live) -> Vec<(u32, Vec<Vertex>)> {
    let mesh = live.mesh_mut();
    let (plan, mut all) = (mesh.plan().clone(), Vec::new());
    for (number, chunk) in mesh.chunks().to_vec().iter().enumerate() {
        let mut vertices = vec![BLANK; chunk.vertices() as usize];
        let mut indices = vec![0; chunk.indices() as usize];
        let _ = mesh
            .read_mesh(number, &mut |piece| {
                match piece {
                    MeshPiece::Vertices { first, vertices: lent } => {
                        vertices[first as usize..][..lent.len()].copy_from_slice(lent);
                    }
                    MeshPiece::Indices { first, indices: lent } => {
                        indices[first as usize..][..lent.len()].copy_from_slice(lent);
                    }
                    _ => {}
                }
                ControlFlow::Continue(())
            })
            .unwrap();
        all.extend(plan.chunk_draws(chunk).map(|draw| {
            let of = &indices[draw.indices.start as usize..draw.indices.end as usize];
            (draw.yarn, of.iter().map(|index| vertices[*index as usize]).collect())
        }));
    }
    all
}

pub(crate) fn yarn_points(yarns: *const texere_yarns) -> Vec<texere_point> {
    let mut sizes: texere_yarn_counts = sized();
    // SAFETY: all pointers are those of values that live as long as the calls.
    unsafe {
        done(texere_yarns_counts(yarns, &mut sizes));
        let mut offsets = vec![0; sizes.yarns as usize + 1];
        let mut points = vec![texere_point::default(); sizes.points as usize];
        let (from, to) = (offsets.as_mut_ptr(), points.as_mut_ptr());
        done(texere_yarns_points(yarns, from, sizes.yarns + 1, to, sizes.points));
        points
    }
}

pub(crate) fn points(own: &[ControlPoint]) -> Vec<texere_point> {
    let point = |own: &ControlPoint| {
        let (half_width, half_height) = (own.half_width(), own.half_height());
        texere_point { x: own.x, y: own.y, z: own.z, half_width, half_height }
    };
    own.iter().map(point).collect()
}
