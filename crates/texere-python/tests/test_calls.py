"""Errors with their places, Ctrl-C, progress, and threads that go on meanwhile."""

import multiprocessing
import os
import signal
import subprocess
import sys
import textwrap
import threading
import time

import pytest
import texere


def test_an_error_names_file_line_and_causes(tmp_path):
    file = tmp_path / "bad.toml"
    file.write_text('weave = { notation = "plain", ends = 4, picks = 4 }\nyarns.a.tex = -3\n')
    with pytest.raises(texere.Error) as raised:
        texere.read(file)
    error = raised.value
    assert (error.file, error.line, error.column) == (str(file), 2, None)
    assert "yarns.a.tex" in error.causes[0] and str(error) == ": ".join(error.causes)


def test_an_error_of_a_program_has_its_column(tmp_path):
    file = tmp_path / "bad.k"
    file.write_text(";!knitout-2\n;;Carriers: 1\nknit + f1 nowhere\n")
    with pytest.raises(texere.Error) as raised:
        texere.read(file)
    assert raised.value.file == str(file) and raised.value.line == 3


def test_an_error_of_the_system_has_its_cause(tmp_path):
    with pytest.raises(texere.Error) as raised:
        texere.read(tmp_path / "nowhere.toml")
    assert raised.value.file == str(tmp_path / "nowhere.toml") and raised.value.line is None
    assert len(raised.value.causes) == 2


def long_design():
    """A knit that takes many passes to come to rest."""
    wool = texere.Yarn(diameter_mm=0.3)
    return texere.weft_knit("kp\npk", wool, wale_mm=1.5, course_mm=1.0, copies=(60, 60))


def spent(call):
    """The time that all cores have worked on a call, and the exception that it ended with."""
    before, ended = time.process_time(), None
    try:
        call()
    except (KeyboardInterrupt, Enough) as exception:
        ended = type(exception)
    return time.process_time() - before, ended


class Enough(Exception):
    """What a progress function raises."""


@pytest.fixture(scope="module")
def whole():
    """The work of a whole rest of the long design."""
    work, ended = spent(lambda: long_design().rest(device="cpu", progress=False))
    assert ended is None
    return work


@pytest.fixture
def ctrl_c():
    """Lets Ctrl-C raise KeyboardInterrupt.

    If Ctrl-C was ignored when Python was started, as it is for the background jobs of a shell
    script, Python goes on ignoring it.
    """
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def test_ctrl_c_ends_a_rest(whole, ctrl_c):
    shares, counted = [], [0, True]

    def press():
        while not shares:
            time.sleep(0.01)
        os.kill(os.getpid(), signal.SIGINT)

    def count():
        while counted[1]:
            counted[0] += 1
            time.sleep(0.001)

    threads = [threading.Thread(target=press), threading.Thread(target=count)]
    [thread.start() for thread in threads]
    try:
        work, ended = spent(lambda: long_design().rest(device="cpu", progress=shares.append))
    finally:
        counted[1] = False
        [thread.join() for thread in threads]
    assert ended is KeyboardInterrupt
    assert work < 0.5 * whole, "the rest went on to its end"
    assert counted[0] > 10, "no other thread went on meanwhile"


def test_ctrl_c_ends_a_script(ctrl_c):
    program = textwrap.dedent("""
        import texere
        wool = texere.Yarn(diameter_mm=0.3)
        design = texere.weft_knit("kp\\npk", wool, wale_mm=1.5, course_mm=1.0, copies=(30, 30))
        design.rest(device="cpu", progress=lambda share: print("works", flush=True))
    """)
    running = subprocess.Popen(
        [sys.executable, "-c", program], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    assert running.stdout.readline() == "works\n"
    running.send_signal(signal.SIGINT)
    _, said = running.communicate()
    assert "KeyboardInterrupt" in said and "panic" not in said


def test_an_exception_of_the_progress_ends_the_rest(whole):
    def stop(share):
        raise Enough

    work, ended = spent(lambda: long_design().rest(device="cpu", progress=stop))
    assert ended is Enough
    assert work < 0.5 * whole, "the rest went on to its end"


def test_progress_is_a_bool_or_a_function():
    with pytest.raises(TypeError):
        texere.read("designs/plain.toml").rest(progress=3)


def test_a_bar_of_tqdm_is_drawn_and_taken_away(capsys):
    texere.weft_knit(
        "k", texere.Yarn(diameter_mm=0.3), wale_mm=1.5, course_mm=1.0, copies=(10, 10)
    ).rest(device="cpu", progress=True)
    said = capsys.readouterr().err
    assert not said or "rest:" in said


def test_threads_mesh_at_once():
    cloths = [texere.read("designs/locknit.toml").placed() for _ in range(8)]
    known = cloths[0].mesh(device="cpu").positions.tobytes()
    made = [None] * 8

    def work(number):
        made[number] = cloths[number].mesh(device="cpu").positions.tobytes()

    threads = [threading.Thread(target=work, args=(number,)) for number in range(8)]
    [thread.start() for thread in threads]
    [thread.join() for thread in threads]
    assert made == [known] * 8


def of_fork(pipe):
    try:
        texere.read("designs/plain.toml")
        pipe.send("read")
    except texere.Error as error:
        pipe.send(str(error))


@pytest.mark.skipif(not hasattr(os, "fork"), reason="there are no forks")
@pytest.mark.filterwarnings("ignore::DeprecationWarning")
def test_a_fork_is_refused_and_does_not_hang():
    texere.read("designs/plain.toml").placed()
    here, there = multiprocessing.Pipe()
    child = multiprocessing.get_context("fork").Process(target=of_fork, args=(there,))
    child.start()
    assert here.poll(60) and "spawn" in here.recv()
    child.join()


def test_a_live_cloth_is_edited_and_undone():
    cloth = texere.read("designs/plain.toml").placed()
    live = cloth.edit(device="cpu")
    before = live.mesh().positions.tobytes()
    assert before == cloth.mesh(device="cpu").positions.tobytes()
    up = bool(texere.weave("plain", 64, 48)[0, 0])
    live.set_lift(0, 0, not up)
    assert live.mesh().positions.tobytes() != before
    live.set_lift(0, 0, up)
    assert live.mesh().positions.tobytes() == before
    drawdown = texere.weave("2/2", 64, 48)
    live.set_drawdown(drawdown)
    assert live.mesh().positions.tobytes() != before
    with pytest.raises(texere.Error):
        texere.read("designs/locknit.toml").placed().edit(device="cpu").set_lift(0, 0, True)
