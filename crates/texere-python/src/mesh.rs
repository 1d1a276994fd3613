//! Meshes: vertices and triangles of tubes, as arrays.

use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};

use bytemuck::cast_slice;
use numpy::ndarray::{Array2, ArrayView2, s};
use numpy::{IntoPyArray, PyArray1, PyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use texere::mesh::Attribute;
use texere::write::{Output, VertexAttribute};
use texere::{Backend, Pipeline, Settings};

use crate::arrays::view;
use crate::error::{Error, Raise};
use crate::shared::Shared;
use crate::watch::Run;
use crate::whole::Whole;
use crate::{device, peers, watch, whole};

/// The triangles of yarns: :meth:`texere.Cloth.mesh` makes them.
///
/// >>> mesh = texere.read("designs/plain.toml").placed().mesh(device="cpu")
/// >>> mesh.positions.shape == mesh.normals.shape, mesh.indices.shape
/// (True, (584448, 3))
#[pyclass(frozen, module = "texere")]
#[derive(Debug)]
pub(crate) struct Mesh {
    mesh: Whole,
    yarns: Shared,
    settings: Settings,
    device: Arc<dyn Backend>,
    /// The attributes of all vertices, made when they are first asked for.
    attributes: OnceLock<Vec<Attribute>>,
}

/// The settings of a mesh: those that suit the yarns, but for what is given.
pub(crate) fn settings(
    yarns: &texere::Yarns,
    sides: Option<u32>,
    subdivisions: Option<u32>,
    caps: bool,
) -> Settings {
    let usual = Settings::of(yarns);
    Settings {
        sides: sides.unwrap_or(usual.sides),
        subdivisions: subdivisions.unwrap_or(usual.subdivisions),
        caps,
        ..usual
    }
}

impl Mesh {
    /// Makes the mesh of `yarns` on the device that is called `device`.
    pub(crate) fn make(py: Python<'_>, yarns: &Shared, settings: Settings, device: &str) -> PyResult<Self> {
        let device = watch::quietly(py, |_| device::open(device))?;
        let vertices = pipeline(yarns, settings).plan().raise(py)?.counts().vertices;
        if u32::try_from(vertices).is_err() {
            return Err(Error::new_err(format!(
                "the mesh has {vertices} vertices, and indices of 32 bits count {} at most",
                u32::MAX
            )));
        }
        let mesh = watch::quietly(py, |run| Whole::new(yarns, settings, &*device, run))?;
        Ok(Self { mesh, yarns: yarns.clone(), settings, device, attributes: OnceLock::new() })
    }

    /// What is known of each vertex.
    fn attributes(&self, py: Python<'_>) -> PyResult<&[Attribute]> {
        if let Some(attributes) = self.attributes.get() {
            return Ok(attributes);
        }
        let made =
            watch::quietly(py, |run| whole::attributes(&self.yarns, self.settings, &*self.device, run))?;
        Ok(self.attributes.get_or_init(|| made))
    }
}

/// What makes a mesh of yarns.
pub(crate) fn pipeline(yarns: &texere::Yarns, settings: Settings) -> Pipeline<'_> {
    Pipeline::new(yarns).settings(settings)
}

/// A pipeline that tells how far it has come.
pub(crate) fn followed<'a>(pipeline: Pipeline<'a>, run: &'a Run) -> Pipeline<'a> {
    pipeline.progress(|done| run.tell(done.rings as f64 / done.total.max(1) as f64))
}

/// How many numbers of four bytes a vertex or an attribute has.
const WORDS: usize = 6;

#[pymethods]
impl Mesh {
    /// Positions of vertices, mm: float32 of shape (n, 3). Does not copy.
    ///
    /// >>> mesh = texere.read("designs/plain.toml").placed().mesh(device="cpu")
    /// >>> mesh.positions.flags.writeable, type(mesh.positions.base)
    /// (False, <class 'texere.Mesh'>)
    #[getter]
    fn positions<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyArray2<f32>>> {
        vertices(slf, 0)
    }

    /// Unit normals of vertices, out of the yarn: float32 of shape (n, 3). Does not copy.
    ///
    /// >>> texere.read("designs/plain.toml").placed().mesh(device="cpu").normals.dtype
    /// dtype('float32')
    #[getter]
    fn normals<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyArray2<f32>>> {
        vertices(slf, 3)
    }

    /// Triangles, the numbers of their vertices: uint32 of shape (m, 3), counter-clockwise seen
    /// from outside. Does not copy.
    ///
    /// >>> texere.read("designs/plain.toml").placed().mesh(device="cpu").indices.dtype
    /// dtype('uint32')
    #[getter]
    fn indices<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyArray2<u32>>> {
        let indices = &slf.get().mesh.indices;
        let triangles = ArrayView2::from_shape((indices.len() / 3, 3), indices).raise(slf.py())?;
        // SAFETY: the indices belong to the mesh of `slf`, which never changes.
        unsafe { view(slf.as_any(), triangles) }
    }

    /// The number of each vertex's yarn, from 0: uint32 of n. Does not copy; the first use of this,
    /// of ``uv`` or of ``tangents`` makes all three.
    ///
    /// >>> mesh = texere.read("designs/plain.toml").placed().mesh(device="cpu")
    /// >>> int(mesh.yarn_ids.max())
    /// 111
    ///
    /// Raises :class:`texere.Error` for a device that fails, or that can't make them.
    #[getter]
    fn yarn_ids<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyArray1<u32>>> {
        let attributes = slf.get().attributes(slf.py())?;
        let words: &[u32] = cast_slice(attributes);
        let words = ArrayView2::from_shape((attributes.len(), WORDS), words).raise(slf.py())?;
        // SAFETY: attributes are made once, and never change.
        unsafe { view(slf.as_any(), words.slice(s![.., 0])) }
    }

    /// Where on its yarn each vertex lies: the angle round the section, radians, and the length
    /// along the yarn, mm: float32 of shape (n, 2). Does not copy.
    ///
    /// >>> mesh = texere.Yarns.from_arrays([[0, 0, 0], [1, 0, 0]], 0.1).mesh(device="cpu")
    /// >>> round(float(mesh.uv[:, 1].max()), 6)
    /// 1.0
    ///
    /// Raises :class:`texere.Error` for a device that fails, or that can't make them.
    #[getter]
    fn uv<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyArray2<f32>>> {
        places(slf, 1, 3)
    }

    /// The unit tangent of the yarn at each vertex: float32 of shape (n, 3). Does not copy.
    ///
    /// >>> mesh = texere.Yarns.from_arrays([[0, 0, 0], [1, 0, 0]], 0.1).mesh(device="cpu")
    /// >>> mesh.tangents[0].tolist()
    /// [1.0, 0.0, 0.0]
    ///
    /// Raises :class:`texere.Error` for a device that fails, or that can't make them.
    #[getter]
    fn tangents<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyArray2<f32>>> {
        places(slf, 3, 6)
    }

    /// The colour of each vertex, sRGB: uint8 of shape (n, 3). Returns a copy.
    ///
    /// >>> yarns = texere.Yarns.from_arrays([[0, 0, 0], [1, 0, 0]], 0.1, colors=[[1, 2, 3]])
    /// >>> yarns.mesh(device="cpu").colors[0].tolist()
    /// [1, 2, 3]
    ///
    /// Raises :class:`texere.Error` for a device that fails, or that can't tell vertices' yarns.
    #[getter]
    fn colors<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<u8>>> {
        let attributes = self.attributes(py)?;
        let (yarns, materials) = (self.yarns.layout().yarns(), self.yarns.materials());
        let colors = py.detach(|| {
            let color = |yarn: u32| materials[yarns[yarn as usize].material as usize].srgb;
            let colors = attributes.iter().flat_map(|attribute| color(attribute.yarn)).collect();
            Array2::from_shape_vec((attributes.len(), 3), colors)
        });
        Ok(colors.raise(py)?.into_pyarray(py))
    }

    /// Bytes of vertices and indices.
    ///
    /// >>> texere.Yarns.from_arrays([[0, 0, 0], [1, 0, 0]], 0.1).mesh(sides=4, device="cpu").nbytes
    /// 480
    #[getter]
    fn nbytes(&self) -> usize {
        size_of_val(&self.mesh.vertices[..]) + size_of_val(&self.mesh.indices[..])
    }

    /// Writes the mesh as a ``.glb``, ``.ply``, ``.stl``, ``.obj`` or ``.usda`` file, which appears
    /// whole or not at all. The mesh is made again while it is written, piece by piece. ``packed``
    /// writes a ``.glb`` with half the bytes for a vertex, as whole numbers: positions are off by
    /// at most 1/131068 of the largest side of the yarn's box. ``compressed`` packs a ``.glb`` and
    /// compresses it to about half of its bytes, for readers that know the extension
    /// ``EXT_meshopt_compression``; ``compressed="khr"`` compresses further, for those that know
    /// ``KHR_meshopt_compression``. ``instanced`` writes a ``.glb`` that holds equal parts of yarns
    /// only once, for readers that know ``EXT_mesh_gpu_instancing``. A part is as long as 16
    /// control points, or is a cap. ``attributes`` names further numbers of the vertices of a
    /// ``.glb``, a ``.ply`` or a ``.usda``: ``uv``, the share of a turn round the yarn and the mm
    /// along it; ``tangent``, the direction along the yarn; ``yarn``, the yarn's number.
    ///
    /// >>> import tempfile, pathlib
    /// >>> file = pathlib.Path(tempfile.mkdtemp()) / "yarn.ply"
    /// >>> texere.Yarns.from_arrays([[0, 0, 0], [1, 0, 0]], 0.1).mesh(device="cpu").write(file)
    ///
    /// Raises :class:`texere.Error` for another ending, and for a file that can't be written,
    /// packed, compressed or instanced or can't hold the attributes; ValueError for a file that is
    /// to be several of packed, compressed and instanced, for an unknown value of ``compressed``
    /// and for an unknown attribute.
    #[pyo3(signature = (path, *, packed=false, compressed=Compressed::No, instanced=false, attributes=Vec::new()), text_signature = "($self, path, *, packed=False, compressed=False, instanced=False, attributes=[])")]
    fn write(
        &self,
        py: Python<'_>,
        path: PathBuf,
        packed: bool,
        compressed: Compressed,
        instanced: bool,
        attributes: Vec<String>,
    ) -> PyResult<()> {
        let output = output(&path, compressed, [packed, instanced, false])?.attributes(named(&attributes)?);
        watch::quietly(py, |run| {
            let pipeline = followed(pipeline(&self.yarns, self.settings), run);
            texere::write::stream(pipeline, &*self.device, output).map(|_| ())
        })
    }

    /// The mesh as a ``trimesh.Trimesh``, with its normals and colours. Copies: trimesh counts in
    /// float64.
    ///
    /// >>> yarns = texere.Yarns.from_arrays([[0, 0, 0], [1, 0, 0]], 0.1)
    /// >>> yarns.mesh(sides=4, caps=True, device="cpu").to_trimesh().is_volume
    /// False
    ///
    /// Raises ImportError unless trimesh is installed.
    fn to_trimesh<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        peers::trimesh(slf.as_any())
    }

    /// The mesh as a ``pyvista.PolyData``, with its normals, and ``yarn``, ``uv`` and ``rgb`` as
    /// data of points. Returns a copy.
    ///
    /// >>> yarns = texere.Yarns.from_arrays([[0, 0, 0], [1, 0, 0]], 0.1)
    /// >>> yarns.mesh(sides=4, device="cpu").to_pyvista().n_points
    /// 12
    ///
    /// Raises ImportError unless pyvista is installed.
    fn to_pyvista<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        peers::pyvista(slf.as_any())
    }

    /// Shows the mesh in a window of pyvista, or in a notebook. ``options`` are those of pyvista's
    /// ``Plotter.show``. Returns what ``Plotter.show`` returns.
    ///
    /// >>> mesh = texere.Yarns.from_arrays([[0, 0, 0], [1, 0, 0]], 0.1).mesh(device="cpu")
    /// >>> mesh.show() # doctest: +SKIP
    ///
    /// Raises ImportError unless pyvista is installed.
    #[pyo3(signature = (**options))]
    fn show<'py>(
        slf: &Bound<'py, Self>,
        options: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        peers::show(slf.as_any(), options)
    }

    fn __repr__(&self) -> String {
        let Whole { vertices, indices } = &self.mesh;
        format!("<texere.Mesh {} vertices, {} triangles>", vertices.len(), indices.len() / 3)
    }
}

/// Three of the six numbers of each vertex, from number `first` on.
fn vertices<'py>(slf: &Bound<'py, Mesh>, first: usize) -> PyResult<Bound<'py, PyArray2<f32>>> {
    let vertices = &slf.get().mesh.vertices[..];
    let words = ArrayView2::from_shape((vertices.len(), WORDS), cast_slice(vertices)).raise(slf.py())?;
    // SAFETY: the vertices belong to the mesh of `slf`, which never changes.
    unsafe { view(slf.as_any(), words.slice(s![.., first..first + 3])) }
}

/// Some of the numbers of each vertex's attribute.
fn places<'py>(slf: &Bound<'py, Mesh>, first: usize, end: usize) -> PyResult<Bound<'py, PyArray2<f32>>> {
    let attributes = slf.get().attributes(slf.py())?;
    let words = ArrayView2::from_shape((attributes.len(), WORDS), cast_slice(attributes)).raise(slf.py())?;
    // SAFETY: attributes are made once, and never change.
    unsafe { view(slf.as_any(), words.slice(s![.., first..end])) }
}

/// The attributes of these names.
///
/// **Errors**: `ValueError` for an unknown name.
pub(crate) fn named(attributes: &[String]) -> PyResult<Vec<VertexAttribute>> {
    let named = |name: &String| {
        VertexAttribute::named(name).ok_or_else(|| {
            let known = VertexAttribute::ALL.map(VertexAttribute::name).join(", ");
            PyValueError::new_err(format!("there is no attribute {name:?}; there are: {known}"))
        })
    };
    attributes.iter().map(named).collect()
}

/// The extension that a `.glb` is compressed with, as an argument says it: `False`, `True` for the
/// usual one, or its prefix.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Compressed {
    No,
    Ext,
    Khr,
}

impl FromPyObject<'_, '_> for Compressed {
    type Error = PyErr;

    fn extract(object: Borrowed<'_, '_, PyAny>) -> PyResult<Self> {
        if let Ok(compressed) = object.extract::<bool>() {
            return Ok(if compressed { Self::Ext } else { Self::No });
        }
        match &*object.extract::<String>()? {
            "ext" => Ok(Self::Ext),
            "khr" => Ok(Self::Khr),
            _ => Err(PyValueError::new_err("compressed is False, True, \"ext\" or \"khr\"")),
        }
    }
}

/// The file that a cloth, yarns or a mesh are written to: packed, compressed, instanced or linear,
/// one of them at most.
///
/// **Errors**: `ValueError` for a file that is to be several of them.
pub(crate) fn output(
    path: &Path,
    compressed: Compressed,
    [packed, instanced, linear]: [bool; 3],
) -> PyResult<Output> {
    let output = Output::to(path);
    match (compressed, packed, instanced, linear) {
        (Compressed::No, false, false, false) => Ok(output),
        (Compressed::No, true, false, false) => Ok(output.packed()),
        (Compressed::Ext, false, false, false) => Ok(output.compressed()),
        (Compressed::Khr, false, false, false) => Ok(output.khr_compressed()),
        (Compressed::No, false, true, false) => Ok(output.instanced()),
        (Compressed::No, false, false, true) => Ok(output.linear()),
        _ => Err(PyValueError::new_err(
            "a file is packed (.glb), compressed (.glb), instanced (.glb) or linear (.usda): one of them",
        )),
    }
}
