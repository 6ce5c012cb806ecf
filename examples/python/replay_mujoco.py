"""A plan in MuJoCo: our URDF, our motion, MuJoCo's contacts. Needs: pip install mujoco"""

# pyright: reportAttributeAccessIssue=false
# (MuJoCo is compiled; its names are hidden from pyright.)
import xml.etree.ElementTree as ET

import mujoco
import numpy as np

import pyplatewash as pw

robot = pw.Robot.irb120()
plan = pw.plan("kitchen").plan
spec = mujoco.MjSpec.from_string(robot.urdf)
for pair in ET.fromstring(robot.srdf or "<robot/>").iter("disable_collisions"):
    # MuJoCo reads no SRDF. The base is merged into the world when the model is compiled.
    one, two = ("world" if name == "base_link" else name for name in (pair.get("link1"), pair.get("link2")))
    spec.add_exclude(bodyname1=one, bodyname2=two)
for k, plate in enumerate(plan.plates, 1):
    body = spec.worldbody.add_body(name=f"plate {k}", pos=[plate.x_m, plate.y_m, plate.z_m - plate.thickness_m / 2])
    body.add_geom(type=mujoco.mjtGeom.mjGEOM_CYLINDER, size=[plate.radius_m, plate.thickness_m / 2, 0])
model = spec.compile()
state = mujoco.MjData(model)
last = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, "link_6")

t = np.arange(0.0, plan.duration_s, 0.01)
q, _, _ = plan.trajectory.at(t)
farthest, contacts = 0.0, 0
for configuration in q:
    state.qpos[:] = configuration
    mujoco.mj_forward(model, state)
    ours = robot.fk(configuration, "link_6")
    farthest = max(farthest, float(np.abs(state.xpos[last] - ours[:3, 3]).max()))
    contacts += state.ncon

print(f"{len(t)} configurations; link_6 here and in MuJoCo differ by at most {farthest:.1e} m")
print(f"contacts of the arm with itself or the plates, the tool left out: {contacts}")
