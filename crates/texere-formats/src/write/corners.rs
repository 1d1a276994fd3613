//! The attributes of vertices, ring by ring.

use std::f64::consts::TAU;

use glam::DVec3;
use texere_core::backend::Plan;
use texere_core::{End, Vertex};

use super::WriteError;
use super::mesh_form::Attributes;
use super::mesh_writer::{Run, yarn_runs};
use super::places::RingForm;

/// The most vertices of a batch if the file has neither texture coordinates nor tangents. Copies of
/// a batch then take some hundred kilobytes at most.
const BATCH: usize = 4096;

/// Vertices of one yarn that follow one another in the file.
pub(super) struct Batch<'a> {
    pub(super) yarn: u32,
    /// The number of the first vertex in the file.
    pub(super) place: u64,
    pub(super) vertices: &'a [Vertex],
    /// Empty if the file has neither texture coordinates nor tangents.
    surfaces: &'a [Surface],
}

impl Batch<'_> {
    /// How a texture lies at each of the vertices. All numbers are 0 if the file has neither
    /// texture coordinates nor tangents.
    pub(super) fn surfaces(&self) -> impl Iterator<Item = Surface> {
        self.surfaces.iter().copied().chain(std::iter::repeat(Surface::default())).take(self.vertices.len())
    }
}

/// How a texture lies at a vertex.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Surface {
    /// On a tube the share of a turn round the yarn, and the distance along the yarn, mm. On a cap
    /// the place in the circle that touches the edges of the unit square.
    pub(super) uv: [f32; 2],
    /// The unit direction in which the second coordinate grows on a tube and the first on a cap.
    pub(super) tangent: [f32; 3],
    /// The sign with which normal × tangent is the direction in which the other coordinate grows.
    pub(super) sign: f32,
}

/// Gathers vertices that come piece by piece into batches. With texture coordinates or tangents a
/// batch is a ring or a cap, because these attributes follow from all vertices of a ring or a cap.
#[derive(Debug)]
pub(super) struct Corners {
    attributes: Attributes,
    sides: u32,
    ring: RingForm,
    /// The number of the first vertex of a cap in the file.
    first_of_caps: u64,
    /// The vertices that have come of the current ring or cap.
    waiting: Vec<Vertex>,
    surfaces: Vec<Surface>,
    /// The middle of the ring before, and its distance along the yarn, mm.
    before: Option<(DVec3, f64)>,
    /// The number of rings and the number of caps that are complete.
    complete: [u64; 2],
}

impl Corners {
    /// Batches of the mesh of `plan`, in a file that has such a `ring`.
    pub(super) fn new(plan: &Plan, attributes: Attributes, ring: RingForm) -> Self {
        Self {
            attributes,
            sides: plan.settings().sides,
            ring,
            first_of_caps: ring.tubes(plan),
            waiting: Vec::new(),
            surfaces: Vec::new(),
            before: None,
            complete: [0; 2],
        }
    }

    /// Calls `each` with the batches that the vertices of `run` complete.
    pub(super) fn each(
        &mut self,
        run: &Run<'_>,
        mut each: impl FnMut(Batch<'_>) -> Result<(), WriteError>,
    ) -> Result<(), WriteError> {
        let gathers = self.attributes.uv || self.attributes.tangent;
        for (yarn, own) in yarn_runs(run.chunk, self.sides, run.first, run.vertices.len()) {
            let first = run.first + own.start as u32;
            let (mut place, vertices) = (run.place + own.start as u64, &run.vertices[own]);
            if !gathers {
                for vertices in vertices.chunks(BATCH) {
                    each(Batch { yarn, place, vertices, surfaces: &[] })?;
                    place += vertices.len() as u64;
                }
                continue;
            }
            for (number, vertex) in (first..).zip(vertices) {
                self.waiting.push(*vertex);
                if self.waiting.len() == self.sides as usize {
                    let place = self.complete_loop(run, number + 1 - self.sides);
                    each(Batch { yarn, place, vertices: &self.waiting, surfaces: &self.surfaces })?;
                    self.waiting.clear();
                }
            }
        }
        Ok(())
    }

    /// Completes the ring or the cap that begins with vertex number `first` of the chunk. Returns
    /// the number of its first vertex in the file.
    fn complete_loop(&mut self, run: &Run<'_>, first: u32) -> u64 {
        let middle = self.waiting.iter().map(position).sum::<DVec3>() / f64::from(self.sides);
        self.surfaces.clear();
        if let Some(of_caps) = first.checked_sub(run.chunk.rings() * self.sides) {
            let cap = &run.chunk.caps()[(of_caps / self.sides) as usize];
            self.surfaces.extend(cap_surfaces(&self.waiting, middle, cap.end));
            let place = self.first_of_caps + self.complete[1] * u64::from(self.sides);
            self.complete[1] += 1;
            return place;
        }
        // A part begins a run of rings, unless it goes on from the chunk before.
        let begins = run.chunk.parts().binary_search_by_key(&first, |part| part.first_vertex).is_ok();
        let before = self.before.filter(|_| !begins || (first == 0 && run.goes_on));
        let mm = before.map_or(0.0, |(before, mm)| mm + before.distance(middle));
        self.before = Some((middle, mm));
        let along = along(&self.waiting, middle);
        if self.ring.corners > self.sides {
            self.waiting.push(self.waiting[0]);
        }
        let sides = self.sides as f32;
        self.surfaces.extend(self.waiting.iter().zip(0_u16..).map(|(vertex, corner)| Surface {
            uv: [f32::from(corner) / sides, mm as f32],
            tangent: on_surface(along, vertex),
            sign: -1.0,
        }));
        let place = self.complete[0] * u64::from(self.ring.corners);
        self.complete[0] += 1;
        place
    }
}

fn position(vertex: &Vertex) -> DVec3 {
    DVec3::from(vertex.position.map(f64::from))
}

/// The direction of the yarn at a ring, at right angles to the ring's plane. Seen against this
/// direction, the ring runs counter-clockwise.
fn along(ring: &[Vertex], middle: DVec3) -> DVec3 {
    let spokes = || ring.iter().map(|vertex| position(vertex) - middle);
    // The areas of the triangles between middle and ring, as vectors.
    spokes().zip(spokes().cycle().skip(1)).map(|(one, next)| one.cross(next)).sum()
}

/// The unit vector nearest to `direction` at right angles to the normal of a vertex. If no vector
/// is nearest, any unit vector at right angles to the normal.
fn on_surface(direction: DVec3, vertex: &Vertex) -> [f32; 3] {
    let normal = DVec3::from(vertex.normal.map(f64::from));
    let nearest = direction - normal * (direction.dot(normal) / normal.length_squared());
    let unit = nearest
        .try_normalize()
        .unwrap_or_else(|| normal.try_normalize().map_or(DVec3::X, DVec3::any_orthonormal_vector));
    unit.as_vec3().to_array()
}

/// The surfaces of a cap's vertices.
fn cap_surfaces(cap: &[Vertex], middle: DVec3, end: End) -> impl Iterator<Item = Surface> {
    let sides = cap.len() as f64;
    // Seen from outside, the texture is turned over at the start.
    let sign = if end == End::Start { -1.0 } else { 1.0 };
    let first = position(&cap[0]) - middle;
    cap.iter().enumerate().map(move |(side, vertex)| {
        let (sine, cosine) = (TAU * side as f64 / sides).sin_cos();
        let uv = [cosine, sine].map(|place| (0.5 + 0.5 * place) as f32);
        Surface { uv, tangent: on_surface(first, vertex), sign }
    })
}
