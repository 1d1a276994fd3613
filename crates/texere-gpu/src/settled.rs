//! Tables with which a device turns settled places into control points, so that the points need not
//! go through the host.

use bytemuck::{Pod, Zeroable};
use texere_core::backend::Plan;
use texere_core::settling::SettlingPlan;

/// The numbers of a yarn's places and of its padded control points.
///
/// **Shape**: eight 4-byte values, 32 bytes.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Pod, Zeroable)]
pub struct SettledRow {
    /// Number of the place of the yarn's first control point.
    pub first_place: u32,
    /// Number of the yarn's control points.
    pub points: u32,
    /// Number of the yarn's first control point among all padded control points.
    pub first_point: u32,
    /// 1 if the yarn is closed, otherwise 0.
    pub closed: u32,
    /// Half width and half height of the yarn's virtual start, as bits of two half floats. They are
    /// known beforehand, because yarns don't change their thickness while they settle.
    pub start_halves: u32,
    /// Half width and half height of the yarn's virtual end, as bits of two half floats.
    pub end_halves: u32,
    /// Unused, 0. It makes the row a multiple of 16 bytes.
    pub padding: [u32; 2],
}

const _: () = assert!(size_of::<SettledRow>() == 32 && std::mem::offset_of!(SettledRow, end_halves) == 20);

/// The parameters of a launch over all places.
///
/// **Shape**: eight 4-byte values, 32 bytes. Uniform buffers need a multiple of 16.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Default, Pod, Zeroable)]
pub struct SettledParams {
    /// The origin of places, mm.
    pub origin: [f32; 3],
    /// The unit of places, mm.
    pub unit: f32,
    /// Number of places, including those beyond yarns' ends.
    pub places: u32,
    /// Unused, 0.
    pub padding: u32,
    /// Unused, 0.
    pub more_padding: [u32; 2],
}

const _: () = assert!(size_of::<SettledParams>() == 32 && std::mem::offset_of!(SettledParams, places) == 16);

/// The box round the control points of one workgroup.
///
/// **Shape**: eight `i32`, 32 bytes.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Pod, Zeroable)]
pub struct BoundsRow {
    /// The least x, y and z, units.
    pub low: [i32; 3],
    /// Unused.
    pub padding: i32,
    /// The greatest x, y and z, units.
    pub high: [i32; 3],
    /// Unused.
    pub more_padding: i32,
}

const _: () = assert!(size_of::<BoundsRow>() == 32 && std::mem::offset_of!(BoundsRow, high) == 16);

impl BoundsRow {
    /// The box round all of `rows`: the least and the greatest coordinates, units.
    #[must_use]
    pub fn joined(rows: &[Self]) -> [[i32; 3]; 2] {
        let nothing = [[i32::MAX; 3], [i32::MIN; 3]];
        rows.iter().fold(nothing, |[low, high], row| {
            [
                [0, 1, 2].map(|axis| low[axis].min(row.low[axis])),
                [0, 1, 2].map(|axis| high[axis].max(row.high[axis])),
            ]
        })
    }
}

impl SettledRow {
    /// The rows of all yarns. `settling` gives the numbers of their places, and `plan` those of
    /// their control points. Both must have the same yarns.
    #[must_use]
    pub fn all(settling: &SettlingPlan, plan: &Plan) -> Vec<Self> {
        let rows = settling.strands().iter().enumerate().map(|(yarn, strand)| {
            let (first, last) = (strand.first as usize, (strand.first + strand.points) as usize - 1);
            let point = |place: usize| settling.scale().point(&settling.places()[place]);
            let beyond =
                |end: usize, inner: usize| bytemuck::cast(point(end).reflected(&point(inner)).halves);
            Self {
                first_place: strand.first,
                points: strand.points,
                first_point: plan.padded_offsets()[yarn] as u32 + 1,
                closed: plan.yarn(yarn).closed.into(),
                start_halves: beyond(first, first + 1),
                end_halves: beyond(last, last - 1),
                padding: [0; 2],
            }
        });
        rows.collect()
    }
}

impl SettledParams {
    /// The parameters of `settling`.
    #[must_use]
    pub fn new(settling: &SettlingPlan) -> Self {
        let scale = settling.scale();
        Self {
            origin: scale.origin().as_vec3().to_array(),
            unit: scale.unit(),
            places: settling.counts().places as u32,
            padding: 0,
            more_padding: [0; 2],
        }
    }
}
