"""Workflows under .github have no weak spots that zizmor knows. It judges the files alone, without a network."""

import subprocess
import sysconfig
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def test_zizmor_finds_nothing() -> None:
    zizmor = Path(sysconfig.get_path("scripts")) / "zizmor"
    found = subprocess.run([zizmor, "--offline", "--no-progress", "--color=never", ".github"], cwd=ROOT, capture_output=True, text=True)
    assert found.returncode == 0, found.stdout + found.stderr
