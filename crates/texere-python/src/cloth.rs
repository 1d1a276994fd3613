//! Cloth: its yarns, how they came to rest, and what is made of them.

use std::sync::Arc;

use pyo3::prelude::*;
use texere::rest::RestReport;

use crate::mesh::{Mesh, settings};
use crate::yarns::{Shared, Yarns};

/// The cloth of a design: :meth:`texere.Design.rest` makes it.
///
/// >>> texere.read("designs/poplin.toml").rest(device="cpu", progress=False)
/// <texere.Cloth 'Poplin, its fine ribs across the cloth', at rest>
#[pyclass(frozen, module = "texere")]
#[derive(Debug)]
pub(crate) struct Cloth {
    pub(crate) cloth: Arc<texere::Cloth>,
    /// The name of the device on which it came to rest.
    pub(crate) device: String,
}

impl Cloth {
    pub(crate) fn new(cloth: texere::Cloth, device: String) -> Self {
        Self { cloth: Arc::new(cloth), device }
    }
}

#[pymethods]
impl Cloth {
    /// The yarns. Does not copy.
    ///
    /// >>> len(texere.read("designs/plain.toml").placed().yarns)
    /// 112
    #[getter]
    fn yarns(&self) -> Yarns {
        Yarns { yarns: Shared::Cloth(self.cloth.clone()) }
    }

    /// The tubes of the yarns, as triangles.
    ///
    /// ``sides`` is the corners of a section, ``subdivisions`` the rings between two control
    /// points: without them, what ``texere mesh`` takes for these yarns. ``caps`` closes the ends
    /// of yarns. ``device`` is a name of :func:`texere.devices`, or ``auto`` for the best one.
    /// Ctrl-C ends the call.
    ///
    /// >>> cloth = texere.read("designs/plain.toml").placed()
    /// >>> cloth.mesh(sides=8, device="cpu")
    /// <texere.Mesh 390528 vertices, 779264 triangles>
    ///
    /// Raises :class:`texere.Error` for settings out of range, and for a device that fails.
    #[pyo3(signature = (sides=None, subdivisions=None, *, caps=false, device="auto"))]
    fn mesh(
        &self,
        py: Python<'_>,
        sides: Option<u32>,
        subdivisions: Option<u32>,
        caps: bool,
        device: &str,
    ) -> PyResult<Mesh> {
        let yarns = Shared::Cloth(self.cloth.clone());
        Mesh::make(py, &yarns, settings(&yarns, sides, subdivisions, caps), device)
    }

    /// How the yarns came to rest, in words.
    ///
    /// >>> texere.read("designs/poplin.toml").placed().report
    /// 'placed as the structure says'
    #[getter]
    fn report(&self) -> String {
        self.cloth.report().to_string()
    }

    /// Whether the yarns came to rest.
    ///
    /// >>> texere.read("designs/poplin.toml").placed().is_at_rest
    /// False
    #[getter]
    fn is_at_rest(&self) -> bool {
        matches!(self.cloth.report(), RestReport::Finished(finished) if finished.is_at_rest())
    }

    /// The name of the device on which the yarns came to rest; empty for those that are placed.
    ///
    /// >>> texere.read("designs/poplin.toml").rest(device="cpu").device
    /// 'cpu'
    #[getter]
    fn device(&self) -> &str {
        &self.device
    }

    /// What a designer should know: what the finish asks for and the cloth did not reach, what the
    /// reader had to assume. Copies.
    ///
    /// >>> texere.read("designs/poplin.toml").rest(device="cpu", progress=False).warnings
    /// []
    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.cloth.warnings()
    }

    fn __repr__(&self) -> String {
        format!("<texere.Cloth '{}', {}>", self.cloth.design().name, self.cloth.report())
    }
}
