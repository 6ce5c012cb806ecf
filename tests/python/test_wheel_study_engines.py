"""Studies by engines: the same rows by each, none lost, none twice."""

import importlib
import json
import os
import random
import signal
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from concurrent.futures import Future
from pathlib import Path
from typing import Any

import pytest

import pyplatewash as pw
import study_killers
from ctrl_c import heed_ctrl_c, no_sigint
from pyplatewash import _core
from pyplatewash._studies.engines import drive as driven
from pyplatewash._studies.engines import processes
from pyplatewash._studies import run as runs
from pyplatewash._studies.engines.contract import Died, Made, Share

ENGINES = ["processes", "dask", "ray"]
#: Plates that are planned in some hundredths of a second, and one that cannot be.
PLATES: dict[str, list[Any]] = {"plate[0].at_m": [[0.35, 0.0, 0.03], [0.3, 0.2, 0.03], [0.9, 0.9, 0.03]], "tool.length_m": [0.14, 0.15]}


@pytest.fixture(scope="module")
def plate(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A scenario of one plate."""
    kitchen = pw.Scenario.load("kitchen").to_dict()
    kitchen["layout"] = {"base_radius_m": 0.28}
    kitchen["plate"] = [{"at_m": [0.35, 0.0, 0.03]}]
    file = tmp_path_factory.mktemp("scenario") / "one.toml"
    file.write_text(pw.Scenario.from_dict(kitchen).to_toml())
    return file


@pytest.fixture(scope="module")
def study(plate: Path) -> pw.Study:
    return pw.Study(plate, PLATES, name="plates", plans="all")


@pytest.fixture(scope="module")
def by_threads(study: pw.Study, tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("rows") / "threads"
    study.run(out, workers=1, progress=False)
    return out


def exported(folder: Path) -> bytes:
    """The canonical rows of a folder."""
    file = folder.parent / f"{folder.name}.jsonl"
    assert pw.run_command(["study", "export", str(folder), "--to", str(file)]) == 0
    return file.read_bytes()


def plans(folder: Path) -> dict[str, bytes]:
    return {file.name: file.read_bytes() for file in (folder / "plans").iterdir()}


@pytest.mark.parametrize("engine", ENGINES)
def test_every_engine_gives_the_same_bytes(engine: Any, study: pw.Study, by_threads: Path, tmp_path: Path, plate: Path) -> None:
    told: list[tuple[int, int]] = []
    hidden = plate.with_suffix(".away")
    plate.rename(hidden)  # Workers need no file.
    try:
        rows = study.run(tmp_path / "out", engine=engine, workers=2, progress=lambda done, of: told.append((done, of)))
    finally:
        hidden.rename(plate)
    assert rows.finished and told[-1] == (6, 6)
    assert exported(tmp_path / "out") == exported(by_threads)
    assert plans(tmp_path / "out") == plans(by_threads) and len(plans(by_threads)) == 4
    outcomes = [json.loads(line)["outcome"] for line in exported(by_threads).splitlines()]
    assert outcomes.count("proved") == 4 and outcomes[4:] == ["infeasible"] * 2


@pytest.mark.parametrize("by", ["client", "address"])
def test_uses_an_existing_dask_cluster_and_leaves_it_running(by: str, study: pw.Study, by_threads: Path, tmp_path: Path) -> None:
    distributed: Any = importlib.import_module("distributed")
    with distributed.Client(processes=False, n_workers=1, threads_per_worker=2, dashboard_address=None) as client:
        cluster: dict[str, Any] = {"client": client} if by == "client" else {"address": client.scheduler.address}
        assert study.run(tmp_path / "out", engine="dask", progress=False, **cluster).finished
        assert client.submit(max, 1, 2).result() == 2
    assert exported(tmp_path / "out") == exported(by_threads)


@pytest.mark.parametrize("moment", ["before", "meanwhile"])
def test_reports_a_lost_dask_cluster(moment: str, study: pw.Study, tmp_path: Path) -> None:
    distributed: Any = importlib.import_module("distributed")
    cluster = distributed.LocalCluster(processes=False, n_workers=1, threads_per_worker=1, dashboard_address=None)
    client = distributed.Client(cluster)

    def told(done: int, of: int) -> None:
        if done == 1:
            client.close()

    if moment == "before":
        client.close()
    try:
        with pytest.raises(pw.EngineError, match="the Dask cluster does not answer any more: "):
            study.run(tmp_path / "out", engine="dask", client=client, progress=told)
    finally:
        client.close()
        cluster.close()
    assert study.run(tmp_path / "out", progress=False).finished  # The folder was let go.


@pytest.mark.parametrize("moment", ["before", "meanwhile"])
def test_reports_a_lost_ray_cluster(moment: str, study: pw.Study, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    ray: Any = importlib.import_module("ray")
    monkeypatch.setattr(driven, "LAST_S", 0.5)
    if moment == "before":
        # Whoever has a session may end it at any time.
        monkeypatch.setattr(ray, "is_initialized", lambda: True)
    with pytest.raises(pw.EngineError, match="the Ray cluster does not answer any more: "):
        study.run(tmp_path / "out", engine="ray", progress=lambda done, of: ray.shutdown())
    assert study.run(tmp_path / "out", progress=False).finished  # The folder was let go.


def test_reports_an_unreachable_address_soon(study: pw.Study, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))  # Nobody listens.
        port = taken.getsockname()[1]
        for address in (f"127.0.0.1:{port}", f"ray://127.0.0.1:{port}"):
            with pytest.raises(pw.EngineError, match=f"address: no Ray cluster answers at '{address}': .*refused"):
                study.run(tmp_path / "out", engine="ray", address=address, progress=False)
        monkeypatch.setenv("RAY_ADDRESS", f"127.0.0.1:{port}")
        with pytest.raises(pw.EngineError, match=f"address: no Ray cluster answers at '127.0.0.1:{port}': .*refused"):
            study.run(tmp_path / "out", engine="ray", progress=False)
        with pytest.raises(pw.InputError, match="workers: is for workers that are begun here"):
            study.run(tmp_path / "out", engine="ray", workers=2, progress=False)
    with pytest.raises(pw.EngineError, match="address: no Ray cluster answers at 'here:there': "):
        study.run(tmp_path / "out", engine="ray", address="here:there", progress=False)


@pytest.mark.parametrize("given", [{"address": "127.0.0.1:6379"}, {"workers": 2}])
def test_rejects_options_that_an_existing_ray_session_ignores(given: dict[str, Any], study: pw.Study, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(importlib.import_module("ray"), "is_initialized", lambda: True)
    with pytest.raises(pw.InputError, match=f"{next(iter(given))}: this process has a Ray session already"):
        study.run(tmp_path / "out", engine="ray", progress=False, **given)


def test_an_engine_that_is_not_installed_is_named(study: pw.Study, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for engine, package in (("dask", "distributed"), ("ray", "ray")):
        monkeypatch.setitem(sys.modules, package, None)
        with pytest.raises(pw.MissingError, match=rf"pip install 'pyplatewash\[{engine}\]'") as caught:
            study.run(tmp_path / "out", engine=engine, progress=False)  # type: ignore[arg-type]  # pyright: ignore[reportArgumentType]
        assert caught.value.name == package
    assert study.run(tmp_path / "out", progress=False).finished  # The folder was let go.


def test_reports_a_dask_cluster_that_does_not_start(study: pw.Study, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def unguarded(**_: Any) -> None:
        raise RuntimeError("Nanny failed to start.")

    monkeypatch.setattr(importlib.import_module("distributed"), "LocalCluster", unguarded)
    with pytest.raises(pw.EngineError, match="no Dask cluster begins on this machine: Nanny failed to start.; .* if __name__ == '__main__':"):
        study.run(tmp_path / "out", engine="dask", workers=1, progress=False)


def test_workers_of_another_version_are_refused(study: pw.Study, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(runs, "__version__", "0.0.0")
    with pytest.raises(pw.EngineError, match=r"a worker has pyplatewash .*, and the study was sent by 0\.0\.0"):
        study.run(tmp_path / "out", engine="processes", workers=1, progress=False)


def test_a_missing_study_raises_file_not_found(tmp_path: Path) -> None:
    for place in (tmp_path / "none.toml", tmp_path):
        with pytest.raises(FileNotFoundError) as caught:
            pw.Study.load(place)
        assert isinstance(caught.value, pw.StudyError) and str(tmp_path) in str(caught.value)


def test_rejects_incompatible_arguments(study: pw.Study, tmp_path: Path) -> None:
    wrong: list[tuple[dict[str, Any], str]] = [
        ({"address": "tcp://nowhere:1"}, "address: is of a cluster"),
        ({"engine": "dask", "client": 3}, "client: a distributed.Client is needed"),
        ({"engine": "dask", "address": ""}, "address: the address of a cluster is needed; found ''"),
        ({"engine": "ray", "address": " "}, "address: the address of a cluster is needed; found ' '"),
        ({"engine": "dask", "address": "tcp://127.0.0.1:1", "workers": 2}, "workers: is for workers that are begun here; a cluster that is there"),
        ({"engine": "ray", "address": "127.0.0.1:1", "workers": 2}, "workers: is for workers that are begun here; a cluster that is there"),
        ({"progress": 3}, "progress: True, False or a function"),
        ({"workers": 0}, "workers: an integer from 1"),
        ({"engine": "mpi"}, "engine: "),
    ]
    for arguments, words in wrong:
        with pytest.raises(pw.PlatewashError, match=words):
            study.run(tmp_path / "none", **arguments)
    assert not (tmp_path / "none").exists()


def test_rejects_unordered_and_endless_values() -> None:
    wrong: list[tuple[Any, str]] = [
        ({"tool.length_m": {0.1, 0.2}}, r"axes\[tool.length_m\]: a list of values is needed; found a value of type (set|dict)"),
        ({"tool.length_m": frozenset({0.1})}, r"axes\[tool.length_m\]: a list of values is needed; found a value of type frozenset"),
        ({"tool.length_m": {0.1: 1}}, r"axes\[tool.length_m\]: a list of values is needed; found a value of type (set|dict)"),
        ({"seed": range(10**30)}, r"axes\[seed\]: a range of seeds up to 2⁵³ − 1 is needed; found a value of type range"),
        ({"seed": range(0, 10**30, 2)}, r"axes\[seed\]: a range of seeds"),
        ({"seed": range(2**60, 2**60 + 2)}, "seeds: .*9007199254740991"),
        ({"seed": range(-3, 3)}, "seeds: must be"),
    ]
    for axes, words in wrong:
        with pytest.raises(pw.PlatewashError, match=words):
            pw.Study("kitchen", axes)


def test_an_empty_path_is_not_the_working_folder(study: pw.Study) -> None:
    for call in (study.run, pw.StudyRows, pw.Study.load):
        with pytest.raises(pw.InputError, match=r"(out|folder|path): a path is needed; found ''"):
            call("")


@pytest.mark.parametrize("engine", ["threads", "processes"])
def test_no_more_workers_begin_than_there_are_rows(engine: Any, study: pw.Study, tmp_path: Path) -> None:
    assert study.run(tmp_path / "out", engine=engine, workers=65536, progress=False).finished


@pytest.mark.parametrize("engine", ["processes", "dask", "ray"])
def test_a_row_that_kills_its_workers_is_recorded(engine: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    study = pw.Study("kitchen", {"seed": range(1, 41)})
    monkeypatch.setattr(processes, "BEGIN", processes.BEGIN.replace(processes.__name__, "study_killers"))
    monkeypatch.setattr(importlib.import_module("pyplatewash._studies.engines.dask"), "_packed", study_killers.packed)
    monkeypatch.setattr(importlib.import_module("pyplatewash._studies.engines.ray"), "work", study_killers.work)
    if engine == "ray":
        ray: Any = importlib.import_module("ray")
        ray.cloudpickle.register_pickle_by_value(study_killers)
    journal = _core.StudyJournal(tmp_path / "out", study)
    runs.by_engine(study, journal, engine, 2, None, None, lambda done, of: None, is_empty=True)
    assert journal.finish()
    journal.close()
    rows = [json.loads(line) for line in exported(tmp_path / "out").splitlines()]
    assert [row["index"] for row in rows] == list(range(40))
    crashed = [row for row in rows if row["outcome"] == "crashed"]
    assert [row["index"] for row in crashed] == [study_killers.DEADLY]
    assert "died twice" in crashed[0]["reason"]


def test_reports_workers_that_cannot_start_without_blaming_rows(study: pw.Study, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for begin, executable, words in (
        ("import sys; sys.exit(7)", sys.executable, "ended 3 times before it was ready, with 7"),
        ("print('hello')", sys.executable, "ended 3 times before it was ready"),
        ("", str(tmp_path / "none"), "none': No such file"),
    ):
        monkeypatch.setattr(processes, "BEGIN", begin)
        monkeypatch.setattr(sys, "executable", executable)
        with pytest.raises(pw.EngineError, match=f"no worker process begins: '.*{words}"):
            study.run(tmp_path / "out", engine="processes", workers=2, progress=False)
    assert not (tmp_path / "out" / "rows.jsonl").read_bytes()


@pytest.mark.parametrize("engine", ["dask", "ray"])
def test_reports_packages_that_workers_of_a_cluster_lack(engine: Any, study: pw.Study, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    name = {"dask": "_packed", "ray": "work"}[engine]
    monkeypatch.setattr(importlib.import_module(f"pyplatewash._studies.engines.{engine}"), name, study_killers.lacking)
    if engine == "ray":
        ray: Any = importlib.import_module("ray")
        ray.cloudpickle.register_pickle_by_value(study_killers)
    with pytest.raises(pw.EngineError, match="(?is)gave a share back: .*No module named 'pyplatewash.none'"):
        study.run(tmp_path / "out", engine=engine, workers=1, progress=False)


class Fake:
    """An engine on threads: ``fate`` says what becomes of a share."""

    def __init__(self, study: pw.Study, fate: Callable[[Share], list[int]], slots: int = 3, depth: int = 2, blames_exactly: bool = True) -> None:
        self.depth, self.blames_exactly = depth, blames_exactly
        self._worker, self._fate, self._slots = _core.StudyWorker(study._parts()), fate, slots
        self.shares: list[Share] = []
        self.flying, self.at_once = 0, list[int]()
        self._lock = threading.Lock()

    def slots(self) -> int:
        return self._slots

    def send(self, share: Share) -> Any:
        future: Future[list[int]] = Future()
        with self._lock:
            self.shares.append(share)
            self.flying += 1
            self.at_once.append(self.flying)

        def end() -> None:
            try:
                answer = self._fate(share)
            except BaseException as error:
                self._left()
                future.set_exception(error)
            else:
                self._left()
                future.set_result(answer)

        threading.Timer(0.001, end).start()
        return future

    def _left(self) -> None:
        with self._lock:
            self.flying -= 1

    def rows(self, answer: Any) -> list[Made]:
        made = [self._worker.unplanned(index) for index in answer.result()]
        return [one for one in made if one is not None]

    def stop(self) -> None: ...

    def close(self) -> None: ...


@pytest.mark.parametrize("exactly", [True, False])
def test_a_failing_row_is_recorded_alone(exactly: bool, tmp_path: Path) -> None:
    study = pw.Study("kitchen", {"seed": range(1, 301)})

    def fate(share: Share) -> list[int]:
        if 77 in share.indices:
            raise Died
        return list(share.indices)

    engine = Fake(study, fate, blames_exactly=exactly)
    journal = _core.StudyJournal(tmp_path, study)
    driven.drive(engine, journal, 300, lambda done, of: None)
    assert journal.done == 300
    with_it = [share.indices for share in engine.shares if 77 in share.indices]
    assert with_it[-2:] == [(77,), (77,)] and len(with_it[0]) > 1
    assert max(engine.at_once) <= 6
    if not exactly:
        # Each row of the share that came to grief was by itself, and nobody else at work.
        sent = list(zip((share.indices for share in engine.shares), engine.at_once, strict=True))
        assert all(at_once == 1 for indices, at_once in sent if indices in {(index,) for index in with_it[0]})


def test_sends_undone_rows_again_and_none_twice(tmp_path: Path) -> None:
    study = pw.Study("kitchen", {"seed": range(1, 501)})
    dice = random.Random(3)
    engine = Fake(study, lambda share: list(share.indices[: dice.randint(0, len(share.indices))]))
    journal = _core.StudyJournal(tmp_path, study)
    driven.drive(engine, journal, 500, lambda done, of: None)
    lines = (tmp_path / "rows.jsonl").read_text().splitlines()
    assert sorted(json.loads(line)["index"] for line in lines) == list(range(500))


def test_an_error_keeps_finished_rows(tmp_path: Path) -> None:
    study = pw.Study("kitchen", {"seed": range(1, 501)})
    count = iter(range(1000))

    def fate(share: Share) -> list[int]:
        if next(count) > 5:
            raise pw.EngineError("the cluster is gone")
        return list(share.indices)

    journal = _core.StudyJournal(tmp_path, study)
    with pytest.raises(pw.EngineError, match="gone"):
        driven.drive(Fake(study, fate), journal, 500, lambda done, of: None)
    assert 0 < journal.done < 500


def test_waits_for_a_cluster_without_workers_and_says_so(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(driven, "LACKING_S", 0.5)
    study = pw.Study("kitchen", {"seed": range(1, 4)})
    come = threading.Event()

    def fate(share: Share) -> list[int]:
        come.wait(20.0)
        return list(share.indices)

    journal = _core.StudyJournal(tmp_path, study)
    threading.Timer(2.0, come.set).start()
    with pytest.warns(RuntimeWarning, match="study: the cluster has no workers; they are waited for") as said:
        driven.drive(Fake(study, fate, slots=0), journal, 3, lambda done, of: None)
    assert len(said) == 1 and journal.done == 3


def test_shares_of_rows_adapt_to_their_duration() -> None:
    rows = iter(range(200))
    shares = driven.Shares(lambda most: [next(rows) for _ in range(most)], 200)
    first = shares.next(2)
    assert first is not None and first.indices == (0,)
    shares.took(1, 0.1, ())
    sizes = []
    while shares.left and (share := shares.next(2)) is not None:
        sizes.append(len(share.indices))
    assert sizes[:2] == [20, 20] and sizes[-3:] == [1, 1, 1] and sizes == sorted(sizes, reverse=True) and sum(sizes) == 199
    shares.took(1, 0.1, (7, 8))
    again = shares.next(2)
    assert shares.left == 1 and again is not None and again.indices == (7,)


INTERRUPTED = """
import os, signal, sys, threading
import pyplatewash as pw

study = pw.Study("kitchen", {"seed": range(1, 10001)})
engine, at = sys.argv[1], []

def told(done, rows):
    at.append(done)
    if done >= 3 and (len(at) == 1 or at[-2] < 3):
        os.kill(os.getpid(), signal.SIGINT)

try:
    study.run("out", engine=engine, workers=2, progress=told)
except KeyboardInterrupt:
    pass
journal = pw._core.StudyJournal("out", study)
open("done.txt", "w").write(str(journal.done))
"""


@no_sigint
@pytest.mark.parametrize("engine", ["threads", *ENGINES])
def test_ctrl_c_ends_all_workers_and_lets_the_folder_go(engine: str, tmp_path: Path) -> None:
    line = [sys.executable, "-c", INTERRUPTED, engine]
    done = subprocess.run(line, cwd=tmp_path, capture_output=True, text=True, timeout=600, check=False, preexec_fn=heed_ctrl_c)
    assert done.returncode == 0, done.stderr
    assert 3 <= int((tmp_path / "done.txt").read_text()) < 60, done.stderr


def children(of: int) -> Iterator[int]:
    """The worker processes below a process."""
    for place in Path("/proc").iterdir():
        if place.name.isdigit():
            try:
                stat = (place / "stat").read_text().rsplit(")", 1)[1].split()
            except OSError:
                continue
            if int(stat[1]) == of:
                yield int(place.name)


@pytest.mark.skipif(sys.platform != "linux", reason="looks for processes in /proc")
def test_kills_at_random_moments_lose_no_row(plate: Path, tmp_path: Path) -> None:
    """SIGKILL of the program and of single workers. More of them, by hand: ``PLATEWASH_KILLS=20,400 python -m pytest -k kills_at_random``."""
    count, rows = map(int, os.environ.get("PLATEWASH_KILLS", "3,24").split(","))
    kills(plate, tmp_path, count, rows)


def kills(plate: Path, folder: Path, count: int, rows: int) -> None:
    """So many kills; in the end the rows of an undisturbed run."""
    dice = random.Random(count)
    out = folder / "out"
    text = f"import pyplatewash as pw\nstudy = pw.Study({str(plate)!r}, {{'seed': range(1, {rows + 1})}})\nstudy.run({str(out)!r}, engine='processes', workers=2, progress=False)"
    program: subprocess.Popen[bytes] | None = None
    kept = 0
    for k in range(count):
        if program is None or program.poll() is not None:
            program = subprocess.Popen([sys.executable, "-c", text])
        while program.poll() is None and lines(out) < kept + 2:
            time.sleep(0.01)
        time.sleep(dice.random() * 0.3)
        workers = list(children(program.pid))
        victim = program.pid if k % 3 == 0 or not workers else dice.choice(workers)
        try:
            os.kill(victim, signal.SIGKILL)
        except ProcessLookupError:
            pass
        if victim == program.pid:
            program.wait()
        kept = lines(out)
    assert program is not None
    program.wait()
    assert kept < rows, "the kills came too late to matter"
    study = pw.Study(plate, {"seed": range(1, rows + 1)})
    study.run(out, progress=False)
    study.run(folder / "whole", workers=1, progress=False)
    assert exported(out) == exported(folder / "whole")


def lines(folder: Path) -> int:
    file = folder / "rows.jsonl"
    return file.read_bytes().count(b"\n") if file.exists() else 0
