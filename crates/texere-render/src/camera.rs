//! Cameras: the eye's position, direction and field of view.

use glam::Vec3;

use crate::axes::{across, aspect};
use crate::{Extent, RenderError};

/// The room left round the cloth, as a share of the cloth's size.
const MARGIN: f32 = 0.05;

/// The angle between the line of sight and the cloth's plane in views of the whole cloth, radians.
const OBLIQUE_HEIGHT: f32 = 0.72;

/// The angle between the line of sight and the cloth's plane in close-ups, radians.
const CLOSE_HEIGHT: f32 = 0.95;

/// The turn of the eye about the point that a close-up shows, radians. It is negative, so the eye
/// stands to the left.
const CLOSE_TURN: f32 = -0.35;

/// The threads that a cut goes through.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Cut {
    /// Across the ends, along a pick.
    Warp,
    /// Across the picks, along an end.
    Weft,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Projection {
    /// All lines of sight are parallel.
    Orthographic {
        /// The length that the picture's height shows, mm.
        height: f32,
    },
    /// All lines of sight come from the eye.
    Perspective {
        /// The distance from the target to the eye, mm.
        distance: f32,
        /// The angle from the picture's lower to its upper edge, radians.
        field_of_view: f32,
    },
}

/// The position of an eye, and the direction in which it looks, for [`Camera::perspective`] and
/// [`Camera::orthographic`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose {
    /// The eye, mm.
    pub eye: [f32; 3],
    /// The point in the middle of the picture, mm.
    pub target: [f32; 3],
    /// The direction that is up in the picture, of any length.
    pub up: [f32; 3],
}

/// A view of a fabric, for pictures of one size. Some constructors show the whole cloth or a place
/// of it. Others take any [`Pose`].
///
/// ```
/// use texere_core::{ControlPoint, Yarn, Yarns};
/// use texere_render::{Camera, Extent};
/// let mut yarns = Yarns::builder();
/// yarns.yarn(Yarn::default(), &[0.0, 10.0].map(|x| ControlPoint::new(x, 2.0, 0.0, 0.25)));
/// let extent = Extent::of(&yarns.build()?);
/// // A tenth of a millimetre a pixel: 10.5 mm by 0.5 mm.
/// let camera = Camera::true_scale(&extent, 0.1)?;
/// assert_eq!(camera.size(), [105, 5]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Camera {
    size: [u32; 2],
    pub(crate) target: Vec3,
    /// The direction from the target to the eye.
    pub(crate) toward: Vec3,
    pub(crate) up: Vec3,
    pub(crate) projection: Projection,
    /// The width of a pixel, divided by its height.
    pub(crate) stretch: f64,
    /// Whether all that is nearer to the eye than the target is cut away.
    pub(crate) cuts: bool,
    /// Whether the cloth lies on its face.
    pub(crate) is_over: bool,
    pub(crate) extent: Extent,
}

impl Camera {
    /// The default field of view, from the picture's lower to its upper edge, radians. It is that
    /// of a portrait lens, in which parallel threads look nearly parallel.
    pub const FIELD_OF_VIEW: f32 = 0.42;

    /// The whole cloth from straight above its face, its threads along the picture's edges.
    #[must_use]
    pub fn face(extent: &Extent, size: [u32; 2]) -> Self {
        let [wide, high] = extent.size();
        let height = high.max(wide / aspect(size)) * (1.0 + MARGIN);
        Self::straight(extent, size, height)
    }

    /// The whole cloth from above at true scale: each pixel shows `mm_per_pixel` each way. The
    /// picture is as large as the cloth needs at this scale.
    ///
    /// **Errors**: [`RenderError::Camera`].
    pub fn true_scale(extent: &Extent, mm_per_pixel: f32) -> Result<Self, RenderError> {
        let scale = positive("a scale (mm per pixel)", mm_per_pixel)?;
        // A pixel that the edge touches only by rounding does not count.
        let size = extent.size().map(|mm| (mm / scale - 1e-3).ceil().max(1.0) as u32);
        Ok(Self::straight(extent, size, size[1] as f32 * scale))
    }

    /// A rectangle of the cloth from straight above its face. `low` is the rectangle's lower left
    /// corner (x, y), and `shown` its width and height, mm. The picture shows exactly the
    /// rectangle, so its pixels need not be square. A map that tiles is such a picture of one
    /// repeat.
    ///
    /// ```
    /// # use texere_core::{ControlPoint, Yarn, Yarns};
    /// # use texere_render::{Camera, Extent};
    /// # let mut yarns = Yarns::builder();
    /// # yarns.yarn(Yarn::default(), &[0.0, 10.0].map(|x| ControlPoint::new(x, 2.0, 0.0, 0.25)));
    /// # let extent = Extent::of(&yarns.build()?);
    /// // 3 mm by 1 mm in 20 by 20 pixels.
    /// let camera = Camera::plan(&extent, [4.0, 1.5], [3.0, 1.0], [20, 20])?;
    /// let corner = camera.ray([20.0, 0.0]).at(0.0);
    /// assert!((corner[0] - 7.0).abs() < 1e-6 && (corner[1] - 2.5).abs() < 1e-6);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// **Errors**: [`RenderError::Camera`].
    pub fn plan(
        extent: &Extent,
        low: [f32; 2],
        shown: [f32; 2],
        size: [u32; 2],
    ) -> Result<Self, RenderError> {
        let low = point(low)?;
        let width = positive("a width (mm)", shown[0])?;
        let height = positive("a height (mm)", shown[1])?;
        Ok(Self {
            target: Vec3::new(low[0] + width * 0.5, low[1] + height * 0.5, extent.middle().z),
            stretch: f64::from(width / height) / f64::from(aspect(size)),
            ..Self::straight(extent, size, height)
        })
    }

    fn straight(extent: &Extent, size: [u32; 2], height: f32) -> Self {
        Self {
            size,
            target: extent.middle(),
            toward: Vec3::Z,
            up: Vec3::Y,
            projection: Projection::Orthographic { height },
            stretch: 1.0,
            cuts: false,
            is_over: false,
            extent: *extent,
        }
    }

    /// The whole cloth from above. The eye stands on the side of the cloth's lower edge, and is
    /// then turned by `turn` radians about the cloth's middle, counter-clockwise as seen from
    /// above.
    ///
    /// **Errors**: [`RenderError::Camera`].
    pub fn oblique(extent: &Extent, turn: f32, size: [u32; 2]) -> Result<Self, RenderError> {
        let turn = finite("a turn (radians)", turn)?;
        let mut camera = Self::above(extent, turn, OBLIQUE_HEIGHT, size);
        let (toward, up) = (camera.toward.to_array(), camera.up.to_array());
        camera.projection = portrait(extent.eye_distance(toward, up, Self::FIELD_OF_VIEW, MARGIN, size));
        Ok(camera)
    }

    /// A stretch of `width` mm round the point `at` (x, y), from above and aside.
    ///
    /// **Errors**: [`RenderError::Camera`].
    pub fn close_up(extent: &Extent, at: [f32; 2], width: f32, size: [u32; 2]) -> Result<Self, RenderError> {
        let (at, width) = (point(at)?, positive("a width (mm)", width)?);
        let distance = 0.5 * width / aspect(size) / (Self::FIELD_OF_VIEW * 0.5).tan();
        let camera = Self::above(extent, CLOSE_TURN, CLOSE_HEIGHT, size);
        Ok(Self {
            target: Vec3::new(at[0], at[1], extent.middle().z),
            projection: portrait(distance),
            ..camera
        })
    }

    /// A cut through the point `at` (x, y), seen straight on. The picture shows `width` mm of it.
    ///
    /// **Errors**: [`RenderError::Camera`].
    pub fn cut(
        extent: &Extent,
        cut: Cut,
        at: [f32; 2],
        width: f32,
        size: [u32; 2],
    ) -> Result<Self, RenderError> {
        let (at, width) = (point(at)?, positive("a width (mm)", width)?);
        Ok(Self {
            size,
            target: Vec3::new(at[0], at[1], extent.middle().z),
            toward: if cut == Cut::Warp { Vec3::NEG_Y } else { Vec3::X },
            up: Vec3::Z,
            projection: Projection::Orthographic { height: width / aspect(size) },
            stretch: 1.0,
            cuts: true,
            is_over: false,
            extent: *extent,
        })
    }

    /// A view in perspective from any point. `field_of_view` is the angle from the picture's lower
    /// to its upper edge, radians.
    ///
    /// Light comes from below the cloth if the eye is below the target, and else from above.
    ///
    /// ```
    /// # use texere_core::{ControlPoint, Yarn, Yarns};
    /// # use texere_render::{Camera, Extent, Pose};
    /// # let mut yarns = Yarns::builder();
    /// # yarns.yarn(Yarn::default(), &[0.0, 10.0].map(|x| ControlPoint::new(x, 2.0, 0.0, 0.25)));
    /// # let extent = Extent::of(&yarns.build()?);
    /// let pose = Pose { eye: [5.0, -8.0, 6.0], target: [5.0, 2.0, 0.0], up: [0.0, 0.0, 1.0] };
    /// let camera = Camera::perspective(&extent, &pose, 0.5, [800, 600])?;
    /// // The middle of the picture shows the target.
    /// let sight = camera.ray([400.0, 300.0]);
    /// assert!((sight.at(136.0f64.sqrt())[1] - 2.0).abs() < 1e-6);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// **Errors**: [`RenderError::Camera`] for an eye at the target, an up along the line of sight,
    /// a field of view that is not between 0.0001 and 3.1, and numbers that are not finite.
    pub fn perspective(
        extent: &Extent,
        pose: &Pose,
        field_of_view: f32,
        size: [u32; 2],
    ) -> Result<Self, RenderError> {
        if !(1e-4..=3.1).contains(&field_of_view) {
            let (what, expected) = ("a field of view (radians)", "between 0.0001 and 3.1");
            return Err(RenderError::Camera { what, value: field_of_view, expected });
        }
        Self::posed(extent, pose, size, |distance| Projection::Perspective { distance, field_of_view })
    }

    /// A view from any point with parallel lines of sight. `height` is the length that the
    /// picture's height shows, mm. The whole depth of the cloth is in the picture, however near the
    /// eye is.
    ///
    /// **Errors**: [`RenderError::Camera`] for a height that is not a finite number above zero, and
    /// for the poses that [`Camera::perspective`] refuses.
    pub fn orthographic(
        extent: &Extent,
        pose: &Pose,
        height: f32,
        size: [u32; 2],
    ) -> Result<Self, RenderError> {
        let height = positive("a height (mm)", height)?;
        Self::posed(extent, pose, size, |_| Projection::Orthographic { height })
    }

    fn posed(
        extent: &Extent,
        pose: &Pose,
        size: [u32; 2],
        projection: impl FnOnce(f32) -> Projection,
    ) -> Result<Self, RenderError> {
        for (what, point) in
            [("an eye's coordinate (mm)", pose.eye), ("a target's coordinate (mm)", pose.target)]
        {
            point.into_iter().try_for_each(|value| finite(what, value).map(|_| ()))?;
        }
        let [eye, target] = [pose.eye, pose.target].map(Vec3::from);
        let distance = positive("the way from the eye to the target (mm)", eye.distance(target))?;
        let (toward, up) = ((eye - target) / distance, Vec3::from(pose.up).normalize_or_zero());
        let aside = up.cross(toward).length();
        if aside.is_nan() || aside < 1e-4 {
            let (what, expected) = ("the sine between up and the line of sight", "above 0.0001");
            return Err(RenderError::Camera { what, value: aside, expected });
        }
        Ok(Self {
            size,
            target,
            toward,
            up,
            projection: projection(distance),
            stretch: 1.0,
            cuts: false,
            is_over: toward.z < 0.0,
            extent: *extent,
        })
    }

    fn above(extent: &Extent, turn: f32, height: f32, size: [u32; 2]) -> Self {
        let (sine, cosine) = turn.sin_cos();
        Self {
            size,
            target: extent.middle(),
            toward: Vec3::new(sine * height.cos(), -cosine * height.cos(), height.sin()),
            up: Vec3::Z,
            projection: portrait(1.0),
            stretch: 1.0,
            cuts: false,
            is_over: false,
            extent: *extent,
        }
    }

    /// This view of the cloth turned over sideways, so that its back is seen and end 1 is at
    /// the right.
    #[must_use]
    pub fn turned_over(self) -> Self {
        let over = |v: Vec3| Vec3::new(-v.x, v.y, -v.z);
        Self { toward: over(self.toward), up: over(self.up), is_over: !self.is_over, ..self }
    }

    /// Width and height of the camera's pictures, pixels.
    #[must_use]
    pub const fn size(&self) -> [u32; 2] {
        self.size
    }

    /// The picture's right and up.
    pub(crate) fn across(&self) -> [Vec3; 2] {
        across(self.up, self.toward)
    }

    /// The length that the width of the camera's pictures shows, divided by the length that their
    /// height shows.
    pub(crate) fn aspect(&self) -> f32 {
        (f64::from(aspect(self.size)) * self.stretch) as f32
    }
}

/// A perspective with the default field of view.
fn portrait(distance: f32) -> Projection {
    Projection::Perspective { distance, field_of_view: Camera::FIELD_OF_VIEW }
}

fn positive(what: &'static str, value: f32) -> Result<f32, RenderError> {
    if value.is_finite() && value > 0.0 {
        Ok(value)
    } else {
        Err(RenderError::Camera { what, value, expected: "a finite number above zero" })
    }
}

fn finite(what: &'static str, value: f32) -> Result<f32, RenderError> {
    if value.is_finite() {
        Ok(value)
    } else {
        Err(RenderError::Camera { what, value, expected: "a finite number" })
    }
}

fn point([x, y]: [f32; 2]) -> Result<[f32; 2], RenderError> {
    Ok([finite("a point's x (mm)", x)?, finite("a point's y (mm)", y)?])
}
