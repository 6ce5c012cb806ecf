"""The wheel has everything of Rust's façade that makes sense in Python; its examples hold."""

import doctest
import importlib
import re
import subprocess
from pathlib import Path

import pytest

import pyplatewash as pw

# What each name of the façade is in Python; None with the reason where it is nothing.
PYTHON = {
    # Modules of Rust's; their nouns are at the top.
    "bodies": "ClearanceModel",
    "certificate": None,
    "editor": "edit",
    "export": "Plan.export",
    "kinematics": None,
    "motion": "Trajectory",
    "motion_proof": "prove_motion",
    "paper": None,
    "planner": None,
    "scenario": None,
    "server": None,  # the command's; the cell in a notebook needs none
    "simulator": None,
    "study": "Study",
    "workcell": None,
    "viewer": "Plan.show",  # the page, and figures
    "cli": "run_command",
    # The way through.
    "Certificate": "Certificate",
    "Certified": "Certificate.proved",  # a proof is asked, not held in a type
    "Check": "Certificate.checks",
    "ProveError": "ProveError",
    "Requirement": "Certificate.checks",
    "certify": "prove",
    "prove": "prove",
    "prove_motion": "prove_motion",
    "MotionReport": "prove_motion",
    "PlanError": "PlanError",
    "PlannedJob": "Planned",
    "plan": "plan",
    "Failure": "PlatewashError",
    "Scenario": "Scenario",
    "ScenarioError": "ScenarioError",
    "Execution": "Execution",
    "SimulationError": "SimulationError",
    "SimulationReport": "Execution.report",
    "SimulationVerdict": "Execution.report",
    "simulate": "simulate",
    "tune": "tune",
    "WashReport": "Planned.report",
    "paper_spirals": "Plan.figure",
    "judged_motion": None,  # what `prove_motion` judges; its record says how long the stop takes
    "sweep": "sweep",
    # What they speak of.
    "Axes": "Robot.jacobian",  # axes="base" or "local"
    "CancelToken": None,  # Ctrl-C
    "ClearanceModel": "ClearanceModel",
    "DynamicsError": "DynamicsError",
    "DynamicsModel": "DynamicsModel",
    "Energy": "Energy",
    "Frame": "Robot.fk",  # frames go by name
    "IkError": "IkError",
    "IkFailure": "IkError",
    "IkSettings": "IkSettings",
    "IkSolution": "IkSolution",
    "IkSolver": "Robot.ik",
    "Jacobian": "Robot.jacobian",  # an array
    "JobTerms": "WashJob.to_dict",
    "JointVector": None,  # an array of shape (6,)
    "Layout": "Layout",
    "PairClearance": "ClearanceModel.smallest",
    "PaperJob": "PaperJob",
    "PaperReport": "PaperRun.report",
    "PaperRun": "PaperRun",
    "Plan": "Plan",
    "Plate": "Plate",
    "Pose": None,  # an array of shape (4, 4)
    "RobotModel": "Robot",
    "Surface": "Plate",  # a level disc
    "Tool": "Tool",
    "ToolFrame": "Robot.fk",
    "Trajectory": "Trajectory",
    "Verdict": "Planned.report",
    "WashJob": "WashJob",
    "Workcell": "WashJob.workcell",
}


def rust_names(root: Path) -> set[str]:
    text = (root / "src" / "lib.rs").read_text()
    names = set(re.findall(r"^pub mod (\w+)", text, flags=re.MULTILINE))
    for used in re.findall(r"^pub use [\w:]*?(?:::)?(\{[^}]*\}|\w+)(?: as (\w+))?;", text, flags=re.MULTILINE):
        names |= set(re.findall(r"\w+", used[1] or used[0]))
    return names


def test_every_name_of_the_rust_facade_is_listed(root: Path) -> None:
    assert rust_names(root) == set(PYTHON), "name what is new in PYTHON, and bind it"
    for there in filter(None, PYTHON.values()):
        thing = pw
        for part in there.split("."):
            thing = getattr(thing, part)


def test_scenarios_and_verbs_are_those_of_the_command(platewash: Path) -> None:
    assert pw.__version__ in subprocess.run([platewash, "--version"], capture_output=True, text=True).stdout
    assert sorted(pw.__all__) == pw.__all__
    for name in pw.__all__:
        assert getattr(pw, name).__doc__, f"{name} has no docstring"


@pytest.mark.parametrize("module", ["", "._values", "._records", "._errors", "._page", "._figure", "._tables", "._studies.samples", "._figures", ".ros"])
def test_examples_in_docstrings_run(module: str) -> None:
    found = doctest.testmod(importlib.import_module("pyplatewash" + module))
    assert found.failed == 0
