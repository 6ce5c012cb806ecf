"""The wheel has everything of Rust's façade that makes sense in Python; its types and its examples hold."""

import doctest
import importlib
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

import pyplatewash as pw

# What each name of the façade is in Python; None with the reason where it is nothing.
PYTHON = {
    # Modules of Rust's; their nouns are at the top.
    "certificate": None,
    "editor": "edit",
    "export": "Plan.export",
    "kinematics": None,
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
    "SWEEP_HEADER": None,  # the columns are the records' keys
    "SweepRow": "sweep",
    "sweep": "sweep",
    "sweep_csv": None,  # pandas.DataFrame makes a table of the records
    "sweep_each": "sweep",
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


def check(cwd: Path, *arguments: str | Path) -> None:
    """Runs a checker on the installed package, not on the sources beside the compiled part."""
    done = subprocess.run([sys.executable, "-m", *map(str, arguments)], cwd=cwd, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr


def users(root: Path) -> list[Path]:
    """Everything in Python that uses the wheel."""
    tests = sorted((root / "tests" / "python").glob("test_wheel_*.py"))
    examples = sorted((root / "examples" / "python").glob("*.py"))
    assert len(tests) >= 7 and len(examples) >= 3
    return tests + examples


def test_stubs_match_the_module(tmp_path: Path) -> None:
    check(tmp_path, "mypy.stubtest", "pyplatewash")


@pytest.fixture(scope="module")
def mypy_cache(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Where mypy keeps what it knows of the packages."""
    return tmp_path_factory.mktemp("mypy")


def test_mypy_finds_no_error(root: Path, tmp_path: Path, mypy_cache: Path) -> None:
    strict: list[str | Path] = ["mypy", "--strict", "--config-file", root / "pyproject.toml", "--cache-dir", mypy_cache]
    check(tmp_path, *strict, "-p", "pyplatewash")
    check(tmp_path, *strict, *users(root))


def test_pyright_finds_no_error(root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PYRIGHT_PYTHON_IGNORE_WARNINGS", "1")  # It would ask for a newer version of itself.
    # The package, and what calls all of it; mypy looks at the other tests.
    calls = [file for file in users(root) if file.stem in ("test_wheel_arguments", "test_wheel_jobs", "test_wheel_plates")]
    assert len(calls) == 3
    check(root, "pyright", "--pythonpath", sys.executable, Path(pw.__file__).parent, *calls)


def test_a_wrong_call_is_found_by_the_types(tmp_path: Path, mypy_cache: Path) -> None:
    (tmp_path / "wrong.py").write_text("import pyplatewash as pw\npw.Robot.irb120().fk([0.0] * 6, axes='base')\npw.plan(3)\n")
    line = [sys.executable, "-m", "mypy", "--strict", "--cache-dir", str(mypy_cache), "wrong.py"]
    found = subprocess.run(line, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert "wrong.py:2" in found.stdout and "wrong.py:3" in found.stdout
