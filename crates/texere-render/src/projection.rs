//! A camera's matrices, which lead from a place on the cloth to a pixel, and its lines of sight,
//! which lead back.

use glam::dcamera::rh::proj::directx;
use glam::dcamera::rh::view;
use glam::{DMat4, DVec3};
use texere_core::Ray;

use crate::Camera;
use crate::camera::Projection;

/// The least distance from the eye to the near plane, as a share of the distance to the target.
/// With a nearer plane, depths at the far end would be too coarse.
const NEAREST: f64 = 0.02;

impl Camera {
    /// The matrix from the cloth's coordinates, mm, to the clip space of wgpu: x to the right and y
    /// up from -1 to 1, and depth from 0 at the near plane to 1 at the far plane. Both planes stand
    /// as near to the cloth as possible.
    ///
    /// **Shape**: four columns of four. The numbers are `f64`, because a cloth may be metres wide
    /// and a pixel micrometres.
    ///
    /// ```
    /// # use texere_core::{ControlPoint, Yarn, Yarns};
    /// # use texere_render::{Camera, Extent};
    /// # let mut yarns = Yarns::builder();
    /// # yarns.yarn(Yarn::default(), &[0.0, 10.0].map(|x| ControlPoint::new(x, 2.0, 0.0, 0.25)));
    /// # let extent = Extent::of(&yarns.build()?);
    /// let camera = Camera::true_scale(&extent, 0.1)?; // 105 by 5 pixels
    /// let [x, y] = [5.0, 2.0]; // the cloth's middle
    /// let clip = camera.clip_from_cloth();
    /// assert!((0..2).all(|row| (clip[0][row] * x + clip[1][row] * y + clip[3][row]).abs() < 1e-6));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn clip_from_cloth(&self) -> [[f64; 4]; 4] {
        (self.clip_from_local() * DMat4::from_translation(-self.target.as_dvec3())).to_cols_array_2d()
    }

    /// The line of sight through a point of the picture, in pixels from the picture's left and
    /// upper edges. The middle of a pixel is at a half. The line begins at the eye. If lines of
    /// sight are parallel, it begins before the cloth, and in a cut ([`Camera::cut`]) in the cut's
    /// plane. Its direction has length 1. A picker finds the triangle that the line hits.
    #[must_use]
    pub fn ray(&self, [x, y]: [f32; 2]) -> Ray {
        let [width, height] = self.size().map(f64::from);
        let across = [f64::from(x) / width * 2.0 - 1.0, 1.0 - f64::from(y) / height * 2.0];
        let [right, above] = self.across().map(|axis| axis.as_dvec3().normalize());
        let (target, toward) = (self.target.as_dvec3(), self.toward.as_dvec3().normalize());
        let half = 0.5 * self.exact_height_at_target();
        let aside = right * (across[0] * half * width / height * self.stretch) + above * (across[1] * half);
        let (origin, direction) = match self.projection {
            Projection::Orthographic { .. } => {
                let near = if self.cuts { 0.0 } else { self.depths()[0] };
                (target + toward * near + aside, -toward)
            }
            Projection::Perspective { distance, .. } => {
                let eye = toward * f64::from(distance);
                (target + eye, (aside - eye).normalize())
            }
        };
        Ray { origin: origin.to_array(), direction: direction.to_array() }
    }

    /// The length that the picture's height shows at the target, mm.
    pub(crate) fn height_at_target(&self) -> f32 {
        self.exact_height_at_target() as f32
    }

    fn exact_height_at_target(&self) -> f64 {
        match self.projection {
            Projection::Orthographic { height } => f64::from(height),
            Projection::Perspective { distance, field_of_view } => {
                2.0 * f64::from(distance) * (0.5 * f64::from(field_of_view)).tan()
            }
        }
    }

    /// How far before the target the cloth begins and ends, as the eye sees it, mm. The side of the
    /// cloth that is nearer to the eye comes first.
    fn depths(&self) -> [f64; 2] {
        let depths = self.extent.corners().map(|corner| (corner - self.target).dot(self.toward));
        let (far, near) =
            depths.fold((f32::MAX, f32::MIN), |(far, near), depth| (far.min(depth), near.max(depth)));
        let spare = self.extent.spare().dot(self.toward.abs());
        [f64::from(near + spare), f64::from(far - spare)]
    }

    /// Whether the inside of yarns can be seen: in cuts, or if the near plane may go through yarns.
    /// The ends of yarns are closed.
    pub(crate) fn sees_inside(&self) -> bool {
        let Projection::Perspective { distance, field_of_view } = self.projection else { return self.cuts };
        let eye = f64::from(distance);
        if eye - self.depths()[0] >= eye * NEAREST {
            // All of the cloth lies behind the near plane.
            return false;
        }
        // The box round the visible part of the near plane is tested against the cloth's box.
        let [right, above] = self.across().map(|axis| axis.as_dvec3().normalize());
        let (target, toward) = (self.target.as_dvec3(), self.toward.as_dvec3().normalize());
        let middle = target + toward * (eye * (1.0 - NEAREST));
        let half = eye * NEAREST * (0.5 * f64::from(field_of_view)).tan();
        let reach = right.abs() * (half * f64::from(self.aspect()))
            + above.abs() * half
            + self.extent.spare().as_dvec3();
        let [low, high] =
            [self.extent.low, self.extent.high].map(|corner| DVec3::from(corner.map(f64::from)));
        (middle + reach).cmpge(low).all() && (middle - reach).cmple(high).all()
    }

    /// Whether all of the cloth lies in the picture, or nearly.
    pub(crate) fn sees_all(&self) -> bool {
        let clip_from_local = self.clip_from_local();
        !self.cuts
            && self.extent.corners().all(|corner| {
                let clip = clip_from_local * (corner - self.target).as_dvec3().extend(1.0);
                clip.w > 0.0 && clip.x.abs() <= clip.w && clip.y.abs() <= clip.w
            })
    }

    /// The matrix from coordinates relative to the target to clip space.
    pub(crate) fn clip_from_local(&self) -> DMat4 {
        // The planes enclose the fabric closely, because depth has only 24 bits to distinguish
        // yarns.
        let [near, far] = self.depths();
        let (toward, up) = (self.toward.as_dvec3(), self.up.as_dvec3());
        let aspect = f64::from(self.aspect());
        match self.projection {
            Projection::Orthographic { height } => {
                let near = if self.cuts { 0.0 } else { near };
                let (above, aside) = (0.5 * f64::from(height), 0.5 * f64::from(height) * aspect);
                let look = view::look_to_mat4(DVec3::ZERO, -toward, up);
                directx::orthographic(-aside, aside, -above, above, -near, -far) * look
            }
            Projection::Perspective { distance, field_of_view } => {
                let eye = f64::from(distance);
                let look = view::look_to_mat4(toward * eye, -toward, up);
                let nearest = (eye - near).max(eye * NEAREST);
                let farthest = (eye - far).max(nearest * 1.01);
                directx::perspective(f64::from(field_of_view), aspect, nearest, farthest) * look
            }
        }
    }
}
