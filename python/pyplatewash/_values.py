"""Plain data: immutable, compared by value, printed in full, copied and pickled as any dataclass, checked when it is made."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from . import _core

Floats = npt.NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class Tool:
    """A straight handle that leaves the flange along its normal, with a round sponge at its end.

    The tip is the centre of the sponge's far face as it is pressed while it washes: the free sponge is longer by the compression, and the
    handle ends ``sponge_height_m`` above the contact.

    >>> Tool(length_m=0.15)
    Tool(length_m=0.15, radius_m=0.02, sponge_radius_m=0.025, sponge_height_m=0.025, sponge_compression_m=0.005, sponge_stiffness_pa=None, mass_kg=0.3, com_m=None, inertia_kg_m2=None, mounted_on=None)
    """

    #: From the flange to the sponge's far face as it is pressed [m]; 0 for no tool body.
    length_m: float = 0.0
    #: Radius of the handle [m].
    radius_m: float = 0.02
    #: Radius of the sponge [m]; also decides coverage.
    sponge_radius_m: float = 0.025
    #: Height of the sponge while it washes [m].
    sponge_height_m: float = 0.025
    #: How far the sponge is pressed in while it washes [m]: the tip may lift as far and still touch. An assumption.
    sponge_compression_m: float = 0.005
    #: Least and greatest stiffness of the sponge, pressure over strain [Pa]: an assumption; unknown without it.
    sponge_stiffness_pa: tuple[float, float] | None = None
    #: Mass [kg], none where the length is 0: an assumption.
    mass_kg: float = 0.3
    #: Distance of the centre of mass from the flange, along the handle [m]; without it, half the length.
    com_m: float | None = None
    #: Inertia about the centre of mass, ixx, ixy, ixz, iyy, iyz, izz, z along the handle [kg m^2]; without it, a uniform cylinder's.
    inertia_kg_m2: tuple[float, float, float, float, float, float] | None = None
    #: Link behind joint 6 that carries it, and the axis along which it leaves the link: ``"link_eef"`` for z, ``"flange:x"``. Without it,
    #: ``tool0``, or what the description tells.
    mounted_on: str | None = None

    def __post_init__(self) -> None:
        _core._check("tool", self)


@dataclass(frozen=True, kw_only=True)
class Foot:
    """The ring below a plate that it stands on, as the cylinder that encloses it."""

    #: Outer radius [m].
    radius_m: float
    #: How far it reaches below the body under the pole [m].
    height_m: float

    def __post_init__(self) -> None:
        _core._check("foot", self)


@dataclass(frozen=True, kw_only=True)
class Plate:
    """A plate: a disc, or the surface of revolution of a profile, ``thickness_m`` thick. World frame; it lies level unless it is turned.

    A profile goes through knots, each a radius [m] and a slope [rad], from the pole, (0, 0), outwards; the sine of the slope is linear in
    the radius between. Its name will do for one that comes along: ``"coupe275"``, ``"rim270"``, ``"deep230"``, ``"dessert190"``.

    >>> plate = Plate(x_m=0.3, y_m=0.0, profile="rim270", thickness_m=0.005)
    >>> plate.radius_m, len(plate.profile)
    (0.135, 5)
    >>> plate == Plate(x_m=0.3, y_m=0.0, profile=plate.profile, thickness_m=0.005)
    True
    """

    #: Centre [m].
    x_m: float
    #: Centre [m].
    y_m: float
    #: Height of the washing surface at its centre [m].
    z_m: float = 0.03
    #: Radius of the rim [m]; with a profile, that of its last knot, and to be left out.
    radius_m: float = 0.145
    #: Thickness [m].
    thickness_m: float = 0.02
    #: Knots of the profile, the pole apart, or its name, which becomes its knots; none of a disc.
    profile: tuple[tuple[float, float], ...] | None = None
    #: The ring that it stands on, where it has one.
    foot: Foot | None = None
    #: How it is turned, as a unit quaternion (w, x, y, z): level, face up, as it is.
    quaternion_wxyz: tuple[float, float, float, float] = (1.0, 0.0, 0.0, 0.0)
    #: Its own height error, up or down [m]; none for that of the job.
    height_error_m: float | None = None
    #: Greatest distance of the real plate from its face and its body [m], where it was measured.
    deviation_m: float | None = None
    #: Index of its measured shape in the job, where it has one.
    measured: int | None = None
    #: Index of its soil in the job, where it has one.
    soil: int | None = None

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            x_m: float,
            y_m: float,
            z_m: float = 0.03,
            radius_m: float = 0.145,
            thickness_m: float = 0.02,
            profile: str | npt.ArrayLike | None = None,
            foot: Foot | None = None,
            quaternion_wxyz: npt.ArrayLike = (1.0, 0.0, 0.0, 0.0),
            height_error_m: float | None = None,
            deviation_m: float | None = None,
            measured: int | None = None,
            soil: int | None = None,
        ) -> None: ...

    def __post_init__(self) -> None:
        profile, radius_m, quaternion_wxyz = _core._plate_made(self)
        object.__setattr__(self, "quaternion_wxyz", quaternion_wxyz)
        object.__setattr__(self, "profile", profile)
        object.__setattr__(self, "radius_m", radius_m)
        _core._check("plate", self)


@dataclass(frozen=True, kw_only=True)
class IkSettings:
    """Settings of the inverse kinematics; the defaults suit the IRB 120 and arms of its size."""

    #: Largest accepted distance from the target [m].
    position_tolerance_m: float = 1e-6
    #: Largest accepted angle from the target [rad].
    orientation_tolerance_rad: float = 1e-6
    #: Most damped steps from one start.
    max_iterations: int = 60
    #: Most quadratic programs from one start.
    max_qp_iterations: int = 30
    #: Largest joint step of one iteration [rad].
    step_bound_rad: float = 0.7
    #: Whether closed-form branches serve as starts, on arms that have them.
    analytic_starts: bool = True
    #: Listed starts that are tried after the seed, at most 256.
    listed_starts: int = 64
    #: Random restarts after those.
    random_restarts: int = 0
    #: Seed of the random restarts.
    random_seed: int = 0

    def __post_init__(self) -> None:
        _core._check("ik_settings", self)


@dataclass(frozen=True)
class Coverage:
    """The swept part of a disc, as fractions of its area, 0 to 1."""

    #: Best estimate.
    fraction: float
    #: The true value is not below this.
    lower: float
    #: The true value is not above this.
    upper: float


@dataclass(frozen=True, kw_only=True)
class PaperSpiral:
    """The paper's spiral: waypoints equally spaced in angle, from the centre outwards.

    >>> PaperSpiral().waypoints((0.25, -0.25)).shape
    (55, 2)
    """

    #: Waypoints.
    points: int = 55
    #: Turns.
    turns: float = 3.0
    #: Outer radius [m].
    radius_m: float = 0.145
    #: Whether a full circle at the outer radius follows.
    closing_ring: bool = False

    def __post_init__(self) -> None:
        _core._check("paper_spiral", self)

    def waypoints(self, centre: npt.ArrayLike = (0.0, 0.0)) -> Floats:
        """Waypoints about ``centre``, shape (2,) [m]: shape (N, 2) [m]."""
        return _core._paper_spiral(self, centre)


@dataclass(frozen=True, kw_only=True)
class Rings:
    """Rings about the pole, evenly apart, joined by blends; blends farther out take less of a turn.

    >>> round(Rings(count=3, inner_m=0.0243, lead_rad=2.02, blend_rad=1.77).turns, 3)
    1.93
    """

    #: Rings in all, from 2 to 100.
    count: int
    #: Length along the meridian from the pole to the innermost ring [m].
    inner_m: float
    #: How long before a full turn the first blend begins [rad].
    lead_rad: float
    #: Over which angle the first blend goes [rad].
    blend_rad: float
    #: How often the path goes round each ring.
    laps: int = 1

    def __post_init__(self) -> None:
        _core._check("rings", self)

    @property
    def turns(self) -> float:
        """Turns before the closing ring, which is the last."""
        return _core._rings_turns(self)


@dataclass(frozen=True, kw_only=True)
class WashCurve:
    """A continuous spiral that runs tangentially into its closing ring, or rings joined by blends: the curve of a wash path.

    Lengths are along the meridian of the face, on a disc from its centre.

    >>> theta, points = WashCurve(radius_m=0.124, turns=3.5).sample(1e-5)
    >>> points.shape == (len(theta), 2)
    True
    """

    #: Outer radius [m].
    radius_m: float
    #: Turns before the closing ring, at least a quarter; with rings, ``rings.turns``.
    turns: float
    #: Direction in which the spiral leaves the centre, counter-clockwise from +x [rad].
    start_angle_rad: float = 0.0
    #: Whether a circle at the outer radius follows.
    closing_ring: bool = True
    #: Angle by which that circle ends before a full turn [rad].
    trim_rad: float = 0.0
    #: That it consists of rings; without them, it is a spiral.
    rings: Rings | None = None

    def __post_init__(self) -> None:
        _core._check("wash_curve", self)

    def sample(self, chord_error_m: float = 1e-5) -> tuple[Floats, Floats]:
        """On a disc: angles, shape (N,) [rad], and points, shape (N, 2) [m], whose chords leave the curve by at most ``chord_error_m``."""
        return _core._wash_curve(self, chord_error_m)

    def on(self, plate: Plate, chord_error_m: float = 1e-5) -> tuple[Floats, Floats, Floats]:
        """The same on the face of a plate, in its frame, whose origin is the pole: angles, shape (N,) [rad], points and normals, each of shape
        (N, 3) [m]."""
        return _core._wash_curve_on(self, plate, chord_error_m)
