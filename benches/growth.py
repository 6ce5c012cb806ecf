"""How instructions, time and peak memory grow with the size of a job: the table "Growth" of docs/benchmarks.md.

    cargo build --release --bin platewash
    python benches/growth.py [plates] [turns] [obstacles] [triangles] [rows] [short-rows]

Instructions are callgrind's (valgrind), on one thread; peak memory is of a run without it. The exponent of a size is
log(f(n) / f(m)) / log(n / m) with the size m before it: 1 is linear. Studies are measured in wall time, with one and with two threads.
"""

import argparse
import math
import os
import re
import struct
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PLATEWASH = ROOT / "target" / "release" / "platewash"
SIZES = {
    "plates": [1, 2, 4, 10, 20, 40],
    "turns": [3, 10, 30, 100, 200],
    "obstacles": [0, 1, 10, 30, 100],
    "triangles": [300, 1_000, 3_000, 10_000],
}
STUDIES = {"rows": [10, 100, 1_000], "short-rows": [100, 1_000, 10_000]}
KITCHEN = (ROOT / "scenarios" / "kitchen.toml").read_text()
SPIRAL = (ROOT / "scenarios" / "kitchen-spiral.toml").read_text()


def without_layout(text: str) -> str:
    """A shipped scenario without its section `[layout]`."""
    return re.sub(r"\[layout\]\n(?:.+\n)+", "", text)


def layout(centres: list[tuple[float, float]], radius_m: float) -> str:
    places = ", ".join(f"[{x:.6f}, {y:.6f}]" for x, y in centres)
    keys = f"plate_radius_m = {radius_m}\nplate_height_m = 0.03\nplate_thickness_m = 0.02\nmin_distance_m = {2 * radius_m}\n"
    return f"\n[layout]\n{keys}base_radius_m = 0.2\npositions_m = [{places}]\n"


def plates(count: int, _folder: Path) -> str:
    """Small plates on two arcs in front of the arm, from the middle outwards."""
    arcs = [(radius, angle) for radius in (0.31, 0.39) for angle in range(-95, 96, 10)]
    arcs.sort(key=lambda place: (abs(place[1]), place))
    centres = [(rho * math.cos(math.radians(turn)), rho * math.sin(math.radians(turn))) for rho, turn in arcs[:count]]
    return without_layout(KITCHEN) + layout(centres, 0.026)


def turns(count: int, _folder: Path) -> str:
    """One plate of `kitchen-spiral`, with so many turns."""
    text = without_layout(SPIRAL) + layout([(0.30, 0.0)], 0.145)
    # Three turns are too wide apart for 99.5 %.
    return text.replace("turns = 3.5 ", f"turns = {count} ").replace("required_coverage = 0.995", "required_coverage = 0.9")


def obstacles(count: int, _folder: Path) -> str:
    """`kitchen` with posts on a circle behind and beside the plates."""
    angles = [math.radians(100 + 160 * (k + 0.5) / max(count, 1)) for k in range(count)]
    posts = [
        f'\n[[obstacle]]\nname = "post {k}"\nshape = "box"\nsize_m = [0.01, 0.01, 0.3]\n'
        f"at_m = [{0.6 * math.cos(turn):.6f}, {0.6 * math.sin(turn):.6f}, 0.15]\n"
        for k, turn in enumerate(angles)
    ]
    return KITCHEN + "".join(posts)


def triangles(count: int, folder: Path) -> str:
    """`kitchen` with a bumpy ball of so many triangles behind the arm, decomposed into convex parts."""
    around = round(math.sqrt(count))
    rings = count // (2 * around) + 1

    def vertex(ring: int, k: int) -> tuple[float, float, float]:
        polar, turn = math.pi * ring / rings, 2 * math.pi * (k % around) / around
        radius = 0.1 * (1 + 0.2 * math.sin(5 * polar) * math.sin(5 * turn))
        return radius * math.sin(polar) * math.cos(turn), radius * math.sin(polar) * math.sin(turn), radius * math.cos(polar)

    faces = []
    for ring in range(rings):
        for k in range(around):
            a, b, c, d = vertex(ring, k), vertex(ring, k + 1), vertex(ring + 1, k), vertex(ring + 1, k + 1)
            faces += [(a, c, b), (b, c, d)]
    with open(folder / "ball.stl", "wb") as stl:
        stl.write(b" " * 80 + struct.pack("<I", len(faces)))
        for face in faces:
            stl.write(struct.pack("<12fH", 0, 0, 0, *face[0], *face[1], *face[2], 0))
    keys = 'name = "ball"\nshape = "mesh"\nmesh = "ball.stl"\nmesh_parts = "decomposed"\nat_m = [-0.5, 0, 0.3]\n'
    return f"{KITCHEN}\n[[obstacle]]\n{keys}"


def spent(words: list, folder: Path) -> tuple[float, int]:
    """Wall time [s] and peak memory [bytes] of a command that ends well."""
    began = time.perf_counter()
    with open(folder / "said", "wb") as said:
        process = subprocess.Popen(words, stdout=said, stderr=said)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode:
        sys.exit(f"{' '.join(map(str, words))} ended with {process.returncode}:\n{(folder / 'said').read_text()}")
    return time.perf_counter() - began, usage.ru_maxrss * 1024


def instructions(words: list, folder: Path) -> int:
    out = folder / "callgrind"
    spent(["valgrind", "--tool=callgrind", f"--callgrind-out-file={out}", *words], folder)
    return int(re.search(r"^(?:summary|totals): (\d+)", out.read_text(), re.M)[1])


def exponent(before, here, index: int) -> str:
    if before is None or before[0] == 0:
        return "–"
    return f"{math.log(here[index] / before[index]) / math.log(here[0] / before[0]):.2f}"


def table(kind: str) -> None:
    print(f"\n| {kind} | `plan`, instructions | exponent | `verify`, instructions | exponent | peak memory | exponent |")
    print("| ---: | ---: | ---: | ---: | ---: | ---: | ---: |", flush=True)
    before = None
    for size in SIZES[kind]:
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            (folder / "job.toml").write_text(globals()[kind](size, folder))
            common = ["--threads", "1", "--quiet"]
            plan = [PLATEWASH, "plan", "--scenario", folder / "job.toml", "--out", folder, *common]
            verify = [PLATEWASH, "verify", folder / "plan.json", *common]
            bytes_taken = max(spent(plan, folder)[1], spent(verify, folder)[1])
            here = (size, instructions(plan, folder), instructions(verify, folder), bytes_taken)
        cells = [f"{here[1] / 1e6:.0f} M", f"{here[2] / 1e6:.0f} M", f"{here[3] / 1e6:.0f} MB"]
        pairs = (f"{cell} | {exponent(before, here, k + 1)}" for k, cell in enumerate(cells))
        print(f"| {size} | {' | '.join(pairs)} |", flush=True)
        before = here


def rows(kind: str) -> None:
    """Studies of `kitchen`, or of two plates in one place, whose rows cost next to nothing but their keeping."""
    print(f"\n| {kind} | threads | rows/s | exponent of the time | peak memory | exponent | of twice one thread |")
    print("| ---: | ---: | ---: | ---: | ---: | ---: | ---: |", flush=True)
    before = {}
    for count in STUDIES[kind]:
        rates = []
        for threads in (1, 2):
            with tempfile.TemporaryDirectory() as name:
                folder = Path(name)
                (folder / "job.toml").write_text(KITCHEN if kind == "rows" else without_layout(KITCHEN) + layout([(0.3, 0.0), (0.3, 0.01)], 0.145).replace("min_distance_m", "# min_distance_m"))
                head = 'format = "platewash-study/1"\nname = "growth"\nscenario = "job.toml"\n'
                (folder / "study.toml").write_text(f'{head}[[axis]]\nkey = "seed"\nseeds = "1..{count}"\n')
                words = [PLATEWASH, "study", "run", folder / "study.toml", "--out", folder / "rows", "--threads", str(threads), "--quiet"]
                wall_s, bytes_taken = spent(words, folder)
            here = (count, wall_s, bytes_taken)
            rates.append(count / wall_s)
            share = f"{rates[1] / (2 * rates[0]):.2f}" if threads == 2 else "–"
            time_and_memory = [exponent(before.get(threads), here, k) for k in (1, 2)]
            cells = [count, threads, f"{rates[-1]:.1f}", time_and_memory[0], f"{bytes_taken / 1e6:.0f} MB", time_and_memory[1], share]
            print(f"| {' | '.join(map(str, cells))} |", flush=True)
            before[threads] = here


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("kinds", nargs="*", help=f"tables to make, of {', '.join([*SIZES, *STUDIES])}; without any, all")
    for kind in parser.parse_args().kinds or [*SIZES, *STUDIES]:
        if kind in STUDIES:
            rows(kind)
        elif kind in SIZES:
            table(kind)
        else:
            parser.error(f"no table '{kind}': expected one of {', '.join([*SIZES, *STUDIES])}")


if __name__ == "__main__":
    main()
