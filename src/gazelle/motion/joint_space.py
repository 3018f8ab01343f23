"""The joints that a motion is planned for, and the question whether they may be somewhere.

A configuration is an array of one number per joint of the space, in rad for turning joints and in
m for sliding ones. A motion between two configurations is the straight line between the two
arrays. Continuous joints are numbers like all others: a motion from 3.1 to 3.2 goes on past pi,
one from 3.1 to -3.08 turns almost once around. Planners choose the numbers so that they take the
short way.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, NamedTuple, Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "BoolArray",
    "FloatArray",
    "JointSpace",
    "SweptMotions",
    "SweptValidity",
    "Validity",
]

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]

_TURN = 2.0 * math.pi


@runtime_checkable
class Validity(Protocol):
    """Says whether a robot may be in a configuration: no collision, no limit exceeded."""

    def is_valid(self, q: FloatArray) -> bool:
        """Return whether the robot may be at `q`, shape (n,)."""
        ...

    def motion_is_valid(self, q0: FloatArray, q1: FloatArray, step: float) -> bool:
        """Return whether the robot may move straight from `q0` to `q1`, shape (n,).

        Checks `q1` and states between, no two neighbours further than `step` (Euclidean, rad or
        m) apart. `q0` is known to be valid.
        """
        ...

    def why(self, q: FloatArray) -> str:
        """Return what forbids `q` (n,): links that collide, the joint outside its limit.

        Returns an empty string where nothing does.
        """
        ...


class SweptMotions(NamedTuple):
    """What a kernel needs to check motions itself, as `collision.sweep_kernels.sweep` does.

    Attributes:
        lower: (n,) least that is allowed.
        upper: (n,) most that is allowed.
        surroundings: all of the robot and what is around it, a `SweepArguments`.
    """

    lower: FloatArray
    upper: FloatArray
    surroundings: tuple[Any, ...]


@runtime_checkable
class SweptValidity(Validity, Protocol):
    """A `Validity` that lets kernels check motions."""

    def swept_motions(self) -> SweptMotions | None:
        """Return what kernels need, None where only this object can tell."""
        ...


@dataclass(frozen=True)
class JointSpace:
    """The n joints of a planning group with their limits, (n,) each.

    Attributes:
        names: names of the joints, in the order of all arrays.
        lower: lowest position, rad or m; -inf where there is none.
        upper: highest position, rad or m; inf where there is none.
        continuous: joints that turn without end; their `lower` and `upper` are not looked at.
        velocity: largest speed, rad/s or m/s; inf where none is known.
        acceleration: largest acceleration, rad/s² or m/s²; inf where none is known.
        jerk: largest jerk, rad/s³ or m/s³; inf where none is known.
    """

    names: tuple[str, ...]
    lower: FloatArray
    upper: FloatArray
    continuous: BoolArray
    velocity: FloatArray
    acceleration: FloatArray
    jerk: FloatArray

    def __post_init__(self) -> None:
        for field in ("lower", "upper", "velocity", "acceleration", "jerk"):
            _set_array(self, field, np.float64)
        _set_array(self, "continuous", np.bool_)
        wrong = ~self.continuous & ~(self.lower <= self.upper)
        if wrong.any():
            place = int(np.flatnonzero(wrong)[0])
            raise ValueError(
                f"joint '{self.names[place]}' has lower limit {self.lower[place]:g} above its "
                f"upper limit {self.upper[place]:g}"
            )

    @property
    def size(self) -> int:
        """The number of joints."""
        return len(self.names)

    @cached_property
    def low(self) -> FloatArray:
        """Where samples start, (n,): `lower`, -pi for continuous joints, never infinite."""
        return np.where(self.continuous, -math.pi, np.maximum(self.lower, -_TURN))

    @cached_property
    def high(self) -> FloatArray:
        """Where samples end, (n,): `upper`, pi for continuous joints, never infinite."""
        return np.where(self.continuous, math.pi, np.minimum(self.upper, _TURN))

    @cached_property
    def extent(self) -> float:
        """The largest distance between two configurations, which OMPL calls maximum extent."""
        reach = np.where(self.continuous, math.pi, self.high - self.low)
        return float(np.linalg.norm(reach))

    @cached_property
    def width(self) -> FloatArray:
        """How wide the range of samples is, (n,)."""
        return self.high - self.low

    @cached_property
    def _turns(self) -> bool:
        return bool(self.continuous.any())

    def between(self, start: FloatArray, goal: FloatArray) -> FloatArray:
        """Return goal - start, (n,), continuous joints the short way round."""
        step = goal - start
        if self._turns:
            turned = (step + math.pi) % _TURN - math.pi
            step = np.where(self.continuous, turned, step)
        return step

    def distance(self, start: FloatArray, goal: FloatArray) -> float:
        """Return the Euclidean distance of two (n,), continuous joints the short way round."""
        return float(np.linalg.norm(self.between(start, goal)))

    def sample(self, rng: np.random.Generator) -> FloatArray:
        """Return a configuration (n,) drawn uniformly from within the limits."""
        return self.low + self.width * rng.random(self.size)

    def outside(self, q: FloatArray, tolerance: float = 0.0) -> tuple[str, ...]:
        """Return one sentence per joint of `q` (n,) outside its limits by more than `tolerance`."""
        beyond = np.maximum(self.lower - q, q - self.upper)
        wrong = ~self.continuous & ~(beyond <= tolerance)
        return tuple(
            f"joint '{self.names[i]}' is at {q[i]:.6g}, outside [{self.lower[i]:.6g}, "
            f"{self.upper[i]:.6g}]"
            for i in np.flatnonzero(wrong)
        )

    def clamped(self, q: FloatArray) -> FloatArray:
        """Return `q` (n,) with every joint that is not continuous moved into its limits."""
        return np.where(self.continuous, q, np.clip(q, self.lower, self.upper))

    def restricted(self, lower: FloatArray, upper: FloatArray) -> JointSpace:
        """Return the space with narrower limits; a continuous joint that gets some is bounded.

        Args:
            lower: (n,), new lower limits, -inf where nothing is asked.
            upper: (n,), new upper limits, inf where nothing is asked.

        Raises:
            ValueError: nothing is left of a joint's range.
        """
        bounded = self.continuous & (np.isfinite(lower) | np.isfinite(upper))
        own_lower = np.where(self.continuous, -np.inf, self.lower)
        own_upper = np.where(self.continuous, np.inf, self.upper)
        return replace(
            self,
            lower=np.maximum(own_lower, lower),
            upper=np.minimum(own_upper, upper),
            continuous=self.continuous & ~bounded,
        )

    def array(self, values: Sequence[float] | FloatArray | dict[str, float]) -> FloatArray:
        """Return a configuration (n,), from numbers in order or from a value per name.

        Raises:
            ValueError: a number is missing, too many or not finite.
        """
        if isinstance(values, dict):
            missing = [name for name in self.names if name not in values]
            if missing:
                raise ValueError(f"no position is given for {_listed(missing)}")
            values = [values[name] for name in self.names]
        q = np.asarray(values, dtype=np.float64)
        if q.shape != (self.size,):
            raise ValueError(f"{q.size} positions for {self.size} joints ({_listed(self.names)})")
        if not np.isfinite(q).all():
            wrong = [self.names[i] for i in np.flatnonzero(~np.isfinite(q))]
            raise ValueError(f"the position of {_listed(wrong)} is not a finite number")
        return q


def _set_array(space: JointSpace, field: str, kind: Any) -> None:
    values = np.array(getattr(space, field), dtype=kind)
    if values.shape != (len(space.names),):
        raise ValueError(f"{field} has shape {values.shape}, there are {len(space.names)} joints")
    values.flags.writeable = False
    object.__setattr__(space, field, values)


def _listed(names: Iterable[str]) -> str:
    return ", ".join(f"'{name}'" for name in names)
