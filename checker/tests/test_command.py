"""Whole plans, the command, and plans that were changed."""

import json
import os
import subprocess
import sys
import xml.etree.ElementTree as ET
from itertools import combinations
from pathlib import Path

import numpy as np
import pytest
from jobs import ROOT, irb120, sealed
from platewash_check import exact
from platewash_check.arm import Arm
from platewash_check.check import check
from platewash_check.clearance import Clearance
from platewash_check.mesh import vertices
from platewash_check.motion import Motion
from platewash_check.plan import Plan
from platewash_check.schema import Refused
from platewash_check.statements import apart
from platewash_check.washing import Washing, outside

CHECKER = Path(__file__).resolve().parents[1]


def run(*arguments):
    line = [sys.executable, "-m", "platewash_check", *map(str, arguments)]
    return subprocess.run(line, cwd=ROOT, env={"PYTHONPATH": str(CHECKER)}, capture_output=True, text=True)


def test_a_plan_is_confirmed_with_the_numbers_of_its_certificate(plan_file):
    made = plan_file("sink")
    found = run(made, "--json")
    assert found.returncode == 0, found.stdout + found.stderr
    answer = json.loads(found.stdout)
    assert answer["confirmed"] and answer["headline"].startswith("CONFIRMED: 31 of 31 requirements")
    ours = {a["requirement"]: a["bound"] for a in answer["answers"]}
    command = os.environ.get("PLATEWASH_BIN", str(ROOT / "target/release/platewash"))
    certificate = json.loads(subprocess.run([command, "verify", made, "--json"], capture_output=True, check=True).stdout)
    assert [c["requirement"] for c in certificate["checks"]] and len(certificate["checks"]) == len(ours)
    for theirs in certificate["checks"]:
        name, measure = theirs["requirement"], theirs.get("measure")
        if measure is None or name == "reach":
            continue
        sign = 1 if measure["sense"] == "at_most" else -1
        if measure["seen"] is not None:
            # What is seen at a single moment is never beyond what either program bounds.
            assert sign * (ours[name] - measure["seen"]) >= -1e-6 * (1 + abs(measure["seen"])), (name, ours[name], measure)
        # Apart from distances, which are only followed as far as they are asked for, both agree to 3 % of the limit.
        if name != "clearance":
            assert abs(ours[name] - measure["bound"]) <= 0.03 * max(measure["limit"], abs(measure["bound"])), (name, measure)


def test_bad_files_are_refused(tmp_path, plan_file):
    good = json.loads(plan_file("sink").read_text())
    for change, words in (
        (lambda p: p.update(more=1), "the key 'more' is not known"),
        (lambda p: p["job"]["workcell"]["tool"].update(handle=1), "tool: the key 'handle' is not known"),
        (lambda p: p.pop("knots"), "expected the key 'knots'"),
        (lambda p: p["knots"]["t_s"].pop(), "expected as many times"),
        (lambda p: p["knots"]["q_rad"][3].pop(), "knots.q_rad"),
        (lambda p: p["job"]["plates"][0]["pose"].update(quaternion_wxyz=[1, 1, 0, 0]), "expected a length of 1"),
        (lambda p: p.update(format="platewash-plan/1"), "platewash-plan/2"),
    ):
        bad = json.loads(json.dumps(good))
        change(bad)
        file = tmp_path / "bad.json"
        file.write_text(json.dumps(bad))
        found = run(file)
        assert found.returncode == 2 and words in found.stderr and not found.stdout, found.stderr
    for text, words in (("{", "not JSON"), ('{"a": NaN}', "NaN"), ('{"a": 1, "a": 2}', "stands twice")):
        with pytest.raises(Refused, match=words):
            Plan(text)
    assert run("none.json").returncode == 2


def changed(plan_file, change):
    """The plan of a scenario with another workcell."""
    table = json.loads(plan_file("sink").read_text())
    change(table["job"]["workcell"])
    plan = Plan(sealed(table))
    return plan, Motion(plan.t, plan.q, plan.qd)


@pytest.mark.parametrize("height", [0.2, 0.07])
def test_a_floor_that_cuts_link_1_or_is_too_near_it_is_found(height, plan_file):
    def raise_floor(cell):
        floor = next(o for o in cell["obstacles"] if o["name"] == "floor")
        floor["pose"]["position_m"][2] = height

    clearance = Clearance(irb120(), *changed(plan_file, raise_floor))
    assert any("link_1 keeps" in fault for fault in clearance.still())


@pytest.mark.parametrize("parts", [1, 2])
def test_a_sheet_in_the_way_is_found(parts, plan_file, monkeypatch):
    corners = [[0.3, -0.3, 0.05], [0.3, 0.3, 0.05], [0.3, 0.3, 0.5], [0.3, -0.3, 0.5]]
    thick = lambda points: [[x + d, y, z] for x, y, z in points for d in (-5e-5, 5e-5)]
    hulls = [corners] if parts == 1 else [corners[:3], [corners[0], *corners[2:]]]
    sheet = {
        "name": "sheet",
        "pose": {"position_m": [0, 0, 0], "quaternion_wxyz": [1, 0, 0, 0]},
        "shape": {"parts": [thick(hull) for hull in hulls]},
    }
    clearance = Clearance(irb120(), *changed(plan_file, lambda cell: cell["obstacles"].append(sheet)))
    pairs = [pair for pair in clearance.pairs() if "sheet" in (pair[0].name, pair[1].name)]
    monkeypatch.setattr(clearance, "pairs", lambda: pairs)
    assert clearance.run()[0] < 0


def box(name, half, place):
    shape = {"convex": {"box": {"half_m": half}}}
    return {"name": name, "pose": {"position_m": place, "quaternion_wxyz": [1, 0, 0, 0]}, "shape": shape}


# Changes that make a plan false, or say what nobody can mean; each was confirmed once.
FALSE = {
    "an obstacle with the name of a plate": lambda p: p["job"]["workcell"]["obstacles"].append(box("plate 3", [0.02] * 3, [0.4, 0, 0.1])),
    "an obstacle with the name of a link": lambda p: p["job"]["workcell"]["obstacles"].append(box("link_6", [0.02] * 3, [0.4, 0, 0.1])),
    "a margin that is a text": lambda p: p["job"]["workcell"]["tool"]["bodies"][0].update(margin_m="nan"),
    "a margin below 0": lambda p: p["job"]["workcell"]["tool"]["bodies"][0].update(margin_m=-1),
    "a box inside out": lambda p: p["job"]["workcell"]["obstacles"].append(box("b", [-0.3] * 3, [0.4, 0, 0.1])),
    "a stiffness that descends": lambda p: p["job"]["workcell"]["tool"]["sponge"].update(stiffness_pa=[44000, 11000]),
    "an acceleration below 0": lambda p: scale(p["job"]["limits"]["joint_acceleration_rad_s2"], 0, -1),
    "a height error below 0": lambda p: scale(p["job"]["requirements"]["contact"], "height_error_m", -1),
    "a tool without bodies": lambda p: p["job"]["workcell"]["tool"].update(bodies=[]),
    "a segment that takes no time": lambda p: p["segments"][1].update(t_end_s=p["segments"][1]["t_start_s"]),
    "a trim that is too long": lambda p: p["wash_paths"][0]["curve"].update(trim_rad=2.0),
    "rings from outside": lambda p: p["wash_paths"][0]["curve"]["rings"].update(inner_m=0.3),
    "one ring": lambda p: p["wash_paths"][0]["curve"]["rings"].update(count=1),
    "an order of parts": lambda p: p.update(order=[x + 0.5 for x in p["order"]]),
    "an empty recovery": lambda p: p["job"].update(recovery={}),
    "a number that is infinite": lambda p: p["job"]["limits"].update(tip_speed_m_s=float("inf")),
}


@pytest.mark.parametrize("name", FALSE)
def test_plans_that_mean_something_else_are_refused(name, plan_file):
    table = json.loads(plan_file("sink").read_text())
    FALSE[name](table)
    with pytest.raises(Refused):
        plan = Plan(sealed(table))
        Clearance(irb120(), plan, Motion(plan.t, plan.q, plan.qd))


def test_pairs_that_are_left_out_are_those_of_the_rules(plan_file):
    for change, words in (
        (lambda cell: cell["exclusions"].pop(), "not named among the pairs"),
        (lambda cell: cell["exclusions"].append({"pair": ["link_3", "floor"], "reason": "srdf"}), "floor and link_3 are left out"),
        (lambda cell: cell["exclusions"][0].update(reason="neither_moves"), "are left out"),
    ):
        faults = Clearance(irb120(), *changed(plan_file, change)).exclusions()
        assert len(faults) == 1 and words in faults[0], faults
    # A collar behind the flange, beside link 5.
    collar = {
        "name": "collar",
        "pose": {"position_m": [0, 0, -0.004], "quaternion_wxyz": [1, 0, 0, 0]},
        "shape": {"cylinder": {"radius_m": 0.03, "half_length_m": 0.004}},
    }
    faults = Clearance(irb120(), *changed(plan_file, lambda cell: cell["tool"]["bodies"].append(collar))).still()
    assert any("collar reaches behind the flange" in fault for fault in faults), faults
    # A free-standing box whose name begins like a plate's.
    rack = changed(plan_file, lambda cell: cell["obstacles"].append(box("plate rack", [0.02] * 3, [-0.5, -0.5, 0.5])))
    clearance = Clearance(irb120(), *rack)
    assert list(apart(rack[0], clearance, clearance.plate_of)) == []


def test_the_area_beyond_a_rim_is_that_of_a_dense_sample():
    rng = np.random.default_rng(5)
    points = rng.uniform(-1, 1, (200_000, 2))
    for radius, away, rim in [(0.1, 0.01, 0.05), *rng.uniform(0.01, 0.4, (12, 3))]:
        inside = points[(points**2).sum(axis=1) <= 1] * radius + [away, 0]
        share = (np.linalg.norm(inside, axis=1) > rim).mean()
        assert abs(outside(radius, away, rim) - share * np.pi * radius**2) <= 0.01 * np.pi * radius**2


def test_a_fixture_takes_the_loads_that_the_certificate_names(plan_file):
    table = json.loads(plan_file("kitchen").read_text())
    for force, status in ((25.0, "confirmed"), (20.0, "not_confirmed")):
        table["job"]["requirements"]["holder"] = {
            "sponge_friction": 1.0,
            "fixture": {"force_n": force, "torque_nm": 3.0},
        }
        plan = Plan(sealed(table))
        washing = Washing(irb120(), plan, Motion(plan.t, plan.q, plan.qd))
        answer = next(answer for answer in washing.answers() if answer.requirement == "plate_stays")
        # docs/contact.md: 20.66 N and 2.59 N m.
        assert answer.status == status and "20.6" in answer.words and "2.5" in answer.words, answer


def test_pairs_without_an_srdf_are_neighbours_and_those_that_always_touch():
    arm = Arm((ROOT / "urdf/irb120.urdf").read_text())
    chain = ["base_link"] + [f"link_{k}" for k in range(1, 7)]
    assert arm.disabled == {frozenset(pair) for pair in zip(chain, chain[1:])}


def test_numbers_are_those_of_ball_arithmetic(plan_file):
    pytest.importorskip("flint")
    plan = Plan(plan_file("sink").read_text())
    answer = exact.answer(irb120(), plan, Motion(plan.t, plan.q, plan.qd), 300)
    assert answer.status == "confirmed" and answer.bound < 0.1, answer


# A requirement, and a change of the plan that breaks it.
MUTATIONS = {
    "arm": lambda p, rng: p["job"].update(seed=p["job"]["seed"] + 1),
    "joint_acceleration": lambda p, rng: scale(p["job"]["limits"]["joint_acceleration_rad_s2"], 0, rng.uniform(0.3, 0.9)),
    "tip_speed": lambda p, rng: scale(p["job"]["limits"], "tip_speed_m_s", rng.uniform(0.3, 0.6)),
    "tip_acceleration": lambda p, rng: scale(p["job"]["limits"], "tip_acceleration_m_s2", rng.uniform(0.23, 0.3)),
    "wash_speed": lambda p, rng: scale(p["job"]["requirements"], "wash_speed_m_s", rng.uniform(0.5, 0.99)),
    "wash_acceleration": lambda p, rng: scale(p["job"]["requirements"], "wash_acceleration_m_s2", rng.uniform(0.1, 0.3)),
    "tilt": lambda p, rng: scale(p["wash_paths"][0], "cone_rad", rng.uniform(0.3, 0.8)),
    "contact_height": lambda p, rng: lift(p, rng.uniform(3e-4, 2e-3)),
    "path_deviation": lambda p, rng: scale(p["wash_paths"][0]["curve"], "start_angle_rad", 1 + rng.uniform(0.01, 0.1)),
    "contact_speed": lambda p, rng: scale(p["job"]["requirements"], "landing_m_s", rng.uniform(0.2, 0.8)),
    "clearance": lambda p, rng: scale(p["job"]["requirements"], "clearance_m", rng.uniform(1.5, 4)),
    "swept": lambda p, rng: p["job"]["requirements"].update(coverage=0.9999),
    "pressed": lambda p, rng: p["job"]["requirements"]["contact"].update(share=0.9999),
    "contact_time": lambda p, rng: scale(p["job"]["requirements"]["contact"], "time_s", rng.uniform(3, 9)),
    "contact_dose": lambda p, rng: scale(p["job"]["requirements"]["contact"], "dose_pa_m", rng.uniform(2, 9)),
    "strain": lambda p, rng: scale(p["job"]["requirements"]["contact"], "strain", rng.uniform(0.2, 0.4)),
    "contact_force": lambda p, rng: scale(p["job"]["requirements"]["contact"]["force_n"], 1, rng.uniform(0.1, 0.4)),
    "wrist": lambda p, rng: p["job"]["requirements"].update(wrist_rad=rng.uniform(0.6, 1.2)),
    "home_to_home": lambda p, rng: scale(p["knots"]["qd_rad_s"][0], 0, 0, 1e-3),
    "plates_apart": lambda p, rng: scale(p["job"]["plates"][0]["surface"], "radius_m", 2.5),
    "exclusions": lambda p, rng: p["job"]["workcell"]["exclusions"].append({"pair": ["link_3", "floor"], "reason": "srdf"}),
}


def scale(table, key, by, plus=0.0):
    table[key] = table[key] * by + plus


def lift(p, by):
    p["job"]["plates"][0]["pose"]["position_m"][2] += by


@pytest.mark.parametrize("requirement", MUTATIONS)
def test_changed_plans_are_not_confirmed(requirement, plan_file, monkeypatch):
    table = json.loads(plan_file("sink").read_text())
    MUTATIONS[requirement](table, np.random.default_rng(list(MUTATIONS).index(requirement)))
    text = json.dumps(table) if requirement == "arm" else sealed(table)
    if requirement != "clearance":
        # It takes longest, and is none of what is changed.
        monkeypatch.setattr(Clearance, "run", lambda self, progress: (np.inf, None, 0.0))
    found = {}
    for answer in check(irb120(), Plan(text)):
        found[answer.requirement] = answer.status
        if answer.requirement == requirement:
            break
    assert found[requirement] == "not_confirmed", found


def stl(points, triangles):
    """A binary STL file."""
    body = b"".join(np.float32([[0, 0, 0], *points[t]]).tobytes() + b"\0\0" for t in triangles)
    return bytes(80) + np.uint32(len(triangles)).tobytes() + body


def test_links_of_meshes_are_those_that_the_plan_was_made_with(tmp_path):
    corners = np.array([[x, y, z] for x in (-30, 30) for y in (-30, 30) for z in (0, 80)], dtype=float)
    triangles = [list(t) for t in combinations(range(8), 3)]
    lines = lambda word: [f"{word} {x:g} {y:g} {z:g}" for t in triangles for x, y, z in corners[t]]
    faces = [f"f {3 * k + 1} {3 * k + 2} {3 * k + 3}" for k in range(len(triangles))]
    (tmp_path / "link.obj").write_text("\n".join(lines("v") + faces) + "\n")
    (tmp_path / "ascii.stl").write_text("\n".join(["solid link", *lines("vertex"), "endsolid link"]))
    (tmp_path / "binary.stl").write_bytes(stl(corners, triangles))
    points = [vertices(name, tmp_path, 1e-3) for name in ("link.obj", "ascii.stl", "binary.stl")]
    assert all(np.array_equal(found, points[0]) for found in points) and len(points[0]) == 8

    tree = ET.fromstring((ROOT / "urdf/irb120.urdf").read_text())
    shape = next(link for link in tree.findall("link") if link.get("name") == "link_4").find("collision/geometry")
    for old in list(shape):
        shape.remove(old)
    ET.SubElement(shape, "mesh", filename="link.obj", scale="0.001 0.001 0.001")
    (tmp_path / "arm.urdf").write_text(ET.tostring(tree, encoding="unicode"))
    (tmp_path / "arm.srdf").write_text((ROOT / "urdf/irb120.srdf").read_text())
    command = os.environ.get("PLATEWASH_BIN", str(ROOT / "target/release/platewash"))
    of_arm = ["--urdf", str(tmp_path / "arm.urdf"), "--srdf", str(tmp_path / "arm.srdf")]
    subprocess.run([command, "-q", "plan", "--scenario", "sink", *of_arm, "--out", str(tmp_path)], check=True)
    found = run(tmp_path / "plan.json", *of_arm)
    assert found.returncode == 0, found.stdout + found.stderr
    # A vertex more is another arm.
    with open(tmp_path / "link.obj", "a") as file:
        file.write("v 0 0 -80\n")
    found = run(tmp_path / "plan.json", *of_arm)
    assert found.returncode == 4 and "the description is not the plan's" in found.stdout, found.stdout


def test_broken_descriptions_are_refused(tmp_path, plan_file):
    urdf = (ROOT / "urdf/irb120.urdf").read_text()
    for text, words in (
        (urdf[:-20], "not XML"),
        (urdf.replace('<parent link="link_1"/>', ""), "a parent link"),
        (urdf.replace("</robot>", '<link name="link_1"/></robot>'), "each link once"),
        (urdf.replace("</robot>", '<link name="a"/><link name="b"/>' + "".join(
            f'<joint name="{a}{b}" type="fixed"><parent link="{a}"/><child link="{b}"/></joint>' for a, b in ("ab", "ba")
        ) + "</robot>"), "hang together"),
    ):
        (tmp_path / "arm.urdf").write_text(text)
        found = run(plan_file("sink"), "--urdf", tmp_path / "arm.urdf")
        assert found.returncode == 2 and words in found.stderr, found.stdout + found.stderr
