//! Draws cloth with a render pipeline of the program's own, from the buffers that texere wrote:
//! `cargo run --example draw_buffers --features wgpu,pictures`.

use std::sync::Arc;

use texere::backend::Schedule;
use texere::gpu::wgpu::{self, TextureFormat as Format, TextureUsages as Usages};
use texere::gpu::{VERTEX_LAYOUT, WgpuBackend};
use texere::{Live, Settings};

const SIZE: u32 = 1024; // pixels
const SHADER: &str = "
struct Corner { @builtin(position) at: vec4<f32>, @location(0) normal: vec3<f32> }
@vertex fn corner(@location(0) at: vec3<f32>, @location(1) normal: vec3<f32>) -> Corner {
    return Corner(vec4(at.xy / 10.0 - 1.0, 0.5 - at.z / 10.0, 1.0), normal); // 20 mm of cloth, seen from its face
}
@fragment fn shade(@location(0) normal: vec3<f32>) -> @location(0) vec4<f32> {
    return vec4(vec3(0.8, 0.75, 0.6) * max(dot(normalize(normal), vec3(0.4, 0.5, 0.77)), 0.1), 1.0);
}";

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // texere makes a fabric on a device, which may also be the program's own
    // (WgpuBackend::from_device).
    let design = texere::read("designs/herringbone.wif")?;
    let backend = Arc::new(WgpuBackend::open(0, Schedule::PerRing)?);
    let (device, queue) = (backend.device().clone(), backend.queue().clone());
    let mut live = Live::new(backend, &design.structure, Settings::default())?;
    live.update()?;

    // Textures to draw into, and a pass that draws the cloth.
    let texture = |format, usage| {
        device.create_texture(&wgpu::TextureDescriptor {
            label: None,
            format,
            usage: Usages::RENDER_ATTACHMENT | usage,
            view_formats: &[],
            size: wgpu::Extent3d { width: SIZE, height: SIZE, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
        })
    };
    let color = texture(Format::Rgba8UnormSrgb, Usages::COPY_SRC);
    let [view, depth] = [&color, &texture(Format::Depth32Float, Usages::empty())]
        .map(|texture| texture.create_view(&Default::default()));
    let mut encoder = device.create_command_encoder(&Default::default());
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: &view,
            depth_slice: None,
            resolve_target: None,
            ops: Default::default(),
        })],
        depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
            view: &depth,
            stencil_ops: None,
            depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(1.0), store: wgpu::StoreOp::Store }),
        }),
        ..Default::default()
    });
    pass.set_pipeline(&pipeline(&device));
    texere::gpu::draw(live.mesh(), &mut pass).ok_or("not a mesh of wgpu's")?;
    drop(pass);

    // Copies the picture to the host and writes it to a file.
    let host = device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: u64::from(SIZE * SIZE * 4),
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
        mapped_at_creation: false,
    });
    let layout =
        wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(SIZE * 4), rows_per_image: None };
    let target = wgpu::TexelCopyBufferInfo { buffer: &host, layout };
    encoder.copy_texture_to_buffer(color.as_image_copy(), target, color.size());
    queue.submit([encoder.finish()]);
    host.map_async(wgpu::MapMode::Read, .., |_| ());
    device.poll(wgpu::PollType::wait_indefinitely())?;
    let pixels = host.get_mapped_range(..)?;
    texere::write::picture([SIZE; 2], &pixels, std::env::temp_dir().join("herringbone.png"))?;
    Ok(())
}

/// A render pipeline whose vertices are texere's.
fn pipeline(device: &wgpu::Device) -> wgpu::RenderPipeline {
    let source = wgpu::ShaderSource::Wgsl(SHADER.into());
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor { label: None, source });
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: None,
        layout: None,
        multiview_mask: None,
        cache: None,
        multisample: Default::default(),
        primitive: Default::default(),
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: None,
            compilation_options: Default::default(),
            buffers: &[Some(VERTEX_LAYOUT)],
        },
        depth_stencil: Some(wgpu::DepthStencilState {
            format: Format::Depth32Float,
            depth_write_enabled: Some(true),
            depth_compare: Some(wgpu::CompareFunction::Less),
            stencil: Default::default(),
            bias: Default::default(),
        }),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: None,
            compilation_options: Default::default(),
            targets: &[Some(Format::Rgba8UnormSrgb.into())],
        }),
    })
}
