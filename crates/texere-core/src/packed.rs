//! Packed vertices: half the bytes of a [`Vertex`], on a grid that the whole fabric shares.

use bytemuck::{Pod, Zeroable};

use crate::Vertex;

/// The step of the grid that packed positions lie on: a power of two of mm, the same for a whole
/// fabric.
///
/// It is one of the [`Settings`](crate::Settings). A finer step is more exact, a coarser one
/// [reaches](Quantum::reach) further.
///
/// ```
/// use texere_core::Quantum;
/// let usual = Quantum::default();
/// assert_eq!((usual.mm(), usual.reach().ceil()), (1.0 / 4096.0, 256.0));
/// // A cloth of 1.5 m, seen from its middle.
/// assert_eq!(Quantum::reaching(750.0).mm(), 1.0 / 1024.0);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Quantum {
    exponent: i8,
}

/// The exponents of the finest and the coarsest quantum. With the finest, a fibre of the least
/// radius is a thousand quanta thick. The coarsest reaches across all coordinates.
const EXPONENTS: std::ops::RangeInclusive<i8> = -24..=11;

/// The bits of a coordinate.
const COORDINATE: u32 = (1 << Quantum::BITS) - 1;

impl Default for Quantum {
    /// [`Quantum::USUAL`].
    fn default() -> Self {
        Self::USUAL
    }
}

impl Quantum {
    /// 2⁻¹² mm, a quarter of a micrometre: 1/400 of the radius of a thread of 0.2 mm. It reaches
    /// 256 mm.
    pub const USUAL: Self = Self { exponent: -12 };

    /// Bits of each packed coordinate.
    pub const BITS: u32 = 21;

    /// The quanta after which packed coordinates repeat.
    pub const WRAP: f32 = (1 << Self::BITS) as f32;

    /// The finest quantum that reaches `mm`, at least 2⁻²⁴ mm. If none reaches it, the coarsest: 2
    /// m.
    #[must_use]
    pub fn reaching(mm: f32) -> Self {
        let all = EXPONENTS.map(|exponent| Self { exponent });
        all.clone().find(|quantum| quantum.reach() >= mm).unwrap_or(Self { exponent: *EXPONENTS.end() })
    }

    /// Its length, mm.
    #[must_use]
    #[inline]
    pub const fn mm(self) -> f32 {
        f32::from_bits(((127 + self.exponent as i32) as u32) << 23)
    }

    /// The number of quanta in a mm.
    #[must_use]
    #[inline]
    pub const fn per_mm(self) -> f32 {
        f32::from_bits(((127 - self.exponent as i32) as u32) << 23)
    }

    /// The largest distance, mm, in x, y or z between a vertex and the place near which it is
    /// [unpacked](PackedVertex::unpack): half of the range of a packed coordinate, less the
    /// rounding of both.
    #[must_use]
    pub const fn reach(self) -> f32 {
        (Self::WRAP / 2.0 - 2.0) * self.mm()
    }

    /// A coordinate, mm, rounded to whole quanta, and clamped to the range of an `i64`.
    fn whole(self, mm: f32) -> i64 {
        (mm * self.per_mm()).round_ties_even() as i64
    }

    /// The lowest bits of a coordinate's whole quanta. All products are by powers of two, and the
    /// difference is exact.
    #[inline]
    fn wrapped(self, mm: f32) -> u32 {
        let quanta = mm * self.per_mm();
        let turns = (quanta * (1.0 / Self::WRAP)).round_ties_even();
        (quanta - turns * Self::WRAP + PackedVertex::ROUNDING).to_bits() & COORDINATE
    }
}

/// A [`Vertex`] in half the bytes.
///
/// **Shape**: two `u32` and two `i16`, 12 bytes. `position` has the lowest 21 bits of x, y and z in
/// whole [quanta](crate::Settings::quantum): x in bits 0 to 20 of the 64, first word lowest, y in
/// bits 21 to 41, z in bits 42 to 62. The last bit is 0. `normal` is the octahedral map of the
/// normal (Meyer, Süßmuth, Sußner, Stamminger and Greiner 2010), in steps of 1/32767 from -32767 to
/// 32767.
///
/// The bits of a coordinate above these 21 are not kept. A vertex lies within the quantum's
/// [reach](Quantum::reach) of a place that the reader names, such as the middle of the cloth, the
/// eye, or a control point beside it, and that place supplies the high bits. The packed bits depend
/// on the position alone, not on a block, a chunk or a cap: equal positions are packed alike, and
/// unpack alike near any place. Where a cloth is cut apart there are no cracks.
///
/// **Errors of rounding**: half a quantum in each coordinate, 6.6e-5 rad in the normal.
///
/// ```
/// use texere_core::{PackedVertex, Quantum, Vertex};
/// let vertex = Vertex { position: [1.0, -20.5, 3.14159], normal: [0.0, 0.6, -0.8] };
/// let packed = PackedVertex::pack(&vertex, Quantum::default());
/// let unpacked = packed.unpack([100.0, 0.0, 0.0], Quantum::default());
/// assert_eq!(unpacked.position, [1.0, -20.5, 12868.0 / 4096.0]);
/// assert!((unpacked.normal[1] - 0.6).abs() < 1e-4 && (unpacked.normal[2] + 0.8).abs() < 1e-4);
/// ```
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Pod, Zeroable)]
pub struct PackedVertex {
    /// Position: 21 bits of x, of y and of z.
    pub position: [u32; 2],
    /// Outward normal, octahedral.
    pub normal: [i16; 2],
}

const _: () = assert!(size_of::<PackedVertex>() == 12 && std::mem::offset_of!(PackedVertex, normal) == 8);

impl PackedVertex {
    /// A number that rounds: added to an `f32` of less than 2²², it leaves the nearest whole
    /// number, ties to even, in the lowest bits of the sum.
    pub const ROUNDING: f32 = 12_582_912.0;

    /// Steps of the normal from 0 to 1.
    pub const NORMAL_STEPS: f32 = 32767.0;

    /// Packs a vertex.
    #[must_use]
    #[inline]
    pub fn pack(vertex: &Vertex, quantum: Quantum) -> Self {
        let [x, y, z] = vertex.position.map(|mm| quantum.wrapped(mm));
        Self {
            position: [x | y << Quantum::BITS, y >> (32 - Quantum::BITS) | z << (2 * Quantum::BITS - 32)],
            normal: octahedral(vertex.normal),
        }
    }

    /// This vertex with another normal.
    #[must_use]
    pub fn with_normal(self, normal: [f32; 3]) -> Self {
        Self { normal: octahedral(normal), ..self }
    }

    /// The vertex within [reach](Quantum::reach) of `near`, mm. `quantum` is the one that it was
    /// packed with.
    #[must_use]
    pub fn unpack(&self, near: [f32; 3], quantum: Quantum) -> Vertex {
        let [low, high] = self.position;
        let wrapped =
            [low, low >> Quantum::BITS | high << (32 - Quantum::BITS), high >> (2 * Quantum::BITS - 32)];
        let position = std::array::from_fn(|axis| {
            let near = quantum.whole(near[axis]);
            let away = 32 - Quantum::BITS;
            let steps = (wrapped[axis].wrapping_sub(near as u32) << away) as i32 >> away;
            near.saturating_add(i64::from(steps)) as f32 * quantum.mm()
        });
        Vertex { position, normal: from_octahedral(self.normal) }
    }
}

/// The steps of a normal on the octahedron |x| + |y| + |z| = 1, whose lower half is folded
/// outwards.
#[inline]
fn octahedral([x, y, z]: [f32; 3]) -> [i16; 2] {
    let scale = 1.0 / (x.abs() + y.abs() + z.abs());
    let (x, y) = (x * scale, y * scale);
    let folded = |beyond: f32, value: f32| if value < 0.0 { -beyond } else { beyond };
    let flat = if z < 0.0 { [folded(1.0 - y.abs(), x), folded(1.0 - x.abs(), y)] } else { [x, y] };
    flat.map(|value| (value * PackedVertex::NORMAL_STEPS + PackedVertex::ROUNDING).to_bits() as i16)
}

/// The unit vector of these steps.
fn from_octahedral(steps: [i16; 2]) -> [f32; 3] {
    let [x, y] = steps.map(|steps| f32::from(steps) / PackedVertex::NORMAL_STEPS);
    let z = 1.0 - x.abs() - y.abs();
    let fold = (-z).max(0.0);
    let [x, y] = [x, y].map(|value| value - fold.copysign(value));
    glam::Vec3::new(x, y, z).normalize_or_zero().to_array()
}
