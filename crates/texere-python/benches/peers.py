"""The time from a definition to a mesh, beside other packages, in one run.

    pip install texere pytexgen trimesh shapely mapbox_earcut pyvista
    python crates/texere-python/benches/peers.py 10 20 40

The cloth is a plain weave of N ends and N picks, round yarns of 0.2 mm, 0.5 mm apart. texere and
TexGen make its mesh from the definition. trimesh and pyvista make tubes round texere's centrelines,
sampled as texere samples them, so their time is that of the meshing alone. Prints a row for each
package: the best of several runs, seconds; triangles; millions of triangles a second.
"""

import contextlib
import os
import sys
import time

import numpy as np
import pytexgen
import pyvista
import shapely
import trimesh

import texere

SIDES = 12
SUBDIVISIONS = 8
DIAMETER, PITCH = 0.2, 0.5
# A run that takes longer than this is not repeated, seconds.
LONG = 2.0


def best(make):
    """The least time of five runs, and what the last run made."""
    least, made = float("inf"), None
    for _ in range(5):
        start = time.perf_counter()
        made = make()
        least = min(least, time.perf_counter() - start)
        if least > LONG:
            break
    return least, made


def by_texere(count):
    yarn = texere.Yarn(diameter_mm=DIAMETER)
    drawdown = texere.weave("plain", count, count)
    design = texere.woven(drawdown, yarn, yarn, warp_mm=PITCH, weft_mm=PITCH)
    return design.placed().mesh(sides=SIDES, subdivisions=SUBDIVISIONS, device="cpu")


@contextlib.contextmanager
def silent():
    """Drops what the process writes to its standard output: TexGen writes a line for each yarn."""
    kept, null = os.dup(1), os.open(os.devnull, os.O_WRONLY)
    os.dup2(null, 1)
    try:
        yield
    finally:
        os.dup2(kept, 1)
        os.close(kept)
        os.close(null)


def by_texgen(count):
    weave = pytexgen.CTextileWeave2D(count, count, PITCH, 2 * DIAMETER)
    for end in range(count):
        for pick in range(count):
            if (end + pick) % 2:
                weave.SwapPosition(end, pick)
    weave.SetYarnWidths(DIAMETER)
    weave.SetYarnHeights(DIAMETER)
    weave.SetResolution(SIDES)
    mesh = pytexgen.CMesh()
    weave.AddSurfaceToMesh(mesh)
    return mesh


def centrelines(mesh):
    """The middles of the rings of each yarn."""
    rings = mesh.positions.reshape(-1, SIDES, 3).mean(axis=1)
    yarns = mesh.yarn_ids[::SIDES]
    return [rings[yarns == yarn] for yarn in range(int(yarns.max()) + 1)]


def by_trimesh(lines):
    circle = shapely.Point(0, 0).buffer(DIAMETER / 2, quad_segs=SIDES // 4)
    tubes = [trimesh.creation.sweep_polygon(circle, line, cap=False) for line in lines]
    return trimesh.util.concatenate(tubes)


def by_pyvista(lines):
    tubes = pyvista.MultiBlock()
    for line in lines:
        poly = pyvista.lines_from_points(line.astype(np.float64))
        tubes.append(poly.tube(radius=DIAMETER / 2, n_sides=SIDES, capping=False).triangulate())
    return tubes.combine(merge_points=False)


def main():
    print("| cloth | package | s | triangles | million a second |")
    print("|---|---|---|---|---|")
    for count in map(int, sys.argv[1:] or ["10", "20", "40"]):
        seconds, mesh = best(lambda: by_texere(count))
        lines = centrelines(mesh)
        rows = [("texere, definition to mesh", seconds, len(mesh.indices))]
        with silent():
            seconds, made = best(lambda: by_texgen(count))
            triangles = made.GetNumElements(pytexgen.CMesh.TRI) + 2 * made.GetNumElements(pytexgen.CMesh.QUAD)
        rows.append(("TexGen, definition to mesh", seconds, triangles))
        seconds, made = best(lambda: by_pyvista(lines))
        rows.append(("pyvista, centrelines to tubes", seconds, made.n_cells))
        seconds, made = best(lambda: by_trimesh(lines))
        rows.append(("trimesh, centrelines to tubes", seconds, len(made.faces)))
        for package, seconds, triangles in rows:
            print(f"| {count} × {count} | {package} | {seconds:.4f} | {triangles} | {triangles / seconds / 1e6:.3f} |")
        sys.stdout.flush()


if __name__ == "__main__":
    main()
