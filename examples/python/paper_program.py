"""The paper's program, call by call, for readers who come from MATLAB. Run: python examples/python/paper_program.py"""

import numpy as np
import numpy.typing as npt

import pyplatewash as pw

Floats = npt.NDArray[np.float64]

robot = pw.Robot.irb120()  # loadrobot("abbIrb120")
scenario = pw.Scenario.load("paper-appendix")
centres = pw.place_plates(scenario).centres  # the appendix's loop over rand
spiral = pw.PaperSpiral(points=55, turns=3, radius_m=0.145)  # linspace in angle and radius
numeric = pw.IkSettings(analytic_starts=False)  # inverseKinematics("RigidBodyTree", robot)
z, dt, kp, kd = 0.08, 0.01, 20.0, 0.1


def pose(point: Floats) -> Floats:
    """trvec2tform(point) * eul2tform([0 pi/2 0]): the x axis of MATLAB's tool0 points down."""
    return np.array([[0, 0, 1, point[0]], [0, 1, 0, point[1]], [-1, 0, 0, point[2]], [0, 0, 0, 1]])


def over(centre: Floats) -> Floats:
    """The spiral over a plate, shape (55, 3)."""
    flat = spiral.waypoints(centre)
    return np.column_stack([flat, np.full(len(flat), z)])


def tool_path() -> list[Floats]:
    """Spirals, nearest plate first, and the transits between them."""
    path: list[Floats] = []
    here, left = np.zeros(3), list(range(len(centres)))
    while left:
        nearest = min(left, key=lambda k: float(np.sum((centres[k] - here[:2]) ** 2)))
        left.remove(nearest)
        wash = over(centres[nearest])
        if path:
            through = pw.transit_waypoints(here, wash[0], points=5, radius_m=0.35, height_m=0.25)
            path.append(pw.cubic_samples(through, 50, "zero_velocity"))  # cubicpolytraj
        path.append(wash)
        here = wash[-1]
    return path


q = np.radians(scenario.robot.start_deg)
executed, reached = [], 0
for segment in tool_path():
    previous = np.zeros(6)
    for point in segment:
        try:
            wanted = robot.ik(pose(point), q, "matlab_tool0", settings=numeric).q  # ik("tool0", ...)
            reached += 1
        except pw.IkError as error:
            wanted = error.q  # MATLAB goes on with its best guess, too
        error_q = wanted - q
        q = q + (kp * error_q + kd * (error_q - previous) / dt) * dt
        previous = error_q
        executed.append(q)
print(f"{reached} of {len(executed)} waypoints reached; the spirals of {len(centres)} plates")
