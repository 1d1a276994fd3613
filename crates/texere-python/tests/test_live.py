"""Changes of edited cloth against its whole mesh, which a session makes anew."""

import numpy as np
import pytest
import texere


def devices():
    return [device.name for device in texere.devices()]


def split(values, mesh):
    """The values of each yarn's vertices."""
    return [values[mesh.yarn_ids == yarn] for yarn in range(int(mesh.yarn_ids.max()) + 1)]


def follow(live, positions, normals):
    """Takes over what has changed, and returns the number of vertices, or None for everything."""
    changes = live.changes()
    if changes is None:
        return None
    for change in changes:
        assert change.positions.base is not None and not change.positions.flags.writeable
        for all, new in ((positions, change.positions), (normals, change.normals)):
            own = np.full((change.count, 3), np.nan, np.float32)
            kept = min(len(own), len(all[change.yarn]))
            own[:kept] = all[change.yarn][:kept]
            own[change.vertices] = new
            all[change.yarn] = own
    return sum(len(change.positions) for change in changes)


@pytest.mark.parametrize("device", devices())
def test_changes_lead_to_the_mesh(device):
    cloth = texere.read("designs/plain.toml").placed()
    live = cloth.edit(device=device)
    mesh = live.mesh()
    positions, normals = split(mesh.positions, mesh), split(mesh.normals, mesh)
    assert follow(live, positions, normals) is None
    assert follow(live, positions, normals) == 0
    rng = np.random.default_rng(7)
    offsets = cloth.yarns.offsets.astype(int)
    changed = 0
    for edit in range(12):
        if edit % 3:
            live.set_lift(int(rng.integers(64)), int(rng.integers(48)), bool(rng.integers(2)))
        else:
            yarn = int(rng.integers(112))
            points = live.yarns().points[offsets[yarn] : offsets[yarn + 1]]
            live.set_points(yarn, points + rng.normal(0, 0.01, points.shape))
        changed += follow(live, positions, normals)
        whole = live.mesh()
        assert (np.concatenate(positions) == whole.positions).all()
        assert (np.concatenate(normals) == whole.normals).all()
    assert 0 < changed < len(mesh.positions)


def test_a_yarn_that_outgrows_its_room_changes_everything():
    live = texere.read("designs/plain.toml").placed().edit(device="cpu")
    assert live.changes() is None
    long = np.stack([np.arange(5000), np.zeros(5000), np.ones(5000)], axis=1) / 100
    live.set_points(0, long, 0.1)
    assert live.changes() is None and live.changes() == []
    live.set_points(0, long[:4000], 0.1)
    changes = live.changes()
    mesh = live.mesh()
    own = (mesh.yarn_ids == 0).sum()
    assert {(change.yarn, change.count) for change in changes} == {(0, own)}


def test_an_edit_that_bends_sharply_keeps_the_rings():
    """The mesh keeps the rings of the cloth before the edit, even if others would suit it now."""
    yarn = texere.Yarn(tex=30, twist_per_m=900)
    cloth = texere.woven(texere.weave("plain", 6, 6), yarn, yarn, warp_mm=0.5, weft_mm=0.5).placed()
    live = cloth.edit(device="cpu")
    assert live.changes() is None
    points = cloth.yarns.points[: int(cloth.yarns.offsets[1])]
    live.set_points(0, points * [1, 9, 1])
    (change,) = live.changes()
    assert change.yarn == 0
    assert (live.mesh().positions[: change.count][change.vertices] == change.positions).all()


def test_a_bump_changes_its_yarn_alone():
    cloth = texere.read("designs/plain.toml").placed()
    live = cloth.edit(device="cpu")
    assert live.changes() is None
    offsets = cloth.yarns.offsets.astype(int)
    points = cloth.yarns.points[offsets[40] : offsets[41]].copy()
    before = cloth.mesh(device="cpu")
    points[len(points) // 2, 2] += 0.1
    live.set_points(40, points)
    after = live.mesh()
    own = after.yarn_ids == 40
    moved = np.flatnonzero((before.positions != after.positions).any(axis=1)[own])
    changes = live.changes()
    assert {change.yarn for change in changes} == {40}
    covered = np.concatenate([np.arange(own.sum())[change.vertices] for change in changes])
    assert set(moved) <= set(covered) and len(moved) > 0
    for change in changes:
        assert (after.positions[own][change.vertices] == change.positions).all()
