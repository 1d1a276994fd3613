//! Cameras: the eye's position, direction and field of view.

use glam::Vec3;

use crate::{Extent, RenderError};

/// Room left round the cloth, as a share of it.
const MARGIN: f32 = 0.05;

/// Vertical field of view of a perspective camera, radians: that of a portrait lens, which keeps threads parallel to the
/// eye.
pub(crate) const FIELD_OF_VIEW: f32 = 0.42;

/// How high the eye stands over the cloth's plane, radians: for the whole of it, and near a point of it.
const OBLIQUE_HEIGHT: f32 = 0.72;
const CLOSE_HEIGHT: f32 = 0.95;

/// How far it stands to the left of the cloth's middle near a point of it, radians.
const CLOSE_TURN: f32 = -0.35;

/// Which threads a cut goes through.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Cut {
    /// Across the ends, along a pick.
    Warp,
    /// Across the picks, along an end.
    Weft,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Projection {
    /// All lines of sight parallel.
    Orthographic {
        /// What the picture's height shows, mm.
        height: f32,
    },
    /// From a point.
    Perspective {
        /// From the target to the eye, mm.
        distance: f32,
    },
}

/// A view of a fabric, made for pictures of a certain size.
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
    /// From the target to the eye.
    pub(crate) toward: Vec3,
    pub(crate) up: Vec3,
    pub(crate) projection: Projection,
    /// Whether all that is nearer to the eye than the target is cut away.
    pub(crate) cuts: bool,
    /// Whether the cloth lies on its face.
    pub(crate) is_over: bool,
    pub(crate) extent: Extent,
}

impl Camera {
    /// The whole cloth from straight above its face, its threads along the picture's edges.
    #[must_use]
    pub fn face(extent: &Extent, size: [u32; 2]) -> Self {
        let [wide, high] = extent.size();
        let height = high.max(wide / aspect(size)) * (1.0 + MARGIN);
        Self::straight(extent, size, height)
    }

    /// The face at true scale: a pixel is `mm_per_pixel` each way, and the picture as large as that makes the cloth.
    ///
    /// **Errors**: [`RenderError::Camera`].
    pub fn true_scale(extent: &Extent, mm_per_pixel: f32) -> Result<Self, RenderError> {
        let scale = positive("a scale (mm per pixel)", mm_per_pixel)?;
        // A pixel that the edge touches only by rounding does not count.
        let size = extent.size().map(|mm| (mm / scale - 1e-3).ceil().max(1.0) as u32);
        Ok(Self::straight(extent, size, size[1] as f32 * scale))
    }

    fn straight(extent: &Extent, size: [u32; 2], height: f32) -> Self {
        Self {
            size,
            target: extent.middle(),
            toward: Vec3::Z,
            up: Vec3::Y,
            projection: Projection::Orthographic { height },
            cuts: false,
            is_over: false,
            extent: *extent,
        }
    }

    /// The whole cloth from above its lower edge, turned by `turn` radians about its middle: counter-clockwise as seen
    /// from above.
    ///
    /// **Errors**: [`RenderError::Camera`].
    pub fn oblique(extent: &Extent, turn: f32, size: [u32; 2]) -> Result<Self, RenderError> {
        let turn = finite("a turn (radians)", turn)?;
        let mut camera = Self::above(extent, turn, OBLIQUE_HEIGHT, size);
        let [right, above] = camera.across();
        let slope = (FIELD_OF_VIEW * 0.5).tan();
        let needed = extent.corners().map(|corner| {
            let corner = corner - camera.target;
            let aside = (corner.dot(right).abs() / aspect(size)).max(corner.dot(above).abs());
            corner.dot(camera.toward) + aside * (1.0 + MARGIN) / slope
        });
        camera.projection = Projection::Perspective { distance: needed.fold(0.0, f32::max) };
        Ok(camera)
    }

    /// A stretch of `width` mm round the point `at` (x, y), from above and aside.
    ///
    /// **Errors**: [`RenderError::Camera`].
    pub fn close_up(extent: &Extent, at: [f32; 2], width: f32, size: [u32; 2]) -> Result<Self, RenderError> {
        let (at, width) = (point(at)?, positive("a width (mm)", width)?);
        let distance = 0.5 * width / aspect(size) / (FIELD_OF_VIEW * 0.5).tan();
        let camera = Self::above(extent, CLOSE_TURN, CLOSE_HEIGHT, size);
        Ok(Self {
            target: Vec3::new(at[0], at[1], extent.middle().z),
            projection: Projection::Perspective { distance },
            ..camera
        })
    }

    /// A cut through the point `at` (x, y), seen straight on, `width` mm of it.
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
            cuts: true,
            is_over: false,
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
            projection: Projection::Perspective { distance: 1.0 },
            cuts: false,
            is_over: false,
            extent: *extent,
        }
    }

    /// The same view of the cloth turned over sideways, so that its back is seen and end 1 is at the right.
    #[must_use]
    pub fn turned_over(self) -> Self {
        let over = |v: Vec3| Vec3::new(-v.x, v.y, -v.z);
        Self { toward: over(self.toward), up: over(self.up), is_over: !self.is_over, ..self }
    }

    /// Width and height of its pictures, pixels.
    #[must_use]
    pub const fn size(&self) -> [u32; 2] {
        self.size
    }

    /// Whether the inside of yarns can be seen, at ends or where they are cut.
    pub(crate) fn sees_inside(&self) -> bool {
        self.cuts || matches!(self.projection, Projection::Perspective { .. })
    }

    /// The picture's right and up.
    pub(crate) fn across(&self) -> [Vec3; 2] {
        let right = self.up.cross(self.toward).normalize();
        [right, self.toward.cross(right)]
    }

    /// Width over height of its pictures.
    pub(crate) fn aspect(&self) -> f32 {
        aspect(self.size)
    }
}

fn aspect(size: [u32; 2]) -> f32 {
    // An empty picture is refused later, when it is drawn.
    size[0].max(1) as f32 / size[1].max(1) as f32
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
