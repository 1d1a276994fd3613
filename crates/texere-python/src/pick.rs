//! The place on a yarn that a ray hits.

use pyo3::prelude::*;
use texere::mesh::Ray;

use crate::arrays::given;

/// The first place on a yarn that a ray hits: :meth:`texere.Cloth.pick` finds it.
///
/// >>> cloth = texere.read("designs/plain.toml").placed()
/// >>> cloth.pick([[20.3, 15.7, 9], [0, 0, -1]])
/// <texere.Hit pick 24 at end 31, ecru>
#[pyclass(frozen, module = "texere")]
#[derive(Debug)]
pub(crate) struct Hit {
    pub(crate) hit: texere::Hit,
    pub(crate) name: String,
}

#[pymethods]
impl Hit {
    /// The number of the yarn, from 0.
    ///
    /// >>> cloth = texere.read("designs/plain.toml").placed()
    /// >>> hit = cloth.pick([[20.3, 15.7, 9], [0, 0, -1]])
    /// >>> assert hit is not None
    /// >>> hit.yarn
    /// 87
    #[getter]
    fn yarn(&self) -> u32 {
        self.hit.place.yarn
    }

    /// The place in the words of a weaver or a knitter, with the yarn's material. If the yarn comes
    /// from a knitting program, the line of the program follows.
    ///
    /// >>> cloth = texere.read("designs/plain.toml").placed()
    /// >>> hit = cloth.pick([[20.3, 15.7, 9], [0, 0, -1]])
    /// >>> assert hit is not None
    /// >>> hit.name
    /// 'pick 24 at end 31, ecru'
    #[getter]
    fn name(&self) -> &str {
        &self.name
    }

    /// The point that the ray hits, mm.
    ///
    /// >>> cloth = texere.read("designs/plain.toml").placed()
    /// >>> hit = cloth.pick([[20.3, 15.7, 9], [0, 0, -1]])
    /// >>> assert hit is not None
    /// >>> hit.position[2] > 0.2
    /// True
    #[getter]
    fn position(&self) -> (f64, f64, f64) {
        self.hit.position.into()
    }

    /// Distance from the ray's origin, in lengths of the ray's direction: in mm if the direction
    /// has length 1.
    ///
    /// >>> cloth = texere.read("designs/plain.toml").placed()
    /// >>> hit = cloth.pick([[20.3, 15.7, 9], [0, 0, -1]])
    /// >>> assert hit is not None
    /// >>> 8 < hit.distance < 9
    /// True
    #[getter]
    fn distance(&self) -> f64 {
        self.hit.distance
    }

    /// The control interval of the yarn that the ray hits, counted from 0, and the position along
    /// the interval, from 0 to 1.
    ///
    /// >>> hit = texere.read("designs/plain.toml").placed().pick([[20.3, 15.7, 9], [0, 0, -1]])
    /// >>> assert hit is not None
    /// >>> interval, t = hit.place
    /// >>> interval > 0, 0 <= t <= 1
    /// (True, True)
    #[getter]
    fn place(&self) -> (u32, f64) {
        (self.hit.interval, self.hit.t)
    }

    fn __repr__(&self) -> String {
        format!("<texere.Hit {}>", self.name)
    }
}

/// A ray from a caller's array of shape (2, 3): origin and direction.
pub(crate) fn ray(value: &Bound<'_, PyAny>) -> PyResult<Ray> {
    let numbers: Vec<f64> = given("ray", value, &[Some(2), Some(3)])?.values()?;
    Ok(Ray { origin: [numbers[0], numbers[1], numbers[2]], direction: [numbers[3], numbers[4], numbers[5]] })
}
