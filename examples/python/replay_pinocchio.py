"""A plan in Pinocchio: our URDF, our motion, Pinocchio's kinematics and dynamics. Needs: pip install pin"""

# pyright: reportAttributeAccessIssue=false
# (Pinocchio is compiled; its names are hidden from pyright.)
import numpy as np
import pinocchio as pin

import pyplatewash as pw

robot = pw.Robot.irb120()
plan = pw.plan("kitchen").plan
model = pin.buildModelFromXML(robot.urdf)
data = model.createData()
tool0 = model.getFrameId("tool0")

t = np.arange(0.0, plan.duration_s, 0.01)
q, qd, qdd = plan.trajectory.at(t)
farthest, torque = 0.0, np.zeros(6)
for k in range(len(t)):
    pin.framesForwardKinematics(model, data, q[k])
    farthest = max(farthest, np.abs(data.oMf[tool0].homogeneous - robot.fk(q[k])).max())
    torque = np.maximum(torque, np.abs(pin.rnea(model, data, q[k], qd[k], qdd[k])))

print(f"{len(t)} configurations; tool0 here and in Pinocchio differ by at most {farthest:.1e}")
print("largest torques without the tool [N m]:", np.round(torque, 1))
