"""The crossings and stitches of a picture against the known drawdown and the known chart."""

import numpy as np
import pytest
import texere

NONE = [-1, -1]


def look(cloth, size, **more):
    layers = ["crossing", "yarn", "position", "normal", "tangent"]
    return cloth.picture(size=size, layers=layers, supersampling=1, hairs=False, **more)


def test_crossings_are_those_of_the_drawdown():
    """The grid of a weave is known: columns and rows 0.5 mm wide, and which thread lies above."""
    ends, picks, pitch = 9, 7, 0.5
    rng = np.random.default_rng(3)
    drawdown = rng.integers(2, size=(picks, ends)).astype(bool)
    yarn = texere.Yarn(diameter_mm=0.2)
    cloth = texere.woven(drawdown, yarn, yarn, warp_mm=pitch, weft_mm=pitch).placed()
    shown = look(cloth, (360, 280))
    crossing, yarns = shown["crossing"], shown["yarn"]
    assert crossing.shape == (280, 360, 2) and crossing.dtype == np.int32
    assert (crossing[yarns < 0] == NONE).all()
    x, y = shown["position"][..., 0] / pitch, shown["position"][..., 1] / pitch
    # Within 0.18 of a pitch of a crossing's middle, where the thread above hides the other.
    at = np.stack([x, y], axis=-1)
    middle = (yarns >= 0) & (np.abs(at - np.floor(at) - 0.5) < 0.18).all(axis=-1)
    end, pick = np.floor(x[middle]).astype(int), np.floor(y[middle]).astype(int)
    assert (crossing[middle] == np.stack([end, pick], axis=-1)).all()
    above = np.where(drawdown[pick, end], end, ends + pick)
    assert (yarns[middle] == above).all()
    assert len(np.unique(crossing[middle], axis=0)) == ends * picks
    # Elsewhere a pixel of an end has this end, and one of the picks beside it.
    on_end = (yarns >= 0) & (yarns < ends) & (crossing[..., 0] >= 0)
    assert (crossing[on_end][:, 0] == yarns[on_end]).all()
    assert np.abs(crossing[on_end][:, 1] + 0.5 - y[on_end]).max() < 1
    # From the back the same crossings have their other threads above.
    back = look(cloth, (360, 280), view="back")
    at = back["position"][..., :2] / pitch
    middle = (back["yarn"] >= 0) & (np.abs(at - np.floor(at) - 0.5) < 0.18).all(axis=-1)
    end, pick = np.floor(at[middle]).astype(int).T
    assert (back["crossing"][middle] == np.stack([end, pick], axis=-1)).all()
    assert (back["yarn"][middle] == np.where(drawdown[pick, end], ends + pick, end)).all()


@pytest.mark.parametrize(
    "design, at", [("herringbone.wif", (60, 96)), ("jersey.toml", (9, 9)), ("locknit.toml", (7, 7))]
)
def test_a_pixel_has_the_place_that_a_ray_picks(design, at):
    """The picker finds the place that a ray hits without the ring numbers of pictures."""
    cloth = texere.read(f"designs/{design}").placed()
    shown = look(cloth, (48, 36), view="close-up", at=at, width_mm=5)
    crossing, known, hits = shown["crossing"], 0, 0
    for row, column in np.argwhere(shown["yarn"] >= 0):
        x, y, _ = shown["position"][row, column]
        hit = cloth.pick([[x, y, 99], [0, 0, -1]])
        if hit is None or hit.yarn != shown["yarn"][row, column]:
            continue
        hits += 1
        name = hit.name.split(": ")[0]
        first, second = crossing[row, column] + 1
        if first == 0:
            known += "wale" not in name and " at " not in name
            continue
        end = f"end {first} at pick {second}", f"pick {second} at end {first}"
        known += name.startswith(end) or f"wale {first}, course {second}" in name
    # A position lies in its pixel's middle, but has the depth of the pixel's first sample, which
    # lies elsewhere. Some rays through positions therefore hit other places.
    assert hits > 300 and known > 0.9 * hits, (known, hits)


def test_stitches_are_those_of_the_chart():
    """Jersey on its face shows legs: each column of stitches 1 mm wide, each row 0.8 mm high."""
    wool = texere.Yarn(diameter_mm=0.15)
    cloth = texere.weft_knit("k", wool, wale_mm=1.0, course_mm=0.8, copies=(7, 5)).placed()
    shown = look(cloth, (280, 200))
    crossing, seen = shown["crossing"], shown["yarn"] >= 0
    known = seen & (crossing[..., 0] >= 0)
    assert known.sum() > 0.9 * seen.sum()
    wale, course = crossing[known].T
    assert set(wale) == set(range(7)) and set(course) == set(range(5))
    x, y = shown["position"][known][:, 0], shown["position"][known][:, 1] / 0.8
    assert np.abs(wale + 0.5 - x).max() < 1
    # A loop reaches from its feet through the loop above.
    up = y - course
    assert up.min() > -0.8 and up.max() < 2.3


def test_a_long_yarn_counts_rings_beyond_8192():
    """Pictures count a yarn's rings from 0 again after 8192. Crossings are right beyond it, too."""
    up = np.arange(800 * 3).reshape(3, 800) % 2 == 0
    thin = texere.Yarn(diameter_mm=0.1, twist_per_m=900)
    cloth = texere.woven(up, thin, thin, warp_mm=0.5, weft_mm=0.5).placed()
    yarns = cloth.mesh(sides=3, device="cpu").yarn_ids
    assert (yarns == 801).sum() / 3 > 8192
    for x in (2.0, 390.0):
        shown = look(cloth, (60, 40), view="close-up", at=(x, 0.75), width_mm=3)
        on_pick = (shown["yarn"] >= 800) & (shown["crossing"][..., 0] >= 0)
        assert on_pick.sum() > 50
        end = shown["crossing"][on_pick][:, 0]
        assert np.abs(end + 0.5 - shown["position"][on_pick][:, 0] / 0.5).max() < 1


def test_cut_yarns_have_crossings():
    """Where a yarn is cut open a pixel shows the inside of its far wall."""
    yarn = texere.Yarn(diameter_mm=0.2)
    cloth = texere.woven(texere.weave("plain", 9, 7), yarn, yarn, warp_mm=0.5, weft_mm=0.5).placed()
    shown = look(cloth, (120, 60), view="cut-weft", at=(2.25, 1.75), width_mm=2)
    cut = (shown["yarn"] >= 0) & (shown["normal"] == shown["tangent"]).all(axis=-1)
    assert cut.sum() > 50
    crossing = shown["crossing"][cut]
    assert (crossing >= 0).all()
    at = shown["position"][cut][:, :2] / 0.5
    assert np.abs(crossing + 0.5 - at).max() < 1.1
