//! Meshes in the text form of Universal Scene Description: a prim for each yarn.
//!
//! Source: Pixar, "UsdGeomMesh", openusd.org.

mod list;
mod pen;
mod prim;

use std::borrow::Borrow;
use std::io::{Seek, Write};

use texere_core::Material;
use texere_core::backend::{Chunk, Plan};

use super::WriteError;
use super::bounds::widen;
use super::corners::Corners;
use super::mesh_form::MeshForm;
use super::mesh_writer::{MeshWriter, Run};
use super::places::{Places, RingForm};
use super::target::Target;
use super::usda::START;
use list::List;
use pen::Pen;
use prim::Prim;

/// The most vertices of a yarn. The format numbers them with 32 bits and a sign.
const VERTICES_MAX: u64 = i32::MAX as u64;

/// A stage that is being written.
///
/// A prim has its lists one after the other, but the mesh comes chunk by chunk. All values of a
/// list therefore have the same length as text. The place of each value is then known whatever
/// comes first, and the file grows in several places. What stands between the lists is written
/// last, because the box of a yarn is known only then.
#[derive(Debug)]
pub(super) struct UsdMeshWriter<'a, W: Write + Seek> {
    target: Target<W>,
    plan: &'a Plan,
    materials: &'a [Material],
    ring: RingForm,
    corners: Corners,
    lists: Vec<List>,
    /// A pen for each list.
    pens: Vec<Pen>,
    /// The prims of the yarns in order. A yarn without triangles has none.
    prims: Vec<Prim>,
    /// The number in the file of the first vertex of all caps.
    first_of_caps: u64,
    /// The byte at which the last prim ends.
    end: u64,
}

impl<'a, W: Write + Seek> UsdMeshWriter<'a, W> {
    /// Starts a stage.
    ///
    /// **Errors**: [`WriteError::TooManyVertices`] for a yarn of more vertices than the format
    /// numbers.
    pub(super) fn start(
        target: Target<W>,
        plan: &'a Plan,
        chunks: impl Iterator<Item = impl Borrow<Chunk>>,
        materials: &'a [Material],
        form: MeshForm,
    ) -> Result<Self, WriteError> {
        let ring = RingForm::new(plan, form.has_seam());
        let lists = List::of(form.attributes);
        let mut prims = prim::all(plan, chunks, ring);
        let mut end = START.len() as u64;
        for prim in &mut prims {
            if prim.vertices() > VERTICES_MAX {
                let (format, vertices) = ("a yarn in USD", prim.vertices());
                return Err(WriteError::TooManyVertices { format, vertices, limit: VERTICES_MAX });
            }
            end = prim.lay(end, &lists, plan, materials);
        }
        Ok(Self {
            target,
            plan,
            materials,
            ring,
            corners: Corners::new(plan, form.attributes, ring),
            pens: lists.iter().map(|_| Pen::default()).collect(),
            lists,
            prims,
            first_of_caps: ring.tubes(plan),
            end,
        })
    }

    /// Writes the triangles of `corners`, those of a tube or of a cap of a yarn. Corners count from
    /// number `first` of the mesh's vertices.
    fn triangles_of(&mut self, yarn: u32, first: u64, corners: &[u32]) -> Result<(), WriteError> {
        let Some(number) = prim::find(&self.prims, yarn) else { return Ok(()) };
        let prim = &mut self.prims[number];
        let base = prim.own(first, self.first_of_caps);
        let next = prim.next(first >= self.first_of_caps, corners.len() as u64 / 3);
        for ((list, pen), at) in self.lists.iter().zip(&mut self.pens).zip(prim.lists) {
            if list.is_of_triangles() {
                let width = list.bytes(prim.vertices());
                let at = at + list.values(next) * width;
                pen.write(&mut self.target, at, |text| list.triangles(text, next, base, corners, width))?;
            }
        }
        Ok(())
    }
}

impl<W: Write + Seek> MeshWriter<W> for UsdMeshWriter<'_, W> {
    fn vertices(&mut self, run: Run<'_>) -> Result<(), WriteError> {
        let Self { target, corners, lists, pens, prims, first_of_caps, .. } = self;
        corners.each(&run, |batch| {
            let Some(prim) = prim::find(prims, batch.yarn) else { return Ok(()) };
            let prim = &mut prims[prim];
            let [low, high] = &mut prim.extent;
            widen([low, high], batch.vertices);
            let first = prim.own(batch.place, *first_of_caps);
            for ((list, pen), at) in lists.iter().zip(&mut *pens).zip(prim.lists) {
                if !list.is_of_triangles() {
                    let at = at + first * list.bytes(prim.vertices());
                    pen.write(target, at, |text| list.vertices(text, first, &batch))?;
                }
            }
            Ok(())
        })
    }

    fn triangles(&mut self, chunk: &Chunk, places: &Places) -> Result<(), WriteError> {
        let (quads, corners) = (self.ring.quads(), u64::from(self.ring.corners));
        for part in chunk.parts() {
            let first = places.of(chunk, part.first_vertex);
            for gap in 0..u64::from(part.rings) - 1 {
                self.triangles_of(part.yarn, first + gap * corners, &quads)?;
            }
        }
        for cap in chunk.caps() {
            let section = self.plan.yarn(cap.yarn as usize).section as usize;
            let corners: Vec<_> = self.plan.cap_indices(section, cap.end).collect();
            self.triangles_of(cap.yarn, places.of(chunk, cap.first_vertex), &corners)?;
        }
        Ok(())
    }

    fn finish(self: Box<Self>) -> Result<Target<W>, WriteError> {
        let Self { mut target, plan, materials, lists, pens, prims, end, .. } = *self;
        for mut pen in pens {
            pen.lift(&mut target)?;
        }
        target.go_to(0)?;
        target.write(START.as_bytes())?;
        for prim in &prims {
            prim.frame(&lists, plan, materials, |at, text| {
                target.go_to(at)?;
                target.write(text.as_bytes())
            })?;
        }
        target.go_to(end)?;
        target.write(b"}\n")?;
        Ok(target)
    }
}
