"""The committed figures are what the command draws."""

import subprocess
import sys
from pathlib import Path

PICTURES = Path(__file__).resolve().parents[2] / "docs/pictures"


def test_the_figures_are_current(platewash, tmp_path):
    made = [sys.executable, PICTURES / "make.py", platewash, "--only", "figures", "--target", tmp_path]
    subprocess.run(made, check=True)
    drawn = sorted(file.name for file in tmp_path.glob("*.svg"))
    assert drawn == sorted(file.name for file in PICTURES.glob("*.svg") if file.name != "flow.svg")
    for name in drawn:
        same = (tmp_path / name).read_text() == (PICTURES / name).read_text()
        assert same, f"{name}: run docs/pictures/make.py as its first lines say"
