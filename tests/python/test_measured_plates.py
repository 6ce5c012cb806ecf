"""What is proved of a plate out of a mesh holds for the mesh: its own facets are pressed, long enough and with the dose.

The mesh is made here from a profile, with noise; SciPy evaluates the knots of the plan, Pinocchio the arm.
"""

import json
import math
import os
import random
import struct
import subprocess

import numpy as np
import pinocchio as pin
import pytest
from scipy.interpolate import CubicHermiteSpline

#: Knots of the built-in profiles: radius [mm], slope [°].
PROFILES = {
    "coupe": [(24, 1.1), (74, 1.9), (92, 10), (106, 17.5), (119, 28.5), (129, 30), (137, 5)],
    "rim": [(82, 0), (93, 38), (103, 11), (131, 11), (135, 0)],
    "deep": [(42, 0), (84, 50), (95, 12), (112, 12), (115, 0)],
    "dessert": [(58, 2), (70, 10), (84, 22), (92, 22), (95, 5)],
}
NOISE_MM = 0.05
THICK_MM = 5.0
#: Part of the height error that is left for the pose of the mesh, which the fit finds within it [m].
POSE_M = 2e-4
POINTS = 1500
STEP_S = 1e-3
#: Meshes: scenario and number of triangles. Ten of them where PLATEWASH_THOROUGH is set.
MESHES = [("dessert", 10_000), ("coupe", 1000)]
if os.environ.get("PLATEWASH_THOROUGH"):
    MESHES = [(name, count) for name in PROFILES for count in (10_000, 100_000)] + [("coupe", 1000), ("dessert", 1000)]


def height(knots, radius):
    """Height over the pole [mm]: between knots the sine of the slope is linear in the radius."""
    z, r0, s0 = 0.0, 0.0, 0.0
    for rk, slope in knots:
        s1 = math.sin(math.radians(slope))
        end = min(radius, rk)
        s = s0 + (s1 - s0) / (rk - r0) * (end - r0)
        z += (end - r0) * (s0 + s) / (math.sqrt(1 - s0 * s0) + math.sqrt(1 - s * s))
        if radius <= rk:
            break
        r0, s0 = rk, s1
    return z


def plate(name, count):
    """Vertices [mm] and triangles of a closed plate with a foot, in its own frame; the first ones are those of the face."""
    knots = PROFILES[name]
    rim = knots[-1][0]
    fine = np.linspace(0, rim, 4001)
    heights = np.array([height(knots, r) for r in fine])
    arc = np.concatenate([[0], np.cumsum(np.hypot(np.diff(fine), np.diff(heights)))])
    around = int(math.sqrt(1.1 * count))
    rings = max(4, count // (4 * around))
    radii = np.interp(arc[-1] * np.arange(1, rings + 1) / rings, arc, fine)
    face = [(r, height(knots, r)) for r in radii]
    under = [(r, z - THICK_MM - (3 if abs(r - 45) < 6 else 0)) for r, z in face]
    outline = face + under[::-1]
    azimuths = 2 * math.pi * np.arange(around) / around
    points = [(0.0, 0.0, 0.0)] + [(r * math.cos(a), r * math.sin(a), z) for r, z in outline for a in azimuths] + [(0.0, 0.0, -THICK_MM)]
    last = len(points) - 1
    triangles = [(0, 1 + k, 1 + (k + 1) % around) for k in range(around)]
    for i in range(len(outline) - 1):
        for k in range(around):
            a, b = 1 + i * around + k, 1 + i * around + (k + 1) % around
            triangles += [(a, a + around, b + around), (a, b + around, b)]
    on_face = around + 2 * around * (rings - 1)
    triangles += [(last, last - around + (k + 1) % around, last - around + k) for k in range(around)]
    return np.array(points), triangles, on_face


def write_stl(path, points, triangles):
    """Binary STL."""
    with path.open("wb") as file:
        file.write(bytes(80) + struct.pack("<I", len(triangles)))
        for triangle in triangles:
            file.write(struct.pack("<12fH", 0, 0, 0, *points[list(triangle)].ravel(), 0))


def on_facets(points, triangles, rng):
    """Points spread over the facets by their area."""
    corners = points[np.array(triangles)]
    areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    chosen = corners[rng.choice(len(areas), POINTS, p=areas / areas.sum())]
    u, v = np.sqrt(rng.random(POINTS)), rng.random(POINTS)
    return np.einsum("nc,nck->nk", np.stack([1 - u, u * (1 - v), u * v], axis=1), chosen)


def poses(plan, irb120, times):
    """Position of the tip and rotation of the tool at some times."""
    knots = plan["knots"]
    spline = CubicHermiteSpline(*(np.array(knots[key]) for key in ("t_s", "q_rad", "qd_rad_s")))
    model = irb120.copy()
    tip = plan["job"]["workcell"]["tool"]["tip"]
    w, x, y, z = tip["quaternion_wxyz"]
    flange = model.getFrameId("tool0")
    parent = model.frames[flange]
    offset = pin.SE3(pin.Quaternion(w, x, y, z), np.array(tip["position_m"]))
    frame = model.addFrame(pin.Frame("tip", parent.parentJoint, flange, parent.placement * offset, pin.FrameType.OP_FRAME))
    data, found = model.createData(), []
    for q in spline(times):
        pin.framesForwardKinematics(model, data, q)
        found.append((data.oMf[frame].translation.copy(), data.oMf[frame].rotation.copy()))
    return [np.array(column) for column in zip(*found)]


def reached(plan, irb120, index, points, required):
    """Shares of some points of a plate [m, world] that are pressed, long enough, and with the dose."""
    [segment] = [segment for segment in plan["segments"] if segment["kind"] == "wash" and segment["plate"] == index]
    times = np.arange(segment["t_start_s"], segment["t_end_s"], STEP_S)
    tips, turns = poses(plan, irb120, times)
    sponge = plan["job"]["workcell"]["tool"]["sponge"]
    free = sponge["height_m"] + sponge["compression_m"]
    longest, stayed, dose = (np.full(len(points), value) for value in (-np.inf, 0.0, 0.0))
    for k in range(len(times) - 1):
        axis = turns[k][:, 2]
        away = tips[k] - points
        along = away @ axis
        pressed = sponge["compression_m"] + along
        beside = np.einsum("nk,nk->n", away, away) - along**2
        inside = beside <= sponge["radius_m"] ** 2
        longest = np.where(inside, np.maximum(longest, pressed), longest)
        touches = inside & (pressed >= required["compression_m"])
        stayed += touches * STEP_S
        # The point of the sponge over each place moves with the tool.
        moved = tips[k + 1] - (points + ((tips[k] - points) @ turns[k]) @ turns[k + 1].T)
        dose += touches * sponge["stiffness_pa"][0] * pressed / free * np.linalg.norm(moved, axis=1)
    return [np.mean(longest >= required["compression_m"]), np.mean(stayed >= required["time_s"]), np.mean(dose >= required["dose_pa_m"])]


@pytest.mark.parametrize(("scenario", "count"), MESHES)
def test_what_is_proved_of_a_fitted_plate_holds_for_its_mesh(platewash, irb120, tmp_path, scenario, count):
    rng = np.random.default_rng(count)
    clean, triangles, on_face = plate(scenario, count)
    noisy = clean + rng.normal(0, NOISE_MM, clean.shape)
    turn = pin.exp3(np.array([random.Random(count).uniform(-1.5, 1.5) for _ in range(3)]))
    write_stl(tmp_path / "plate.stl", noisy @ turn.T + [113.0, -57.0, 31.0], triangles)
    text = subprocess.run([platewash, "scenario", scenario], check=True, capture_output=True, text=True).stdout
    lines = [line for line in text.splitlines() if not line.startswith("plate_thickness_m")]
    lines = ['plate_mesh = "plate.stl"' if line.startswith("plate_profile") else line for line in lines]
    (tmp_path / "mine.toml").write_text("\n".join(lines))
    command = [platewash, "run", "--quiet", "--scenario", tmp_path / "mine.toml", "--out", tmp_path / "out"]
    subprocess.run(command, check=True, capture_output=True)
    plan, certificate = (json.loads((tmp_path / "out" / f"{name}.json").read_text()) for name in ("plan", "certificate"))
    assert certificate["verdict"] == "pass"
    terms = plan["job"]["plates"][0]["terms"]
    assert NOISE_MM / 1000 < terms["deviation_m"] < 1e-3

    required = plan["job"]["requirements"]["contact"]
    pose = plan["job"]["plates"][0]["pose"]
    proved = next(contact for contact in certificate["contact"] if contact["plate"] == 0)
    w, x, y, z = pose["quaternion_wxyz"]
    facets = 1e-3 * on_facets(noisy, triangles[:on_face], rng)
    spare = required["height_error_m"] - POSE_M
    for off in (-spare, 0.0, spare):
        points = (facets + [0, 0, off]) @ pin.Quaternion(w, x, y, z).matrix().T + np.array(pose["position_m"])
        found = reached(plan, irb120, 0, points, required)
        for name, share in zip(("pressed", "time", "dose"), found):
            at_least = proved[name]["at_least"]
            # Points are few, and time is cut into steps.
            assert share >= at_least - 2 / math.sqrt(POINTS) * math.sqrt(max(1 - at_least, 1e-3)), f"{name}: {share} < {at_least}"
    # The check can fail: a plate that lies much lower is not pressed.
    low = facets @ pin.Quaternion(w, x, y, z).matrix().T + np.array(pose["position_m"]) - [0, 0, 8e-3]
    assert reached(plan, irb120, 0, low, required)[0] < 0.5
