//! Meshes for other packages of Python, which are imported when they are asked for.

use pyo3::prelude::*;
use pyo3::types::PyDict;

/// The arrays of a mesh as keyword arguments.
fn arrays<'py>(mesh: &Bound<'py, PyAny>, names: &[(&str, &str)]) -> PyResult<Bound<'py, PyDict>> {
    let arrays = PyDict::new(mesh.py());
    for (argument, name) in names {
        arrays.set_item(argument, mesh.getattr(*name)?)?;
    }
    Ok(arrays)
}

/// A `trimesh.Trimesh` with the vertices, normals and colours of a mesh.
pub(crate) fn trimesh<'py>(mesh: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
    let names = [
        ("vertices", "positions"),
        ("faces", "indices"),
        ("vertex_normals", "normals"),
        ("vertex_colors", "colors"),
    ];
    let arrays = arrays(mesh, &names)?;
    // Otherwise trimesh would put vertices of different yarns together.
    arrays.set_item("process", false)?;
    mesh.py().import("trimesh")?.call_method("Trimesh", (), Some(&arrays))
}

/// A `pyvista.PolyData` with the vertices of a mesh. Its normals, yarns, texture coordinates (`uv`)
/// and colours are data of points.
pub(crate) fn pyvista<'py>(mesh: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
    let class = mesh.py().import("pyvista")?.getattr("PolyData")?;
    let (positions, indices) = (mesh.getattr("positions")?, mesh.getattr("indices")?);
    let made = class.call_method1("from_regular_faces", (positions, indices))?;
    let data = made.getattr("point_data")?;
    for (name, array) in [("Normals", "normals"), ("yarn", "yarn_ids"), ("uv", "uv"), ("rgb", "colors")] {
        data.set_item(name, mesh.getattr(array)?)?;
    }
    data.setattr("active_normals_name", "Normals")?;
    Ok(made)
}

/// Shows a mesh in a window of pyvista, or in a notebook. `options` are those of `Plotter.show`.
pub(crate) fn show<'py>(
    mesh: &Bound<'py, PyAny>,
    options: Option<&Bound<'py, PyDict>>,
) -> PyResult<Bound<'py, PyAny>> {
    let py = mesh.py();
    let made = pyvista(mesh)?;
    let plotter = py.import("pyvista")?.getattr("Plotter")?.call0()?;
    let look = PyDict::new(py);
    look.set_item("scalars", "rgb")?;
    look.set_item("rgb", true)?;
    plotter.call_method("add_mesh", (made,), Some(&look))?;
    plotter.call_method("show", (), options)
}
