"""Mesh files, opened by trimesh: counts, bounds, colours, and whether capped tubes are solids."""

import math

import numpy
import pytest
import texere
import trimesh

FORMATS = ["ply", "stl", "obj", "glb"]


def opened(path):
    """The file as one mesh in millimetres. STL has no shared vertices: equal places are joined."""
    loaded = trimesh.load(path, process=path.suffix == ".stl", force="scene")
    mesh = loaded.to_mesh()
    if path.suffix == ".glb":
        # Metres, along the same axes.
        mesh.vertices = mesh.vertices * 1000.0
    return mesh


def cloth():
    design = texere.read("designs/plain.toml")
    return design.rest(device="cpu", progress=False)


@pytest.mark.parametrize("suffix", FORMATS)
def test_counts_and_bounds_are_ours(tmp_path, suffix):
    sides = 6
    mesh = cloth().mesh(sides=sides, device="cpu")
    path = tmp_path / f"plain.{suffix}"
    mesh.write(path)
    read = opened(path)
    assert len(read.faces) == len(mesh.indices)
    bounds = [mesh.positions.min(axis=0), mesh.positions.max(axis=0)]
    assert numpy.abs(read.bounds - bounds).max() < 1e-5
    # Where the texture of OBJ begins and ends, trimesh has a vertex of each ring twice.
    twice = len(mesh.positions) // sides if suffix == "obj" else 0
    if suffix != "stl":
        assert len(read.vertices) == len(mesh.positions) + twice


def test_curves_come_back_to_the_bit(tmp_path):
    yarns = cloth().yarns
    yarns.write(tmp_path / "plain.bcc")
    read = texere.read_curves(tmp_path / "plain.bcc", diameter_mm=0.4)
    assert numpy.array_equal(read.points, yarns.points)
    assert numpy.array_equal(read.offsets, yarns.offsets)
    assert numpy.allclose(read.halves, 0.2, atol=1e-4)
    cloth().write(tmp_path / "cloth.bcc")
    assert (tmp_path / "cloth.bcc").read_bytes() == (tmp_path / "plain.bcc").read_bytes()
    cloth().write(tmp_path / "cloth.usda")
    assert (tmp_path / "cloth.usda").read_text().startswith("#usda 1.0")
    stage = texere.read_curves(tmp_path / "cloth.usda", diameter_mm=0.4)
    assert numpy.array_equal(stage.points, yarns.points)
    assert numpy.allclose(stage.halves, 0.2, atol=1e-4)
    with pytest.raises(texere.Error):
        texere.read_curves(tmp_path / "plain.bcc", diameter_mm=-1.0)


@pytest.mark.parametrize("suffix", ["ply", "obj", "glb"])
def test_colours_are_ours(tmp_path, suffix):
    points = [[x, y, 0.0] for x in (0.0, 5.0) for y in range(3)]
    yarns = texere.Yarns.from_arrays(points, 0.2, offsets=[0, 3, 6], colors=[[200, 30, 10], [0, 90, 255]])
    path = tmp_path / f"two.{suffix}"
    yarns.mesh(device="cpu").write(path)
    loaded = trimesh.load(path, process=False, force="scene")
    seen = set()
    for piece in loaded.geometry.values():
        visual = piece.visual
        color = visual.material.main_color if visual.kind == "texture" else visual.main_color
        colors = [color] if visual.kind == "texture" else numpy.unique(visual.vertex_colors, axis=0)
        seen |= {tuple(int(channel) for channel in color[:3]) for color in colors}
    wanted = {(200, 30, 10), (0, 90, 255)}
    if suffix == "glb":
        # glTF's colours are linear.
        def linear(channel):
            encoded = channel / 255.0
            return encoded / 12.92 if encoded <= 0.04045 else ((encoded + 0.055) / 1.055) ** 2.4

        wanted = {tuple(round(linear(channel) * 255.0) for channel in color) for color in wanted}
    off = max(min(max(abs(a - b) for a, b in zip(one, other)) for other in seen) for one in wanted)
    assert off <= 1, (seen, wanted)


@pytest.mark.parametrize("suffix", FORMATS)
def test_capped_tubes_are_solids(tmp_path, suffix):
    sides, radius, length = 12, 0.4, 7.0
    points = numpy.linspace([0.0, 0.0, 0.0], [length, 0.0, 0.0], 8)
    path = tmp_path / f"rod.{suffix}"
    texere.Yarns.from_arrays(points, radius).mesh(sides=sides, caps=True, device="cpu").write(path)
    mesh = trimesh.load(path, force="mesh", process=True)
    mesh.merge_vertices(merge_norm=True, merge_tex=True)
    assert mesh.is_watertight and mesh.is_winding_consistent
    exact = 0.5 * sides * math.sin(2.0 * math.pi / sides) * radius**2 * length
    # A GLB file is in metres.
    volume = mesh.volume * (1e9 if suffix == "glb" else 1.0)
    assert abs(volume / exact - 1.0) < 0.01
