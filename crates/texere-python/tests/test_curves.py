"""Files of curves, written and read."""

import re

import numpy as np
import pytest
import texere


def test_curves_come_back_to_the_bit(tmp_path):
    rng = np.random.default_rng(5)
    points = rng.normal(0, 1e3, (60, 3)).astype(np.float32)
    yarns = texere.Yarns.from_arrays(points, 0.25, [0, 10, 40, 60], closed=[False, True, False])
    file = tmp_path / "three.bcc"
    yarns.write(file)
    again = texere.read_curves(file, diameter_mm=0.5)
    assert (again.points == points).all() and (again.offsets == [0, 10, 40, 60]).all()
    assert (again.halves == 0.25).all()
    one, other = yarns.mesh(sides=6, device="cpu"), again.mesh(sides=6, device="cpu")
    assert (one.positions == other.positions).all() and (one.indices == other.indices).all()


def test_a_unit_scales_what_is_read(tmp_path):
    file = tmp_path / "one.BCC"
    texere.Yarns.from_arrays([[0, 0, 0], [1, 2, 3]], 0.1).write(file)
    metres = texere.read_curves(file, diameter_mm=2, unit_mm=1000)
    assert metres.points.tolist() == [[0, 0, 0], [1000, 2000, 3000]] and (metres.halves == 1).all()


@pytest.mark.parametrize("ending", ["bcc", "usda", "yarns"])
def test_cloth_and_its_yarns_write_equal_files(ending, tmp_path):
    cloth = texere.read("designs/locknit.toml").placed()
    cloth.write(tmp_path / f"cloth.{ending}")
    cloth.yarns.write(tmp_path / f"yarns.{ending}")
    written = (tmp_path / f"cloth.{ending}").read_bytes()
    assert written == (tmp_path / f"yarns.{ending}").read_bytes() and len(written) > 1000


def test_the_text_of_usd_holds_the_points(tmp_path):
    points = np.random.default_rng(6).normal(0, 1, (20, 3)).astype(np.float32)
    file = tmp_path / "one.usda"
    texere.Yarns.from_arrays(points, 0.1).write(file)
    (listed,) = re.findall(r"point3f\[\] points = \[(.*?)\]", file.read_text(), re.S)
    numbers = np.array(re.findall(r"[-+.\de]+", listed), np.float32).reshape(-1, 3)
    # The curve may have phantom points at its ends.
    inside = (len(numbers) - len(points)) // 2
    assert (numbers[inside : inside + len(points)] == points).all()


def test_what_curves_cannot_hold_is_refused(tmp_path):
    tense = texere.Yarns.from_arrays([[0, 0, 0], [1, 0, 0]], 0.1, tension=0.5)
    with pytest.raises(texere.Error, match="tension"):
        tense.write(tmp_path / "tense.bcc")
    cloth = texere.read("designs/plain.toml").placed()
    for call in (cloth.write, cloth.yarns.write):
        with pytest.raises(texere.Error, match="bcc"):
            call(tmp_path / "cloth.abc")
    assert not list(tmp_path.iterdir())
    file = tmp_path / "hat.bcc"
    file.write_bytes(b"BCC")
    with pytest.raises(texere.Error) as raised:
        texere.read_curves(file, diameter_mm=0.2)
    assert raised.value.file == str(file)
    texere.Yarns.from_arrays([[0, 0, 0], [1, 0, 0]], 0.1).write(file)
    with pytest.raises(texere.Error, match="the diameter of the yarns is missing"):
        texere.read_curves(file)
