"""Rows of a study that are drawn: within their ranges, none twice, the same again, and spread as their method says."""

import json
import math
import sys
import warnings
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import pyplatewash as pw

METHODS = ["sobol", "latin_hypercube", "random"]
RANGES: dict[str, Any] = {"tool.length_m": (0.05, 0.25), "wash.pattern": ["rings", "spiral"], "plate[0].at_m": ((0.0, 0.3), (-0.38, 0.38), 0.03), "seed": range(1, 100)}

numbers = st.floats(-1e6, 1e6, allow_nan=False)
ends = st.tuples(numbers, st.floats(1e-3, 1e6)).map(lambda drawn: (drawn[0], drawn[0] + drawn[1]))


@settings(max_examples=60, derandomize=True, database=None, deadline=None)
@given(st.dictionaries(st.text("abc._", min_size=1), ends, min_size=1, max_size=4), st.integers(1, 40), st.sampled_from(METHODS), st.integers(0, 2**53 - 1))
def test_samples_are_within_their_ranges_distinct_and_the_same_again(ranges: dict[str, tuple[float, float]], count: int, method: Any, seed: int) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        rows = pw.samples(ranges, count, method, seed=seed)
        assert rows == pw.samples(ranges, count, method, seed=seed)
    assert len(rows) == count == len({json.dumps(row) for row in rows})
    for row in rows:
        assert list(row) == list(ranges)
        assert all(type(row[key]) is float and low <= row[key] <= high for key, (low, high) in ranges.items())


@pytest.mark.parametrize("method", METHODS)
def test_samples_every_kind_of_value(method: Any) -> None:
    rows = pw.samples(RANGES, 64, method, seed=2)
    assert rows != pw.samples(RANGES, 64, method, seed=3)
    assert {row["wash.pattern"] for row in rows} == {"rings", "spiral"} and len({row["seed"] for row in rows}) > 20
    for row in rows:
        x_m, y_m, z_m = row["plate[0].at_m"]
        assert 0 <= x_m <= 0.3 and -0.38 <= y_m <= 0.38 and z_m == 0.03 and 0.05 <= row["tool.length_m"] <= 0.25
        assert type(row["seed"]) is int and 1 <= row["seed"] < 100
    json.dumps(rows)


@pytest.mark.parametrize(("method", "strata"), [("sobol", 64), ("latin_hypercube", 64)])
def test_each_range_is_filled_evenly(method: Any, strata: int) -> None:
    rows = pw.samples({"a": (0.0, 1.0), "b": (-1.0, 1.0), "c": [1, 2, 3, 4]}, strata, method, seed=5)
    for key, low, wide in (("a", 0.0, 1.0), ("b", -1.0, 2.0)):
        assert sorted(math.floor((row[key] - low) / wide * strata) for row in rows) == list(range(strata))
    assert [sum(row["c"] == value for row in rows) for value in (1, 2, 3, 4)] == 4 * [strata // 4]


def test_samples_a_range_by_its_logarithm() -> None:
    rows = pw.samples({"a": (1e-6, 1.0), "b": (0.0, 1.0)}, 64, seed=1, log=["a"])
    assert sorted(math.floor(math.log10(row["a"]) / 6 * 64 + 64) for row in rows) == list(range(64))
    assert np.median([row["a"] for row in rows]) == pytest.approx(1e-3, rel=0.2)


def test_sobol_warns_of_counts_that_are_no_power_of_two() -> None:
    with pytest.warns(UserWarning, match="power of 2"):
        pw.samples({"a": (0.0, 1.0)}, 3)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        pw.samples({"a": (0.0, 1.0)}, 8)


@pytest.mark.filterwarnings("ignore:The balance properties")
@pytest.mark.parametrize("method", METHODS)
def test_lists_alone_are_drawn_without_one_row_twice(method: Any) -> None:
    rows = pw.samples({"a": [1, 2, 3], "b": ["x", "y"]}, 6, method)
    assert sorted((row["a"], row["b"]) for row in rows) == [(a, b) for a in (1, 2, 3) for b in ("x", "y")]
    with pytest.raises(pw.InputError, match="count: an integer up to 6 is needed, as many different rows as there are; found 7"):
        pw.samples({"a": [1, 2, 3], "b": ["x", "y"]}, 7, method)


#: A list that is within itself.
NESTED: list[Any] = []
NESTED.append(NESTED)

BAD: list[tuple[Any, dict[str, Any], str]] = [
    ({}, {}, "ranges: at least one key is needed"),
    ({"a": 3}, {}, r"ranges\['a'\]: \(least, greatest\), a list of values.* found 3 \(int\)"),
    ({"a": (1, 2, 3)}, {}, r"ranges\['a'\]: .*; found a tuple of 3"),
    ({"a": (2, 1)}, {}, r"ranges\['a'\]: \(least, greatest\) with least < greatest is needed; found \(2.0, 1.0\)"),
    ({"a": (1, 1)}, {}, "least < greatest"),
    ({"a": (-1.7e308, 1.7e308)}, {}, "least < greatest"),
    ({"a": (0, math.nan)}, {}, r"ranges\['a'\]: a finite number is needed; found nan"),
    ({"a": (0, 10**400)}, {}, "a number is needed; found 1000"),
    ({"a": (0, "1")}, {}, r"ranges\['a'\]: a number is needed; found '1' \(str\)"),
    ({"a": ((0, 1), None)}, {}, r"ranges\['a'\]\[1\]: a number is needed; found None"),
    ({"a": []}, {}, r"ranges\['a'\]: at least one value is needed"),
    ({"a": [1, 2, 1]}, {}, r"ranges\['a'\]: different values are needed; 1 is there twice"),
    ({"a": [1, math.inf]}, {}, r"ranges\['a'\]\[1\]: a finite number is needed"),
    ({"a": range(10**30)}, {}, r"ranges\['a'\]: integers up to 9007199254740991 are needed; found range\(0, 1000"),
    ({"a": [NESTED]}, {}, r"ranges\['a'\]\[0\](\[0\]){10}: lists are needed that are at most 10 deep in each other"),
    ({"a": [None]}, {}, r"ranges\['a'\]\[0\]: a number, a text, True, False or a list of them is needed"),
    ({3: (0, 1)}, {}, "ranges: keys of scenarios are needed; found 3"),
    ({"a": (0, 1)}, {"log": ["a"]}, r"ranges\['a'\]: numbers above 0 are needed for a key in log"),
    ({"a": [1]}, {"log": ["a"]}, r"ranges\['a'\]: a range is needed for a key in log"),
    ({"a": (0, 1)}, {"log": ["b"]}, "log: keys of ranges are needed; found b"),
    ({"a": (0, 1)}, {"count": 0}, "count: an integer from 1 to 10000000 is needed; found 0"),
    ({"a": (0, 1)}, {"count": 2.0}, "count: an integer .* found 2.0"),
    ({"a": (0, 1)}, {"method": "halton"}, 'method: one of "sobol", "latin_hypercube", "random" is needed; found .halton.'),
    ({"a": (0, 1)}, {"seed": -1}, "seed: an integer from 0 to 9007199254740991 is needed; found -1"),
    ({"a": tuple((0, 1) for _ in range(1001))}, {}, "ranges: at most 1000 numbers are drawn"),
]


@pytest.mark.parametrize(("ranges", "others", "words"), BAD, ids=[words for _, _, words in BAD])
def test_names_values_that_form_no_range(ranges: Any, others: dict[str, Any], words: str) -> None:
    with pytest.raises((pw.InputError, pw.InputTypeError), match=words):
        pw.samples(ranges, **{"count": 2, **others})


@pytest.mark.parametrize("method", ["sobol", "latin_hypercube", "random"])
def test_a_range_may_be_as_wide_as_numbers_are(method: Any) -> None:
    ends = (5e-324, sys.float_info.max)
    drawn = [row["a"] for row in pw.samples({"a": ends}, 256, method, log=["a"])]
    assert all(ends[0] <= value <= ends[1] for value in drawn) and len(set(drawn)) == 256
    assert sum(value < 1e-7 for value in drawn) == pytest.approx(128, abs=30)  # The middle, by the logarithm, is about 3e-8.


def test_without_scipy_the_message_says_how_to_get_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "scipy", None)
    monkeypatch.setitem(sys.modules, "scipy.stats", None)
    with pytest.raises(ImportError, match=r"pip install 'pyplatewash\[study\]'") as caught:
        pw.samples({"a": (0, 1)}, 2)
    assert isinstance(caught.value, pw.MissingError) and caught.value.name == "scipy"
