//! The memory that a plan's work needs.

use texere_core::backend::{Block, Chunk, Plan};
use texere_core::definitions::Turn;
use texere_core::{Limits, PlanError, SectionPoint, Vertex};

use crate::tables::{CapRow, YarnRow, cap_pattern, lean_count};
use crate::upload::Ends;

/// The buffers that a session of the schedule per-ring keeps on a GPU while it makes the meshes of
/// all chunks of `plan`. Each entry names what a buffer holds, and gives the buffer's bytes. The
/// buffers of the two chunks in flight come last. `limits` are the limits to which the chunks of
/// the caller and those of a [scan](texere_core::backend::Session::with_limits) are cut.
///
/// These are not counted:
/// - the rounding up of each buffer to what kernels read at a time,
/// - parameters and time stamps, some hundred bytes,
/// - the 16 MiB that wgpu maps to upload through, and two buffers of up to 96 MiB each through
///   which it reads results, which some drivers take from the device's memory,
/// - rings, 48 bytes each, if [`Session::trajectory`](texere_core::backend::Session::trajectory) is
///   called,
/// - packed vertices, 12 bytes each, if [`Session::packed`](texere_core::backend::Session::packed)
///   is called,
/// - attributes of vertices and the lengths of yarn before blocks, if
///   [`Session::attributes`](texere_core::backend::Session::attributes) is called.
///
/// ```
/// use texere_core::backend::Plan;
/// use texere_core::{ControlPoint, Limits, Settings, Yarn, Yarns};
/// let mut yarns = Yarns::builder();
/// yarns.yarn(Yarn::default(), &[0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1)));
/// let plan = Plan::new(yarns.build()?.layout().clone(), Settings::default())?;
/// let buffers = texere_gpu::device_buffers(&plan, &Limits::NONE)?;
/// // Three points and two virtual ends; 30 vertices.
/// assert!(buffers.contains(&("control points", 80)) && buffers.contains(&("vertices", 720)));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// **Errors**: the errors of [`Plan::chunks`].
pub fn device_buffers(plan: &Plan, limits: &Limits) -> Result<Vec<(&'static str, u64)>, PlanError> {
    let bytes = |count: usize, each: usize| (count * each) as u64;
    let (settings, yarns) = (plan.settings(), plan.layout().yarns().len());
    let turns = if plan.needs_scan() { plan.block_count() + yarns as u64 } else { 0 } + lean_count(plan);
    let caps = cap_pattern(plan).len();
    let mut buffers = vec![
        ("control points", plan.resident_bytes()),
        ("yarns", bytes(yarns, size_of::<YarnRow>())),
        ("outlines", bytes(plan.outlines().len(), size_of::<SectionPoint>())),
        ("the index pattern", bytes(6 * settings.sides as usize, size_of::<u32>())),
        ("the cap pattern", bytes(caps, size_of::<u32>())),
        ("rolls", turns * size_of::<Turn>() as u64),
    ];
    // Chunks are loaded into the two slots alternately, and a slot's memory grows to that of the
    // largest chunk in it. A scan loads the tables of its chunks first. If it has more than two, or
    // if the caller's chunks are those of a region, which are no chunks of the scan, the caller's
    // first chunk comes into the slot after that of the scan's last one.
    let mut places = [[0; 4]; 2];
    let tables = |chunk: &Chunk| {
        [bytes(chunk.blocks().len(), size_of::<Block>()), bytes(chunk.caps().len(), size_of::<CapRow>())]
    };
    let mut scanned = 0;
    if plan.needs_scan() {
        // A region's scan goes over the whole plan.
        for chunk in plan.whole().chunks(limits)? {
            grow(&mut places[scanned % 2][..2], tables(&chunk));
            scanned += 1;
        }
    }
    let shift = if scanned > 2 || !plan.is_whole() { scanned } else { 0 };
    // Chunks are made one by one, because the tables of all chunks together may need as much memory
    // as a device has.
    for (number, chunk) in plan.chunks(limits)?.enumerate() {
        let mesh = [
            bytes(chunk.vertices() as usize, size_of::<Vertex>()),
            bytes(chunk.indices() as usize, size_of::<u32>()),
        ];
        let place = &mut places[(number + shift) % 2];
        grow(&mut place[..2], tables(&chunk));
        grow(&mut place[2..], mesh);
    }
    let names = ["the block table", "the cap table", "vertices", "indices"];
    buffers.extend(places.into_iter().flat_map(|place| names.into_iter().zip(place)));
    buffers.retain(|(_, bytes)| *bytes > 0);
    Ok(buffers)
}

/// The peak bytes of host memory that [`Pipeline::mesh`](texere_core::Pipeline::mesh) needs with a
/// GPU: the bytes of the mesh, of the block table, and of the ends of all yarns. Control points and
/// rolls are kept on the GPU. [`Plan::host_bytes`] gives the bytes for a CPU.
#[must_use]
pub fn host_bytes_beside_gpu(plan: &Plan) -> u64 {
    let blocks = plan.block_count() * size_of::<Block>() as u64;
    plan.counts().bytes() + blocks + plan.counts().yarns * size_of::<Ends>() as u64
}

fn grow(held: &mut [u64], wanted: [u64; 2]) {
    for (held, wanted) in held.iter_mut().zip(wanted) {
        *held = wanted.max(*held);
    }
}
