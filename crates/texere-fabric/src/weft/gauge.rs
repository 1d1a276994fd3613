//! Gauge: the distances between the loops of a knit.

use crate::yarn_size::INCH_MM;

/// Munden's constants of plain jersey after dry relaxation, without unit: wales per cm times the
/// loop length in cm, and courses per cm times the loop length in cm.
const MUNDEN: [f64; 2] = [4.2, 5.5];

/// The distances between the loops of a knit, and the length of its loops.
///
/// ```
/// use texere_fabric::weft::Gauge;
/// // Plain jersey with loops of 2.5 mm: 16.8 wales and 22 courses a cm.
/// let gauge = Gauge::munden(2.5);
/// assert!((10.0 / gauge.wale_mm - 16.8).abs() < 1e-9 && (10.0 / gauge.course_mm - 22.0).abs() < 1e-9);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gauge {
    /// Distance from one wale to the next, mm.
    pub wale_mm: f64,
    /// Distance from one course to the next, mm.
    pub course_mm: f64,
    /// The mean length of yarn in a loop that settling aims for, mm. With `None` the lengths of
    /// loops are free.
    pub loop_length_mm: Option<f64>,
}

impl Gauge {
    /// A gauge of wales and courses at these distances, mm, with loops of any length.
    #[must_use]
    pub const fn new(wale_mm: f64, course_mm: f64) -> Self {
        Self { wale_mm, course_mm, loop_length_mm: None }
    }

    /// The gauge of a machine with `needles` per inch, each of which makes one wale, and of cloth
    /// with `courses_per_cm`.
    ///
    /// ```
    /// assert!((texere_fabric::weft::Gauge::per_inch(14.0, 12.5).wale_mm - 1.814).abs() < 1e-3);
    /// ```
    #[must_use]
    pub fn per_inch(needles: f64, courses_per_cm: f64) -> Self {
        Self::new(INCH_MM / needles, 10.0 / courses_per_cm)
    }

    /// The gauge of plain jersey from a machine with `needles` per inch, each of which makes one
    /// wale. A course is 4.2 / 5.5 of a wale high, by Munden's constants ([`Gauge::munden`]).
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

    /// The gauge of plain jersey with loops of `loop_length_mm` after dry relaxation: 4.2 / l wales
    /// and 5.5 / l courses per cm, with l in cm. Other structures draw in by other amounts, and
    /// need figures of their own.
    ///
    /// **Source**: Munden, "The geometry and dimensional properties of plain-knit fabrics", Journal
    /// of the Textile Institute 50, 1959.
    #[must_use]
    pub fn munden(loop_length_mm: f64) -> Self {
        let [wale_mm, course_mm] = MUNDEN.map(|per_cm| loop_length_mm / per_cm);
        Self { wale_mm, course_mm, loop_length_mm: Some(loop_length_mm) }
    }
}
