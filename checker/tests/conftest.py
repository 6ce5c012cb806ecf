"""Plans that the command makes once for all tests."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="session")
def plan_file(tmp_path_factory):
    """Path of the plan of a shipped scenario."""
    command = os.environ.get("PLATEWASH_BIN", str(ROOT / "target/release/platewash"))
    folder, made = tmp_path_factory.mktemp("plans"), {}

    def make(scenario):
        if scenario not in made:
            out = folder / scenario
            subprocess.run([command, "-q", "plan", "--scenario", scenario, "--out", str(out)], check=True, cwd=folder)
            made[scenario] = out / "plan.json"
        return made[scenario]

    return make
