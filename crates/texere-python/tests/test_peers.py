"""Pictures against the picker, meshes in other packages, and what notebooks show."""

import struct
import zlib

import numpy as np
import pytest
import texere


@pytest.fixture(scope="module")
def cloth():
    return texere.read("designs/plain.toml").placed()


def test_layers_show_what_rays_hit(cloth):
    """The CPU's picker has no code in common with what draws pictures."""
    eye = ((21.0, -10.0, 20.0), (21.0, 16.0, 0.0), (0.0, 0.0, 1.0))
    size = (48, 36)
    layers = ["yarn", "depth", "position", "normal", "tangent", "uv"]
    look = {"view": "eye", "eye": eye, "field_of_view": 0.04, "supersampling": 1, "hairs": False}
    shown = cloth.picture(size=size, layers=layers, **look)
    assert shown["color"].shape == (36, 48, 3) and shown["uv"].shape == (36, 48, 2)
    seen = shown["yarn"] >= 0
    assert np.isinf(shown["depth"][~seen]).all() and (shown["normal"][~seen] == 0).all()
    assert np.allclose(np.linalg.norm(shown["normal"][seen], axis=1), 1, atol=1e-5)
    away = shown["position"] - np.array(eye[0], np.float32)
    assert np.allclose(np.linalg.norm(away[seen], axis=1), shown["depth"][seen], atol=1e-3)
    hits = alike = 0
    for row, column in np.argwhere(seen):
        ray = [eye[0], away[row, column]]
        hit = cloth.pick(ray)
        if hit is None:
            continue
        hits += 1
        place = shown["position"][row, column]
        alike += hit.yarn == shown["yarn"][row, column] and np.linalg.norm(hit.position - place) < 0.05
    assert hits > 500
    # A pixel counts as its first sample, which is not in its middle: outlines differ.
    assert alike > 0.9 * hits, (alike, hits)


def test_a_picture_without_background_has_alpha(cloth):
    near = {"view": "cut-warp", "at": (20, 16), "width_mm": 3}
    nothing = cloth.picture(size=(40, 30), background="nothing", **near)
    assert nothing.shape == (30, 40, 4) and nothing[..., 3].min() == 0 and nothing[..., 3].max() == 255
    red = cloth.picture(size=(40, 30), background="#ff0000", **near)
    assert (red[0, 0] == [255, 0, 0]).all()
    assert (cloth.picture(size=(40, 30)) == cloth.picture(size=(40, 30))).all()


def test_views_differ(cloth):
    place = {"at": (20, 16), "width_mm": 5}
    views = [{}, {"view": "back"}, {"view": "oblique", "turn": 0.5}]
    views += [{"view": view, **place} for view in ("close-up", "cut-warp", "cut-weft")]
    pictures = {cloth.picture(size=(40, 30), **view).tobytes() for view in views}
    assert len(pictures) == len(views)


def test_trimesh_takes_the_mesh():
    yarns = texere.Yarns.from_arrays([[0, 0, 0], [1, 0, 0], [2, 0, 0]], 0.25, colors=[[9, 8, 7]])
    mesh = yarns.mesh(sides=64, caps=True, device="cpu")
    made = mesh.to_trimesh()
    assert made.faces.shape == mesh.indices.shape and (made.vertices == mesh.positions).all()
    assert (made.visual.vertex_colors[:, :3] == [9, 8, 7]).all()
    made.merge_vertices(merge_norm=True, merge_tex=True)
    assert made.is_watertight and made.volume == pytest.approx(2 * np.pi * 0.25**2, rel=0.01)


def test_pyvista_takes_the_mesh():
    mesh = texere.read("designs/locknit.toml").placed().mesh(device="cpu")
    made = mesh.to_pyvista()
    assert (made.points == mesh.positions).all() and made.n_cells == len(mesh.indices)
    assert (made.regular_faces == mesh.indices).all()
    assert (made.point_data["yarn"] == mesh.yarn_ids).all()
    assert (made.point_data["Normals"] == mesh.normals).all()


def test_show_gives_pyvista_the_mesh(monkeypatch):
    """A window needs a screen, so pyvista's plotter is replaced."""
    import pyvista

    told = []

    class Plotter:
        def add_mesh(self, mesh, **look):
            told.append((mesh.n_points, look))

        def show(self, **options):
            told.append(options)
            return "shown"

    monkeypatch.setattr(pyvista, "Plotter", Plotter)
    mesh = texere.read("designs/locknit.toml").placed().mesh(device="cpu")
    assert mesh.show(screenshot=True) == "shown"
    assert told == [(len(mesh.positions), {"scalars": "rgb", "rgb": True}), {"screenshot": True}]


def test_without_a_package_its_import_fails(monkeypatch):
    import sys

    mesh = texere.Yarns.from_arrays([[0, 0, 0], [1, 0, 0]], 0.1).mesh(device="cpu")
    for name, call in [("trimesh", mesh.to_trimesh), ("pyvista", mesh.to_pyvista), ("pyvista", mesh.show)]:
        monkeypatch.setitem(sys.modules, name, None)
        with pytest.raises(ImportError):
            call()


def test_a_notebook_shows_a_picture(cloth):
    png = cloth._repr_png_()
    assert png.startswith(b"\x89PNG") and struct.unpack(">II", png[16:24]) == (640, 480)
    data = b""
    at = 8
    while at < len(png):
        length, kind = struct.unpack(">I4s", png[at : at + 8])
        data += png[at + 8 : at + 8 + length] if kind == b"IDAT" else b""
        at += 12 + length
    rows = np.frombuffer(zlib.decompress(data), np.uint8).reshape(480, 1 + 3 * 640)
    assert rows[:, 1:].std() > 5


def test_a_notebook_shows_measures(cloth):
    table = cloth.measures._repr_html_()
    assert table.startswith("<table>") and "<th>areal_weight</th>" in table and "nan" not in table
