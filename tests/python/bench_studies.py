"""One study by every engine: the same bytes, and what each costs over threads. No part of the tests.

    python -m venv bench && bench/bin/pip install '.[dask,ray]'
    bench/bin/python tests/python/bench_studies.py rows 500         # kitchen x 4 tools x 500 seeds by all engines, whole
    bench/bin/python tests/python/bench_studies.py overhead 40 5    # kitchen x 4 tools x 10 seeds, engines in turn, 5 rounds
    bench/bin/python tests/python/bench_studies.py empty 100000     # rows of a planner that does nothing: the engine alone
    bench/bin/python tests/python/bench_studies.py shares 2000      # the same, a row a share: what a share costs

Engines are begun before the clock is. Each works with two workers, or as many as a third argument of ``rows`` and ``empty`` says.
"""

import hashlib
import statistics
import sys
import tempfile
import time
import uuid
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pyplatewash as pw
from pyplatewash import _core
from pyplatewash._studies.engines import drive as driven
from pyplatewash._studies.engines.drive import drive
from pyplatewash._studies.engines.contract import Engine, Kit, Share
from pyplatewash._studies.run import begin

ENGINES = ["threads", "processes", "dask", "ray"]
TOOLS_M = [0.12, 0.13, 0.14, 0.15]


def tools(seeds: int) -> pw.Study:
    return pw.Study("kitchen", {"tool.length_m": TOOLS_M, "seed": range(1, seeds + 1)}, name="tools")


def begun(engine: str, study: pw.Study, workers: int, is_empty: bool) -> Engine | None:
    """An engine whose workers have read the study; None for threads."""
    if engine == "threads":
        return None
    one = begin(engine, Kit(uuid.uuid4().hex, pw.__version__, study._parts(), is_empty), workers, None, None)
    shares = [one.send(Share((0,), 0.0)) for _ in range(4 * workers)]
    for share in shares:
        one.rows(share)
    return one


def worked(engine: str, study: pw.Study, folder: Path, workers: int = 2, is_empty: bool = False) -> tuple[float, str]:
    """Seconds that all rows take, and the hash of what they are."""
    one = begun(engine, study, workers, is_empty)
    journal = _core.StudyJournal(folder, study)
    began = time.perf_counter()
    if one is None:
        journal.work(workers, lambda done, rows: None)
    else:
        drive(one, journal, len(study), lambda done, rows: None)
    took = time.perf_counter() - began
    journal.finish()
    journal.close()
    if one is not None:
        one.close()
    file = folder.with_suffix(".jsonl")
    pw.run_command(["study", "export", str(folder), "--to", str(file)])
    return took, hashlib.sha256(file.read_bytes()).hexdigest()


def rows(seeds: int, workers: int = 2) -> None:
    study = tools(seeds)
    for engine in ENGINES:
        with tempfile.TemporaryDirectory() as folder:
            took, sha256 = worked(engine, study, Path(folder) / engine, workers)
        print(f"{engine:10} {len(study)} rows in {took:.1f} s, {len(study) / took:.2f} rows/s, sha256 {sha256}", flush=True)


def overhead(rows: int, rounds: int) -> None:
    study = tools(rows // len(TOOLS_M))
    ratios: dict[str, list[float]] = {engine: [] for engine in ENGINES}
    for k in range(rounds):
        took: dict[str, Any] = {}
        for engine in ENGINES if k % 2 == 0 else ENGINES[::-1]:
            with tempfile.TemporaryDirectory() as folder:
                took[engine], _ = worked(engine, study, Path(folder) / engine)
        for engine in ENGINES:
            ratios[engine].append(took[engine] / took["threads"])
        print(*(f"{engine} {took[engine]:.2f} s" for engine in ENGINES), flush=True)
    for engine in ENGINES:
        print(f"{engine:10} {statistics.median(ratios[engine]):.3f} times what threads take (median of {rounds})")


def empty(rows: int, workers: int = 2) -> None:
    study = pw.Study("kitchen", {"seed": range(1, rows + 1)}, name="empty")
    for engine in ENGINES[1:]:
        with tempfile.TemporaryDirectory() as folder:
            took, _ = worked(engine, study, Path(folder) / engine, workers, is_empty=True)
        print(f"{engine:10} {rows} rows in {took:.2f} s, {1e6 * took / rows:.1f} us a row", flush=True)


def shares(rows: int, workers: int = 2) -> None:
    driven.MOST_ROWS = 1
    empty(rows, workers)


if __name__ == "__main__":
    verbs: dict[str, Callable[..., None]] = {"rows": rows, "overhead": overhead, "empty": empty, "shares": shares}
    verbs[sys.argv[1]](*map(int, sys.argv[2:]))
