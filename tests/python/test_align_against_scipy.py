"""The mount from touched points against SciPy, through the command: the same pose, and the same that is left of the points."""

import json
import subprocess

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

HEADER = "x_m,y_m,z_m,touched_x_mm,touched_y_mm,touched_z_mm\n"


def table(drawn, touched):
    rows = np.hstack([drawn, 1e3 * touched])
    return HEADER + "".join(",".join(repr(float(cell)) for cell in row) + "\n" for row in rows)


@pytest.mark.parametrize("seed", range(12))
def test_noisy_points_give_the_mount_that_scipy_finds(platewash, tmp_path, seed):
    rng = np.random.default_rng(seed)
    count = int(rng.integers(3, 12))
    drawn = rng.uniform([-0.8, -0.8, 0.0], [0.8, 0.8, 0.15], (count, 3))
    turn = Rotation.from_euler("zyx", rng.uniform([-np.pi, -0.2, -0.2], [np.pi, 0.2, 0.2]))
    place = rng.uniform(-1.0, 1.0, 3)
    touched = turn.inv().apply(drawn - place) + rng.normal(0.0, 3e-4, (count, 3))
    (tmp_path / "touched.csv").write_text(table(drawn, touched), encoding="utf-8")

    line = [platewash, "align", "touched.csv", "--tolerance", "0.05", "--json"]
    done = subprocess.run(line, cwd=tmp_path, check=False, capture_output=True)
    answer = json.loads(done.stdout)
    # Most of these tables are out of level, which the mount is found for all the same.
    assert answer["fits"] and done.returncode == (0 if answer["level"] else 4)

    middle = drawn.mean(axis=0), touched.mean(axis=0)
    expected, _ = Rotation.align_vectors(drawn - middle[0], touched - middle[1])
    position = middle[0] - expected.apply(middle[1])
    left = drawn - (expected.apply(touched) + position)
    mount = answer["mount"]
    np.testing.assert_allclose(mount["rotation"], expected.as_matrix(), atol=1e-9)
    np.testing.assert_allclose(mount["position_m"], position, atol=1e-9)
    np.testing.assert_allclose([touch["residual_m"] for touch in answer["touches"]], left, atol=1e-9)
    assert answer["rms_m"] == pytest.approx(np.sqrt((left**2).sum(axis=1).mean()), abs=1e-10)
    found = Rotation.from_quat(np.roll(mount["quaternion_wxyz"], -1))
    assert (found.inv() * expected).magnitude() < 1e-7
    np.testing.assert_allclose(Rotation.from_euler("xyz", mount["rpy_rad"]).as_matrix(), expected.as_matrix(), atol=1e-9)
    up = expected.as_matrix()[2, 2]
    assert answer["tilt_rad"] == pytest.approx(np.arccos(up), abs=1e-6)
    assert answer["level"] == (answer["tilt_rad"] <= 0.0035)
