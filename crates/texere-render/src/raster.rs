//! Draws a chunk without a mesh, in three steps: list the blocks in view, find the nearest triangle
//! of each sample, and work out what that triangle shows.

use std::ops::Range;
use std::sync::Arc;

use bytemuck::{Pod, Zeroable};
use texere_core::backend::{BLOCK_RINGS, Chunk, Plan};
use texere_core::{BackendError, ControlPoint, DeviceInfo, DeviceKind, Limits, Yarns};
use texere_shaders::{Resource, grid};
use texere_wgpu::{ChunkTables, LAUNCH_BLOCKS, PARAMETERS};
use wgpu::{BindingResource, BufferUsages};

use crate::rasteriser::{Keys, Kind, Pipelines, group};
use crate::screen::{SCREEN_GROUP, Screen};
use crate::watch::Watch;
use crate::{RenderError, Renderer, hairs};

/// `Sweep` of `fabric.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, Pod, Zeroable)]
struct Sweep {
    first_row: u32,
    rows: u32,
    number: u32,
    reach: f32,
    is_first: u32,
    hair_reach: f32,
    padding: [u32; 2],
}

const _: () = assert!(size_of::<Sweep>() == 32);

/// The most blocks of a chunk on CPUs and on GPUs with memory of their own: 67 million rings, which
/// these GPUs draw in a hundredth of a second. On other devices chunks are smaller, so that the
/// desktop does not wait for them. Few large chunks are faster than many small ones, because after
/// each chunk all samples are gone through once.
const BLOCKS_MOST: u64 = 1 << 20;

/// The bytes of a ring's roll and lean.
pub(crate) const ROLL_BYTES: u64 = 8;

/// The bytes of a block in the three lists of `Listed` in `fabric.wgsl`. The three counts of the
/// lists take as many bytes together.
const LISTED_BYTES: u64 = 12;

/// The bytes of the three numbers of workgroups of one indirect dispatch.
const GROUPS_BYTES: u64 = 12;

/// The number of blocks that a workgroup of `cull` tests: `CULL_GROUP / BLOCK_LANES` of
/// `cull.wgsl`.
const CULLED_BLOCKS: u32 = 8;

/// The number of blocks that a workgroup of `list_all` lists: `CULL_GROUP` of `cull.wgsl`.
const LISTED_BLOCKS: u32 = 64;

/// The buffers with which chunks are drawn, one chunk at a time. They are as large as the largest
/// chunk so far needed.
#[derive(Debug)]
pub(crate) struct Raster {
    /// The view of the next picture, which the scene writes.
    view: wgpu::Buffer,
    /// The parameters of each round. With 32-bit atomics the first round finds depths and the
    /// second finds triangles. With 64-bit atomics there is one round.
    sweeps: [wgpu::Buffer; 2],
    listed: wgpu::Buffer,
    groups: wgpu::Buffer,
    ring_rolls: wgpu::Buffer,
    /// How far a section reaches from its centre, in half widths or half heights.
    reach: f32,
    /// Whether any section turns.
    rolled: bool,
    /// The number of hairs per mm of each yarn; none if no yarn has hairs.
    hair_densities: Option<wgpu::Buffer>,
    /// Whether the next picture shows hairs.
    pub(crate) has_hairs: bool,
    /// Whether the next picture shows all of the fabric.
    pub(crate) sees_all: bool,
}

impl Raster {
    pub(crate) fn new(
        renderer: &Renderer,
        view: wgpu::Buffer,
        plan: &Plan,
        yarns: &Yarns,
    ) -> Result<Self, BackendError> {
        let buffer = |what, bytes, usage| renderer.buffer(what, bytes, usage);
        let sweep = || buffer("sweep", size_of::<Sweep>() as u64, PARAMETERS);
        let reach = plan.outlines().iter().map(|point| point.x.hypot(point.y)).fold(0.0, f32::max);
        Ok(Self {
            view,
            sweeps: [sweep()?, sweep()?],
            listed: buffer("listed blocks", 0, BufferUsages::STORAGE)?,
            groups: buffer("workgroups", 3 * GROUPS_BYTES, BufferUsages::STORAGE | BufferUsages::INDIRECT)?,
            ring_rolls: buffer("rolls of rings", 0, BufferUsages::STORAGE)?,
            reach,
            rolled: plan.needs_scan(),
            hair_densities: hairs::any(yarns).then(|| hairs::densities(renderer, yarns)).transpose()?,
            has_hairs: false,
            sees_all: false,
        })
    }

    /// Whether fibres stand off any yarn.
    pub(crate) const fn is_hairy(&self) -> bool {
        self.hair_densities.is_some()
    }

    /// The limits by which the fabric is cut into chunks. A chunk's tables fit a binding, the
    /// numbers of its triangles and hairs fit 32 bits, and it takes only a short time to draw.
    pub(crate) fn chunk_limits(plan: &Plan, yarns: &Yarns, device: &DeviceInfo) -> Limits {
        let settings = plan.settings();
        let triangles = 2 * u64::from(BLOCK_RINGS) * u64::from(settings.sides);
        // Triangles are numbered. A block has at most two caps, and each cap gets as many numbers
        // as a block.
        let hairs = if hairs::any(yarns) { hairs::OF_BLOCK } else { 0 };
        let numbered = u64::from(u32::MAX) / (3 * triangles + hairs);
        // The control points for one block: one for each interval of its rings, and three more,
        // because an interval reads four points.
        let points = u64::from(BLOCK_RINGS.div_ceil(settings.subdivisions + 1)) + 3;
        // If the caller has set a limit other than the default, that limit is kept.
        let kinds = [DeviceKind::DiscreteGpu, DeviceKind::Cpu];
        let is_fast = kinds.contains(&device.kind) && device.limits.blocks == LAUNCH_BLOCKS;
        let blocks = if is_fast { BLOCKS_MOST } else { device.limits.blocks };
        let binding = device.limits.binding_bytes;
        // A chunk binds a window of the control points. 32 points are reserved, because a window
        // begins at a multiple of `WINDOW_POINTS` (16), and the last ring reads points behind its
        // interval.
        let windows = (binding / size_of::<ControlPoint>() as u64).saturating_sub(32) / points;
        // The rolls of all rings must fit. All other tables are smaller.
        let tables = (binding / (u64::from(BLOCK_RINGS) * ROLL_BYTES)).saturating_sub(1);
        Limits { blocks: numbered.min(windows).min(tables).min(blocks).max(2), ..Limits::NONE }
    }

    /// The shaders that draw chunks with these tables.
    ///
    /// **Errors**: [`RenderError::Backend`], [`RenderError::Cancelled`].
    pub(crate) fn pipelines(
        &self,
        renderer: &Renderer,
        tables: ChunkTables<'_>,
        watch: &mut Watch<'_>,
    ) -> Result<Arc<Pipelines>, RenderError> {
        let kind = Kind { flattened: tables.are_flattened(), rolled: self.rolled, hairy: self.is_hairy() };
        renderer.rasteriser.pipelines(&renderer.device, kind, watch)
    }

    /// Draws a chunk on the rows `band` of the screen, over what earlier chunks left there, and
    /// submits the work to the device.
    pub(crate) fn draw(
        &mut self,
        renderer: &Renderer,
        pipelines: &Pipelines,
        tables: ChunkTables<'_>,
        chunk: &Chunk,
        screen: &Screen,
        band: Range<u32>,
    ) -> Result<wgpu::SubmissionIndex, BackendError> {
        let (device, keys) = (&renderer.device, renderer.rasteriser.keys);
        let rows = band.end - band.start;
        renderer.reserve(&mut self.listed, LISTED_BYTES * (chunk.blocks().len() as u64 + 1))?;
        if self.rolled {
            renderer.reserve(&mut self.ring_rolls, ROLL_BYTES * u64::from(chunk.rings()))?;
        }
        let first = Sweep {
            first_row: band.start,
            rows,
            number: 0,
            reach: self.reach,
            is_first: (chunk.index() == 0).into(),
            hair_reach: if self.has_hairs { hairs::REACH } else { 0.0 },
            padding: [0; 2],
        };
        for (number, buffer) in (0..).zip(&self.sweeps[..keys.rounds()]) {
            renderer.write(buffer, bytemuck::bytes_of(&Sweep { number, ..first }))?;
        }
        device.scoped("Queue::submit", || {
            let mut encoder = device.device().create_command_encoder(&Default::default());
            encoder.clear_buffer(&screen.keys, 0, Some(screen.key_bytes(rows)));
            encoder.clear_buffer(&self.listed, 0, Some(LISTED_BYTES));
            {
                let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
                let of = Binder { raster: self, device: device.device(), tables, screen };
                of.list(&mut pass, pipelines, chunk, self.sees_all && rows == screen.large()[1]);
                of.find(&mut pass, pipelines, chunk, keys);
                of.show(&mut pass, &pipelines.resolve, [screen.large()[0], rows]);
            }
            device.queue().submit([encoder.finish()])
        })
    }
}

/// The resources that the passes over a chunk bind.
struct Binder<'a> {
    raster: &'a Raster,
    device: &'a wgpu::Device,
    tables: ChunkTables<'a>,
    screen: &'a Screen,
}

impl Binder<'_> {
    /// The binding of a round's parameters: number 1 in group 1.
    fn sweep(&self, round: usize) -> (u32, BindingResource<'_>) {
        (1, self.raster.sweeps[round].as_entire_binding())
    }

    /// Sets `pipeline`, with tables of the session (`fabric`) in group 0 and the picture's `own`
    /// resources in group 1.
    fn set(
        &self,
        pass: &mut wgpu::ComputePass<'_>,
        pipeline: &wgpu::ComputePipeline,
        fabric: &[Resource],
        own: &[(u32, BindingResource<'_>)],
    ) {
        let tables: Vec<_> = fabric
            .iter()
            .filter_map(|&wanted| Some((wanted as u32, self.tables.resource(wanted)?)))
            .collect();
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, &group(self.device, pipeline, 0, &tables), &[]);
        pass.set_bind_group(1, &group(self.device, pipeline, 1, own), &[]);
    }

    /// Records the shader that lists the blocks that the view may show, or all blocks.
    fn list(&self, pass: &mut wgpu::ComputePass<'_>, pipelines: &Pipelines, chunk: &Chunk, all: bool) {
        use Resource::{Blocks, Params, Points};
        let blocks = chunk.blocks().len() as u32;
        let listed = (2, self.raster.listed.as_entire_binding());
        let (columns, rows) = if all {
            self.set(pass, &pipelines.list_all, &[Params], &[listed]);
            grid(blocks.div_ceil(LISTED_BLOCKS))
        } else {
            let view = (0, self.raster.view.as_entire_binding());
            self.set(pass, &pipelines.cull, &[Params, Points, Blocks], &[view, self.sweep(0), listed]);
            grid(blocks.div_ceil(CULLED_BLOCKS))
        };
        pass.dispatch_workgroups(columns, rows, 1);
    }

    /// Records the shaders that find the nearest triangle of each sample.
    fn find(&self, pass: &mut wgpu::ComputePass<'_>, pipelines: &Pipelines, chunk: &Chunk, keys: Keys) {
        use Resource::{Blocks, CapPattern, CapRows, Outlines, Params, Points, Rolls, Yarns};
        let Raster { listed, groups, ring_rolls, rolled, hair_densities, has_hairs, .. } = self.raster;
        let view = (0, self.raster.view.as_entire_binding());
        let [listed, counted, samples, rolls] =
            [(2, listed), (3, groups), (4, &self.screen.keys), (5, ring_rolls)]
                .map(|(number, buffer)| (number, buffer.as_entire_binding()));
        let Pipelines { count_listed, count_left, rasters, caps, hairs, .. } = pipelines;
        let counted_by = |pass: &mut wgpu::ComputePass<'_>, count: &wgpu::ComputePipeline| {
            pass.set_pipeline(count);
            let counts = group(self.device, count, 1, &[listed.clone(), counted.clone()]);
            pass.set_bind_group(1, &counts, &[]);
            pass.dispatch_workgroups(1, 1, 1);
        };
        for round in 0..keys.rounds() {
            let fabric = [Params, Points, Yarns, Blocks, Outlines, Rolls];
            let sweep = self.sweep(round);
            let own = [view.clone(), sweep.clone(), listed.clone(), samples.clone(), rolls.clone()];
            // If no section turns, there are no rolls.
            let without = usize::from(!rolled);
            let counts = [Some(count_listed), Some(count_left), None];
            for (number, (count, raster)) in (0..).zip(counts.into_iter().zip(rasters)) {
                if let Some(count) = count {
                    counted_by(pass, count);
                }
                self.set(pass, raster, &fabric[..6 - without], &own[..5 - without]);
                pass.dispatch_workgroups_indirect(groups, number * GROUPS_BYTES);
            }
            if !chunk.caps().is_empty() {
                let fabric = [Params, Points, Yarns, Outlines, CapRows, CapPattern];
                let own = [view.clone(), sweep.clone(), samples.clone(), rolls.clone()];
                self.set(pass, caps, &fabric, &own);
                let (columns, rows) = grid(chunk.caps().len() as u32);
                pass.dispatch_workgroups(columns, rows, 1);
            }
            if let (true, Some(hairs), Some(densities)) = (*has_hairs, hairs, hair_densities) {
                let densities = (6, densities.as_entire_binding());
                let own = [view.clone(), sweep, listed.clone(), samples.clone(), densities];
                self.set(pass, hairs, &fabric, &own);
                pass.dispatch_workgroups_indirect(groups, 0);
            }
        }
    }

    /// Records the shader that works out what the nearest triangle of each sample shows, over
    /// `columns` and `rows` of the screen.
    fn show(
        &self,
        pass: &mut wgpu::ComputePass<'_>,
        resolve: &wgpu::ComputePipeline,
        [columns, rows]: [u32; 2],
    ) {
        use Resource::{Blocks, CapPattern, CapRows, Outlines, Params, Points, Yarns};
        let fabric = [Params, Points, Yarns, Blocks, Outlines, CapRows, CapPattern];
        let own = [
            (0, self.raster.view.as_entire_binding()),
            self.sweep(0),
            (4, self.screen.keys.as_entire_binding()),
            (5, self.raster.ring_rolls.as_entire_binding()),
            (6, BindingResource::TextureView(&self.screen.depths)),
            (7, BindingResource::TextureView(&self.screen.directions)),
            (8, BindingResource::TextureView(&self.screen.places)),
        ];
        self.set(pass, resolve, &fabric, &own);
        pass.dispatch_workgroups(columns.div_ceil(SCREEN_GROUP), rows.div_ceil(SCREEN_GROUP), 1);
    }
}
