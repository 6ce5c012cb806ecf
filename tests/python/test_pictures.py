"""The committed figures are what the command draws; the film is one."""

import subprocess
import sys
from pathlib import Path

from PIL import Image

PICTURES = Path(__file__).resolve().parents[2] / "docs/pictures"


def test_the_figures_are_current(platewash, tmp_path):
    made = [sys.executable, PICTURES / "make.py", platewash, "--only", "figures", "--target", tmp_path]
    subprocess.run(made, check=True)
    drawn = sorted(file.name for file in tmp_path.glob("*.svg"))
    assert drawn == sorted(file.name for file in PICTURES.glob("*.svg") if file.name != "flow.svg")
    for name in drawn:
        same = (tmp_path / name).read_text() == (PICTURES / name).read_text()
        assert same, f"{name}: run docs/pictures/make.py as its first lines say"


def test_the_readmes_film_is_small_and_moves():
    film = PICTURES / "kitchen.webp"
    assert film.stat().st_size < 3e6
    with Image.open(film) as frames:
        assert (frames.format, frames.size) == ("WEBP", (960, 600))
        assert frames.n_frames > 100
    for page in ("README.md", "docs/site/pages/index.md"):
        assert "docs/pictures/kitchen.webp" in (PICTURES.parents[1] / page).read_text(encoding="utf-8"), page
