"""Meshes are those of the ``texere`` program, to the bit, and their arrays fit the yarns."""

import os
import pathlib
import subprocess

import numpy as np
import pytest
import texere

ROOT = pathlib.Path(__file__).resolve().parents[3]
PROGRAM = ROOT / "target" / "debug" / ("texere.exe" if os.name == "nt" else "texere")


def ply(path):
    """Positions, normals and triangles of a binary PLY file."""
    header, _, body = path.read_bytes().partition(b"end_header\n")
    count = {
        line.split()[1]: int(line.split()[2])
        for line in header.decode().splitlines()
        if line.startswith("element")
    }
    vertex = np.dtype([("position", "<f4", 3), ("normal", "<f4", 3), ("color", "u1", 3)])
    face = np.dtype([("count", "u1"), ("corners", "<u4", 3)])
    assert len(body) == count["vertex"] * vertex.itemsize + count["face"] * face.itemsize
    vertices = np.frombuffer(body, vertex, count["vertex"])
    faces = np.frombuffer(body, face, count["face"], vertices.nbytes)
    assert (faces["count"] == 3).all()
    return vertices["position"], vertices["normal"], faces["corners"], vertices["color"]


@pytest.mark.parametrize("design", ["poplin.toml", "jersey.toml", "locknit.toml", "two-ply.toml"])
@pytest.mark.parametrize("chosen", [{}, {"sides": 9, "subdivisions": 3, "caps": True}])
def test_a_mesh_is_that_of_the_program_to_the_bit(design, chosen, tmp_path):
    flags = [f"--{name}" if value is True else f"--{name}={value}" for name, value in chosen.items()]
    known = tmp_path / "known.ply"
    command = [PROGRAM, "mesh", f"designs/{design}", "--device", "cpu", *flags, "-o", known]
    subprocess.run(command, check=True, capture_output=True)
    mesh = texere.read(f"designs/{design}").rest(device="cpu").mesh(device="cpu", **chosen)
    positions, normals, triangles, colors = ply(known)
    assert positions.tobytes() == mesh.positions.tobytes()
    assert normals.tobytes() == mesh.normals.tobytes()
    assert (triangles == mesh.indices).all()
    assert (colors == mesh.colors).all()
    own = tmp_path / "own.ply"
    mesh.write(own)
    assert own.read_bytes() == known.read_bytes()


def test_a_mesh_of_several_chunks_is_one_piece(tmp_path):
    yarn = texere.Yarn(diameter_mm=0.2)
    design = texere.woven(texere.weave("2/2", 400, 300), yarn, yarn, warp_mm=0.5, weft_mm=0.5)
    cloth = design.placed()
    mesh = cloth.mesh(sides=12, subdivisions=3, device="cpu")
    assert mesh.nbytes > 3 << 26, "one chunk holds this"
    known = tmp_path / "known.ply"
    mesh.write(known)
    _, _, triangles, _ = ply(known)
    assert (triangles == mesh.indices).all()
    corners = mesh.yarn_ids[mesh.indices]
    assert (corners == corners[:, :1]).all(), "a triangle has corners of two yarns"


def test_triangles_face_outwards():
    mesh = texere.read("designs/locknit.toml").placed().mesh(device="cpu")
    a, b, c = (mesh.positions[mesh.indices[:, corner]].astype(float) for corner in range(3))
    outward = sum(mesh.normals[mesh.indices[:, corner]] for corner in range(3))
    facing = (np.cross(b - a, c - a) * outward).sum(axis=1)
    assert (facing > 0).mean() > 0.999


def test_ids_and_places_are_those_of_the_yarns():
    """Two straight yarns of lengths that are known."""
    points = [[0, 0, 0], [1, 0, 0], [2, 0, 0], [0, 5, 0], [0, 5, 4]]
    yarns = texere.Yarns.from_arrays(points, 0.25, [0, 3, 5], colors=[[1, 2, 3], [4, 5, 6]])
    mesh = yarns.mesh(sides=8, subdivisions=1, device="cpu")
    first = mesh.positions[:, 1] < 2.5
    assert (mesh.yarn_ids == np.where(first, 0, 1)).all()
    assert np.allclose(mesh.uv[first, 1], mesh.positions[first, 0], atol=1e-6)
    assert np.allclose(mesh.uv[~first, 1], mesh.positions[~first, 2], atol=1e-6)
    assert np.allclose(np.sort(np.unique(mesh.uv[:, 0])), np.arange(8) * np.pi / 4)
    assert np.allclose(mesh.tangents[first], [1, 0, 0])
    assert (mesh.colors[first] == [1, 2, 3]).all() and (mesh.colors[~first] == [4, 5, 6]).all()


def test_devices_agree():
    cloth = texere.read("designs/locknit.toml").placed()
    known = cloth.mesh(device="cpu")
    for device in texere.devices():
        other = cloth.mesh(device=device.name)
        assert np.abs(other.positions - known.positions).max() < 1e-4, device
        assert (other.yarn_ids == known.yarn_ids).all(), device


def test_saved_yarns_are_read_to_the_bit(tmp_path):
    yarns = texere.read("designs/jersey.toml").placed().yarns
    yarns.write(tmp_path / "jersey.yarns")
    again = texere.read_yarns(tmp_path / "jersey.yarns")
    assert again.points.tobytes() == yarns.points.tobytes()
    assert again.halves.tobytes() == yarns.halves.tobytes()
    assert again.offsets.tolist() == yarns.offsets.tolist()
    assert again.names == yarns.names


def test_yarns_from_the_arrays_of_yarns_are_the_same():
    yarns = texere.read("designs/poplin.toml").placed().yarns
    again = texere.Yarns.from_arrays(yarns.points, yarns.halves, yarns.offsets)
    assert again.points.tobytes() == yarns.points.tobytes()
    assert again.halves.tobytes() == yarns.halves.tobytes()
