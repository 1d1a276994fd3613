"""Textile designs to yarn-level 3D geometry, as numpy arrays.

>>> design = texere.read("designs/plain.toml")
>>> cloth = design.rest(device="cpu")
>>> mesh = cloth.mesh(device="cpu")
>>> mesh.positions.shape[1], mesh.indices.shape[1]
(3, 3)

Lengths are in mm, angles in radians; x runs along the weft or the courses, y along the warp or the
wales, z out of the technical face. Yarns, ends, picks and courses are counted from 0.
"""

from ._texere import (
    Bar,
    Change,
    Clearance,
    Cloth,
    Contact,
    Design,
    Device,
    Diagnosis,
    Error,
    Hit,
    Live,
    Measures,
    Mesh,
    StrainTest,
    Yarn,
    Yarns,
    __version__,
    devices,
    read,
    read_curves,
    read_yarns,
    warp_knit,
    weave,
    weft_knit,
    woven,
)

__all__ = [
    "Bar",
    "Change",
    "Clearance",
    "Cloth",
    "Contact",
    "Design",
    "Device",
    "Diagnosis",
    "Error",
    "Hit",
    "Live",
    "Measures",
    "Mesh",
    "StrainTest",
    "Yarn",
    "Yarns",
    "__version__",
    "devices",
    "read",
    "read_curves",
    "read_yarns",
    "warp_knit",
    "weave",
    "weft_knit",
    "woven",
]
