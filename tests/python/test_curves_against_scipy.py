"""The curves between plates against SciPy, through the files that the command writes."""

import csv
import json
import subprocess
from pathlib import Path

import numpy as np
import pytest
from scipy.interpolate import CubicHermiteSpline, CubicSpline

ROOT = Path(__file__).resolve().parents[2]


def reference(interpolation, points):
    times = np.linspace(0.0, 1.0, len(points))
    if interpolation == "zero_velocity":
        return CubicHermiteSpline(times, points, np.zeros_like(points))
    return CubicSpline(times, points, bc_type="clamped")


@pytest.mark.parametrize("interpolation", ["zero_velocity", "c2_spline"])
def test_transitions_are_scipys_curves(platewash, tmp_path, interpolation):
    text = (ROOT / "scenarios/paper-appendix.toml").read_text()
    # Plates well within reach, so that the commanded tip is on its waypoint to the solver's tolerance.
    edited = text.replace('interpolation = "zero_velocity"', f'interpolation = "{interpolation}"')
    edited = edited.replace('region = "appendix"', "positions_m = [[0.22, -0.28], [0.36, 0.0], [0.22, 0.28]]")
    scenario = tmp_path / "case.toml"
    scenario.write_text(edited)
    subprocess.run([platewash, "plan", "--quiet", "--scenario", scenario, "--out", tmp_path], check=True, capture_output=True)
    plan = json.loads((tmp_path / "plan.json").read_text())
    with open(tmp_path / "trajectory.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    tip = np.array([[float(row[f"tip_{axis}_m"]) for axis in "xyz"] for row in rows])
    dt = plan["scenario"]["control"]["dt_s"]
    compared = 0
    # The step from the start to the first waypoint has no tool path.
    segments = [s for s in plan["segments"] if s["kind"] != "depart"]
    for segment, path in zip(segments, plan["tool_path"], strict=True):
        if segment["kind"] != "transition":
            continue
        assert path["interpolation"] == interpolation
        curve = reference(interpolation, np.array(path["through_m"]))
        first = round(segment["t_start_s"] / dt) + 1
        last = round(segment["t_end_s"] / dt)
        expected = curve(np.linspace(0.0, 1.0, path["samples"]))
        assert last - first + 1 == path["samples"] == 50
        # Unreached waypoints (none here) would show as errors far beyond the solver's 1e-6 m.
        np.testing.assert_allclose(tip[first : last + 1], expected, atol=2e-6)
        compared += 1
    assert compared == 2
