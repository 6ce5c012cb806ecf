"""A plan in MuJoCo: our URDF, our motion, MuJoCo's contacts. Needs: pip install mujoco"""

# pyright: reportAttributeAccessIssue=false
# (MuJoCo is compiled; its names are hidden from pyright.)
import mujoco
import numpy as np

import pyplatewash as pw

robot = pw.Robot.irb120()
plan = pw.plan("kitchen")
model = mujoco.MjModel.from_xml_string(robot.urdf)
state = mujoco.MjData(model)
last = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, "link_6")

t = np.arange(0.0, plan.trajectory.duration_s, 0.01)
q, _, _ = plan.trajectory.at(t)
farthest = 0.0
for configuration in q:
    state.qpos[:] = configuration
    mujoco.mj_forward(model, state)
    ours = robot.fk(configuration, "link_6")
    farthest = max(farthest, float(np.abs(state.xpos[last] - ours[:3, 3]).max()))

print(f"{len(t)} configurations; link_6 here and in MuJoCo differ by at most {farthest:.1e} m")
