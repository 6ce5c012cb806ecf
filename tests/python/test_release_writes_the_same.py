"""The release build writes the bytes that the build under test writes (tests/command/golden.rs has the other half)."""

import hashlib
import json
import subprocess

import pytest
from conftest import ROOT

GOLDEN = json.loads((ROOT / "tests" / "golden" / "outputs.json").read_text(encoding="utf-8"))


@pytest.mark.parametrize("threads", ["1", "2", "8"])
@pytest.mark.parametrize("run", GOLDEN)
def test_outputs_have_the_committed_hashes(platewash, tmp_path, run, threads):
    scenario, seed = run.split()
    line = [platewash, "run", "--scenario", scenario, "--seed", seed, "--threads", threads, "--quiet"]
    subprocess.run(line, cwd=tmp_path, check=True, stdout=subprocess.DEVNULL)
    out = tmp_path / "out"
    files = [file for file in out.iterdir() if file.name != "page.html"]  # it has the bundle in it, where there is one
    hashes = {file.name: hashlib.sha256(file.read_bytes()).hexdigest() for file in files}
    assert hashes == GOLDEN[run]
