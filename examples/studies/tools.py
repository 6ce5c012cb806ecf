"""The study of docs/tools-over-the-table.md: writes its file, `tools.toml`, and draws the maps of its rows.

    python examples/studies/tools.py                                          # writes examples/studies/tools.toml anew
    platewash study run examples/studies/tools.toml --out out/tools --threads 1
    python examples/studies/tools.py --rows out/tools --to docs/pictures      # draws the maps
"""

import argparse
import math
from pathlib import Path

HERE = Path(__file__).resolve().parent

# The region of the scenario `kitchen`: x and y of plate centres, and their least distance from the base axis [m].
X_M, Y_M, BASE_M = 0.30, 0.38, 0.28
STEP_M = 0.02
HEIGHT_M = 0.03

TOOLS = {"tool.length_m": (0.05, 0.10, 0.15), "tool.radius_m": (0.015, 0.030), "tool.sponge_radius_m": (0.020, 0.030)}
PLACE = "plate[0].at_m"

HEAD = """\
# Twelve tools, and a plate at every place of a grid of 2 cm over the region of the scenario `kitchen`: which of them wash it, and where
# does it stop? docs/tools-over-the-table.md has the answer. Written by tools.py beside it.
format = "platewash-study/1"
name = "tools over the table"
scenario = "one-plate.toml"
"""


def places():
    """Centres of plates [m]: all of the grid that the region holds."""
    grid = [(i * STEP_M, j * STEP_M) for i in range(round(X_M / STEP_M) + 1) for j in range(-round(Y_M / STEP_M), round(Y_M / STEP_M) + 1)]
    return [(round(x, 3), round(y, 3)) for x, y in grid if math.hypot(x, y) >= BASE_M - 1e-9]


def study():
    """The study file's text."""
    axes = [f'\n[[axis]]\nkey = "{key}"\nvalues = {list(values)}\n' for key, values in TOOLS.items()]
    listed = [f"[{x}, {y}, {HEIGHT_M}]" for x, y in places()]
    lines = "".join(f"    {', '.join(listed[k : k + 6])},\n" for k in range(0, len(listed), 6))
    return f'{HEAD}{"".join(axes)}\n[[axis]]\nkey = "{PLACE}"\nvalues = [\n{lines}]\n'


#: Maps by their file: what they show, and the axes that they are apart by.
MAPS = {
    "tools-outcomes.png": ("outcome", ["tool.sponge_radius_m", "tool.length_m"]),
    "tools-clearance.png": ("clearance", ["tool.radius_m", "tool.length_m"]),
}


def draw(rows, to):
    """Draws the maps of rows into a folder."""
    import matplotlib

    matplotlib.use("agg")
    import pyplatewash as pw

    read = pw.StudyRows(rows)
    to.mkdir(parents=True, exist_ok=True)
    for name, (value, by) in MAPS.items():
        axes = read.map(PLACE, value, by=by, region="kitchen")
        axes[0].figure.savefig(to / name, dpi=160, metadata={"Software": None})


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rows", type=Path, help="the study's folder")
    parser.add_argument("--to", type=Path, help="folder for the maps of its rows")
    arguments = parser.parse_args()
    if (arguments.rows is None) != (arguments.to is None):
        parser.error("--rows and --to go together")
    if arguments.rows is not None:
        draw(arguments.rows, arguments.to)
    else:
        (HERE / "tools.toml").write_text(study(), encoding="utf-8")


if __name__ == "__main__":
    main()
