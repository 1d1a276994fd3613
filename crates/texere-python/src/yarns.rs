//! Yarns with their control points, of cloth or of the caller's own arrays.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use bytemuck::cast_slice;
use numpy::ndarray::{Array2, ArrayView1, ArrayView2, s};
use numpy::{IntoPyArray, PyArray1, PyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use texere::read::CurveScale;
use texere::write::{CurveFormat, Format, Output};
use texere::yarn::{Layout, Material, Section};
use texere::{ControlPoint, WriteError};

use crate::arrays::{given, view};
use crate::error::{Error, Raise};
use crate::mesh::{Mesh, settings};
use crate::shared::Shared;
use crate::{mesh, watch};

/// Yarns: control points of centrelines, with their thickness.
///
/// >>> yarns = texere.read("designs/plain.toml").placed().yarns
/// >>> len(yarns), yarns.points.shape[1], len(yarns.offsets)
/// (112, 3, 113)
#[pyclass(frozen, module = "texere")]
#[derive(Debug)]
pub(crate) struct Yarns {
    pub(crate) yarns: Shared,
}

/// Reads yarns that :meth:`texere.Yarns.write` or ``texere mesh -o cloth.yarns`` has saved, to the
/// bit.
///
/// >>> import tempfile, pathlib
/// >>> file = pathlib.Path(tempfile.mkdtemp()) / "one.yarns"
/// >>> texere.Yarns.from_arrays([[0, 0, 0], [1, 0, 0]], 0.1).write(file)
/// >>> len(texere.read_yarns(file))
/// 1
///
/// Raises :class:`texere.Error` for a file that holds no yarns. The error's ``file`` is the path.
#[pyfunction]
pub(crate) fn read_yarns(py: Python<'_>, path: PathBuf) -> PyResult<Yarns> {
    Ok(Yarns::own(watch::quietly(py, |_| texere::read::yarns(path))?.yarns))
}

/// Reads curves that another program wrote. The file is a BCC file (``.bcc``), an OBJ file with
/// polylines (``.obj``), the text form of USD (``.usda``) or a file of TexGen (``.tg3``). Yarns of
/// TexGen have their sections. All other curves become round yarns.
///
/// ``unit_mm`` is the length of the file's unit, ``diameter_mm`` the diameter of all yarns. If they
/// are left out, files of TexGen and USD say their unit and widths. Other files have a unit of 1 mm
/// and need ``diameter_mm``. An argument that is given replaces what the file says. A unit of 1 mm
/// keeps coordinates to the bit.
///
/// >>> import tempfile, pathlib
/// >>> file = pathlib.Path(tempfile.mkdtemp()) / "one.bcc"
/// >>> texere.Yarns.from_arrays([[0, 0, 0], [1, 0, 0]], 0.1).write(file)
/// >>> texere.read_curves(file, diameter_mm=0.2).points.tolist()
/// [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]]
///
/// Raises :class:`texere.Error` for a file that holds no curves or needs a diameter, and for
/// coordinates or a diameter out of range.
#[pyfunction]
#[pyo3(signature = (path, *, diameter_mm=None, unit_mm=None))]
pub(crate) fn read_curves(
    py: Python<'_>,
    path: PathBuf,
    diameter_mm: Option<f32>,
    unit_mm: Option<f32>,
) -> PyResult<Yarns> {
    let scale = CurveScale { unit_mm, diameter_mm };
    Ok(Yarns::own(watch::quietly(py, |_| texere::read::curves(path, scale))?))
}

/// Whether the ending of a path stands for a mesh, and not for yarns or curves. An ending that can
/// stand for a mesh and for curves stands for a mesh if `triangles` are asked for.
///
/// **Errors**: [`Error`] for any other ending, and for triangles in a file that can hold no mesh.
pub(crate) fn is_mesh(path: &Path, triangles: bool) -> PyResult<bool> {
    let is_curves = CurveFormat::from_path(path).is_ok();
    match Format::from_path(path) {
        Ok(_) => Ok(triangles || !is_curves),
        Err(_) if triangles && (is_saved(path) || is_curves) => {
            Err(Error::new_err(format!("{} holds no triangles", path.display())))
        }
        Err(_) if is_saved(path) || is_curves => Ok(false),
        Err(error) => {
            let curves = CurveFormat::ALL.map(CurveFormat::extension).join(", ");
            Err(Error::new_err(format!("{error}; and without a mesh: {curves}, yarns")))
        }
    }
}

fn is_saved(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("yarns"))
}

/// Writes yarns, or their centrelines as curves, by the ending of the path.
pub(crate) fn write(yarns: &texere::Yarns, output: Output) -> Result<(), WriteError> {
    if is_saved(output.path()) {
        return texere::write::yarns(yarns, output).map(|_| ());
    }
    texere::write::curves(yarns, output).map(|_| ())
}

impl Yarns {
    pub(crate) fn own(yarns: texere::Yarns) -> Self {
        Self { yarns: Shared::Own(Arc::new(yarns)) }
    }
}

#[pymethods]
impl Yarns {
    /// Yarns from arrays, all of which are copied.
    ///
    /// ``points`` has the shape (n, 3): the control points of all yarns, mm. ``radii`` is a number,
    /// an array of n, or one of shape (n, 2) with half widths and half heights, mm. ``offsets``
    /// says where in ``points`` each yarn begins, and ends with n; without it there is one yarn.
    /// ``closed`` and ``twist`` (radians a mm, above 0 for Z twist) are one value, or one for each
    /// yarn. ``colors`` has the shape (yarns, 3), 0 to 255, sRGB. ``tension`` is that of the
    /// splines, 0 to below 1.
    ///
    /// >>> ring = [[1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0]]
    /// >>> len(texere.Yarns.from_arrays(ring, 0.1, closed=True))
    /// 1
    ///
    /// Raises :class:`texere.Error` for points and radii out of range, TypeError and ValueError for
    /// arrays of another type or shape.
    #[staticmethod]
    #[pyo3(signature = (points, radii, offsets=None, *, closed=None, twist=None, colors=None, tension=0.0))]
    #[allow(clippy::too_many_arguments, reason = "each is an argument by name in Python")]
    fn from_arrays(
        py: Python<'_>,
        points: &Bound<'_, PyAny>,
        radii: &Bound<'_, PyAny>,
        offsets: Option<&Bound<'_, PyAny>>,
        closed: Option<&Bound<'_, PyAny>>,
        twist: Option<&Bound<'_, PyAny>>,
        colors: Option<&Bound<'_, PyAny>>,
        tension: f32,
    ) -> PyResult<Self> {
        let points = points_of(points, Some(radii))?;
        let count = points.len();
        let offsets = match offsets {
            Some(offsets) => given("offsets", offsets, &[None])?.values()?,
            None => vec![0, count as i64],
        };
        if let Some(offset) = offsets.iter().find(|offset| !(0..=count as i64).contains(*offset)) {
            return Err(PyValueError::new_err(format!("offsets has {offset}, expected 0 to {count}")));
        }
        let count = offsets.len().saturating_sub(1);
        let closed: Vec<bool> = each("closed", closed, count, false)?;
        let twist: Vec<f32> = each("twist", twist, count, 0.0)?;
        let colors = colors.map(|colors| self::colors(colors, count)).transpose()?;
        let has_colors = colors.is_some();
        let materials = colors.unwrap_or_else(|| vec![Material::default()]);
        let yarn = |number: usize| texere::Yarn {
            closed: closed[number % closed.len()],
            twist: twist[number % twist.len()],
            material: if has_colors { number as u32 } else { 0 },
            ..texere::Yarn::default()
        };
        let yarns = (0..count).map(yarn).collect();
        let offsets = offsets.into_iter().map(|offset| offset as u64).collect();
        let made = watch::quietly(py, |_| {
            let layout = Layout::new(yarns, offsets, vec![Section::Circle])?.with_tension(tension)?;
            texere::Yarns::new(layout, materials, points)
        })?;
        Ok(Self::own(made))
    }

    /// Control points of all yarns, mm: float32 of shape (n, 3). Does not copy.
    ///
    /// >>> texere.Yarns.from_arrays([[0, 0, 0], [1, 0, 0]], 0.1).points.tolist()
    /// [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]]
    #[getter]
    fn points<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyArray2<f32>>> {
        let points = slf.get().yarns.points();
        let numbers = ArrayView2::from_shape((points.len(), 4), cast_slice(points)).raise(slf.py())?;
        // SAFETY: the points belong to the yarns of `slf`, which never change.
        unsafe { view(slf.as_any(), numbers.slice(s![.., ..3])) }
    }

    /// Half width and half height at each control point, mm: float16 of shape (n, 2). Does not
    /// copy.
    ///
    /// >>> texere.Yarns.from_arrays([[0, 0, 0], [1, 0, 0]], 0.5).halves.tolist()
    /// [[0.5, 0.5], [0.5, 0.5]]
    #[getter]
    fn halves<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        let points = slf.get().yarns.points();
        let bits: &[u16] = cast_slice(points);
        let bits = ArrayView2::from_shape((points.len(), 8), bits).raise(slf.py())?;
        // SAFETY: as in `points`.
        unsafe { view(slf.as_any(), bits.slice(s![.., 6..])) }?.call_method1("view", ("float16",))
    }

    /// Where in the points each yarn begins, and at the end the number of points: uint64, one more
    /// than there are yarns. Does not copy.
    ///
    /// >>> texere.Yarns.from_arrays([[0, 0, 0], [1, 0, 0]], 0.1).offsets.tolist()
    /// [0, 2]
    #[getter]
    fn offsets<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyArray1<u64>>> {
        // SAFETY: as in `points`.
        unsafe { view(slf.as_any(), ArrayView1::from(slf.get().yarns.layout().offsets())) }
    }

    /// The colour of each yarn, sRGB: uint8 of shape (yarns, 3). Returns a copy.
    ///
    /// >>> points = [[0, 0, 0], [1, 0, 0]]
    /// >>> texere.Yarns.from_arrays(points, 0.1, colors=[[1, 2, 3]]).colors.tolist()
    /// [[1, 2, 3]]
    #[getter]
    fn colors<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<u8>> {
        let (yarns, materials) = (self.yarns.layout().yarns(), self.yarns.materials());
        let color = |(yarn, channel): (usize, usize)| materials[yarns[yarn].material as usize].srgb[channel];
        Array2::from_shape_fn((yarns.len(), 3), color).into_pyarray(py)
    }

    /// Which thread of the design each yarn is, in words. Returns a copy.
    ///
    /// >>> texere.read("designs/plain.toml").placed().yarns.names[:2]
    /// ['end 1', 'end 2']
    #[getter]
    fn names(&self) -> Vec<String> {
        self.yarns.layout().yarns().iter().map(|yarn| yarn.origin.to_string()).collect()
    }

    /// Tension of the splines through the control points, 0 to below 1.
    ///
    /// >>> texere.Yarns.from_arrays([[0, 0, 0], [1, 0, 0]], 0.1, tension=0.5).tension
    /// 0.5
    #[getter]
    fn tension(&self) -> f32 {
        self.yarns.tension()
    }

    /// The tubes of the yarns, as triangles: see :meth:`texere.Cloth.mesh`.
    ///
    /// >>> yarns = texere.Yarns.from_arrays([[0, 0, 0], [1, 0, 0]], 0.1)
    /// >>> yarns.mesh(sides=4, device="cpu").indices.shape
    /// (16, 3)
    #[pyo3(signature = (sides=None, subdivisions=None, *, caps=false, device="auto"))]
    fn mesh(
        &self,
        py: Python<'_>,
        sides: Option<u32>,
        subdivisions: Option<u32>,
        caps: bool,
        device: &str,
    ) -> PyResult<Mesh> {
        Mesh::make(py, &self.yarns, settings(&self.yarns, sides, subdivisions, caps), device)
    }

    /// Writes the yarns by the ending of the path: ``.yarns``, to the bit, for
    /// :func:`texere.read_yarns`; ``.bcc`` and ``.usda``, their centrelines as curves in mm. A BCC
    /// file has neither thickness nor colour, and :func:`texere.read_curves` reads it. The file
    /// appears whole or not at all. ``linear`` writes a ``.usda`` of straight lines between control
    /// points, for simulators that read no other curves.
    ///
    /// >>> import tempfile, pathlib
    /// >>> file = pathlib.Path(tempfile.mkdtemp()) / "one.yarns"
    /// >>> texere.Yarns.from_arrays([[0, 0, 0], [1, 0, 0]], 0.1).write(file)
    ///
    /// Raises :class:`texere.Error` for another ending, for BCC of yarns whose tension is not 0,
    /// and for a file that can't be written.
    #[pyo3(signature = (path, *, linear=false))]
    fn write(&self, py: Python<'_>, path: PathBuf, linear: bool) -> PyResult<()> {
        let (yarns, output): (&texere::Yarns, _) =
            (&self.yarns, mesh::output(&path, mesh::Compressed::No, [false, false, linear])?);
        watch::quietly(py, |_| write(yarns, output))
    }

    fn __len__(&self) -> usize {
        self.yarns.layout().yarns().len()
    }

    fn __repr__(&self) -> String {
        format!("<texere.Yarns {} with {} control points>", self.__len__(), self.yarns.points().len())
    }
}

/// Control points from callers' arrays. Without radii each is 1 mm thick.
pub(crate) fn points_of(
    points: &Bound<'_, PyAny>,
    radii: Option<&Bound<'_, PyAny>>,
) -> PyResult<Vec<ControlPoint>> {
    let points = given("points", points, &[None, Some(3)])?;
    let positions: Vec<f32> = points.values()?;
    let halves = radii.map_or(Ok(vec![[0.5; 2]]), |radii| halves(radii, points.shape[0]))?;
    let point = |(number, at): (usize, &[f32])| {
        let [width, height] = halves[number % halves.len()];
        ControlPoint::new(at[0], at[1], at[2], width).flattened(width, height)
    };
    Ok(positions.chunks_exact(3).enumerate().map(point).collect())
}

/// Half widths and half heights from the radii of `count` points: one pair, or one for each point.
fn halves(radii: &Bound<'_, PyAny>, count: usize) -> PyResult<Vec<[f32; 2]>> {
    if let Ok(radius) = radii.extract::<f32>() {
        return Ok(vec![[radius; 2]]);
    }
    if let Ok(radii) = given("radii", radii, &[Some(count)]) {
        return Ok(radii.values::<f32>()?.into_iter().map(|radius| [radius; 2]).collect());
    }
    let radii = given("radii", radii, &[Some(count), Some(2)])?.values::<f32>()?;
    Ok(radii.chunks_exact(2).map(|half| [half[0], half[1]]).collect())
}

/// A value for each of `count` yarns, or one for all of them.
fn each<T: crate::arrays::Number + for<'a, 'py> FromPyObject<'a, 'py>>(
    name: &'static str,
    value: Option<&Bound<'_, PyAny>>,
    count: usize,
    usual: T,
) -> PyResult<Vec<T>> {
    let Some(value) = value else { return Ok(vec![usual]) };
    value.extract().map_or_else(|_| given(name, value, &[Some(count)])?.values(), |one: T| Ok(vec![one]))
}

/// A material for each colour.
fn colors(value: &Bound<'_, PyAny>, count: usize) -> PyResult<Vec<Material>> {
    let numbers = given("colors", value, &[Some(count), Some(3)])?.values::<i64>()?;
    let channel = |number: &i64| {
        u8::try_from(*number)
            .map_err(|_| PyValueError::new_err(format!("colors has {number}, expected 0 to 255")))
    };
    let channels = numbers.iter().map(channel).collect::<PyResult<Vec<_>>>()?;
    let material = |color: &[u8]| Material { srgb: [color[0], color[1], color[2]], ..Material::default() };
    Ok(channels.chunks_exact(3).map(material).collect())
}
