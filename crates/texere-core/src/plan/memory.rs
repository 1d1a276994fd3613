//! How much memory a plan's work takes.

use super::{Block, CapRow, Limits, Plan, YarnRow};
use crate::padded_upload::Ends;
use crate::{PlanError, SectionPoint, Turn, Vertex};

impl Plan {
    /// The buffers that a session of the schedule per-ring keeps on a GPU while it makes the mesh of all chunks cut to
    /// `limits`, the device's own: what each holds, and its bytes. Those of the two chunks in flight come last. Where a caller
    /// cuts chunks smaller, tables are as large as a scan needs them, which goes by the device's limits.
    ///
    /// A backend may round each up to what its kernels read at a time, and adds parameters and time stamps, some hundred
    /// bytes. The 16 MiB that wgpu maps to upload through come on top where a driver takes them from the device's memory.
    /// Rings, 32 bytes each, come on top where [`Session::trajectory`](crate::Session::trajectory) is called.
    ///
    /// ```
    /// use texere_core::{ControlPoint, Limits, Plan, Settings, Yarn, Yarns};
    /// let mut yarns = Yarns::builder();
    /// yarns.yarn(Yarn::default(), &[0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1)));
    /// let plan = Plan::new(yarns.build()?.layout().clone(), Settings::default())?;
    /// let buffers = plan.device_buffers(&Limits::NONE)?;
    /// // Three points and two virtual ends; 30 vertices.
    /// assert!(buffers.contains(&("control points", 80)) && buffers.contains(&("vertices", 720)));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// **Errors**: those of [`Plan::chunks`].
    pub fn device_buffers(&self, limits: &Limits) -> Result<Vec<(&'static str, u64)>, PlanError> {
        let bytes = |count: usize, each: usize| (count * each) as u64;
        let (settings, yarns) = (self.settings(), self.layout().yarns().len());
        let turns = if self.needs_scan() { self.block_count() + yarns as u64 } else { 0 };
        let caps = if settings.caps { self.cap_pattern().len() } else { 0 };
        let mut buffers = vec![
            ("control points", self.resident_bytes()),
            ("yarns", bytes(yarns, size_of::<YarnRow>())),
            ("outlines", bytes(self.outlines().len(), size_of::<SectionPoint>())),
            ("the index pattern", bytes(6 * settings.sides as usize, size_of::<u32>())),
            ("the cap pattern", bytes(caps, size_of::<u32>())),
            ("rolls", turns * size_of::<Turn>() as u64),
        ];
        // Of two places each takes every other chunk, and grows to the largest of them. A scan goes through the chunks
        // before the mesh does, for their tables alone; where there are more than two, that shifts who takes which.
        let scanned = if self.needs_scan() { self.chunks(limits)?.count() } else { 0 };
        let shift = if scanned > 2 { scanned } else { 0 };
        let mut places = [[0; 4]; 2];
        // One by one: all tables at once would be what a caller asks about.
        for (number, chunk) in self.chunks(limits)?.enumerate() {
            let tables = [
                bytes(chunk.blocks().len(), size_of::<Block>()),
                bytes(chunk.caps().len(), size_of::<CapRow>()),
            ];
            let mesh = [
                bytes(chunk.vertices() as usize, size_of::<Vertex>()),
                bytes(chunk.indices() as usize, size_of::<u32>()),
            ];
            if number < scanned {
                grow(&mut places[number % 2][..2], tables);
            }
            let place = &mut places[(number + shift) % 2];
            grow(&mut place[..2], tables);
            grow(&mut place[2..], mesh);
        }
        let names = ["the block table", "the cap table", "vertices", "indices"];
        buffers.extend(places.into_iter().flat_map(|place| names.into_iter().zip(place)));
        buffers.retain(|(_, bytes)| *bytes > 0);
        Ok(buffers)
    }

    /// Bytes of host memory that [`Pipeline::mesh`](crate::Pipeline::mesh) takes on a CPU at its peak: the mesh, the padded
    /// control points, the block table and, where any yarn turns, the rolls. The yarns, which the caller has, are not in it.
    #[must_use]
    pub fn host_bytes(&self) -> u64 {
        let rolls = if self.needs_scan() { self.counts().rings * size_of::<Turn>() as u64 } else { 0 };
        self.counts().bytes() + self.block_table_bytes() + self.resident_bytes() + rolls
    }

    /// The same on a GPU, which keeps control points and rolls itself: the mesh, the block table, and the ends of all yarns.
    /// What a driver takes is not in it, nor the memory that it gives to send and read through, nor a copy of up to 16 MiB of
    /// the control points, which is gone before there is a mesh.
    #[must_use]
    pub fn host_bytes_beside_gpu(&self) -> u64 {
        let ends = self.counts().yarns * size_of::<Ends>() as u64;
        self.counts().bytes() + self.block_table_bytes() + ends
    }

    fn block_table_bytes(&self) -> u64 {
        self.block_count() * size_of::<Block>() as u64
    }
}

fn grow(held: &mut [u64], wanted: [u64; 2]) {
    for (held, wanted) in held.iter_mut().zip(wanted) {
        *held = wanted.max(*held);
    }
}
