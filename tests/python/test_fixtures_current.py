"""The kinematics fixtures are what their generator writes today, and our own reader confirms them."""

import json

import arms
import generate
import numpy as np
import pytest
import stl_files

import urdf_reader

NAMES = [*(f"{arm.name}.json" for arm in arms.ARMS), "irb120.json"]


@pytest.fixture(scope="module")
def regenerated():
    return generate.references()


def read(folder, name: str) -> dict:
    return json.loads((folder / name).read_text(encoding="utf-8"))


def assert_close(committed, fresh, where: str) -> None:
    """Same structure, equal text, numbers within 1e-13."""
    assert type(committed) is type(fresh), where
    if isinstance(fresh, dict):
        assert list(committed) == list(fresh), where
        for key in fresh:
            assert_close(committed[key], fresh[key], f"{where}.{key}")
    elif isinstance(fresh, list):
        assert len(committed) == len(fresh), where
        for index, (a, b) in enumerate(zip(committed, fresh)):
            assert_close(a, b, f"{where}[{index}]")
    elif isinstance(fresh, float):
        assert abs(committed - fresh) <= 1e-13, f"{where}: {committed} is now {fresh}"
    else:
        assert committed == fresh, where


def test_no_generated_arm_is_stale_or_missing(fixtures):
    assert {path.name for path in fixtures.glob("arm_*.json")} == set(NAMES) - {"irb120.json"}
    assert {path.name for path in fixtures.glob("arm_*.urdf")} == set(arms.urdf_texts())


@pytest.mark.parametrize("name", arms.urdf_texts())
def test_urdf_text_is_current(fixtures, name):
    assert (fixtures / name).read_text(encoding="utf-8") == arms.urdf_texts()[name]


@pytest.mark.parametrize("name", NAMES)
def test_reference_values_are_current(fixtures, regenerated, name):
    assert_close(read(fixtures, name), regenerated[name], name)


def test_solutions_are_current(fixtures):
    assert_close(read(fixtures, "solutions.json"), generate.solutions(), "solutions.json")


@pytest.mark.parametrize("name", NAMES)
def test_own_reader_confirms_the_reference(fixtures, name):
    content = read(fixtures, name)
    tree = urdf_reader.Tree(fixtures / content["urdf"])
    tip = content["tip"]
    assert [j.name for j in tree.chain(tip) if j.kind != "fixed"] == content["joints"]
    assert len(content["cases"]) >= 40
    for case in content["cases"]:
        q = dict(zip(content["joints"], case["q"]))
        poses = tree.poses(q)
        for link, expected in case["links"].items():
            np.testing.assert_allclose(poses[link][:3, 3], expected["p"], atol=1e-13, rtol=0)
            np.testing.assert_allclose(poses[link][:3, :3], expected["R"], atol=1e-13, rtol=0)
        world = tree.jacobian(q, tip)
        turn = np.kron(np.eye(2), poses[tip][:3, :3].T)
        np.testing.assert_allclose(case["jacobian_world"], world, atol=1e-13, rtol=0)
        np.testing.assert_allclose(case["jacobian_local"], turn @ world, atol=1e-13, rtol=0)


def test_published_solutions_reach_their_pose(fixtures):
    content = read(fixtures, "solutions.json")
    tree = urdf_reader.Tree(fixtures / content["urdf"])
    for solution in content["solutions"]:
        placed = tree.poses({f"joint_{i + 1}": value for i, value in enumerate(solution)})[content["frame"]]
        off = np.linalg.norm(placed[:3, 3] - content["pose"]["p"])
        cosine = (np.trace(np.array(content["pose"]["R"]).T @ placed[:3, :3]) - 1) / 2
        assert off <= content["position_tolerance_m"]
        assert np.arccos(min(1.0, cosine)) <= content["rotation_tolerance_rad"]


def test_stl_files_and_what_trimesh_reads_are_current(fixtures):
    assert read(fixtures, "stl_files.json") == stl_files.files()
