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

A scenario is planned, its plan is proved and simulated:

>>> planned = pw.plan("kitchen", seed=3)
>>> pw.prove(planned).proved, pw.simulate(planned).report().verdict
(True, 'washed')
"""

from importlib.metadata import version as _version

from ._core import (
    Certificate,
    ClearanceModel,
    DynamicsModel,
    Execution,
    Layout,
    PaperJob,
    PaperRun,
    Plan,
    Planned,
    Robot,
    Scenario,
    SimulationSettings,
    Study,
    Trajectory,
    WashJob,
    coverage,
    coverage_raster,
    cubic_samples,
    differences,
    place_plates,
    plan,
    prove,
    prove_motion,
    reproduce,
    run_command,
    run_paper,
    simulate,
    sweep,
    transit_waypoints,
    tune,
)
from ._edit import edit
from ._errors import (
    DynamicsError,
    EngineError,
    ExportError,
    FileError,
    IkError,
    IkPathError,
    InputError,
    InputTypeError,
    InternalError,
    LayoutError,
    MissingError,
    NoKeyError,
    PlanError,
    PlanFileError,
    PlatewashError,
    ProveError,
    ScenarioError,
    ShapeError,
    SimulationError,
    StudyError,
    UrdfError,
)
from ._figure import Figure
from ._nouns import finish as _finish
from ._page import Page
from ._records import CoverageRaster, Energy, IkBatch, IkBranches, IkSolution, Record, Recovery
from ._studies.samples import samples
from ._studies.rows import StudyRows
from ._values import Coverage, Foot, IkSettings, PaperSpiral, Plate, Rings, Tool, WashCurve

__version__: str = _version("pyplatewash")
_finish()

__all__ = [
    "Certificate",
    "ClearanceModel",
    "Coverage",
    "CoverageRaster",
    "DynamicsError",
    "DynamicsModel",
    "Energy",
    "EngineError",
    "Execution",
    "ExportError",
    "Figure",
    "FileError",
    "Foot",
    "IkBatch",
    "IkBranches",
    "IkError",
    "IkPathError",
    "IkSettings",
    "IkSolution",
    "InputError",
    "InputTypeError",
    "InternalError",
    "Layout",
    "LayoutError",
    "MissingError",
    "NoKeyError",
    "Page",
    "PaperJob",
    "PaperRun",
    "PaperSpiral",
    "Plan",
    "PlanError",
    "PlanFileError",
    "Planned",
    "Plate",
    "PlatewashError",
    "ProveError",
    "Record",
    "Recovery",
    "Rings",
    "Robot",
    "Scenario",
    "ScenarioError",
    "ShapeError",
    "SimulationError",
    "SimulationSettings",
    "Study",
    "StudyError",
    "StudyRows",
    "Tool",
    "Trajectory",
    "UrdfError",
    "WashCurve",
    "WashJob",
    "coverage",
    "coverage_raster",
    "cubic_samples",
    "differences",
    "edit",
    "place_plates",
    "plan",
    "prove",
    "prove_motion",
    "reproduce",
    "run_command",
    "run_paper",
    "samples",
    "simulate",
    "sweep",
    "transit_waypoints",
    "tune",
]
