"""Paths and models shared by the tests of this folder. Run: pytest tests/python"""

import os
import sys
from pathlib import Path

import matplotlib
import numpy as np
import pinocchio as pin
import pytest

ROOT = Path(__file__).resolve().parents[2]
FIXTURES = ROOT / "crates" / "kinematics" / "tests" / "fixtures"
sys.path.insert(0, str(FIXTURES))
sys.dont_write_bytecode = sys.pycache_prefix is None
matplotlib.use("agg")  # No test opens a window.


#: The files that take longest. They come first, so that with several processes none is still at a long file when the others are done.
LONGEST = ["test_wheel_study_engines.py", "test_wheel_docs.py", "test_wheel_arguments.py", "test_wheel_command.py"]


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    rank = {name: place for place, name in enumerate(LONGEST)}
    items.sort(key=lambda item: rank.get(item.path.name, len(LONGEST)))


@pytest.fixture(scope="session")
def root() -> Path:
    """The repository."""
    return ROOT


@pytest.fixture(scope="session")
def platewash() -> Path:
    """The command: PLATEWASH_BIN, else target/release/platewash."""
    binary = Path(os.environ.get("PLATEWASH_BIN", ROOT / "target" / "release" / "platewash")).resolve()
    assert binary.is_file(), f"{binary} is missing: cargo build --release --bin platewash, or set PLATEWASH_BIN"
    return binary


@pytest.fixture(scope="session")
def fixtures() -> Path:
    """The folder of the kinematics fixtures and their generator."""
    return FIXTURES


@pytest.fixture(scope="session")
def irb120_urdf() -> Path:
    return ROOT / "urdf" / "irb120.urdf"


@pytest.fixture(scope="session")
def irb120(irb120_urdf) -> pin.Model:
    """Pinocchio's model of the arm."""
    return pin.buildModelFromUrdf(str(irb120_urdf))


@pytest.fixture(scope="session")
def random_configurations(irb120) -> np.ndarray:
    """300 joint vectors [rad], uniform within the limits, always the same."""
    rng = np.random.default_rng(20)
    return rng.uniform(irb120.lowerPositionLimit, irb120.upperPositionLimit, size=(300, 6))
