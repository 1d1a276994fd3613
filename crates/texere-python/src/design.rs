//! Designs: read, finished, written, and taken to their cloth.

use std::path::PathBuf;
use std::sync::Arc;

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use texere::Backend;
use texere::read::Refusal;
use texere::rest::{Finish, FinishError, Length, RestBy, stand_in};
use texere::woven::{BySet, Set, Stretch};

use crate::arrays::given;
use crate::cloth::Cloth;
use crate::device;
use crate::progress::Shown;
use crate::strain::{self, StrainTest};
use crate::watch::{self, Run};

/// A design: its structure, its yarns, and how its cloth is finished. :func:`texere.read`,
/// :func:`texere.woven`, :func:`texere.weft_knit` and :func:`texere.warp_knit` make one.
///
/// >>> texere.read("designs/herringbone.wif")
/// <texere.Design 'Striped herringbone', woven, 192.0 x 192.0 mm>
#[pyclass(frozen, module = "texere")]
#[derive(Debug)]
pub(crate) struct Design {
    pub(crate) design: Arc<texere::Design>,
}

/// Reads a design: a draft of WIF (``.wif``), Fiberworks (``.dtx``) or WeavePoint (``.wpo``),
/// texere's own design file (``.toml``) or a program of a knitting machine (``.k``, ``.knitout``).
///
/// >>> texere.read("designs/locknit.toml").kind
/// 'warp-knitted'
///
/// Raises :class:`texere.Error`, with file, line and column, for a file that is no design.
#[pyfunction]
pub(crate) fn read(py: Python<'_>, path: PathBuf) -> PyResult<Design> {
    let design = watch::quietly(py, |_| texere::read(path))?;
    Ok(Design::of(design))
}

impl Design {
    pub(crate) fn of(design: texere::Design) -> Self {
        Self { design: Arc::new(design) }
    }
}

/// The strains of a test that names none: those of ``texere test``.
const STRAINS: [f64; 8] = [0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4];

/// The word for a structure.
fn kind(design: &texere::Design) -> &'static str {
    let structure = &design.structure;
    if structure.woven().is_some() {
        "woven"
    } else if structure.knitted().is_some() {
        "weft-knitted"
    } else {
        "warp-knitted"
    }
}

#[pymethods]
impl Design {
    /// The title of the design, or else the name of its file.
    ///
    /// >>> texere.read("designs/herringbone.wif").name
    /// 'Striped herringbone'
    #[getter]
    fn name(&self) -> &str {
        &self.design.name
    }

    /// ``woven``, ``weft-knitted`` or ``warp-knitted``.
    ///
    /// >>> texere.read("designs/herringbone.wif").kind
    /// 'woven'
    #[getter]
    fn kind(&self) -> &'static str {
        kind(&self.design)
    }

    /// Width and height of the cloth as it is placed, mm.
    ///
    /// >>> texere.read("designs/herringbone.wif").size_mm
    /// (192.0, 192.0)
    #[getter]
    fn size_mm(&self) -> (f64, f64) {
        self.design.structure.size_mm().into()
    }

    /// Whether :meth:`rest` lets the yarns come to rest. A WIF draft says False: it has no finish.
    ///
    /// >>> texere.read("designs/herringbone.wif").settle
    /// False
    #[getter]
    fn settle(&self) -> bool {
        self.design.settle
    }

    /// The files that the design was read from: its own, and those that it names.
    ///
    /// >>> [path.name for path in texere.read("designs/herringbone.wif").files]
    /// ['herringbone.wif']
    #[getter]
    fn files(&self) -> Vec<PathBuf> {
        self.design.files().to_vec()
    }

    /// Warnings: what the reader of the file had to assume, and faults of the structure as it is
    /// placed. Returns a copy.
    ///
    /// >>> texere.read("designs/herringbone.wif").warnings
    /// []
    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.design.warnings()
    }

    /// The design with another finish; what is None stays as it is.
    ///
    /// ``settle`` lets yarns come to rest. For woven cloth: ``warp_tension`` and ``weft_tension``,
    /// 0 to 10, 1 in relaxed cloth; ``calender``, 0 to 10, how strongly the cloth is pressed flat;
    /// ``stretch``, ``("warp", 1.1)`` to make the cloth 1.1 times as long along its warp, 0.5 to 2.
    /// For knits: ``press_mm``, the distance of two plates, 0.001 to 1000 mm; ``loop_length``, 0.5
    /// to 2 times the length of yarn that is placed; ``rest``, ``"clear"`` or ``"energy"``. With
    /// ``"clear"`` yarns move until none pierces another, in at most ``passes`` passes, 1 to
    /// 1000000, of each of the two forms of settling. With ``"energy"`` yarns move until bending
    /// and contact have the least energy, which gives the knit its gauge. A knit that is pressed,
    /// or whose lengths are free, can't rest by its energy. ``hold`` is the way along which a knit
    /// that rests by its energy keeps the size of its gauge: ``"courses"``, ``"wales"`` or
    /// ``"both"``. With ``rest="clear"`` nothing holds it any longer.
    ///
    /// >>> texere.read("designs/herringbone.wif").finished(settle=True).settle
    /// True
    ///
    /// Raises ValueError for a value out of its range, and for an argument that this kind of
    /// structure does not have.
    #[pyo3(signature = (*, settle=None, warp_tension=None, weft_tension=None, calender=None, stretch=None, press_mm=None, loop_length=None, passes=None, rest=None, hold=None))]
    #[allow(clippy::too_many_arguments, reason = "each is an argument by name in Python")]
    fn finished(
        &self,
        settle: Option<bool>,
        warp_tension: Option<f32>,
        weft_tension: Option<f32>,
        calender: Option<f32>,
        stretch: Option<(String, f64)>,
        press_mm: Option<f32>,
        loop_length: Option<f32>,
        passes: Option<u32>,
        rest: Option<String>,
        hold: Option<String>,
    ) -> PyResult<Self> {
        let mut design = (*self.design).clone();
        let is_woven = design.structure.woven().is_some();
        let words = rest.as_ref().or(hold.as_ref());
        if is_woven && (press_mm.or(loop_length).is_some() || passes.is_some() || words.is_some()) {
            let message = "press_mm, loop_length, passes, rest and hold are those of a knit";
            return Err(PyValueError::new_err(message));
        }
        let taut = warp_tension.or(weft_tension).or(calender);
        if !is_woven && (stretch.is_some() || taut.is_some()) {
            return Err(PyValueError::new_err("tensions, calender and stretch are those of woven cloth"));
        }
        let finish = design.finish;
        let times = |name, value: Option<f32>, usual| within(name, value, [0.0, 10.0], usual);
        design.finish = Finish {
            taut: BySet {
                warp: times("warp_tension", warp_tension, finish.taut.warp)?,
                weft: times("weft_tension", weft_tension, finish.taut.weft)?,
            },
            calender: times("calender", calender, finish.calender)?,
            press_mm: match press_mm {
                Some(given) => Some(within("press_mm", Some(given), [0.001, 1000.0], given)?),
                None => finish.press_mm,
            },
            length: match loop_length {
                Some(given) => Some(Length::Given(within("loop_length", Some(given), [0.5, 2.0], given)?)),
                None => finish.length,
            },
            passes: within("passes", passes, [1, 1_000_000], finish.passes)?,
            by: match rest.as_deref() {
                None => finish.by,
                Some("clear") => RestBy::Contact,
                Some("energy") => RestBy::Energy,
                Some(_) => return Err(PyValueError::new_err("rest is neither 'clear' nor 'energy'")),
            },
            ..finish
        };
        let is_free = matches!(design.finish.length, Some(Length::Free { .. }));
        if design.finish.by == RestBy::Energy && (design.finish.press_mm.is_some() || is_free) {
            return Err(PyValueError::new_err("rest by energy knows no press and no free lengths"));
        }
        let by_energy = design.finish.by == RestBy::Energy;
        if hold.is_some() && !by_energy {
            return Err(PyValueError::new_err("only a knit that rests by its energy can be held"));
        }
        let held = hold.as_deref().map(|name| strain::along("hold", name)).transpose()?;
        design.finish.hold = held.or(finish.hold).filter(|_| by_energy);
        if let Some((along, by)) = stretch {
            let along = match along.as_str() {
                "warp" => Set::Warp,
                "weft" => Set::Weft,
                _ => return Err(PyValueError::new_err("stretch[0] is neither 'warp' nor 'weft'")),
            };
            design.stretch = Some(Stretch { along, by: within("stretch[1]", Some(by), [0.5, 2.0], by)? });
        }
        design.settle = settle.unwrap_or(design.settle);
        Ok(Self::of(design))
    }

    /// The cloth: its yarns are placed, and come to rest where :attr:`settle` says so.
    ///
    /// ``device`` is a name of :func:`texere.devices`, or ``auto`` for the best one. ``progress``
    /// is True for a bar if tqdm is installed, False for none, or a function of the share that is
    /// done, from 0 to 1. Other threads of Python go on meanwhile. Ctrl-C ends the call.
    ///
    /// >>> cloth = texere.read("designs/poplin.toml").rest(device="cpu", progress=False)
    /// >>> cloth.is_at_rest, cloth.report
    /// (True, 'at rest')
    ///
    /// Raises :class:`texere.Error` for cloth that can't be made, and for a device that fails.
    /// Yarns that don't come to rest are no error: ``report`` of the cloth says so.
    #[pyo3(signature = (device="auto", progress=None))]
    fn rest(&self, py: Python<'_>, device: &str, progress: Option<Bound<'_, PyAny>>) -> PyResult<Cloth> {
        let design = self.design.clone();
        let (cloth, device) =
            on_device(py, (design.finish.by, device), ("rest", progress), |device, run| {
                let rest = (*design).clone().rest(device).progress(|share| run.tell(share)).run();
                rest.map(|cloth| (cloth, device.info().name.clone()))
            })?;
        Ok(Cloth::new(cloth, device))
    }

    /// Lets a knit come to rest by its energy, then holds it at each of ``strains`` and measures
    /// how it pulls. ``along`` is ``courses`` (the knit gets wider, and its height is free),
    /// ``wales`` (the knit gets longer, and its width is free) or ``both``. ``strains`` are shares
    /// of the size at rest, -0.5 to 5, each greater than the one before. At rest nothing holds the
    /// knit, whatever the design's ``hold`` says. Forces grow in proportion to the bending
    /// stiffness of the yarns.
    ///
    /// ``device`` and ``progress`` are those of :meth:`rest`. The CPU does the work if ``device``
    /// can't.
    ///
    /// >>> test = texere.read("designs/rib.toml").test("courses", [0.1, 0.2, 0.3])
    /// >>> bool((test.force[1:, 0] > test.force[:-1, 0]).all())
    /// True
    ///
    /// Raises ValueError for another ``along``, and :class:`texere.Error` for a design that is no
    /// knit that repeats, for strains that don't rise, and if yarns pass through one another.
    #[pyo3(signature = (along="courses", strains=None, device="auto", progress=None))]
    fn test(
        &self,
        py: Python<'_>,
        along: &str,
        strains: Option<&Bound<'_, PyAny>>,
        device: &str,
        progress: Option<Bound<'_, PyAny>>,
    ) -> PyResult<StrainTest> {
        let along = strain::along("along", along)?;
        let strains = match strains {
            Some(strains) => given("strains", strains, &[None])?.values()?,
            None => STRAINS.to_vec(),
        };
        let design = self.design.clone();
        let test = on_device(py, (RestBy::Energy, device), ("test", progress), |device, run| {
            design.strain_test(along, &strains, device, |share| run.tell(share))
        })?;
        Ok(StrainTest::new(test))
    }

    /// The cloth with its yarns where the structure places them, whatever :attr:`settle` says.
    ///
    /// >>> texere.read("designs/poplin.toml").placed().report
    /// 'placed as the structure says'
    ///
    /// Raises :class:`texere.Error` for cloth that can't be made.
    fn placed(&self, py: Python<'_>) -> PyResult<Cloth> {
        let design = self.design.clone();
        Ok(Cloth::new(watch::quietly(py, |_| (*design).clone().placed(0.0))?, String::new()))
    }

    /// Writes the design as a ``.toml`` design file, which holds woven cloth, knits that were read
    /// from charts and pictures, and warp knits; as a ``.wif`` draft, which holds woven cloth; or
    /// as a ``.k`` or ``.knitout`` file, which holds knits that were read from one. The file
    /// appears whole or not at all. Returns what the format leaves out, key by key.
    ///
    /// >>> import tempfile, pathlib
    /// >>> folder = pathlib.Path(tempfile.mkdtemp())
    /// >>> texere.read("designs/plain.toml").write(folder / "plain.toml")
    /// []
    ///
    /// Raises :class:`texere.Error` for a design that the format can't hold, and for a file that
    /// can't be written.
    fn write(&self, py: Python<'_>, path: PathBuf) -> PyResult<Vec<String>> {
        let design = self.design.clone();
        let ending = path.extension().map(|ending| ending.to_ascii_lowercase());
        watch::quietly(py, |_| match ending.as_ref().and_then(|ending| ending.to_str()) {
            Some("wif") => texere::write::wif(&design, path),
            Some("k" | "knitout") => texere::write::knitout(&design, path),
            _ => texere::write::toml(&design, path),
        })
    }

    fn __repr__(&self) -> String {
        let [width, height] = self.design.structure.size_mm();
        format!("<texere.Design '{}', {}, {width:.1} x {height:.1} mm>", self.design.name, self.kind())
    }
}

/// Does `work` on the device that is called `name`, or on the CPU if that device can't let yarns
/// come to rest as `by` says. The progress of `work` is shown after the text `what`.
fn on_device<T: Send>(
    py: Python<'_>,
    (by, name): (RestBy, &str),
    (what, progress): (&'static str, Option<Bound<'_, PyAny>>),
    work: impl FnOnce(&dyn Backend, &Run) -> Result<T, Refusal> + Send,
) -> PyResult<T> {
    let mut shown = match progress {
        Some(progress) => Shown::asked(&progress, what)?,
        None => Shown::Waiting(what),
    };
    let device = watch::quietly(py, |_| device::open(name))?;
    let done = watch::work(
        py,
        |py, share| shown.show(py, share),
        |run| {
            let cpu = stand_in(by, &*device).map_err(FinishError::from)?;
            work(cpu.as_deref().unwrap_or(&*device), run)
        },
    );
    shown.close(py)?;
    done
}

/// The value that is given, or else the usual one.
///
/// **Errors**: `ValueError` for a given one out of its range.
fn within<T: PartialOrd + Copy + std::fmt::Display>(
    name: &str,
    given: Option<T>,
    [low, high]: [T; 2],
    usual: T,
) -> PyResult<T> {
    match given {
        None => Ok(usual),
        Some(given) if low <= given && given <= high => Ok(given),
        Some(given) => Err(PyValueError::new_err(format!("{name} is {given}, expected {low} to {high}"))),
    }
}
