"""The stubs are those of the module, and the examples in docstrings have the types that they say."""

import doctest
import inspect
import json
import subprocess
import sys
import textwrap

import pytest
import texere

from test_examples import NAMES, ROOT


def run(*args):
    done = subprocess.run([sys.executable, *args], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr


def test_the_stubs_are_those_of_the_module(tmp_path):
    # PyO3 gives the module of Rust an `__all__`, which is not in the stubs.
    allowed = tmp_path / "allowed"
    allowed.write_text("texere._texere.__all__\n")
    run("-m", "mypy.stubtest", "texere", "--allowlist", str(allowed), "--ignore-unused-allowlist")


def test_examples_are_strictly_typed(tmp_path):
    lines = ["import numpy as np", "import texere", ""]
    for number, value in enumerate(NAMES.values()):
        lines.append(f"def example_{number}() -> None:")
        for example in doctest.DocTestParser().get_examples(inspect.getdoc(value)):
            lines.append(textwrap.indent(example.source, "    "))
    assert len(lines) > 200
    examples = tmp_path / "examples.py"
    examples.write_text("\n".join(lines))
    run("-m", "mypy", "--strict", "--cache-dir", str(tmp_path / "cache"), str(examples))


def test_a_wrong_type_is_seen(tmp_path):
    wrong = tmp_path / "wrong.py"
    wrong.write_text("import texere\nsides: str = texere.read('a').placed().mesh().nbytes\n")
    done = subprocess.run(
        [sys.executable, "-m", "mypy", "--strict", "--cache-dir", str(tmp_path / "cache"), str(wrong)],
        capture_output=True,
        text=True,
    )
    assert done.returncode == 1 and "assignment" in done.stdout


NOTEBOOKS = sorted((ROOT / "docs" / "notebooks").glob("*.ipynb"))


@pytest.mark.parametrize("notebook", NOTEBOOKS, ids=[path.stem for path in NOTEBOOKS])
def test_notebooks_are_strictly_typed(notebook, tmp_path):
    cells = json.loads(notebook.read_text(encoding="utf-8"))["cells"]
    code = ["".join(cell["source"]) for cell in cells if cell["cell_type"] == "code"]
    assert "import texere" in code[0] and len(code) > 4
    module = tmp_path / f"{notebook.stem}.py"
    module.write_text("\n\n".join(code), encoding="utf-8")
    run("-m", "mypy", "--strict", "--cache-dir", str(tmp_path / "cache"), str(module))


def test_there_are_notebooks():
    assert len(NOTEBOOKS) == 2
