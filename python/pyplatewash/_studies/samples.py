"""Rows of a study drawn over ranges: Sobol' sequences, Latin hypercubes and random numbers, by SciPy, which is asked for only then."""

from __future__ import annotations

import math
import sys
import warnings
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

import numpy as np

from .. import _arguments
from .._arguments import shown
from .._errors import InputError, InputTypeError
from .table import as_json, needed

if TYPE_CHECKING:
    from .._values import Floats

METHODS = ("sobol", "latin_hypercube", "random")
#: Most rows, as of a study; most numbers that are drawn for a row.
MOST_ROWS, MOST_NUMBERS = 10_000_000, 1000
#: Greatest integer, as of a seed.
MOST_WHOLE = 2**53 - 1
#: Deepest that lists of a value are in lists.
DEEPEST = 10
#: Greatest logarithm of a number.
MOST_LOG = math.log(sys.float_info.max)
#: How often rows that are there before are drawn anew.
ROUNDS = 100

#: A value from numbers that are spread over [0, 1).
Drawn: TypeAlias = Callable[["Floats"], Any]


@dataclass(frozen=True)
class Draw:
    """How a key's value is drawn: from how many numbers, how, and how many different values there are."""

    numbers: int
    value: Drawn
    values: float


def samples(
    ranges: Mapping[str, Any], count: int, method: Literal["sobol", "latin_hypercube", "random"] = "sobol", *, seed: int = 0, log: Iterable[str] = ()
) -> list[dict[str, Any]]:
    """Rows of a study, drawn: a dictionary of keys and values each, as ``[[rows]]`` of a study file state them. No row is there twice.

    ``ranges`` says for each key of a scenario what its values are: ``(least, greatest)`` for numbers between two, evenly, or evenly by
    their logarithm for the keys in ``log``; ``[a, b, c]`` for one of these, ``range(1, 501)`` among them; ``((0.0, 0.3), (-0.38, 0.38), 0.03)``
    for a list of numbers, each of a range or given, as ``plate[0].at_m`` is.

    ``method`` is that of ``scipy.stats.qmc``: ``"sobol"``, scrambled, which fills the space most evenly for counts that are powers of two
    (SciPy warns of others); ``"latin_hypercube"``, one value in each of ``count`` strata of each range; or ``"random"``. The same ``seed``
    gives the same rows with the same version of SciPy.

    >>> [row["seed"] for row in samples({"tool.length_m": (0.1, 0.2), "seed": [7]}, 2)]
    [7, 7]

    Raises InputError, InputTypeError; MissingError, an ImportError, without SciPy.
    """
    rows = _arguments.count("count", count, 1, MOST_ROWS)
    way, start = _arguments.word("method", method, METHODS), _arguments.count("seed", seed, 0, MOST_WHOLE)
    draws = _draws(ranges, log)
    different = math.prod(draw.values for draw in draws.values())
    if different < rows:
        raise InputError(f"count: an integer up to {different:.0f} is needed, as many different rows as there are; found {rows}", argument="count")
    engine = _engine(way, sum(draw.numbers for draw in draws.values()), start)
    drawn: dict[str, dict[str, Any]] = {}
    for turn in range(ROUNDS):
        with warnings.catch_warnings():
            if turn:
                warnings.simplefilter("ignore")
            points = engine(rows - len(drawn))
        for point in points:
            row = _row(draws, point)
            drawn.setdefault(as_json(list(row.values())), row)
        if len(drawn) == rows:
            return list(drawn.values())
    words = f"count: fewer rows are needed, for all values are listed, and {rows} different ones were not drawn; state them as axes"
    raise InputError(words, argument="count")


def _row(draws: dict[str, Draw], point: Floats) -> dict[str, Any]:
    row, here = {}, 0
    for key, draw in draws.items():
        row[key] = draw.value(point[here : here + draw.numbers])
        here += draw.numbers
    return row


def _engine(method: str, numbers: int, seed: int) -> Callable[[int], Floats]:
    qmc = needed("scipy.stats", "samples need", "study").qmc
    generator = np.random.default_rng(seed)
    if method == "random":
        return lambda rows: generator.random((rows, numbers))
    kind = {"sobol": qmc.Sobol, "latin_hypercube": qmc.LatinHypercube}[method]
    try:
        engine = kind(numbers, rng=generator)
    except TypeError:  # SciPy before 1.15.
        engine = kind(numbers, seed=generator)
    return lambda rows: np.asarray(engine.random(rows))


def _draws(ranges: Any, log: Any) -> dict[str, Draw]:
    if not isinstance(ranges, Mapping):
        raise InputTypeError(f"ranges: a dictionary of keys and ranges is needed; found {shown(ranges)}", argument="ranges")
    if not ranges:
        raise InputError("ranges: at least one key is needed; found none", argument="ranges")
    by_logarithm = set(_arguments.texts("log", list(log) if isinstance(log, (set, frozenset, dict)) else log))
    draws = {}
    for key, stated in ranges.items():
        if not isinstance(key, str):
            raise InputTypeError(f"ranges: keys of scenarios are needed; found {shown(key)}", argument="ranges")
        draws[key] = _draw(f"ranges[{key!r:.60}]", stated, key in by_logarithm)
        by_logarithm.discard(key)
    if by_logarithm:
        raise InputError(f"log: keys of ranges are needed; found {', '.join(sorted(by_logarithm)):.60}", argument="log")
    if sum(draw.numbers for draw in draws.values()) > MOST_NUMBERS:
        raise InputError(f"ranges: at most {MOST_NUMBERS} numbers are drawn for a row; found more", argument="ranges")
    return draws


def _draw(name: str, stated: Any, by_logarithm: bool) -> Draw:
    wanted = f"{name}: (least, greatest), a list of values, or a tuple of ranges and numbers is needed"
    if isinstance(stated, (list, range)):
        if by_logarithm:
            raise InputError(f"{name}: a range is needed for a key in log; found a list", argument=name)
        return _choice(name, stated)
    if not isinstance(stated, tuple):
        raise InputTypeError(f"{wanted}; found {shown(stated)}", argument=name)
    if not any(isinstance(part, tuple) for part in stated):
        return _range(name, stated, by_logarithm, wanted)
    named = [(f"{name}[{place}]", part) for place, part in enumerate(stated)]
    parts = [_range(called, part, by_logarithm, wanted) if isinstance(part, tuple) else _given(called, part) for called, part in named]

    def value(numbers: Floats) -> list[Any]:
        left = iter(numbers)
        return [part.value(np.array([next(left) for _ in range(part.numbers)])) for part in parts]

    return Draw(sum(part.numbers for part in parts), value, math.inf)


def _range(name: str, stated: tuple[Any, ...], by_logarithm: bool, wanted: str) -> Draw:
    if len(stated) != 2:
        raise InputError(f"{wanted}; found a tuple of {len(stated)}", argument=name)
    least, greatest = (_given(name, end).value(np.zeros(0)) for end in stated)
    if not least < greatest or not math.isfinite(greatest - least):
        raise InputError(f"{name}: (least, greatest) with least < greatest is needed; found ({least}, {greatest})", argument=name)
    if not by_logarithm:
        return Draw(1, lambda numbers: min(max(least + float(numbers[0]) * (greatest - least), least), greatest), math.inf)
    if least <= 0:
        raise InputError(f"{name}: numbers above 0 are needed for a key in log; found ({least}, {greatest})", argument=name)
    begin, times = math.log(least), math.log(greatest) - math.log(least)
    return Draw(1, lambda numbers: min(max(math.exp(min(begin + float(numbers[0]) * times, MOST_LOG)), least), greatest), math.inf)


def _given(name: str, value: Any) -> Draw:
    """A number that is not drawn."""
    number = _arguments.number(name, value)
    if not math.isfinite(number):
        raise InputError(f"{name}: a finite number is needed; found {shown(value)}", argument=name)
    return Draw(0, lambda _: number, 1)


def _choice(name: str, stated: Sequence[Any]) -> Draw:
    if not stated:
        raise InputError(f"{name}: at least one value is needed; found none", argument=name)
    if isinstance(stated, range):
        if max(abs(stated[0]), abs(stated[-1])) > MOST_WHOLE:
            raise InputError(f"{name}: integers up to {MOST_WHOLE} are needed; found {stated!r:.80}", argument=name)
        return Draw(1, lambda numbers: stated[int(float(numbers[0]) * len(stated))], len(stated))
    values = [_plain(f"{name}[{place}]", value) for place, value in enumerate(stated)]
    texts = [as_json(value) for value in values]
    if len(set(texts)) < len(texts):
        twice = next(text for text in texts if texts.count(text) > 1)
        raise InputError(f"{name}: different values are needed; {twice:.60} is there twice", argument=name)
    return Draw(1, lambda numbers: values[int(float(numbers[0]) * len(values))], len(values))


def _plain(name: str, value: Any, depth: int = 0) -> Any:
    """A value that a scenario can state, within so many lists."""
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, (list, tuple)):
        if depth == DEEPEST:
            raise InputError(f"{name}: lists are needed that are at most {DEEPEST} deep in each other; found one more", argument=name)
        return [_plain(f"{name}[{place}]", part, depth + 1) for place, part in enumerate(value)]
    if isinstance(value, (str, bool)):
        return value
    if not isinstance(value, (int, float)):
        raise InputTypeError(f"{name}: a number, a text, True, False or a list of them is needed; found {shown(value)}", argument=name)
    _given(name, value)
    return value
