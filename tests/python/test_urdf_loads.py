"""Pinocchio and MuJoCo load urdf/irb120.urdf and agree with its figures and with each other."""

import mujoco
import numpy as np
import pinocchio as pin
import pytest

import urdf_reader

MASSES = [6.215, 3.067, 3.909, 2.944, 1.328, 0.546, 0.137]
UPPER = [2.87979, 1.91986, 1.22173, 2.79253, 2.094395, 6.98132]
LOWER = [-2.87979, -1.91986, -1.91986, -2.79253, -2.094395, -6.98132]
SPEED = [4.36332, 4.36332, 4.36332, 5.58505, 5.58505, 7.33038]
LINKS = ["base_link", *(f"link_{i}" for i in range(1, 7))]
COLLISION = dict(zip(LINKS, [4, 4, 9, 9, 9, 3, 1]))
VISUAL = dict(zip(LINKS, [5, 4, 7, 5, 9, 4, 1]))
CHECKED_PAIRS = {(a, b) for a in (0, 1) for b in (3, 4, 5, 6)}


@pytest.fixture(scope="module")
def mujoco_model(irb120_urdf):
    return mujoco.MjModel.from_xml_path(str(irb120_urdf))


def frame(model: pin.Model, q, name: str) -> pin.SE3:
    data = model.createData()
    pin.framesForwardKinematics(model, data, np.asarray(q, dtype=float))
    return data.oMf[model.getFrameId(name)]


def test_joints_limits_and_masses(irb120):
    assert (irb120.name, irb120.nq, irb120.nv) == ("irb120", 6, 6)
    assert list(irb120.names)[1:] == [f"joint_{i}" for i in range(1, 7)]
    assert irb120.lowerPositionLimit.tolist() == LOWER
    assert irb120.upperPositionLimit.tolist() == UPPER
    assert irb120.upperVelocityLimit.tolist() == SPEED
    assert irb120.upperEffortLimit.tolist() == [0.0] * 6  # Published so; it means unknown.
    assert [inertia.mass for inertia in irb120.inertias] == MASSES


def test_frames_at_zero(irb120):
    flange, tool0 = frame(irb120, np.zeros(6), "flange"), frame(irb120, np.zeros(6), "tool0")
    np.testing.assert_allclose(flange.translation, [0.374, 0, 0.630], atol=1e-15)
    np.testing.assert_allclose(flange.rotation, np.eye(3), atol=1e-15)
    np.testing.assert_allclose(tool0.translation, [0.374, 0, 0.630], atol=1e-15)
    np.testing.assert_allclose(tool0.rotation, [[0, 0, 1], [0, 1, 0], [-1, 0, 0]], atol=1e-15)
    assert frame(irb120, np.zeros(6), "base").isIdentity(1e-15)


def test_reads_all_shapes(irb120, irb120_urdf):
    for kind, wanted in ((pin.GeometryType.COLLISION, COLLISION), (pin.GeometryType.VISUAL, VISUAL)):
        geometry = pin.buildGeomFromUrdf(irb120, str(irb120_urdf), kind)
        owners = [irb120.frames[shape.parentFrame].name for shape in geometry.geometryObjects]
        assert {link: owners.count(link) for link in LINKS} == wanted
        assert len(owners) == sum(wanted.values())


def test_visuals_have_their_colours(irb120, irb120_urdf):
    geometry = pin.buildGeomFromUrdf(irb120, str(irb120_urdf), pin.GeometryType.VISUAL)
    colours = {tuple(np.round(shape.meshColor, 3)) for shape in geometry.geometryObjects}
    assert colours == {
        (0.773, 0.78, 0.769, 1.0),
        (0.345, 0.365, 0.369, 1.0),
        (0.62, 0.63, 0.64, 1.0),
        (0.85, 0.05, 0.08, 1.0),
    }


def test_every_arm_link_but_the_base_is_spheres_and_capsules(irb120_urdf):
    shapes = urdf_reader.shapes(irb120_urdf)
    assert urdf_reader.segments(shapes["base_link"]) is None
    for link in LINKS[1:]:
        assert urdf_reader.segments(shapes[link]) is not None, link


def test_capsule_spheres_sit_on_the_cylinder_ends(irb120_urdf):
    shapes = {shape.name: shape for parts in urdf_reader.shapes(irb120_urdf).values() for shape in parts}
    capsules = [name for name in shapes if name.rpartition("_")[0].endswith("capsule")]
    assert len(capsules) == 11
    for name in capsules:
        for end, point in zip(("start", "end"), urdf_reader.axis_ends(shapes[name])):
            sphere = shapes[f"{name}_{end}"]
            assert sphere.size[0] == shapes[name].size[0]
            np.testing.assert_allclose(sphere.T_link_shape[:3, 3], point, atol=1e-12, rtol=0)


def test_srdf_leaves_the_eight_pairs(irb120, irb120_urdf):
    geometry = pin.buildGeomFromUrdf(irb120, str(irb120_urdf), pin.GeometryType.COLLISION)
    geometry.addAllCollisionPairs()
    pin.removeCollisionPairs(irb120, geometry, str(irb120_urdf.with_suffix(".srdf")))
    # A shape's parent joint has the number of its link; the universe (0) carries base_link.
    owners = [shape.parentJoint for shape in geometry.geometryObjects]
    assert {tuple(sorted((owners[p.first], owners[p.second]))) for p in geometry.collisionPairs} == CHECKED_PAIRS


def test_mujoco_reads_the_same_arm(mujoco_model):
    bodies = [mujoco_model.body(i).name for i in range(mujoco_model.nbody)]
    assert bodies == ["world", *LINKS[1:]]  # MuJoCo melts a fixed base into the world.
    assert mujoco_model.ngeom == sum(COLLISION.values())
    assert mujoco_model.jnt_range.tolist() == [list(pair) for pair in zip(LOWER, UPPER)]
    assert not mujoco_model.jnt_actfrclimited.any()  # effort="0" is not taken for a limit.
    np.testing.assert_allclose(mujoco_model.body_mass[1:], MASSES[1:], rtol=1e-15)
    assert mujoco_model.body_mass.sum() == pytest.approx(11.931, abs=1e-12)


def test_mujoco_and_pinocchio_agree_on_poses(irb120, mujoco_model, random_configurations):
    pin_data, mj_data = irb120.createData(), mujoco.MjData(mujoco_model)
    for q in random_configurations:
        mj_data.qpos[:] = q
        mujoco.mj_kinematics(mujoco_model, mj_data)
        pin.framesForwardKinematics(irb120, pin_data, q)
        for link in LINKS[1:]:
            body, placed = mj_data.body(link), pin_data.oMf[irb120.getFrameId(link)]
            np.testing.assert_allclose(body.xpos, placed.translation, atol=1e-9, rtol=0)
            np.testing.assert_allclose(body.xmat.reshape(3, 3), placed.rotation, atol=1e-9, rtol=0)


def test_mujoco_and_pinocchio_agree_on_dynamics(irb120, mujoco_model, random_configurations):
    pin_data, mj_data = irb120.createData(), mujoco.MjData(mujoco_model)
    rng = np.random.default_rng(21)
    for q in random_configurations[:50]:
        velocity, acceleration = rng.uniform(-2, 2, size=(2, 6))
        mj_data.qpos[:], mj_data.qvel[:], mj_data.qacc[:] = q, velocity, acceleration
        mujoco.mj_inverse(mujoco_model, mj_data)
        # Contacts and joint stops push in MuJoCo only; what they add is taken out.
        torque = mj_data.qfrc_inverse + mj_data.qfrc_constraint
        np.testing.assert_allclose(torque, pin.rnea(irb120, pin_data, q, velocity, acceleration), atol=1e-6)
