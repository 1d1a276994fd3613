//! Woven designs in code.

use numpy::ndarray::Array2;
use numpy::{IntoPyArray, PyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use texere::Structure;
use texere::woven::{Crimp, Drawdown, Relief, Shape, Thread, Weave, Woven, WovenDesign};

use crate::arrays::given;
use crate::design::Design;
use crate::error::Raise;
use crate::yarn::Bobbins;

/// The drawdown of a weave in notation, as a bool array of shape (picks, ends): ``plain``, ``2/2``,
/// ``satin 8(3)``, ``herringbone 2/2(16)``. Row 0 is the first pick, at the bottom of the cloth;
/// column 0 the first end, at the left. True: the end lies on the face. Returns a copy.
///
/// >>> texere.weave("2/2", ends=4, picks=2).astype(int).tolist()
/// [[1, 1, 0, 0], [0, 1, 1, 0]]
///
/// Raises :class:`texere.Error` for a text that is no notation, and for a size that no cloth has.
#[pyfunction]
pub(crate) fn weave<'py>(
    py: Python<'py>,
    notation: &str,
    ends: usize,
    picks: usize,
) -> PyResult<Bound<'py, PyArray2<bool>>> {
    let drawdown = Weave::parse(notation).raise(py)?.drawdown(ends, picks).raise(py)?;
    let up = |(pick, end)| drawdown.up(end, pick);
    Ok(Array2::from_shape_fn((picks, ends), up).into_pyarray(py))
}

/// A woven design from a drawdown and yarns.
///
/// ``drawdown`` is an array of shape (picks, ends) of bool, or of 0 and 1, as :func:`texere.weave`
/// gives it; copied. ``warp`` and ``weft`` are a :class:`texere.Yarn`, or a sequence that is
/// repeated over the ends from the left, the picks from the bottom. ``warp_mm`` and ``weft_mm`` are
/// the width of a thread's column of the cloth, mm: a number, or one for each thread. With
/// ``selvedge`` the weft turns back round the edge ends. ``shape`` is ``round`` or ``crossing``
/// (one control point a crossing). ``warp_share`` is the warp's share of the crimp, 0 (straight
/// ends) to 1; None leaves it to the yarns' stiffness. ``relief`` says what becomes of threads that
/// lie too close where they are placed: ``report``, ``flatten`` or ``shrink``.
///
/// >>> yarn = texere.Yarn(tex=30)
/// >>> texere.woven(texere.weave("2/2", 40, 30), warp=yarn, weft=yarn, warp_mm=0.4, weft_mm=0.4)
/// <texere.Design 'woven', woven, 16.0 x 12.0 mm>
///
/// Raises :class:`texere.Error`, TypeError and ValueError for arrays that no cloth can be.
#[pyfunction]
#[pyo3(signature = (drawdown, warp, weft, *, warp_mm, weft_mm, name="woven", selvedge=false, shape="round", warp_share=None, relief="report"))]
#[allow(clippy::too_many_arguments, reason = "each is an argument by name in Python")]
pub(crate) fn woven(
    py: Python<'_>,
    drawdown: &Bound<'_, PyAny>,
    warp: &Bound<'_, PyAny>,
    weft: &Bound<'_, PyAny>,
    warp_mm: &Bound<'_, PyAny>,
    weft_mm: &Bound<'_, PyAny>,
    name: &str,
    selvedge: bool,
    shape: &str,
    warp_share: Option<f32>,
    relief: &str,
) -> PyResult<Design> {
    let drawdown = read(drawdown)?;
    let mut bobbins = Bobbins::default();
    let (warp, weft) = (bobbins.add("warp", warp)?, bobbins.add("weft", weft)?);
    let warp = threads(&bobbins, &warp, drawdown.ends(), "warp_mm", warp_mm)?;
    let weft = threads(&bobbins, &weft, drawdown.picks(), "weft_mm", weft_mm)?;
    let mut cloth = Woven::new(drawdown, warp, weft, bobbins.materials, bobbins.sections).raise(py)?;
    cloth.set_selvedge(selvedge);
    cloth.set_shape(choice("shape", shape, &[("round", Shape::Round), ("crossing", Shape::Crossing)])?);
    if let Some(share) = warp_share {
        cloth.set_crimp(Crimp::WarpShare(share)).raise(py)?;
    }
    let reliefs = [("report", Relief::Report), ("flatten", Relief::Flatten), ("shrink", Relief::Shrink)];
    let relief = choice("relief", relief, &reliefs)?;
    let woven = WovenDesign::new(cloth, None, relief).raise(py)?;
    Ok(Design::of(texere::Design::of(name, Structure::Woven(woven))))
}

/// A drawdown from a caller's array.
pub(crate) fn read(value: &Bound<'_, PyAny>) -> PyResult<Drawdown> {
    let array = given("drawdown", value, &[None, None])?;
    let (picks, ends) = (array.shape[0], array.shape[1]);
    // The size is checked before anything of that size is copied.
    let mut drawdown = Drawdown::new(ends, picks).raise(value.py())?;
    for (number, up) in array.values::<bool>()?.into_iter().enumerate() {
        if up {
            drawdown.set(number % ends, number / ends, true).raise(value.py())?;
        }
    }
    Ok(drawdown)
}

/// `count` threads that take the `yarns` in turn.
fn threads(
    bobbins: &Bobbins,
    yarns: &[usize],
    count: usize,
    name: &'static str,
    spacing: &Bound<'_, PyAny>,
) -> PyResult<Vec<Thread>> {
    let spacing = match spacing.extract::<f64>() {
        Ok(one) => vec![one],
        Err(_) => given(name, spacing, &[Some(count)])?.values()?,
    };
    let thread = |number: usize| bobbins.thread(yarns[number % yarns.len()], spacing[number % spacing.len()]);
    Ok((0..count).map(thread).collect())
}

/// The choice of a name.
///
/// **Errors**: `ValueError`, with the names that there are.
pub(crate) fn choice<T: Copy>(what: &str, name: &str, choices: &[(&str, T)]) -> PyResult<T> {
    choices.iter().find(|(known, _)| *known == name).map(|(_, choice)| *choice).ok_or_else(|| {
        let known = choices.iter().map(|(name, _)| *name).collect::<Vec<_>>().join(", ");
        PyValueError::new_err(format!("{what} is {name:?}, expected one of {known}"))
    })
}
