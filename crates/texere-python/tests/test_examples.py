"""Each public name has a docstring, and the examples in docstrings run."""

import doctest
import inspect
import pathlib

import numpy as np
import pytest
import texere

ROOT = pathlib.Path(__file__).resolve().parents[3]


def member_of(of, name):
    """A member as the class holds it: getters as such, static methods as functions."""
    member = vars(of)[name]
    return getattr(of, name) if isinstance(member, staticmethod) else member


def public():
    """All public names, with those of the classes."""
    yield "texere", texere
    for name in texere.__all__:
        if name.startswith("__"):
            continue
        value = getattr(texere, name)
        yield name, value
        if inspect.isclass(value) and not issubclass(value, Exception):
            for member, _ in inspect.getmembers(value):
                if not member.startswith("_") and member in vars(value):
                    yield f"{name}.{member}", member_of(value, member)


NAMES = dict(public())


@pytest.mark.parametrize("name", NAMES)
def test_the_docstring_has_an_example_that_runs(name):
    text = inspect.getdoc(NAMES[name])
    assert text, f"{name} has no docstring"
    examples = doctest.DocTestParser().get_doctest(text, {"texere": texere, "np": np}, name, None, 0)
    assert examples.examples, f"{name} has no example"
    said = []
    runner = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS)
    runner.run(examples, out=said.append, clear_globs=True)
    assert not runner.failures, "".join(said)


def test_a_getter_or_a_call_of_arrays_says_whether_it_copies():
    for name, value in NAMES.items():
        text = inspect.getdoc(value) or ""
        if "shape (" in text and name not in ("texere",):
            assert "opies" in text or "opied" in text or "copy" in text, name


def test_the_modules_names_are_public():
    hidden = {name for name in dir(texere._texere) if not name.startswith("_")}
    assert hidden <= set(texere.__all__), "the package takes over all that the module has"
