//! Four lanes in plain Rust, which the compiler turns into whatever vectors there are.

use std::ops::{Add, Div, Mul, Sub};

use super::vector::{LINE, Line, Vector};

#[derive(Debug, Clone, Copy)]
pub(super) struct Portable([f32; 4]);

#[cfg_attr(optimized, inline(always))]
fn each<T>(f: impl Fn(usize) -> T) -> [T; 4] {
    [f(0), f(1), f(2), f(3)]
}

impl Add for Portable {
    type Output = Self;
    #[cfg_attr(optimized, inline(always))]
    fn add(self, other: Self) -> Self {
        Self(each(|lane| self.0[lane] + other.0[lane]))
    }
}

impl Sub for Portable {
    type Output = Self;
    #[cfg_attr(optimized, inline(always))]
    fn sub(self, other: Self) -> Self {
        Self(each(|lane| self.0[lane] - other.0[lane]))
    }
}

impl Mul for Portable {
    type Output = Self;
    #[cfg_attr(optimized, inline(always))]
    fn mul(self, other: Self) -> Self {
        Self(each(|lane| self.0[lane] * other.0[lane]))
    }
}

impl Div for Portable {
    type Output = Self;
    #[cfg_attr(optimized, inline(always))]
    fn div(self, other: Self) -> Self {
        Self(each(|lane| self.0[lane] / other.0[lane]))
    }
}

impl Vector for Portable {
    const LANES: usize = 4;
    type Mask = [bool; 4];
    type Whole = [u32; 4];

    #[cfg_attr(optimized, inline(always))]
    fn load(from: &[f32]) -> Self {
        let from = &from[..4];
        Self(each(|lane| from[lane]))
    }

    #[cfg_attr(optimized, inline(always))]
    fn store(self, to: &mut [f32]) {
        to[..4].copy_from_slice(&self.0);
    }

    #[cfg_attr(optimized, inline(always))]
    fn splat(value: f32) -> Self {
        Self([value; 4])
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
    fn negate(self) -> Self {
        Self(each(|lane| -self.0[lane]))
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
    fn less(self, other: Self) -> [bool; 4] {
        each(|lane| self.0[lane] < other.0[lane])
    }

    #[cfg_attr(optimized, inline(always))]
    fn is_zero(self) -> [bool; 4] {
        each(|lane| self.0[lane] == 0.0)
    }

    #[cfg_attr(optimized, inline(always))]
    fn select(mask: [bool; 4], yes: Self, no: Self) -> Self {
        Self(each(|lane| if mask[lane] { yes.0[lane] } else { no.0[lane] }))
    }

    #[cfg_attr(optimized, inline(always))]
    fn bits(mask: [bool; 4]) -> u32 {
        (0..4).map(|lane| u32::from(mask[lane]) << lane).sum()
    }

    #[cfg_attr(optimized, inline(always))]
    fn pick(from: Self, places: [u32; 4]) -> Self {
        Self(each(|lane| from.0[places[lane] as usize & 3]))
    }

    #[cfg_attr(optimized, inline(always))]
    fn preceding(before: Self, here: Self) -> Self {
        Self([before.0[3], here.0[0], here.0[1], here.0[2]])
    }

    #[cfg_attr(optimized, inline(always))]
    fn preceding_four(before: Self, _here: Self) -> Self {
        before
    }

    #[cfg_attr(optimized, inline(always))]
    fn components(points: &[[f32; 4]]) -> [Self; 4] {
        let points = &points[..4];
        each(|component| Self(each(|lane| points[lane][component])))
    }

    #[cfg_attr(optimized, inline(always))]
    fn tiles(rows: [Self; 4]) -> [Self; 4] {
        each(|lane| Self(each(|row| rows[row].0[lane])))
    }

    #[cfg_attr(optimized, inline(always))]
    fn arrange<const STREAM: bool>(columns: &[f32], lines: &mut [Line]) {
        let (columns, _) = columns.as_chunks::<LINE>();
        lines.iter_mut().zip(columns).for_each(|(line, four)| line.0 = *four);
    }

    #[cfg_attr(optimized, inline(always))]
    fn scatter(rows: [Self; 4], out: &mut [f32], stride: usize) {
        for lane in 0..4 {
            out[lane * stride..][..4].copy_from_slice(&each(|row| rows[row].0[lane]));
        }
    }

    #[cfg_attr(optimized, inline(always))]
    fn load_whole(from: &[u32]) -> [u32; 4] {
        let from = &from[..4];
        each(|lane| from[lane])
    }

    #[cfg_attr(optimized, inline(always))]
    fn store_whole(values: [u32; 4], to: &mut [u32]) {
        to[..4].copy_from_slice(&values);
    }

    #[cfg_attr(optimized, inline(always))]
    fn splat_whole(value: u32) -> [u32; 4] {
        [value; 4]
    }

    #[cfg_attr(optimized, inline(always))]
    fn add_whole(a: [u32; 4], b: [u32; 4]) -> [u32; 4] {
        each(|lane| a[lane].wrapping_add(b[lane]))
    }

    #[cfg_attr(optimized, inline(always))]
    fn sub_whole(a: [u32; 4], b: [u32; 4]) -> [u32; 4] {
        each(|lane| a[lane].wrapping_sub(b[lane]))
    }

    #[cfg_attr(optimized, inline(always))]
    fn first(a: [u32; 4]) -> u32 {
        a[0]
    }

    #[cfg_attr(optimized, inline(always))]
    fn without_first([_, b, c, d]: [u32; 4]) -> [u32; 4] {
        [0, b, c, d]
    }

    #[cfg_attr(optimized, inline(always))]
    fn running_sum([a, b, c, d]: [u32; 4]) -> [u32; 4] {
        let ab = a.wrapping_add(b);
        let abc = ab.wrapping_add(c);
        [a, ab, abc, abc.wrapping_add(d)]
    }

    #[cfg_attr(optimized, inline(always))]
    fn splat_last(a: [u32; 4]) -> [u32; 4] {
        [a[3]; 4]
    }

    #[cfg_attr(optimized, inline(always))]
    fn shift_left<const BY: i32>(a: [u32; 4]) -> [u32; 4] {
        each(|lane| a[lane] << BY)
    }

    #[cfg_attr(optimized, inline(always))]
    fn shift_right<const BY: i32>(a: [u32; 4]) -> [u32; 4] {
        each(|lane| a[lane] >> BY)
    }

    #[cfg_attr(optimized, inline(always))]
    fn has_bit(a: [u32; 4], bit: u32) -> [bool; 4] {
        each(|lane| a[lane] & bit != 0)
    }

    #[cfg_attr(optimized, inline(always))]
    fn from_signed(a: [u32; 4]) -> Self {
        Self(each(|lane| a[lane].cast_signed() as f32))
    }

    #[cfg_attr(optimized, inline(always))]
    fn from_bits(a: [u32; 4]) -> Self {
        Self(each(|lane| f32::from_bits(a[lane])))
    }

    #[cfg_attr(optimized, inline(always))]
    fn to_signed(self) -> [u32; 4] {
        each(|lane| (self.0[lane] as i32).cast_unsigned())
    }

    #[cfg_attr(optimized, inline(always))]
    fn stream(from: &[f32; LINE], to: &mut Line) {
        to.0 = *from;
    }

    #[cfg_attr(optimized, inline(always))]
    fn stream_indices(table: &[u32; LINE], base: Self::Whole, to: &mut Line) {
        for (place, offset) in table.iter().enumerate() {
            to.0[place] = f32::from_bits(base[place % 4].wrapping_add(*offset));
        }
    }

    #[cfg_attr(optimized, inline(always))]
    fn fence() {}
}
