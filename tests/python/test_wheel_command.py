"""The command of the wheel is the Rust program; Ctrl-C and other threads get their turn while Rust works."""

import json
import signal
import subprocess
import sys
import sysconfig
import threading
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from ctrl_c import heed_ctrl_c, no_sigint

import pyplatewash as pw

INTERRUPTED_CODE = 130
LINES = [
    "--version",
    "--help",
    "fk --help",
    "fk 0 20 10 0 60 0",
    "fk 0 20 10 0 60 0 --json",
    "fk 0 0",
    "layout --scenario paper-text --json",
    "validate --scenario kitchen",
    "validate --scenario nowhere.toml",
    "plan --scenario kitchen --seed 5 --quiet --json",
    "frobnicate",
]


def run(*command: str | Path, cwd: Path) -> tuple[int, str, str]:
    done = subprocess.run([*map(str, command)], cwd=cwd, capture_output=True, text=True, check=False)
    return done.returncode, done.stdout, done.stderr


def command(platewash: Path, which: str) -> list[str]:
    """How one calls the command: of Rust, of the wheel by its script, of the wheel as a module."""
    script = Path(sysconfig.get_path("scripts")) / ("platewash.exe" if sys.platform == "win32" else "platewash")
    return {"rust": [str(platewash)], "script": [str(script)], "module": [sys.executable, "-m", "pyplatewash"]}[which]


@pytest.mark.parametrize("line", LINES)
def test_the_wheels_command_is_the_rust_one(platewash: Path, tmp_path: Path, line: str) -> None:
    folders = [tmp_path / name for name in ("rust", "script", "module")]
    answers = []
    for folder in folders:
        folder.mkdir()
        answers.append(run(*command(platewash, folder.name), *line.split(), cwd=folder))
    assert answers[0] == answers[1] == answers[2]
    written = [{file.relative_to(folder): file.read_bytes() for file in folder.rglob("*") if file.is_file()} for folder in folders]
    assert written[0] == written[1] == written[2]


def test_exit_codes_come_back_from_the_call(capfd: pytest.CaptureFixture[str]) -> None:
    assert pw.run_command(["robot", "--json"]) == 0
    assert "joint_1" in json.dumps(json.loads(capfd.readouterr().out))
    assert pw.run_command(["fk", "1"]) == 2


# Work of several seconds: what it is done on, and the call.
MANY = (
    "centres = [[0.2 + 0.02 * i, -0.4 + 0.02 * k] for i in range(8) for k in range(41)]; "
    "job = pw.Scenario.load('kitchen-spiral').replace(layout={'region': None, 'positions_m': centres, 'plate_radius_m': 0.008}, wash={'path_radius_m': 0.006, 'turns': 1.0}, "
    "tool={'sponge_radius_m': 0.004, 'radius_m': 0.004}).job()"
)
DRAWN = (
    "drawn = kitchen.replace(layout={'only_washable': True, 'count': 100, 'region': None, 'rho_m': [0.2, 0.6], 'plate_radius_m': 0.02, "
    "'min_distance_m': 0.05}, wash={'path_radius_m': 0.015, 'turns': 1.0})"
)
EDGE = "edge = paper.replace(wash={'points': 50_000}, layout={'region': None, 'positions_m': [[0.4, -0.25], [0.3, 0.45]]}).paper_job()"
NEAR = "near = pw.run_paper(paper.replace(wash={'points': 90_000}, layout={'region': None, 'positions_m': [[0.3, -0.25], [0.3, 0.25]]}).paper_job())"
LONG = {
    "place": (DRAWN, "pw.place_plates(drawn)"),
    "plan": (MANY, "pw.plan(job)"),
    "prove": (MANY.replace("range(41)", "range(21)") + "; plan = pw.plan(job).plan", "pw.prove(plan)"),
    "simulate": ("slow = pw.SimulationSettings(plant={'substeps': 1000})", "pw.simulate(plan, settings=slow)"),
    "tune": ("", "pw.tune(plan, np.linspace(5, 60, 100), np.linspace(0.7, 1.5, 100))"),
    "sweep": ("", "pw.sweep(kitchen, range(1, 1_000_000))"),
    "paper run": (EDGE, "pw.run_paper(edge)"),
    "paper report": (NEAR, "near.report()"),
    "reproduce": ("", "pw.reproduce(layouts=10_000, draws=1_000_000)"),
    "command": ("", 'pw.run_command(["reproduce", "--layouts", "10000", "--draws", "1000000"])'),
    "batch": ("far = np.tile(np.eye(4), (400_000, 1, 1)); far[:, :3, 3] = 0.9", "pw.Robot.irb120().ik_batch(far)"),
}
# Seconds of processor time, all threads together, in which work that was given up must have ended.
SOON_S = 2.0
INTERRUPTED = """
import os, signal, threading, time
import numpy as np
import pyplatewash as pw

kitchen, paper = pw.Scenario.load("kitchen"), pw.Scenario.load("paper-appendix")
plan = pw.plan(kitchen.job()).plan
{made}
threading.Timer(0.4, os.kill, (os.getpid(), signal.SIGINT)).start()
try:
    {call}
except KeyboardInterrupt:
    begun, before = time.process_time(), -1.0
    while (now := time.process_time() - begun) - before > 0.02 and now < {soon_s}:
        before = now
        time.sleep(0.2)
    print("interrupted, and still at work" if now >= {soon_s} else "interrupted")
"""


@pytest.fixture
def started_in_the_background() -> Iterator[None]:
    """What a shell does to a job in its background, and nohup: this process, and whatever it starts, ignores Ctrl-C."""
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    yield
    signal.signal(signal.SIGINT, before)


def ends_at_ctrl_c(work: str, folder: Path) -> None:
    made, call = LONG[work]
    line = [sys.executable, "-c", INTERRUPTED.format(made=made, call=call, soon_s=SOON_S)]
    done = subprocess.run(line, cwd=folder, capture_output=True, text=True, timeout=600, check=False, preexec_fn=heed_ctrl_c)
    assert done.stdout == "interrupted\n", done.stderr


@no_sigint
@pytest.mark.parametrize("work", LONG)
def test_ctrl_c_ends_long_work_and_its_threads(work: str, tmp_path: Path) -> None:
    ends_at_ctrl_c(work, tmp_path)


@no_sigint
@pytest.mark.usefixtures("started_in_the_background")
def test_ctrl_c_ends_long_work_when_the_tests_run_in_the_background(tmp_path: Path) -> None:
    ends_at_ctrl_c("sweep", tmp_path)


def swept(command: list[str], last: int, folder: Path, preexec: Callable[[], None] | None) -> tuple[int, list[str]]:
    """Exit code and seeds of a sweep from seed 1 that gets SIGINT after its first row."""
    line = [*command, "sweep", "--scenario", "kitchen", "--seeds", f"1..{last}", "--threads", "1", "--quiet"]
    with subprocess.Popen(line, cwd=folder, stdout=subprocess.PIPE, text=True, preexec_fn=preexec) as child:
        assert child.stdout is not None
        rows = [child.stdout.readline(), child.stdout.readline()]
        child.send_signal(signal.SIGINT)
        rows += child.stdout.readlines()
    return child.returncode, [row.split(",")[0] for row in rows[1:]]


@no_sigint
@pytest.mark.parametrize("which", ["rust", "module"])
def test_ctrl_c_ends_the_command(platewash: Path, which: str, tmp_path: Path) -> None:
    code, _ = swept(command(platewash, which), 100_000, tmp_path, heed_ctrl_c)
    assert code == INTERRUPTED_CODE


@no_sigint
@pytest.mark.usefixtures("started_in_the_background")
@pytest.mark.parametrize("which", ["rust", "module"])
def test_a_command_started_in_the_background_ignores_ctrl_c(platewash: Path, which: str, tmp_path: Path) -> None:
    code, seeds = swept(command(platewash, which), 4, tmp_path, None)
    assert (code, seeds) == (0, [str(seed) for seed in range(1, 5)])


def test_other_threads_run_while_rust_works() -> None:
    stop, turns = threading.Event(), 0

    def count() -> None:
        nonlocal turns
        while not stop.wait(1e-3):
            turns += 1

    counter = threading.Thread(target=count)
    counter.start()
    begun = turns
    pw.sweep("kitchen", range(1, 4))
    inside = turns - begun
    stop.set()
    counter.join()
    assert inside >= 10  # With the lock held it would be none or one.
