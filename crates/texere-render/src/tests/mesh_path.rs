//! The judge of pictures: it draws a session's mesh by the device's own rasteriser, and lights the
//! samples as for any picture.

use bytemuck::{Pod, Zeroable};
use image::RgbImage;
use texere_core::Limits;
use texere_core::backend::{Chunk, Plan};
use texere_shaders::picture;
use wgpu::{BindingResource, BufferUsages, LoadOp, Operations, StoreOp, TextureFormat, TextureUsages};

use super::image_of;
use crate::rasteriser::{group, module, pipeline};
use crate::screen::{SAMPLES, SCREEN_GROUP};
use crate::uniform::ViewUniform;
use crate::watch::Watch;
use crate::{Background, Camera, Quality, Scene};

const DEPTH: TextureFormat = TextureFormat::Depth32Float;
const KEPT: TextureFormat = TextureFormat::Rgba16Uint;

/// `Run` of `mesh.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
struct Run {
    yarn: u32,
    first_ring: u32,
    gaps: u32,
    first_vertex: u32,
}

/// `CAP` of `mesh.wgsl`.
const CAP: u32 = 1 << 31;

/// Counts the samples in which either picture has a yarn, and those of them in which the yarns or
/// their depths differ.
const COMPARE: &str = "
@group(0) @binding(0) var drawn_depths: texture_depth_multisampled_2d;
@group(0) @binding(2) var places: texture_multisampled_2d<u32>;
@group(0) @binding(3) var depths: texture_2d_array<f32>;
@group(0) @binding(4) var kept_places: texture_2d_array<u32>;
@group(0) @binding(5) var<storage, read_write> counts: array<atomic<u32>, 2>;

@compute @workgroup_size(8, 8)
fn compare(@builtin(global_invocation_id) at: vec3<u32>) {
    let pixel = vec2<i32>(at.xy);
    let sample = i32(at.z);
    if any(at.xy >= textureDimensions(drawn_depths)) {
        return;
    }
    let one = textureLoad(drawn_depths, pixel, sample);
    let other = textureLoad(depths, pixel, sample, 0).x;
    if one >= 1.0 && other >= 1.0 {
        return;
    }
    atomicAdd(&counts[0], 1u);
    let place = textureLoad(places, pixel, sample);
    let is_other = (place.x | place.y << 16u) != textureLoad(kept_places, pixel, sample, 0).x;
    if is_other || abs(one - other) > 0.01 {
        atomicAdd(&counts[1], 1u);
    }
}";

/// Copies what the rasteriser wrote to the textures that the light shader reads.
const UNPACK: &str = "
@group(0) @binding(0) var drawn_depths: texture_depth_multisampled_2d;
@group(0) @binding(1) var directions: texture_multisampled_2d<u32>;
@group(0) @binding(2) var places: texture_multisampled_2d<u32>;
@group(0) @binding(3) var depths: texture_storage_2d_array<r32float, write>;
@group(0) @binding(4) var kept_directions: texture_storage_2d_array<rg32uint, write>;
@group(0) @binding(5) var kept_places: texture_storage_2d_array<rg32uint, write>;

@compute @workgroup_size(8, 8)
fn unpack(@builtin(global_invocation_id) at: vec3<u32>) {
    let pixel = vec2<i32>(at.xy);
    let sample = i32(at.z);
    if any(at.xy >= textureDimensions(drawn_depths)) {
        return;
    }
    let d = textureLoad(directions, pixel, sample);
    let p = textureLoad(places, pixel, sample);
    textureStore(depths, pixel, sample, vec4(textureLoad(drawn_depths, pixel, sample), 0.0, 0.0, 0.0));
    textureStore(kept_directions, pixel, sample, vec4(d.x | d.y << 16u, d.z | d.w << 16u, 0u, 0u));
    textureStore(kept_places, pixel, sample, vec4(p.x | p.y << 16u, p.z | p.w << 16u, 0u, 0u));
}";

/// The runs of a chunk, and its triangles: three vertices and the run of each.
fn triangles(plan: &Plan, chunk: &Chunk) -> (Vec<Run>, Vec<[u32; 4]>) {
    let (mut runs, mut triangles) = (Vec::new(), Vec::new());
    let sides = plan.settings().sides;
    for block in chunk.blocks().iter().filter(|block| block.quads > 0) {
        let (run, first_vertex) = (runs.len() as u32, block.first_vertex);
        runs.push(Run { yarn: block.yarn, first_ring: block.first_ring, gaps: block.quads, first_vertex });
        for quad in 0..block.quads * sides {
            let beside = if (quad + 1) % sides == 0 { quad + 1 - sides } else { quad + 1 };
            let [p, q, r, s] =
                [quad, beside, quad + sides, beside + sides].map(|corner| corner + block.first_vertex);
            triangles.extend([[p, q, r, run], [q, s, r, run]]);
        }
    }
    for cap in chunk.caps() {
        let (run, first_vertex) = (runs.len() as u32 | CAP, cap.first_vertex);
        runs.push(Run { yarn: cap.yarn, first_ring: 0, gaps: 0, first_vertex });
        let section = plan.layout().yarns()[cap.yarn as usize].section as usize;
        let corners: Vec<u32> =
            plan.cap_indices(section, cap.end).map(|index| cap.first_vertex + index).collect();
        triangles.extend(corners.chunks_exact(3).map(|corner| [corner[0], corner[1], corner[2], run]));
    }
    (runs, triangles)
}

/// The judge's result for a picture.
#[derive(Debug)]
pub(super) struct Judgement {
    /// The share of samples, among those that show a yarn, in which the mesh has another yarn, or
    /// the yarn at another depth.
    pub(super) off: f64,
    /// The picture as the scene draws it, and as the mesh shows it.
    pub(super) pictures: [RgbImage; 2],
}

/// Judges the picture of a fabric of one chunk. The picture's samples lie where the device's
/// rasteriser has them, from whatever distance the fabric is seen.
pub(super) fn judge(scene: &mut Scene, camera: &Camera) -> Judgement {
    scene.look(camera, Quality { supersampling: 1, ..Quality::default() }).unwrap();
    let mut view = ViewUniform::new(camera, Background::Ground, 1, false);
    view.spread = 0.0;
    scene.renderer.write(&scene.view, bytemuck::bytes_of(&view)).unwrap();
    scene.draw(&mut Watch::none()).unwrap();
    let drawn = lit(scene, camera);
    let plan = scene.plan.clone();
    let chunks: Vec<_> = plan.chunks(&Limits::NONE).unwrap().collect();
    assert_eq!(chunks.len(), 1);
    scene.session.mesh(&chunks[0]).unwrap();
    let [samples, others] = draw(scene, &plan, &chunks[0], camera);
    Judgement { off: f64::from(others) / f64::from(samples), pictures: [drawn, lit(scene, camera)] }
}

/// The lit picture of what is on the screen.
fn lit(scene: &Scene, camera: &Camera) -> RgbImage {
    scene.shade(&mut Watch::none()).unwrap();
    let [rgb, _] = scene.copy().unwrap();
    image_of(camera.size(), rgb)
}

/// Draws the mesh over the screen. Returns the number of samples that show a yarn, and the number
/// of those that differ from what was there.
fn draw(scene: &Scene, plan: &Plan, chunk: &Chunk, camera: &Camera) -> [u32; 2] {
    let (renderer, screen) = (&scene.renderer, scene.screen.as_ref().unwrap());
    let device = renderer.device.device();
    let [width, height] = screen.large();
    let target = |format| {
        let texture = device.create_texture(&wgpu::TextureDescriptor {
            label: None,
            size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: SAMPLES,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: TextureUsages::RENDER_ATTACHMENT | TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        });
        texture.create_view(&wgpu::TextureViewDescriptor::default())
    };
    let (depths, directions, places) = (target(DEPTH), target(KEPT), target(KEPT));
    let (runs, triangles) = triangles(plan, chunk);
    let corners = 3 * triangles.len() as u32;
    let storage = |bytes: &[u8]| renderer.filled("judge", bytes, BufferUsages::STORAGE).unwrap();
    let (runs, triangles) = (storage(bytemuck::cast_slice(&runs)), storage(bytemuck::cast_slice(&triangles)));

    let yarns = yarns(device, camera, plan.settings().sides);
    let vertices = scene.session.vertex_buffer(chunk).unwrap();
    let bound: Vec<_> = (0..)
        .zip([&scene.view, vertices, &runs, &triangles])
        .map(|(binding, buffer)| wgpu::BindGroupEntry { binding, resource: buffer.as_entire_binding() })
        .collect();
    let layout = &yarns.get_bind_group_layout(1);
    let bound = device.create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout, entries: &bound });
    let counts = renderer.filled("counts", &[0; 8], BufferUsages::STORAGE | BufferUsages::COPY_SRC).unwrap();
    let read = BufferUsages::MAP_READ | BufferUsages::COPY_DST;
    let host = renderer.device.buffer("counts", 8, read).unwrap();
    let compare = pipeline(device, &module(device, COMPARE), "compare");
    let texture = BindingResource::TextureView;
    let compared = [
        (0, texture(&depths)),
        (2, texture(&places)),
        (3, texture(&screen.depths)),
        (4, texture(&screen.places)),
        (5, counts.as_entire_binding()),
    ];
    let compared = group(device, &compare, 0, &compared);
    let unpack = pipeline(device, &module(device, UNPACK), "unpack");
    let views = [&depths, &directions, &places, &screen.depths, &screen.directions, &screen.places];
    let views: Vec<_> = (0..).zip(views).map(|(number, view)| (number, texture(view))).collect();
    let unpacked = group(device, &unpack, 0, &views);

    let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    {
        let kept = |view| {
            Some(wgpu::RenderPassColorAttachment {
                view,
                depth_slice: None,
                resolve_target: None,
                ops: Operations { load: LoadOp::Clear(wgpu::Color::TRANSPARENT), store: StoreOp::Store },
            })
        };
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: None,
            color_attachments: &[kept(&directions), kept(&places)],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &depths,
                depth_ops: Some(Operations { load: LoadOp::Clear(1.0), store: StoreOp::Store }),
                stencil_ops: None,
            }),
            ..Default::default()
        });
        pass.set_pipeline(&yarns);
        pass.set_bind_group(1, &bound, &[]);
        pass.draw(0..corners, 0..1);
    }
    {
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
        for (pipeline, bound) in [(&compare, &compared), (&unpack, &unpacked)] {
            pass.set_pipeline(pipeline);
            pass.set_bind_group(0, bound, &[]);
            pass.dispatch_workgroups(width.div_ceil(SCREEN_GROUP), height.div_ceil(SCREEN_GROUP), SAMPLES);
        }
    }
    encoder.copy_buffer_to_buffer(&counts, 0, &host, 0, 8);
    let submission = renderer.device.queue().submit([encoder.finish()]);
    host.map_async(wgpu::MapMode::Read, .., |_| ());
    renderer.device.wait(submission).unwrap();
    let view = host.get_mapped_range(..).unwrap();
    [0, 4].map(|at| u32::from_ne_bytes(view[at..at + 4].try_into().unwrap()))
}

fn yarns(device: &wgpu::Device, camera: &Camera, sides: u32) -> wgpu::RenderPipeline {
    let source = format!("{}const SIDES = {sides}u;\n{}", picture::KEPT, include_str!("mesh.wgsl"));
    let module = module(device, source);
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("yarns"),
        layout: None,
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("yarn_corner"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: &[],
        },
        primitive: wgpu::PrimitiveState {
            cull_mode: if camera.sees_inside() { None } else { Some(wgpu::Face::Back) },
            ..Default::default()
        },
        depth_stencil: Some(wgpu::DepthStencilState {
            format: DEPTH,
            depth_write_enabled: Some(true),
            depth_compare: Some(wgpu::CompareFunction::Less),
            stencil: wgpu::StencilState::default(),
            bias: wgpu::DepthBiasState::default(),
        }),
        multisample: wgpu::MultisampleState { count: SAMPLES, ..Default::default() },
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some("yarn_sample"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &[Some(KEPT.into()), Some(KEPT.into())],
        }),
        multiview_mask: None,
        cache: None,
    })
}
