"""Goal constraints: configurations that satisfy them, drawn as MoveIt's samplers draw them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from gazelle.motion.constraints import (
    JointConstraint,
    OrientationConstraint,
    PathConstraint,
    PositionConstraint,
)
from gazelle.motion.constraints.kinematic_constraints import matrix_of
from gazelle.motion.joint_space import FloatArray, Validity
from gazelle.motion.kinematics import Patience, Solver

__all__ = ["Goal", "GoalSampler"]

_SLACK = 1e-5
_WITH_VALIDITY = 8
_ALONE = 40


@dataclass(frozen=True)
class Goal:
    """The constraints of one goal; all of them must hold.

    Attributes:
        constraints: of joints and links.
        size: number of the group's variables.
    """

    constraints: tuple[PathConstraint, ...]
    size: int

    @property
    def joints(self) -> tuple[JointConstraint, ...]:
        """Its joint constraints."""
        return tuple(one for one in self.constraints if isinstance(one, JointConstraint))

    @property
    def is_exact(self) -> bool:
        """Whether it says where each joint shall be, and nothing else."""
        indices = {one.index for one in self.joints}
        return len(indices) == self.size and len(self.joints) == len(self.constraints)

    @property
    def centre(self) -> FloatArray:
        """The configuration that an exact goal asks for, rad and m, (`size`,)."""
        q = np.zeros(self.size)
        for one in self.joints:
            q[one.index] = one.position
        return q

    def is_met(self, q: FloatArray) -> bool:
        """Return whether all constraints hold at a configuration, rad and m, (`size`,)."""
        return all((np.abs(one.excess(q)) <= _SLACK).all() for one in self.constraints)

    def told(self) -> str:
        """Return what is asked of links, in words."""
        parts = []
        for one in self.constraints:
            if isinstance(one, PositionConstraint):
                x, y, z = one.regions[0].pose[:3, 3]
                parts.append(f"link '{one.link}' at ({x:.3f}, {y:.3f}, {z:.3f}) m")
            elif isinstance(one, OrientationConstraint):
                parts.append(f"the orientation asked of link '{one.link}'")
        return " with ".join(parts)


@dataclass
class GoalSampler:
    """Draws configurations that meet one of several goals, see `gazelle.motion.planning.plan`.

    Attributes:
        goals: any of them will do.
        solver: inverse kinematics of the group.
        seed_q: where inverse kinematics starts first: where the robot is.
        validity: prefers configurations that it allows.
    """

    goals: Sequence[Goal]
    solver: Solver
    seed_q: FloatArray
    validity: Validity
    _draws: dict[int, int] = field(default_factory=dict)
    _turn: int = 0

    def __call__(self, rng: np.random.Generator) -> FloatArray | None:
        """Return a configuration, or None where this draw found none."""
        number = self._turn % len(self.goals)
        self._turn += 1
        goal = self.goals[number]
        count = self._draws.get(number, 0)
        self._draws[number] = count + 1
        q = self._drawn(goal, count, rng)
        return q if q is not None and goal.is_met(q) else None

    def _drawn(self, goal: Goal, count: int, rng: np.random.Generator) -> FloatArray | None:
        positions = [one for one in goal.constraints if isinstance(one, PositionConstraint)]
        turns = [one for one in goal.constraints if isinstance(one, OrientationConstraint)]
        if not positions and not turns:
            return self._joints(goal, count, rng)
        link = (positions or turns)[0].link
        turn = next((one for one in turns if one.link == link), None)
        target = np.eye(4)
        if turn is not None:
            target[:3, :3] = _rotation(turn, count, rng)
        if positions:
            at = positions[0]
            region = at.regions[count % len(at.regions)]
            point = region.pose[:3, 3] if count < len(at.regions) else region.sample(rng)
            target[:3, 3] = point - target[:3, :3] @ np.array(at.offset_m)
        else:
            some = self.solver.group.space.sample(rng)
            target[:3, 3] = self.solver.fk(self.seed_q if not count else some, link)[:3, 3]
        return self._solved(target, link, position_only=turn is None, count=count, rng=rng)

    def _joints(self, goal: Goal, count: int, rng: np.random.Generator) -> FloatArray:
        """Joints within their tolerances, others where they are first and then anywhere."""
        q = self.solver.group.space.sample(rng) if count else self.seed_q.copy()
        for one in goal.joints:
            low, high = -one.tolerance_below, one.tolerance_above
            q[one.index] = one.position + (rng.uniform(low, high) if count else 0.0)
        return q

    def _solved(
        self,
        target: FloatArray,
        link: str,
        *,
        position_only: bool,
        count: int,
        rng: np.random.Generator,
    ) -> FloatArray | None:
        seed = self.solver.group.space.sample(rng) if count else self.seed_q
        for validity, attempts in ((self.validity, _WITH_VALIDITY), (None, _ALONE)):
            q = self.solver.ik(
                target,
                seed_q=seed,
                patience=Patience(attempts=attempts),
                validity=validity,
                rng=rng,
                link=link,
                position_only=position_only or None,
            )
            if q is not None:
                return q
        return None


def _rotation(turn: OrientationConstraint, count: int, rng: np.random.Generator) -> FloatArray:
    if not count:
        return turn.orientation
    angles = rng.uniform(-1.0, 1.0, 3) * np.minimum(turn.tolerance_rad, np.pi)
    drawn: FloatArray = turn.orientation @ matrix_of(angles, turn.parameterization)
    return drawn
