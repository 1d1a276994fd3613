//! GLB files that hold each part of a yarn once, however often it recurs.
//!
//! Source: Khronos Group, "EXT_mesh_gpu_instancing".

use std::io::{Seek, Write};

use texere_core::backend::{Chunk, Plan};
use texere_core::{Material, Vertex};

use super::form::VertexForm;
use super::instanced_document::{Pattern, document};
use super::parts::{Kind, Parts, Triangles};
use super::start::begin;
use crate::write::WriteError;
use crate::write::bounds::Bounds;
use crate::write::mesh_form::MeshForm;
use crate::write::mesh_writer::{MeshWriter, Run, yarn_runs};
use crate::write::places::Places;
use crate::write::target::Target;

/// The control intervals of a part. With 8, 16 and 32 the file of `designs/paper/figure-7a.toml`
/// takes 17.1, 15.0 and 61.1 MB, and that of a twill of as many threads 16.0, 8.1 and 4.2 MB:
/// longer parts have fewer places, and recur more seldom.
const INTERVALS: u32 = 16;

/// The most that a coordinate of two equal parts differs, as a share of the largest coordinate of
/// the cloth: eight times the distance between neighbouring floats. A part's shape is rounded anew
/// wherever it recurs.
const OFF: f32 = 1.0 / (1 << 20) as f32;

/// The most that a coordinate of two equal parts differs in any cloth, mm: as much as in a packed
/// file. A cloth of more than 5 m has parts that recur, but differ by more.
const OFF_MOST_MM: f32 = 0.005;

/// The largest coordinate that a cloth may have, mm. The difference of two such coordinates is not
/// too large for a float.
const REACH_MOST_MM: f32 = f32::MAX / 4.0;

/// An instanced GLB file that is being written. Its parts are kept until all vertices have come.
#[derive(Debug)]
pub(in crate::write) struct InstancedGlbWriter<'a, W: Write + Seek> {
    target: Target<W>,
    plan: &'a Plan,
    materials: &'a [Material],
    form: VertexForm,
    parts: Parts,
    /// The rings of the part that is not complete yet.
    rings: Vec<Vertex>,
    /// The last ring that has begun: its number within its yarn, and the yarn.
    last: (u32, u32),
    /// The vertices of the cap that is not complete yet.
    cap: Vec<Vertex>,
}

impl<'a, W: Write + Seek> InstancedGlbWriter<'a, W> {
    /// Starts a file. It needs `bounds`, the boxes of all yarns.
    ///
    /// **Errors**: [`WriteError::Unheld`] for coordinates whose differences may not fit a float.
    pub(in crate::write) fn start(
        target: Target<W>,
        plan: &'a Plan,
        materials: &'a [Material],
        form: MeshForm,
        bounds: Option<&Bounds>,
    ) -> Result<Self, WriteError> {
        let corners = bounds.into_iter().flat_map(Bounds::yarns).flatten().flatten();
        // A yarn without vertices has an empty box.
        let reach = corners.map(|place| place.abs()).filter(|place| *place < f32::MAX).fold(0.0, f32::max);
        if reach > REACH_MOST_MM {
            let (format, what) = ("instanced GLB", format!("a coordinate of {reach:e} mm"));
            return Err(WriteError::Unheld { format, what });
        }
        let (parts, form) = (Parts::new((reach * OFF).min(OFF_MOST_MM)), VertexForm::new(form));
        let (rings, cap) = (Vec::new(), Vec::new());
        Ok(Self { target, plan, materials, form, parts, rings, last: (0, 0), cap })
    }

    fn sides(&self) -> usize {
        self.plan.settings().sides as usize
    }

    /// Begins ring number `ring` of a yarn. `begins` says that the ring does not go on from the
    /// ring before.
    fn ring(&mut self, yarn: u32, ring: u32, begins: bool) -> Result<(), WriteError> {
        let gaps = INTERVALS * (self.plan.settings().subdivisions + 1);
        let (sides, is_cut) = (self.sides(), self.last.0.is_multiple_of(gaps));
        if begins {
            self.complete()?;
            self.rings.clear();
        } else if is_cut && self.rings.len() > sides {
            self.complete()?;
            self.rings.drain(..self.rings.len() - sides);
        }
        self.last = (ring, yarn);
        Ok(())
    }

    /// Makes a part of the rings that have come, and adds it. A single ring makes no part, because
    /// it has no triangles.
    fn complete(&mut self) -> Result<(), WriteError> {
        let rings = self.rings.len() / self.sides();
        if rings < 2 {
            return Ok(());
        }
        let material = self.plan.yarn(self.last.1 as usize).material;
        let kind = Kind { triangles: Triangles::Tube { gaps: rings as u32 - 1 }, material };
        self.parts.add(kind, &self.rings)
    }
}

impl<W: Write + Seek> MeshWriter<W> for InstancedGlbWriter<'_, W> {
    fn vertices(&mut self, run: Run<'_>) -> Result<(), WriteError> {
        let (sides, tubes) = (self.plan.settings().sides, run.chunk.rings() * self.plan.settings().sides);
        for (yarn, own) in yarn_runs(run.chunk, sides, run.first, run.vertices.len()) {
            for (vertex, number) in run.vertices[own.clone()].iter().zip(run.first + own.start as u32..) {
                if let Some(of_caps) = number.checked_sub(tubes) {
                    self.cap.push(*vertex);
                    if self.cap.len() == sides as usize {
                        let cap = run.chunk.caps()[(of_caps / sides) as usize];
                        let what = self.plan.yarn(yarn as usize);
                        let triangles = Triangles::Cap { section: what.section, end: cap.end };
                        self.parts.add(Kind { triangles, material: what.material }, &self.cap)?;
                        self.cap.clear();
                    }
                    continue;
                }
                if number % sides == 0 {
                    let parts = run.chunk.parts();
                    let part = parts[parts.partition_point(|part| part.first_vertex <= number) - 1];
                    let begins = number == part.first_vertex && !(number == 0 && run.goes_on);
                    self.ring(yarn, part.first_ring + (number - part.first_vertex) / sides, begins)?;
                }
                self.rings.push(*vertex);
            }
        }
        Ok(())
    }

    /// Nothing is left to write: the triangles of all parts are in one pattern.
    fn triangles(&mut self, _: &Chunk, _: &Places) -> Result<(), WriteError> {
        Ok(())
    }

    fn finish(mut self: Box<Self>) -> Result<Target<W>, WriteError> {
        self.complete()?;
        let Self { mut target, plan, materials, form, parts, .. } = *self;
        let parts = parts.in_order();
        let pattern = Pattern::new(plan, &parts);
        begin(&document(materials, &form, &parts, &pattern), &mut target)?;
        target.write_words(&pattern.corners)?;
        for part in &parts {
            target.write_words(bytemuck::cast_slice(&part.vertices))?;
        }
        for part in parts.iter().filter(|part| part.places.len() > 1) {
            target.write_words(bytemuck::cast_slice(part.places.as_flattened()))?;
        }
        Ok(target)
    }
}
