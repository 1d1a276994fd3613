//! Cloth: its yarns, how they came to rest, and what is made of them.

use std::path::PathBuf;
use std::sync::{Arc, OnceLock};

use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use texere::Picker;
use texere::backend::Plan;
use texere::picture::{Background, Quality};
use texere::rest::RestReport;
use texere::yarn::YarnPlace;

use crate::check::{Clearance, Diagnosis};
use crate::edit::Editing;
use crate::error::Raise;
use crate::measures::Measures;
use crate::mesh::{Compressed, Mesh, settings};
use crate::pick::Hit;
use crate::picture::{Asked, Kept, View};
use crate::shared::Shared;
use crate::yarns::Yarns;
use crate::{device, mesh, peers, pick, picture, watch, yarns};

/// The cloth of a design: :meth:`texere.Design.rest` makes it.
///
/// >>> texere.read("designs/poplin.toml").rest(device="cpu", progress=False)
/// <texere.Cloth 'Poplin, its fine ribs across the cloth', at rest>
#[pyclass(frozen, module = "texere")]
#[derive(Debug)]
pub(crate) struct Cloth {
    pub(crate) cloth: Arc<texere::Cloth>,
    /// The name of the device on which the cloth came to rest; empty for cloth that is placed.
    device: String,
    /// Finds what rays hit. It is made for the first ray.
    picker: OnceLock<Picker>,
    /// What the last picture was made of.
    scene: Kept,
}

/// Width and height of a picture in a notebook, pixels.
const SHOWN: [u32; 2] = [640, 480];

impl Cloth {
    pub(crate) fn new(cloth: texere::Cloth, device: String) -> Self {
        Self { cloth: Arc::new(cloth), device, picker: OnceLock::new(), scene: Kept::default() }
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
    /// ``sides`` is the number of corners of a section, ``subdivisions`` the number of rings
    /// between two control points. If they are left out, they are what ``texere mesh`` takes for
    /// these yarns. ``caps`` closes the ends of yarns. ``device`` is a name of
    /// :func:`texere.devices`, or ``auto`` for the best one. Ctrl-C ends the call.
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

    /// Measures of the cloth: yarn, weight, thickness, crimp, cover, loops.
    ///
    /// >>> cloth = texere.read("designs/plain.toml").placed()
    /// >>> cloth.measures.warp_crimp > 0
    /// True
    ///
    /// Raises :class:`texere.Error` if the measures can't be taken.
    #[getter]
    fn measures(&self, py: Python<'_>) -> PyResult<Measures> {
        watch::quietly(py, |_| Measures::new(&self.cloth))
    }

    /// What is wrong with the cloth, where, and what would cure it. The larger the cloth, the
    /// longer the check takes, so keep the result.
    ///
    /// >>> texere.read("designs/poplin.toml").placed().diagnosis.is_clean
    /// False
    ///
    /// Raises :class:`texere.Error` if the cloth can't be measured.
    #[getter]
    fn diagnosis(&self, py: Python<'_>) -> PyResult<Diagnosis> {
        watch::quietly(py, |run| Diagnosis::new(&self.cloth, &self.device, run))
    }

    /// How near the yarns come to one another, and how tightly they bend.
    ///
    /// >>> texere.read("designs/poplin.toml").placed().clearance().least < 0.9
    /// True
    ///
    /// Raises :class:`texere.Error` if the cloth can't be measured.
    fn clearance(&self, py: Python<'_>) -> PyResult<Clearance> {
        watch::quietly(py, |run| Clearance::new(&self.cloth, run))
    }

    /// The first place on a yarn that a ray hits, or None. ``ray`` has the shape (2, 3): its origin
    /// and its direction, mm; copied. The first call builds a tree of boxes round the yarns, which
    /// later calls search, too.
    ///
    /// >>> hit = texere.read("designs/plain.toml").placed().pick([[20.3, 15.7, 9], [0, 0, -1]])
    /// >>> assert hit is not None
    /// >>> hit.name
    /// 'pick 24 at end 31, ecru'
    ///
    /// Raises TypeError and ValueError for what is no ray.
    fn pick(&self, py: Python<'_>, ray: &Bound<'_, PyAny>) -> PyResult<Option<Hit>> {
        let ray = pick::ray(ray)?;
        let (design, yarns) = (self.cloth.design(), self.cloth.yarns());
        if self.picker.get().is_none() {
            let settings = settings(yarns, None, None, false);
            let plan = Plan::new(yarns.layout().clone(), settings).raise(py)?;
            let picker = watch::quietly(py, |_| Picker::new(Arc::new(plan), yarns.points()))?;
            let _ = self.picker.set(picker);
        }
        let Some(hit) = self.picker.get().and_then(|picker| picker.pick(&ray)) else { return Ok(None) };
        let place = YarnPlace::at(yarns, hit.place.yarn as usize, hit.interval as usize, hit.t);
        let name = place.map(|place| design.named(yarns, &place).to_string()).unwrap_or_default();
        Ok(Some(Hit { hit, name }))
    }

    /// The cloth, to be edited: lifts, control points, colours. Its mesh is kept on ``device``.
    ///
    /// >>> texere.read("designs/plain.toml").placed().edit(device="cpu")
    /// <texere.Live 'Plain weave in ecru'>
    ///
    /// Raises :class:`texere.Error` for a device that fails, or that can't edit.
    #[pyo3(signature = (*, device="auto"))]
    fn edit(&self, py: Python<'_>, device: &str) -> PyResult<Editing> {
        Editing::new(py, &self.cloth, device)
    }

    /// Writes the cloth. The ending of the path says what the file holds: ``.glb``, ``.ply``,
    /// ``.stl`` and ``.obj`` the mesh as :meth:`mesh` makes it; ``.yarns`` the yarns to the bit;
    /// ``.bcc`` and ``.usda`` the centrelines of the yarns as curves. A mesh is made and written
    /// piece by piece, in bounded memory. The file appears whole or not at all, and replaces no
    /// file of the design. ``packed`` writes a ``.glb`` with half the bytes for a vertex, as whole
    /// numbers: positions are off by at most 1/131068 of the largest side of the yarn's box.
    /// ``compressed`` packs a ``.glb`` and compresses it to about half of its bytes, for readers
    /// that know the extension ``EXT_meshopt_compression``; ``compressed="khr"`` compresses
    /// further, for those that know ``KHR_meshopt_compression``. ``instanced`` and ``attributes``
    /// are those of :meth:`Mesh.write`.
    /// ``linear`` writes a ``.usda`` of straight lines between control points, with thickness and
    /// mass, for simulators that read no other curves. ``triangles`` writes a ``.usda`` of meshes,
    /// one for each yarn, instead of curves.
    ///
    /// >>> import tempfile, pathlib
    /// >>> file = pathlib.Path(tempfile.mkdtemp()) / "plain.glb"
    /// >>> texere.read("designs/plain.toml").placed().write(file, device="cpu")
    ///
    /// Raises :class:`texere.Error` for another ending, a device that fails, and a file that can't
    /// be written, packed, compressed or instanced or can't hold the attributes; ValueError for a
    /// file that is to be several of packed, compressed, instanced and linear, for an unknown value
    /// of ``compressed``, and for an unknown attribute.
    #[pyo3(signature = (path, *, packed=false, compressed=Compressed::No, instanced=false, attributes=Vec::new(), linear=false, triangles=false, device="auto"), text_signature = "($self, path, *, packed=False, compressed=False, instanced=False, attributes=[], linear=False, triangles=False, device='auto')")]
    #[allow(clippy::too_many_arguments, reason = "each is an argument by name in Python")]
    fn write(
        &self,
        py: Python<'_>,
        path: PathBuf,
        packed: bool,
        compressed: Compressed,
        instanced: bool,
        attributes: Vec<String>,
        linear: bool,
        triangles: bool,
        device: &str,
    ) -> PyResult<()> {
        let yarns = self.cloth.yarns();
        let output = mesh::output(&path, compressed, [packed, instanced, linear])?
            .attributes(mesh::named(&attributes)?)
            .sparing(self.cloth.design().files());
        output.check().raise(py)?;
        if !yarns::is_mesh(&path, triangles)? {
            return watch::quietly(py, |_| yarns::write(yarns, output));
        }
        let device = watch::quietly(py, |_| device::open(device))?;
        let pipeline = || mesh::pipeline(yarns, settings(yarns, None, None, false));
        watch::quietly(py, |run| {
            texere::write::stream(mesh::followed(pipeline(), run), &*device, output).map(|_| ())
        })
    }

    /// A picture of the cloth: uint8 of shape (height, width, 3), sRGB, rows from the top; the
    /// array owns its memory; no copy is made of it.
    ///
    /// ``size`` is width and height, pixels. ``view`` is ``face``, ``back``, ``oblique``,
    /// ``close-up``, ``cut-warp``, ``cut-weft`` or ``eye``. ``turn`` turns the oblique view,
    /// radians. Close-ups and cuts show ``width_mm`` of the cloth round the point ``at``. For the
    /// view ``eye`` the argument ``eye`` has the eye and the point that it looks at, mm, and the
    /// direction that is up in the picture; ``field_of_view`` is the angle from the lower to the
    /// upper edge, radians. ``background`` is ``ground``, a colour, or ``nothing``: then the
    /// picture has a fourth channel, alpha. The picture is made from one that is ``supersampling``
    /// times as wide and as high, with four samples in each pixel. ``hairs`` says whether fibres
    /// that stand off yarns are drawn. ``device`` is ``auto`` or a device of ``wgpu``, such as
    /// ``wgpu:0``.
    ///
    /// With ``layers`` the call gives a dict of arrays: ``color``, which is the picture, and the
    /// layers that were asked for. In a layer each pixel has the value of one of its samples.
    ///
    /// - ``depth``: float32 of (height, width), the distance along the pixel's line of sight, mm,
    ///   from the eye, or from a plane before the cloth where lines of sight are parallel. Infinite
    ///   where there is no yarn.
    /// - ``yarn``: int32, the number of the yarn; -1 where there is none.
    /// - ``position``, ``normal``: float32 of (height, width, 3): the place on the surface, mm, and
    ///   the unit normal, in the coordinates of the cloth.
    /// - ``tangent``: the direction of the fibres along the surface, which turn with the twist.
    /// - ``uv``: float32 of (height, width, 2): the angle round the yarn, radians, and the distance
    ///   along it, modulo 8192, in rings of the picture's own mesh, in steps of an eighth.
    /// - ``crossing``: int32 of (height, width, 2), counted from 0. In woven cloth the end and the
    ///   pick that cross nearest along the yarn that the pixel shows; in a knit the wale and the
    ///   course of the stitch that the yarn makes there. The numbers are those that :meth:`pick`
    ///   names, less 1, because names count from 1. Both are -1 where there is no yarn, at a yarn's
    ///   end beyond the last crossing, in a turn of the weft, and where a yarn of a knit floats.
    ///
    /// >>> cloth = texere.read("designs/plain.toml").placed()
    /// >>> shown = cloth.picture(size=(80, 60), layers=["yarn", "depth"])
    /// >>> shown["color"].shape, shown["yarn"].shape, sorted(shown)
    /// ((60, 80, 3), (60, 80), ['color', 'depth', 'yarn'])
    ///
    /// Raises :class:`texere.Error` where there is no device for pictures, and for a view or a size
    /// that it can't do; ValueError for a view or a layer that there is not.
    #[pyo3(signature = (size=(1600, 1200), view="face", *, turn=0.0, at=None, width_mm=None, eye=None, field_of_view=0.42, background=None, supersampling=2, hairs=true, layers=None, device="auto"))]
    #[allow(clippy::too_many_arguments, reason = "each is an argument by name in Python")]
    fn picture<'py>(
        &self,
        py: Python<'py>,
        size: (u32, u32),
        view: &str,
        turn: f32,
        at: Option<(f32, f32)>,
        width_mm: Option<f32>,
        eye: Option<([f32; 3], [f32; 3], [f32; 3])>,
        field_of_view: f32,
        background: Option<&Bound<'py, PyAny>>,
        supersampling: u32,
        hairs: bool,
        layers: Option<Vec<String>>,
        device: &str,
    ) -> PyResult<Bound<'py, PyAny>> {
        let quality = Quality { supersampling, hairs };
        let background = background.map_or(Ok(Background::Ground), picture::background)?;
        let view = View::new(view, turn, at.zip(width_mm), eye, field_of_view)?;
        let asked = Asked { size: size.into(), view, background, quality };
        picture::picture(py, &self.cloth, &self.scene, &asked, device, layers)
    }

    /// Shows the mesh of the cloth in a window of pyvista, or in a notebook:
    /// :meth:`texere.Mesh.show` of :meth:`mesh`.
    ///
    /// >>> texere.read("designs/plain.toml").placed().show() # doctest: +SKIP
    ///
    /// Raises ImportError unless pyvista is installed.
    #[pyo3(signature = (**options))]
    fn show<'py>(
        &self,
        py: Python<'py>,
        options: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let mesh = Bound::new(py, self.mesh(py, None, None, false, "auto")?)?;
        peers::show(mesh.as_any(), options)
    }

    /// A picture for notebooks. None where there is no device for pictures.
    fn _repr_png_<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyBytes>>> {
        if !picture::has_device(py) {
            return Ok(None);
        }
        let quality = Quality { supersampling: 2, hairs: true };
        let asked = Asked { size: SHOWN, view: View::Face, background: Background::Ground, quality };
        let png = picture::png(py, self.cloth.yarns(), &self.scene, &asked)?;
        Ok(Some(PyBytes::new(py, &png)))
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
    /// reader had to assume. Returns a copy.
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
