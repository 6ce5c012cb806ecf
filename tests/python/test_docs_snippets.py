"""The Python in docs/urdf.md runs as printed, from top to bottom, and does what its text says."""

import re

import mujoco
import numpy as np
import pytest


@pytest.fixture(scope="module")
def after(root):
    """The variables left behind by all snippets of the page, run in order from the root of the repository."""
    text = (root / "docs" / "urdf.md").read_text(encoding="utf-8")
    snippets = re.findall(r"^```python\n(.*?)^```$", text, flags=re.MULTILINE | re.DOTALL)
    assert len(snippets) == 5
    variables: dict = {}
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(root)
        for number, snippet in enumerate(snippets, 1):
            exec(compile(snippet, f"docs/urdf.md, snippet {number}", "exec"), variables)
    return variables


def test_tool0_points_down_in_the_first_snippet(after):
    np.testing.assert_allclose(after["tool0"].rotation[:, 2], [0, 0, -1], atol=1e-12)


def test_distance_snippet_finds_clearance(after):
    assert 0 < after["least"] < 0.5


def test_exclusions_remove_the_standing_contacts(after, irb120_urdf):
    assert after["state"].ncon == 0
    plain = mujoco.MjModel.from_xml_path(str(irb120_urdf))
    state = mujoco.MjData(plain)
    mujoco.mj_forward(plain, state)
    touching = {frozenset(int(plain.geom_bodyid[g]) for g in contact.geom) for contact in state.contact}
    assert touching == {frozenset((0, 1)), frozenset((4, 6))}  # As the page says; body i is link_i, 0 the base.


def test_matlab_pose_points_down(after):
    np.testing.assert_allclose(after["T_base_tool0"].rotation[:, 2], [0, 0, -1], atol=1e-12)
