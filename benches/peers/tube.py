"""Times the making of tubes round the polylines in FOLDER.

`tube.py FOLDER vtk|vtk-triangles|numpy ROUNDS` runs VTK's tube filter, the same filter with its
result cut into triangles, or a vectorised numpy tube.
"""

import resource
import sys
import time

import numpy as np

SIDES = 6
RADIUS = 0.125


def vtk_tube(points, offsets, triangles):
    import vtk
    from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray

    data = vtk.vtkPolyData()
    vertices = vtk.vtkPoints()
    vertices.SetData(numpy_to_vtk(points))
    data.SetPoints(vertices)
    lines = vtk.vtkCellArray()
    ids = np.arange(len(points), dtype=np.int64)
    lines.SetData(numpy_to_vtkIdTypeArray(offsets.astype(np.int64), deep=1), numpy_to_vtkIdTypeArray(ids, deep=1))
    data.SetLines(lines)

    def run():
        tube = vtk.vtkTubeFilter()
        tube.SetInputData(data)
        tube.SetRadius(RADIUS)
        tube.SetNumberOfSides(SIDES)
        last = tube
        if triangles:
            last = vtk.vtkTriangleFilter()
            last.SetInputConnection(tube.GetOutputPort())
        last.Update()
        return last.GetOutput()

    return run


def numpy_tube(points, offsets):
    starts, ends = offsets[:-1].astype(np.int64), offsets[1:].astype(np.int64) - 1
    angles = np.arange(SIDES) * (2 * np.pi / SIDES)
    circle = np.stack([np.cos(angles), np.sin(angles)], axis=1).astype(np.float32)
    sides = np.arange(SIDES, dtype=np.uint32)
    following = (sides + 1) % SIDES
    quad = np.stack([sides, following, sides + SIDES, following, following + SIDES, sides + SIDES], axis=1).ravel()

    def run():
        tangent = np.empty_like(points)
        tangent[1:-1] = points[2:] - points[:-2]
        tangent[starts] = points[starts + 1] - points[starts]
        tangent[ends] = points[ends] - points[ends - 1]
        tangent /= np.linalg.norm(tangent, axis=1, keepdims=True)
        side = np.stack([-tangent[:, 1], tangent[:, 0], np.zeros(len(points), np.float32)], axis=1)
        side /= np.linalg.norm(side, axis=1, keepdims=True)
        up = np.cross(tangent, side)
        normals = circle[:, 0, None] * side[:, None] + circle[:, 1, None] * up[:, None]
        vertices = points[:, None] + np.float32(RADIUS) * normals
        gaps = np.ones(len(points), bool)
        gaps[ends] = False
        rings = np.nonzero(gaps)[0].astype(np.uint32)
        indices = rings[:, None] * np.uint32(SIDES) + quad
        return vertices, normals, indices

    return run


def main():
    folder, tool, rounds = sys.argv[1], sys.argv[2], int(sys.argv[3])
    points = np.fromfile(f"{folder}/points.f32", "<f4").reshape(-1, 3)
    offsets = np.fromfile(f"{folder}/offsets.u64", "<u8")
    run = numpy_tube(points, offsets) if tool == "numpy" else vtk_tube(points, offsets, tool == "vtk-triangles")
    times = []
    for _ in range(rounds):
        start = time.perf_counter()
        run()
        times.append(time.perf_counter() - start)
    triangles = (len(points) - (len(offsets) - 1)) * 2 * SIDES
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(f"{tool}: {triangles / np.median(times) / 1e6:.1f} M triangles/s, allocation included; peak {peak:.0f} MiB")


main()
