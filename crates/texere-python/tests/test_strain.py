"""Knits that are strained."""

import numpy as np
import pytest
import texere


@pytest.mark.parametrize("along, axis", [("courses", 0), ("wales", 1)])
def test_work_is_stored(along, axis):
    """The work of the force is the energy that is stored."""
    test = texere.read("designs/jersey.toml").test(along, np.linspace(0.02, 0.3, 15), progress=False)
    assert test.along == along
    assert test.balanced.all()
    strain, force = test.strain, test.force
    assert np.allclose(strain[:, axis], np.linspace(0, 0.3, 16), atol=1e-6)
    # The other way is free: the cloth gets narrower, and nothing pulls.
    assert (np.diff(strain[:, 1 - axis]) < 0).all()
    assert (abs(force[:, 1 - axis]) < 0.01 * force[-1, axis]).all()
    # Force per width, times the width that is left of each mm at rest.
    pull = force[:, axis] * (1 + strain[:, 1 - axis])
    work = np.concatenate([[0], np.cumsum((pull[1:] + pull[:-1]) / 2 * np.diff(strain[:, axis]))])
    assert np.allclose(work, test.energy, rtol=0.02, atol=0.002 * test.energy[-1])


def test_energy_gives_a_knit_its_gauge():
    """Rest by energy forgets the gauge of the design, on any device; rest by contact keeps it."""
    rib = texere.read("designs/rib.toml")
    placed = rib.size_mm[0]
    by_energy = rib.finished(rest="energy").rest(progress=False)
    assert by_energy.is_at_rest
    points = by_energy.yarns.points
    assert np.ptp(points[:, 0]) < 0.8 * placed
    clear = rib.finished(rest="clear").rest(device="cpu", progress=False)
    assert np.ptp(clear.yarns.points[:, 0]) > 0.9 * placed


def test_refusals():
    jersey, woven = (texere.read(f"designs/{name}.toml") for name in ("jersey", "plain"))
    with pytest.raises(ValueError, match="expected courses, wales or both"):
        jersey.test("bias")
    with pytest.raises(ValueError, match="shape"):
        jersey.test("wales", [[0.1]])
    for strains in ([0.2, 0.1], [9.0], [float("nan")]):
        with pytest.raises(texere.Error, match="strain"):
            jersey.test("wales", strains)
    with pytest.raises(texere.Error):
        woven.test()
    with pytest.raises(ValueError, match="those of a knit"):
        woven.finished(rest="energy")
    with pytest.raises(ValueError, match="no press"):
        jersey.finished(rest="energy", press_mm=0.4)
    with pytest.raises(ValueError, match="neither"):
        jersey.finished(rest="tense")
    with pytest.raises(ValueError, match="hold is 'bias'"):
        jersey.finished(rest="energy", hold="bias")
    with pytest.raises(ValueError, match="can be held"):
        jersey.finished(hold="wales")
    with pytest.raises(ValueError, match="those of a knit"):
        woven.finished(hold="wales")


def test_a_held_knit_keeps_its_size():
    rib = texere.read("designs/rib.toml").finished(rest="energy", hold="courses")
    held = rib.rest(progress=False)
    assert held.is_at_rest
    assert np.ptp(held.yarns.points[:, 0]) > 0.9 * rib.size_mm[0]
    free = rib.finished(rest="clear").finished(rest="energy").rest(progress=False)
    assert np.ptp(free.yarns.points[:, 0]) < 0.8 * rib.size_mm[0]


def test_a_test_can_be_cancelled():
    class Enough(Exception):
        pass

    def stop(share):
        raise Enough

    cable = texere.read("designs/cable.toml")
    with pytest.raises(Enough):
        cable.test("courses", progress=stop)
