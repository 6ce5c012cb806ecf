"""Answers that hold arrays, and reports."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple

import numpy as np
import numpy.typing as npt

from ._errors import InputTypeError, NoKeyError

if TYPE_CHECKING:
    from ._core import Plan


class Record(Mapping[str, Any]):
    """A read-only dictionary whose keys are attributes too, all the way down: ``report.plates[0].reached``.

    ``str(record)`` is its text, where it has one (a report); ``to_dict()`` gives plain dictionaries.
    """

    __slots__ = ("_data", "_text")

    def __init__(self, data: Mapping[str, Any], text: str | None = None) -> None:
        if not isinstance(data, Mapping):
            raise InputTypeError(f"data: a dictionary is needed; found a value of type {type(data).__name__}", argument="data")
        object.__setattr__(self, "_data", dict(data))
        object.__setattr__(self, "_text", text)

    def __getitem__(self, key: str) -> Any:
        try:
            return _wrapped(self._data[key])
        except (KeyError, TypeError):
            keys = ", ".join(map(str, self._data))
            raise NoKeyError(f"key: one of {keys} is needed; found {key!r:.60}", argument="key") from None

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        try:
            return self[name]
        except KeyError:
            keys = ", ".join(map(str, self._data))
            raise AttributeError(f"no key '{name}'; there are: {keys}") from None

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError("records are read-only")

    def __iter__(self) -> Iterator[str]:
        return iter(self._data)

    def __len__(self) -> int:
        return len(self._data)

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._data]

    def __repr__(self) -> str:
        return f"Record({self._data!r})"

    def __str__(self) -> str:
        return repr(self) if self._text is None else str(self._text)

    def _repr_html_(self) -> str:
        from ._tables import record

        return record(self, None if self._text is None else str(self._text))

    def __reduce__(self) -> tuple[Any, ...]:
        return (Record, (self._data, self._text))

    def to_dict(self) -> dict[str, Any]:
        """The same as plain dictionaries and lists."""
        return _plain(self._data)  # type: ignore[no-any-return]


def _wrapped(value: Any) -> Any:
    if isinstance(value, dict):
        return Record(value)
    if isinstance(value, list):
        return [_wrapped(v) for v in value]
    return value


def _plain(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {key: _plain(v) for key, v in value.items()}
    if isinstance(value, list):
        return [_plain(v) for v in value]
    return value


class _ArrayFields:
    """Equality and printing of dataclasses that hold arrays."""

    __hash__: ClassVar[None]  # type: ignore[assignment]

    def __eq__(self, other: object) -> bool:
        if type(other) is not type(self):
            return NotImplemented
        pairs = [(getattr(self, f.name), getattr(other, f.name)) for f in fields(self)]  # type: ignore[arg-type]
        return all(np.array_equal(a, b, equal_nan=True) if isinstance(a, np.ndarray) else a == b for a, b in pairs)


@dataclass(frozen=True, eq=False)
class IkSolution(_ArrayFields):
    """The answer of ``Robot.ik``: a configuration within the limits that meets both tolerances."""

    #: Joint positions, shape (6,) [rad].
    q: npt.NDArray[np.float64]
    #: Linear systems and quadratic programs solved, over all starts.
    iterations: int
    #: The method that answered: ``"dls"`` or ``"qp"``.
    method: str
    #: From where the answer was found: ``"seed"``, ``"analytic"``, ``"listed 3"``, ``"random 0"``.
    start: str
    #: Distance of the frame's origin from the target's [m].
    position_error_m: float
    #: Angle between the frame and the target [rad].
    orientation_error_rad: float


@dataclass(frozen=True, eq=False)
class IkBatch(_ArrayFields):
    """The answers of ``Robot.ik_batch``, row by row."""

    #: Configurations, shape (N, 6) [rad]; where not solved, the best one found.
    q: npt.NDArray[np.float64]
    #: Whether each target is solved, shape (N,).
    solved: npt.NDArray[np.bool_]
    #: Linear systems and quadratic programs, shape (N,).
    iterations: npt.NDArray[np.int64]
    #: Distances from the targets, shape (N,) [m].
    position_error_m: npt.NDArray[np.float64]
    #: Angles from the targets, shape (N,) [rad].
    orientation_error_rad: npt.NDArray[np.float64]
    #: Why, by row, for those that are not solved: ``IkError.cause``, ``"target"`` for a row that is no pose (``Robot.ik`` says why), or
    #: ``"seed"`` for one whose seed is not finite; those have NaN in place of numbers.
    causes: dict[int, str]

    def __len__(self) -> int:
        return len(self.q)

    def __repr__(self) -> str:
        return f"IkBatch({int(self.solved.sum())} of {len(self)} solved)"


@dataclass(frozen=True, eq=False)
class IkBranches(_ArrayFields):
    """The answer of ``Robot.ik_all``."""

    #: Configurations, shape (K, 6) [rad], with all whole turns that the limits allow.
    q: npt.NDArray[np.float64]
    #: Branch of each: ``"front up plain"``.
    labels: list[str]
    #: Why each branch without a configuration has none.
    rejections: dict[str, str]

    def __len__(self) -> int:
        return len(self.q)

    def __repr__(self) -> str:
        return f"IkBranches({len(self)} configurations, {len(set(self.labels))} branches)"


@dataclass(frozen=True, eq=False)
class Energy(_ArrayFields):
    """Energy of the moving arm: numbers for one state, arrays of shape (N,) for many."""

    #: Half of qd M(q) qd [J].
    kinetic_j: float | npt.NDArray[np.float64]
    #: That of the weights, zero at the height of the base [J].
    potential_j: float | npt.NDArray[np.float64]

    @property
    def total_j(self) -> float | npt.NDArray[np.float64]:
        """Both together [J]."""
        return self.kinetic_j + self.potential_j


@dataclass(frozen=True, eq=False)
class CoverageRaster(_ArrayFields):
    """The swept part of a disc as a square raster: show it with ``imshow(raster.state, origin="lower", extent=raster.extent)``."""

    #: Cells outside the disc.
    OUTSIDE: ClassVar[int] = 0
    #: Cells of which no part is swept.
    MISSED: ClassVar[int] = 1
    #: Cells swept in part, or by more than one segment of the path.
    PARTLY: ClassVar[int] = 2
    #: Cells that one segment of the path sweeps wholly.
    SWEPT: ClassVar[int] = 3

    #: One of the four for each cell, shape (M, M), row index for y.
    state: npt.NDArray[np.uint8]
    #: x of the cells' middles, shape (M,) [m].
    x_m: npt.NDArray[np.float64]
    #: y of the cells' middles, shape (M,) [m].
    y_m: npt.NDArray[np.float64]

    @property
    def extent(self) -> tuple[float, float, float, float]:
        """Left, right, bottom and top of the raster [m]."""
        half = (self.x_m[-1] - self.x_m[0]) / (2 * max(len(self.x_m) - 1, 1))
        left, right = float(self.x_m[0] - half), float(self.x_m[-1] + half)
        return left, right, float(self.y_m[0] - half), float(self.y_m[-1] + half)

    def __repr__(self) -> str:
        return f"CoverageRaster({len(self.x_m)} x {len(self.y_m)})"


class Recovery(NamedTuple):
    """The way on after a stop. Neither plan is proved yet: see ``prove``."""

    home: Plan
    """Motion from where the arm stands home."""
    rest: Plan | None
    """The plates that are left, in the order and along the paths of the stopped plan; None where all were washed."""
    stop: Record
    """The stop: ``time_s`` in the plan, ``off_rad``, the plates that were ``washed``, the plate that the arm was ``at_plate``; ``joints_fit`` is False where a
    stated time was not checked, as the joints fit no moment of the plan."""
    near: list[Record]
    """Pairs of bodies that are nearer where the arm stands than the job asks, with ``distance_m``."""
