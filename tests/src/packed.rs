//! Compares packed vertices with the mesh. This file has its own code that unpacks them, in f64.

use std::collections::HashMap;
use std::ops::ControlFlow;
use std::sync::Arc;

use glam::{DVec2, DVec3};
use texere_core::backend::{Plan, Session, SessionError};
use texere_core::{Backend, Limits, MeshPiece, MeshPlace, PackedVertex, Quantum, Settings, Vertex, Yarns};
use thiserror::Error;

/// Angle by which packing may turn a normal, rad: half a step of both coordinates in the middle of
/// a face of the octahedron, where a step turns the normal most.
const NORMAL: f64 = 6.6e-5;

/// Further angle that is allowed unless results have to be exact, rad. A GPU makes the mesh with
/// one kernel and packs vertices with another, and the two need not round alike.
const NORMAL_NEAR: f64 = 1e-5;

/// An error of packed vertices.
#[derive(Debug, Error)]
pub enum PackedError {
    /// The device failed, or packs nothing.
    #[error(transparent)]
    Session(#[from] SessionError),
    /// A packed vertex lies too far from that of the mesh.
    #[error("{place:?} lies at {actual}, not {expected}")]
    Position {
        /// The place of the vertex.
        place: MeshPlace,
        /// The vertex's position in the mesh, mm.
        expected: DVec3,
        /// The vertex's unpacked position, mm.
        actual: DVec3,
    },
    /// A normal differs too much from the mesh's.
    #[error("{place:?} points to {actual}, not {expected}")]
    Normal {
        /// The place of the vertex.
        place: MeshPlace,
        /// The mesh's normal.
        expected: DVec3,
        /// The unpacked normal.
        actual: DVec3,
    },
    /// A corner of a ring is not packed alike where it occurs again: in another chunk, in a chunk
    /// of the other limits, in a cap, or at the end of a closed yarn.
    #[error("{place:?} is {one:?} and {other:?}: a crack")]
    Crack {
        /// The place of the vertex.
        place: MeshPlace,
        /// The vertex's bits where the corner occurred first.
        one: PackedVertex,
        /// The vertex's bits where the corner occurred again.
        other: PackedVertex,
    },
}

/// Packs the vertices of `yarns` on `device`, in chunks of `limits` and in chunks of the device's
/// own limits, and checks them.
///
/// Each packed vertex has to lie within half a quantum of the mesh's vertex in each coordinate,
/// with a normal that differs by the rounding of packing alone. Unless `exact` is set, a position
/// may differ by a whole quantum, and both may differ a little more for the rounding of f32. A
/// corner of a ring has to be packed alike wherever it occurs: in a ring that a chunk or a closed
/// yarn repeats, in the chunks of both limits and, but for its normal, in a cap.
///
/// ```
/// use texere_conformance::{cases, check_packed};
/// use texere_core::Limits;
/// use texere_cpu::SerialBackend;
/// let case = &cases::all()[0];
/// let limits = Limits { blocks: 2, ..Limits::NONE };
/// check_packed(&case.yarns(), case.settings, &limits, &SerialBackend::new(), true)?;
/// # Ok::<(), texere_conformance::PackedError>(())
/// ```
///
/// **Errors**: [`PackedError`], the first one found.
pub fn check_packed(
    yarns: &Yarns,
    settings: Settings,
    limits: &Limits,
    device: &dyn Backend,
    exact: bool,
) -> Result<(), PackedError> {
    let plan = Arc::new(Plan::new(yarns.layout().clone(), settings).map_err(SessionError::from)?);
    let step = f64::from(settings.quantum.mm());
    let (most, turned) = if exact { (0.5 * step, NORMAL) } else { (step, NORMAL + NORMAL_NEAR) };
    let mut seen = HashMap::new();
    for limits in [limits, &Limits::NONE] {
        for (place, packed, vertex) in both(yarns, &plan, &limits.min(&device.info().limits), device)? {
            let near = control_point(yarns, &plan, &place);
            let (actual, expected) =
                (position(packed, near, settings.quantum), DVec3::from(vertex.position.map(f64::from)));
            // Two kernels may differ in the last digits of f32, which far from the origin are
            // coarser than a quantum.
            let digits =
                if exact { 0.0 } else { 4.0 * f64::from(f32::EPSILON) * expected.abs().max_element() };
            if !(actual - expected).abs().cmple(DVec3::splat(most + digits)).all() {
                return Err(PackedError::Position { place, expected, actual });
            }
            let (actual, expected) = (normal(packed), DVec3::from(vertex.normal.map(f64::from)));
            // The sine is compared, because the cosine does not show small angles.
            if !(actual.cross(expected).length() <= turned && actual.dot(expected) > 0.0) {
                return Err(PackedError::Normal { place, expected, actual });
            }
            let closes =
                plan.yarn(place.yarn as usize).closed && place.ring + 1 == plan.rings(place.yarn as usize);
            let ring = if closes { 0 } else { place.ring };
            // A cap has the ring's positions with a normal of its own.
            let tube = MeshPlace { cap: None, ring, ..place };
            for (place, value) in [(place, packed), (tube, PackedVertex { normal: [0; 2], ..packed })] {
                let one = *seen.entry((place, value.normal == [0; 2])).or_insert(value);
                if one != value {
                    return Err(PackedError::Crack { place, one, other: value });
                }
            }
        }
    }
    Ok(())
}

/// All packed vertices, with the mesh's vertices and their places.
fn both(
    yarns: &Yarns,
    plan: &Arc<Plan>,
    limits: &Limits,
    device: &dyn Backend,
) -> Result<Vec<(MeshPlace, PackedVertex, Vertex)>, SessionError> {
    let mut session = Session::new(device, plan.clone())?.with_limits(limits);
    session.upload(0, yarns.points())?;
    session.scan()?;
    let mut all = Vec::new();
    for chunk in plan.chunks(limits)? {
        let unwritten = PackedVertex { position: [u32::MAX; 2], normal: [i16::MIN; 2] };
        let mut packed = vec![unwritten; chunk.vertices() as usize];
        let mut vertices = vec![Vertex::default(); chunk.vertices() as usize];
        session.packed(&chunk)?;
        let _ = session.read_packed(&chunk, &mut |first, piece| {
            packed[first as usize..][..piece.len()].copy_from_slice(piece);
            ControlFlow::Continue(())
        })?;
        session.mesh(&chunk)?;
        let _ = session.read_mesh(&chunk, &mut |piece| {
            if let MeshPiece::Vertices { first, vertices: piece } = piece {
                vertices[first as usize..][..piece.len()].copy_from_slice(piece);
            }
            ControlFlow::Continue(())
        })?;
        let places = (0..).map_while(|vertex| plan.place_of_vertex(&chunk, vertex));
        all.extend(
            places
                .zip(packed.into_iter().zip(vertices))
                .map(|(place, (packed, vertex))| (place, packed, vertex)),
        );
    }
    Ok(all)
}

/// The control point at or before the first ring of the block that a vertex lies in.
fn control_point(yarns: &Yarns, plan: &Plan, place: &MeshPlace) -> DVec3 {
    let first = place.ring / texere_core::backend::BLOCK_RINGS * texere_core::backend::BLOCK_RINGS;
    let points = yarns.yarn_points(place.yarn as usize).unwrap_or_default();
    let point = points[plan.interval(first).0 as usize % points.len()];
    DVec3::new(point.x.into(), point.y.into(), point.z.into())
}

/// The position nearest to `near` that the 64 bits may stand for. Coordinates are bits 0 to 20, 21
/// to 41 and 42 to 62.
fn position(packed: PackedVertex, near: DVec3, quantum: Quantum) -> DVec3 {
    let bits = u64::from(packed.position[0]) | u64::from(packed.position[1]) << 32;
    let (step, range) = (f64::from(quantum.mm()), f64::from(1u32 << 21));
    let coordinate = |axis: usize| {
        let quanta = (bits >> (21 * axis) & 0x1f_ffff) as f64;
        (quanta + ((near[axis] / step - quanta) / range).round() * range) * step
    };
    DVec3::new(coordinate(0), coordinate(1), coordinate(2))
}

/// The unit vector of a normal that is packed as steps on an unfolded octahedron.
fn normal(packed: PackedVertex) -> DVec3 {
    let flat = DVec2::from(packed.normal.map(|steps| f64::from(steps) / 32767.0));
    let z = 1.0 - flat.x.abs() - flat.y.abs();
    let unfolded = (DVec2::ONE - DVec2::new(flat.y.abs(), flat.x.abs())) * flat.map(f64::signum);
    let level = if z < 0.0 { unfolded } else { flat };
    level.extend(z).normalize()
}
