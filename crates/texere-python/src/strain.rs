//! Tests of strain: how a knit pulls when it is held at another size than its size at rest.

use numpy::ndarray::{Array1, Array2};
use numpy::{IntoPyArray, PyArray1, PyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use texere::rest::{Along, StrainState};

/// A knit at rest, and strained: see :meth:`Design.test`. The states are in the order of their
/// strains, and the state at rest is one of them.
///
/// >>> texere.read("designs/jersey.toml").test("wales", [0.05, 0.1])
/// <texere.StrainTest along wales, 3 states>
#[pyclass(frozen, module = "texere")]
#[derive(Debug)]
pub(crate) struct StrainTest {
    test: texere::rest::StrainTest,
}

impl StrainTest {
    pub(crate) const fn new(test: texere::rest::StrainTest) -> Self {
        Self { test }
    }

    /// Two numbers of each state.
    fn pairs<'py>(
        &self,
        py: Python<'py>,
        of: impl Fn(&StrainState) -> [f64; 2],
    ) -> Bound<'py, PyArray2<f64>> {
        let states = &self.test.states;
        Array2::from_shape_fn((states.len(), 2), |(state, axis)| of(&states[state])[axis]).into_pyarray(py)
    }

    /// A value of each state.
    fn each<'py, T: numpy::Element>(
        &self,
        py: Python<'py>,
        of: impl Fn(&StrainState) -> T,
    ) -> Bound<'py, PyArray1<T>> {
        self.test.states.iter().map(of).collect::<Array1<_>>().into_pyarray(py)
    }
}

/// The [`Along`] that is called `name`. `argument` is the argument that has this value.
///
/// **Errors**: `ValueError` if there is none.
pub(crate) fn along(argument: &str, name: &str) -> PyResult<Along> {
    let refused = || format!("{argument} is '{name}', expected courses, wales or both");
    Along::named(name).ok_or_else(|| PyValueError::new_err(refused()))
}

#[pymethods]
impl StrainTest {
    /// The directions in which the knit was strained: ``courses``, ``wales`` or ``both``.
    ///
    /// >>> texere.read("designs/jersey.toml").test("both", [0.1]).along
    /// 'both'
    #[getter]
    const fn along(&self) -> &'static str {
        self.test.along.name()
    }

    /// Wales per cm at rest.
    ///
    /// >>> 8 < texere.read("designs/jersey.toml").test("both", [0.1]).wales_per_cm < 16
    /// True
    #[getter]
    fn wales_per_cm(&self) -> f64 {
        10.0 / self.test.gauge.wale_mm
    }

    /// Courses per cm at rest.
    ///
    /// >>> 10 < texere.read("designs/jersey.toml").test("both", [0.1]).courses_per_cm < 25
    /// True
    #[getter]
    fn courses_per_cm(&self) -> f64 {
        10.0 / self.test.gauge.course_mm
    }

    /// The strain of each state along the courses and along the wales, as a share of the cloth's
    /// size at rest: float64 of shape (states, 2). Returns a copy.
    ///
    /// >>> texere.read("designs/jersey.toml").test("courses", [0.1]).strain[:, 0].round(6).tolist()
    /// [0.0, 0.1]
    #[getter]
    fn strain<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        self.pairs(py, |state| state.strain)
    }

    /// The force of each state along the courses and along the wales, N/mm: for each mm that the
    /// strained cloth measures across the force. float64 of shape (states, 2). Returns a copy.
    ///
    /// >>> force = texere.read("designs/jersey.toml").test("courses", [0.1]).force
    /// >>> bool(force[1, 0] > 100 * abs(force[1, 1]))
    /// True
    #[getter]
    fn force<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        self.pairs(py, |state| state.force)
    }

    /// Thickness of each state, mm: float64 of shape (states,). Returns a copy.
    ///
    /// >>> texere.read("designs/jersey.toml").test("courses", [0.1]).thickness_mm.shape
    /// (2,)
    #[getter]
    fn thickness_mm<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.each(py, |state| state.thickness_mm)
    }

    /// The energy of each state above that at rest, for each mm² of cloth at rest, N mm/mm²:
    /// float64 of shape (states,). Returns a copy.
    ///
    /// >>> energy = texere.read("designs/jersey.toml").test("courses", [0.1]).energy
    /// >>> bool(energy[0] == 0 < energy[1])
    /// True
    #[getter]
    fn energy<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.each(py, |state| self.test.stored(state))
    }

    /// Whether the forces of each state balance: bool of shape (states,). Returns a copy.
    ///
    /// >>> texere.read("designs/jersey.toml").test("courses", [0.1]).balanced.tolist()
    /// [True, True]
    #[getter]
    fn balanced<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<bool>> {
        self.each(py, |state| state.balanced)
    }

    /// The strain at which the force per width first reaches ``force``, N/mm. Between two states
    /// the force is taken to change linearly. In a test along ``both``, force and strain are those
    /// along the courses. None if no state reaches the force.
    ///
    /// >>> test = texere.read("designs/jersey.toml").test("courses", [0.1])
    /// >>> strain = test.strain_at(test.force[1, 0] / 2)
    /// >>> strain is not None and abs(strain - 0.05) < 1e-3
    /// True
    fn strain_at(&self, force: f64) -> Option<f64> {
        self.test.strain_at(force)
    }

    /// The tangent modulus at a strain, N/mm: by how much the force per width grows with the
    /// strain. None if there are fewer than three states, or if the strain lies outside of them.
    ///
    /// >>> modulus = texere.read("designs/jersey.toml").test("courses", [0.05, 0.1]).modulus_at(0)
    /// >>> modulus is not None and modulus > 0
    /// True
    #[pyo3(signature = (strain=0.0))]
    fn modulus_at(&self, strain: f64) -> Option<f64> {
        self.test.modulus_at(strain)
    }

    /// Poisson's ratio at a strain: by how much the cloth gets narrower across the strain. It needs
    /// three states. None for a test along both ways, and beyond the states.
    ///
    /// >>> poisson = texere.read("designs/jersey.toml").test("courses", [0.05, 0.1]).poisson_at(0)
    /// >>> poisson is not None and 0.2 < poisson < 1
    /// True
    #[pyo3(signature = (strain=0.0))]
    fn poisson_at(&self, strain: f64) -> Option<f64> {
        self.test.poisson_at(strain)
    }

    fn __repr__(&self) -> String {
        format!("<texere.StrainTest along {}, {} states>", self.along(), self.test.states.len())
    }
}
