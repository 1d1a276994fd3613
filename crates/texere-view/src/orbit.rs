//! The eye, which goes round a point of the cloth.

use std::f32::consts::FRAC_PI_2;

use glam::Vec3;
use texere::picture::{Camera, Extent, Pose, RenderError};

/// Room left round the whole cloth, as a share of it.
const MARGIN: f32 = 0.08;

/// How far a drag over one pixel turns the eye, radians.
const TURN: f32 = 0.008;

/// How near and how far the eye may come, in lengths of the cloth's diagonal.
const REACH: [f32; 2] = [1e-5, 20.0];

/// An eye that looks at a point of the cloth, from a side and a height.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Orbit {
    target: Vec3,
    /// The angle about z, radians: 0 looks from the cloth's lower edge, and it grows
    /// counter-clockwise as seen from above.
    turn: f32,
    /// The angle over the cloth's plane, radians, from π/2 straight above to -π/2 straight below.
    height: f32,
    /// The distance from the target to the eye, mm.
    distance: f32,
    /// Whether all lines of sight are parallel.
    pub(crate) is_parallel: bool,
}

/// A side that the whole cloth is seen from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Side {
    Face,
    /// Turned over sideways: end 1 is at the right.
    Back,
    Oblique,
}

impl Orbit {
    /// The view of the whole cloth, for pictures of `size`, pixels.
    pub(crate) fn whole(extent: &Extent, side: Side, size: [u32; 2]) -> Self {
        let (low, high) = (Vec3::from(extent.low), Vec3::from(extent.high));
        let (turn, height) = match side {
            Side::Face => (0.0, FRAC_PI_2),
            Side::Back => (2.0 * FRAC_PI_2, -FRAC_PI_2),
            Side::Oblique => (-0.5, 0.72),
        };
        let orbit = Self {
            target: (low + high) * 0.5,
            turn,
            height,
            distance: 1.0,
            is_parallel: side != Side::Oblique,
        };
        let [_, above, toward] = orbit.axes().map(Vec3::into);
        let distance = extent.eye_distance(toward, above, Camera::FIELD_OF_VIEW, MARGIN, size);
        Self { distance: distance.max(f32::MIN_POSITIVE), ..orbit }
    }

    /// Unit vectors to the right and up in the picture, and towards the eye.
    fn axes(&self) -> [Vec3; 3] {
        let ((sine, cosine), (high, flat)) = (self.turn.sin_cos(), self.height.sin_cos());
        let toward = Vec3::new(sine * flat, -cosine * flat, high);
        let above = Vec3::new(-sine * high, cosine * high, flat);
        [above.cross(toward), above, toward]
    }

    /// The length that the picture's height spans at the target, mm.
    fn height_mm(&self) -> f32 {
        2.0 * self.distance * (0.5 * Camera::FIELD_OF_VIEW).tan()
    }

    /// The camera for pictures of `size`, pixels.
    ///
    /// **Errors**: the errors of [`Camera::orthographic`] and [`Camera::perspective`].
    pub(crate) fn camera(&self, extent: &Extent, size: [u32; 2]) -> Result<Camera, RenderError> {
        let [_, above, toward] = self.axes();
        let eye = self.target + toward * self.distance;
        let pose = Pose { eye: eye.to_array(), target: self.target.to_array(), up: above.to_array() };
        if self.is_parallel {
            Camera::orthographic(extent, &pose, self.height_mm(), size)
        } else {
            Camera::perspective(extent, &pose, Camera::FIELD_OF_VIEW, size)
        }
    }

    /// Turns the eye round the target after a drag by `right` and `down` pixels.
    pub(crate) fn turn(&mut self, [right, down]: [f32; 2]) {
        self.turn -= right * TURN;
        self.height = (self.height + down * TURN).clamp(-FRAC_PI_2, FRAC_PI_2);
    }

    /// Moves the cloth with a drag, in a picture of `size`, pixels.
    pub(crate) fn pan(&mut self, [right, down]: [f32; 2], size: [u32; 2]) {
        let pixel = self.height_mm() / size[1].max(1) as f32;
        let [across, above, _] = self.axes();
        self.target += (above * down - across * right) * pixel;
    }

    /// Brings the eye nearer by a `factor` above 1, or further away by a factor below 1. The point
    /// of the cloth that is seen at `at` in a picture of `size`, pixels, stays there.
    pub(crate) fn zoom(&mut self, factor: f32, at: [f32; 2], size: [u32; 2], extent: &Extent) {
        let diagonal = Vec3::from(extent.high).distance(Vec3::from(extent.low));
        let distance = (self.distance / factor).clamp(diagonal * REACH[0], diagonal * REACH[1]);
        let off = [0, 1].map(|axis| at[axis] - 0.5 * size[axis] as f32);
        let kept = 1.0 - distance / self.distance;
        self.pan(off.map(|pixels| -pixels * kept), size);
        self.distance = distance;
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may panic")]

    use super::*;

    const EXTENT: Extent = Extent { low: [2.0, -1.0, -0.5], high: [32.0, 19.0, 0.5], radius: 0.2 };
    const SIZE: [u32; 2] = [800, 500];

    /// The place in the picture at which a point of the cloth is seen, pixels.
    fn pixel(orbit: &Orbit, point: [f64; 3]) -> [f64; 2] {
        let matrix = orbit.camera(&EXTENT, SIZE).unwrap().clip_from_cloth();
        let clip: [f64; 4] = std::array::from_fn(|row| {
            (0..3).map(|axis| matrix[axis][row] * point[axis]).sum::<f64>() + matrix[3][row]
        });
        [(clip[0] / clip[3] + 1.0) * 400.0, (1.0 - clip[1] / clip[3]) * 250.0]
    }

    fn assert_at(orbit: &Orbit, point: [f64; 3], expected: [f64; 2]) {
        let found = pixel(orbit, point);
        let off = (0..2).map(|axis| (found[axis] - expected[axis]).abs()).fold(0.0, f64::max);
        assert!(off < 0.05, "{point:?} is seen at {found:?} and not at {expected:?}");
    }

    #[test]
    fn the_whole_cloth_is_in_the_picture_from_every_side() {
        for side in [Side::Face, Side::Back, Side::Oblique] {
            for is_parallel in [false, true] {
                let orbit = Orbit { is_parallel, ..Orbit::whole(&EXTENT, side, SIZE) };
                let mut most: f64 = 0.0;
                for corner in 0..8 {
                    let pick = |axis: usize| if corner >> axis & 1 == 1 { EXTENT.high } else { EXTENT.low };
                    let [x, y] = pixel(&orbit, [0, 1, 2].map(|axis| f64::from(pick(axis)[axis])));
                    most = most.max((x / 400.0 - 1.0).abs()).max((y / 250.0 - 1.0).abs());
                }
                assert!((0.7..1.0).contains(&most), "{side:?}: {most}");
            }
        }
    }

    #[test]
    fn end_one_is_at_the_left_on_the_face_and_at_the_right_on_the_back() {
        let (first, last) = ([2.5, 0.0, 0.0], [2.5, 18.0, 0.0]);
        for (side, is_left) in [(Side::Face, true), (Side::Back, false)] {
            let orbit = Orbit::whole(&EXTENT, side, SIZE);
            assert_eq!(pixel(&orbit, first)[0] < 400.0, is_left, "{side:?}");
            assert!(pixel(&orbit, first)[1] > pixel(&orbit, last)[1], "{side:?}: the last pick is on top");
        }
    }

    /// A point in the target's plane moves with a drag. The point under the pointer stays there
    /// while the view is zoomed.
    #[test]
    fn what_is_dragged_or_zoomed_stays_under_the_pointer() {
        for side in [Side::Face, Side::Back, Side::Oblique] {
            for is_parallel in [false, true] {
                let mut orbit = Orbit { is_parallel, ..Orbit::whole(&EXTENT, side, SIZE) };
                let middle = orbit.target.as_dvec3();
                assert_at(&orbit, middle.to_array(), [400.0, 250.0]);
                orbit.pan([60.0, -35.0], SIZE);
                assert_at(&orbit, middle.to_array(), [460.0, 215.0]);
                orbit.zoom(3.0, [460.0, 215.0], SIZE, &EXTENT);
                assert_at(&orbit, middle.to_array(), [460.0, 215.0]);
            }
        }
    }

    #[test]
    fn turning_keeps_the_target_in_the_middle_and_stops_overhead() {
        let mut orbit = Orbit { is_parallel: false, ..Orbit::whole(&EXTENT, Side::Oblique, SIZE) };
        let middle = orbit.target.as_dvec3().to_array();
        for drag in [[100.0, 0.0], [0.0, 1e4], [-250.0, -3e4], [0.0, 77.0]] {
            orbit.turn(drag);
            assert_at(&orbit, middle, [400.0, 250.0]);
            assert!(orbit.height.abs() <= FRAC_PI_2);
        }
    }

    #[test]
    fn zooming_stops_before_the_cloth_is_a_point_or_fills_everything() {
        let mut orbit = Orbit::whole(&EXTENT, Side::Face, SIZE);
        for factor in [1e9, 1e-9, f32::MAX] {
            orbit.zoom(factor, [10.0, 10.0], SIZE, &EXTENT);
            assert!(orbit.camera(&EXTENT, SIZE).is_ok());
        }
    }
}
