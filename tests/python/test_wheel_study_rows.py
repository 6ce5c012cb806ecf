"""Rows of studies, read: what comes out of a folder is what is in it, whichever way it is taken out."""

import hashlib
import json
import math
import os
import re
import secrets
import subprocess
import sys
import tracemalloc
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd  # type: ignore[import-untyped]
import pyarrow.parquet as pq  # type: ignore[import-untyped]
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from matplotlib.axes import Axes
from matplotlib.colors import to_hex

import pyplatewash as pw
from pyplatewash import _figures as palette
from pyplatewash import _core
from pyplatewash._studies import table as tables
from study_folders import folder, line, row

AXES = ("plate[0].at_m", "robot.model", "tool.length_m")
STUDY = """
format = "platewash-study/1"
name = "two tools"
scenario = ["base.toml", "kitchen"]
[[axis]]
key = "tool.length_m"
values = [0.12, 0.15]
[[axis]]
key = "layout.positions_m"
values = [[[0.3, 0.0]], [[0.9, 0.0]]]
[[axis]]
key = "seed"
seeds = "4..4"
"""


def mixed() -> list[dict[str, Any]]:
    """Rows of every outcome, with each field null in some."""
    at = [[0.3, 0.1 * k, 0.03] for k in range(7)]
    axes: list[dict[str, Any]] = [{"plate[0].at_m": place, "robot.model": "irb120", "tool.length_m": 0.1 + 0.01 * k} for k, place in enumerate(at)]
    pair, hash_ = ["handle", "link_4"], 64 * "a"
    broken = {"requirement": "contact_dose", "plate": 0, "segment": 2, "waypoint": None, "time_s": 1.5, "point_m": [0.1, 0.2, 0.03]}
    plate = {"requirement": None, "plate": 3, "segment": None, "waypoint": None, "time_s": None, "point_m": [0.4, 0.5, 0.03]}
    return [
        row(0, axes[0], duration_s=8.5, swept=0.998, pressed=0.999, clearance_m=0.0191, clearance_pair=pair, plan=hash_),
        row(1, axes[1], "not_proved", reason="contact dose", place=broken, duration_s=9.0, swept=1.0, clearance_m=0.02, clearance_pair=pair, plan=hash_),
        row(2, axes[2], "infeasible", reason="out of reach,\n„weit“ weg", place=plate),
        row(3, axes[3], "not_found", reason="no way was found"),
        row(4, axes[4], "error", reason="the values state no job"),
        row(5, axes[5], "crashed", reason="the program failed"),
        row(6, axes[6], duration_s=9.5, swept=0.999, clearance_m=0.0111, clearance_pair=["base_link", "sponge"], plan=hash_),
    ]


@pytest.fixture
def rows(tmp_path: Path) -> pw.StudyRows:
    """All rows of a study, in the order in which they were done."""
    done = mixed()
    return pw.StudyRows(folder(tmp_path / "study", AXES, [done[k] for k in (3, 0, 6, 1, 2, 5, 4)], 7))


@pytest.fixture(scope="module")
def real(tmp_path_factory: pytest.TempPathFactory) -> pw.StudyRows:
    """A study as the command makes it: two tools on a plate that they wash, and on one out of reach."""
    at = tmp_path_factory.mktemp("real")
    (at / "base.toml").write_text(pw.Scenario.load("kitchen").replace(layout={"region": None, "positions_m": [[0.3, 0.0]]}).to_toml())
    (at / "study.toml").write_text(STUDY)
    done = command("run", at / "study.toml", "--out", at / "out", "--quiet")
    assert done.returncode == 0, done.stderr
    return pw.StudyRows(at / "out")


def command(*arguments: str | Path) -> "subprocess.CompletedProcess[str]":
    line_ = [sys.executable, "-m", "pyplatewash", "study", *map(str, arguments)]
    return subprocess.run(line_, capture_output=True, text=True, encoding="utf-8", check=False)


# Rows.


def test_rows_come_in_the_order_of_their_indices(rows: pw.StudyRows) -> None:
    assert list(rows) == mixed() and list(rows) == mixed()
    assert (rows.done, rows.rows, len(rows), rows.finished, rows.axes) == (7, 7, 7, True, list(AXES))
    assert rows.row(2) == mixed()[2] and rows.row(np.int64(0)) == mixed()[0]  # type: ignore[arg-type]
    assert repr(rows) == f"StudyRows({str(rows.folder)!r}, 7 of 7 rows)"
    with pytest.raises(pw.InputError, match="index: an integer from 0 to 6 is needed; found 7"):
        rows.row(7)


def test_a_study_under_way_is_read_up_to_its_last_whole_line(tmp_path: Path) -> None:
    rows = pw.StudyRows(folder(tmp_path / "s", AXES, mixed()[:3:2], 7, torn=line(mixed()[1])[:-1]))
    assert [one["index"] for one in rows] == [0, 2] and not rows.finished
    with pytest.raises(KeyError, match="row 1 .* is not done yet"):
        rows.row(1)
    with open(rows.folder / "rows.jsonl", "ab") as journal:
        journal.write(b"\n" + line(mixed()[3]))
    assert rows.done == 2 and [one["index"] for one in rows] == [0, 2]  # As they were.
    assert [one["index"] for one in pw.StudyRows(rows.folder)] == [0, 1, 2, 3]
    none = pw.StudyRows(folder(tmp_path / "none", AXES, (), 7))
    assert list(none) == [] and len(none.to_frame()) == 0
    assert none.to_frame().dtypes.to_dict() == rows.to_frame().dtypes.to_dict()


DAMAGED = {
    b"{}\n": "is no row: missing field `schema`",
    line(mixed()[1])[:200] + b"\n": "is no row: ",
    line(mixed()[1]).replace(b'"schema":2', b'"schema":1'): "is a row of schema 1; this program reads schema 2",
    line(row(7, {})): "row 7 is none of 7, counted from 0",
    line(mixed()[0]): "row 0 is there before",
    line(mixed()[1] | {"outcome": "fine"}): "is no row: unknown variant `fine`",
    line(mixed()[1] | {"place": None}): "is no row: invalid type: null",
    line(mixed()[1] | {"duration_s": math.nan}): "is no row: ",
    line(mixed()[1] | {"clearance_m": "1"}): 'is no row: invalid type: string "1", expected f64',
    line(mixed()[1] | {"place": {"point_m": [1, "2", 3]}}): 'is no row: invalid type: string "2"',
    line(mixed()[1] | {"place": {"plate": 0.5}}): "is no row: invalid type: floating point `0.5`",
    line(mixed()[1] | {"axes": {"seed": 1}}): "row 1 has other axes than manifest.json states",
    line(mixed()[1] | {"axes": mixed()[1]["axes"] | {"tool.length_m": "long"}}): "row 1 has other axes than manifest.json states",
    line(mixed()[1] | {"axes": mixed()[1]["axes"] | {"plate[0].at_m": [0, 1]}}): "row 1 has other axes than manifest.json states",
    line(mixed()[1] | {"clearance_pair": ["a"]}): "is no row: invalid length 1",
    line(mixed()[1]).replace(b'"index":1', b'"index": 1'): "row 1 is not as it was written",
    b"\xff\xfe\n": "is no row",
}


@pytest.mark.parametrize("damaged", DAMAGED, ids=list(DAMAGED.values()))
def test_names_file_and_number_of_a_damaged_line(damaged: bytes, tmp_path: Path) -> None:
    at = folder(tmp_path / "s", AXES, mixed()[:1], 7, torn=damaged + line(mixed()[2]))
    with pytest.raises(pw.StudyError, match=rf"rows\.jsonl: line 2: {re.escape(DAMAGED[damaged])}") as caught:
        list(pw.StudyRows(at))
    assert (caught.value.line, caught.value.source) == (2, str(at / "rows.jsonl"))


@settings(max_examples=150, derandomize=True, database=None, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(file=st.sampled_from(["rows.jsonl", "manifest.json", "timings.jsonl"]), at=st.integers(0, 5000), cut=st.integers(0, 8), put=st.binary(max_size=8))
def test_a_damaged_folder_is_read_or_refused(file: str, at: int, cut: int, put: bytes, tmp_path: Path) -> None:
    where = tmp_path / secrets.token_hex(4)
    folder(where, AXES, mixed(), 7)
    whole = (where / file).read_bytes()
    at %= len(whole) + 1
    (where / file).write_bytes(whole[:at] + put + whole[at + cut :])
    try:
        rows = pw.StudyRows(where)
        assert len(list(rows)) == len(rows.to_frame()) == rows.summary().done == rows.done
        rows.export(where.with_suffix(".jsonl"), partial=True)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            rows.to_parquet(where.with_suffix(".parquet"), partial=True)
    except pw.StudyError as error:
        # Where rows and manifest differ, nobody knows which of them is damaged.
        assert str(where / file) in str(error) or (file == "manifest.json" and "manifest.json" in str(error))


def test_rejects_folders_without_a_study(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match=r"manifest\.json: cannot be read, so this is not the folder of a study") as caught:
        pw.StudyRows(tmp_path)
    assert isinstance(caught.value, pw.StudyError) and isinstance(caught.value, pw.FileError) and caught.value.errno == 2
    wrong: list[tuple[dict[str, Any], str]] = [
        ({"format": "other/1"}, 'format must be platewash-study-manifest/1; found "other/1"'),
        ({"rows": True}, "is no manifest: .*rows"),
        ({"rows": 0}, "rows must be from 1"),
        ({"axes": [{}]}, "is no manifest: "),
        ({"axes": [{"key": "seed", "count": 7, "kind": "odd"}]}, "is no manifest: .*odd"),
    ]
    for place, (changed, words) in enumerate(wrong):
        with pytest.raises(pw.StudyError, match=words):
            pw.StudyRows(folder(tmp_path / str(place), AXES, (), 7, **changed))
    (tmp_path / "0" / "manifest.json").write_bytes(b"\xff")
    with pytest.raises(pw.StudyError, match=r"manifest\.json: cannot be read, .*UTF-8"):
        pw.StudyRows(tmp_path / "0")
    (folder(tmp_path / "gone", AXES, (), 7) / "rows.jsonl").unlink()
    with pytest.raises(FileNotFoundError, match=r"rows\.jsonl: cannot be read"):
        pw.StudyRows(tmp_path / "gone")


def test_rows_are_read_one_by_one(tmp_path: Path) -> None:
    many = (row(index, {"seed": index}, reason=1000 * "x") for index in range(5000))
    rows = pw.StudyRows(folder(tmp_path / "s", ["seed"], many, 5000))
    tracemalloc.start()
    try:
        assert sum(one["index"] for one in rows) == 5000 * 4999 / 2
        most = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert most < 1_000_000 < rows.folder.joinpath("rows.jsonl").stat().st_size / 5


# Frames and data sets.


def flat(of: dict[str, Any]) -> dict[str, Any]:
    """A row as the columns have it, worked out another way: dictionaries by both names, lists by their places."""
    out: dict[str, Any] = {}

    def put(name: str, value: Any) -> None:
        if isinstance(value, list):
            for place, part in enumerate(value):
                put(f"{name}.{place}", part)
        elif isinstance(value, dict):
            for inner, part in value.items():
                put(inner if name == "axes" else f"{name}.{inner}", part)
        elif value is not None:
            out[name] = value

    for name, value in of.items():
        put(name, value)
    return {name: value for name, value in out.items() if name != "schema"}


def test_a_data_frame_has_every_row(rows: pw.StudyRows) -> None:
    frame = rows.to_frame()
    assert frame.index.tolist() == list(range(7)) and frame.attrs["manifest"] == rows.manifest
    for index, of in enumerate(mixed()):
        there = frame.loc[index].dropna().to_dict()
        took = there.pop("wall_s", None)
        assert there | {"index": index} == flat(of)
        assert took == (None if index == 4 else 0.25 + index)  # The last one is missing after a crash.
    assert str(frame["place.plate"].dtype) == "Int64" and str(frame["duration_s"].dtype) == "float64"
    assert "wall_s" not in rows.to_frame(timings=False).columns
    assert frame.groupby("clearance_pair.0").size().to_dict() == {"handle": 2, "base_link": 1}


def test_a_data_frame_is_built_in_parts(rows: pw.StudyRows, monkeypatch: pytest.MonkeyPatch) -> None:
    whole = rows.to_frame()
    monkeypatch.setattr(tables, "BATCH_ROWS", 2)
    monkeypatch.setattr(tables, "MOST_TEXTS", 3)
    pd.testing.assert_frame_equal(rows.to_frame(), whole)


def test_columns_follow_from_the_axes_and_never_from_what_is_null(rows: pw.StudyRows, tmp_path: Path) -> None:
    bare = [row(k, mixed()[k]["axes"], "error") for k in range(7)]
    nulls = pw.StudyRows(folder(tmp_path / "nulls", AXES, bare, 7))
    assert nulls.to_frame().dtypes.to_dict() == rows.to_frame().dtypes.to_dict()
    for of, name in ((rows, "a.parquet"), (nulls, "b.parquet")):
        of.to_parquet(tmp_path / name)
    assert pq.read_schema(tmp_path / "a.parquet").remove_metadata() == pq.read_schema(tmp_path / "b.parquet").remove_metadata()


def test_axes_of_every_kind_have_columns(tmp_path: Path) -> None:
    several: list[dict[str, Any]] = [
        {"seed": 1, "wash.contact": True, "wash.turns": 3, "wash.pattern": "rings", "layout.plate_knots": [[0.1, 10]], "wash.contact_force_n": [1, 40], "robot.home_deg": "a"},
        {"seed": 2**53 - 1, "wash.contact": False, "wash.turns": 2.5, "wash.pattern": "ß", "layout.plate_knots": [[0.1, 9], [1, 2]], "wash.contact_force_n": [0.5, 1], "robot.home_deg": [0]},
    ]
    kinds = ["whole", "flag", "number", "text", "json", {"numbers": 2}, "json"]
    rows = pw.StudyRows(folder(tmp_path / "s", dict(zip(several[0], kinds, strict=True)), [row(k, axes) for k, axes in enumerate(several)], 2))
    frame = rows.to_frame()
    assert frame["seed"].tolist() == [1, 2**53 - 1] and str(frame["seed"].dtype) == "Int64"
    assert frame["wash.contact"].tolist() == [True, False] and frame["wash.turns"].tolist() == [3.0, 2.5]
    assert frame["layout.plate_knots"].tolist() == ["[[0.1,10]]", "[[0.1,9],[1,2]]"] and frame["wash.pattern"].tolist() == ["rings", "ß"]
    assert frame["wash.contact_force_n.1"].tolist() == [40.0, 1.0] and frame["robot.home_deg"].tolist() == ['"a"', "[0]"]
    rows.to_parquet(tmp_path / "s.parquet")
    assert pq.read_table(tmp_path / "s.parquet").column("seed").to_pylist() == [1, 2**53 - 1]


@pytest.mark.parametrize("name", ["rows.parquet", "rows"])
def test_a_data_set_has_every_row(name: str, rows: pw.StudyRows, tmp_path: Path) -> None:
    (tmp_path / "rows").mkdir()  # An empty one is taken.
    rows.to_parquet(tmp_path / name)
    table = pq.read_table(tmp_path / name)
    for of, there in zip(mixed(), table.to_pylist(), strict=True):
        assert there.pop("wall_s") == (None if of["index"] == 4 else 0.25 + of["index"])
        assert {key: value for key, value in there.items() if value is not None} == flat(of)
    assert json.loads((table.schema.metadata or {})[b"platewash_manifest"]) == rows.manifest
    assert list(table.column_names) == ["index", *rows.to_frame().columns]
    pd.testing.assert_frame_equal(pd.read_parquet(tmp_path / name).set_index("index"), rows.to_frame(), check_dtype=False)
    rows.to_parquet(tmp_path / "again.parquet", timings=False)
    assert "wall_s" not in pq.read_schema(tmp_path / "again.parquet").names


def test_a_data_set_is_written_in_files_and_groups(rows: pw.StudyRows, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tables, "GROUP_ROWS", 2)
    monkeypatch.setattr(tables, "FILE_ROWS", 4)
    rows.to_parquet(tmp_path / "set")
    assert [pq.read_metadata(file).num_rows for file in sorted((tmp_path / "set").iterdir())] == [4, 3]
    assert pq.read_table(tmp_path / "set").column("index").to_pylist() == list(range(7))
    rows.to_parquet(tmp_path / "one.parquet")
    assert pq.read_metadata(tmp_path / "one.parquet").num_row_groups == 4


def test_files_are_written_whole_or_not_at_all(rows: pw.StudyRows, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "full").mkdir()
    (tmp_path / "full" / "mine").touch()
    (tmp_path / "old.parquet").write_text("old")
    before = sorted(tmp_path.iterdir())
    with pytest.raises(OSError, match=r"full: cannot be written"):
        rows.to_parquet(tmp_path / "full")
    with pytest.raises(FileNotFoundError, match="none/a.parquet: cannot be written"):
        rows.to_parquet(tmp_path / "none" / "a.parquet")
    with pytest.raises(pw.FileError, match="cannot be written"):
        rows.export(tmp_path / "full")

    def full(*_: Any) -> Any:
        yield [[None]]
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(tables, "batches", full)
    monkeypatch.setattr(tables, "pyarrow", lambda: (None, None))
    for name in ("old.parquet", "new"):
        with pytest.raises(Exception):
            rows.to_parquet(tmp_path / name)
    assert sorted(tmp_path.iterdir()) == before and (tmp_path / "old.parquet").read_text() == "old"
    assert [file.name for file in (tmp_path / "full").iterdir()] == ["mine"]


def test_writes_unfinished_studies_on_request(tmp_path: Path) -> None:
    rows = pw.StudyRows(folder(tmp_path / "s", AXES, mixed()[:3], 7))
    for write, name in ((rows.export, "a.jsonl"), (rows.to_parquet, "a.parquet")):
        with pytest.raises(pw.StudyError, match="is not finished: 3 of 7 rows; .*partial=True"):
            write(tmp_path / name)
        write(tmp_path / name, partial=True)
    assert (tmp_path / "a.jsonl").read_bytes() == b"".join(map(line, mixed()[:3]))
    assert pq.read_metadata(tmp_path / "a.parquet").num_rows == 3 and len(rows.to_frame()) == 3


def test_reading_writes_nothing_into_the_folder(tmp_path: Path) -> None:
    rows = pw.StudyRows(folder(tmp_path / "s", AXES, mixed(), 7))
    before = {file: file.read_bytes() for file in (tmp_path / "s").iterdir()}
    for write, name in ((rows.export, "rows.jsonl"), (rows.export, "../s/new"), (rows.to_parquet, "manifest.json"), (rows.to_parquet, "a/new.parquet")):
        with pytest.raises(pw.FileError, match="it is in the study's folder, which is kept as it is"):
            write(tmp_path / "s" / name)
    assert {file: file.read_bytes() for file in (tmp_path / "s").iterdir()} == before


def test_a_rows_scenario_needs_no_file_of_its_arm(tmp_path: Path, root: Path) -> None:
    text = (root / "examples" / "studies" / "one-plate.toml").read_text().replace('model = "irb120"', 'urdf = "arm.urdf"')
    (tmp_path / "base.toml").write_text(text)
    arm = tmp_path / "arm.urdf"
    arm.write_bytes((root / "urdf" / "irb120.urdf").read_bytes())
    study = f'format = "platewash-study/1"\nname = "s"\nscenario = "{tmp_path.as_posix()}/base.toml"\n'
    rows = pw.Study.parse(study).run(tmp_path / "out", progress=False)
    arm.unlink()
    assert pw.plan(pw.StudyRows(tmp_path / "out").scenario(0).job()).plan.hash == rows.row(0)["plan"] != None


def test_refuses_rows_that_were_changed(tmp_path: Path) -> None:
    sha256 = hashlib.sha256(b"".join(map(line, mixed()))).hexdigest()
    rows = pw.StudyRows(folder(tmp_path / "good", AXES, reversed(mixed()), 7, rows_sha256=sha256))
    rows.export(tmp_path / "good.jsonl")
    rows.to_parquet(tmp_path / "good.parquet")
    refused = f"the rows were changed since the study was finished: .* states {sha256}"
    changed = [*mixed()[:6], mixed()[6] | {"swept": 1.0}]
    with pytest.raises(pw.StudyError, match=refused):
        pw.StudyRows(folder(tmp_path / "bad", AXES, changed, 7, rows_sha256=sha256))
    (rows.folder / "rows.jsonl").write_bytes((tmp_path / "bad" / "rows.jsonl").read_bytes())
    for write, name in ((rows.export, "bad.jsonl"), (rows.to_parquet, "bad.parquet")):  # Even by who has read them before.
        with pytest.raises(pw.StudyError, match=refused):
            write(tmp_path / name)
        assert not (tmp_path / name).exists()


@pytest.mark.parametrize("wrong", ["--1", "1e999", "nan", "-1.0", "1e400", "1."])
def test_names_the_line_of_an_invalid_timing(wrong: str, tmp_path: Path) -> None:
    at = folder(tmp_path / "s", AXES, mixed(), 7)
    (at / "timings.jsonl").write_text(f'{{"index":0,"wall_s":1.5e-7}}\n{{"index":1,"wall_s":{wrong}}}\n')
    with pytest.raises(pw.StudyError, match=r"timings\.jsonl: line 2: is no timing"):
        pw.StudyRows(at).to_frame()


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no FIFO on this system")
def test_never_replaces_what_is_no_file(rows: pw.StudyRows, tmp_path: Path) -> None:
    place = tmp_path / "pipe.parquet"
    os.mkfifo(place)
    for write in (rows.export, rows.to_parquet):
        with pytest.raises(pw.FileError, match=r"pipe\.parquet: cannot be written: it is no regular file"):
            write(place)
    assert place.is_fifo()


# The command's, and what a row is made of.


def test_export_and_summary_equal_those_of_the_command(real: pw.StudyRows, tmp_path: Path) -> None:
    assert real.finished and real.done == 8
    real.export(tmp_path / "rows.jsonl")
    assert (tmp_path / "rows.jsonl").read_text(encoding="utf-8") == command("export", real.folder).stdout
    assert real.summary().to_dict() == json.loads(command("show", real.folder, "--json").stdout)
    assert set(real.summary().outcomes) > {"proved"}
    said = real._repr_html_()
    assert "two tools: 8 of 8 rows" in said and "tool.length_m" in said


def test_the_scenario_of_a_row_equals_that_of_the_command(real: pw.StudyRows) -> None:
    study = real.folder.parent / "study.toml"
    for index in (0, 3, 5):
        said = pw.Scenario.parse(command("scenario", study, "--row", str(index)).stdout)
        assert real.scenario(index).to_dict() == said.to_dict()
    proved = next(one for one in real if one["outcome"] == "proved" and one["scenario"] == "base.toml")
    assert pw.plan(real.scenario(proved["index"]).job()).plan.hash == proved["plan"]


def test_a_rows_scenario_needs_the_folder_alone(tmp_path: Path) -> None:
    kitchen = pw.Scenario.load("kitchen").replace(seed=4)
    study = pw.Study(kitchen, rows=[{"tool.length_m": 0.14}], name="own")
    rows = study.run(tmp_path / "out", progress=False)
    assert rows.scenario(0).to_dict() == kitchen.replace(tool={"length_m": 0.14}).to_dict() == study.scenario(0).to_dict()
    assert pw.Study.load(tmp_path / "out") == study
    parts = tmp_path / "out" / "study.json"
    text = parts.read_text(encoding="utf-8")
    parts.write_text(text.replace("seed = 4", "seed = 5"), encoding="utf-8")
    with pytest.raises(pw.StudyError, match="study.json: is not the study that the manifest is of: the study file"):
        rows.scenario(0)
    parts.unlink()
    with pytest.raises(FileNotFoundError, match="study.json"):
        rows.scenario(0)
    with pytest.raises(pw.NoKeyError, match="row 1 of"):
        pw.StudyRows(folder(tmp_path / "s", ["seed"], [row(0, {"seed": 1})], 2)).scenario(1)


def test_returns_a_plan_where_the_study_keeps_it(tmp_path: Path) -> None:
    plan = pw.plan(pw.Scenario.load("kitchen").job()).plan
    proved = [row(seed, {"seed": seed}, plan=plan.hash) for seed in range(2)]
    rows = pw.StudyRows(folder(tmp_path / "s", ["seed"], [*proved, row(2, {"seed": 2}, "error"), row(3, {"seed": 3}, plan=64 * "a")], 4))
    plans = rows.folder / "plans"
    plans.mkdir()
    for index in (0, 2, 3):
        plan.save(plans / f"{index}.json")
    assert rows.plan(0) == plan
    with pytest.raises(KeyError, match="there is no plan of row 1 .*: the study does not keep it"):
        rows.plan(1)
    with pytest.raises(pw.StudyError, match=f"3.json: is not the plan of row 3, whose hash is aaa.*; found {plan.hash}"):
        rows.plan(3)
    with pytest.raises(pw.StudyError, match="2.json: is not the plan of row 2, whose hash is None"):
        rows.plan(2)
    (plans / "2.json").unlink()
    with pytest.raises(KeyError, match="there is no plan of row 2 .*: it has none"):
        rows.plan(2)
    other = json.loads((plans / "0.json").read_text())
    other["order"].reverse()
    (plans / "0.json").write_text(json.dumps(other))
    with pytest.raises(pw.StudyError, match="is not the plan of row 0, whose hash is .*; found this one over other contents"):
        rows.plan(0)


# Maps.


def table(tmp_path: Path) -> pw.StudyRows:
    """Two tools at a grid of 3 by 3 places, of which one is left out."""
    done, index = [], 0
    for length in (0.2, 0.1):
        for x in (0.2, 0.3, 0.4):
            for y in (-0.1, 0.0, 0.1):
                if (x, y) == (0.2, 0.0):
                    continue
                proved = length == 0.2 or x > 0.3
                fields = {"clearance_m": x / 10 + length / 100, "duration_s": 10 * length, "swept": 0.99 + y / 100} if proved else {}
                outcome = "proved" if proved else "not_found" if y < 0.05 else "infeasible"
                done.append(row(index, {"plate[0].at_m": [x, y, 0.03], "tool.length_m": length}, outcome, **fields))
                index += 1
    return pw.StudyRows(folder(tmp_path / "table", ["tool.length_m", "plate[0].at_m"], done, len(done)))


def pictured(ax: Axes, x: float, y: float) -> list[Any]:
    """What the images of an axes have at a place: their values, where they have one."""
    found = []
    for image in ax.images:
        left, right, bottom, top = image.get_extent()
        values: Any = np.ma.asarray(image.get_array())
        tall, wide = values.shape[:2]
        value = values[math.floor((y - bottom) / (top - bottom) * tall), math.floor((x - left) / (right - left) * wide)]
        if value is not np.ma.masked:
            found.append((float(value), to_hex(tuple(image.get_cmap()(image.norm(value))))))
    return found


def labels(ax: Axes) -> set[str]:
    return {text.get_text() for legend in ax.figure.legends for text in legend.get_texts()}


def test_a_map_shows_the_results_of_rows(tmp_path: Path) -> None:
    rows = table(tmp_path)
    ax = rows.map("plate[0].at_m")
    assert isinstance(ax, Axes) and (ax.get_xlabel(), ax.get_ylabel()) == ("x [m]", "y [m]")
    assert [pictured(ax, x, y)[0][0] for x, y in ((0.2, 0.1), (0.3, 0.0), (0.4, 0.1))] == [50.0, 50.0, 100.0]
    assert pictured(ax, 0.2, 0.0) == []  # No row.
    ax = rows.map("plate[0].at_m", "clearance")
    assert isinstance(ax, Axes)
    assert pictured(ax, 0.4, 0.0)[0][0] == pytest.approx(41.0) and pictured(ax, 0.3, 0.0)[0][0] == pytest.approx(32.0)
    ax = rows.map("plate[0].at_m", "duration")
    assert isinstance(ax, Axes)
    assert pictured(ax, 0.4, 0.0)[0][0] == pytest.approx(1.5) and pictured(ax, 0.3, 0.0)[0][0] == pytest.approx(2.0)
    ax = rows.map("plate[0].at_m", "swept")
    assert isinstance(ax, Axes) and pictured(ax, 0.4, -0.1)[0][0] == pytest.approx(98.9)
    assert ax.images[0].get_extent() == pytest.approx((0.15, 0.45, -0.15, 0.15))  # Squares about their places; y grows upwards.


def test_maps_of_axes_share_a_scale_and_stand_in_the_studys_order(tmp_path: Path) -> None:
    axes = table(tmp_path).map("plate[0].at_m", "clearance", by="tool.length_m")
    assert isinstance(axes, list)
    assert [ax.get_title() for ax in axes] == ["tool.length 0.2 m", "tool.length 0.1 m"]
    assert [(ax.images[0].norm.vmin, ax.images[0].norm.vmax) for ax in axes] == 2 * [pytest.approx((22.0, 42.0))]
    assert pictured(axes[1], 0.3, 0.0) == [(0.0, palette.NOTHING)] and labels(axes[1]) == {"nothing proved"}
    both = pw.StudyRows(tmp_path / "table").map("plate[0].at_m", by=["scenario", "tool.length_m"])
    assert isinstance(both, list) and both[1].get_title() == "scenario kitchen\ntool.length 0.1 m"


def test_distinguishes_not_found_from_impossible(tmp_path: Path) -> None:
    rows = table(tmp_path)
    short = rows.map("plate[0].at_m", "outcome", by=["tool.length_m"])
    assert isinstance(short, list)
    colours = {place: pictured(short[1], *place)[0][1] for place in ((0.3, 0.0), (0.3, 0.1), (0.4, 0.0))}
    assert colours == {(0.3, 0.0): palette.OUTCOMES["not_found"], (0.3, 0.1): palette.OUTCOMES["infeasible"], (0.4, 0.0): palette.OUTCOMES["proved"]}
    assert labels(short[1]) == {"proved", "no way found: there may be one", "infeasible: known to be"}
    whole = rows.map("plate[0].at_m", "outcome")
    assert isinstance(whole, Axes) and pictured(whole, 0.3, 0.0)[0][1] == palette.SEVERAL
    assert len(set(palette.OUTCOMES.values()) | {palette.SEVERAL, palette.NOTHING}) == 8


def test_a_region_is_where_plates_are_drawn(tmp_path: Path) -> None:
    ax = table(tmp_path).map("plate[0].at_m", region="kitchen")
    assert isinstance(ax, Axes) and labels(ax) >= {"base", "region of plate centres", "no plate centre within 280 mm"}
    # Plates are drawn about the foot of the mount, along the world's axes.
    moved = pw.Scenario.load("kitchen").replace(robot={"mount_m": [1, 2, 0], "mount_rpy_deg": [0, 0, 90]})
    ax = pw.StudyRows(tmp_path / "table").map("plate[0].at_m", region=moved)
    assert isinstance(ax, Axes)
    corners: Any = next(patch for patch in ax.patches if patch.get_label() == "region of plate centres").get_path().vertices
    drawn = np.array([(plate.x_m, plate.y_m) for seed in range(1, 31) for plate in pw.place_plates(moved.replace(seed=seed)).plates])
    assert corners.min(axis=0).tolist() == pytest.approx([1.0, 1.62]) and corners.max(axis=0).tolist() == pytest.approx([1.3, 2.38])
    assert (corners.min(axis=0) <= drawn.min(axis=0)).all() and (drawn.max(axis=0) <= corners.max(axis=0)).all()
    assert (drawn.min(axis=0) < corners.min(axis=0) + 0.1).all()


def test_positions_off_a_grid_are_dots(tmp_path: Path) -> None:
    rng = np.random.default_rng(3)
    done = [row(k, {"plate[0].at_m": [*place, 0.03]}, clearance_m=0.01) for k, place in enumerate(rng.uniform(0, 1, (20, 2)).tolist())]
    ax = pw.StudyRows(folder(tmp_path / "s", ["plate[0].at_m"], done, 20)).map("plate[0].at_m", "clearance")
    assert isinstance(ax, Axes) and not ax.images and np.shape(ax.collections[0].get_offsets()) == (20, 2)
    ax.figure.canvas.draw()


def test_maps_report_errors(tmp_path: Path, rows: pw.StudyRows) -> None:
    with pytest.raises(pw.InputError, match='at: one of "plate.0..at_m", "robot.model", "tool.length_m" is needed; found .seed.'):
        rows.map("seed")
    with pytest.raises(pw.InputError, match="at: an axis of places is needed, .* tool.length_m, whose value in row 0 is 0.1"):
        rows.map("tool.length_m")
    with pytest.raises(pw.InputError, match='by: one of "scenario", "robot.model", "tool.length_m" is needed'):
        rows.map("plate[0].at_m", by="plate[0].at_m")
    with pytest.raises(pw.InputError, match="by: different axes are needed"):
        rows.map("plate[0].at_m", by=["scenario", "scenario"])
    with pytest.raises(pw.InputError, match='value: one of "washable", "clearance", "swept", "duration", "outcome" is needed; found .speed.'):
        rows.map("plate[0].at_m", "speed")  # type: ignore[arg-type]  # pyright: ignore[reportArgumentType]
    none = pw.StudyRows(folder(tmp_path / "none", AXES, (), 7))
    with pytest.raises(pw.InputError, match="rows to draw are needed"):
        none.map("plate[0].at_m")
    many = pw.StudyRows(folder(tmp_path / "many", {"plate[0].at_m": {"numbers": 2}, "seed": "whole"}, [row(k, {"plate[0].at_m": [0, 0], "seed": k}) for k in range(65)], 65))
    with pytest.raises(pw.InputError, match="by: axes with at most 64 combinations"):
        many.map("plate[0].at_m", by=["seed"])


# What is missing.


@pytest.mark.parametrize(("name", "ask"), [("pandas", "to_frame"), ("pyarrow", "to_parquet"), ("matplotlib", "map")])
def test_without_a_package_the_message_says_how_to_get_it(name: str, ask: str, rows: pw.StudyRows, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "matplotlib.pyplot" if name == "matplotlib" else name, None)
    arguments = {"to_frame": (), "to_parquet": (tmp_path / "a.parquet",), "map": ("plate[0].at_m",)}[ask]
    with pytest.raises(ImportError, match=r"pip install 'pyplatewash\[(study|viz)\]'") as caught:
        getattr(rows, ask)(*arguments)
    assert isinstance(caught.value, pw.MissingError) and caught.value.name == name
    assert not os.path.exists(tmp_path / "a.parquet")


def test_reading_needs_no_optional_package(rows: pw.StudyRows) -> None:
    code = "import sys, pyplatewash as pw; list(pw.StudyRows(sys.argv[1])); print({'pandas', 'pyarrow', 'scipy', 'matplotlib'} & set(sys.modules))"
    done = subprocess.run([sys.executable, "-c", code, rows.folder], capture_output=True, text=True, check=True)
    assert done.stdout == "set()\n"


# What is shipped, and what the pages say.


def test_shipped_studies_are_valid(root: Path, tmp_path: Path) -> None:
    studies = root / "examples" / "studies"
    (tmp_path / "tools.py").write_bytes((studies / "tools.py").read_bytes())
    subprocess.run([sys.executable, tmp_path / "tools.py"], check=True)
    assert (tmp_path / "tools.toml").read_bytes() == (studies / "tools.toml").read_bytes()
    for name, last in (("tools.toml", 3671), ("tools-four-plates.toml", 719)):
        assert command("scenario", studies / name, "--row", str(last)).returncode == 0
        assert command("scenario", studies / name, "--row", str(last + 1)).returncode == 2
    one = pw.Scenario.load(studies / "one-plate.toml").to_dict()
    kitchen = pw.Scenario.load("kitchen").to_dict()
    assert {key for key in kitchen if kitchen[key] != one[key]} == {"name", "layout"} and len(one["plate"]) == 1


def test_the_pages_blocks_run(root: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    # As if it had been planned.
    tools = {"tool.length_m": 0.15, "tool.radius_m": 0.02, "tool.sponge_radius_m": 0.02}
    listed = [{**tools, "plate[0].at_m": [0.3, 0.02 * k, 0.03]} for k in range(18)]
    study = pw.Study(root / "examples" / "studies" / "one-plate.toml", rows=listed)
    journal = _core.StudyJournal("out/tools", study)
    for k in range(18):
        journal.append(line(row(k, study.row(k).axes, plan=64 * "a", key=study.row(k).key) | {"scenario": study.scenarios[0]}).strip(), 0.1, None)
    assert journal.finish()
    journal.close()
    for page, count in (("studies.md", 2), ("tools-over-the-table.md", 1)):
        blocks = re.findall(r"^```python\n(.*?)^```$", (root / "docs" / page).read_text(encoding="utf-8"), flags=re.MULTILINE | re.DOTALL)
        after: dict[str, Any] = {}
        for block in blocks:
            exec(compile(block, page, "exec"), after)
        assert len(blocks) == count
        if page == "studies.md":
            assert after["scenario"]["tool"].length_m == 0.15 and len(after["drawn"]) == 256 and Path("out/tools.parquet").is_file()
