"""Invalid inputs: each raises an exception of an expected type, and nothing panics."""

import itertools

import numpy as np
import pytest
import texere

EXPECTED = (texere.Error, TypeError, ValueError, OverflowError, MemoryError)
YARN = texere.Yarn(diameter_mm=0.2)
HUGE = np.broadcast_to(np.float32(0), (1 << 40, 3))


def woven(drawdown=np.ones((4, 4), bool), warp=YARN, weft=YARN, warp_mm=0.5, weft_mm=0.5, **more):
    return texere.woven(drawdown, warp, weft, warp_mm=warp_mm, weft_mm=weft_mm, **more)


def knit(chart="kp", yarns=YARN, wale_mm=1.5, course_mm=1.0, **more):
    return texere.weft_knit(chart, yarns, wale_mm=wale_mm, course_mm=course_mm, **more)


def warp_knit(bars=None, yarns=YARN, wales=4, courses=2, wale_mm=1.0, course_mm=0.75, **more):
    bars = [texere.Bar("1-0/2-3//"), texere.Bar("1-2/1-0//")] if bars is None else bars
    return texere.warp_knit(
        bars, yarns, wales=wales, courses=courses, wale_mm=wale_mm, course_mm=course_mm, **more
    )


LINE = [[0, 0, 0], [1, 0, 0]]
NAN, INF = float("nan"), float("inf")

CALLS = {
    # Drawdowns.
    "a drawdown of one dimension": lambda: woven(np.ones(4, bool)),
    "a drawdown of three dimensions": lambda: woven(np.ones((2, 2, 2), bool)),
    "a drawdown without picks": lambda: woven(np.ones((0, 4), bool)),
    "a drawdown of floats": lambda: woven(np.ones((4, 4))),
    "a drawdown of NaN": lambda: woven(np.full((4, 4), NAN)),
    "a drawdown of twos": lambda: woven(np.full((4, 4), 2)),
    "a drawdown of texts": lambda: woven(np.full((4, 4), "x")),
    "a drawdown of objects": lambda: woven(np.full((4, 4), None)),
    "a ragged drawdown": lambda: woven([[1, 0], [1]]),
    "a huge drawdown": lambda: woven(np.broadcast_to(True, (1 << 40, 1 << 20))),
    "a drawdown of more crossings than there may be": lambda: woven(np.broadcast_to(True, (99999, 99999))),
    # Threads.
    "no warp": lambda: woven(warp=[]),
    "a warp of numbers": lambda: woven(warp=[1, 2]),
    "a spacing of zero": lambda: woven(warp_mm=0),
    "a negative spacing": lambda: woven(warp_mm=-1),
    "a spacing of NaN": lambda: woven(weft_mm=NAN),
    "an infinite spacing": lambda: woven(weft_mm=INF),
    "too few spacings": lambda: woven(warp_mm=[0.5, 0.5]),
    "a spacing of NaN among others": lambda: woven(warp_mm=[0.5, 0.5, NAN, 0.5]),
    "an unknown shape": lambda: woven(shape="star"),
    "a warp share of 2": lambda: woven(warp_share=2.0),
    "a warp share of NaN": lambda: woven(warp_share=NAN),
    # Yarns.
    "a yarn without thickness": lambda: texere.Yarn(),
    "a yarn of thickness 0": lambda: texere.Yarn(diameter_mm=0),
    "a yarn of thickness NaN": lambda: texere.Yarn(diameter_mm=NAN),
    "a yarn of negative tex": lambda: texere.Yarn(tex=-1),
    "a yarn of density 0": lambda: texere.Yarn(tex=50, density=0),
    "a colour with a letter": lambda: texere.Yarn(diameter_mm=1, color="#12345g"),
    "a colour of more bytes than letters": lambda: texere.Yarn(diameter_mm=1, color="#ééé"),
    "a colour with a sign": lambda: texere.Yarn(diameter_mm=1, color="#+12345"),
    "a colour of 256": lambda: texere.Yarn(diameter_mm=1, color=(256, 0, 0)),
    "a section without aspect": lambda: texere.Yarn(diameter_mm=1, section="ellipse"),
    "a section of aspect 0": lambda: texere.Yarn(diameter_mm=1, section=("ellipse", 0)),
    "a section of NaN": lambda: texere.Yarn(diameter_mm=1, section=("lenticular", 1.5, NAN)),
    "a valley deeper than plies": lambda: texere.Yarn(diameter_mm=1, section=("lobed", 2, 0.25)),
    "a half ply": lambda: texere.Yarn(diameter_mm=1, section=("lobed", 2.5, 0.75)),
    "a section of four billion plies": lambda: texere.Yarn(diameter_mm=1, section=("lobed", 4_000_000_000)),
    "a twist of NaN": lambda: woven(warp=texere.Yarn(diameter_mm=0.2, twist_per_m=NAN)),
    "a bending stiffness of 0": lambda: woven(warp=texere.Yarn(diameter_mm=0.2, bending_stiffness=0)).placed(),
    "a bending stiffness of nan": lambda: woven(
        warp=texere.Yarn(diameter_mm=0.2, bending_stiffness=float("nan"))
    ).placed(),
    "a hairiness of 1000": lambda: woven(warp=texere.Yarn(diameter_mm=0.2, hairiness=1000)).placed(),
    "a firmness of NaN": lambda: woven(warp=texere.Yarn(diameter_mm=0.2, firmness=NAN)),
    "a stiffness of NaN": lambda: woven(warp=texere.Yarn(diameter_mm=0.2, stiffness=NAN)),
    "an unknown fibre": lambda: texere.Yarn(diameter_mm=0.2, fibre="hemp"),
    "fibre packed beyond hexagons": lambda: texere.Yarn(diameter_mm=0.2, packing=0.95),
    "a packing of NaN": lambda: texere.Yarn(diameter_mm=0.2, packing=NAN),
    # Knits.
    "an empty chart": lambda: knit(""),
    "a chart of unknown stitches": lambda: knit("xyz"),
    "a ragged chart": lambda: knit("kk\nk"),
    "a chart that never knits": lambda: knit("m"),
    "three beds": lambda: knit(beds=3),
    "a turn of yarns that are not there": lambda: knit(turn=[0, 7]),
    "a wale of NaN": lambda: knit(wale_mm=NAN),
    "no copy": lambda: knit(copies=(0, 1)),
    "too many copies": lambda: knit(copies=(2**32 - 1, 2**32 - 1)).placed(),
    "negative copies": lambda: knit(copies=(-1, 1)),
    "a loop length of NaN": lambda: knit(loop_length_mm=NAN),
    "no bar": lambda: warp_knit([]),
    "a chain that is none": lambda: texere.Bar("1-x"),
    "a chain of NaN": lambda: texere.Bar([[NAN, 0]]),
    "a chain of negative spaces": lambda: texere.Bar([[-1, 0]]),
    "a chain of huge spaces": lambda: texere.Bar(np.full((2, 2), 2**63, np.uint64)),
    "a huge chain": lambda: texere.Bar(np.broadcast_to(0, (1 << 40, 2))),
    "a chain without laps": lambda: texere.Bar(np.zeros((0, 2), int)),
    "a step of 3": lambda: texere.Bar("1-0", step=3),
    "a threading of yarns that are not there": lambda: warp_knit([texere.Bar("1-0/1-2//", threading=[5])]),
    "an offset that overflows": lambda: warp_knit([texere.Bar("1-0/1-2//", offset=2**31 - 1)]),
    "wales that do not repeat": lambda: warp_knit(courses=3),
    "four billion wales": lambda: warp_knit(wales=2**32 - 2),
    # Finishes.
    "a calender of 11": lambda: woven().finished(calender=11),
    "a tension of NaN": lambda: woven().finished(warp_tension=NAN),
    "a press of woven cloth": lambda: woven().finished(press_mm=1),
    "a stretch of a knit": lambda: knit().finished(stretch=("warp", 1.1)),
    "a stretch along nothing": lambda: woven().finished(stretch=("bias", 1.1)),
    "no pass": lambda: knit().finished(passes=0),
    # Yarns from arrays.
    "points of two coordinates": lambda: texere.Yarns.from_arrays([[0, 0], [1, 0]], 0.1),
    "points of NaN": lambda: texere.Yarns.from_arrays([[0, 0, 0], [NAN, 0, 0]], 0.1),
    "infinite points": lambda: texere.Yarns.from_arrays([[0, 0, 0], [INF, 0, 0]], 0.1),
    "complex points": lambda: texere.Yarns.from_arrays(np.ones((2, 3), complex), 0.1),
    "points of dates": lambda: texere.Yarns.from_arrays(np.zeros((2, 3), "datetime64[s]"), 0.1),
    "no points": lambda: texere.Yarns.from_arrays(np.zeros((0, 3)), 0.1),
    "one point": lambda: texere.Yarns.from_arrays([[0, 0, 0]], 0.1),
    "huge points": lambda: texere.Yarns.from_arrays(HUGE, 0.1),
    "no radius": lambda: texere.Yarns.from_arrays(LINE, 0),
    "a radius of NaN": lambda: texere.Yarns.from_arrays(LINE, NAN),
    "radii of no points": lambda: texere.Yarns.from_arrays(np.zeros((0, 3)), np.zeros(0)),
    "three radii": lambda: texere.Yarns.from_arrays(LINE, [1, 1, 1]),
    "offsets that fall": lambda: texere.Yarns.from_arrays(LINE, 0.1, [0, 2, 1, 2]),
    "offsets that begin late": lambda: texere.Yarns.from_arrays(LINE, 0.1, [1, 2]),
    "offsets past the end": lambda: texere.Yarns.from_arrays(LINE, 0.1, [0, 5]),
    "negative offsets": lambda: texere.Yarns.from_arrays(LINE, 0.1, [-1, 2]),
    "offsets of floats": lambda: texere.Yarns.from_arrays(LINE, 0.1, [0.0, 2.0]),
    "no offsets": lambda: texere.Yarns.from_arrays(LINE, 0.1, []),
    "one offset": lambda: texere.Yarns.from_arrays(LINE, 0.1, [0]),
    "huge offsets": lambda: texere.Yarns.from_arrays(LINE, 0.1, np.broadcast_to(0, 1 << 44)),
    "colours of 256": lambda: texere.Yarns.from_arrays(LINE, 0.1, colors=[[256, 0, 0]]),
    "colours of other yarns": lambda: texere.Yarns.from_arrays(LINE, 0.1, colors=[[1, 2, 3], [4, 5, 6]]),
    "a twist of 1e9": lambda: texere.Yarns.from_arrays(LINE, 0.1, twist=1e9),
    "twists of no yarns": lambda: texere.Yarns.from_arrays(LINE, 0.1, twist=[]),
    "a tension of 1": lambda: texere.Yarns.from_arrays(LINE, 0.1, tension=1),
    # Meshes.
    "two sides": lambda: woven().placed().mesh(sides=2, device="cpu"),
    "four billion sides": lambda: woven().placed().mesh(sides=2**32 - 1, device="cpu"),
    "negative sides": lambda: woven().placed().mesh(sides=-1, device="cpu"),
    "sides that overflow": lambda: woven().placed().mesh(sides=2**40, device="cpu"),
    "four billion subdivisions": lambda: woven().placed().mesh(subdivisions=2**32 - 1, device="cpu"),
    "an unknown device": lambda: woven().placed().mesh(device="abacus"),
    "a device of a zero byte": lambda: woven().placed().mesh(device="cpu\0"),
    # Rays and edits.
    "a ray of one vector": lambda: woven().placed().pick([0, 0, 1]),
    "a ray of texts": lambda: woven().placed().pick([["a", "b", "c"]] * 2),
    "a lift outside the cloth": lambda: woven().placed().edit(device="cpu").set_lift(4, 0, True),
    "a lift of 2^64 - 1": lambda: woven().placed().edit(device="cpu").set_lift(2**64 - 1, 2**64 - 1, True),
    "a drawdown of another size": lambda: woven().placed().edit(device="cpu").set_drawdown([[1]]),
    "points of a yarn that is not there": lambda: woven().placed().edit(device="cpu").set_points(99, LINE),
    "too few points": lambda: woven().placed().edit(device="cpu").set_points(0, LINE),
    "a colour of no material": lambda: woven().placed().edit(device="cpu").set_color(9, "#000000"),
    # Pictures.
    "a picture of no size": lambda: woven().placed().picture(size=(0, 4)),
    "a huge picture": lambda: woven().placed().picture(size=(2**32 - 1, 2**32 - 1)),
    "an unknown view": lambda: woven().placed().picture(view="moon"),
    "a close-up of nothing": lambda: woven().placed().picture(view="close-up"),
    "a close-up of NaN": lambda: woven().placed().picture(view="close-up", at=(NAN, 0), width_mm=1),
    "a turn of NaN": lambda: woven().placed().picture(view="oblique", turn=NAN),
    "an eye in its target": lambda: woven().placed().picture(view="eye", eye=([0, 0, 0],) * 3),
    "no samples": lambda: woven().placed().picture(size=(8, 8), supersampling=0),
    "an unknown layer": lambda: woven().placed().picture(size=(8, 8), layers=["colour"]),
    "an unknown background": lambda: woven().placed().picture(size=(8, 8), background="sky"),
    # Files.
    "a path of another ending": lambda: woven().write("design.doc"),
    "a path in no folder": lambda: woven().write("/nowhere/design.toml"),
    "a knit as a draft": lambda: knit().write("/tmp/knit.wif"),
    "a mesh of another ending": lambda: woven().placed().mesh(device="cpu").write("mesh.doc"),
    "a cloth over its own design": lambda: texere.read("designs/plain.toml").placed().write("designs/plain.toml"),
    "a file that is no yarns": lambda: texere.read_yarns("designs/plain.toml"),
}


@pytest.mark.parametrize("what", CALLS)
@pytest.mark.filterwarnings("ignore::RuntimeWarning")
def test_what_no_cloth_can_be_is_refused(what):
    with pytest.raises(EXPECTED) as raised:
        CALLS[what]()
    assert "fault of texere" not in str(raised.value)


def test_arrays_of_any_layout_and_type_are_taken():
    """Arrays are taken in any layout and byte order, and of several types of numbers."""
    up = texere.weave("herringbone 2/2(16)", 24, 20)
    known = woven(up, warp_mm=0.5).placed().yarns.points.tobytes()
    wide = np.zeros((20, 48), bool)
    wide[:, ::2] = up
    unaligned = np.zeros(up.size * 8 + 1, np.uint8)[1:].view(np.int64).reshape(up.shape)
    unaligned[...] = up
    layouts = [np.asfortranarray(up), np.ascontiguousarray(up.T).T, up[::-1][::-1], wide[:, ::2], unaligned]
    types = [up.astype(kind) for kind in ("i1", "u1", ">i4", "u8", ">u2")]
    for array in itertools.chain(layouts, types, [up.tolist()]):
        assert woven(array).placed().yarns.points.tobytes() == known
    points = np.array([[0, 0, 0], [1, 0, 0], [2, 1, 0]])
    known = texere.Yarns.from_arrays(points, 0.1).points.tobytes()
    for kind in ("f2", ">f4", "f8", "g", "i2", ">u8"):
        assert texere.Yarns.from_arrays(points.astype(kind), 0.1).points.tobytes() == known


def test_arrays_of_the_caller_stay_as_they_are():
    points, radii = np.array(LINE, np.float32), np.full(2, 0.1, np.float32)
    before = points.copy()
    yarns = texere.Yarns.from_arrays(points, radii)
    assert not np.shares_memory(points, yarns.points)
    points += 1
    assert (yarns.points == before).all() and points.flags.writeable
