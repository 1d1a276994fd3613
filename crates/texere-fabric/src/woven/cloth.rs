//! A woven cloth: its drawdown and its threads.

use texere_core::{COORDINATE_LIMIT, Material, Origin, RADIUS_MAX, RADIUS_MIN, Section, Yarn};

use super::thread::{
    FIRMNESS_MAX, FIRMNESS_MIN, FLATNESS_MAX, FLATNESS_MIN, SPACING_MAX, SPACING_MIN, STIFFNESS_MAX,
    STIFFNESS_MIN, Thread, middles,
};
use super::{BySet, Crimp, Drawdown, Shape};
use crate::{FabricError, ThreadError, WovenError, yarn_check};

/// The most control points of a cloth. They take 64 GiB.
pub(crate) const POINTS_MAX: u64 = 1 << 32;

/// A woven cloth whose numbers have been checked: how its threads interlace, and the yarn and
/// spacing of each thread.
///
/// ```
/// use texere_core::{Material, Section};
/// use texere_fabric::{Thread, Weave, Woven};
/// let plain = Weave::parse("plain")?;
/// let thread = Thread::new(1.0, 0.2);
/// let mut cloth = Woven::new(
///     plain.drawdown(3, 2)?,
///     vec![thread; 3],
///     vec![thread; 2],
///     vec![Material::default()],
///     vec![Section::Circle],
/// )?;
/// assert_eq!(cloth.size_mm(), [3.0, 2.0]);
/// let yarns = cloth.yarns()?;
/// // At each end of a yarn a control point, at each crossing one, and three where the thread changes sides.
/// assert_eq!(yarns.layout().offsets(), [0, 7, 14, 21, 32, 43]);
///
/// // Flat yarns need less room where they cross.
/// cloth.set_section(Section::Ellipse { aspect: 2.0 })?;
/// assert!(cloth.yarns()?.points()[1].z < yarns.points()[1].z);
/// # Ok::<(), texere_fabric::FabricError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Woven {
    drawdown: Drawdown,
    pub(super) warp: Vec<Thread>,
    pub(super) weft: Vec<Thread>,
    materials: Vec<Material>,
    pub(super) sections: Vec<Section>,
    shape: Shape,
    pub(super) crimp: Crimp,
    selvedge: bool,
}

impl Woven {
    /// Checks and joins a drawdown, its ends (`warp`) and picks (`weft`), and the materials and
    /// sections that they refer to.
    ///
    /// **Errors**: [`FabricError`] for a number of threads other than the drawdown's, more control
    /// points than 2³², spacings outside \[[`SPACING_MIN`], [`SPACING_MAX`]\], radii, half widths
    /// or half heights outside \[[`RADIUS_MIN`], [`RADIUS_MAX`]\], a flatness outside \[0.1, 10\],
    /// a stiffness or firmness outside \[0.01, 100\], a least area outside \[0, 1\], twists beyond
    /// [`TWIST_LIMIT`](texere_core::TWIST_LIMIT), unknown materials and sections, sections whose
    /// numbers are not valid, and cloth wider or longer than [`COORDINATE_LIMIT`].
    pub fn new(
        drawdown: Drawdown,
        warp: Vec<Thread>,
        weft: Vec<Thread>,
        materials: Vec<Material>,
        sections: Vec<Section>,
    ) -> Result<Self, FabricError> {
        let (ends, picks) = (drawdown.ends(), drawdown.picks());
        for (set, threads, planned) in [("end", warp.len(), ends), ("pick", weft.len(), picks)] {
            if threads != planned {
                return Err(WovenError::ThreadCount { set, threads, planned }.into());
            }
        }
        yarn_check::sections(&sections)?;
        let (shape, crimp) = (Shape::default(), Crimp::default());
        let cloth = Self { drawdown, warp, weft, materials, sections, shape, crimp, selvedge: false };
        // Every shape has at least this number of points. A cloth whose shape needs too many more
        // is refused when its yarns are made.
        let (longer, wider) = (picks as u64 + 2, ends as u64 + 2);
        let points = ends as u64 * longer + picks as u64 * wider;
        if points > POINTS_MAX {
            return Err(WovenError::Points { ends, picks, points, limit: POINTS_MAX }.into());
        }
        cloth.check_threads(&cloth.warp, Origin::End)?;
        cloth.check_threads(&cloth.weft, Origin::Pick)?;
        for (set, extent_mm) in ["ends", "picks"].into_iter().zip(cloth.size_mm()) {
            let limit = f64::from(COORDINATE_LIMIT);
            if extent_mm > limit {
                return Err(WovenError::Extent { set, extent_mm, limit }.into());
            }
        }
        Ok(cloth)
    }

    /// A cloth of another drawdown and other threads, with the materials, sections, shape, crimp
    /// and selvedge of this one.
    pub(crate) fn like(
        &self,
        drawdown: Drawdown,
        warp: Vec<Thread>,
        weft: Vec<Thread>,
    ) -> Result<Self, FabricError> {
        let cloth = Self::new(drawdown, warp, weft, self.materials.clone(), self.sections.clone())?;
        Ok(Self { shape: self.shape, crimp: self.crimp, selvedge: self.selvedge, ..cloth })
    }

    /// This cloth with the spacings of ends multiplied by `times[0]`, and the spacings of picks by
    /// `times[1]`.
    pub(crate) fn spaced(&self, times: [f64; 2]) -> Result<Self, FabricError> {
        let [warp, weft] = [(&self.warp, times[0]), (&self.weft, times[1])].map(|(set, times)| {
            set.iter().map(|thread| Thread { spacing_mm: thread.spacing_mm * times, ..*thread }).collect()
        });
        self.like(self.drawdown.clone(), warp, weft)
    }

    fn check_threads(&self, threads: &[Thread], origin: fn(u32) -> Origin) -> Result<(), FabricError> {
        for (number, each) in (1..).zip(threads) {
            let thread = origin(number);
            if !(SPACING_MIN..=SPACING_MAX).contains(&each.spacing_mm) {
                return Err(WovenError::Spacing {
                    thread,
                    spacing_mm: each.spacing_mm,
                    low: SPACING_MIN,
                    high: SPACING_MAX,
                }
                .into());
            }
            let Thread { material, section, twist, radius_mm, .. } = *each;
            let yarn = Yarn { material, section, closed: false, twist, origin: thread };
            yarn_check::yarn(&yarn, radius_mm, &self.materials, &self.sections)?;
            if !(FLATNESS_MIN..=FLATNESS_MAX).contains(&each.flatness) {
                return Err(WovenError::Flatness {
                    thread,
                    flatness: each.flatness,
                    low: FLATNESS_MIN,
                    high: FLATNESS_MAX,
                }
                .into());
            }
            if !(STIFFNESS_MIN..=STIFFNESS_MAX).contains(&each.stiffness) {
                return Err(WovenError::Stiffness {
                    thread,
                    stiffness: each.stiffness,
                    low: STIFFNESS_MIN,
                    high: STIFFNESS_MAX,
                }
                .into());
            }
            if !(FIRMNESS_MIN..=FIRMNESS_MAX).contains(&each.firmness) {
                return Err(WovenError::Firmness {
                    thread,
                    firmness: each.firmness,
                    low: FIRMNESS_MIN,
                    high: FIRMNESS_MAX,
                }
                .into());
            }
            if !(0.0..=1.0).contains(&each.least_area) {
                return Err(WovenError::LeastArea { thread, least_area: each.least_area }.into());
            }
            let [half_width, half_height] = each.halves_mm();
            for (side, half_mm) in [("width", half_width), ("height", half_height)] {
                if !(RADIUS_MIN..=RADIUS_MAX).contains(&half_mm) {
                    return Err(WovenError::Half {
                        thread,
                        side,
                        half_mm,
                        low: RADIUS_MIN,
                        high: RADIUS_MAX,
                    }
                    .into());
                }
            }
        }
        Ok(())
    }

    /// Which thread lies on top at each crossing.
    #[must_use]
    pub const fn drawdown(&self) -> &Drawdown {
        &self.drawdown
    }

    pub(super) const fn drawdown_mut(&mut self) -> &mut Drawdown {
        &mut self.drawdown
    }

    /// Puts the warp up or down at a crossing; `end` and `pick` are counted from 0.
    ///
    /// ```
    /// use texere_core::{Material, Section};
    /// use texere_fabric::{Thread, Weave, Woven};
    /// let (warp, weft) = (vec![Thread::new(1.0, 0.2); 4], vec![Thread::new(1.0, 0.2); 4]);
    /// let plain = Weave::parse("plain")?.drawdown(4, 4)?;
    /// let mut cloth = Woven::new(plain, warp, weft, vec![Material::default()], vec![Section::Circle])?;
    /// let up = cloth.drawdown().up(2, 1);
    /// cloth.set_lift(2, 1, !up)?;
    /// assert_eq!(cloth.drawdown().up(2, 1), !up);
    /// # Ok::<(), texere_fabric::FabricError>(())
    /// ```
    ///
    /// **Errors**: [`WovenError::NoCrossing`] for a crossing outside the cloth.
    pub fn set_lift(&mut self, end: usize, pick: usize, up: bool) -> Result<(), WovenError> {
        self.drawdown.set(end, pick, up)
    }

    /// A cloth with this cloth's drawdown, shape, crimp and selvedge, but with other ends (`warp`)
    /// and picks (`weft`), and the materials and sections that these refer to.
    ///
    /// ```
    /// use texere_core::{Material, Section};
    /// use texere_fabric::{Thread, Weave, Woven, diameter_mm, tex_from_cotton_count};
    /// let (warp, weft) = (vec![Thread::new(1.0, 0.2); 4], vec![Thread::new(1.0, 0.2); 4]);
    /// let plain = Weave::parse("plain")?.drawdown(4, 4)?;
    /// let cloth = Woven::new(plain, warp, weft, vec![Material::default()], vec![Section::Circle])?;
    /// // Cotton of Ne 20, whose yarns have a density of .9 g/cm3.
    /// let cotton = Thread::new(0.5, (diameter_mm(tex_from_cotton_count(20.0), 0.9) / 2.0) as f32);
    /// let (materials, sections) = (cloth.materials().to_vec(), cloth.sections().to_vec());
    /// let finer = cloth.with_threads(vec![cotton; 4], vec![cotton; 4], materials, sections)?;
    /// assert_eq!(finer.drawdown(), cloth.drawdown());
    /// assert_eq!(finer.size_mm(), [2.0, 2.0]);
    /// # Ok::<(), texere_fabric::FabricError>(())
    /// ```
    ///
    /// **Errors**: the errors of [`Woven::new`].
    pub fn with_threads(
        &self,
        warp: Vec<Thread>,
        weft: Vec<Thread>,
        materials: Vec<Material>,
        sections: Vec<Section>,
    ) -> Result<Self, FabricError> {
        let cloth = Self::new(self.drawdown.clone(), warp, weft, materials, sections)?;
        Ok(Self { shape: self.shape, crimp: self.crimp, selvedge: self.selvedge, ..cloth })
    }

    /// The ends, from the left.
    #[must_use]
    pub fn warp(&self) -> &[Thread] {
        &self.warp
    }

    /// The picks, from the first one woven.
    #[must_use]
    pub fn weft(&self) -> &[Thread] {
        &self.weft
    }

    /// The materials that threads refer to.
    #[must_use]
    pub fn materials(&self) -> &[Material] {
        &self.materials
    }

    /// Gives the material with number `material`, counted from 0, the sRGB colour `srgb`.
    ///
    /// **Errors**: [`WovenError::NoMaterial`] past the last material.
    pub fn set_color(&mut self, material: usize, srgb: [u8; 3]) -> Result<(), WovenError> {
        let materials = self.materials.len();
        let place = self.materials.get_mut(material).ok_or(WovenError::NoMaterial { material, materials })?;
        place.srgb = srgb;
        Ok(())
    }

    /// Replaces the material with number `material`, counted from 0.
    pub(super) fn set_material(&mut self, material: usize, with: Material) -> Result<(), WovenError> {
        let materials = self.materials.len();
        *self.materials.get_mut(material).ok_or(WovenError::NoMaterial { material, materials })? = with;
        Ok(())
    }

    /// The sections that threads refer to.
    #[must_use]
    pub fn sections(&self) -> &[Section] {
        &self.sections
    }

    /// Gives all threads one flatness, width over height. Each thread keeps its area.
    ///
    /// **Errors**: [`WovenError::Flatness`] outside \[0.1, 10\], and [`WovenError::Half`] for a
    /// thread that would be too thin or too wide. After an error the cloth is unchanged.
    pub fn set_flatness(&mut self, flatness: f32) -> Result<(), FabricError> {
        let flattened = |set: &[Thread]| set.iter().map(|thread| Thread { flatness, ..*thread }).collect();
        let (warp, weft): (Vec<_>, Vec<_>) = (flattened(&self.warp), flattened(&self.weft));
        self.check_threads(&warp, Origin::End)?;
        self.check_threads(&weft, Origin::Pick)?;
        (self.warp, self.weft) = (warp, weft);
        Ok(())
    }

    /// Gives all threads one section.
    ///
    /// **Errors**: [`ThreadError::Section`] if the section's numbers are not valid. After an error
    /// the cloth is unchanged.
    pub fn set_section(&mut self, section: Section) -> Result<(), ThreadError> {
        section.validate().map_err(|source| ThreadError::Section { section: 0, source })?;
        self.sections = vec![section];
        for thread in self.warp.iter_mut().chain(&mut self.weft) {
            thread.section = 0;
        }
        Ok(())
    }

    /// Width (along the weft) and height (along the warp) of the cloth, mm: the sums of its
    /// threads' spacings.
    #[must_use]
    pub fn size_mm(&self) -> [f64; 2] {
        [&self.warp, &self.weft].map(|threads| threads.iter().map(|thread| thread.spacing_mm).sum())
    }

    /// The number and the places of the threads' control points.
    #[must_use]
    pub const fn shape(&self) -> Shape {
        self.shape
    }

    /// Chooses the number and the places of the threads' control points.
    pub const fn set_shape(&mut self, shape: Shape) {
        self.shape = shape;
    }

    /// How warp and weft share the crimp.
    #[must_use]
    pub const fn crimp(&self) -> Crimp {
        self.crimp
    }

    /// Chooses how warp and weft share the crimp.
    ///
    /// **Errors**: [`WovenError::Crimp`] for a share outside \[0, 1\]. After an error the cloth is
    /// unchanged.
    pub fn set_crimp(&mut self, crimp: Crimp) -> Result<(), WovenError> {
        crimp.validate()?;
        self.crimp = crimp;
        Ok(())
    }

    /// The warp's share of the crimp, from 0 to 1, that [`Woven::crimp`] gives in this cloth.
    #[must_use]
    pub fn warp_share(&self) -> f32 {
        self.crimp.warp_share(&self.warp, &self.weft)
    }

    /// Whether the weft turns back round the edge ends.
    #[must_use]
    pub const fn selvedge(&self) -> bool {
        self.selvedge
    }

    /// Chooses whether the weft turns back round the edge ends, or each pick is a yarn of its own,
    /// cut at both edges.
    pub const fn set_selvedge(&mut self, selvedge: bool) {
        self.selvedge = selvedge;
    }

    /// Middles of the ends (x) and of the picks (y), mm from the cloth's left and lower edges. Each
    /// thread lies in the middle of a strip as wide as its own spacing.
    ///
    /// ```
    /// use texere_core::{Material, Section};
    /// use texere_fabric::{Thread, Weave, Woven};
    /// let (thin, thick) = (Thread::new(1.0, 0.2), Thread::new(2.0, 0.4));
    /// let plain = Weave::parse("plain")?.drawdown(3, 1)?;
    /// let (warp, weft) = (vec![thin, thick, thin], vec![thin]);
    /// let cloth = Woven::new(plain, warp, weft, vec![Material::default()], vec![Section::Circle])?;
    /// assert_eq!(cloth.middles_mm().warp, [0.5, 2.0, 3.5]);
    /// assert_eq!(cloth.size_mm(), [4.0, 1.0]);
    /// # Ok::<(), texere_fabric::FabricError>(())
    /// ```
    #[must_use]
    pub fn middles_mm(&self) -> BySet<Vec<f64>> {
        BySet { warp: &self.warp, weft: &self.weft }.map(|threads| middles(threads).collect())
    }
}
