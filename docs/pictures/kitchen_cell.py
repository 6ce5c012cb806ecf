"""Draws kitchen-cell.svg: what the paper's program washes beside what a proved plan washes.

    platewash run --scenario paper-appendix --out paper
    platewash run --scenario kitchen --out kitchen
    python docs/pictures/kitchen_cell.py paper kitchen docs/pictures/kitchen-cell.svg
"""

import csv
import json
import sys
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parent))

from paper_cell import discs, line, page, panel  # noqa: E402


def tip_paths(file):
    """Points of the tip while it washes, by plate, and between."""
    washing, between = {}, [[]]
    with open(file, newline="") as rows:
        for row in csv.DictReader(rows):
            point = float(row["tip_x_m"]), float(row["tip_y_m"])
            if row["segment"] == "wash":
                washing.setdefault(int(row["plate"]), []).append(point)
                if between[-1]:
                    between.append([])
            else:
                between[-1].append(point)
    return washing, [path for path in between if len(path) > 1]


def main(paper, kitchen, target):
    plans = [json.loads((folder / "plan.json").read_text()) for folder in (paper, kitchen)]
    reports = [json.loads((folder / "report.json").read_text()) for folder in (paper, kitchen)]
    executed, _ = tip_paths(paper / "executed.csv")
    washed, between = tip_paths(kitchen / "trajectory.csv")
    washed = {plate: path[::4] + path[-1:] for plate, path in washed.items()}
    swept = {p["plate"]: f'{100 * p["executed_coverage"]["fraction"]:.0f} %' for p in reports[0]["plates"]}
    certificate = reports[1]["certificate"]
    proved = {p["plate"]: f'{100 * p["at_least"]:.0f} %' for p in certificate["coverage"]}
    clearance = next(c for c in certificate["checks"] if c["requirement"] == "clearance")["measure"]["bound"]
    left = panel("The paper's program", "as its control law executes it", discs(plans[0]), executed, "#c2258f", swept)
    note = f'{reports[1]["duration_s"]:.1f} s from home to home, nothing nearer than {1e3 * clearance:.0f} mm'
    transits = "\n".join(
        line(path[::8] + path[-1:], fill="none", stroke="#57606a", stroke_width=1.2, stroke_dasharray="5 4") for path in between
    )
    right = panel("kitchen, proved", note, discs(plans[1]), washed, "#0969da", proved) + transits
    foot = "Share of each plate that a sponge of radius 25 mm sweeps (right: guaranteed at least), seen from above. Dashed: transits."
    target.write_text(page(left, right, foot))


if __name__ == "__main__":
    main(*map(Path, sys.argv[1:]))
