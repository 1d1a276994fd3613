//! Numpy arrays: copies of the arrays that callers give, and views of memory that a Python object
//! owns.

use numpy::ndarray::{ArrayView, Dimension};
use numpy::{Element, PyArray, PyArrayDyn, PyArrayMethods};
use pyo3::exceptions::{PyMemoryError, PyTypeError, PyValueError};
use pyo3::prelude::*;

/// A type of number to which the values of a caller's array are converted.
pub(crate) trait Number: Element + Copy {
    /// The name of the numpy type.
    const DTYPE: &'static str;
    /// The kinds of numpy types that are accepted: `b` for bool, `i` and `u` for whole numbers, `f`
    /// for floats.
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

/// A caller's array whose shape has been checked. Its values are not copied yet.
#[derive(Debug)]
pub(crate) struct Given<'py> {
    name: &'static str,
    array: Bound<'py, PyAny>,
    pub(crate) shape: Vec<usize>,
}

/// The array `value`, or the array that numpy makes of `value`. `shape` says how many values each
/// dimension must have; None allows any number. `name` is the argument's name in error messages.
///
/// **Errors**: `ValueError` for an array of another shape, and the errors of `numpy.asarray`.
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
    /// A copy of the values, row after row. If `T` is `bool`, the whole numbers 0 and 1 are
    /// accepted, too.
    ///
    /// **Errors**: `TypeError` for numbers of a kind that `T` does not accept, `ValueError` for
    /// whole numbers that `bool` or `int64` can't hold, and `MemoryError` if there is no memory for
    /// the copy.
    pub(crate) fn values<T: Number>(&self) -> PyResult<Vec<T>> {
        let Self { name, array, .. } = self;
        let dtype = array.getattr("dtype")?;
        let kind: char = dtype.getattr("kind")?.extract()?;
        // Numpy makes an array of floats from an empty list, so the type of an empty array does not
        // matter.
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

/// A read-only array over memory that `owner` owns. The array keeps `owner` alive.
///
/// # Safety
///
/// The memory of `array` stays where it is, and unchanged, as long as `owner` lives.
pub(crate) unsafe fn view<'py, T: Element, D: Dimension>(
    owner: &Bound<'py, PyAny>,
    array: ArrayView<'_, T, D>,
) -> PyResult<Bound<'py, PyArray<T, D>>> {
    // SAFETY: the caller vouches for the memory of `array`.
    let view = unsafe { PyArray::borrow_from_array(&array, owner.clone()) };
    view.call_method1("setflags", (false,))?;
    Ok(view)
}
