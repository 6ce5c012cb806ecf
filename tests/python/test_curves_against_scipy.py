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


def over(plan, plate, settings):
    """First and last point of the paper's spiral over a plate: its centre, and where its last turn ends."""
    x, y, z = plan["job"]["plates"][plate]["pose"]["position_m"]
    spiral = settings["spiral"]
    angle = 2 * np.pi * spiral["turns"]
    end = spiral["radius_m"] * np.array([np.cos(angle), np.sin(angle), 0.0])
    centre = np.array([x, y, z + settings["height_m"]])
    return centre, centre + end


def waypoints(start, end, arc):
    """Up to the arc round the base, the shorter way round, and down."""
    first, last = (np.arctan2(p[1], p[0]) for p in (start, end))
    turn = (last - first + np.pi) % (2 * np.pi) - np.pi
    angles = first + turn * np.linspace(0.0, 1.0, arc["points"])
    ring = [(arc["radius_m"] * np.cos(a), arc["radius_m"] * np.sin(a), arc["height_m"]) for a in angles]
    return np.array([start, *ring, end])


@pytest.mark.parametrize("interpolation", ["zero_velocity", "c2_spline"])
def test_transits_agree_with_scipy(platewash, tmp_path, interpolation):
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
    dt, settings = plan["job"]["simulation"]["control"]["dt_s"], plan["job"]["planner"]["paper"]
    assert settings["transit"] == {"interpolation": interpolation, "samples": 50}
    compared = 0
    for before, segment in zip(plan["segments"], plan["segments"][1:]):
        if segment["kind"] != "transit":
            continue
        through = over(plan, before["plate"], settings)[-1], over(plan, segment["plate"], settings)[0]
        curve = reference(interpolation, waypoints(*through, settings["arc"]))
        first = round(segment["t_start_s"] / dt) + 1
        last = round(segment["t_end_s"] / dt)
        expected = curve(np.linspace(0.0, 1.0, 50))
        assert last - first + 1 == 50
        # Unreached waypoints (none here) would show as errors far beyond the solver's 1e-6 m.
        np.testing.assert_allclose(tip[first : last + 1], expected, atol=2e-6)
        compared += 1
    assert compared == 2
