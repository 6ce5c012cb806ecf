"""The command of the wheel is the Rust program; Ctrl-C and other threads get their turn while Rust works."""

import json
import subprocess
import sys
import sysconfig
import threading
from pathlib import Path

import pytest

import pyplatewash as pw

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


@pytest.mark.parametrize("line", LINES)
def test_the_wheels_command_is_the_rust_one(platewash: Path, tmp_path: Path, line: str) -> None:
    script = Path(sysconfig.get_path("scripts")) / ("platewash.exe" if sys.platform == "win32" else "platewash")
    folders = [tmp_path / name for name in ("rust", "script", "module")]
    answers = []
    commands = [[str(platewash)], [str(script)], [sys.executable, "-m", "pyplatewash"]]
    for folder, command in zip(folders, commands, strict=True):
        folder.mkdir()
        answers.append(run(*command, *line.split(), cwd=folder))
    assert answers[0] == answers[1] == answers[2]
    written = [{file.relative_to(folder): file.read_bytes() for file in folder.rglob("*") if file.is_file()} for folder in folders]
    assert written[0] == written[1] == written[2]


def test_exit_codes_come_back_from_the_call(capfd: pytest.CaptureFixture[str]) -> None:
    assert pw.run_command(["robot", "--json"]) == 0
    assert "joint_1" in json.dumps(json.loads(capfd.readouterr().out))
    assert pw.run_command(["fk", "1"]) == 2


LONG = {
    "reproduce": "pw.reproduce(layouts=10_000, draws=1_000_000)",
    "sweep": "pw.sweep('kitchen', range(1, 1_000_000))",
    "tune": "pw.tune(pw.plan('kitchen'), np.linspace(5, 60, 100), np.linspace(0.7, 1.5, 100))",
    "simulate": "pw.simulate(pw.plan('kitchen'), pw.Setup('computed_torque', plant={'substeps': 1000}))",
    "batch": "far = np.tile(np.eye(4), (400_000, 1, 1)); far[:, :3, 3] = 0.9; pw.Robot.irb120().ik_batch(far)",
}
INTERRUPTED = """
import os, signal, threading
import numpy as np
import pyplatewash as pw
threading.Timer(1.0, os.kill, (os.getpid(), signal.SIGINT)).start()
try:
    {call}
except KeyboardInterrupt:
    print("interrupted")
"""


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no SIGINT for another process")
@pytest.mark.parametrize("call", LONG.values(), ids=LONG.keys())
def test_ctrl_c_ends_long_work(call: str, tmp_path: Path) -> None:
    program = INTERRUPTED.format(call=call)
    done = subprocess.run([sys.executable, "-c", program], cwd=tmp_path, capture_output=True, text=True, timeout=300, check=False)
    assert done.stdout == "interrupted\n", done.stderr


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
