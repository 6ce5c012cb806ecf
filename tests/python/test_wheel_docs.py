"""The README's example, the pages for Python users, the examples and the notebooks run, and say what they say."""

import os
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import nbformat
import numpy as np
import pytest
from nbclient import NotebookClient
from readme_example import example

import pyplatewash as pw
from wheel_plans import paper_run, plan

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = sorted((ROOT / "examples" / "python").glob("*.py"))
NOTEBOOKS = sorted((ROOT / "notebooks").glob("*.ipynb"))


def printed(*arguments: str | Path) -> str:
    done = subprocess.run([sys.executable, *map(str, arguments)], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_the_readmes_example_is_short_and_runs_as_printed() -> None:
    lines = [line for line in example().splitlines() if line.strip()]
    assert len(lines) < 12
    headline, swept, shape = printed(ROOT / "tests" / "python" / "readme_example.py").splitlines()
    assert headline == pw.prove(plan("kitchen", 7)).headline
    assert float(swept.removeprefix("least share swept ").removesuffix("%")) > 99
    assert shape == "(3, 6)"


@pytest.mark.parametrize("page", ["python.md", "tutorial-matlab.md"])
def test_the_pages_blocks_run_from_top_to_bottom(page: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    blocks = re.findall(r"^```python\n(.*?)^```$", (ROOT / "docs" / page).read_text(), flags=re.MULTILINE | re.DOTALL)
    assert len(blocks) > 4
    monkeypatch.chdir(tmp_path)
    after: dict[str, Any] = {}
    for number, block in enumerate(blocks, 1):
        exec(compile(block, f"docs/{page}, block {number}", "exec"), after)
    if page == "tutorial-matlab.md":
        np.testing.assert_allclose(after["axis"], [[0, 0, -1], [1, 0, 0]], atol=1e-5)  # The trap: down and forwards.
        np.testing.assert_allclose(after["eul2quat"]([0.3, 0.2, 0.1]), [0.98334744, 0.0342708, 0.10602051, 0.14357218], atol=1e-8)


def test_the_researchers_tutorial_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    page = (ROOT / "docs" / "tutorial-researcher.md").read_text()
    (study,) = re.findall(r"^```toml\n(.*?)^```$", page, flags=re.MULTILINE | re.DOTALL)
    assert 'seeds = "1..50"' in study
    monkeypatch.chdir(tmp_path)
    Path("lengths.toml").write_text(study.replace("1..50", "1..2"))
    rows = pw.Study.load("lengths.toml").run("out/lengths", progress=False)
    assert rows.finished
    after: dict[str, Any] = {}
    for block in re.findall(r"^```python\n(.*?)^```$", page, flags=re.MULTILINE | re.DOTALL):
        exec(compile(block, "docs/tutorial-researcher.md", "exec"), after)
    assert len(after["frame"]) == 4 and after["worst"]["tool"].length_m in {0.1, 0.15}


def test_the_papers_program_call_by_call_equals_its_run() -> None:
    source = next(path for path in EXAMPLES if path.stem == "paper_program")
    assert len(source.read_text().splitlines()) < 60
    after: dict[str, Any] = {"__name__": "example"}
    exec(compile(source.read_text(), source.name, "exec"), after)
    run = paper_run("paper-appendix")
    assert after["reached"] == run.reached.sum()
    np.testing.assert_allclose(after["executed"], run.executed_q, atol=1e-9)


@pytest.mark.parametrize("engine", ["pinocchio", "mujoco"])
def test_a_plan_is_replayed_elsewhere(engine: str) -> None:
    said = printed(next(path for path in EXAMPLES if path.stem == f"replay_{engine}"))
    found = re.search(r"differ by at most ([-+.e\d]+)", said)
    assert found and float(found[1]) < 1e-9, said
    if engine == "mujoco":
        assert said.endswith("the tool left out: 0\n"), said


def test_every_example_is_tested() -> None:
    assert [path.stem for path in EXAMPLES] == ["paper_program", "replay_mujoco", "replay_pinocchio"]
    assert len(NOTEBOOKS) == 5


def words(notebook: Any) -> list[str]:
    """What the cells say, pictures and tables in HTML apart."""
    outputs = [output for cell in notebook.cells for output in cell.get("outputs", ())]
    return ["".join(output.get("text", "") or output.get("data", {}).get("text/plain", "")) for output in outputs]


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_notebooks_run_and_their_outputs_are_current(path: Path, tmp_path: Path) -> None:
    executed = nbformat.read(path, as_version=4)
    folder = {"metadata": {"path": str(tmp_path)}}
    NotebookClient(executed, timeout=600, kernel_name="python3", record_timing=False, resources=folder).execute()
    if os.environ.get("PLATEWASH_WRITE_DOCS"):
        executed.metadata.pop("language_info", None)
        nbformat.write(executed, path)
    committed = nbformat.read(path, as_version=4)
    assert path.stat().st_size < 100_000, "keep pictures few and small"
    assert words(executed) == words(committed), "PLATEWASH_WRITE_DOCS=1 cargo xtask test --only python runs the notebooks anew"
