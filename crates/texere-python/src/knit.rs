//! Weft and warp knits in code.

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use texere::Structure;
use texere::warp::{self, CHAIN_COURSES, Chain, Lap, NEEDLES_MOST, SPACE_MAX, Threading, WarpKnitted};
use texere::weft::{Beds, Cells, Chart, Gauge, Knitted, Machine};

use crate::arrays::given;
use crate::design::Design;
use crate::error::Raise;
use crate::woven::choice;
use crate::yarn::Bobbins;

/// The values of the argument `cells`, which sets the number of control points of a stitch.
const CELLS: [(&str, Cells); 2] = [("round", Cells::Round), ("even", Cells::Even)];

/// A weft knit from a chart.
///
/// ``chart`` is one repeat in symbols, a row to the line, the last course on top: ``k`` knit, ``p``
/// purl, ``t`` tuck, ``m`` miss, ``<`` and ``>`` transfers, ``RRrr`` a cable; with ``beds=2`` also
/// ``b`` both needles and ``u`` tuck on the back needle. ``yarns`` is a :class:`texere.Yarn` or a
/// sequence of them; ``turn`` has the number of each course's yarn, in turn from the first course
/// on, copied. ``wale_mm`` and ``course_mm`` are the distances of wales and courses. ``copies`` are
/// those of the repeat along courses and wales. ``loop_length_mm`` is the length of yarn in a loop
/// that settling aims for; with None loops may get any length. ``cells`` is ``round`` or ``even``
/// (equally many control points for each stitch).
///
/// >>> wool = texere.Yarn(diameter_mm=0.3)
/// >>> rib = texere.weft_knit("kp", wool, wale_mm=1.5, course_mm=1.0, copies=(4, 6))
/// >>> rib.kind
/// 'weft-knitted'
///
/// Raises :class:`texere.Error`, TypeError and ValueError for what no knit can be.
#[pyfunction]
#[pyo3(signature = (chart, yarns, *, wale_mm, course_mm, turn=None, copies=(1, 1), beds=1, loop_length_mm=None, cells="round", name="weft-knitted"))]
#[allow(clippy::too_many_arguments, reason = "each is an argument by name in Python")]
pub(crate) fn weft_knit(
    py: Python<'_>,
    chart: &str,
    yarns: &Bound<'_, PyAny>,
    wale_mm: f64,
    course_mm: f64,
    turn: Option<Vec<u32>>,
    copies: (u32, u32),
    beds: u32,
    loop_length_mm: Option<f64>,
    cells: &str,
    name: &str,
) -> PyResult<Design> {
    let mut bobbins = Bobbins::default();
    let count = bobbins.add("yarns", yarns)?.len();
    let turn = turn.unwrap_or_default();
    if let Some(yarn) = turn.iter().find(|yarn| **yarn as usize >= count) {
        return Err(PyValueError::new_err(format!(
            "turn has yarn {yarn}, but there are {count}, counted from 0"
        )));
    }
    let beds = match beds {
        1 => Beds::One,
        2 => Beds::Two,
        other => return Err(PyValueError::new_err(format!("beds is {other}, expected 1 or 2"))),
    };
    let cells = choice("cells", cells, &CELLS)?;
    let chart = Chart::parse(chart, beds).and_then(|chart| chart.with_yarns(&turn)).raise(py)?;
    let knit = Machine::default().knit(&chart.program().raise(py)?).raise(py)?;
    let gauge = Gauge { wale_mm, course_mm, loop_length_mm };
    let yarns = bobbins.knit();
    let Bobbins { materials, sections, .. } = bobbins;
    let knit = Knitted::new(knit.stitches, gauge, yarns, materials, sections, copies.into()).raise(py)?;
    Ok(Design::of(texere::Design::of(name, Structure::Weft(knit.with_cells(cells)))))
}

/// A guide bar of a warp knit.
///
/// ``chain`` is its movement: chain notation such as ``"1-0/2-3//"``, or an array of shape
/// (courses, 2) of the needle spaces from which and to which each course's lap goes, copied.
/// ``step=2`` says that only even numbers are spaces, as on Raschel machines. ``threading`` has the
/// number of each guide's yarn, or None for an empty guide, and begins again after its last.
/// ``offset`` moves the whole bar by needles towards the high numbers. ``run_in_mm`` is the length
/// of yarn for a rack of 480 courses; None leaves it to the laps.
///
/// >>> texere.Bar("1-0/2-3//")
/// <texere.Bar 1-0/2-3//>
///
/// Raises :class:`texere.Error` for a text that is no chain, TypeError and ValueError for an array
/// that is no chain.
#[pyclass(frozen, module = "texere")]
#[derive(Debug)]
pub(crate) struct Bar {
    bar: warp::Bar,
}

#[pymethods]
impl Bar {
    #[new]
    #[pyo3(signature = (chain, *, threading=None, offset=0, run_in_mm=None, step=1))]
    fn new(
        py: Python<'_>,
        chain: &Bound<'_, PyAny>,
        threading: Option<Vec<Option<u32>>>,
        offset: i32,
        run_in_mm: Option<f64>,
        step: u32,
    ) -> PyResult<Self> {
        let chain = match chain.extract::<String>() {
            Ok(text) => Chain::parse(&text, step).raise(py)?,
            Err(_) => laps(chain)?,
        };
        let threading = threading.map_or_else(|| Threading::full(0), Threading::of);
        Ok(Self { bar: warp::Bar { chain, threading, offset, run_in_mm, jacquard: None } })
    }

    fn __repr__(&self) -> String {
        format!("<texere.Bar {}>", self.bar.chain)
    }
}

/// The chain of an array of laps.
fn laps(value: &Bound<'_, PyAny>) -> PyResult<Chain> {
    let array = given("chain", value, &[None, Some(2)])?;
    if !(1..=CHAIN_COURSES).contains(&array.shape[0]) {
        let courses = array.shape[0];
        return Err(PyValueError::new_err(format!(
            "chain has {courses} laps, expected 1 to {CHAIN_COURSES}"
        )));
    }
    let spaces: Vec<i64> = array.values()?;
    if let Some(space) = spaces.iter().find(|space| !(0..=i64::from(SPACE_MAX)).contains(*space)) {
        return Err(PyValueError::new_err(format!(
            "chain has the needle space {space}, expected 0 to {SPACE_MAX}"
        )));
    }
    let laps = spaces.chunks_exact(2).map(|lap| Lap { from: lap[0] as i32, to: lap[1] as i32 });
    Chain::new(laps.collect()).ok_or_else(|| {
        PyValueError::new_err(format!("chain has a lap round more than {NEEDLES_MOST} needles"))
    })
}

/// A warp knit from its guide bars.
///
/// ``bars`` are the :class:`texere.Bar` from the front one on. ``yarns`` are the yarns that
/// threadings refer to: a :class:`texere.Yarn` or a sequence of them. ``wales`` and ``courses`` are
/// the size of one piece. They are multiples of the numbers of wales and of courses after which all
/// bars begin again. ``copies`` are the numbers of such pieces along courses and wales.
/// ``wale_mm``, ``course_mm`` and ``cells`` are as in :func:`texere.weft_knit`.
///
/// >>> locknit = texere.warp_knit(
/// ...     [texere.Bar("1-0/2-3//"), texere.Bar("1-2/1-0//")], texere.Yarn(diameter_mm=0.1),
/// ...     wale_mm=1.0, course_mm=0.75, wales=4, courses=2, copies=(3, 5))
/// >>> locknit.size_mm
/// (12.0, 7.5)
///
/// Raises :class:`texere.Error`, TypeError and ValueError for what no knit can be.
#[pyfunction]
#[pyo3(signature = (bars, yarns, *, wale_mm, course_mm, wales, courses, copies=(1, 1), cells="round", name="warp-knitted"))]
#[allow(clippy::too_many_arguments, reason = "each is an argument by name in Python")]
pub(crate) fn warp_knit(
    py: Python<'_>,
    bars: Vec<PyRef<'_, Bar>>,
    yarns: &Bound<'_, PyAny>,
    wale_mm: f64,
    course_mm: f64,
    wales: u32,
    courses: u32,
    copies: (u32, u32),
    cells: &str,
    name: &str,
) -> PyResult<Design> {
    let mut bobbins = Bobbins::default();
    bobbins.add("yarns", yarns)?;
    let cells = choice("cells", cells, &CELLS)?;
    let bars = bars.iter().map(|bar| bar.bar.clone()).collect();
    let yarns = bobbins.knit();
    let Bobbins { materials, sections, .. } = bobbins;
    let gauge = Gauge::new(wale_mm, course_mm);
    let knit = WarpKnitted::new(bars, gauge, wales, courses, yarns, materials, sections, copies.into());
    let knit = knit.raise(py)?.with_cells(cells);
    Ok(Design::of(texere::Design::of(name, Structure::Warp(knit))))
}
