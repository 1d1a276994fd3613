"""Arrays own nothing, cannot be written, and keep alive what they show."""

import gc
import pathlib
import random
import subprocess
import sys
import textwrap
import threading

import numpy as np
import pytest
import texere


def small():
    """A cloth of a few hundred control points, placed."""
    yarn = texere.Yarn(diameter_mm=0.2)
    return texere.woven(texere.weave("2/2", 5, 4), yarn, yarn, warp_mm=0.5, weft_mm=0.6).placed()


VIEWS = {
    "mesh": ["positions", "normals", "indices", "yarn_ids", "uv", "tangents"],
    "yarns": ["points", "halves", "offsets"],
}


@pytest.mark.parametrize("owner, name", [(owner, name) for owner, names in VIEWS.items() for name in names])
def test_an_array_is_a_view_that_owns_nothing(owner, name):
    cloth = small()
    made = cloth.mesh(device="cpu") if owner == "mesh" else cloth.yarns
    one, other = getattr(made, name), getattr(made, name)
    assert np.shares_memory(one, other) and not one.flags.owndata
    base = one
    while isinstance(base, np.ndarray):
        base = base.base
    assert base is made
    with pytest.raises(ValueError):
        one[...] = 0
    with pytest.raises(ValueError):
        one.flags.writeable = True
    copy = one.copy()
    del made, other, base, cloth
    gc.collect()
    assert (one == copy).all()


def test_positions_and_normals_lie_side_by_side():
    mesh = small().mesh(device="cpu")
    assert mesh.normals.ctypes.data - mesh.positions.ctypes.data == 12


def test_dlpack_shares_the_memory():
    mesh = small().mesh(device="cpu")
    for name in VIEWS["mesh"]:
        array = getattr(mesh, name)
        other = np.from_dlpack(array)
        assert np.shares_memory(array, other) and not other.flags.writeable
        assert array.__dlpack_device__() == (1, 0)


def test_cloths_of_the_same_yarns_share_them():
    cloth = small()
    assert np.shares_memory(cloth.yarns.points, cloth.yarns.points)
    mesh = cloth.mesh(device="cpu")
    copies = texere.Yarns.from_arrays(cloth.yarns.points, cloth.yarns.halves, cloth.yarns.offsets)
    assert not np.shares_memory(copies.points, cloth.yarns.points)
    assert copies.mesh(device="cpu").positions.tobytes() == mesh.positions.tobytes()


@pytest.mark.skipif(not pathlib.Path("/proc/self/clear_refs").exists(), reason="the peak is read in /proc")
def test_arrays_take_no_memory():
    """The peak of memory while large arrays are taken and read, in a process of its own."""
    program = textwrap.dedent("""
        import re, numpy, texere
        def peak(name):
            return int(re.search(name + r":\\s*(\\d+)", open("/proc/self/status").read())[1]) * 1024
        yarn = texere.Yarn(diameter_mm=0.2)
        design = texere.woven(texere.weave("2/2", 300, 300), yarn, yarn, warp_mm=0.5, weft_mm=0.5)
        cloth = design.placed()
        open("/proc/self/clear_refs", "w").write("5")
        before = peak("VmRSS")
        mesh = cloth.mesh(sides=12, device="cpu")
        made = peak("VmHWM") - before
        assert made < 1.15 * mesh.nbytes, (made, mesh.nbytes)
        arrays = [mesh.positions, mesh.normals, mesh.indices, cloth.yarns.points]
        open("/proc/self/clear_refs", "w").write("5")
        before = peak("VmRSS")
        for array in arrays:
            for first in range(0, len(array), 65536):
                array[first : first + 65536].max()
        taken = peak("VmHWM") - before
        assert mesh.nbytes > 100e6
        assert taken < 0.02 * mesh.nbytes, (taken, mesh.nbytes)
    """)
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


def known(make):
    """An array, and what it has to hold whatever is freed."""
    array = make()
    return array, array.copy()


def sequence(seed):
    """Makes objects and arrays and frees them in random order, and looks at what is left."""
    rng = random.Random(seed)
    held = {}
    for step in range(rng.randrange(5, 40)):
        kinds = {kind: [name for name, (own, _) in held.items() if own == kind] for kind in ("cloth", "mesh", "yarns", "live", "array")}
        choice = rng.choice(["cloth", "mesh", "mesh", "yarns", "live", "array", "array", "array", "free", "free", "free"])
        if choice == "free" and held:
            del held[rng.choice(list(held))]
        elif choice == "cloth" or not kinds["cloth"]:
            held[step] = ("cloth", small())
        elif choice == "mesh":
            source = held[rng.choice(kinds["cloth"] + kinds["yarns"])][1]
            held[step] = ("mesh", source.mesh(sides=rng.randrange(3, 7), device="cpu"))
        elif choice == "yarns":
            held[step] = ("yarns", held[rng.choice(kinds["cloth"])][1].yarns)
        elif choice == "live":
            live = held[rng.choice(kinds["cloth"])][1].edit(device="cpu")
            live.set_lift(rng.randrange(5), rng.randrange(4), rng.random() < 0.5)
            held[step] = ("live", live)
            held[step + 1000] = ("yarns", live.yarns())
        elif choice == "array":
            kind = rng.choice([kind for kind in ("mesh", "yarns") if kinds[kind]] or ["cloth"])
            if kind != "cloth":
                owner, name = held[rng.choice(kinds[kind])][1], rng.choice(VIEWS[kind])
                held[step] = ("array", known(lambda: getattr(owner, name)))
                del owner
    names = list(held)
    rng.shuffle(names)
    for name in names:
        del held[name]
        for kind, what in held.values():
            if kind == "array":
                assert what[0].tobytes() == what[1].tobytes(), seed


def test_a_thousand_sequences_of_freeing_are_clean():
    """Four threads run the sequences at once. Objects of one thread are freed by another."""
    failures, passed_on = [], []
    lock = threading.Lock()

    def work(first):
        try:
            for seed in range(first, 1000, 4):
                sequence(seed)
                mesh = small().mesh(device="cpu")
                with lock:
                    passed_on.append((mesh.positions, mesh.positions.copy()))
                    array, copy = passed_on.pop(seed % len(passed_on))
                del mesh
                assert array.tobytes() == copy.tobytes()
        except BaseException as error:
            failures.append(error)

    threads = [threading.Thread(target=work, args=(first,)) for first in range(4)]
    [thread.start() for thread in threads]
    [thread.join() for thread in threads]
    assert not failures, failures
