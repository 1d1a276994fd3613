//! Measures of a cloth.

use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Measures of a cloth. A measure that the cloth does not have, or that is not known, is NaN.
/// Numbers of loops, wales and courses are 0 instead.
///
/// >>> measures = texere.read("designs/plain.toml").placed().measures
/// >>> round(measures.width_mm, 1), measures.loops
/// (42.7, 0)
#[pyclass(frozen, module = "texere")]
#[derive(Debug)]
pub(crate) struct Measures {
    measures: texere::check::Measures,
    size_mm: [f64; 2],
}

impl Measures {
    pub(crate) fn new(cloth: &texere::Cloth) -> Result<Self, texere::read::Refusal> {
        let design = cloth.design();
        let measures = design.structure.measures(cloth.yarns()).map_err(|error| design.refused(error))?;
        Ok(Self { measures, size_mm: design.structure.size_mm() })
    }
}

/// A measure, or NaN.
fn known(value: Option<f64>) -> f64 {
    value.unwrap_or(f64::NAN)
}

/// The names of all measures, in the order in which they are shown.
const NAMES: [&str; 18] = [
    "width_mm",
    "height_mm",
    "thickness_mm",
    "length_mm",
    "areal_weight",
    "warp_crimp",
    "weft_crimp",
    "warp_cover",
    "weft_cover",
    "cover",
    "warp_cover_factor",
    "weft_cover_factor",
    "cover_factor",
    "wales",
    "courses",
    "loops",
    "loop_length_mm",
    "tightness",
];

#[pymethods]
impl Measures {
    /// Width of the cloth, mm.
    ///
    /// >>> round(texere.read("designs/plain.toml").placed().measures.width_mm, 2)
    /// 42.67
    #[getter]
    fn width_mm(&self) -> f64 {
        self.size_mm[0]
    }

    /// Height of the cloth, mm.
    ///
    /// >>> texere.read("designs/plain.toml").placed().measures.height_mm > 31
    /// True
    #[getter]
    fn height_mm(&self) -> f64 {
        self.size_mm[1]
    }

    /// Thickness without load, mm.
    ///
    /// >>> texere.read("designs/plain.toml").placed().measures.thickness_mm > 0.3
    /// True
    #[getter]
    fn thickness_mm(&self) -> f64 {
        self.measures.thickness_mm
    }

    /// Length of yarn of each material, mm. Returns a copy.
    ///
    /// >>> len(texere.read("designs/plain.toml").placed().measures.length_mm)
    /// 1
    #[getter]
    fn length_mm(&self) -> Vec<f64> {
        self.measures.length_mm.clone()
    }

    /// Weight, g/m². NaN unless every material that is used has a tex.
    ///
    /// >>> 50 < texere.read("designs/plain.toml").placed().measures.areal_weight < 500
    /// True
    #[getter]
    fn areal_weight(&self) -> f64 {
        known(self.measures.areal_weight)
    }

    /// Crimp of the warp: length of yarn over length of cloth, less 1. NaN of a knit.
    ///
    /// >>> texere.read("designs/plain.toml").placed().measures.warp_crimp > 0
    /// True
    #[getter]
    fn warp_crimp(&self) -> f64 {
        known(self.measures.crimp.map(|crimp| crimp.warp))
    }

    /// Crimp of the weft. NaN of a knit.
    ///
    /// >>> texere.read("designs/locknit.toml").placed().measures.weft_crimp
    /// nan
    #[getter]
    fn weft_crimp(&self) -> f64 {
        known(self.measures.crimp.map(|crimp| crimp.weft))
    }

    /// The share of the cloth's width that ends cover, 0 to 1. NaN of a knit.
    ///
    /// >>> 0 < texere.read("designs/plain.toml").placed().measures.warp_cover < 1
    /// True
    #[getter]
    fn warp_cover(&self) -> f64 {
        known(self.measures.cover.map(|cover| cover.fraction.warp))
    }

    /// The share of the cloth's length that picks cover, 0 to 1. NaN of a knit.
    ///
    /// >>> 0 < texere.read("designs/plain.toml").placed().measures.weft_cover < 1
    /// True
    #[getter]
    fn weft_cover(&self) -> f64 {
        known(self.measures.cover.map(|cover| cover.fraction.weft))
    }

    /// The share of the cloth that is covered, 0 to 1. NaN of a knit.
    ///
    /// >>> measures = texere.read("designs/plain.toml").placed().measures
    /// >>> measures.cover > measures.warp_cover
    /// True
    #[getter]
    fn cover(&self) -> f64 {
        known(self.measures.cover.map(|cover| cover.cloth))
    }

    /// Peirce's cover factor of the warp: ends to the inch over the root of the cotton count. NaN
    /// of a knit, and unless every material that is used has a tex.
    ///
    /// >>> texere.read("designs/plain.toml").placed().measures.warp_cover_factor > 0
    /// True
    #[getter]
    fn warp_cover_factor(&self) -> f64 {
        known(self.measures.cover.and_then(|cover| cover.factor).map(|factor| factor.warp))
    }

    /// Peirce's cover factor of the weft.
    ///
    /// >>> texere.read("designs/plain.toml").placed().measures.weft_cover_factor > 0
    /// True
    #[getter]
    fn weft_cover_factor(&self) -> f64 {
        known(self.measures.cover.and_then(|cover| cover.factor).map(|factor| factor.weft))
    }

    /// Peirce's cover factor of the cloth.
    ///
    /// >>> texere.read("designs/plain.toml").placed().measures.cover_factor > 0
    /// True
    #[getter]
    fn cover_factor(&self) -> f64 {
        known(self.measures.cover.and_then(|cover| cover.cloth_factor))
    }

    /// Wales of a knit. 0 of woven cloth.
    ///
    /// >>> texere.read("designs/locknit.toml").placed().measures.wales
    /// 18
    #[getter]
    fn wales(&self) -> u32 {
        self.measures.knit.map_or(0, |knit| knit.size[0])
    }

    /// Courses of a knit. 0 of woven cloth.
    ///
    /// >>> texere.read("designs/locknit.toml").placed().measures.courses
    /// 24
    #[getter]
    fn courses(&self) -> u32 {
        self.measures.knit.map_or(0, |knit| knit.size[1])
    }

    /// Loops of a knit. 0 of woven cloth.
    ///
    /// >>> texere.read("designs/locknit.toml").placed().measures.loops > 400
    /// True
    #[getter]
    fn loops(&self) -> u64 {
        self.measures.knit.map_or(0, |knit| knit.loops)
    }

    /// Length of yarn in a loop, mm. NaN of woven cloth.
    ///
    /// >>> texere.read("designs/jersey.toml").placed().measures.loop_length_mm > 1
    /// True
    #[getter]
    fn loop_length_mm(&self) -> f64 {
        known(self.measures.knit.map(|knit| knit.loop_length_mm))
    }

    /// The root of tex over the loop length in cm. NaN of woven cloth, and unless all yarns that
    /// are used have one and the same tex.
    ///
    /// >>> texere.read("designs/plain.toml").placed().measures.tightness
    /// nan
    #[getter]
    fn tightness(&self) -> f64 {
        known(self.measures.knit.and_then(|knit| knit.tightness))
    }

    /// All measures that the cloth has, by their names. Returns a copy.
    ///
    /// >>> "warp_crimp" in texere.read("designs/plain.toml").placed().measures.as_dict()
    /// True
    fn as_dict<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyDict>> {
        let all = PyDict::new(slf.py());
        for name in NAMES {
            let value = slf.getattr(name)?;
            let is_known = match value.extract::<u64>() {
                Ok(count) => count > 0,
                Err(_) => value.extract::<f64>().map_or(true, f64::is_finite),
            };
            if is_known {
                all.set_item(name, value)?;
            }
        }
        Ok(all)
    }

    /// A table for notebooks.
    fn _repr_html_(slf: &Bound<'_, Self>) -> PyResult<String> {
        let mut rows = String::new();
        for (name, value) in Self::as_dict(slf)? {
            let value = match value.extract::<f64>() {
                Ok(number) => format!("{number:.6}").trim_end_matches('0').trim_end_matches('.').to_owned(),
                Err(_) => value.repr()?.to_string(),
            };
            rows += &format!("<tr><th>{name}</th><td>{value}</td></tr>");
        }
        Ok(format!("<table>{rows}</table>"))
    }

    fn __repr__(slf: &Bound<'_, Self>) -> PyResult<String> {
        Ok(format!("<texere.Measures {}>", Self::as_dict(slf)?.repr()?))
    }
}
