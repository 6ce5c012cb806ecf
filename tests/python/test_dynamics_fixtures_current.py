"""The dynamics fixtures are what their generator writes today, and both of its sources agree."""

import json
import sys

import numpy as np
import pytest
from conftest import ROOT

FIXTURES = ROOT / "crates" / "simulator" / "tests" / "fixtures"
sys.path.insert(0, str(FIXTURES))

import generate_dynamics  # noqa: E402

NAMES = list(generate_dynamics.cases())


def committed(name: str) -> dict:
    return json.loads((FIXTURES / f"{name}.json").read_text(encoding="utf-8"))


def test_no_fixture_is_stale_or_missing():
    assert {path.stem for path in FIXTURES.glob("*.json")} == set(NAMES)


@pytest.mark.parametrize("name", NAMES)
def test_values_are_current(name):
    old, new = committed(name), generate_dynamics.reference(name)
    assert {key: old[key] for key in old if key != "states"} == {key: new[key] for key in new if key != "states"}
    assert len(old["states"]) == len(new["states"]) > 0
    for before, now in zip(old["states"], new["states"]):
        assert list(before) == list(now)
        for key in now:
            np.testing.assert_allclose(before[key], now[key], rtol=1e-11, atol=1e-11, err_msg=f"{name} {key}")


@pytest.mark.parametrize("name", NAMES)
def test_first_states_do_not_depend_on_their_number(name):
    few = generate_dynamics.reference(name, 3)["states"]
    assert [state["q"] for state in few] == [state["q"] for state in committed(name)["states"][:3]]


@pytest.mark.parametrize("name", NAMES)
def test_pinocchio_and_mujoco_agree(name):
    for state in generate_dynamics.reference(name, 200)["states"]:
        forward, other = np.array(state["forward"]), np.array(state["forward_mujoco"])
        assert np.abs(forward - other).max() < 1e-10 * np.abs(forward).max()
