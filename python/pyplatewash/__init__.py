"""Plan, check and report the washing of plates by an ABB IRB 120 or another six-axis arm.

Arguments and answers are SI and radians, and names say so where they can: ``length_m``, ``q_rad``. Scenario files state angles in
degrees, under names that end in ``_deg``. A pose is a 4 x 4 matrix ``T_base_frame`` that maps the frame's coordinates to the base's;
joint vectors have shape (6,), many of them (N, 6), from the base to the tip. Anything array-like is accepted.

>>> import pyplatewash as pw
>>> robot = pw.Robot.irb120()
>>> robot.fk([0.0] * 6).shape
(4, 4)
>>> target = robot.fk([0.1, 0.4, 0.1, 0.0, 1.0, 0.2])
>>> robot.ik(target).q.round(6).tolist()
[0.1, 0.4, 0.1, -0.0, 1.0, 0.2]
"""

from importlib.metadata import version as _version

from ._core import (
    Certificate,
    ClearanceModel,
    Cycle,
    DynamicsModel,
    Execution,
    IkSolution,
    Job,
    Layout,
    Plan,
    Robot,
    Scenario,
    Setup,
    Trajectory,
    coverage,
    coverage_raster,
    cubic_samples,
    place_plates,
    plan,
    reproduce,
    run_command,
    simulate,
    sweep,
    transition_waypoints,
    tune,
    verify,
)
from ._errors import (
    DynamicsError,
    FileError,
    IkError,
    IkPathError,
    InputError,
    InputTypeError,
    InternalError,
    LayoutError,
    NoKeyError,
    PlanError,
    PlanFileError,
    PlatewashError,
    ScenarioError,
    ShapeError,
    SimulationError,
    UrdfError,
    VerifyError,
)
from ._records import CoverageRaster, Energy, IkBatch, IkBranches, Record
from ._values import Coverage, IkSettings, Plate, Spiral, Stroke, Tool

__version__: str = _version("pyplatewash")

__all__ = [
    "Certificate",
    "ClearanceModel",
    "Coverage",
    "CoverageRaster",
    "Cycle",
    "DynamicsError",
    "DynamicsModel",
    "Energy",
    "Execution",
    "FileError",
    "IkBatch",
    "IkBranches",
    "IkError",
    "IkPathError",
    "IkSettings",
    "IkSolution",
    "InputError",
    "InputTypeError",
    "InternalError",
    "Job",
    "Layout",
    "LayoutError",
    "NoKeyError",
    "Plan",
    "PlanError",
    "PlanFileError",
    "Plate",
    "PlatewashError",
    "Record",
    "Robot",
    "Scenario",
    "ScenarioError",
    "Setup",
    "ShapeError",
    "SimulationError",
    "Spiral",
    "Stroke",
    "Tool",
    "Trajectory",
    "UrdfError",
    "VerifyError",
    "coverage",
    "coverage_raster",
    "cubic_samples",
    "place_plates",
    "plan",
    "reproduce",
    "run_command",
    "simulate",
    "sweep",
    "transition_waypoints",
    "tune",
    "verify",
]
