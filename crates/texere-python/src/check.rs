//! How near yarns come to one another, what is wrong with a cloth, and what would cure it.

use pyo3::prelude::*;
use texere::Settings;
use texere::check::{CheckReport, ClothClearance, SettlingReport};
use texere::read::Refusal;
use texere::rest::FinishError;

use crate::error::Raise;
use crate::watch::Run;

/// Two yarns that come near one another.
///
/// >>> clearance = texere.read("designs/poplin.toml").placed().clearance()
/// >>> clearance.worst[0].ratio < 0.9
/// True
#[pyclass(frozen, module = "texere")]
#[derive(Debug)]
pub(crate) struct Contact {
    /// How near the two yarns come: 1 where they just touch, less where they pierce.
    ///
    /// >>> texere.read("designs/poplin.toml").placed().clearance().worst[0].ratio > 0.5
    /// True
    #[pyo3(get)]
    ratio: f64,
    /// The point half way between the two centrelines, mm.
    ///
    /// >>> len(texere.read("designs/poplin.toml").placed().clearance().worst[0].position)
    /// 3
    #[pyo3(get)]
    position: (f64, f64, f64),
    /// The places on both yarns, in a weaver's or a knitter's words.
    ///
    /// >>> len(texere.read("designs/poplin.toml").placed().clearance().worst[0].places)
    /// 2
    #[pyo3(get)]
    places: (String, String),
}

#[pymethods]
impl Contact {
    fn __repr__(&self) -> String {
        format!("<texere.Contact {:.4} of touching: {} and {}>", self.ratio, self.places.0, self.places.1)
    }
}

/// How near the yarns of a cloth come to one another, and how tightly they bend.
///
/// >>> texere.read("designs/poplin.toml").rest(device="cpu").clearance().least > 0.98
/// True
#[pyclass(frozen, module = "texere")]
#[derive(Debug)]
pub(crate) struct Clearance {
    clearance: ClothClearance,
}

impl Clearance {
    /// Measures the clearance of the cloth's yarns, as they are drawn with the settings that suit
    /// them.
    pub(crate) fn new(cloth: &texere::Cloth, run: &Run) -> Result<Self, Refusal> {
        let settings = Settings::of(cloth.yarns());
        Ok(Self { clearance: cloth.clearance(&settings, |share| run.tell(share))? })
    }
}

#[pymethods]
impl Clearance {
    /// How near yarns come at the least: 1 where they just touch. Infinite if no yarns come near
    /// one another, and NaN if all places where they do are too crowded to be measured.
    ///
    /// >>> texere.read("designs/poplin.toml").placed().clearance().least < 0.9
    /// True
    #[getter]
    fn least(&self) -> f64 {
        self.clearance.least()
    }

    /// How many places there are where two yarns come near one another.
    ///
    /// >>> texere.read("designs/poplin.toml").placed().clearance().contacts > 1000
    /// True
    #[getter]
    fn contacts(&self) -> u64 {
        self.clearance.contacts
    }

    /// How many of the contacts have a ratio below 1 by more than 0.001.
    ///
    /// >>> texere.read("designs/poplin.toml").placed().clearance().below_one > 0
    /// True
    #[getter]
    fn below_one(&self) -> u64 {
        self.clearance.below_one
    }

    /// The radius of the tightest bend in radii of its yarn; infinite where all yarns are straight.
    ///
    /// >>> texere.read("designs/poplin.toml").placed().clearance().bend > 0
    /// True
    #[getter]
    fn bend(&self) -> f64 {
        self.clearance.bend.radii
    }

    /// The nearest contacts, the worst first: 100 at most. Returns a copy.
    ///
    /// >>> worst = texere.read("designs/poplin.toml").placed().clearance().worst
    /// >>> worst[0].ratio <= worst[-1].ratio
    /// True
    #[getter]
    fn worst(&self) -> Vec<Contact> {
        let contact = |contact: &texere::check::ThreadContact| Contact {
            ratio: contact.ratio,
            position: contact.middle_mm().into(),
            places: contact.places.each_ref().map(ToString::to_string).into(),
        };
        self.clearance.worst.iter().map(contact).collect()
    }

    fn __repr__(&self) -> String {
        format!("<texere.Clearance {:.4} at the least, {} contacts>", self.least(), self.contacts())
    }
}

/// What is wrong with a cloth, and which single changes of its design would cure it.
///
/// >>> texere.read("designs/poplin.toml").rest(device="cpu").diagnosis
/// <texere.Diagnosis clean>
#[pyclass(frozen, module = "texere")]
#[derive(Debug)]
pub(crate) struct Diagnosis {
    report: CheckReport,
}

/// The share by which a clearance may be below 1 before yarns count as piercing: the usual one of
/// `texere check`.
const ACCURACY: f64 = 0.015;

/// The share of the progress that measuring takes. The rest of it is for finding cures.
const MEASURED: f64 = 0.5;

impl Diagnosis {
    /// Checks a cloth that came to rest on `device`.
    pub(crate) fn new(cloth: &texere::Cloth, device: &str, run: &Run) -> Result<Self, Refusal> {
        let settings = Settings::of(cloth.yarns());
        let clearance = cloth.clearance(&settings, |share| run.tell(MEASURED * share))?;
        let settling = SettlingReport::new(cloth, device);
        let mut report = CheckReport::new(cloth, settling, ACCURACY, &settings, clearance);
        if report.verdict().is_some() {
            // If the run is stopped, its exception is raised, and the cures found so far are lost.
            let device = texere::open("cpu").map_err(FinishError::from)?;
            report.find_cures(cloth, &*device, |share| run.tell(MEASURED + (1.0 - MEASURED) * share))?;
        }
        Ok(Self { report })
    }
}

#[pymethods]
impl Diagnosis {
    /// Whether there is no fault.
    ///
    /// >>> texere.read("designs/poplin.toml").placed().diagnosis.is_clean
    /// False
    #[getter]
    fn is_clean(&self) -> bool {
        self.report.verdict().is_none()
    }

    /// ``clean``, or the faults in one phrase.
    ///
    /// >>> texere.read("designs/poplin.toml").placed().diagnosis.verdict
    /// 'pierces itself, folds, jams, is inside out'
    #[getter]
    fn verdict(&self) -> &str {
        self.report.verdict().unwrap_or("clean")
    }

    /// What ``texere check`` prints: faults with their places, and cures, as pairs of a label and
    /// what is said of it. Returns a copy.
    ///
    /// >>> lines = texere.read("designs/poplin.toml").placed().diagnosis.lines
    /// >>> lines[0][0]
    /// 'clearance'
    #[getter]
    fn lines(&self) -> Vec<(&'static str, String)> {
        self.report.lines()
    }

    /// The whole diagnosis by name, as ``texere check --json`` prints it; docs/INSPECT.md says what
    /// each entry is. Returns a copy.
    ///
    /// >>> texere.read("designs/poplin.toml").placed().diagnosis.as_dict()["clean"]
    /// False
    fn as_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let text = serde_json::to_string(&self.report).raise(py)?;
        py.import("json")?.call_method1("loads", (text,))
    }

    fn __repr__(&self) -> String {
        format!("<texere.Diagnosis {}>", self.verdict())
    }
}
