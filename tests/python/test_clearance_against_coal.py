"""`platewash fk --json` states the same clearances as coal finds from the URDF primitives.

The reference itself is held against MuJoCo and closed forms.
"""

import mujoco
import numpy as np
import pinocchio as pin
import pytest

import urdf_reader
from clearance_reference import FLOOR, Plates, Reference, Tool, bodies
from clearances_said import TOLERANCE_M, TOOL, said

PLATES = Plates(0.145, 0.03, 0.02, ((0.30, -0.25), (0.30, 0.25)))
# Thinner than a millimetre, where routines of the kind stop up to 75 µm short.
THIN = Tool(length_m=0.15, radius_m=4e-4, sponge_radius_m=3e-4, sponge_height_m=8e-4, compression_m=2e-4)
LAYOUT = """\
[layout]
plate_radius_m = 0.145
plate_height_m = 0.03
plate_thickness_m = 0.02
positions_m = [[0.30, -0.25], [0.30, 0.25]]
"""

SELF_PAIRS = {frozenset((a, b)) for a in ("base_link", "link_1") for b in ("link_3", "link_4", "link_5", "link_6")}
HANDLE_PAIRS = {frozenset(("handle", link)) for link in ("base_link", "link_1", "link_2", "link_3")}


def tool_down(model: pin.Model, count: int) -> list[np.ndarray]:
    """Joint vectors with tool0's z axis straight down and the tip within 0.3 m above the floor, q4 = 0."""
    rng, data, found = np.random.default_rng(31), model.createData(), []
    tool0 = model.getFrameId("tool0")
    while len(found) < count:
        q = rng.uniform(model.lowerPositionLimit, model.upperPositionLimit)
        q[3], q[4] = 0.0, np.pi / 2 - q[1] - q[2]
        pin.framesForwardKinematics(model, data, q)
        tip = data.oMf[tool0].act(np.array([0, 0, TOOL.length_m]))
        if abs(q[4]) <= model.upperPositionLimit[4] and 0 <= tip[2] <= 0.3:
            found.append(q)
    return found


@pytest.fixture(scope="module")
def configurations(irb120, random_configurations) -> np.ndarray:
    return np.array([np.zeros(6), *random_configurations, *tool_down(irb120, 60)])


@pytest.fixture(scope="module")
def tree(irb120_urdf):
    return urdf_reader.Tree(irb120_urdf)


@pytest.fixture(scope="module")
def reference(irb120_urdf):
    return Reference(bodies(irb120_urdf, TOOL, PLATES))


@pytest.fixture(scope="module")
def poses(tree, configurations):
    """Link poses of every configuration."""
    names = [joint.name for joint in tree.chain("link_6")]
    return [tree.poses(dict(zip(names, q))) for q in configurations]


@pytest.fixture(scope="module")
def report(platewash, configurations, tmp_path_factory) -> dict:
    """What the command says about the configurations."""
    return said(platewash, tmp_path_factory.mktemp("coal"), TOOL, LAYOUT, configurations)


def test_command_read_the_configurations(report, configurations):
    assert report["robot"] == "irb120"
    stated = np.array([one["q_rad"] for one in report["configurations"]])
    np.testing.assert_allclose(stated, configurations, atol=1e-12, rtol=0)


def test_command_places_the_frames(report, poses):
    known = set(poses[0])
    # MATLAB's tool0 is link_6; other names that the URDF does not have are the command's own.
    for stated, placed in zip(report["configurations"], poses):
        frames = stated["frames"]
        assert {"flange", "tool0"} & set(frames), f"neither flange nor tool0 among {sorted(frames)}"
        for name in (known | {"matlab_tool0"}) & set(frames):
            expected = placed["link_6" if name == "matlab_tool0" else name]
            np.testing.assert_allclose(frames[name]["position_m"], expected[:3, 3], atol=1e-12, err_msg=name)
            np.testing.assert_allclose(frames[name]["rotation"], expected[:3, :3], atol=1e-12, err_msg=name)


def test_command_checks_the_pairs_that_matter(report, reference):
    for stated in report["configurations"]:
        listed = [frozenset((pair["a"], pair["b"])) for pair in stated["clearance"]]
        assert len(listed) == len(set(listed)), "a pair is stated twice"
        assert set().union(*listed) <= {*reference.bodies, FLOOR}
        assert {"handle", "sponge", FLOOR, "plate 1", "plate 2"} <= set().union(*listed)
        assert SELF_PAIRS | HANDLE_PAIRS <= set(listed)


def agrees(stated: float, expected: float) -> bool:
    """Positive distances agree within the tolerance; overlap is overlap on both sides, whatever its depth."""
    if not np.isfinite(stated):
        return False
    if expected > TOLERANCE_M:
        return abs(stated - expected) <= TOLERANCE_M
    # Touching within the tolerance may fall on either side of zero.
    return stated <= (0.0 if expected < -TOLERANCE_M else expected + TOLERANCE_M)


def differences(report, reference, poses) -> list[str]:
    """The distances on which the command and coal disagree, the worst first."""
    wrong = []
    for index, (stated, placed) in enumerate(zip(report["configurations"], poses, strict=True)):
        reference.move(placed)
        for pair in stated["clearance"]:
            expected = reference.distance(pair["a"], pair["b"])
            if not agrees(pair["distance_m"], expected):
                wrong.append((abs(pair["distance_m"] - expected), index, pair, expected))
    wrong.sort(key=lambda entry: -entry[0])
    return [f"configuration {i}: {pair}, coal {expected:.9f}" for _, i, pair, expected in wrong]


def test_clearances_agree_with_coal(report, reference, poses):
    wrong = differences(report, reference, poses)
    assert not wrong, f"{len(wrong)} distances differ, the worst first:\n" + "\n".join(wrong[:10])


def test_clearances_of_a_thin_tool_agree_with_coal(platewash, irb120_urdf, configurations, poses, tmp_path):
    report = said(platewash, tmp_path, THIN, LAYOUT, configurations)
    wrong = differences(report, Reference(bodies(irb120_urdf, THIN, PLATES)), poses)
    assert not wrong, f"{len(wrong)} distances differ, the worst first:\n" + "\n".join(wrong[:10])


# The reference itself.


def point_to_segment(point, start, end) -> float:
    along = end - start
    share = np.clip((point - start) @ along / max(along @ along, 1e-300), 0.0, 1.0)
    return float(np.linalg.norm(point - start - share * along))


def segment_distance(a0, a1, b0, b1) -> float:
    """Distance of two segments: an end point decides, unless the common perpendicular meets both."""
    ends = [point_to_segment(p, b0, b1) for p in (a0, a1)] + [point_to_segment(p, a0, a1) for p in (b0, b1)]
    u, v, w = a1 - a0, b1 - b0, a0 - b0
    normal = np.cross(u, v)
    square = normal @ normal
    if square > 1e-18:
        s, t = np.cross(v, w) @ normal / square, np.cross(u, w) @ normal / square
        if 0 <= s <= 1 and 0 <= t <= 1:
            ends.append(abs(w @ normal) / np.sqrt(square))
    return min(ends)


def test_coal_agrees_with_closed_form_of_capsules(irb120_urdf, reference, poses):
    parts = {link: urdf_reader.segments(shapes) for link, shapes in urdf_reader.shapes(irb120_urdf).items() if shapes}
    compared = 0
    for placed in poses[::4]:
        reference.move(placed)

        def ends(link):
            R, p = placed[link][:3, :3], placed[link][:3, 3]
            return [(R @ start + p, R @ end + p, radius) for start, end, radius in parts[link]]

        for far in ("link_3", "link_4", "link_5", "link_6"):
            exact = min(
                segment_distance(a0, a1, b0, b1) - ra - rb
                for a0, a1, ra in ends("link_1")
                for b0, b1, rb in ends(far)
            )
            found = reference.distance("link_1", far)
            if exact > 0:
                assert found == pytest.approx(exact, abs=1e-5)
                compared += 1
            else:
                assert found <= 1e-9
    assert compared > 200


def mujoco_scene(irb120_urdf) -> mujoco.MjModel:
    """The arm with the tool on link_6 and the plates in the world, as MuJoCo geoms of the same names."""
    spec = mujoco.MjSpec.from_file(str(irb120_urdf))
    flange = urdf_reader.pose(np.zeros(3), [[0, 0, 1], [0, 1, 0], [-1, 0, 0]])  # T_link_6_tool0
    tool = [(spec.body("link_6"), flange @ part.T_link_shape, part) for part in TOOL.shapes().values()]
    plates = [(spec.worldbody, part.T_link_shape, part) for part in PLATES.shapes()]
    for body, T, part in tool + plates:
        quaternion = np.zeros(4)
        mujoco.mju_mat2Quat(quaternion, T[:3, :3].flatten())
        radius, length = part.size
        body.add_geom(
            name=part.name,
            type=mujoco.mjtGeom.mjGEOM_CYLINDER,
            size=[radius, length / 2, 0],
            pos=T[:3, 3],
            quat=quaternion,
        )
    return spec.compile()


def test_coal_agrees_with_mujoco(irb120_urdf, reference, configurations, poses):
    model = mujoco_scene(irb120_urdf)
    data = mujoco.MjData(model)
    pairs = [sorted(pair) for pair in SELF_PAIRS | HANDLE_PAIRS]
    pairs += [("sponge", name) for name in ("base_link", "link_1", "link_2", "link_3", "plate 1", "plate 2")]
    pairs += [(f"plate {i}", name) for i in (1, 2) for name in ("handle", "link_3", "link_4", "link_5", "link_6")]
    compared = 0
    for q, placed in list(zip(configurations, poses))[::5]:
        reference.move(placed)
        data.qpos[:] = q
        mujoco.mj_kinematics(model, data)
        for a, b in pairs:
            numbers = [[model.geom(s.name).id for s in reference.bodies[name].shapes] for name in (a, b)]
            other = min(
                mujoco.mj_geomDistance(model, data, one, two, 5.0, None) for one in numbers[0] for two in numbers[1]
            )
            found = reference.distance(a, b)
            if min(found, other) > 1e-6:
                assert found == pytest.approx(other, abs=1e-5), (a, b, q.tolist())
                compared += 1
            else:
                assert max(found, other) <= 1e-6, (a, b, q.tolist())
    assert compared > 1500


def test_floor_distances_agree_with_surface_samples(reference, poses):
    """No sampled surface point lies below the closed form, and one comes close to it."""
    angle = np.linspace(0, 2 * np.pi, 721)
    ring = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    for placed in poses[::30]:
        reference.move(placed)
        for name in ("base_link", "handle", "sponge", "plate 1"):
            least = np.inf
            for part, T in zip(reference.bodies[name].shapes, reference.placed[name]):
                if part.kind == "cylinder":
                    rims = [np.c_[part.size[0] * ring, np.full(len(ring), z * part.size[1] / 2)] for z in (-1, 1)]
                    points = np.vstack(rims)
                else:
                    signs = np.array(np.meshgrid([-1, 1], [-1, 1], [-1, 1])).reshape(3, -1).T
                    points = signs * np.array(part.size) / 2
                least = min(least, (points @ T[:3, :3].T + T[:3, 3])[:, 2].min())
            assert 0 <= least - reference.distance(FLOOR, name) + 1e-12 <= 1e-5
