"""Values that were probably meant in another unit: warnings of Python's, and data."""

import warnings

import numpy as np
import pytest

import pyplatewash as pw

HOME = [0, -np.pi / 2, np.pi / 2, 0, 0.5, 0]


def test_a_home_in_radians_is_warned_of() -> None:
    kitchen = pw.Scenario.load("kitchen")
    with pytest.warns(UserWarning, match="robot.start_deg.*radians were probably meant") as caught:
        scenario = kitchen.replace(robot={"start_deg": HOME})
    assert caught[0].filename == __file__
    (note,) = scenario.notes
    assert note["kind"] == "home_in_radians" and note["key"] == "robot.start_deg"
    assert np.allclose(note["meant_deg"], np.degrees(HOME), rtol=1e-3)
    with pytest.warns(UserWarning, match="robot.home_deg"):
        pw.Scenario.parse(kitchen.to_toml().replace("[robot]", f"[robot]\nhome_deg = {list(map(float, HOME))}"))


def test_homes_in_degrees_are_not_warned_of() -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for name in pw.Scenario.shipped():
            assert pw.Scenario.load(name).notes == []
        pw.Scenario.load("kitchen").replace(robot={"start_deg": [0, 0, 0, 0, 90, 0.5]})
