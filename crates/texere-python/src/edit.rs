//! Cloth that is edited.

use std::sync::{Arc, Mutex, TryLockError};

use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use texere::mesh::{LiveError, Topology};
use texere::yarn::YarnPlace;
use texere::{ControlPoint, Live, Settings, Structure};

use crate::change::{Change, changes};
use crate::mesh::{Mesh, settings};
use crate::pick::{Hit, ray};
use crate::watch::Run;
use crate::yarn::srgb;
use crate::yarns::{Yarns, points_of};
use crate::{device, drawdown, watch};

/// Cloth that is edited: :meth:`texere.Cloth.edit` makes it of a :class:`texere.Cloth`, which stays
/// as it is. One thread at a time may use the edited cloth.
///
/// >>> live = texere.read("designs/plain.toml").placed().edit(device="cpu")
/// >>> hit = live.pick([[20.3, 15.7, 9], [0, 0, -1]])
/// >>> assert hit is not None
/// >>> hit.name
/// 'pick 24 at end 31, ecru'
/// >>> live.set_lift(30, 23, True)
/// >>> hit = live.pick([[20.3, 15.7, 9], [0, 0, -1]])
/// >>> assert hit is not None
/// >>> hit.name
/// 'end 31 at pick 24, ecru'
#[pyclass(frozen, module = "texere", name = "Live")]
#[derive(Debug)]
pub(crate) struct Editing {
    /// The cloth, and whether the caller of `changes` knows all changes up to the last call.
    live: Mutex<(Live, bool)>,
    /// The cloth before all edits.
    cloth: Arc<texere::Cloth>,
    device: String,
}

impl Editing {
    pub(crate) fn new(py: Python<'_>, cloth: &Arc<texere::Cloth>, device: &str) -> PyResult<Self> {
        let opened = watch::quietly(py, |_| device::open(device))?;
        let live = watch::quietly(py, |_| {
            let (structure, yarns) = (&cloth.design().structure, cloth.yarns());
            let usual = settings(yarns, None, None, false);
            // No indices are read from this mesh, so the device writes none.
            let settings = Settings { topology: Topology::Shared, ..usual };
            if !matches!(structure, Structure::Woven(_)) {
                return Live::given(opened, yarns.clone(), settings);
            }
            let mut live = Live::new(opened, structure, settings)?;
            live.set_rest(yarns)?;
            Ok(live)
        })?;
        Ok(Self { live: Mutex::new((live, false)), cloth: cloth.clone(), device: device.into() })
    }

    /// Does `work` with the cloth, which no other thread may use meanwhile.
    ///
    /// **Errors**: `RuntimeError` while another thread uses it.
    fn alone<T: Send>(
        &self,
        py: Python<'_>,
        work: impl FnOnce(&mut Live) -> Result<T, LiveError> + Send,
    ) -> PyResult<T> {
        self.watched(py, |live, _, _| work(live))
    }

    /// Does `work` as [`Self::alone`] does. `work` also gets whether all changes are known, and the
    /// [`Run`] that it tells its progress to.
    fn watched<T: Send>(
        &self,
        py: Python<'_>,
        work: impl FnOnce(&mut Live, &mut bool, &Run) -> Result<T, LiveError> + Send,
    ) -> PyResult<T> {
        let mut live = match self.live.try_lock() {
            Ok(live) => live,
            Err(TryLockError::Poisoned(poisoned)) => poisoned.into_inner(),
            Err(TryLockError::WouldBlock) => {
                return Err(PyRuntimeError::new_err("another thread uses this cloth"));
            }
        };
        let (live, is_known) = &mut *live;
        watch::quietly(py, move |run| work(live, is_known, run))
    }
}

#[pymethods]
impl Editing {
    /// Puts the warp up or down where an end and a pick cross, both counted from 0. Both threads
    /// then lie as the structure places them, even if they were at rest before.
    ///
    /// >>> live = texere.read("designs/plain.toml").placed().edit(device="cpu")
    /// >>> live.set_lift(0, 0, True)
    ///
    /// Raises :class:`texere.Error` for a crossing outside the cloth, and for a knit.
    fn set_lift(&self, py: Python<'_>, end: usize, pick: usize, up: bool) -> PyResult<()> {
        self.alone(py, |live| live.set_lift(end, pick, up))
    }

    /// Gives the cloth another drawdown, an array of shape (picks, ends) as :func:`texere.weave`
    /// gives it; copied.
    ///
    /// >>> live = texere.read("designs/plain.toml").placed().edit(device="cpu")
    /// >>> live.set_drawdown(texere.weave("2/2", 64, 48))
    ///
    /// Raises :class:`texere.Error` for a knit, TypeError and ValueError for an array that is no
    /// drawdown of the cloth's size.
    fn set_drawdown(&self, py: Python<'_>, drawdown: &Bound<'_, PyAny>) -> PyResult<()> {
        let drawdown = drawdown::read(drawdown)?;
        let (ends, picks) = (drawdown.ends(), drawdown.picks());
        let own = self.cloth.design().structure.woven().map(|woven| woven.cloth().drawdown());
        if own.is_some_and(|own| (own.ends(), own.picks()) != (ends, picks)) {
            return Err(PyValueError::new_err("drawdown has not the size of the cloth's own"));
        }
        self.alone(py, |live| live.set_drawdown(0..ends, 0..picks, |end, pick| drawdown.up(end, pick)))
    }

    /// Gives a yarn other control points: ``points`` of shape (n, 3) and ``radii``, a number or an
    /// array of n or (n, 2), mm, as in :meth:`texere.Yarns.from_arrays`; copied. Without ``radii``
    /// each point keeps the thickness that it has, so their number has to stay.
    ///
    /// >>> cloth = texere.read("designs/plain.toml").placed()
    /// >>> live = cloth.edit(device="cpu")
    /// >>> first = cloth.yarns.points[: cloth.yarns.offsets[1]]
    /// >>> live.set_points(0, first + [0, 0, 1])
    /// >>> float((live.yarns().points - cloth.yarns.points).max())
    /// 1.0
    ///
    /// Raises :class:`texere.Error` for a yarn that is not there, and for points out of range.
    #[pyo3(signature = (yarn, points, radii=None))]
    fn set_points(
        &self,
        py: Python<'_>,
        yarn: usize,
        points: &Bound<'_, PyAny>,
        radii: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<()> {
        let mut points = points_of(points, radii)?;
        if radii.is_none() {
            let own = self.alone(py, |live| live.only(yarn))?;
            if own.points().len() != points.len() {
                let (given, own) = (points.len(), own.points().len());
                return Err(PyValueError::new_err(format!("points has {given}, and without radii {own}")));
            }
            let same = |(point, own): (&mut ControlPoint, &ControlPoint)| point.halves = own.halves;
            points.iter_mut().zip(own.points()).for_each(same);
        }
        self.alone(py, move |live| live.set_points(yarn, &points))
    }

    /// Gives a material another colour, ``"#rrggbb"`` or three numbers, sRGB. Materials are counted
    /// from 0, in the order of the design.
    ///
    /// >>> live = texere.read("designs/plain.toml").placed().edit(device="cpu")
    /// >>> live.set_color(0, "#ff0000")
    /// >>> live.yarns().colors[0].tolist()
    /// [255, 0, 0]
    ///
    /// Raises :class:`texere.Error` for a material that is not there.
    fn set_color(&self, py: Python<'_>, material: usize, color: &Bound<'_, PyAny>) -> PyResult<()> {
        let srgb = srgb(color)?;
        self.alone(py, |live| {
            let own = live.materials().get(material).cloned().unwrap_or_default();
            live.set_material(material, texere::yarn::Material { srgb, ..own })
        })
    }

    /// The first place on a yarn that a ray hits, or None: see :meth:`texere.Cloth.pick`. Edits
    /// count at once.
    ///
    /// >>> live = texere.read("designs/plain.toml").placed().edit(device="cpu")
    /// >>> live.pick([[-5, -5, 9], [0, 0, -1]]) is None
    /// True
    fn pick(&self, py: Python<'_>, ray: &Bound<'_, PyAny>) -> PyResult<Option<Hit>> {
        let ray = self::ray(ray)?;
        let design = self.cloth.design();
        self.alone(py, |live| {
            let Some(hit) = live.pick(&ray)? else { return Ok(None) };
            let only = live.only(hit.place.yarn as usize)?;
            let place = YarnPlace::at(&only, 0, hit.interval as usize, hit.t);
            let name = place.map(|place| design.named(&only, &place).to_string()).unwrap_or_default();
            Ok(Some(Hit { hit, name }))
        })
    }

    /// The yarns as they are now. Returns a copy.
    ///
    /// >>> len(texere.read("designs/plain.toml").placed().edit(device="cpu").yarns())
    /// 112
    fn yarns(&self, py: Python<'_>) -> PyResult<Yarns> {
        Ok(Yarns::own(self.alone(py, |live| live.yarns())?))
    }

    /// The vertices that edits have changed since the last call, yarn by yarn, for a viewer that
    /// replaces only them. The device makes only them again. They equal those of :meth:`mesh`
    /// without arguments, to the bit. Colours don't count. The call copies vertices from the
    /// device.
    ///
    /// None says that everything counts as changed: take :meth:`mesh`. The first call gives None.
    /// So does a call after a yarn has outgrown the room that is kept for it, and one after a call
    /// that failed or was stopped.
    ///
    /// >>> live = texere.read("designs/plain.toml").placed().edit(device="cpu")
    /// >>> mesh = live.mesh()
    /// >>> yarns = [mesh.positions[mesh.yarn_ids == yarn] for yarn in range(112)]
    /// >>> live.changes() is None
    /// True
    /// >>> live.set_lift(30, 23, True)
    /// >>> for change in live.changes() or []:
    /// ...     yarns[change.yarn] = np.resize(yarns[change.yarn], (change.count, 3))
    /// ...     yarns[change.yarn][change.vertices] = change.positions
    /// >>> bool((np.concatenate(yarns) == live.mesh().positions).all())
    /// True
    ///
    /// Raises :class:`texere.Error` for a device that fails.
    fn changes(&self, py: Python<'_>) -> PyResult<Option<Vec<Change>>> {
        self.watched(py, changes)
    }

    /// The mesh of the yarns as they are now, made anew: see :meth:`texere.Cloth.mesh`. Without
    /// ``sides`` and ``subdivisions`` they are those of the cloth before all edits. Copies the
    /// yarns.
    ///
    /// >>> texere.read("designs/plain.toml").placed().edit(device="cpu").mesh(sides=8)
    /// <texere.Mesh 390528 vertices, 779264 triangles>
    #[pyo3(signature = (sides=None, subdivisions=None, *, caps=false))]
    fn mesh(
        &self,
        py: Python<'_>,
        sides: Option<u32>,
        subdivisions: Option<u32>,
        caps: bool,
    ) -> PyResult<Mesh> {
        let (yarns, own) = self.alone(py, |live| Ok((live.yarns()?, *live.mesh().plan().settings())))?;
        let yarns = Yarns::own(yarns).yarns;
        let (sides, subdivisions) = (sides.unwrap_or(own.sides), subdivisions.unwrap_or(own.subdivisions));
        Mesh::make(py, &yarns, settings(&yarns, Some(sides), Some(subdivisions), caps), &self.device)
    }

    fn __repr__(&self) -> String {
        format!("<texere.Live '{}'>", self.cloth.design().name)
    }
}
