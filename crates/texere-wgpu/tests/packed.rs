//! Packed vertices in a caller's vertex shader: their layout, and the functions that unpack them.

#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test may panic")]

mod support;

use std::ops::ControlFlow;

use texere_core::{Limits, PackedVertex, Settings, Yarn};
use texere_wgpu::{PACKED_LAYOUT, UNPACK};
use wgpu::{TextureFormat::Rgba32Float, TextureUsages};

use support::{backend, plan, waves};

/// Draws each vertex into a pixel of its own, side by side. The pixels hold the positions and the
/// normals.
const DRAW: &str = "
struct Seen {
    @builtin(position) pixel: vec4<f32>,
    @location(0) @interpolate(flat) place: vec3<f32>,
    @location(1) @interpolate(flat) normal: vec3<f32>,
}
@vertex fn vertex(@builtin(vertex_index) number: u32, @location(0) words: vec2<u32>, @location(1) normal: vec2<f32>) -> Seen {
    let place = unpacked_position(words, vec3(-200.03, 100.0, 41.7), 1.0 / 4096.0);
    let across = (2.0 * f32(number) + 1.0) / WIDTH - 1.0;
    return Seen(vec4(across, 0.0, 0.5, 1.0), place, unpacked_normal(normal));
}
struct Written { @location(0) place: vec4<f32>, @location(1) normal: vec4<f32> }
@fragment fn fragment(seen: Seen) -> Written {
    return Written(vec4(seen.place, 1.0), vec4(seen.normal, 1.0));
}";

/// The length of a row of a texture that is copied must be a multiple of this, bytes.
const ROW: u32 = 256;

#[test]
fn a_vertex_shader_unpacks_what_the_host_does() {
    let backend = backend();
    let (device, queue) = (backend.device(), backend.queue());
    let yarns = waves(3, 50, Yarn { twist: 0.3, ..Yarn::default() });
    let plan = plan(&yarns, Settings { caps: true, ..Settings::default() });
    let chunk = plan.chunks(&Limits::NONE).unwrap().next().unwrap();
    let mut session = backend.lending_session(plan.clone()).unwrap();
    session.upload(0, yarns.points()).unwrap();
    session.scan().unwrap();
    session.packed(&chunk).unwrap();

    let width = (chunk.vertices() * 16).next_multiple_of(ROW) / 16;
    let source = format!("const WIDTH = {width}.0;\n{UNPACK}{DRAW}");
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: None,
        source: wgpu::ShaderSource::Wgsl(source.into()),
    });
    let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: None,
        layout: None,
        multiview_mask: None,
        cache: None,
        multisample: Default::default(),
        primitive: wgpu::PrimitiveState {
            topology: wgpu::PrimitiveTopology::PointList,
            ..Default::default()
        },
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: None,
            compilation_options: Default::default(),
            buffers: &[Some(PACKED_LAYOUT)],
        },
        depth_stencil: None,
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: None,
            compilation_options: Default::default(),
            targets: &[Some(Rgba32Float.into()), Some(Rgba32Float.into())],
        }),
    });
    let size = wgpu::Extent3d { width, height: 1, depth_or_array_layers: 1 };
    let textures = [(); 2].map(|()| {
        device.create_texture(&wgpu::TextureDescriptor {
            label: None,
            format: Rgba32Float,
            usage: TextureUsages::RENDER_ATTACHMENT | TextureUsages::COPY_SRC,
            view_formats: &[],
            size,
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
        })
    });
    let views = textures.each_ref().map(|texture| texture.create_view(&Default::default()));
    let targets = views.each_ref().map(|view| {
        Some(wgpu::RenderPassColorAttachment {
            view,
            depth_slice: None,
            resolve_target: None,
            ops: Default::default(),
        })
    });
    let mut encoder = device.create_command_encoder(&Default::default());
    let mut pass = encoder
        .begin_render_pass(&wgpu::RenderPassDescriptor { color_attachments: &targets, ..Default::default() });
    pass.set_pipeline(&pipeline);
    pass.set_vertex_buffer(0, session.packed_buffer(&chunk).unwrap().slice(..));
    pass.draw(0..chunk.vertices(), 0..1);
    drop(pass);
    let [places, normals] = textures.map(|texture| {
        let host = device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: u64::from(width) * 16,
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let layout =
            wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(width * 16), rows_per_image: None };
        encoder.copy_texture_to_buffer(
            texture.as_image_copy(),
            wgpu::TexelCopyBufferInfo { buffer: &host, layout },
            size,
        );
        host
    });
    queue.submit([encoder.finish()]);
    let [places, normals] = [&places, &normals].map(|host| {
        host.map_async(wgpu::MapMode::Read, .., |answer| answer.unwrap());
        device.poll(wgpu::PollType::wait_indefinitely()).unwrap();
        let bytes = host.get_mapped_range(..).unwrap().to_vec();
        bytemuck::pod_collect_to_vec::<u8, [f32; 4]>(&bytes)
    });

    let mut packed: Vec<PackedVertex> = Vec::new();
    let _ = session
        .read_packed(&chunk, &mut |_, piece| {
            packed.extend_from_slice(piece);
            ControlFlow::Continue(())
        })
        .unwrap();
    assert_eq!(packed.len(), chunk.vertices() as usize);
    for (packed, (place, normal)) in packed.iter().zip(places.iter().zip(&normals)) {
        let unpacked = packed.unpack([25.0, 0.0, 0.0], plan.settings().quantum);
        assert_eq!(place[..3], unpacked.position);
        let off = (0..3).map(|axis| (normal[axis] - unpacked.normal[axis]).abs()).fold(0.0, f32::max);
        assert!(off < 1e-6, "{normal:?}, not {:?}", unpacked.normal);
    }
}
