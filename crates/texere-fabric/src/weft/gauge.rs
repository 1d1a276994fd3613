//! How close stitches lie.

use crate::yarn_size::INCH_MM;

/// Munden's constants of plain jersey, dry relaxed: loops a cm along a course and along a wale,
/// times the loop length in cm.
const MUNDEN: [f64; 2] = [4.2, 5.5];

/// How close the stitches of a weft knit lie, and how long its loops are.
///
/// ```
/// use texere_fabric::weft::Gauge;
/// // Plain jersey with loops of 2.5 mm: 16.8 wales and 22 courses a cm.
/// let gauge = Gauge::munden(2.5);
/// assert!((10.0 / gauge.wale_mm - 16.8).abs() < 1e-9 && (10.0 / gauge.course_mm - 22.0).abs() < 1e-9);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gauge {
    /// From one wale to the next, mm.
    pub wale_mm: f64,
    /// From one course to the next, mm.
    pub course_mm: f64,
    /// The mean length of yarn in a loop that settling is to reach, mm; `None` where it finds its
    /// own.
    pub loop_length_mm: Option<f64>,
}

impl Gauge {
    /// Wales and courses so many mm apart, with loops of any length.
    #[must_use]
    pub const fn new(wale_mm: f64, course_mm: f64) -> Self {
        Self { wale_mm, course_mm, loop_length_mm: None }
    }

    /// A wale for each needle of a machine with so many to the inch, and so many courses to the cm
    /// of cloth.
    ///
    /// ```
    /// assert!((texere_fabric::weft::Gauge::per_inch(14.0, 12.5).wale_mm - 1.814).abs() < 1e-3);
    /// ```
    #[must_use]
    pub fn per_inch(needles: f64, courses_per_cm: f64) -> Self {
        Self::new(INCH_MM / needles, 10.0 / courses_per_cm)
    }

    /// A wale for each needle of a machine with so many to the inch, and courses as close as plain
    /// jersey has them, by Munden's constants ([`Gauge::munden`]): 4.2 / 5.5 of a wale.
    ///
    /// ```
    /// let gauge = texere_fabric::weft::Gauge::plain(14.0);
    /// assert!((gauge.wale_mm - 1.814).abs() < 1e-3 && (gauge.course_mm / gauge.wale_mm - 0.764).abs() < 1e-3);
    /// ```
    #[must_use]
    pub fn plain(needles: f64) -> Self {
        let [wales, courses] = MUNDEN;
        let wale_mm = INCH_MM / needles;
        Self::new(wale_mm, wales / courses * wale_mm)
    }

    /// Plain jersey with loops of `loop_length_mm`, as it lies after dry relaxation: 4.2 / l wales
    /// and 5.5 / l courses to the cm, l in cm. Other structures draw in further, or less: they need
    /// their own figures.
    ///
    /// **Source**: Munden, "The geometry and dimensional properties of plain-knit fabrics", Journal
    /// of the Textile Institute 50, 1959.
    #[must_use]
    pub fn munden(loop_length_mm: f64) -> Self {
        let [wale_mm, course_mm] = MUNDEN.map(|per_cm| loop_length_mm / per_cm);
        Self { wale_mm, course_mm, loop_length_mm: Some(loop_length_mm) }
    }
}
