//! The bounding box of a fabric.

use glam::Vec3;
use rayon::prelude::*;
use texere_core::settling::Settler;
use texere_core::{BackendError, Section, Yarns};

use crate::axes::{across, aspect};

/// The box round a fabric, and the mean radius of its yarns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extent {
    /// The least x, y and z, mm.
    pub low: [f32; 3],
    /// The greatest x, y and z, mm.
    pub high: [f32; 3],
    /// The mean radius of the fabric's yarns over all control points, mm. A flattened yarn counts
    /// with the radius of a round yarn of the same area.
    pub radius: f32,
}

impl Extent {
    /// The box round all control points. Each point counts as wide as its yarn.
    #[must_use]
    pub fn of(yarns: &Yarns) -> Self {
        let layout = yarns.layout();
        let reaches: Vec<f32> = layout.sections().iter().map(reach).collect();
        let nothing = (Vec3::INFINITY, Vec3::NEG_INFINITY, 0.0f64);
        let each = layout.yarns().par_iter().enumerate().map(|(number, yarn)| {
            let reach = reaches[yarn.section as usize];
            let points = yarns.yarn_points(number).unwrap_or_default();
            points.iter().fold(nothing, |(low, high, radii), point| {
                let (width, height) = (point.half_width(), point.half_height());
                let (centre, reach) = (point.position(), Vec3::splat(width.max(height) * reach));
                (
                    low.min(centre - reach),
                    high.max(centre + reach),
                    radii + f64::from((width * height).sqrt()),
                )
            })
        });
        // The radii are added up in order, so that the sum is the same every time.
        let (low, high, radii) = each
            .collect::<Vec<_>>()
            .into_iter()
            .fold(nothing, |one, other| (one.0.min(other.0), one.1.max(other.1), one.2 + other.2));
        let radius = (radii / layout.point_count() as f64) as f32;
        Self { low: low.to_array(), high: high.to_array(), radius }
    }

    /// The box round `yarns` as `settler` has placed them. Each yarn counts as wide as the widest.
    ///
    /// **Errors**: [`BackendError`] of the settler's device.
    pub fn settled(yarns: &Yarns, settler: &mut dyn Settler) -> Result<Self, BackendError> {
        let bounds = settler.bounds()?;
        let plan = settler.plan();
        let [low, high] = bounds.map(|units| plan.scale().position(units.into()).as_vec3());
        let widest = yarns.layout().sections().iter().map(reach).fold(0.0, f32::max);
        let reach = Vec3::splat(plan.spans().thickest * widest);
        Ok(Self { low: (low - reach).to_array(), high: (high + reach).to_array(), ..Self::of(yarns) })
    }

    /// Width and length of the cloth, mm.
    #[must_use]
    pub fn size(&self) -> [f32; 2] {
        [self.high[0] - self.low[0], self.high[1] - self.low[1]]
    }

    /// The least distance, mm, from which an eye sees all of the cloth. `toward` is the direction
    /// from the cloth's middle to the eye, of length 1. `up` is the direction that is up in the
    /// picture, of any length. `size` is the width and height of the picture, pixels.
    /// `field_of_view` is the angle from the picture's lower to its upper edge, radians. `margin`
    /// is the room left round the cloth, as a share of the cloth's size.
    ///
    /// ```
    /// use texere_render::Extent;
    /// let extent = Extent { low: [0.0; 3], high: [20.0, 10.0, 0.0], radius: 0.1 };
    /// // Ten millimetres of height, and a right angle to see them in.
    /// let right_angle = std::f32::consts::FRAC_PI_2;
    /// let distance = extent.eye_distance([0.0, 0.0, 1.0], [0.0, 1.0, 0.0], right_angle, 0.0, [200, 100]);
    /// assert!((distance - 5.0).abs() < 1e-5);
    /// ```
    #[must_use]
    pub fn eye_distance(
        &self,
        toward: [f32; 3],
        up: [f32; 3],
        field_of_view: f32,
        margin: f32,
        size: [u32; 2],
    ) -> f32 {
        let toward = Vec3::from(toward);
        let [right, above] = across(Vec3::from(up), toward);
        let slope = (field_of_view * 0.5).tan();
        let needed = self.corners().map(|corner| {
            let corner = corner - self.middle();
            let aside = (corner.dot(right).abs() / aspect(size)).max(corner.dot(above).abs());
            corner.dot(toward) + aside * (1.0 + margin) / slope
        });
        needed.fold(0.0, f32::max)
    }

    pub(crate) fn middle(&self) -> Vec3 {
        (Vec3::from(self.low) + Vec3::from(self.high)) * 0.5
    }

    /// How far yarns may reach out of the box, mm. A spline of tension 0 leaves the box of its
    /// control points by up to an eighth of the box's sides. The corners of a section may lie
    /// further out than half its width and half its height: the mean radius is added for them.
    pub(crate) fn spare(&self) -> Vec3 {
        (Vec3::from(self.high) - Vec3::from(self.low)) / 8.0 + self.radius
    }

    /// The eight corners of the box.
    pub(crate) fn corners(&self) -> impl Iterator<Item = Vec3> {
        let (low, high) = (Vec3::from(self.low), Vec3::from(self.high));
        (0..8).map(move |corner| {
            Vec3::select(glam::BVec3::new(corner & 1 != 0, corner & 2 != 0, corner & 4 != 0), high, low)
        })
    }
}

/// How far a section reaches from its centre, along its width or its height, in radii of the yarn.
fn reach(section: &Section) -> f32 {
    section.half_width().max(section.half_height())
}
