//! The yarns of a fabric: control points, layout, materials, ups and sources.

mod error;

use std::borrow::Cow;
use std::ops::Range;
use std::sync::Arc;

use glam::Vec3;
use rayon::prelude::*;

use crate::stand::Stand;
use crate::{
    BENDING_LIMITS, COORDINATE_LIMIT, ControlPoint, HAIRINESS_LIMIT, Layout, Material, RADIUS_MAX,
    RADIUS_MIN, Section, Yarn,
};

pub use self::error::YarnError;

/// The yarns of a fabric, after all checks. They are the input of every pipeline.
///
/// ```
/// use texere_core::{ControlPoint, Material, Origin, Section, Yarn, Yarns};
/// let mut yarns = Yarns::builder();
/// let cotton = yarns.material(Material::default());
/// let round = yarns.section(Section::Circle);
/// let points = [0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1));
/// yarns.yarn(Yarn { material: cotton, section: round, origin: Origin::Pick(1), ..Yarn::default() }, &points);
/// let yarns = yarns.build()?;
/// assert_eq!(yarns.layout().offsets(), [0, 3]);
/// # Ok::<(), texere_core::YarnError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Yarns {
    layout: Arc<Layout>,
    materials: Arc<[Material]>,
    // Copies of yarns share their points until one of them moves.
    points: Arc<Vec<ControlPoint>>,
    ups: Option<Arc<Vec<Vec3>>>,
    sources: Option<Arc<Vec<u32>>>,
}

impl Yarns {
    /// A builder without yarns.
    #[must_use]
    pub fn builder() -> YarnsBuilder {
        YarnsBuilder::default()
    }

    /// Yarns of a layout, with its materials and its control points. There must be as many points
    /// as the layout says, yarn after yarn.
    ///
    /// **Errors**: [`YarnError`] for another number of points than the layout's, a yarn whose
    /// material is missing, a material that [`check_material`] refuses, and for the first control
    /// point that is not finite, lies beyond [`COORDINATE_LIMIT`], or whose half width or half
    /// height is outside \[[`RADIUS_MIN`], [`RADIUS_MAX`]\].
    pub fn new(
        mut layout: Layout,
        materials: Vec<Material>,
        points: Vec<ControlPoint>,
    ) -> Result<Self, YarnError> {
        if points.len() as u64 != layout.point_count() {
            return Err(YarnError::PointCount { points: points.len() as u64, planned: layout.point_count() });
        }
        check_materials(&layout, &materials)?;
        let yarns = layout.offsets().par_windows(2).zip(layout.yarns()).enumerate();
        let stands = yarns.map(|(number, (bounds, yarn))| {
            let own = &points[bounds[0] as usize..bounds[1] as usize];
            check_points(number, own).map(|()| Stand::of(own, yarn.closed, None))
        });
        // The first of several errors is returned.
        let stands: Vec<_> = stands.collect();
        for (yarn, stand) in stands.into_iter().enumerate() {
            layout.set_stand(yarn, stand?);
        }
        Ok(Self {
            layout: Arc::new(layout),
            materials: materials.into(),
            points: Arc::new(points),
            ups: None,
            sources: None,
        })
    }

    /// Adds the source of each control point: one `u32` per control point, which stands for a
    /// crossing, a stitch or a line of a file.
    ///
    /// **Errors**: [`YarnError::SourceCount`] if the number of sources differs from that of the
    /// control points.
    pub fn with_sources(mut self, sources: Vec<u32>) -> Result<Self, YarnError> {
        if sources.len() != self.points.len() {
            return Err(YarnError::SourceCount { sources: sources.len(), points: self.points.len() });
        }
        self.sources = Some(Arc::new(sources));
        Ok(self)
    }

    /// These yarns with splines of another [tension](Layout::tension). The control points stay in
    /// place.
    ///
    /// ```
    /// use texere_core::{ControlPoint, Yarn, Yarns};
    /// # let mut yarns = Yarns::builder();
    /// # let points = [0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1));
    /// # yarns.yarn(Yarn::default(), &points);
    /// # let yarns = yarns.build()?;
    /// assert_eq!(yarns.tension(), 0.0);
    /// let taut = yarns.with_tension(0.3)?;
    /// assert_eq!(taut.tension(), 0.3);
    /// assert!(taut.with_tension(1.0).is_err());
    /// # Ok::<(), texere_core::YarnError>(())
    /// ```
    ///
    /// **Errors**: [`YarnError::Tension`] outside \[0, 1).
    pub fn with_tension(mut self, tension: f32) -> Result<Self, YarnError> {
        if tension.to_bits() != self.tension().to_bits() {
            self.layout = Arc::new(Arc::unwrap_or_clone(self.layout).with_tension(tension)?);
        }
        Ok(self)
    }

    /// These yarns with one section for all of them.
    ///
    /// ```
    /// use texere_core::{ControlPoint, Section, Yarn, Yarns};
    /// # let mut yarns = Yarns::builder();
    /// # yarns.yarn(Yarn::default(), &[0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1)));
    /// # let yarns = yarns.build()?;
    /// let plied = yarns.with_section(Section::plied(2))?;
    /// assert_eq!(plied.layout().sections(), [Section::plied(2)]);
    /// # Ok::<(), texere_core::YarnError>(())
    /// ```
    ///
    /// **Errors**: [`YarnError::Section`] for a section with invalid parameters.
    pub fn with_section(mut self, section: Section) -> Result<Self, YarnError> {
        self.layout = Arc::new(Arc::unwrap_or_clone(self.layout).with_section(section)?);
        Ok(self)
    }

    /// Gives each control point an up direction, which is the direction of the yarn's height at
    /// that point, instead of z. In a cloth that is bent out of its plane, ups point along the
    /// normals of its surface. [`Yarns::mapped`] makes such ups. Only the part at right angles to
    /// the yarn counts. Between two points the ups are blended
    /// ([`up_between`](crate::definitions::up_between)).
    ///
    /// ```
    /// use texere_core::{ControlPoint, Yarn, Yarns};
    /// // A ribbon along x that stands on edge: its height points along y.
    /// let mut yarns = Yarns::builder();
    /// let ribbon = [0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1).flattened(0.5, 0.125));
    /// yarns.yarn(Yarn::default(), &ribbon);
    /// let yarns = yarns.build()?.with_ups(vec![[0.0, 1.0, 0.0]; 3])?;
    /// assert_eq!(yarns.ups().map(<[_]>::len), Some(3));
    /// # Ok::<(), texere_core::YarnError>(())
    /// ```
    ///
    /// **Errors**: [`YarnError::UpCount`] if the number of ups differs from that of the control
    /// points, and [`YarnError::Up`] for a vector without a direction.
    pub fn with_ups(mut self, ups: Vec<[f32; 3]>) -> Result<Self, YarnError> {
        if ups.len() != self.points.len() {
            return Err(YarnError::UpCount { ups: ups.len(), points: self.points.len() });
        }
        let unit = |(point, up): (usize, &[f32; 3])| {
            let up = Vec3::from_array(*up);
            // A vector of length 1, up to rounding, stays as it is. Ups that were read from yarns
            // therefore keep their bits when they are given again.
            let unit = |up: Vec3| {
                let is_unit = (up.length_squared() - 1.0).abs() <= 8.0 * f32::EPSILON;
                if is_unit { Some(up) } else { up.try_normalize() }
            };
            // Each vector is normalised twice. The square of a very short vector has few digits, so
            // that its length is only about 1 after the first time.
            unit(up).and_then(unit).ok_or_else(|| {
                let yarn = self.layout.offsets().partition_point(|&start| start <= point as u64) - 1;
                YarnError::Up { yarn, point: point - self.layout.offsets()[yarn] as usize, up: up.to_array() }
            })
        };
        let ups = ups.iter().enumerate().map(unit).collect::<Result<Vec<_>, _>>()?;
        let layout = Arc::make_mut(&mut self.layout);
        let yarns = layout.offsets().par_windows(2).zip(layout.yarns());
        let stands = yarns.map(|(bounds, yarn)| {
            let own = bounds[0] as usize..bounds[1] as usize;
            Stand::of(&self.points[own.clone()], yarn.closed, Some(&ups[own]))
        });
        let stands: Vec<_> = stands.collect();
        for (yarn, stand) in stands.into_iter().enumerate() {
            layout.set_stand(yarn, stand);
        }
        self.ups = Some(Arc::new(ups));
        Ok(self)
    }

    /// The given [up direction](Yarns::with_ups) of each control point, a unit vector. `None` if
    /// none were given.
    #[must_use]
    pub fn ups(&self) -> Option<&[Vec3]> {
        self.ups.as_ref().map(|ups| ups.as_slice())
    }

    /// The layout: offsets, sections, and the data of each yarn.
    #[must_use]
    pub fn layout(&self) -> &Arc<Layout> {
        &self.layout
    }

    /// The [tension](Layout::tension) of the splines.
    #[must_use]
    pub fn tension(&self) -> f32 {
        self.layout.tension()
    }

    /// The materials that yarns refer to.
    #[must_use]
    pub fn materials(&self) -> &Arc<[Material]> {
        &self.materials
    }

    /// All control points, yarn after yarn (the paper's τ).
    #[must_use]
    pub fn points(&self) -> &[ControlPoint] {
        &self.points
    }

    /// All control points, without the rest of the yarns. Other copies of these yarns may share
    /// them.
    pub(crate) fn into_points(self) -> Arc<Vec<ControlPoint>> {
        self.points
    }

    /// The [source](Yarns::with_sources) of each control point, if there are sources.
    #[must_use]
    pub fn sources(&self) -> Option<&[u32]> {
        self.sources.as_ref().map(|sources| sources.as_slice())
    }

    /// The range of a yarn's control points among all control points, or `None` past the last yarn.
    #[must_use]
    pub fn range(&self, yarn: usize) -> Option<Range<usize>> {
        let (first, end) = (self.layout.offsets().get(yarn)?, self.layout.offsets().get(yarn + 1)?);
        Some(*first as usize..*end as usize)
    }

    /// A yarn's control points, or `None` past the last yarn.
    #[must_use]
    pub fn yarn_points(&self, yarn: usize) -> Option<&[ControlPoint]> {
        self.points.get(self.range(yarn)?)
    }

    /// Moves one yarn by replacing its control points by as many other ones.
    ///
    /// **Errors**: [`YarnError`] for an unknown yarn, another number of points, or an invalid
    /// point. The yarns are then unchanged.
    pub fn set_points(&mut self, yarn: usize, points: &[ControlPoint]) -> Result<(), YarnError> {
        let range =
            self.range(yarn).ok_or(YarnError::UnknownYarn { yarn, yarns: self.layout.yarns().len() })?;
        if range.len() != points.len() {
            return Err(YarnError::PointCount { points: points.len() as u64, planned: range.len() as u64 });
        }
        check_points(yarn, points)?;
        let ups = self.ups().map(|ups| &ups[range.clone()]);
        let stand = Stand::of(points, self.layout.yarns()[yarn].closed, ups);
        if stand != self.layout.stand(yarn) {
            Arc::make_mut(&mut self.layout).set_stand(yarn, stand);
        }
        Arc::make_mut(&mut self.points)[range].copy_from_slice(points);
        Ok(())
    }

    /// Replaces the materials. The geometry stays as it is.
    ///
    /// **Errors**: [`YarnError::UnknownMaterial`] if a yarn refers to a missing one, and
    /// the errors of [`check_material`].
    pub fn set_materials(&mut self, materials: Vec<Material>) -> Result<(), YarnError> {
        check_materials(&self.layout, &materials)?;
        self.materials = materials.into();
        Ok(())
    }
}

impl<'a> From<&'a Yarns> for Cow<'a, Yarns> {
    fn from(yarns: &'a Yarns) -> Self {
        Self::Borrowed(yarns)
    }
}

impl From<Yarns> for Cow<'_, Yarns> {
    fn from(yarns: Yarns) -> Self {
        Self::Owned(yarns)
    }
}

fn check_materials(layout: &Layout, materials: &[Material]) -> Result<(), YarnError> {
    for (yarn, each) in layout.yarns().iter().enumerate() {
        if each.material as usize >= materials.len() {
            return Err(YarnError::UnknownMaterial {
                yarn,
                material: each.material,
                materials: materials.len(),
            });
        }
    }
    materials.iter().enumerate().try_for_each(|(material, each)| check_material(material, each))
}

/// Checks a material. Its number, `material`, only appears in errors.
///
/// **Errors**: [`YarnError::Hairiness`] outside \[0, [`HAIRINESS_LIMIT`]\],
/// [`YarnError::LinearDensity`] for a tex that is no positive number, and [`YarnError::Bending`]
/// for a bending stiffness outside of [`BENDING_LIMITS`].
///
/// ```
/// use texere_core::{Material, check_material};
/// assert!(check_material(0, &Material::default()).is_ok());
/// assert!(check_material(0, &Material { hairiness: f32::NAN, ..Material::default() }).is_err());
/// assert!(check_material(0, &Material { tex: Some(-30.0), ..Material::default() }).is_err());
/// assert!(check_material(0, &Material { bending: Some(0.0), ..Material::default() }).is_err());
/// ```
pub fn check_material(material: usize, each: &Material) -> Result<(), YarnError> {
    let &Material { tex, hairiness, bending, .. } = each;
    if !(0.0..=HAIRINESS_LIMIT).contains(&hairiness) {
        return Err(YarnError::Hairiness { material, hairiness, limit: HAIRINESS_LIMIT });
    }
    if let Some(tex) = tex
        && !(tex.is_finite() && tex > 0.0)
    {
        return Err(YarnError::LinearDensity { material, tex });
    }
    let [low, high] = BENDING_LIMITS;
    match bending.filter(|bending| !(low..=high).contains(bending)) {
        Some(bending) => Err(YarnError::Bending { material, bending, low, high }),
        None => Ok(()),
    }
}

/// Checks the control points of a yarn. The yarn's number, `yarn`, only appears in errors.
///
/// **Errors**: [`YarnError::NotFinite`], [`YarnError::TooFar`] and [`YarnError::Size`] for the
/// first invalid point.
///
/// ```
/// use texere_core::{ControlPoint, check_points};
/// assert!(check_points(0, &[ControlPoint::new(1.0, 2.0, 3.0, 0.1)]).is_ok());
/// assert!(check_points(0, &[ControlPoint::new(f32::NAN, 2.0, 3.0, 0.1)]).is_err());
/// ```
pub fn check_points(yarn: usize, points: &[ControlPoint]) -> Result<(), YarnError> {
    // All points are checked together, without a branch. The first invalid point is searched for
    // only if there is one.
    let within = |value: f32, low: f32, high: f32| (value >= low) & (value <= high);
    let sound = points.iter().fold(true, |sound, point| {
        let placed = [point.x, point.y, point.z].map(|at| within(at, -COORDINATE_LIMIT, COORDINATE_LIMIT));
        sound & placed[0] & placed[1] & placed[2] & point.halves.within_limits()
    });
    if sound {
        return Ok(());
    }
    for (point, each) in points.iter().enumerate() {
        for (field, value) in [("x", each.x), ("y", each.y), ("z", each.z)] {
            if !value.is_finite() {
                return Err(YarnError::NotFinite { yarn, point, field, value });
            }
            if value.abs() > COORDINATE_LIMIT {
                return Err(YarnError::TooFar { yarn, point, field, value, limit: COORDINATE_LIMIT });
            }
        }
        for (field, size) in [("half width", each.half_width()), ("half height", each.half_height())] {
            if size.is_nan() {
                return Err(YarnError::NotFinite { yarn, point, field, value: size });
            }
            let (low, high) = (RADIUS_MIN, RADIUS_MAX);
            if !(low..=high).contains(&size) {
                return Err(YarnError::Size { yarn, point, field, size, low, high });
            }
        }
    }
    Ok(())
}

/// A builder that collects yarns one by one. [`YarnsBuilder::build`] checks them all.
#[derive(Debug, Clone, Default)]
pub struct YarnsBuilder {
    offsets: Vec<u64>,
    yarns: Vec<Yarn>,
    sections: Vec<Section>,
    materials: Vec<Material>,
    points: Vec<ControlPoint>,
    tension: f32,
}

impl YarnsBuilder {
    /// Adds a material and returns its index.
    pub fn material(&mut self, material: Material) -> u32 {
        self.materials.push(material);
        self.materials.len() as u32 - 1
    }

    /// Adds a section and returns its index.
    pub fn section(&mut self, section: Section) -> u32 {
        self.sections.push(section);
        self.sections.len() as u32 - 1
    }

    /// Adds a yarn with its control points.
    pub fn yarn(&mut self, yarn: Yarn, points: &[ControlPoint]) -> &mut Self {
        if self.offsets.is_empty() {
            self.offsets.push(0);
        }
        self.yarns.push(yarn);
        self.points.extend_from_slice(points);
        self.offsets.push(self.points.len() as u64);
        self
    }

    /// Sets the [tension](Layout::tension) of all yarns' splines, in \[0, 1). The default is 0.
    pub const fn tension(&mut self, tension: f32) -> &mut Self {
        self.tension = tension;
        self
    }

    /// Checks everything and makes the yarns. If no section was added, there is the circle. If no
    /// material was added, there is undyed yarn.
    ///
    /// **Errors**: the errors of [`Layout::new`], [`Layout::with_tension`] and [`Yarns::new`].
    pub fn build(mut self) -> Result<Yarns, YarnError> {
        if self.sections.is_empty() {
            self.sections.push(Section::Circle);
        }
        if self.materials.is_empty() {
            self.materials.push(Material::default());
        }
        let layout = Layout::new(self.yarns, self.offsets, self.sections)?.with_tension(self.tension)?;
        Yarns::new(layout, self.materials, self.points)
    }
}
