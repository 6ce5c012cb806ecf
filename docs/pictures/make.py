"""Makes the pictures of the documentation and the animation of the README.

    cargo build --release
    cargo xtask test --only browser     # once: fetches the browser into target/browser
    python docs/pictures/make.py target/release/platewash

Figures come from the command, all others from its page, in the browser of the tests. `--only figures` leaves those of the page out, for
which Pillow is needed (matplotlib brings it along).
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

WIDTH, FRAMES_A_SECOND, TIMES_FASTER = 720, 12, 8


def platewash(command, *arguments):
    subprocess.run([command, *map(str, arguments), "--quiet"], check=True, capture_output=True)


def figures(command, folder, target):
    """Draws the figures."""
    for scenario, (figure, name) in FIGURES.items():
        platewash(command, "plan", "--scenario", scenario, "--out", folder / scenario)
        platewash(command, "figures", folder / scenario / "plan.json", "--only", figure, "--out", folder / scenario)
        shutil.copyfile(folder / scenario / f"{figure}.svg", target / name)


def frames_of(page, folder, count):
    """Draws a page, and so many frames of its scene, in the browser of the tests; see page.mjs."""
    script = shutil.copyfile(HERE / "page.mjs", BROWSER / "page.mjs")
    node = NODE if NODE.exists() else "node"
    subprocess.run([node, script, page, folder, str(count)], check=True)


def pages(command, folder, target):
    """Takes the picture of the page of `kitchen`, and joins those of its scene to an animated GIF."""
    from PIL import Image

    platewash(command, "run", "--scenario", "kitchen", "--out", folder)
    duration_s = json.loads((folder / "plan.json").read_text())["knots"]["t_s"][-1]
    count = round(duration_s / TIMES_FASTER * FRAMES_A_SECOND)
    frames_of(folder / "page.html", folder, count)
    shutil.copyfile(folder / "page.jpg", target / "page.jpg")
    frames = []
    for k in range(count):
        with Image.open(folder / f"frame-{k:03}.png") as picture:
            size = (WIDTH, round(WIDTH * picture.height / picture.width))
            frames.append(picture.convert("RGB").resize(size, Image.Resampling.LANCZOS))
    # Small patches of colour count as well as large ones.
    palette = frames[-1].quantize(256, method=Image.Quantize.MAXCOVERAGE)
    frames = [frame.quantize(palette=palette, dither=Image.Dither.NONE) for frame in frames]
    shown_ms = round(1000 / FRAMES_A_SECOND)
    frames[0].save(target / "kitchen.gif", save_all=True, append_images=frames[1:], duration=shown_ms, loop=0, optimize=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command", type=Path, help="the platewash program")
    parser.add_argument("--only", choices=["figures", "pages"])
    parser.add_argument("--target", type=Path, default=HERE, help="folder to write to")
    arguments = parser.parse_args()
    command = str(arguments.command.resolve())
    with tempfile.TemporaryDirectory() as folder:
        if arguments.only != "pages":
            figures(command, Path(folder), arguments.target)
        if arguments.only != "figures":
            pages(command, Path(folder), arguments.target)


if __name__ == "__main__":
    main()
