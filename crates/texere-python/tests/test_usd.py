"""Curves as USD, opened by Pixar's usd-core."""

import numpy
import pytest
import texere
from pxr import Gf, Usd, UsdGeom


def spline_length(points, steps=64):
    """Length of the Catmull-Rom spline of a curve's vertices. The spline runs from the second vertex to the last
    but one."""
    t = numpy.linspace(0.0, 1.0, steps + 1)[:, None]
    length = 0.0
    for a, b, c, d in zip(points, points[1:], points[2:], points[3:]):
        at = b + 0.5 * t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a)))
        length += numpy.linalg.norm(numpy.diff(at, axis=0), axis=1).sum()
    return length


def curves_of(path):
    """The curves of all prims of a stage."""
    stage = Usd.Stage.Open(str(path))
    assert UsdGeom.GetStageMetersPerUnit(stage) == 0.001
    assert UsdGeom.GetStageUpAxis(stage) == UsdGeom.Tokens.z
    assert stage.GetDefaultPrim().IsValid()
    # The generator keeps the stage open until the last value has been taken.
    yield from (UsdGeom.BasisCurves(prim) for prim in stage.Traverse() if prim.IsA(UsdGeom.BasisCurves))


@pytest.mark.parametrize("design", ["two-ply", "jersey", "locknit", "tartan"])
def test_a_stage_holds_the_yarns(tmp_path, design):
    yarns = texere.read(f"designs/{design}.toml").placed().yarns
    path = tmp_path / "cloth.usda"
    yarns.write(path)
    ours, halves = (numpy.split(each, yarns.offsets[1:-1].astype(int)) for each in (yarns.points, yarns.halves))
    seen = []
    for curves in curves_of(path):
        assert curves.GetTypeAttr().Get() == UsdGeom.Tokens.cubic
        assert curves.GetBasisAttr().Get() == UsdGeom.Tokens.catmullRom
        assert curves.GetWrapAttr().Get() == UsdGeom.Tokens.nonperiodic
        assert curves.GetWidthsInterpolation() == UsdGeom.Tokens.vertex
        assert len(curves.GetDisplayColorAttr().Get()) == 1
        counts = numpy.array(curves.GetCurveVertexCountsAttr().Get())
        points = numpy.split(numpy.array(curves.GetPointsAttr().Get()), numpy.cumsum(counts)[:-1])
        # The first and the last point are there twice.
        assert all(numpy.array_equal(own[0], own[1]) and numpy.array_equal(own[-1], own[-2]) for own in points)
        widths = numpy.split(numpy.array(curves.GetWidthsAttr().Get()), numpy.cumsum(counts)[:-1])
        low, high = numpy.array(curves.GetExtentAttr().Get())
        for yarn, own, width in zip(curves.GetPrim().GetAttribute("primvars:yarn").Get(), points, widths):
            assert numpy.array_equal(own[1:-1], ours[yarn])
            # A flat yarn is drawn as a round one of the same area.
            area = halves[yarn].astype(numpy.float64).prod(axis=1)
            assert numpy.allclose(width[1:-1], 2.0 * numpy.sqrt(area), rtol=1e-6)
            assert width[0] == width[1] and width[-1] == width[-2]
            within = width.min() / 2.0 - 1e-6
            assert (own[1:-1] >= low + within).all() and (own[1:-1] <= high - within).all()
            seen.append(yarn)
    assert sorted(seen) == list(range(len(yarns)))


def test_linear_curves_run_through_the_control_points(tmp_path):
    cloth = texere.read("designs/jersey.toml").placed()
    by_yarns, by_cloth = tmp_path / "yarns.usda", tmp_path / "cloth.usda"
    cloth.yarns.write(by_yarns, linear=True)
    cloth.write(by_cloth, linear=True)
    assert by_yarns.read_bytes() == by_cloth.read_bytes()
    ours = numpy.split(cloth.yarns.points, cloth.yarns.offsets[1:-1].astype(int))
    for curves in curves_of(by_cloth):
        assert curves.GetTypeAttr().Get() == UsdGeom.Tokens.linear
        counts = numpy.array(curves.GetCurveVertexCountsAttr().Get())
        assert len(curves.GetWidthsAttr().Get()) == counts.sum()
        prim = curves.GetPrim()
        assert {"PhysicsCurvesDeformableSimAPI", "PhysicsCollisionAPI"} <= set(prim.GetPrimTypeInfo().GetAppliedAPISchemas())
        thickness = prim.GetAttribute("physics:thicknesses").Get()
        assert numpy.array_equal(thickness, curves.GetWidthsAttr().Get())
        masses = prim.GetAttribute("physics:masses").Get()
        assert len(masses) == len(counts)
        points = numpy.split(numpy.array(curves.GetPointsAttr().Get()), numpy.cumsum(counts)[:-1])
        for yarn, own in zip(curves.GetPrim().GetAttribute("primvars:yarn").Get(), points):
            assert numpy.array_equal(own, ours[yarn])
        # 20 tex: 20 milligrams a metre.
        lengths = [numpy.linalg.norm(numpy.diff(own, axis=0), axis=1).sum() for own in points]
        assert numpy.allclose(masses, 20e-6 * numpy.array(lengths) / 1000.0, rtol=1e-5)
    for name in ["cloth.bcc", "cloth.yarns", "cloth.glb"]:
        with pytest.raises(texere.Error):
            cloth.write(tmp_path / name, linear=True)
        if name != "cloth.glb":
            with pytest.raises(texere.Error):
                cloth.yarns.write(tmp_path / name, linear=True)
    with pytest.raises(ValueError):
        cloth.write(tmp_path / "both.usda", linear=True, packed=True)
    assert len(list(tmp_path.iterdir())) == 2


def test_curves_are_as_long_as_their_yarns(tmp_path):
    # A helix, whose length is known.
    radius, pitch, turns = 2.0, 1.5, 5
    angles = numpy.linspace(0.0, 2.0 * numpy.pi * turns, 40 * turns + 1)
    points = [radius * numpy.cos(angles), radius * numpy.sin(angles), pitch * angles / (2.0 * numpy.pi)]
    path = tmp_path / "helix.usda"
    texere.Yarns.from_arrays(numpy.transpose(points), 0.1).write(path)
    [length] = [spline_length(numpy.array(curves.GetPointsAttr().Get())) for curves in curves_of(path)]
    assert abs(length / (turns * numpy.hypot(2.0 * numpy.pi * radius, pitch)) - 1.0) < 1e-4


@pytest.mark.parametrize("seed", range(12))
def test_curves_lie_where_pixar_places_them(tmp_path, seed):
    """Random stages of usd-core: each point of a linear curve lies where usd-core's own matrices take it, in mm and with
    z up. Its diameter grows by the cube root of the volume's growth."""
    random = numpy.random.default_rng(seed)
    path = tmp_path / "cloth.usda"
    stage = Usd.Stage.CreateNew(str(path))
    axis = (UsdGeom.Tokens.y, UsdGeom.Tokens.z)[seed % 2]
    UsdGeom.SetStageUpAxis(stage, axis)
    metres = random.choice([0.001, 0.01, 1.0])
    UsdGeom.SetStageMetersPerUnit(stage, metres)
    expected, widths, place = [], [], ""
    for level in range(3):
        place += f"/level_{level}"
        xform = UsdGeom.Xform.Define(stage, place)
        pivot = Gf.Vec3d(*random.normal(size=3))
        xform.AddTranslateOp(opSuffix="pivot").Set(pivot)
        turns = ["XYZ", "XZY", "YXZ", "YZX", "ZXY", "ZYX"]
        getattr(xform, f"AddRotate{turns[random.integers(6)]}Op")().Set(Gf.Vec3f(*random.uniform(-180, 180, 3)))
        xform.AddScaleOp().Set(Gf.Vec3f(*random.uniform(0.5, 2.0, 3)))
        xform.AddRotateYOp(opSuffix="more").Set(float(random.uniform(-90, 90)))
        xform.AddOrientOp().Set(Gf.Quatf(*random.normal(size=4)).GetNormalized())
        xform.AddTranslateOp(opSuffix="pivot", isInverseOp=True)
        xform.AddTransformOp().Set(Gf.Matrix4d(Gf.Rotation(Gf.Vec3d(1, 2, 3), 40), Gf.Vec3d(*random.normal(size=3))))
        if level == 2 and seed % 3 == 0:
            xform.SetResetXformStack(True)
        curves = UsdGeom.BasisCurves.Define(stage, place + "/lines")
        own = random.normal(size=(5, 3)).astype(numpy.float32)
        curves.CreateTypeAttr(UsdGeom.Tokens.linear)
        curves.CreateCurveVertexCountsAttr([3, 2])
        curves.CreatePointsAttr(own)
        curves.CreateWidthsAttr([0.25])
        matrix = numpy.array(UsdGeom.Xformable(curves).ComputeLocalToWorldTransform(Usd.TimeCode.Default()))
        world = numpy.hstack([own, numpy.ones((5, 1))]) @ matrix[:, :3] * metres * 1000.0
        expected.append(world if axis == UsdGeom.Tokens.z else world @ [[1, 0, 0], [0, 0, 1], [0, -1, 0]])
        growth = numpy.cbrt(abs(numpy.linalg.det(matrix[:3, :3]))) * metres * 1000.0
        widths.append(numpy.full(5, 0.25 * growth))
    stage.GetRootLayer().Save()
    yarns = texere.read_curves(path)
    expected = numpy.concatenate(expected)
    assert numpy.allclose(yarns.points, expected, rtol=1e-5, atol=1e-5 * abs(expected).max())
    # Diameters are kept in half precision.
    assert numpy.allclose(2.0 * yarns.halves[:, 0], numpy.concatenate(widths), rtol=1e-3)
    assert list(yarns.offsets) == [0, 3, 5, 8, 10, 13, 15]


@pytest.mark.parametrize("design", ["two-ply", "jersey", "locknit", "tartan"])
def test_yarns_come_back(tmp_path, design):
    """Files that texere wrote, and files that usd-core made of them in its own layout."""
    yarns = texere.read(f"designs/{design}.toml").placed().yarns
    yarns.write(tmp_path / "own.usda")
    Usd.Stage.Open(str(tmp_path / "own.usda")).Export(str(tmp_path / "pixar.usda"))
    for name in ["own.usda", "pixar.usda"]:
        again = texere.read_curves(tmp_path / name)
        assert numpy.array_equal(again.points, yarns.points)
        assert numpy.array_equal(again.offsets, yarns.offsets)
    Usd.Stage.Open(str(tmp_path / "own.usda")).Export(str(tmp_path / "cloth.usdc"))
    with pytest.raises(texere.Error, match="the text form"):
        texere.read_curves(tmp_path / "cloth.usdc")


@pytest.mark.parametrize("design", ["two-ply", "jersey", "locknit"])
@pytest.mark.parametrize("caps", [False, True])
def test_a_stage_of_meshes_holds_our_triangles(tmp_path, design, caps):
    mesh = texere.read(f"designs/{design}.toml").placed().mesh(sides=6, caps=caps, device="cpu")
    path = tmp_path / "mesh.usda"
    mesh.write(path)
    stage = Usd.Stage.Open(str(path))
    assert UsdGeom.GetStageMetersPerUnit(stage) == 0.001
    assert UsdGeom.GetStageUpAxis(stage) == UsdGeom.Tokens.z
    theirs = []
    for number, prim in enumerate(prim for prim in stage.Traverse() if prim.IsA(UsdGeom.Mesh)):
        yarn = UsdGeom.Mesh(prim)
        counts = numpy.array(yarn.GetFaceVertexCountsAttr().Get())
        corners = numpy.array(yarn.GetFaceVertexIndicesAttr().Get()).reshape(-1, 3)
        assert (counts == 3).all() and len(counts) == len(corners)
        assert UsdGeom.Mesh.ValidateTopology(corners.ravel().tolist(), counts.tolist(), int(corners.max()) + 1)[0]
        points, normals = (numpy.array(each.Get()) for each in (yarn.GetPointsAttr(), yarn.GetNormalsAttr()))
        assert yarn.GetNormalsInterpolation() == UsdGeom.Tokens.vertex
        assert yarn.GetSubdivisionSchemeAttr().Get() == UsdGeom.Tokens.none
        assert len(yarn.GetDisplayColorAttr().Get()) == 1
        assert numpy.array_equal(yarn.GetExtentAttr().Get(), UsdGeom.PointBased.ComputeExtent(yarn.GetPointsAttr().Get()))
        assert prim.GetAttribute("primvars:yarn").Get() == number
        theirs.append(numpy.concatenate([points, normals], axis=1)[corners].reshape(-1, 18))
    theirs = numpy.concatenate(theirs)
    ours = numpy.concatenate([mesh.positions, mesh.normals], axis=1)[mesh.indices].reshape(-1, 18)
    ours, theirs = (rows[numpy.lexsort(rows.T)] for rows in (ours, theirs))
    assert numpy.array_equal(ours, theirs)


def test_a_stage_holds_meshes_or_curves(tmp_path):
    cloth = texere.read("designs/plain.toml").placed()
    cloth.write(tmp_path / "curves.usda", device="cpu")
    cloth.write(tmp_path / "mesh.usda", triangles=True, attributes=["uv", "tangent", "yarn"], device="cpu")
    curves, meshes = (Usd.Stage.Open(str(tmp_path / name)) for name in ("curves.usda", "mesh.usda"))
    kinds = [{prim.GetTypeName() for prim in stage.Traverse()} for stage in (curves, meshes)]
    assert kinds == [{"Xform", "BasisCurves"}, {"Xform", "Mesh"}]
    for prim in meshes.Traverse():
        if not prim.IsA(UsdGeom.Mesh):
            continue
        primvars = UsdGeom.PrimvarsAPI(prim)
        vertices = len(UsdGeom.Mesh(prim).GetPointsAttr().Get())
        for name in ("st", "tangents"):
            primvar = primvars.GetPrimvar(name)
            assert primvar.GetInterpolation() == UsdGeom.Tokens.vertex and len(primvar.Get()) == vertices
        turns = numpy.array(primvars.GetPrimvar("st").Get())[:, 0]
        assert turns.min() == 0.0 and turns.max() == 1.0
    for name in ("cloth.bcc", "cloth.yarns"):
        with pytest.raises(texere.Error, match="holds no triangles"):
            cloth.write(tmp_path / name, triangles=True, device="cpu")
    with pytest.raises(texere.Error, match="curves can't hold attributes"):
        cloth.write(tmp_path / "cloth.usda", attributes=["uv"], device="cpu")
    with pytest.raises(texere.Error, match="straight lines"):
        cloth.write(tmp_path / "both.usda", triangles=True, linear=True, device="cpu")
    assert len(list(tmp_path.iterdir())) == 2
