"""How packages come by the page in 3-D: `python/backend`."""

import importlib.util
import subprocess
import sys
from importlib import metadata
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture
def backend(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Any:
    """The backend as in a checkout without a bundle, on a machine where nothing is on the PATH."""
    spec = importlib.util.spec_from_file_location("platewash_build", ROOT / "python" / "backend" / "platewash_build.py")
    assert spec and spec.loader
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    monkeypatch.delenv(module.SWITCH, raising=False)
    monkeypatch.setattr(module, "ROOT", tmp_path)
    monkeypatch.setattr(module, "BUNDLE", tmp_path / "stamp")
    monkeypatch.setattr(module, "CHORES", tmp_path / "chores")
    monkeypatch.setattr(module.shutil, "which", lambda name: None)
    monkeypatch.setattr(module.platform, "system", lambda: "Linux")
    monkeypatch.setattr(module.platform, "machine", lambda: "x86_64")
    module.CHORES.touch()
    return module


def say(monkeypatch: pytest.MonkeyPatch, backend: Any, code: int = 0, stdout: str = "", stderr: str = "") -> None:
    """Has every program that the backend starts end so."""
    monkeypatch.setattr(backend.shutil, "which", lambda name: f"/bin/{name}")
    monkeypatch.setattr(backend.subprocess, "run", lambda line, **_: subprocess.CompletedProcess(line, code, stdout, stderr))


def test_needs_node_only_where_the_bundle_is_missing(backend: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    assert backend._node() == [backend.NODE]
    for version, asked in [("v20.19.0", [backend.NODE]), ("v22.17.0", []), ("v24.1.0", []), ("", [backend.NODE])]:
        say(monkeypatch, backend, stdout=version)
        assert backend._node() == asked, version
    backend.BUNDLE.touch()
    assert backend._node() == []


def test_a_source_package_needs_no_node(backend: Any) -> None:
    backend.CHORES.unlink()
    assert backend._node() == []


def test_needs_no_node_where_none_is_published(backend: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(backend.platform, "machine", lambda: "riscv64")
    assert backend._node() == []


def test_a_failed_page_is_reported_without_failing(
    backend: Any, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    backend._make_page()
    assert "no cargo" in capsys.readouterr().err
    say(monkeypatch, backend, code=1, stderr="npm error\n\nFAILED: no network\n")
    backend._make_page()
    assert capsys.readouterr().err == "warning: this build has no page in 3-D: no network\n"
    say(monkeypatch, backend)
    backend._make_page()
    assert capsys.readouterr().err == ""


def test_a_source_package_without_the_page_says_so(backend: Any, capsys: pytest.CaptureFixture[str]) -> None:
    backend.CHORES.unlink()
    backend._make_page()
    assert "not in these sources" in capsys.readouterr().err
    backend.BUNDLE.touch()
    backend._make_page()
    assert capsys.readouterr().err == ""


def test_the_switch_disables_building_the_page(backend: Any, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setenv(backend.SWITCH, "0")
    assert backend._node() == []
    backend._make_page()
    assert backend.SWITCH in capsys.readouterr().err


def test_the_wheel_has_the_page_and_the_licences_of_what_others_wrote_of_it(tmp_path: Path) -> None:
    files = metadata.files("pyplatewash") or []
    notices = [file.read_text() for file in files if file.name == "notices.txt"]
    assert len(notices) == 1
    for name in ("three", "uplot"):
        assert f"\n{name} " in notices[0], name
    done = subprocess.run([sys.executable, "-m", "pyplatewash", "run", "--quiet"], cwd=tmp_path, capture_output=True, check=True)
    assert done.stderr == b""
    assert "three.js authors" in (tmp_path / "out" / "page.html").read_text(encoding="utf-8")
