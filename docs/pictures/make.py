"""Makes the pictures of the documentation and the animation of the README.

    cargo build --release
    cargo xtask test --only browser     # once: fetches the browser into target/browser
    python docs/pictures/make.py target/release/platewash

Figures come from the command, all others from its page, in the browser of the tests. `--only figures`, `page` or `film` makes these alone.
The film needs Pillow (matplotlib brings it along); `tests/python/requirements.txt` has its exact version. It takes minutes.
"""

import argparse
import json
import shutil
import subprocess
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
BROWSER = HERE.parents[1] / "target" / "browser"
NODE = HERE.parents[1] / "target" / "node" / "bin" / "node"

# By scenario: the figure of the command, and the file that shows it here.
FIGURES = {"kitchen": ("layout", "kitchen-layout.svg"), "paper-appendix": ("spiral", "paper-spiral.svg")}

# How well the frames of the film are kept, from 0 to 100; how much work goes into making it small, from 0 to 6.
QUALITY, EFFORT = 80, 4


def platewash(command, *arguments):
    subprocess.run([command, *map(str, arguments), "--quiet"], check=True, capture_output=True)


def figures(command, folder, target):
    """Draws the figures."""
    for scenario, (figure, name) in FIGURES.items():
        platewash(command, "plan", "--scenario", scenario, "--out", folder / scenario)
        platewash(command, "figures", folder / scenario / "plan.json", "--only", figure, "--out", folder / scenario)
        shutil.copyfile(folder / scenario / f"{figure}.svg", target / name)


def frames_of(page, folder, wanted):
    """Draws a page, and so many frames of its scene or its film, in the browser of the tests; see page.mjs."""
    script = shutil.copyfile(HERE / "page.mjs", BROWSER / "page.mjs")
    node = NODE if NODE.exists() else "node"
    subprocess.run([node, script, page, folder, str(wanted)], check=True)


def page(command, folder, target):
    """Takes the picture of the page of `kitchen`."""
    platewash(command, "run", "--scenario", "kitchen", "--out", folder)
    frames_of(folder / "page.html", folder, 0)
    shutil.copyfile(folder / "page.jpg", target / "page.jpg")


def film(command, folder, target):
    """Joins the frames of "See the proof" of `kitchen` to an animated WebP."""
    from PIL import Image

    platewash(command, "run", "--scenario", "kitchen", "--out", folder)
    frames_of(folder / "page.html", folder, "film")
    shown_ms = [round(ms) for ms in json.loads((folder / "film.json").read_text())]
    frames = [Image.open(folder / f"frame-{k:03}.png").convert("RGB") for k in range(len(shown_ms))]
    kept = {"quality": QUALITY, "method": EFFORT}
    frames[0].save(target / "kitchen.webp", save_all=True, append_images=frames[1:], duration=shown_ms, loop=0, **kept)


MADE = {"figures": figures, "page": page, "film": film}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command", type=Path, help="the platewash program")
    parser.add_argument("--only", choices=MADE)
    parser.add_argument("--target", type=Path, default=HERE, help="folder to write to")
    arguments = parser.parse_args()
    command = str(arguments.command.resolve())
    for name, make in MADE.items():
        with tempfile.TemporaryDirectory() as folder:
            if arguments.only in (None, name):
                make(command, Path(folder), arguments.target)


if __name__ == "__main__":
    main()
