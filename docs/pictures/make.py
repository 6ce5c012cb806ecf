"""Makes the pictures of the documentation and the animation of the README, from what the command draws.

    cargo build --release
    python docs/pictures/make.py target/release/platewash

`--only pictures` leaves the animation out, which needs Pillow (matplotlib brings it along).
"""

import argparse
import json
import shutil
import subprocess
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent

# By scenario: figure of the command, and the file that shows it here.
PICTURES = {
    "kitchen": {"layout": "kitchen-layout.svg", "flow": "flow.svg"},
    "paper-appendix": {"spiral": "paper-spiral.svg", "sheet": "paper-sheet.svg"},
}

# The part of a figure "moment" in which the workcell is: left, top, right, lower edge, in pixels.
VIEW = (70, 130, 1200, 915)
WIDTH, FRAMES_A_SECOND, TIMES_FASTER = 720, 12, 8

# Colours of small things, which a palette of the most frequent colours would leave out: paths, axes, sponge, badge.
SMALL = ["#c2187f", "#e8a6cd", "#0072b2", "#56b4e9", "#d5400d", "#00795a", "#0b5fa5", "#fad440", "#c7a220", "#d00d14"]


def platewash(command, *arguments):
    line = [command, *map(str, arguments), "--quiet"]
    subprocess.run(line, check=True, capture_output=True)


def planned(command, scenario, folder):
    """The plan file of a scenario."""
    platewash(command, "plan", "--scenario", scenario, "--out", folder / scenario)
    return folder / scenario / "plan.json"


def pictures(command, folder, target):
    """Writes the pictures to a folder."""
    for scenario, figures in PICTURES.items():
        drawn = folder / f"{scenario}-figures"
        platewash(command, "figures", planned(command, scenario, folder), "--only", ",".join(figures), "--out", drawn)
        for figure, name in figures.items():
            shutil.copyfile(drawn / f"{figure}.svg", target / name)


def palette_of(frame):
    """One palette for all frames: the frequent colours of one of them, and those of small things with what lies between them and white."""
    from PIL import Image, ImageColor

    small = []
    for colour in SMALL:
        for share in (1.0, 0.7, 0.4):
            small += [round(255 + share * (part - 255)) for part in ImageColor.getrgb(colour)]
    frequent = 256 - len(small) // 3
    palette = Image.new("P", (1, 1))
    palette.putpalette(frame.quantize(frequent).getpalette()[: 3 * frequent] + small)
    return palette


def animation(command, folder, target):
    """Writes the washing of `kitchen`, moment by moment, as an animated GIF."""
    from PIL import Image

    plan = planned(command, "kitchen", folder)
    duration = json.loads(plan.read_text())["knots"]["t_s"][-1]
    count = round(duration / TIMES_FASTER * FRAMES_A_SECOND)
    frames = []
    for k in range(count):
        drawn = folder / "moment"
        platewash(command, "figures", plan, "--only", "moment", "--at", duration * k / count, "--out", drawn)
        with Image.open(drawn / "moment.png") as picture:
            view = picture.convert("RGB").crop(VIEW)
        size = (WIDTH, round(WIDTH * view.height / view.width))
        frames.append(view.resize(size, Image.Resampling.LANCZOS))
    palette = palette_of(frames[-1])
    frames = [frame.quantize(palette=palette, dither=Image.Dither.NONE) for frame in frames]
    shown_ms = round(1000 / FRAMES_A_SECOND)
    frames[0].save(target, save_all=True, append_images=frames[1:], duration=shown_ms, loop=0, optimize=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command", type=Path, help="the platewash program")
    parser.add_argument("--only", choices=["pictures", "animation"])
    parser.add_argument("--target", type=Path, default=HERE, help="folder to write to")
    arguments = parser.parse_args()
    command = str(arguments.command.resolve())
    with tempfile.TemporaryDirectory() as folder:
        if arguments.only != "animation":
            pictures(command, Path(folder), arguments.target)
        if arguments.only != "pictures":
            animation(command, Path(folder), arguments.target / "kitchen.gif")


if __name__ == "__main__":
    main()
