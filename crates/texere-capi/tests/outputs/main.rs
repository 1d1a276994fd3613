//! All outputs of a plan have the same bytes from C as from Rust, on every device.

#![allow(clippy::unwrap_used, reason = "a test ends at what it did not expect")]

mod plans;
#[cfg(all(target_os = "linux", feature = "opencl", feature = "wgpu"))]
mod session;

use std::ffi::c_void;
use std::ptr::{from_mut, null, null_mut};
use std::slice::from_raw_parts;

use plans::{Plan, VERTEX, bytes, devices, message, ok, sized, subjects, whole};
use texere::mesh::{Limits, Topology};
use texere::write::Format;
use texere::{Backend, Mesh, Pipeline, Settings, WriteError, Yarns};
use texere_c::texere_status::*;
use texere_c::*;

/// Limits that cut meshes into the same chunks as the library does. The largest buffer of a chunk
/// has 16 MiB for each core, but 32 MiB at least and 64 MiB at most.
fn limits() -> Limits {
    let cores = std::thread::available_parallelism().unwrap().get() as u64;
    Limits { binding_bytes: (cores << 24).clamp(32 << 20, 64 << 20), ..Limits::NONE }
}

/// Calls `check` for all yarns on all devices, with the settings that suit the yarns.
fn everywhere(check: impl Fn(&str, &dyn Backend, &Yarns, &Settings, &Plan) + Sync) {
    for device in devices() {
        let backend = &*texere::open(device).unwrap();
        for (name, yarns) in &subjects() {
            let with = |caps, topology| {
                let settings = Settings { caps, topology, ..Settings::of(yarns) };
                let plan = Plan::new(yarns, device, &settings);
                check(&format!("{name} on {device}, {topology:?}"), backend, yarns, &settings, &plan);
            };
            // Making a mesh or its file mostly keeps only one core busy, so two checks run at once.
            std::thread::scope(|scope| {
                scope.spawn(|| with(false, Topology::Indexed));
                with(true, Topology::Shared);
            });
        }
    }
}

fn pipeline<'a>(yarns: &'a Yarns, settings: &Settings) -> Pipeline<'a> {
    Pipeline::new(yarns).settings(*settings).limits(limits())
}

fn same_mesh(name: &str, mesh: &Mesh, vertices: &[texere_vertex], indices: &[u32]) {
    assert!(bytes(&mesh.vertices) == bytes(vertices), "{name}: other vertices");
    assert!(mesh.indices == indices, "{name}: other indices");
}

#[test]
fn meshes_packed_vertices_attributes_and_rings_are_those_of_rust() {
    everywhere(|name, backend, yarns, settings, plan| {
        let mesh = pipeline(yarns, settings).mesh(backend).unwrap();
        assert_eq!(plan.counts.chunks, mesh.chunks.len() as u64, "{name}");
        let (vertices, indices) = plan.mesh();
        same_mesh(name, &mesh, &vertices, &indices);

        let mut packed = vec![texere_packed_vertex { position: [9; 2], normal: [9; 2] }; mesh.vertices.len()];
        // SAFETY: the views are those of arrays with the lengths that the counts say.
        ok(unsafe { texere_plan_packed(plan.handle, null(), &whole(&mut packed)) });
        let own = pipeline(yarns, settings).packed(backend).unwrap();
        assert!(bytes(&own) == bytes(&packed), "{name}: other packed vertices");

        let nothing = texere_attribute { yarn: 9, angle: 9.0, along: 9.0, tangent: [9.0; 3] };
        let mut attributes = vec![nothing; mesh.vertices.len()];
        // SAFETY: as above.
        ok(unsafe { texere_plan_attributes(plan.handle, null(), &whole(&mut attributes)) });
        let own = pipeline(yarns, settings).attributes(backend).unwrap();
        assert!(bytes(&own) == bytes(&attributes), "{name}: other attributes");

        // SAFETY: zeros are a valid value of `texere_ring`.
        let nothing: texere_ring = unsafe { std::mem::zeroed() };
        let mut rings = vec![nothing; plan.counts.rings as usize];
        let (mut offsets, mut count) = (null(), 0);
        // SAFETY: as above; the offsets are as many as the library says.
        let offsets = unsafe {
            ok(texere_plan_trajectory(plan.handle, null(), &whole(&mut rings)));
            ok(texere_plan_ring_offsets(plan.handle, &mut offsets, &mut count));
            from_raw_parts(offsets, count as usize)
        };
        let own = pipeline(yarns, settings).trajectory(backend).unwrap();
        assert!(bytes(&own.rings) == bytes(&rings), "{name}: other rings");
        assert_eq!(own.offsets, offsets, "{name}");
    });
}

#[test]
fn a_mesh_laid_apart_has_the_values_of_the_dense_one_and_leaves_the_rest_alone() {
    #[repr(C)]
    #[derive(Clone, Copy)]
    struct Own {
        before: u32,
        normal: [f32; 3],
        between: f32,
        position: [f32; 3],
        behind: u64,
    }
    let empty = Own { before: 1, normal: [9.0; 3], between: 2.0, position: [9.0; 3], behind: 3 };
    everywhere(|name, _, _, _, plan| {
        let (vertices, indices) = plan.mesh();
        let mut apart = vec![empty; vertices.len()];
        let mut wide = vec![[5_u32; 3]; indices.len()];
        let all = whole(&mut apart);
        let member = |offset: usize| texere_view {
            data: all.data.wrapping_byte_add(offset),
            size: all.size - offset as u64,
            ..all
        };
        let arrays = texere_mesh_arrays {
            positions: member(std::mem::offset_of!(Own, position)),
            normals: member(std::mem::offset_of!(Own, normal)),
            indices: whole(&mut wide),
            ..sized()
        };
        // SAFETY: the views are those of arrays with the lengths that the counts say.
        ok(unsafe { texere_plan_mesh_arrays(plan.handle, null(), &arrays) });
        for (own, vertex) in apart.iter().zip(&vertices) {
            assert_eq!((own.position, own.normal), (vertex.position, vertex.normal), "{name}");
            assert_eq!((own.before, own.between, own.behind), (1, 2.0, 3), "{name}");
        }
        assert!(wide.iter().map(|own| own[0]).eq(indices.iter().copied()), "{name}");
        assert!(wide.iter().all(|own| own[1..] == [5, 5]), "{name}");

        // Positions alone, without normals and indices.
        let mut positions = vec![[9.0_f32; 3]; vertices.len()];
        let arrays = texere_mesh_arrays { positions: whole(&mut positions), ..sized() };
        // SAFETY: as above.
        ok(unsafe { texere_plan_mesh_arrays(plan.handle, null(), &arrays) });
        assert!(positions.iter().eq(vertices.iter().map(|vertex| &vertex.position)), "{name}");

        // Each normal right behind its position.
        let (mut dense, mut own) = (vec![VERTEX; vertices.len()], vec![7; indices.len()]);
        let positions = whole(&mut dense);
        let normals = texere_view {
            data: positions.data.wrapping_byte_add(12),
            size: positions.size - 12,
            ..positions
        };
        let arrays = texere_mesh_arrays { positions, normals, indices: whole(&mut own), ..sized() };
        // SAFETY: as above.
        ok(unsafe { texere_plan_mesh_arrays(plan.handle, null(), &arrays) });
        assert!(bytes(&dense) == bytes(&vertices) && own == indices, "{name}");
    });
}

/// The pieces that a stream has brought so far.
struct Streamed {
    vertices: Vec<texere_vertex>,
    indices: Vec<u32>,
    draws: Vec<texere_draw>,
    /// The chunk of the last piece, and the piece's `base_vertex`.
    last: Option<(u64, u64)>,
    most: u64,
}

/// Adds a piece to those that have come. Returns 1 if the piece does not follow the one before.
unsafe extern "C" fn collect(user: *mut c_void, piece: *const texere_piece) -> i32 {
    // SAFETY: the pointers are what the test and the library say.
    let (all, piece) = unsafe { (&mut *user.cast::<Streamed>(), &*piece) };
    let [vertices, indices] = [all.vertices.len() as u64, all.indices.len() as u64];
    let mut follows = piece.struct_size as usize == size_of::<texere_piece>();
    if all.last != Some((piece.chunk, piece.base_vertex)) {
        follows &= piece.chunk == all.last.map_or(0, |(chunk, _)| chunk + 1);
        follows &= piece.base_vertex == vertices;
        all.last = Some((piece.chunk, piece.base_vertex));
        // SAFETY: as above.
        all.draws.extend(unsafe { from_raw_parts(piece.draws, piece.draw_count as usize) });
    }
    if !piece.vertices.is_null() {
        follows &= piece.first_vertex == vertices;
        // SAFETY: as above.
        all.vertices.extend(unsafe { from_raw_parts(piece.vertices, piece.vertex_count as usize) });
    }
    if !piece.indices.is_null() {
        follows &= piece.first_index == indices;
        // SAFETY: as above.
        all.indices.extend(unsafe { from_raw_parts(piece.indices, piece.index_count as usize) });
    }
    all.most = all.most.max(piece.vertex_count);
    i32::from(!follows)
}

#[test]
fn the_pieces_of_a_stream_are_the_whole_mesh() {
    everywhere(|name, backend, yarns, settings, plan| {
        let mesh = pipeline(yarns, settings).mesh(backend).unwrap();
        let mut all = Streamed { vertices: vec![], indices: vec![], draws: vec![], last: None, most: 0 };
        // SAFETY: the callback takes this pointer.
        ok(unsafe { texere_plan_stream(plan.handle, null(), Some(collect), from_mut(&mut all).cast()) });
        same_mesh(name, &mesh, &all.vertices, &all.indices);
        let draws =
            all.draws.iter().map(|draw| (draw.yarn, draw.first_index, draw.index_count, draw.base_vertex));
        let own = mesh.draws().map(|draw| {
            (draw.yarn, draw.indices.start, draw.indices.end - draw.indices.start, draw.base_vertex)
        });
        assert!(draws.eq(own), "{name}: other draws");
        // No piece is larger than a chunk, which bounds what a cancelled call still has to do.
        assert!(all.most <= limits().binding_bytes / 24, "{name}: {} vertices in a piece", all.most);
    });
}

unsafe extern "C" fn store(user: *mut c_void, offset: u64, data: *const u8, size: usize) -> i32 {
    // SAFETY: the pointers are what the test and the library say.
    let (file, bytes) = unsafe { (&mut *user.cast::<Vec<u8>>(), from_raw_parts(data, size)) };
    let (from, to) = (offset as usize, offset as usize + size);
    file.resize(file.len().max(to), 0);
    file[from..to].copy_from_slice(bytes);
    0
}

#[test]
fn a_file_for_a_callback_has_the_bytes_of_the_file() {
    everywhere(|name, backend, yarns, settings, plan| {
        let formats = [
            (TEXERE_FORMAT_PLY, Format::Ply),
            (TEXERE_FORMAT_GLB, Format::Glb),
            (TEXERE_FORMAT_STL, Format::Stl),
            (TEXERE_FORMAT_OBJ, Format::Obj),
            (TEXERE_FORMAT_PACKED_GLB, Format::PackedGlb),
            (TEXERE_FORMAT_COMPRESSED_GLB, Format::CompressedGlb),
            (TEXERE_FORMAT_INSTANCED_GLB, Format::InstancedGlb),
            (TEXERE_FORMAT_USDA, Format::Usda),
            (TEXERE_FORMAT_KHR_COMPRESSED_GLB, Format::KhrCompressedGlb),
        ];
        // Writers of files are the same for all devices, and files of text take long to write. So
        // only `cpu` tries all formats, and the other devices try one.
        let count = if backend.info().name == "cpu" { formats.len() } else { 1 };
        for (number, format) in formats.into_iter().take(count) {
            // The text of such long yarns takes minutes. Other subjects, too, have several
            // chunks in a file, because chunks of files are small.
            if matches!(format, Format::Obj | Format::Usda) && name.starts_with("several chunks") {
                continue;
            }
            let mut own = std::io::Cursor::new(Vec::new());
            let pipeline = Pipeline::new(yarns).settings(*settings);
            let rust = texere::write::stream_to(pipeline, backend, format, &mut own);
            let mut file = Vec::<u8>::new();
            // SAFETY: the callback takes this pointer.
            let status = unsafe {
                texere_plan_write_to(plan.handle, null(), number, Some(store), from_mut(&mut file).cast())
            };
            // The yarns of the subject `several chunks` are too long to be packed.
            if matches!(rust, Err(WriteError::TooLongToPack { .. })) {
                assert_eq!(status, TEXERE_UNSUPPORTED);
                continue;
            }
            rust.unwrap();
            ok(status);
            assert!(own.into_inner() == file, "{name}: another {format:?}");
        }
    });
}

unsafe extern "C" fn refuse_piece(_: *mut c_void, _: *const texere_piece) -> i32 {
    41
}

unsafe extern "C" fn refuse_bytes(_: *mut c_void, _: u64, _: *const u8, _: usize) -> i32 {
    -42
}

#[test]
fn a_callback_that_answers_otherwise_ends_the_call_with_its_number() {
    let (_, yarns) = &subjects()[0];
    let plan = Plan::new(yarns, "cpu", &Settings::of(yarns));
    // SAFETY: the callbacks take any pointer.
    unsafe {
        let ended = texere_plan_stream(plan.handle, null(), Some(refuse_piece), null_mut());
        assert_eq!(ended, TEXERE_CANCELLED);
        assert_eq!(message(), "the callback answered 41");
        let ended =
            texere_plan_write_to(plan.handle, null(), TEXERE_FORMAT_PLY, Some(refuse_bytes), null_mut());
        assert_eq!(ended, TEXERE_CANCELLED);
        assert!(message().ends_with("the callback answered -42"), "{}", message());
    }
}

/// A run, and the number of the chunk of the last piece.
struct Cancelled {
    run: *mut texere_run,
    last: u64,
}

/// Cancels the run at each piece.
unsafe extern "C" fn cancel(user: *mut c_void, piece: *const texere_piece) -> i32 {
    // SAFETY: the pointers are what the test and the library say.
    unsafe {
        let cancelled = &mut *user.cast::<Cancelled>();
        cancelled.last = (*piece).chunk;
        i32::from(texere_run_cancel(cancelled.run) != TEXERE_OK)
    }
}

#[test]
fn a_cancelled_run_ends_a_stream_before_the_next_chunk() {
    let (_, yarns) = &subjects()[3];
    let plan = Plan::new(yarns, "cpu", &Settings::of(yarns));
    assert!(plan.counts.chunks > 2);
    let mut run = null_mut();
    // SAFETY: all pointers are those of values that live as long as the calls.
    unsafe {
        ok(texere_run_new(&mut run));
        let mut cancelled = Cancelled { run, last: 0 };
        let user = from_mut(&mut cancelled).cast();
        assert_eq!(texere_plan_stream(plan.handle, run, Some(cancel), user), TEXERE_CANCELLED);
        assert_eq!((message(), cancelled.last), ("cancelled".into(), 0));
        for made in [
            texere_plan_packed(
                plan.handle,
                run,
                &whole(&mut vec![[0_u32; 3]; plan.counts.vertices as usize]),
            ),
            texere_plan_attributes(
                plan.handle,
                run,
                &whole(&mut vec![[0_u32; 6]; plan.counts.vertices as usize]),
            ),
            texere_plan_trajectory(
                plan.handle,
                run,
                &whole(&mut vec![[0_u32; 12]; plan.counts.rings as usize]),
            ),
            texere_plan_write_to(
                plan.handle,
                run,
                TEXERE_FORMAT_GLB,
                Some(store),
                from_mut(&mut Vec::<u8>::new()).cast(),
            ),
        ] {
            assert_eq!(made, TEXERE_CANCELLED, "{}", message());
        }
        texere_run_free(run);
    }
}

#[test]
fn chunks_say_where_they_lie() {
    everywhere(|name, _, _, _, plan| {
        let [mut vertices, mut indices, mut draws] = [0; 3];
        for number in 0..plan.counts.chunks {
            let mut chunk: texere_chunk = sized();
            // SAFETY: a struct of the right size.
            ok(unsafe { texere_plan_chunk(plan.handle, number, &mut chunk) });
            assert_eq!(chunk.first_vertex, vertices, "{name}");
            vertices += chunk.vertex_count;
            indices += chunk.index_count;
            draws += chunk.draw_count;
        }
        assert_eq!((vertices, draws), (plan.counts.vertices, plan.counts.draws), "{name}");
        assert!(indices == plan.counts.indices || indices == 0, "{name}");
    });
}
