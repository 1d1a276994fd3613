"""The code in docs/PYTHON.md runs, from one block to the next."""

import pathlib
import re

import texere

PAGE = pathlib.Path(__file__).resolve().parents[3] / "docs" / "PYTHON.md"


def test_the_code_of_the_page_runs(tmp_path):
    blocks = re.findall(r"```python\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.S)
    assert len(blocks) == 2
    names = {}
    for block in blocks:
        exec(block.replace('"poplin.glb"', repr(str(tmp_path / "poplin.glb"))), names)
    assert (tmp_path / "poplin.glb").read_bytes().startswith(b"glTF")
    assert names["picture"].shape == (600, 800, 3)
    for name in ("twill", "rib", "locknit"):
        assert len(names[name].placed().mesh(device="cpu").indices) > 1000


def test_the_page_names_what_there_is():
    for code in re.findall(r"`([^`\n]+)`", PAGE.read_text(encoding="utf-8")):
        for owner, member in re.findall(r"\b(texere|cloth|mesh|design|Yarns)\.(\w+)", code):
            of = {"texere": texere, "cloth": texere.Cloth, "mesh": texere.Mesh, "design": texere.Design}
            assert hasattr(of.get(owner, texere.Yarns), member), code
