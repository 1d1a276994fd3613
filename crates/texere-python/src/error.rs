//! The exception of what texere refuses, and its place in a file.

use std::error::Error as StdError;
use std::iter::successors;

use pyo3::create_exception;
use pyo3::exceptions::PyException;
use pyo3::prelude::*;
use texere::read::{FaultPlace, fault_place};

create_exception!(
    texere,
    Error,
    PyException,
    "What texere refuses: a design that can't be read or made, yarns out of range, a device that \
     fails.\n\n\
     The message is one line with all causes. ``file`` is the path of the design's file that is at \
     fault, ``line`` and ``column`` count from 1 in it; each is None where the error has no such \
     place. ``causes`` are the messages from the outermost to the innermost error.\n\n\
     >>> try:\n\
     ...     texere.read(\"nowhere.toml\")\n\
     ... except texere.Error as error:\n\
     ...     print(error.file, error.line)\n\
     nowhere.toml None\n"
);

/// Gives the exception's class the attributes that each of its instances has.
pub(crate) fn complete(py: Python<'_>) -> PyResult<()> {
    let class = py.get_type::<Error>();
    for name in ["file", "line", "column"] {
        class.setattr(name, py.None())?;
    }
    class.setattr("causes", pyo3::types::PyTuple::empty(py))
}

/// The exception of an error of the crate `texere`.
pub(crate) fn raised(py: Python<'_>, error: &(dyn StdError + 'static)) -> PyErr {
    let causes = successors(Some(error), |error: &&(dyn StdError + 'static)| (*error).source());
    let causes: Vec<_> = causes.map(ToString::to_string).collect();
    let raised = Error::new_err(causes.join(": "));
    let value = raised.value(py);
    let counted = |number: usize| (number > 0).then_some(number);
    let place = fault_place(error);
    let file = place.map(|FaultPlace { file, .. }| file.to_string_lossy().into_owned());
    let line = place.and_then(|place| counted(place.line));
    let column = place.and_then(|place| counted(place.column));
    let causes = pyo3::types::PyTuple::new(py, causes);
    let set = value.setattr("file", file).and_then(|()| value.setattr("line", line));
    let set = set.and_then(|()| value.setattr("column", column));
    match set.and_then(|()| value.setattr("causes", causes?)) {
        Ok(()) => raised,
        Err(error) => error,
    }
}

/// Errors of the crate `texere` as exceptions.
pub(crate) trait Raise<T> {
    /// The value, or the exception.
    fn raise(self, py: Python<'_>) -> PyResult<T>;
}

impl<T, E: StdError + 'static> Raise<T> for Result<T, E> {
    fn raise(self, py: Python<'_>) -> PyResult<T> {
        self.map_err(|error| raised(py, &error))
    }
}
