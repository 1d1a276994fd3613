//! Bends or turns cloth, or carries it by any other smooth map.

use glam::{DMat3, DVec3, Vec3};
use rayon::prelude::*;

use crate::definitions::Basis;
use crate::interval::tangent;
use crate::{ControlPoint, Layout, Yarn, YarnError, Yarns};

/// The step of the difference quotients that measure how a map stretches, as a share of the yarn's
/// half height at the point. With half the value, and with twice, no test is red.
const NEAR: f64 = 0.01;

/// A mapped yarn: its control points, its up directions, and its length divided by its length
/// before.
struct Carried {
    points: Vec<ControlPoint>,
    ups: Vec<[f32; 3]>,
    longer: f64,
}

impl Yarns {
    /// These yarns carried by `map`, from mm to mm: for example round a cylinder, over a saddle, or
    /// turned about any axis. Control points, half widths, half heights and [up
    /// directions](Yarns::with_ups) follow the map's stretch and turn near each point. If the map
    /// bends the cloth only little over a yarn's thickness, yarns stay as clear of one another as
    /// they were. Each yarn keeps its number of turns of twist. The spline runs between the carried
    /// points, so a map that bends much between two points needs more of them.
    ///
    /// `map` must be smooth. It must not fold space or turn it inside out.
    ///
    /// **Errors**: the errors of [`Layout::new`] and [`Yarns::new`] if yarns exceed the limits of
    /// size, twist and position.
    ///
    /// ```
    /// use texere_core::{ControlPoint, Yarn, Yarns};
    /// // A ribbon along x, round a cylinder of 10 mm about the y axis.
    /// let mut yarns = Yarns::builder();
    /// let ribbon: Vec<_> = (0..9).map(|x| ControlPoint::new(x as f32, 0.0, 0.0, 0.1).flattened(0.5, 0.125)).collect();
    /// yarns.yarn(Yarn::default(), &ribbon);
    /// let round = yarns.build()?.mapped(|[x, y, z]| {
    ///     let (sin, cos) = (x / 10.0).sin_cos();
    ///     [(10.0 + z) * sin, y, (10.0 + z) * cos]
    /// })?;
    /// // Its height points out of the cylinder.
    /// let (point, up) = (round.points()[8], round.ups().map_or([0.0; 3], |ups| ups[8].to_array()));
    /// assert!((up[0] - point.x / 10.0).abs() < 1e-4 && (up[2] - point.z / 10.0).abs() < 1e-4);
    /// assert!((point.half_width() - 0.5).abs() < 1e-3 && (point.half_height() - 0.125).abs() < 1e-3);
    /// # Ok::<(), texere_core::YarnError>(())
    /// ```
    pub fn mapped(&self, map: impl Fn([f64; 3]) -> [f64; 3] + Sync) -> Result<Self, YarnError> {
        let map = |place: DVec3| DVec3::from_array(map(place.to_array()));
        let layout = self.layout();
        let carried: Vec<_> = (0..layout.yarns().len())
            .into_par_iter()
            .map(|yarn| {
                let points = self.yarn_points(yarn).unwrap_or_default();
                let closed = layout.yarns()[yarn].closed;
                carry(points, closed, layout.ups(yarn), &map)
            })
            .collect();
        let twisted = |(yarn, carried): (&Yarn, &Carried)| {
            // Untwisted yarns stay untwisted.
            let twist = if yarn.twist == 0.0 { 0.0 } else { (f64::from(yarn.twist) / carried.longer) as f32 };
            Yarn { twist, ..*yarn }
        };
        let yarns = layout.yarns().iter().zip(&carried).map(twisted).collect();
        let layout = Layout::new(yarns, layout.offsets().to_vec(), layout.sections().to_vec())?;
        let layout = layout.with_tension(self.tension())?;
        let points = carried.iter().flat_map(|carried| &carried.points).copied().collect();
        let ups = carried.iter().flat_map(|carried| &carried.ups).copied().collect();
        let mapped = Self::new(layout, self.materials().to_vec(), points)?.with_ups(ups)?;
        mapped.with_sources_of([self])
    }

    /// The up direction of each control point: that of the yarn, or that of the upright frame if
    /// the yarn has none.
    pub(crate) fn standing_ups(&self) -> Vec<Vec3> {
        let yarns = self.layout().yarns().iter().enumerate();
        let of_yarn = |(number, yarn): (usize, &Yarn)| {
            let (points, closed) = (self.yarn_points(number).unwrap_or_default(), yarn.closed);
            match self.layout().ups(number) {
                Some(ups) => ups.to_vec(),
                None => {
                    let upright = |point| Basis::upright(tangent(points, closed, point)).up;
                    (0..points.len()).map(upright).collect()
                }
            }
        };
        yarns.flat_map(of_yarn).collect()
    }
}

fn carry(
    points: &[ControlPoint],
    closed: bool,
    ups: Option<&[Vec3]>,
    map: &impl Fn(DVec3) -> DVec3,
) -> Carried {
    let mut carried = Carried { points: Vec::new(), ups: Vec::new(), longer: 1.0 };
    for (number, point) in points.iter().enumerate() {
        let along = tangent(points, closed, number);
        let up = match ups {
            Some(ups) => {
                (ups[number] - along * ups[number].dot(along)).normalize_or(Basis::upright(along).up)
            }
            None => Basis::upright(along).up,
        };
        let (along, up) = (along.as_dvec3(), up.as_dvec3());
        let (wide, high) = (f64::from(point.half_width()), f64::from(point.half_height()));
        let place = point.position().as_dvec3();
        let near = NEAR * high;
        let stretch =
            DMat3::from_cols_array_2d(&[DVec3::X, DVec3::Y, DVec3::Z].map(|axis| {
                ((map(place + axis * near) - map(place - axis * near)) / (2.0 * near)).to_array()
            }));
        // The section is taken at right angles to the carried yarn. The part of a displacement that
        // goes along the yarn is left out, because it only moves the surface along itself.
        let tangent = (stretch * along).normalize_or_zero();
        let across = |v: DVec3| v - tangent * v.dot(tangent);
        let (side, up) = (across(stretch * up.cross(along) * wide), across(stretch * up * high));
        let half_height = up.length();
        // The half width is chosen so that the section has the area of the carried ellipse. Unless
        // the map shears the section, its axes are those of the carried ellipse, too.
        let half_width = side.cross(up).length() / half_height;
        let [x, y, z] = map(place).as_vec3().to_array();
        let carried_point = ControlPoint { x, y, z, ..*point };
        carried.points.push(carried_point.flattened(half_width as f32, half_height as f32));
        carried.ups.push(up.normalize_or_zero().as_vec3().to_array());
    }
    let length = |points: &[ControlPoint]| -> f64 {
        let steps = points.windows(2).map(|ends| f64::from(ends[0].position().distance(ends[1].position())));
        steps.sum()
    };
    carried.longer = (length(&carried.points) / length(points).max(f64::MIN_POSITIVE)).max(f64::MIN_POSITIVE);
    carried
}
