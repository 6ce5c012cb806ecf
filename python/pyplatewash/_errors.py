"""What can go wrong: one small hierarchy, with the place and the cause as attributes."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt


class PlatewashError(Exception):
    """Base of every exception of this package. ``str(error)`` says where and why in one sentence.

    Each is also what Python's users expect: a ``ValueError``, a ``TypeError``, an ``OSError`` or a ``KeyError``. A call that does
    not fit a function's signature never gets here: that is Python's own ``TypeError``.
    """

    def __init__(self, message: str = "", **fields: Any) -> None:
        super().__init__(message)
        for name, value in fields.items():
            setattr(self, name, value)

    def __str__(self) -> str:
        # Not that of OSError or KeyError, which say less.
        return str(self.args[0]) if self.args else ""

    def __reduce__(self) -> tuple[Any, ...]:
        return (_restore, (type(self), str(self), dict(self.__dict__)))


def _restore(kind: type[PlatewashError], message: str, fields: dict[str, Any]) -> PlatewashError:
    return kind(message, **fields)


class InputError(PlatewashError, ValueError):
    """An argument has a value that makes no sense."""

    #: The argument or key at fault.
    argument: str | None = None


class ShapeError(InputError):
    """An array has the wrong shape."""

    #: The shape found.
    found: tuple[int, ...] = ()
    #: The shapes wanted, as words.
    wanted: list[str] = []


class InputTypeError(PlatewashError, TypeError):
    """An argument is of a wrong type, or holds no real numbers."""

    #: The argument or key at fault.
    argument: str | None = None


class NoKeyError(InputError, KeyError):
    """A scenario or record has no such key; the message names those that there are."""


class FileError(InputError, OSError):
    """The system does not give or take a file; where it is missing, the exception is a ``FileNotFoundError``, too."""

    #: The file.
    filename: str | None = None
    #: The system's number for the fault, where it has one.
    errno: int | None = None
    #: The message.
    strerror: str | None = None


class UrdfError(InputError):
    """A description of an arm was refused; the message names the joint, link or line at fault."""


class ScenarioError(InputError):
    """A scenario was refused."""

    #: The file or name.
    source: str | None = None
    #: Line in the file, from 1.
    line: int | None = None
    #: The key at fault.
    key: str | None = None
    #: What was expected there.
    expected: str | None = None
    #: What was found there.
    found: str | None = None


class PlanFileError(InputError):
    """A plan file cannot be read or written."""


class UrdfAccessError(UrdfError, FileError):
    """The file of an arm cannot be read."""


class UrdfNotFoundError(UrdfAccessError, FileNotFoundError):
    """The file of an arm is not there."""


class ScenarioAccessError(ScenarioError, FileError):
    """The file of a scenario cannot be read or written."""


class ScenarioNotFoundError(ScenarioAccessError, FileNotFoundError):
    """There is no scenario of that name, and no such file, or no folder that one shall be written to."""


class PlanAccessError(PlanFileError, FileError):
    """A plan file cannot be read or written."""


class PlanNotFoundError(PlanAccessError, FileNotFoundError):
    """A plan file is not there, or the folder that it shall be written to."""


class PageNotFoundError(FileError, FileNotFoundError):
    """The folder that a page shall be written to is not there."""


class StudyError(InputError):
    """A study was refused, or its folder keeps something else, or somebody else works on it."""

    #: The file, or the folder.
    source: str | None = None
    #: Line in the file, from 1.
    line: int | None = None


class StudyAccessError(StudyError, FileError):
    """A file of a study cannot be read or written."""


class StudyNotFoundError(StudyAccessError, FileNotFoundError):
    """A study's file or folder is not there."""


class EngineError(PlatewashError):
    """The workers of a study cannot be had, or are of another version; the rows that were done are kept."""


class LayoutError(PlatewashError):
    """The plates could not be placed."""

    #: ``"no_room"`` (no arrangement holds so many), ``"not_found"`` (no layout was found; there may be one) or ``"empty_region"``.
    cause: str | None = None
    #: Plates asked for.
    count: int | None = None
    #: Plates that the best attempt placed.
    most_placed: int | None = None
    #: No arrangement holds more plates than this.
    upper_bound: int | None = None


class IkError(PlatewashError):
    """No configuration was found; the best one and why it stopped there."""

    #: ``"unreachable"`` (proven), ``"limit"``, ``"local_minimum"``, ``"singular"`` or ``"iterations"``.
    cause: str
    #: Joint at its limit, 0 for joint 1.
    joint: int | None = None
    #: The best configuration found, shape (6,) [rad].
    q: npt.NDArray[np.float64]
    #: Linear systems and quadratic programs solved; None for a path that breaks off.
    iterations: int | None = None
    #: How far the joint would have to go beyond its limit [rad], where known.
    limit_excess_rad: float | None = None
    #: How far the best configuration is off [m]; None for a path that breaks off.
    position_error_m: float | None = None
    #: How far the best configuration is turned [rad]; None for a path that breaks off.
    orientation_error_rad: float | None = None


class IkPathError(IkError):
    """A path breaks off; ``cause`` may also be ``"branch_end"``, and ``q`` is the last configuration before."""

    #: Waypoint that is not reached.
    waypoint: int
    #: The configurations up to there, shape (K, 6) [rad].
    solved: npt.NDArray[np.float64]


class PlanError(PlatewashError):
    """A job could not be carried out."""

    #: Stage that failed: ``"robot"``, ``"job"``, ``"plan"``, ``"paper"``, ``"tracking"``, ``"ik"``, ``"clearance"``, ``"coverage"`` or
    #: ``"dry_run"``.
    stage: str | None = None
    #: Plate at fault.
    plate: int | None = None
    #: Waypoint at fault, over all segments.
    waypoint: int | None = None
    #: Joint at fault, 0 for joint 1.
    joint: int | None = None
    #: Why, in one word, where there is one: ``"unwashable"`` (it is known that a plate cannot be washed), ``"not_found"`` (no
    #: way to wash it was found; there may be one), ``"line"``, ``"no_transit"``, ``"tilt"`` (none was found), ``"home"``,
    #: ``"overlap"`` (plates share a place).
    cause: str | None = None
    #: For a plate that cannot be washed, or was not found to be: the share of the wash path that was tried for which configurations were found.
    share: float | None = None
    #: For such a plate whose position was given: the nearest centre at which it can be, shape (2,) [m].
    nearest_m: npt.NDArray[np.float64] | None = None


class ProveError(InputError):
    """A plan says nothing that could be judged, or its arm must be given. A plan that breaks a requirement is no error."""


class ExportError(PlatewashError):
    """A plan is not handed over to a robot."""

    #: Why, in one word that stays: ``"uncertified"``, ``"waived"``, ``"arm"``, ``"load"``, ``"frame"``, ``"start"``, ``"segment_time"``, or
    #: what the program does not keep: ``"joint_speed"``, ``"deviation"``, ``"clearance"``, ``"coverage"``, ``"contact"``, ``"not_kept"``.
    code: str


class ProgramFileError(FileError):
    """A robot program or a bag cannot be written: none of its files is."""


class ProgramNotFoundError(ProgramFileError, FileNotFoundError):
    """The folder in which a program's folder or a bag shall be made is not there."""


class DynamicsError(InputError):
    """An arm has no dynamics: a link states no mass, or one that no body can have."""

    #: The link at fault.
    link: str | None = None
    #: The joint that nothing resists, for a link without inertia about it.
    joint: str | None = None


class SimulationError(PlatewashError):
    """A plan could not be simulated."""

    #: ``"other_arm"``, ``"plan"``, ``"setting"``, ``"too_long"``, ``"unstable"``, ``"stiff_contact"``, ``"diverged"`` or ``"coverage"``.
    cause: str
    #: The key of the scenario at fault.
    key: str | None = None
    #: Segment of the plan at fault.
    segment: int | None = None
    #: The plate that it names.
    plate: int | None = None
    #: Joint that diverges, 0 for joint 1.
    joint: int | None = None
    #: When it does [s].
    t_s: float | None = None
    #: A configuration about which the sampled loop is not stable, shape (6,) [rad].
    q: npt.NDArray[np.float64] | None = None
    #: The least rate at which these gains, or the foam's contact, are stable [Hz], where there is one.
    least_rate_hz: float | None = None
    #: Steps a sample with which the foam's contact is stable at the rate asked for.
    least_substeps: int | None = None
    #: The highest frequency that is stable at this rate with this damping [rad/s], where there is one.
    highest_frequency_rad_s: float | None = None


class MissingError(PlatewashError, ImportError):
    """Something that this installation lacks is needed; the message says how to get it."""

    #: What is missing: ``"matplotlib"``, ``"anywidget"``, ``"rosbags"``, ``"ros2"``, ``"distributed"``, ``"ray"``, ``"pandas"``,
    #: ``"pyarrow"``, ``"scipy"`` or ``"page"``.
    name: str | None = None


class InternalError(PlatewashError):
    """A fault in platewash itself; please report it."""
