"""Writes `spiral-knots.json`: the wash knots of `kitchen-spiral`, thinned, as a program planned them.

    python3 tests/golden/spiral_knots.py PLATEWASH [SCENARIO]

The committed file is of the last program before there were rings and a promise about contact (commit ee369e1), whose scenario `kitchen`
is `kitchen-spiral` today. `tests/spiral_knots.rs` compares.
"""

import json
import subprocess
import sys
import tempfile
from pathlib import Path

SEEDS = (1, 2, 3)
#: Every so manieth knot of a wash is kept.
EVERY = 10
#: Digits behind the point of seconds and radians: two hundred times finer than what is compared.
DIGITS = 11


def washes(program: str, scenario: str, seed: int) -> list[dict]:
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([program, "plan", "--scenario", scenario, "--seed", str(seed), "--out", folder, "--quiet"], check=True, stdout=subprocess.DEVNULL)
        plan = json.loads(Path(folder, "plan.json").read_text(encoding="utf-8"))
    knots, found = plan["knots"], []
    for segment in plan["segments"]:
        if segment["kind"] != "wash":
            continue
        start, end = segment["t_start_s"], segment["t_end_s"]
        inside = [k for k, t in enumerate(knots["t_s"]) if start <= t <= end]
        rows = [[round(number, DIGITS) for number in [knots["t_s"][k] - start, *knots["q_rad"][k]]] for k in inside[::EVERY]]
        found.append({"plate": segment["plate"], "knots": len(inside), "t_s_q_rad": rows})
    return found


def main() -> None:
    program, scenario = sys.argv[1], (sys.argv[2:] or ["kitchen-spiral"])[0]
    lines = []
    for seed in SEEDS:
        for wash in washes(program, scenario, seed):
            rows = ",\n".join(json.dumps(row) for row in wash.pop("t_s_q_rad"))
            head = json.dumps({"seed": seed, **wash})[:-1]
            lines.append(f'{head}, "t_s_q_rad": [\n{rows}]}}')
    text = f'{{"every": {EVERY}, "washes": [\n' + ",\n".join(lines) + "]}\n"
    Path(__file__).with_name("spiral-knots.json").write_text(text, encoding="utf-8")


main()
