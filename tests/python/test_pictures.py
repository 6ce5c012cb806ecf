"""The committed pictures are what their generators make of the command's own output."""

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def test_the_paper_cell_is_current(platewash, tmp_path):
    subprocess.run([platewash, "run", "--quiet", "--scenario", "paper-appendix", "--out", tmp_path], check=True, capture_output=True)
    drawn = tmp_path / "drawn.svg"
    subprocess.run([sys.executable, ROOT / "docs/pictures/paper_cell.py", tmp_path, drawn], check=True)
    committed = ROOT / "docs/pictures/paper-cell.svg"
    assert drawn.read_text() == committed.read_text(), "run docs/pictures/paper_cell.py as its first lines say"


def test_the_kitchen_cell_is_current(platewash, tmp_path):
    folders = [tmp_path / "paper", tmp_path / "kitchen"]
    for folder, scenario in zip(folders, ["paper-appendix", "kitchen"]):
        command = [platewash, "run", "--quiet", "--scenario", scenario, "--out", folder]
        subprocess.run(command, check=True, capture_output=True)
    drawn = tmp_path / "drawn.svg"
    subprocess.run([sys.executable, ROOT / "docs/pictures/kitchen_cell.py", *folders, drawn], check=True)
    committed = ROOT / "docs/pictures/kitchen-cell.svg"
    assert drawn.read_text() == committed.read_text(), "run docs/pictures/kitchen_cell.py as its first lines say"
