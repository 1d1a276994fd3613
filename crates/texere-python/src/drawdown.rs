//! Drawdowns, as arrays.

use numpy::ndarray::Array2;
use numpy::{IntoPyArray, PyArray2};
use pyo3::prelude::*;
use texere::woven::{Drawdown, Weave};

use crate::arrays::given;
use crate::error::Raise;

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
