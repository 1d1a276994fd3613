//! A mesh that stays on its device has the same bytes as the mesh in host memory. The test reads it
//! with OpenCL or Vulkan.

use std::ptr::{null, null_mut};

use ash::vk;
use ash::vk::Handle;
use opencl3::command_queue::{CL_BLOCKING, enqueue_read_buffer};
use texere::Settings;
use texere_c::texere_status::*;
use texere_c::*;

use crate::plans::{Plan, VERTEX, bytes, devices, message, ok, sized, subjects};

/// Reads a part of a `cl_mem` through the session's own queue.
fn opencl_bytes(native: &texere_native, part: &texere_device_buffer, ready: u64) -> Vec<u8> {
    let mut read = vec![0; part.size as usize];
    let object = |number: u64| std::ptr::with_exposed_provenance_mut(number as usize);
    // SAFETY: the objects are valid until the session is freed. The event is valid until the next
    // call of the session.
    unsafe {
        let (queue, memory, event) = (object(native.queue), object(part.buffer), object(ready));
        let (offset, out) = (part.offset as usize, read.as_mut_ptr().cast());
        enqueue_read_buffer(queue, memory, CL_BLOCKING, offset, read.len(), out, 1, &event).unwrap();
    }
    read
}

/// Copies a part of a `VkBuffer` on the session's own queue to memory that the host sees.
fn vulkan_bytes(native: &texere_native, part: &texere_device_buffer) -> Vec<u8> {
    // SAFETY: the objects are valid until the session is freed. Only this thread uses the device.
    unsafe {
        let entry = ash::Entry::load().unwrap();
        let instance = ash::Instance::load(entry.static_fn(), vk::Instance::from_raw(native.instance));
        let physical = vk::PhysicalDevice::from_raw(native.physical_device);
        let device = ash::Device::load(instance.fp_v1_0(), vk::Device::from_raw(native.device));
        let queue = vk::Queue::from_raw(native.queue);
        let info = vk::BufferCreateInfo::default().size(part.size).usage(vk::BufferUsageFlags::TRANSFER_DST);
        let copy = device.create_buffer(&info, None).unwrap();
        let needed = device.get_buffer_memory_requirements(copy);
        let kinds = instance.get_physical_device_memory_properties(physical);
        let seen = vk::MemoryPropertyFlags::HOST_VISIBLE | vk::MemoryPropertyFlags::HOST_COHERENT;
        let kind = (0..kinds.memory_type_count).find(|kind| {
            needed.memory_type_bits >> kind & 1 == 1
                && kinds.memory_types[*kind as usize].property_flags.contains(seen)
        });
        let info =
            vk::MemoryAllocateInfo::default().allocation_size(needed.size).memory_type_index(kind.unwrap());
        let memory = device.allocate_memory(&info, None).unwrap();
        device.bind_buffer_memory(copy, memory, 0).unwrap();
        let info = vk::CommandPoolCreateInfo::default().queue_family_index(native.queue_family);
        let pool = device.create_command_pool(&info, None).unwrap();
        let info = vk::CommandBufferAllocateInfo::default().command_pool(pool).command_buffer_count(1);
        let commands = device.allocate_command_buffers(&info).unwrap();
        let barrier = vk::MemoryBarrier::default()
            .src_access_mask(vk::AccessFlags::SHADER_WRITE)
            .dst_access_mask(vk::AccessFlags::TRANSFER_READ);
        let range = vk::BufferCopy::default().src_offset(part.offset).size(part.size);
        device.begin_command_buffer(commands[0], &vk::CommandBufferBeginInfo::default()).unwrap();
        device.cmd_pipeline_barrier(
            commands[0],
            vk::PipelineStageFlags::COMPUTE_SHADER,
            vk::PipelineStageFlags::TRANSFER,
            vk::DependencyFlags::empty(),
            &[barrier],
            &[],
            &[],
        );
        device.cmd_copy_buffer(commands[0], vk::Buffer::from_raw(part.buffer), copy, &[range]);
        device.end_command_buffer(commands[0]).unwrap();
        let submit = vk::SubmitInfo::default().command_buffers(&commands);
        device.queue_submit(queue, &[submit], vk::Fence::null()).unwrap();
        device.queue_wait_idle(queue).unwrap();
        let mapped = device.map_memory(memory, 0, part.size, vk::MemoryMapFlags::empty()).unwrap();
        let read = std::slice::from_raw_parts(mapped.cast(), part.size as usize).to_vec();
        device.destroy_command_pool(pool, None);
        device.destroy_buffer(copy, None);
        device.free_memory(memory, None);
        read
    }
}

#[test]
fn lent_buffers_hold_the_mesh() {
    for name in devices().into_iter().filter(|name| *name != "cpu") {
        for (subject, yarns) in subjects() {
            let plan = Plan::new(&yarns, name, &Settings::of(&yarns));
            let (vertices, indices) = plan.mesh();
            let (mut session, mut native) = (null_mut(), sized());
            // SAFETY: all pointers are those of values that live as long as the calls.
            unsafe {
                ok(texere_session_new(plan.handle, null(), &mut session));
                ok(texere_session_native(session, &mut native));
            }
            for number in 0..plan.counts.chunks {
                let (mut chunk, mut mesh): (texere_chunk, texere_device_mesh) = (sized(), sized());
                // SAFETY: as above.
                unsafe {
                    ok(texere_plan_chunk(plan.handle, number, &mut chunk));
                    ok(texere_session_mesh(session, number, &mut mesh));
                }
                assert_eq!(mesh.kind, native.kind);
                let lent = [mesh.vertices, mesh.indices].map(|part| match mesh.kind {
                    TEXERE_NATIVE_OPENCL => opencl_bytes(&native, &part, mesh.ready),
                    _ => vulkan_bytes(&native, &part),
                });
                let [first, first_index] = [chunk.first_vertex as usize, chunk.first_index as usize];
                let own = &vertices[first..][..chunk.vertex_count as usize];
                let own_indices = &indices[first_index..][..chunk.index_count as usize];
                assert!(lent[0] == bytes(own), "{subject} on {name}: other vertices in chunk {number}");
                assert!(lent[1] == bytes(own_indices), "{subject} on {name}: other indices in {number}");
                let (mut read, mut read_indices) = (vec![VERTEX; own.len()], vec![7; own_indices.len()]);
                let lengths = [chunk.vertex_count, chunk.index_count];
                let (to, to_indices) = (read.as_mut_ptr(), read_indices.as_mut_ptr());
                // SAFETY: as above.
                unsafe {
                    ok(texere_session_wait(session));
                    ok(texere_session_read(session, number, to, lengths[0], to_indices, lengths[1]));
                    if number > 1 {
                        // A later chunk has taken the buffers of chunk 0 by now.
                        ok(texere_plan_chunk(plan.handle, 0, &mut chunk));
                        let (mut old, mut old_indices) =
                            (vec![VERTEX; chunk.vertex_count as usize], vec![7; chunk.index_count as usize]);
                        let (to, to_indices) = (old.as_mut_ptr(), old_indices.as_mut_ptr());
                        let gone = texere_session_read(
                            session,
                            0,
                            to,
                            chunk.vertex_count,
                            to_indices,
                            chunk.index_count,
                        );
                        assert_eq!(gone, TEXERE_ARGUMENT, "{}", message());
                    }
                }
                assert!(bytes(&read) == bytes(own) && read_indices == own_indices, "{subject} on {name}");
            }
            // SAFETY: the library looks handles up.
            unsafe { texere_session_free(session) };
        }
    }
}

#[test]
fn a_device_without_buffers_is_refused() {
    let (_, yarns) = &subjects()[0];
    let plan = Plan::new(yarns, "cpu", &Settings::of(yarns));
    let mut session = null_mut();
    // SAFETY: all pointers are those of values that live as long as the call.
    let made = unsafe { texere_session_new(plan.handle, null(), &mut session) };
    assert_eq!(made, TEXERE_UNSUPPORTED, "{}", message());
    assert!(session.is_null());
}
