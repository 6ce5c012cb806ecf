"""What reading many rows of a study costs, each way in a process of its own. By hand: python tests/python/bench_rows.py 100000"""

import hashlib
import random
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

import pyplatewash as pw
import study_folders

WAYS = ["open", "iterate", "summary", "export", "to_parquet", "to_frame"]


def made(at: Path, count: int) -> None:
    """The folder of a finished study with so many rows, in an order by chance."""
    order = list(range(count))
    random.Random(1).shuffle(order)
    fields = {"reason": 100 * "x", "duration_s": 9.5, "swept": 0.99, "clearance_m": 0.01, "clearance_pair": ["link_4", "handle"], "plan": 64 * "a"}

    def row(k: int) -> dict[str, Any]:
        return study_folders.row(k, {"seed": k, "tool.length_m": 0.1}, **fields)

    sha256 = hashlib.sha256()
    for k in range(count):
        sha256.update(study_folders.line(row(k)))
    study_folders.folder(at, ["tool.length_m", "seed"], map(row, order), count, rows_sha256=sha256.hexdigest())


def measured(way: str, at: Path) -> str:
    """Time and memory of one way."""
    before, start = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss, time.perf_counter()
    rows = pw.StudyRows(at)
    if way == "iterate":
        assert sum(1 for _ in rows) == len(rows)
    elif way == "to_parquet":
        rows.to_parquet(at.parent / "rows.parquet")
    elif way == "export":
        rows.export(at.parent / "rows.export")
    elif way != "open":
        getattr(rows, way)()
    most = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return f"{way:12}{time.perf_counter() - start:8.2f} s {most / 1024:8.0f} MB, {before / 1024:.0f} MB of it before"


if __name__ == "__main__":
    if len(sys.argv) == 3:
        print(measured(sys.argv[1], Path(sys.argv[2])))
    else:
        with tempfile.TemporaryDirectory() as folder:
            study = Path(folder) / "study"
            # A process of its own, whose memory the others do not begin with.
            code = "import bench_rows, pathlib, sys; bench_rows.made(pathlib.Path(sys.argv[1]), int(sys.argv[2]))"
            subprocess.run([sys.executable, "-c", code, study, sys.argv[1]], cwd=Path(__file__).parent, check=True)
            for each in WAYS:
                subprocess.run([sys.executable, __file__, each, study], check=True)
