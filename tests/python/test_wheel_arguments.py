"""Every public callable with every argument replaced by every bad value: it answers, or refuses the argument by its name."""

import inspect
import itertools
import pickle
import re
import webbrowser
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pyplatewash as pw
import study_folders
from pyplatewash import _core, _files
from pyplatewash._studies import run as runs
from wheel_plans import paper_run, planned

ROBOT = pw.Robot.irb120()
Q = np.array([0.1, 0.3, 0.1, 0.2, 1.0, 0.0])
RUN = paper_run("paper-appendix")
PLAN = RUN.plan()
WASH = planned(pw.Scenario.load("kitchen").replace(layout={"count": 1}))  # Of one plate: it is exported, proved and simulated often.
SECTION: dict[str, float] = {}
STUDY = pw.Study("kitchen", rows=[{"seed": 3}])
KEPT = pw.Study("kitchen", rows=[{"seed": 1, "wash.contact_force_n": [1, 40]}])  # Two numbers are a place, too.

# A good value for each argument, by its name; by the call's too, where the name alone does not say.
GOOD: dict[str, Any] = {
    "q": Q, "qd": Q, "qdd": Q, "torque": Q, "seed": 1, "seeds": [1], "frame": "tool0", "tool": pw.Tool(length_m=0.15), "axes": "local",
    "target": ROBOT.fk(Q), "targets": ROBOT.fk(Q)[None], "previous": Q, "settings": pw.IkSettings(), "robot": ROBOT, "plates": [pw.Plate(x_m=0.3, y_m=0.0)],
    "working": [0], "required_m": 0.01, "quaternion_wxyz": [1.0, 0.0, 0.0, 0.0], "gravity_m_s2": [0.0, 0.0, -9.81], "plan": PLAN, "job": WASH.job, "payload_kg": 3.0, "law": "pd", "control": SECTION, "plant": SECTION,
    "frequencies_rad_s": [20.0], "damping_ratios": [1.0], "dt_s": 0.1, "executed": True, "t_s": [0.0, 1.0], "q_rad": np.zeros((2, 6)), "qd_rad_s": np.zeros((2, 6)),
    "polyline": [[0.0, 0.0], [0.1, 0.0]], "centre": [0.0, 0.0], "radius_m": 0.1, "sponge_radius_m": 0.02, "cell_m": 0.01, "cells": 9, "start": [0.3, 0.0, 0.1],
    "end": [0.0, 0.3, 0.1], "points": 5, "height_m": 0.25, "waypoints": np.eye(3), "samples": 20, "interpolation": "c2_spline", "scenario": "paper-appendix",
    "layout": pw.place_plates("paper-appendix"), "layouts": 1, "draws": 1, "arguments": ["--version"], "name_or_file": "kitchen", "source": "here", "table": {"layout": {"region": "text"}},
    "key": "wash", "path": "plan.json", "urdf": "arm.urdf", "srdf": "arm.srdf", "package_path": ["."], "folder": ".", "visual_shapes": False, "split_links": [], "fixed": {}, "memo": {}, "iterations": 3, "method": "dls",
    "position_error_m": 0.0, "orientation_error_rad": 0.0, "chord_error_m": 1e-3, "turns": 3.0, "start_angle_rad": 0.0, "trim_rad": 0.0, "closing_ring": True, "length_m": 0.1,
    "sponge_height_m": 0.02, "sponge_compression_m": 0.005, "sponge_stiffness_pa": (11e3, 44e3), "mass_kg": 0.3, "com_m": 0.05, "inertia_kg_m2": (1.0, 0.0, 0.0, 1.0, 0.0, 1.0), "x_m": 0.3, "y_m": 0.0, "z_m": 0.03,
    "thickness_m": 0.02, "position_tolerance_m": 1e-6, "orientation_tolerance_rad": 1e-6, "max_iterations": 60, "max_qp_iterations": 30, "step_bound_rad": 0.7,
    "analytic_starts": True, "listed_starts": 4, "random_restarts": 0, "random_seed": 0, "data": {"a": 1},
    "mounted_on": "tool0", "kind": "layout", "execution": pw.simulate(WASH.plan), "certificate": pw.prove(WASH.plan), "prove": True, "simulate": False, "height": 300,
    "to": "ros2", "out": None, "tolerance_m": 2e-4, "speed_share": 0.5, "speed_m_s": 0.1, "Plan.dry_run height_m": 0.05, "corner_m": 5e-3, "accept": ["swept"], "joint_3": "independent", "stands_rad": WASH.plan.trajectory.q_rad[0], "tip": None, "stopped_s": 0.0,
    "profile": None, "foot": pw.Foot(radius_m=0.08, height_m=0.005), "rings": None, "count": 3, "inner_m": 0.02, "lead_rad": 2.0, "blend_rad": 1.8, "laps": 1, "height_error_m": 0.001, "deviation_m": 0.001, "measured": None, "soil": None, "WashCurve.on plate": pw.Plate(x_m=0.3, y_m=0.0),
    "html": "<p>a page", "svg": "<svg></svg>", "Figure.save path": "figure.svg", "Plan.view path": "page.html", "Page.save path": "page.html", "Page.open path": "page.html",
    "Robot.from_urdf text": ROBOT.urdf, "Robot.from_urdf srdf": ROBOT.srdf, "Plan.from_json text": PLAN.to_json(), "Scenario.parse text": "name = 'x'\n[layout]\nregion = 'text'\n",
    "Robot.ik seed": Q, "Robot.ik_path seed": Q, "Robot.ik_batch seeds": Q, "sweep scenario": "kitchen", "run_paper job": RUN.job, "plan seed": None, "prove plan": WASH.plan,
    "Study scenario": "kitchen", "Study axes": {"seed": [1]}, "rows": None, "name": "a study", "plans": "none", "Study.load path": "study.toml", "Study.parse text": STUDY.to_toml(), "Study.run out": "out",
    "engine": "threads", "workers": 1, "client": None, "address": None, "progress": False,
    "ranges": {"tool.length_m": (0.1, 0.2)}, "samples method": "random", "log": ["tool.length_m"], "StudyRows folder": "study", "index": 0, "partial": True, "timings": True, "at": "wash.contact_force_n",
    "value": "outcome", "by": ["seed"], "region": None, "StudyRows.export path": "rows.jsonl", "StudyRows.to_parquet path": "rows.parquet", "ax": None,
    "simulate settings": pw.SimulationSettings("exact"), "tune settings": pw.SimulationSettings("pd"), "Record.__getitem__ key": "a", "Record text": "words",
    "prove_motion q": np.zeros((2, 6)), "prove_motion qd": np.zeros((2, 6)), "prove_motion qdd": np.zeros((2, 6)), "t": [0.0, 1.0], "obstacles": [], "mount": np.eye(4), "clearance_m": 0.005, "prove_motion interpolation": "cubic",
    "acceleration_limits": np.ones(6),
}  # fmt: skip
# Classes of answers, which users are given: whoever makes one is trusted. Exceptions take any words.
ANSWERS = {"Coverage", "CoverageRaster", "Energy", "IkBatch", "IkBranches", "IkSolution", "Recovery"}
# Arguments that may be anything: a key of any type may be asked for.
TAKES_ANYTHING = {"Record text", "Record.__getitem__ key"}

MASKED = np.ma.masked_array(np.zeros(6), mask=[False, False, True, False, False, False])
BAD: list[Any] = [
    None, object(), 3, -5, 2**53, 2**80, 10**400, True, 0.5, np.nan, np.inf, -np.inf, 1j, np.complex64(1j), "", "0.15", "nowhere", "/nowhere/a/b", "\ud800", "a\0b", b"bytes",
    [], [object()], ["x"], [-1], [None], {}, {"a": object()}, {3: 4}, np.zeros(0), np.full(6, np.nan), np.zeros((4, 4)), np.array("x"), np.array(["x"]), np.array(3.0), np.datetime64("now"),
    np.ma.masked, MASKED, [MASKED], Path("/nowhere/x.toml"), Path("/"), len, int, ROBOT, pw.Tool(), pw.Plate(x_m=0, y_m=0), PLAN, ROBOT.fk, range(1),
]  # fmt: skip

RUST = re.compile(r"PathBuf|PyString|OsString|Py[A-Z]\w+|\bVec\b|\b[ui](8|16|32|64|size)\b|\bf64\b|\bstr\b`|Option|Bound<|extract|cannot be converted|can't be|an? 'int' object|--[a-z]")


def public() -> Iterator[tuple[str, Callable[..., Any]]]:
    """Functions, constructors and methods, with their names."""
    yield "Robot.load", pw.Robot.load
    for name in pw.__all__:
        thing = getattr(pw, name)
        if isinstance(thing, type):
            if name in ANSWERS or issubclass(thing, BaseException):
                continue
            if "__new__" in vars(thing) or "__init__" in vars(thing):
                yield name, thing
            for method in vars(thing):
                if callable(getattr(thing, method)) and (not method.startswith("_") or method == "__getitem__"):
                    yield f"{name}.{method}", getattr(thing, method)
        elif callable(thing):
            yield name, thing


INSTANCES: dict[str, Callable[[], Any]] = {
    "Robot": lambda: ROBOT, "Plan": lambda: PLAN, "Scenario": lambda: pw.Scenario.load("kitchen"), "Trajectory": lambda: PLAN.trajectory, "SimulationSettings": lambda: pw.SimulationSettings("pd"),
    "PaperJob": lambda: RUN.job, "PaperRun": lambda: RUN, "WashJob": lambda: WASH.job, "Planned": lambda: WASH, "Certificate": lambda: pw.prove(WASH.plan), "DynamicsModel": lambda: pw.DynamicsModel(ROBOT),
    "ClearanceModel": lambda: pw.ClearanceModel(ROBOT, pw.Tool(length_m=0.15), [pw.Plate(x_m=0.3, y_m=0.0)]), "Execution": lambda: pw.simulate(PLAN), "PaperSpiral": pw.PaperSpiral,
    "WashCurve": lambda: pw.WashCurve(radius_m=0.1, turns=3.0), "Rings": lambda: pw.Rings(count=3, inner_m=0.02, lead_rad=2.0, blend_rad=1.8), "Record": lambda: pw.Record({"a": 1}), "Layout": lambda: pw.place_plates("kitchen"),
    "Plan.export": lambda: WASH.plan, "Plan.to_joint_trajectory": lambda: WASH.plan, "Plan.dry_run": lambda: WASH.plan, "Plan.recover": lambda: WASH.plan, "Plan.show": lambda: WASH.plan, "Plan.view": lambda: WASH.plan, "Plan.figure": lambda: WASH.plan, "Page": lambda: pw.Page("<p>a page"), "Figure": lambda: pw.Figure("<svg></svg>"),
    "Scenario.paper_job": lambda: pw.Scenario.load("paper-appendix"), "StudyRows": lambda: pw.StudyRows("study"),
    "Study": lambda: STUDY,
}  # fmt: skip
MADE: dict[str, Any] = {}


def bound(name: str, call: Callable[..., Any]) -> tuple[Callable[..., Any], list[inspect.Parameter]]:
    """A callable without `self`, and its other arguments."""
    parameters = list(inspect.signature(call).parameters.values())
    if parameters and parameters[0].name == "self":
        owner, method = name.split(".")
        owner = name if name in INSTANCES else owner
        if owner not in MADE:
            MADE[owner] = INSTANCES[owner]()
        call, parameters = getattr(MADE[owner], method), parameters[1:]
    return call, [p for p in parameters if p.kind is not p.VAR_KEYWORD]


def good(name: str, parameter: inspect.Parameter) -> Any:
    for key in (f"{name} {parameter.name}", parameter.name):
        if key in GOOD:
            return GOOD[key]
    raise AssertionError(f"add a good value for {name}({parameter.name}) to GOOD")


def tried(name: str, call: Callable[..., Any], parameters: list[inspect.Parameter], changed: str | None, value: Any) -> Any:
    """Calls with good values, one of them replaced."""
    values = {p: value if p.name == changed else good(name, p) for p in parameters}
    if name.endswith("fk") or {"frame", "tool"} <= {p.name for p in parameters}:
        values = {p: v for p, v in values.items() if p.name != ("frame" if changed == "tool" else "tool")}
    positional = [v for p, v in values.items() if p.kind is p.POSITIONAL_ONLY]
    return call(*positional, **{p.name: v for p, v in values.items() if p.kind is not p.POSITIONAL_ONLY})


CALLS = dict(public())


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Files of good names, in a folder that may be written to."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(webbrowser, "open", lambda address: True)
    save = _files.save_program

    def save_here(folder: Path, files: dict[str, str]) -> None:
        if Path(folder).is_dir() and not Path(folder).resolve().is_relative_to(tmp_path):
            raise pw.FileError("no folder of this test's")  # Whoever may write anywhere would find programs there.
        save(folder, files)

    monkeypatch.setattr(_files, "save_program", save_here)
    monkeypatch.setattr(runs, "run", lambda study, out, *others: run_here(tmp_path, study, out, *others))
    Path("study.toml").write_text(STUDY.to_toml())
    Path("arm.urdf").write_text(ROBOT.urdf)
    Path("arm.srdf").write_text(ROBOT.srdf or "")
    PLAN.save("plan.json")
    row = study_folders.row(0, KEPT.row(0).axes, key=KEPT.row(0).key, plan=PLAN.hash)
    journal = _core.StudyJournal("study", KEPT)
    journal.append(study_folders.line(row).strip(), 0.1, PLAN.to_json().encode())
    journal.close()


RUN_STUDY = runs.run


def run_here(here: Path, study: pw.Study, out: Path, *others: Any) -> pw.StudyRows:
    """Runs a study in a folder below this one, and in no other that could be made."""
    if "\0" not in str(out) and not out.resolve().is_relative_to(here):
        raise pw.FileError("no folder of this test's")
    return RUN_STUDY(study, out, *others)


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("name", CALLS)
def test_a_bad_value_is_refused_by_the_arguments_name(name: str, capfd: pytest.CaptureFixture[str]) -> None:
    call, parameters = bound(name, CALLS[name])
    tried(name, call, parameters, None, None)  # Good values do.
    for parameter, value in itertools.product(parameters, BAD):
        if value is None and parameter.default is not parameter.empty:
            continue  # It may be left out.
        try:
            tried(name, call, parameters, parameter.name, value)
        except pw.PlatewashError as error:
            words = str(error)
            assert not isinstance(error, pw.InternalError), (parameter.name, value, error)
            assert words.strip() and not RUST.search(words.replace(repr(value)[1:-1], "")), words
            if isinstance(error, pw.InputTypeError):
                assert error.argument and parameter.name in error.argument, (parameter.name, value, words)
            if isinstance(error, pw.InputError) and type(error) in (pw.InputError, pw.ShapeError):
                assert error.argument and words.count(f"{error.argument}: {error.argument}") == 0, words
                assert any(p.name in error.argument for p in parameters), (parameter.name, value, words)
        else:
            taken = type(value) is object and f"{name} {parameter.name}" not in TAKES_ANYTHING
            assert not taken, f"{name}({parameter.name}=object()) is taken for good"
        if type(value) is object and f"{name} {parameter.name}" not in TAKES_ANYTHING:
            with pytest.raises(pw.InputTypeError, match=re.escape(parameter.name)) as caught:
                tried(name, call, parameters, parameter.name, value)
            assert isinstance(caught.value, TypeError)
    capfd.readouterr()


LISTED: list[tuple[Callable[[], Any], type[Exception], str]] = [
    (lambda: pw.place_plates(3), TypeError, r"scenario: a Scenario, the name of a shipped one or the path of a file is needed; found 3 \(int\)"),  # type: ignore[arg-type]  # pyright: ignore[reportArgumentType]
    (lambda: pw.plan(3), TypeError, r"job: a WashJob, a Scenario, the name of a shipped one or the path of a scenario file is needed; found 3 \(int\)"),  # type: ignore[arg-type]  # pyright: ignore[reportArgumentType]
    (lambda: pw.run_paper(WASH.job), TypeError, r"job: a PaperJob, a Scenario, the name of a shipped one or the path of a scenario file is needed; found a value of type WashJob"),  # type: ignore[arg-type]  # pyright: ignore[reportArgumentType]
    (lambda: pw.reproduce(seed=-1), ValueError, r"seed: an integer from 0 to 9007199254740991 is needed; found -1 \(int\)"),
    (lambda: pw.reproduce(seed=2**53), ValueError, "seed: an integer from 0 to 9007199254740991 is needed; found 9007199254740992"),
    (lambda: pw.prove("nowhere.json"), FileNotFoundError, "nowhere.json: cannot be read"),
    (lambda: pw.prove(3), TypeError, r"plan: a Plan, what plan\(\) returns, or the path of a plan file is needed; found 3 \(int\)"),  # type: ignore[arg-type]  # pyright: ignore[reportArgumentType]
    (lambda: ROBOT.fk(Q, 3), TypeError, r"frame: a frame's name is needed; found 3 \(int\)"),  # type: ignore[arg-type]  # pyright: ignore[reportArgumentType]
    (lambda: pw.sweep("kitchen", 3), TypeError, r"seeds: a list of seeds is needed; found 3 \(int\)"),  # type: ignore[arg-type]  # pyright: ignore[reportArgumentType]
    (lambda: pw.sweep("kitchen", [1, -2]), ValueError, r"seeds\[1\]: an integer from 0 to 9007199254740991 is needed; found -2"),
    (lambda: pw.IkSettings(max_iterations=-5), ValueError, r"settings.max_iterations: an integer from 1 to 1000000000 is needed; found -5"),
    (lambda: pw.IkSettings(step_bound_rad=9.0), ValueError, r"settings.step_bound_rad: must be in \(0, π\] rad; found 9"),
    (lambda: pw.Tool(length_m="0.15"), TypeError, r"tool.length_m: a number is needed; found '0.15' \(str\)"),  # type: ignore[arg-type]  # pyright: ignore[reportArgumentType]
    (lambda: pw.Tool(length_m=-1), ValueError, "tool.length_m: must be from 0 to 100 m; found -1"),
    (lambda: pw.WashCurve(radius_m=0.1, turns=0.1), ValueError, "curve.turns: a number from 0.25 to 1000 is needed; found 0.1"),
    (lambda: PLAN.save("/nowhere/a.json"), FileNotFoundError, "/nowhere/a.json: cannot be written"),
    (lambda: pw.Plan.load("/nowhere/a.json"), FileNotFoundError, "/nowhere/a.json: cannot be read"),
    (lambda: pw.Plan.load("/"), OSError, "/: cannot be read: not a regular file"),
    (lambda: pw.Robot.load("/nowhere/a.urdf"), FileNotFoundError, "/nowhere/a.urdf: cannot be read"),
    (lambda: pw.Robot.load("arm.urdf", srdf="none.srdf"), FileNotFoundError, "none.srdf: cannot be read"),
    (lambda: pw.Robot.load("arm.urdf", package_path=["a", 3]), TypeError, r"package_path\[1\]: a path is needed; found 3 \(int\)"),  # type: ignore[list-item]  # pyright: ignore[reportArgumentType]
    (lambda: pw.Scenario.load("ktchen"), FileNotFoundError, "ktchen: is neither a file nor a shipped scenario"),
    (lambda: pw.place_plates("none.toml"), FileNotFoundError, "none.toml: is neither a file nor a shipped scenario"),
    (lambda: pw.Scenario.load("kitchen")["nose"], KeyError, "one of .*wash.* is needed; found 'nose'"),
    (lambda: WASH.plan.show(3), TypeError, r"execution: an Execution, as simulate gives it, is needed; found 3 \(int\)"),  # type: ignore[arg-type]  # pyright: ignore[reportArgumentType]
    (lambda: WASH.plan.show(certificate=True), TypeError, r"certificate: a Certificate, as prove gives it, is needed; found True \(bool\)"),  # type: ignore[arg-type]  # pyright: ignore[reportArgumentType]
    (lambda: WASH.plan.show(height=50), ValueError, r"height: an integer from 100 to 10000 is needed; found 50 \(int\)"),
    (lambda: pw.Page("", 0), ValueError, "height: an integer from 100 to 10000 is needed; found 0"),
    (lambda: WASH.plan.view(path=3), TypeError, r"path: a path is needed; found 3 \(int\)"),  # type: ignore[arg-type]  # pyright: ignore[reportArgumentType]
    (lambda: pw.Page("").save("/nowhere/a.html"), FileNotFoundError, "/nowhere/a.html: cannot be written"),
    (lambda: PLAN.provenance["nose"], KeyError, "one of scenario, version is needed; found 'nose'"),
]  # fmt: skip


@pytest.mark.parametrize("case", range(len(LISTED)))
def test_exceptions_derive_from_ours_and_pythons(case: int) -> None:
    call, builtin, words = LISTED[case]
    with pytest.raises(pw.PlatewashError, match=words) as caught:
        call()
    error = caught.value
    assert isinstance(error, builtin) and not isinstance(error, pw.InternalError)
    again = pickle.loads(pickle.dumps(error))
    assert type(again) is type(error) and str(again) == str(error) and vars(again) == vars(error)
    if isinstance(error, pw.FileError):
        assert error.filename and error.filename in str(error)
        assert error.errno == (None if error.filename == "/" else 2)


def test_a_missing_file_raises_the_error_of_its_kind() -> None:
    with pytest.raises(pw.PlanFileError):
        pw.Plan.load("none.json")
    with pytest.raises(pw.UrdfError):
        pw.Robot.load("none.urdf")
    with pytest.raises(pw.ScenarioError):
        pw.Scenario.load("none.toml")


def test_a_package_path_is_a_folder_or_several() -> None:
    for package_path in (".", Path(), ["."], (Path(),), [], None):
        assert pw.Robot.load("arm.urdf", package_path=package_path) == pw.Robot.from_urdf(ROBOT.urdf)


def test_a_plan_is_given_by_its_path_too() -> None:
    plan, pd = WASH.plan, pw.SimulationSettings("pd")
    plan.save("plan.json")
    assert pw.prove("plan.json") == pw.prove(Path("plan.json")) == pw.prove(plan)
    assert pw.simulate("plan.json") == pw.simulate(plan)
    assert pw.tune("plan.json", [20.0], settings=pd) == pw.tune(plan, [20.0], settings=pd)
    assert pw.SimulationSettings.of("plan.json") == pw.SimulationSettings.of(plan) == WASH.job.simulation


@pytest.mark.parametrize("call", [lambda q: ROBOT.fk(q), lambda q: pw.Trajectory.through([q, q], 0.1), lambda q: pw.Scenario.load("kitchen").replace(robot={"home_deg": q})])
def test_masked_values_are_refused_by_name(call: Callable[[Any], Any]) -> None:
    call(np.ma.masked_array(np.zeros(6)))  # Nothing is masked.
    with pytest.raises(pw.InputError, match=r"^(q|q_rad|robot.home_deg): 1 masked values?; fill"):
        call(MASKED)
    with pytest.raises(pw.InputError, match="masked"):
        pw.Tool(length_m=np.ma.masked)  # type: ignore[arg-type]  # pyright: ignore[reportArgumentType]


def test_passes_on_exceptions_of_the_callers_objects() -> None:
    def seeds() -> Iterator[int]:
        yield 1
        raise RuntimeError("mine")

    with pytest.raises(RuntimeError, match="mine"):
        pw.sweep("kitchen", seeds())


def test_each_program_names_the_call_of_the_other() -> None:
    with pytest.raises(pw.InputError, match=r"\"paper-appendix\" has job.program = \"paper\".*paper_job\(\).*run_paper"):
        pw.Scenario.load("paper-appendix").job()
    with pytest.raises(pw.InputError, match=r"\"kitchen\" has job.program = \"certified\".* job\(\).*plan plans"):
        pw.Scenario.load("kitchen").paper_job()
    with pytest.raises(pw.InputError, match="run_paper"):
        pw.sweep("paper-text", [1])
