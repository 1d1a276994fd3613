//! Shows the progress of a call: in a progress bar of tqdm, or by calling the caller's function.

use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Where a call's progress is shown.
#[derive(Debug)]
pub(crate) enum Shown {
    /// No progress is shown.
    Nobody,
    /// A progress bar of tqdm that is not drawn yet, with the text before it. Short calls end
    /// before it is drawn.
    Waiting(&'static str),
    /// A progress bar of tqdm that has been drawn.
    Bar(Py<PyAny>),
    /// A function of the caller's, which is called with the share of the work that is done.
    Function(Py<PyAny>),
}

impl Shown {
    /// Reads the argument `progress`. True asks for a progress bar, which needs tqdm to be
    /// installed. False asks for no bar. A function is called with the share that is done. `what`
    /// is the text before the bar.
    pub(crate) fn asked(progress: &Bound<'_, PyAny>, what: &'static str) -> PyResult<Self> {
        if let Ok(asked) = progress.extract::<bool>() {
            return Ok(if asked { Self::Waiting(what) } else { Self::Nobody });
        }
        if progress.is_callable() {
            return Ok(Self::Function(progress.clone().unbind()));
        }
        Err(PyTypeError::new_err("progress is neither a bool nor a function of the share that is done"))
    }

    /// Shows the share that is done, from 0 to 1.
    pub(crate) fn show(&mut self, py: Python<'_>, share: f64) -> PyResult<()> {
        if let Self::Waiting(what) = self {
            *self = bar(py, what)?;
        }
        match self {
            Self::Bar(bar) => {
                bar.setattr(py, "n", (1000.0 * share).round() / 10.0)?;
                bar.call_method0(py, "refresh").map(|_| ())
            }
            Self::Function(function) => function.call1(py, (share,)).map(|_| ()),
            Self::Nobody | Self::Waiting(_) => Ok(()),
        }
    }

    /// Removes the bar, if one has been drawn.
    pub(crate) fn close(&self, py: Python<'_>) -> PyResult<()> {
        match self {
            Self::Bar(bar) => bar.call_method0(py, "close").map(|_| ()),
            _ => Ok(()),
        }
    }
}

/// A new progress bar of tqdm, or [`Shown::Nobody`] if tqdm is not installed.
fn bar(py: Python<'_>, what: &str) -> PyResult<Shown> {
    let Ok(tqdm) = py.import("tqdm.auto") else { return Ok(Shown::Nobody) };
    let options = PyDict::new(py);
    options.set_item("total", 100)?;
    options.set_item("desc", what)?;
    options.set_item("leave", false)?;
    options.set_item("bar_format", "{desc}: {percentage:3.0f}%|{bar}| {elapsed}")?;
    Ok(Shown::Bar(tqdm.call_method("tqdm", (), Some(&options))?.unbind()))
}
