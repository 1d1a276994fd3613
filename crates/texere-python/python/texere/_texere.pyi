# The types of the module that Rust makes. Its docstrings say what everything does.

import os
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, Literal, Union, final, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

__version__: str

_Path = Union[str, os.PathLike[str]]
_Color = Union[str, tuple[int, int, int], Sequence[int]]
_Section = Union[str, tuple[str, float], tuple[str, float, float]]
_Point = tuple[float, float, float]
_Rows = Union[NDArray[Any], Sequence[Sequence[float]]]
_View = Literal["face", "back", "oblique", "close-up", "cut-warp", "cut-weft", "eye"]
_Attribute = Literal["uv", "tangent", "yarn"]
_Layer = Literal["depth", "normal", "tangent", "yarn", "uv", "position", "crossing"]

class Error(Exception):
    file: str | None
    line: int | None
    column: int | None
    causes: tuple[str, ...]

@final
class Device:
    @property
    def name(self) -> str: ...
    @property
    def device(self) -> str: ...
    @property
    def is_auto(self) -> bool: ...

@final
class Yarn:
    def __new__(
        cls,
        *,
        diameter_mm: float | None = None,
        tex: float | None = None,
        density: float | None = None,
        color: _Color | None = None,
        name: str = "yarn",
        twist_per_m: float | None = None,
        section: _Section | None = None,
        flatness: float = 1.0,
        stiffness: float = 1.0,
        firmness: float | None = None,
        hairiness: float = 0.0,
        fibre: str = "cotton",
        packing: float = ...,
        bending_stiffness: float | None = None,
    ) -> Yarn: ...
    @property
    def name(self) -> str: ...
    @property
    def diameter_mm(self) -> float: ...

@final
class Bar:
    def __new__(
        cls,
        chain: str | ArrayLike,
        *,
        threading: Sequence[int | None] | None = None,
        offset: int = 0,
        run_in_mm: float | None = None,
        step: int = 1,
    ) -> Bar: ...

@final
class Design:
    @property
    def name(self) -> str: ...
    @property
    def kind(self) -> str: ...
    @property
    def size_mm(self) -> tuple[float, float]: ...
    @property
    def settle(self) -> bool: ...
    @property
    def files(self) -> list[Path]: ...
    @property
    def warnings(self) -> list[str]: ...
    def finished(
        self,
        *,
        settle: bool | None = None,
        warp_tension: float | None = None,
        weft_tension: float | None = None,
        calender: float | None = None,
        stretch: tuple[str, float] | None = None,
        press_mm: float | None = None,
        loop_length: float | None = None,
        passes: int | None = None,
        rest: Literal["clear", "energy"] | None = None,
        hold: Literal["courses", "wales", "both"] | None = None,
    ) -> Design: ...
    def rest(self, device: str = "auto", progress: bool | Callable[[float], object] | None = None) -> Cloth: ...
    def test(
        self,
        along: Literal["courses", "wales", "both"] = "courses",
        strains: ArrayLike | None = None,
        device: str = "auto",
        progress: bool | Callable[[float], object] | None = None,
    ) -> StrainTest: ...
    def placed(self) -> Cloth: ...
    def write(self, path: _Path) -> list[str]: ...

@final
class Cloth:
    @property
    def report(self) -> str: ...
    @property
    def is_at_rest(self) -> bool: ...
    @property
    def device(self) -> str: ...
    @property
    def warnings(self) -> list[str]: ...
    @property
    def yarns(self) -> Yarns: ...
    @property
    def measures(self) -> Measures: ...
    @property
    def diagnosis(self) -> Diagnosis: ...
    def clearance(self) -> Clearance: ...
    def mesh(
        self,
        sides: int | None = None,
        subdivisions: int | None = None,
        *,
        caps: bool = False,
        device: str = "auto",
    ) -> Mesh: ...
    def pick(self, ray: _Rows) -> Hit | None: ...
    def edit(self, *, device: str = "auto") -> Live: ...
    @overload
    def picture(
        self,
        size: tuple[int, int] = (1600, 1200),
        view: _View = "face",
        *,
        turn: float = 0.0,
        at: tuple[float, float] | None = None,
        width_mm: float | None = None,
        eye: tuple[_Point, _Point, _Point] | None = None,
        field_of_view: float = 0.42,
        background: _Color | None = None,
        supersampling: int = 2,
        hairs: bool = True,
        layers: None = None,
        device: str = "auto",
    ) -> NDArray[np.uint8]: ...
    @overload
    def picture(
        self,
        size: tuple[int, int] = (1600, 1200),
        view: _View = "face",
        *,
        turn: float = 0.0,
        at: tuple[float, float] | None = None,
        width_mm: float | None = None,
        eye: tuple[_Point, _Point, _Point] | None = None,
        field_of_view: float = 0.42,
        background: _Color | None = None,
        supersampling: int = 2,
        hairs: bool = True,
        layers: Sequence[_Layer],
        device: str = "auto",
    ) -> dict[str, NDArray[Any]]: ...
    def write(
        self,
        path: _Path,
        *,
        packed: bool = False,
        compressed: bool | Literal["ext", "khr"] = False,
        instanced: bool = False,
        attributes: Sequence[_Attribute] = ...,
        linear: bool = False,
        triangles: bool = False,
        device: str = "auto",
    ) -> None: ...
    def show(self, **options: Any) -> Any: ...
    def _repr_png_(self) -> bytes | None: ...

@final
class Yarns:
    @staticmethod
    def from_arrays(
        points: ArrayLike,
        radii: ArrayLike,
        offsets: ArrayLike | None = None,
        *,
        closed: ArrayLike | None = None,
        twist: ArrayLike | None = None,
        colors: ArrayLike | None = None,
        tension: float = 0.0,
    ) -> Yarns: ...
    @property
    def points(self) -> NDArray[np.float32]: ...
    @property
    def halves(self) -> NDArray[np.float16]: ...
    @property
    def offsets(self) -> NDArray[np.uint64]: ...
    @property
    def colors(self) -> NDArray[np.uint8]: ...
    @property
    def names(self) -> list[str]: ...
    @property
    def tension(self) -> float: ...
    def mesh(
        self,
        sides: int | None = None,
        subdivisions: int | None = None,
        *,
        caps: bool = False,
        device: str = "auto",
    ) -> Mesh: ...
    def write(self, path: _Path, *, linear: bool = False) -> None: ...
    def __len__(self) -> int: ...

@final
class Mesh:
    @property
    def positions(self) -> NDArray[np.float32]: ...
    @property
    def normals(self) -> NDArray[np.float32]: ...
    @property
    def indices(self) -> NDArray[np.uint32]: ...
    @property
    def yarn_ids(self) -> NDArray[np.uint32]: ...
    @property
    def uv(self) -> NDArray[np.float32]: ...
    @property
    def tangents(self) -> NDArray[np.float32]: ...
    @property
    def colors(self) -> NDArray[np.uint8]: ...
    @property
    def nbytes(self) -> int: ...
    def write(
        self,
        path: _Path,
        *,
        packed: bool = False,
        compressed: bool | Literal["ext", "khr"] = False,
        instanced: bool = False,
        attributes: Sequence[_Attribute] = ...,
    ) -> None: ...
    def to_trimesh(self) -> Any: ...
    def to_pyvista(self) -> Any: ...
    def show(self, **options: Any) -> Any: ...

@final
class Measures:
    @property
    def width_mm(self) -> float: ...
    @property
    def height_mm(self) -> float: ...
    @property
    def thickness_mm(self) -> float: ...
    @property
    def length_mm(self) -> list[float]: ...
    @property
    def areal_weight(self) -> float: ...
    @property
    def warp_crimp(self) -> float: ...
    @property
    def weft_crimp(self) -> float: ...
    @property
    def warp_cover(self) -> float: ...
    @property
    def weft_cover(self) -> float: ...
    @property
    def cover(self) -> float: ...
    @property
    def warp_cover_factor(self) -> float: ...
    @property
    def weft_cover_factor(self) -> float: ...
    @property
    def cover_factor(self) -> float: ...
    @property
    def wales(self) -> int: ...
    @property
    def courses(self) -> int: ...
    @property
    def loops(self) -> int: ...
    @property
    def loop_length_mm(self) -> float: ...
    @property
    def tightness(self) -> float: ...
    def as_dict(self) -> dict[str, Any]: ...
    def _repr_html_(self) -> str: ...

@final
class Contact:
    @property
    def ratio(self) -> float: ...
    @property
    def position(self) -> _Point: ...
    @property
    def places(self) -> tuple[str, str]: ...

@final
class Clearance:
    @property
    def least(self) -> float: ...
    @property
    def contacts(self) -> int: ...
    @property
    def below_one(self) -> int: ...
    @property
    def bend(self) -> float: ...
    @property
    def worst(self) -> list[Contact]: ...

@final
class Diagnosis:
    @property
    def is_clean(self) -> bool: ...
    @property
    def verdict(self) -> str: ...
    @property
    def lines(self) -> list[tuple[str, str]]: ...
    def as_dict(self) -> dict[str, Any]: ...

@final
class StrainTest:
    @property
    def along(self) -> Literal["courses", "wales", "both"]: ...
    @property
    def wales_per_cm(self) -> float: ...
    @property
    def courses_per_cm(self) -> float: ...
    @property
    def strain(self) -> NDArray[np.float64]: ...
    @property
    def force(self) -> NDArray[np.float64]: ...
    @property
    def thickness_mm(self) -> NDArray[np.float64]: ...
    @property
    def energy(self) -> NDArray[np.float64]: ...
    @property
    def balanced(self) -> NDArray[np.bool_]: ...
    def strain_at(self, force: float) -> float | None: ...
    def modulus_at(self, strain: float = 0.0) -> float | None: ...
    def poisson_at(self, strain: float = 0.0) -> float | None: ...

@final
class Hit:
    @property
    def yarn(self) -> int: ...
    @property
    def name(self) -> str: ...
    @property
    def position(self) -> _Point: ...
    @property
    def distance(self) -> float: ...
    @property
    def place(self) -> tuple[int, float]: ...

@final
class Change:
    @property
    def yarn(self) -> int: ...
    @property
    def count(self) -> int: ...
    @property
    def vertices(self) -> slice: ...
    @property
    def positions(self) -> NDArray[np.float32]: ...
    @property
    def normals(self) -> NDArray[np.float32]: ...

@final
class Live:
    def set_lift(self, end: int, pick: int, up: bool) -> None: ...
    def set_drawdown(self, drawdown: ArrayLike) -> None: ...
    def set_points(self, yarn: int, points: ArrayLike, radii: ArrayLike | None = None) -> None: ...
    def set_color(self, material: int, color: _Color) -> None: ...
    def pick(self, ray: _Rows) -> Hit | None: ...
    def yarns(self) -> Yarns: ...
    def changes(self) -> list[Change] | None: ...
    def mesh(self, sides: int | None = None, subdivisions: int | None = None, *, caps: bool = False) -> Mesh: ...

def devices() -> list[Device]: ...
def read(path: _Path) -> Design: ...
def read_curves(path: _Path, *, diameter_mm: float | None = None, unit_mm: float | None = None) -> Yarns: ...
def read_yarns(path: _Path) -> Yarns: ...
def weave(notation: str, ends: int, picks: int) -> NDArray[np.bool_]: ...
def woven(
    drawdown: ArrayLike,
    warp: Yarn | Sequence[Yarn],
    weft: Yarn | Sequence[Yarn],
    *,
    warp_mm: ArrayLike,
    weft_mm: ArrayLike,
    name: str = "woven",
    selvedge: bool = False,
    shape: Literal["round", "crossing"] = "round",
    warp_share: float | None = None,
    relief: Literal["report", "flatten", "shrink"] = "report",
) -> Design: ...
def weft_knit(
    chart: str,
    yarns: Yarn | Sequence[Yarn],
    *,
    wale_mm: float,
    course_mm: float,
    turn: Sequence[int] | None = None,
    copies: tuple[int, int] = ...,
    beds: Literal[1, 2] = 1,
    loop_length_mm: float | None = None,
    cells: Literal["round", "even"] = "round",
    name: str = "weft-knitted",
) -> Design: ...
def warp_knit(
    bars: Sequence[Bar],
    yarns: Yarn | Sequence[Yarn],
    *,
    wale_mm: float,
    course_mm: float,
    wales: int,
    courses: int,
    copies: tuple[int, int] = ...,
    cells: Literal["round", "even"] = "round",
    name: str = "warp-knitted",
) -> Design: ...
