//! Packed vertices: half the bytes of a [`Vertex`], on a grid that the whole fabric shares.

use bytemuck::{Pod, Zeroable};

use crate::Vertex;

/// The step of the grid that packed positions lie on. It is a power of two of mm, and the same for
/// a whole fabric.
///
/// The quantum is one of the [`Settings`](crate::Settings). A finer step is more exact, and a
/// coarser step [reaches](Quantum::reach) further.
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

/// The exponents of the finest and the coarsest quantum. With the finest, the least radius of a
/// yarn is over 1,600 quanta. The coarsest reaches over all coordinates that are allowed.
const EXPONENTS: std::ops::RangeInclusive<i8> = -24..=11;

/// The mask of a packed coordinate's bits.
const COORDINATE: u32 = (1 << Quantum::BITS) - 1;

impl Default for Quantum {
    /// [`Quantum::USUAL`].
    fn default() -> Self {
        Self::USUAL
    }
}

impl Quantum {
    /// The usual quantum, 2⁻¹² mm. It is a quarter of a micrometre, 1/400 of the radius of a thread
    /// of 0.2 mm, and reaches 256 mm.
    pub const USUAL: Self = Self { exponent: -12 };

    /// Number of bits of each packed coordinate.
    pub const BITS: u32 = 21;

    /// The number of quanta after which packed coordinates repeat.
    pub const WRAP: f32 = (1 << Self::BITS) as f32;

    /// The quantum of a length, mm; none unless it is a power of two from 2⁻²⁴ to 2¹¹.
    ///
    /// ```
    /// use texere_core::Quantum;
    /// assert_eq!(Quantum::of(1.0 / 4096.0), Some(Quantum::USUAL));
    /// assert!([0.0, 0.3, -0.5, 4096.0, f32::NAN].into_iter().all(|mm| Quantum::of(mm).is_none()));
    /// ```
    #[must_use]
    pub fn of(mm: f32) -> Option<Self> {
        EXPONENTS.map(|exponent| Self { exponent }).find(|quantum| quantum.mm() == mm)
    }

    /// The finest quantum that reaches `mm`. The finest of all is 2⁻²⁴ mm. If none reaches so far,
    /// the result is the coarsest, 2¹¹ mm or about 2 m.
    #[must_use]
    pub fn reaching(mm: f32) -> Self {
        let all = EXPONENTS.map(|exponent| Self { exponent });
        all.clone().find(|quantum| quantum.reach() >= mm).unwrap_or(Self { exponent: *EXPONENTS.end() })
    }

    /// The quantum's length, mm.
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
    /// [unpacked](PackedVertex::unpack). It is half of the range of a packed coordinate, less the
    /// rounding of the vertex and of the place.
    #[must_use]
    pub const fn reach(self) -> f32 {
        (Self::WRAP / 2.0 - 2.0) * self.mm()
    }

    /// A coordinate, mm, rounded to whole quanta, and clamped to the range of an `i64`.
    fn whole(self, mm: f32) -> i64 {
        (mm * self.per_mm()).round_ties_even() as i64
    }

    /// The lowest bits of a coordinate in whole quanta. All factors are powers of two, and the
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
/// **Shape**: two `u32` and two `i16`, 12 bytes. `position` holds the lowest 21 bits of x, y and z
/// in whole [quanta](crate::Settings::quantum). The first word is the lower half of 64 bits. x has
/// bits 0 to 20, y bits 21 to 41, and z bits 42 to 62. Bit 63 is 0. `normal` is the octahedral map
/// of the normal (Meyer, Süßmuth, Sußner, Stamminger and Greiner 2010), in steps of 1/32767 from
/// -32767 to 32767.
///
/// The higher bits of a coordinate are not kept. To unpack a vertex, the reader names a place
/// within the quantum's [reach](Quantum::reach) of the vertex, such as the middle of the cloth, the
/// eye, or a control point beside it. That place supplies the high bits. The packed bits depend on
/// the position alone, not on a block, a chunk or a cap. Equal positions have equal bits, and
/// unpack to equal positions near any place. There are no cracks where a cloth is cut into chunks.
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
    /// The position: 21 bits each of x, y and z.
    pub position: [u32; 2],
    /// The outward normal, in the octahedral map.
    pub normal: [i16; 2],
}

const _: () = assert!(size_of::<PackedVertex>() == 12 && std::mem::offset_of!(PackedVertex, normal) == 8);

impl PackedVertex {
    /// A number for rounding. If it is added to an `f32` below 2²² in size, the lowest bits of the
    /// sum are the nearest whole number, ties to even.
    pub const ROUNDING: f32 = 12_582_912.0;

    /// Number of steps of a normal's coordinate from 0 to 1.
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

    /// The vertex with these bits that lies within [reach](Quantum::reach) of the place `near`, mm.
    /// `quantum` is the one that the vertex was packed with.
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

/// A normal projected to the octahedron |x| + |y| + |z| = 1, whose lower half is folded outwards,
/// in steps.
#[inline]
fn octahedral([x, y, z]: [f32; 3]) -> [i16; 2] {
    let scale = 1.0 / (x.abs() + y.abs() + z.abs());
    let (x, y) = (x * scale, y * scale);
    let folded = |beyond: f32, value: f32| if value < 0.0 { -beyond } else { beyond };
    let flat = if z < 0.0 { [folded(1.0 - y.abs(), x), folded(1.0 - x.abs(), y)] } else { [x, y] };
    flat.map(|value| (value * PackedVertex::NORMAL_STEPS + PackedVertex::ROUNDING).to_bits() as i16)
}

/// The unit vector whose octahedral map is `steps`.
fn from_octahedral(steps: [i16; 2]) -> [f32; 3] {
    let [x, y] = steps.map(|steps| f32::from(steps) / PackedVertex::NORMAL_STEPS);
    let z = 1.0 - x.abs() - y.abs();
    let fold = (-z).max(0.0);
    let [x, y] = [x, y].map(|value| value - fold.copysign(value));
    glam::Vec3::new(x, y, z).normalize_or_zero().to_array()
}
