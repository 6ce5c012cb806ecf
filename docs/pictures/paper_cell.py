"""Draws paper-cell.svg: the paper's workcell from above, as planned and as executed.

    platewash run --scenario paper-appendix --out out
    python docs/pictures/paper_cell.py out docs/pictures/paper-cell.svg
"""

import csv
import json
import sys
from pathlib import Path

UNIT = 410.0  # pixels per metre
WIDTH, HEIGHT, TOP, GAP = 470, 440, 66, 30
X_MAX, Y_MAX = 0.48, 0.57  # robot coordinates of the top left corner, metres


def pixel(x, y):
    """Robot x points up, robot y to the left: the cell seen from above, from behind the arm."""
    return (Y_MAX - y) * UNIT, TOP + (X_MAX - x) * UNIT


def discs(plan):
    """Centre and radius of each plate, metres."""
    return [(*plate["pose"]["position_m"][:2], plate["surface"]["radius_m"]) for plate in plan["job"]["plates"]]


def line(points, **style):
    d = "M" + " L".join(f"{px:.1f} {py:.1f}" for px, py in (pixel(x, y) for x, y in points))
    return f'<path d="{d}" {attributes(style)}/>'


def attributes(style):
    return " ".join(f'{name.replace("_", "-")}="{value}"' for name, value in style.items())


def circle(x, y, radius, **style):
    px, py = pixel(x, y)
    return f'<circle cx="{px:.1f}" cy="{py:.1f}" r="{radius * UNIT:.1f}" {attributes(style)}/>'


def text(px, py, words, size=15, **style):
    return f'<text x="{px:.1f}" y="{py:.1f}" font-size="{size}" {attributes(style)}>{words}</text>'


def panel(title, note, plates, paths, colour, labels):
    out = [text(0, 22, title, 19, font_weight="600", fill="#1b1f24"), text(0, 44, note, 14, fill="#57606a")]
    x0, y0 = pixel(0.0905, 0.0905)
    x1, y1 = pixel(-0.2115, -0.0905)
    out.append(f'<rect x="{x0:.1f}" y="{y0:.1f}" width="{x1 - x0:.1f}" height="{y1 - y0:.1f}" rx="6" fill="#f08c3a"/>')
    cx, cy = pixel(-0.06, 0.0)
    out.append(text(cx, cy + 5, "IRB 120", 14, fill="#ffffff", text_anchor="middle"))
    for plate in plates:
        out.append(circle(*plate, fill="#f6f8fa", stroke="#8c959f", stroke_width=1.5))
    for number, plate in enumerate(plates):
        clip = f'{title.split()[0].lower()}-{number}'
        out.append(f'<clipPath id="{clip}">{circle(*plate)}</clipPath>')
        band = line(paths[number], fill="none", stroke=colour, stroke_width=f"{0.05 * UNIT:.1f}", stroke_linecap="round",
                    stroke_linejoin="round", stroke_opacity=0.35)
        out.append(f'<g clip-path="url(#{clip})">{band}</g>')
        out.append(line(paths[number], fill="none", stroke=colour, stroke_width=1.6))
    for number, (x, y, _) in enumerate(plates):
        px, py = pixel(x, y)
        out.append(text(px, py + 5, labels[number], 16, fill="#1b1f24", text_anchor="middle", font_weight="600",
                        paint_order="stroke", stroke="#ffffff", stroke_width=4))
    return "\n".join(out)


def page(left, right, foot):
    """The whole picture: two panels beside one another and a line below."""
    width = 2 * WIDTH + 3 * GAP
    return f"""<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {HEIGHT}" font-family="Helvetica, Arial, sans-serif">
<rect width="100%" height="100%" fill="#ffffff"/>
<g transform="translate({GAP} 14)">{left}</g>
<g transform="translate({2 * GAP + WIDTH} 14)">{right}</g>
{text(GAP, HEIGHT - 14, foot, 13, fill="#57606a")}
</svg>
"""


def main(folder, target):
    plan = json.loads((folder / "plan.json").read_text())
    report = json.loads((folder / "report.json").read_text())
    plates = discs(plan)

    def spirals(name):
        paths = {}
        with open(folder / name, newline="") as file:
            for row in csv.DictReader(file):
                if row["segment"] == "wash":
                    paths.setdefault(int(row["plate"]), []).append((float(row["tip_x_m"]), float(row["tip_y_m"])))
        return paths

    ideal, executed = spirals("trajectory.csv"), spirals("executed.csv")
    covered = {p["plate"]: (p["ideal_coverage"]["fraction"], p["executed_coverage"]["fraction"]) for p in report["plates"]}
    label = {i: [f"{100 * c:.0f} %" for c in covered[i]] for i in covered}
    numbers = range(len(plates))
    left = panel("Commanded", "the spirals that the program asks for", plates, ideal, "#c2258f", {i: label[i][0] for i in numbers})
    right = panel("Executed", "what its control law makes of them", plates, executed, "#0969da", {i: label[i][1] for i in numbers})
    foot = f"Paper's program, {plan['provenance']['scenario']}, seed {plan['job']['seed']}: share of each plate swept by a sponge of radius 25 mm, seen from above."
    target.write_text(page(left, right, foot))


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]))
