"""Plans of other kinds than a washing: dry runs in the air, the way home after a stop, and the plates that are left."""

import json
import os
import subprocess

import numpy as np
import pytest
from jobs import ROOT, irb120, sealed
from platewash_check.check import check
from platewash_check.clearance import Clearance
from platewash_check.motion import Motion
from platewash_check.plan import Plan
from platewash_check.schema import Refused
from platewash_check.statements import answers, raised
from platewash_check.verdict import CONFIRMED

COMMAND = os.environ.get("PLATEWASH_BIN", str(ROOT / "target/release/platewash"))


def made(*arguments):
    subprocess.run([COMMAND, "-q", *map(str, arguments)], check=True, capture_output=True)


@pytest.fixture(scope="module")
def dry_run(plan_file, tmp_path_factory):
    """The plan of a dry run."""
    out = tmp_path_factory.mktemp("dry")
    made("dry-run", plan_file("sink"), "--out", out)
    return out / "dry-run/plan.json"


@pytest.fixture(scope="module")
def recovery(plan_file, tmp_path_factory):
    """The folder of both plans after a stop in the middle of the second wash."""
    out, file = tmp_path_factory.mktemp("recovery"), plan_file("sink")
    plan = json.loads(file.read_text())
    wash = [segment for segment in plan["segments"] if segment["kind"] == "wash"][1]
    k = int(np.searchsorted(plan["knots"]["t_s"], 0.5 * (wash["t_start_s"] + wash["t_end_s"])))
    at = [repr(float(angle)) for angle in np.degrees(plan["knots"]["q_rad"][k])]
    made("recover", file, "--at-deg", *at, "--stopped-s", repr(plan["knots"]["t_s"][k]), "--out", out)
    return out / "recovery"


def parts(table):
    plan = Plan(sealed(table))
    motion = Motion(plan.t, plan.q, plan.qd)
    return plan, motion, Clearance(irb120(), plan, motion)


def open_of(table, among=lambda plan, motion, clearance: answers(irb120(), plan, motion, clearance)):
    """Requirements that are not confirmed."""
    return [answer.requirement for answer in among(*parts(table)) if answer.status != CONFIRMED]


def test_a_dry_run_has_its_real_plates_below_it(dry_run):
    table = json.loads(dry_run.read_text())
    assert open_of(table) == []
    obstacles = lambda p: p["job"]["workcell"]["obstacles"]
    real = lambda p: next(body for body in obstacles(p) if body["name"] == "real plate 2")
    for change, words in (
        (lambda p: obstacles(p).remove(real(p)), "plate 2 has no real plate below it"),
        (lambda p: real(p)["pose"]["position_m"].__setitem__(0, real(p)["pose"]["position_m"][0] + 1e-6), "real plate 2 is not 50 mm below"),
        (lambda p: real(p)["shape"]["convex"]["cylinder"].update(radius_m=0.14), "real plate 2 is not 50 mm below"),
        (lambda p: real(p).update(shape={"convex": {"sphere": {"radius_m": 0.1}}}), "plate 2 has no real plate below it"),
        (lambda p: p["job"]["dry_run"].update(height_m=0.06), "is not 60 mm below"),
        (lambda p: obstacles(p).append({**real(p), "name": "box"}), "real plate 2 and box overlap"),
    ):
        bad = json.loads(json.dumps(table))
        change(bad)
        plan, _, clearance = parts(bad)
        assert any(words in fault for fault in raised(plan, clearance)), words
    # What the sponge would press in the air is not judged, and no motion may be too fast.
    assert "contact" not in parts(table)[0].requirements
    bad = json.loads(json.dumps(table))
    bad["job"]["dry_run"]["parent"] = "the washing"
    with pytest.raises(Refused, match="64 digits"):
        Plan(sealed(bad))


@pytest.mark.skipif("PLATEWASH_THOROUGH" not in os.environ, reason="a minute")
def test_a_dry_run_is_confirmed(dry_run):
    assert open_of(json.loads(dry_run.read_text()), lambda plan, motion, _: check(irb120(), plan)) == []


def test_the_way_home_and_the_rest_are_confirmed(recovery):
    home = json.loads((recovery / "home.json").read_text())
    all_of = lambda plan, motion, _: check(irb120(), plan)
    found = {answer.requirement: answer for answer in all_of(*parts(home))}
    assert [a for a in found.values() if a.status != CONFIRMED] == []
    theirs = json.loads((recovery / "home.certificate.json").read_text())["checks"]
    assert {check["requirement"] for check in theirs} == set(found)
    for check_ in theirs:
        if check_.get("measure") and check_["requirement"] != "clearance":
            bound, limit = check_["measure"]["bound"], check_["measure"]["limit"]
            assert abs(found[check_["requirement"]].bound - bound) <= 0.03 * max(limit, abs(bound)), check_
    assert open_of(json.loads((recovery / "rest.json").read_text())) == []


def test_a_way_home_that_was_changed_is_not_confirmed(recovery):
    home = json.loads((recovery / "home.json").read_text())
    plate = home["job"]["recovery"]["part"]["home"]["retreat"]["plate"]
    place = lambda p: p["job"]["plates"][plate]["pose"]["position_m"]
    all_of = lambda plan, motion, _: check(irb120(), plan)
    for change, requirement in (
        (lambda p: p["job"]["requirements"].update(lifting_m_s=0.01), "contact_speed"),
        # The plate is not where the retreat begins: the sponge stands below it, or the retreat is not along its normal.
        (lambda p: place(p).__setitem__(2, place(p)[2] + 0.06), "contact_height"),
        (lambda p: p["job"]["plates"][plate]["pose"].update(quaternion_wxyz=[np.cos(0.1), np.sin(0.1), 0, 0]), "line_deviation"),
        (lambda p: p["job"]["recovery"]["part"]["home"].update(retreat=None), "segments"),
        (lambda p: p["job"]["home_rad"][1].__setitem__(0, 0.5), "home_to_home"),
    ):
        bad = json.loads(json.dumps(home))
        change(bad)
        assert requirement in open_of(bad, all_of), requirement


def test_a_recovery_that_contradicts_itself_is_refused(recovery):
    home, rest = (json.loads((recovery / name).read_text()) for name in ("home.json", "rest.json"))
    for table, change in (
        (home, lambda p: p["job"]["recovery"].update(left_out=[0])),
        (home, lambda p: p["job"]["requirements"].update(landing_m_s=0.02)),
        (home, lambda p: p["job"].update(dry_run={"parent": "0" * 64, "height_m": 0.05})),
        (rest, lambda p: p["job"]["recovery"].update(left_out=[])),
        (rest, lambda p: p["job"]["recovery"].update(left_out=[2, 1])),
        (rest, lambda p: p["job"]["recovery"].update(part="all")),
        (rest, lambda p: p["job"]["recovery"].update(parent="A" * 64)),
    ):
        bad = json.loads(json.dumps(table))
        change(bad)
        with pytest.raises(Refused):
            Plan(sealed(bad))
    # A plate that is left out and washed all the same.
    bad = json.loads(json.dumps(rest))
    bad["job"]["recovery"]["left_out"] = sorted({*bad["job"]["recovery"]["left_out"], bad["order"][0]})
    if len(bad["job"]["recovery"]["left_out"]) < len(bad["job"]["plates"]):
        assert "every_plate_once" in open_of(bad)
