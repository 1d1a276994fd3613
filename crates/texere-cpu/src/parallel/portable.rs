//! Four lanes in plain Rust, which the compiler turns into the vectors of the target.

use std::ops::{Add, Div, Mul, Neg, Sub};

use super::simd::{Floats, Integers, Job, LINE, Line, Mask, Simd};

/// Vectors that need no instructions beyond those of every processor of the target.
#[derive(Debug, Clone, Copy)]
pub(super) struct Portable;

#[derive(Debug, Clone, Copy)]
pub(super) struct F32x4([f32; 4]);

#[derive(Debug, Clone, Copy)]
pub(super) struct U32x4([u32; 4]);

#[derive(Debug, Clone, Copy)]
pub(super) struct Mask4([bool; 4]);

#[cfg_attr(optimized, inline(always))]
fn each<T>(f: impl Fn(usize) -> T) -> [T; 4] {
    [f(0), f(1), f(2), f(3)]
}

impl Add for F32x4 {
    type Output = Self;
    #[cfg_attr(optimized, inline(always))]
    fn add(self, other: Self) -> Self {
        Self(each(|lane| self.0[lane] + other.0[lane]))
    }
}

impl Sub for F32x4 {
    type Output = Self;
    #[cfg_attr(optimized, inline(always))]
    fn sub(self, other: Self) -> Self {
        Self(each(|lane| self.0[lane] - other.0[lane]))
    }
}

impl Mul for F32x4 {
    type Output = Self;
    #[cfg_attr(optimized, inline(always))]
    fn mul(self, other: Self) -> Self {
        Self(each(|lane| self.0[lane] * other.0[lane]))
    }
}

impl Div for F32x4 {
    type Output = Self;
    #[cfg_attr(optimized, inline(always))]
    fn div(self, other: Self) -> Self {
        Self(each(|lane| self.0[lane] / other.0[lane]))
    }
}

impl Neg for F32x4 {
    type Output = Self;
    #[cfg_attr(optimized, inline(always))]
    fn neg(self) -> Self {
        Self(each(|lane| -self.0[lane]))
    }
}

impl Add for U32x4 {
    type Output = Self;
    #[cfg_attr(optimized, inline(always))]
    fn add(self, other: Self) -> Self {
        Self(each(|lane| self.0[lane].wrapping_add(other.0[lane])))
    }
}

impl Sub for U32x4 {
    type Output = Self;
    #[cfg_attr(optimized, inline(always))]
    fn sub(self, other: Self) -> Self {
        Self(each(|lane| self.0[lane].wrapping_sub(other.0[lane])))
    }
}

impl Simd for Portable {
    const LANES: usize = 4;
    type Floats = F32x4;
    type Integers = U32x4;
    type Mask = Mask4;

    #[inline(never)]
    fn run(self, job: impl Job) {
        job.run(self);
    }

    #[cfg_attr(optimized, inline(always))]
    fn splat(self, value: f32) -> F32x4 {
        F32x4([value; 4])
    }

    #[cfg_attr(optimized, inline(always))]
    fn load(self, from: &[f32]) -> F32x4 {
        let from = &from[..4];
        F32x4(each(|lane| from[lane]))
    }

    #[cfg_attr(optimized, inline(always))]
    fn splat_integer(self, value: u32) -> U32x4 {
        U32x4([value; 4])
    }

    #[cfg_attr(optimized, inline(always))]
    fn load_integers(self, from: &[u32]) -> U32x4 {
        let from = &from[..4];
        U32x4(each(|lane| from[lane]))
    }

    #[cfg_attr(optimized, inline(always))]
    fn components(self, points: &[[f32; 4]]) -> [F32x4; 4] {
        let points = &points[..4];
        each(|component| F32x4(each(|lane| points[lane][component])))
    }

    #[cfg_attr(optimized, inline(always))]
    fn rows<const ROWS: usize>(self, table: &[[[f32; 4]; ROWS]], numbers: &[u32], row: usize) -> [F32x4; 4] {
        let numbers = &numbers[..4];
        self.components(&each(|lane| table[numbers[lane] as usize][row]))
    }

    #[cfg_attr(optimized, inline(always))]
    fn tiles(self, rows: [F32x4; 4]) -> [F32x4; 4] {
        each(|lane| F32x4(each(|row| rows[row].0[lane])))
    }

    #[cfg_attr(optimized, inline(always))]
    fn arrange<const STREAM: bool>(self, columns: &[f32], lines: &mut [Line]) {
        let (columns, _) = columns.as_chunks::<LINE>();
        lines.iter_mut().zip(columns).for_each(|(line, four)| line.0 = *four);
    }

    #[cfg_attr(optimized, inline(always))]
    fn scatter(self, rows: [F32x4; 4], out: &mut [f32], stride: usize) {
        // `left` is cut down lane by lane, because its bounds are cheaper to check than an index
        // for each lane.
        let mut left = &mut out[..3 * stride + 4];
        for lane in 0..4 {
            left[..4].copy_from_slice(&each(|row| rows[row].0[lane]));
            left = left.get_mut(stride..).unwrap_or_default();
        }
    }

    #[cfg_attr(optimized, inline(always))]
    fn stream(self, from: &[f32; LINE], to: &mut Line) {
        to.0 = *from;
    }

    #[cfg_attr(optimized, inline(always))]
    fn stream_indices(self, table: &[u32; LINE], base: U32x4, to: &mut Line) {
        for (place, offset) in table.iter().enumerate() {
            to.0[place] = f32::from_bits(base.0[place % 4].wrapping_add(*offset));
        }
    }

    #[cfg_attr(optimized, inline(always))]
    fn fence(self) {}
}

impl Floats for F32x4 {
    type Integers = U32x4;
    type Mask = Mask4;

    #[cfg_attr(optimized, inline(always))]
    fn store(self, to: &mut [f32]) {
        to[..4].copy_from_slice(&self.0);
    }

    #[cfg_attr(optimized, inline(always))]
    fn sqrt(self) -> Self {
        Self(each(|lane| self.0[lane].sqrt()))
    }

    #[cfg_attr(optimized, inline(always))]
    fn floor(self) -> Self {
        Self(each(|lane| self.0[lane].floor()))
    }

    #[cfg_attr(optimized, inline(always))]
    fn abs(self) -> Self {
        Self(each(|lane| self.0[lane].abs()))
    }

    #[cfg_attr(optimized, inline(always))]
    fn min(self, other: Self) -> Self {
        Self(each(|lane| if self.0[lane] < other.0[lane] { self.0[lane] } else { other.0[lane] }))
    }

    #[cfg_attr(optimized, inline(always))]
    fn max(self, other: Self) -> Self {
        Self(each(|lane| if self.0[lane] > other.0[lane] { self.0[lane] } else { other.0[lane] }))
    }

    #[cfg_attr(optimized, inline(always))]
    fn less(self, other: Self) -> Mask4 {
        Mask4(each(|lane| self.0[lane] < other.0[lane]))
    }

    #[cfg_attr(optimized, inline(always))]
    fn is_zero(self) -> Mask4 {
        Mask4(each(|lane| self.0[lane] == 0.0))
    }

    #[cfg_attr(optimized, inline(always))]
    fn permute(self, places: U32x4) -> Self {
        Self(each(|lane| self.0[places.0[lane] as usize & 3]))
    }

    #[cfg_attr(optimized, inline(always))]
    fn shift_in(self, before: Self) -> Self {
        Self([before.0[3], self.0[0], self.0[1], self.0[2]])
    }

    #[cfg_attr(optimized, inline(always))]
    fn shift_in_four(self, before: Self) -> Self {
        before
    }

    #[cfg_attr(optimized, inline(always))]
    fn to_signed(self) -> U32x4 {
        U32x4(each(|lane| (self.0[lane] as i32).cast_unsigned()))
    }

    #[cfg_attr(optimized, inline(always))]
    fn to_bits(self) -> U32x4 {
        U32x4(each(|lane| self.0[lane].to_bits()))
    }
}

impl Integers for U32x4 {
    type Floats = F32x4;
    type Mask = Mask4;

    #[cfg_attr(optimized, inline(always))]
    fn store(self, to: &mut [u32]) {
        to[..4].copy_from_slice(&self.0);
    }

    #[cfg_attr(optimized, inline(always))]
    fn first(self) -> u32 {
        self.0[0]
    }

    #[cfg_attr(optimized, inline(always))]
    fn without_first(self) -> Self {
        Self([0, self.0[1], self.0[2], self.0[3]])
    }

    #[cfg_attr(optimized, inline(always))]
    fn running_sum(self) -> Self {
        let Self([a, b, c, d]) = self;
        let ab = a.wrapping_add(b);
        let abc = ab.wrapping_add(c);
        Self([a, ab, abc, abc.wrapping_add(d)])
    }

    #[cfg_attr(optimized, inline(always))]
    fn splat_last(self) -> Self {
        Self([self.0[3]; 4])
    }

    #[cfg_attr(optimized, inline(always))]
    fn shift_left<const BY: i32>(self) -> Self {
        Self(each(|lane| self.0[lane] << BY))
    }

    #[cfg_attr(optimized, inline(always))]
    fn times(self, factor: u32) -> Self {
        Self(each(|lane| self.0[lane].wrapping_mul(factor)))
    }

    #[cfg_attr(optimized, inline(always))]
    fn shift_right<const BY: i32>(self) -> Self {
        Self(each(|lane| self.0[lane] >> BY))
    }

    #[cfg_attr(optimized, inline(always))]
    fn shift_right_signed<const BY: i32>(self) -> Self {
        Self(each(|lane| (self.0[lane].cast_signed() >> BY).cast_unsigned()))
    }

    #[cfg_attr(optimized, inline(always))]
    fn masked(self, mask: u32) -> Self {
        Self(each(|lane| self.0[lane] & mask))
    }

    #[cfg_attr(optimized, inline(always))]
    fn has_bit(self, bit: u32) -> Mask4 {
        Mask4(each(|lane| self.0[lane] & bit != 0))
    }

    #[cfg_attr(optimized, inline(always))]
    fn signed_to_floats(self) -> F32x4 {
        F32x4(each(|lane| self.0[lane].cast_signed() as f32))
    }

    #[cfg_attr(optimized, inline(always))]
    fn bit_cast(self) -> F32x4 {
        F32x4(each(|lane| f32::from_bits(self.0[lane])))
    }
}

impl Mask for Mask4 {
    type Floats = F32x4;

    #[cfg_attr(optimized, inline(always))]
    fn select(self, yes: F32x4, no: F32x4) -> F32x4 {
        F32x4(each(|lane| if self.0[lane] { yes.0[lane] } else { no.0[lane] }))
    }

    #[cfg_attr(optimized, inline(always))]
    fn bits(self) -> u32 {
        (0..4).map(|lane| u32::from(self.0[lane]) << lane).sum()
    }
}
