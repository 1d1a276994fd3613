//! Woven designs in code.

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use texere::Structure;
use texere::woven::{Crimp, Relief, Shape, Thread, Woven, WovenDesign};

use crate::arrays::given;
use crate::design::Design;
use crate::drawdown;
use crate::error::Raise;
use crate::yarn::Bobbins;

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
    let drawdown = drawdown::read(drawdown)?;
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
