//! The prims of yarns: what is in each, and where in the file.

use std::borrow::Borrow;
use std::iter;

use texere_core::Material;
use texere_core::backend::{Chunk, Plan};

use super::list::{List, three};
use crate::write::WriteError;
use crate::write::places::{Places, RingForm};
use crate::write::usda::{quoted, triple};
use crate::write::yarn_name::yarn_name;

/// The prim of a yarn.
#[derive(Debug)]
pub(super) struct Prim {
    yarn: u32,
    /// The numbers in the mesh of the yarn's first vertex and of its first vertex of a cap.
    first: [u64; 2],
    /// How many vertices the yarn's tubes have, and how many its caps have.
    vertices: [u64; 2],
    /// How many triangles the yarn's tubes have, and how many its caps have.
    triangles: [u64; 2],
    /// How many triangles of tubes, and how many of caps, have been written.
    written: [u64; 2],
    /// The least and the greatest coordinates of the vertices that have come, mm.
    pub(super) extent: [[f32; 3]; 2],
    /// The byte at which the prim begins.
    at: u64,
    /// The bytes at which its lists begin.
    pub(super) lists: [u64; List::ALL],
}

/// The prims of the mesh of `plan`, cut into `chunks`. A yarn without triangles has none.
pub(super) fn all(
    plan: &Plan,
    chunks: impl Iterator<Item = impl Borrow<Chunk>>,
    ring: RingForm,
) -> Vec<Prim> {
    let [sides, corners] = [plan.settings().sides, ring.corners].map(u64::from);
    let mut prims = Vec::<Prim>::new();
    let mut places = Places::new(plan, ring);
    for chunk in chunks {
        let chunk = chunk.borrow();
        for part in chunk.parts() {
            let first = places.of(chunk, part.first_vertex);
            if prims.last().is_none_or(|prim| prim.yarn != part.yarn) {
                prims.push(Prim::new(part.yarn, first));
            }
            let Some(prim) = prims.last_mut() else { continue };
            // A ring that the chunk before repeats counts once.
            prim.vertices[0] = first + u64::from(part.rings) * corners - prim.first[0];
            prim.triangles[0] += (u64::from(part.rings) - 1) * 2 * sides;
        }
        for cap in chunk.caps() {
            let Some(number) = find(&prims, cap.yarn) else { continue };
            let prim = &mut prims[number];
            if prim.vertices[1] == 0 {
                prim.first[1] = places.of(chunk, cap.first_vertex);
            }
            prim.vertices[1] += sides;
            prim.triangles[1] += sides - 2;
        }
        places.pass(chunk);
    }
    prims.retain(|prim| prim.triangles() > 0);
    prims
}

/// The place in `prims` of the prim of a yarn.
pub(super) fn find(prims: &[Prim], yarn: u32) -> Option<usize> {
    prims.binary_search_by_key(&yarn, |prim| prim.yarn).ok()
}

impl Prim {
    fn new(yarn: u32, first: u64) -> Self {
        Self {
            yarn,
            first: [first, 0],
            vertices: [0; 2],
            triangles: [0; 2],
            written: [0; 2],
            extent: [[f32::MAX; 3], [f32::MIN; 3]],
            at: 0,
            lists: [0; List::ALL],
        }
    }

    /// The number of the prim's vertices.
    pub(super) const fn vertices(&self) -> u64 {
        self.vertices[0] + self.vertices[1]
    }

    /// The number of the prim's triangles.
    pub(super) const fn triangles(&self) -> u64 {
        self.triangles[0] + self.triangles[1]
    }

    /// The number in the prim of the mesh's vertex number `place`. Vertices from `first_of_caps` on
    /// are those of caps.
    pub(super) const fn own(&self, place: u64, first_of_caps: u64) -> u64 {
        if place < first_of_caps { place - self.first[0] } else { self.vertices[0] + place - self.first[1] }
    }

    /// The number in the prim of the next triangle of a tube or of a cap, of which `count` are to
    /// be written.
    pub(super) const fn next(&mut self, of_cap: bool, count: u64) -> u64 {
        let written = &mut self.written[of_cap as usize];
        let number = *written;
        *written += count;
        if of_cap { self.triangles[0] + number } else { number }
    }

    /// Lays the prim into the file from byte `at` on. Returns the byte at which it ends.
    pub(super) fn lay(&mut self, at: u64, lists: &[List], plan: &Plan, materials: &[Material]) -> u64 {
        self.at = at;
        let mut end = at;
        for (number, text) in self.texts(lists, plan, materials).into_iter().enumerate() {
            end += text.len() as u64;
            if let Some(list) = lists.get(number) {
                self.lists[number] = end;
                end += list.all_bytes(self.vertices(), self.triangles());
            }
        }
        end
    }

    /// Calls `write` with the texts between the lists, and the byte at which each begins.
    pub(super) fn frame(
        &self,
        lists: &[List],
        plan: &Plan,
        materials: &[Material],
        mut write: impl FnMut(u64, &str) -> Result<(), WriteError>,
    ) -> Result<(), WriteError> {
        let ends = self
            .lists
            .iter()
            .zip(lists)
            .map(|(at, list)| at + list.all_bytes(self.vertices(), self.triangles()));
        let mut texts = iter::once(self.at).chain(ends).zip(self.texts(lists, plan, materials));
        texts.try_for_each(|(at, text)| write(at, &text))
    }

    /// The texts before and between the lists, and after the last one.
    fn texts(&self, lists: &[List], plan: &Plan, materials: &[Material]) -> Vec<String> {
        let yarn = plan.yarn(self.yarn as usize);
        let color = materials[yarn.material as usize].linear_rgb();
        let [low, high] = self.extent.map(three);
        let start = format!(
            "    def Mesh \"yarn_{number}\" (\n        displayName = {name}\n    )\n    {{\n        \
             float3[] extent = [{low}, {high}]\n        \
             color3f[] primvars:displayColor = [{color}]\n        \
             int primvars:yarn = {yarn}\n        \
             uniform token subdivisionScheme = \"none\"\n",
            number = u64::from(self.yarn) + 1,
            name = quoted(&yarn_name(self.yarn as usize, yarn.origin)),
            color = triple(color),
            yarn = self.yarn,
        );
        let starts = lists.iter().map(|list| list.start()).chain(["    }\n"]);
        let ends = iter::once(start).chain(lists.iter().map(|list| list.end().to_owned()));
        ends.zip(starts).map(|(end, start)| end + start).collect()
    }
}
