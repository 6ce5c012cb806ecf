"""The types of the package: three checkers find its stubs true, and no error in what uses it. Run: cargo xtask check --only types"""

import subprocess
import sys
from pathlib import Path

import pytest

import pyplatewash as pw


def check(cwd: Path, *arguments: str | Path) -> None:
    """Runs a checker on the installed package, not on the sources beside the compiled part."""
    done = subprocess.run([sys.executable, "-m", *map(str, arguments)], cwd=cwd, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr


def users(root: Path) -> list[Path]:
    """Everything in Python that uses the wheel."""
    tests = sorted((root / "tests" / "python").glob("test_wheel_*.py"))
    examples = sorted((root / "examples" / "python").glob("*.py"))
    assert len(tests) >= 7 and len(examples) >= 3
    return tests + examples


def test_stubs_match_the_module(tmp_path: Path) -> None:
    check(tmp_path, "mypy.stubtest", "pyplatewash")


@pytest.fixture
def mypy_cache(root: Path) -> Path:
    """Where mypy keeps what it knows of the packages, from one run to the next."""
    return root / "target" / "mypy"


def test_mypy_finds_no_error(root: Path, tmp_path: Path, mypy_cache: Path) -> None:
    strict: list[str | Path] = ["mypy", "--strict", "--config-file", root / "pyproject.toml", "--cache-dir", mypy_cache]
    check(tmp_path, *strict, "-p", "pyplatewash")
    check(tmp_path, *strict, *users(root))


def test_pyright_finds_no_error(root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PYRIGHT_PYTHON_IGNORE_WARNINGS", "1")  # It would ask for a newer version of itself.
    # The package, and what calls all of it; mypy looks at the other tests.
    calls = [file for file in users(root) if file.stem in ("test_wheel_arguments", "test_wheel_jobs", "test_wheel_plates")]
    assert len(calls) == 3
    check(root, "pyright", "--pythonpath", sys.executable, Path(pw.__file__).parent, *calls)


def test_a_wrong_call_is_found_by_the_types(tmp_path: Path, mypy_cache: Path) -> None:
    (tmp_path / "wrong.py").write_text("import pyplatewash as pw\npw.Robot.irb120().fk([0.0] * 6, axes='base')\npw.plan(3)\n")
    line = [sys.executable, "-m", "mypy", "--strict", "--cache-dir", str(mypy_cache), "wrong.py"]
    found = subprocess.run(line, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert "wrong.py:2" in found.stdout and "wrong.py:3" in found.stdout
