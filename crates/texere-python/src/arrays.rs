//! Arrays of Python: those that callers give, which are copied, and views of what an object owns.

use numpy::ndarray::{ArrayView, Dimension};
use numpy::{Element, PyArray, PyArrayDyn, PyArrayMethods};
use pyo3::exceptions::{PyMemoryError, PyTypeError, PyValueError};
use pyo3::prelude::*;

/// A number that a caller's array is converted to.
pub(crate) trait Number: Element + Copy {
    /// The numpy type.
    const DTYPE: &'static str;
    /// The kinds of numpy types that are taken: `b` bool, `i` and `u` whole numbers, `f` floats.
    const KINDS: &'static str;
}

impl Number for f32 {
    const DTYPE: &'static str = "float32";
    const KINDS: &'static str = "iuf";
}

impl Number for f64 {
    const DTYPE: &'static str = "float64";
    const KINDS: &'static str = "iuf";
}

impl Number for i64 {
    const DTYPE: &'static str = "int64";
    const KINDS: &'static str = "iu";
}

impl Number for bool {
    const DTYPE: &'static str = "bool";
    const KINDS: &'static str = "biu";
}

/// A caller's array that has been looked at, and not copied yet.
#[derive(Debug)]
pub(crate) struct Given<'py> {
    name: &'static str,
    array: Bound<'py, PyAny>,
    pub(crate) shape: Vec<usize>,
}

/// The array that `value` is, or that numpy makes of it. `shape` says how many values each
/// dimension has; None allows any number.
///
/// **Errors**: `TypeError` and `ValueError` for what is no array of numbers of this shape.
pub(crate) fn given<'py>(
    name: &'static str,
    value: &Bound<'py, PyAny>,
    shape: &[Option<usize>],
) -> PyResult<Given<'py>> {
    let array = value.py().import("numpy")?.call_method1("asarray", (value,))?;
    let own: Vec<usize> = array.getattr("shape")?.extract()?;
    let fits = own.len() == shape.len()
        && own.iter().zip(shape).all(|(own, wanted)| wanted.is_none_or(|wanted| wanted == *own));
    if !fits {
        let wanted = shape.iter().map(|side| side.map_or("n".into(), |side| side.to_string()));
        let wanted = wanted.collect::<Vec<_>>().join(", ");
        return Err(PyValueError::new_err(format!("{name} has the shape {own:?}, expected [{wanted}]")));
    }
    Ok(Given { name, array, shape: own })
}

impl Given<'_> {
    /// The values, row after row. A bool array takes 0 and 1 as well.
    ///
    /// **Errors**: `TypeError` for numbers of another kind, `ValueError` for numbers that the type
    /// does not hold, `MemoryError`.
    pub(crate) fn values<T: Number>(&self) -> PyResult<Vec<T>> {
        let Self { name, array, .. } = self;
        let dtype = array.getattr("dtype")?;
        let kind: char = dtype.getattr("kind")?.extract()?;
        // An empty list of Python is an array of floats.
        if !T::KINDS.contains(kind) && array.len()? > 0 {
            return Err(PyTypeError::new_err(format!("{name} has the type {dtype}, expected {}", T::DTYPE)));
        }
        let length: usize = array.getattr("size")?.extract()?;
        let mut values = Vec::new();
        values
            .try_reserve_exact(length)
            .map_err(|_| PyMemoryError::new_err(format!("{name} has {length} values, more than fit")))?;
        let converted = array.call_method1("astype", (T::DTYPE,))?;
        if T::DTYPE == "bool" && kind != 'b' || T::DTYPE == "int64" && kind == 'u' {
            let numpy = converted.py().import("numpy")?;
            if !numpy.call_method1("array_equal", (&converted, array))?.extract()? {
                return Err(PyValueError::new_err(format!(
                    "{name} has values that {} does not hold",
                    T::DTYPE
                )));
            }
        }
        let converted = converted.cast_into::<PyArrayDyn<T>>()?;
        values.extend(converted.readonly().as_array().iter());
        Ok(values)
    }
}

/// A read-only array over memory that `owner` owns; it keeps `owner` alive.
///
/// # Safety
///
/// The memory of `array` stays where it is, and unchanged, as long as `owner` lives.
pub(crate) unsafe fn view<'py, T: Element, D: Dimension>(
    owner: &Bound<'py, PyAny>,
    array: ArrayView<'_, T, D>,
) -> PyResult<Bound<'py, PyArray<T, D>>> {
    // SAFETY: the caller vouches for it.
    let view = unsafe { PyArray::borrow_from_array(&array, owner.clone()) };
    view.call_method1("setflags", (false,))?;
    Ok(view)
}
