"""Which pairs of links need not be checked for collision, and why.

As MoveIt's Setup Assistant finds them: neighbours are left out; so is what overlaps when all
joints are at their defaults; what overlaps in nearly all of some random configurations; and what
does in none of many. The same seed gives the same pairs, on any number of threads.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from enum import Enum
from itertools import combinations
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.description.srdf import CollisionPair
from gazelle.diagnostics import Diagnostics
from gazelle.engine.mujoco_library import mujoco
from gazelle.motion.collision.collision_model import (
    CollisionModel,
    build_collision_model,
    collision_bodies,
)
from gazelle.motion.joint_space import BoolArray, FloatArray
from gazelle.motion.model import JointKind, RobotModel
from gazelle.motion.scene import AllowedCollisions, PlanningScene

__all__ = [
    "CollisionMatrix",
    "DisabledReason",
    "LinkPair",
    "random_positions",
    "self_collision_matrix",
]

_FEW_TRIALS = 200
_CHUNK = 250

Progress = Callable[[float], None]


class DisabledReason(Enum):
    """Why a pair is not checked, in MoveIt's words."""

    ADJACENT = "Adjacent"
    DEFAULT = "Default"
    ALWAYS = "Always"
    NEVER = "Never"
    USER = "User"


@dataclass(frozen=True, slots=True)
class LinkPair:
    """Two links and why they are not checked for collision; None when they are.

    Attributes:
        link1: the one whose name comes first.
        link2: the other.
    """

    link1: str
    link2: str
    reason: DisabledReason | None = None


@dataclass(frozen=True)
class CollisionMatrix:
    """All pairs of links that have something to collide with, sorted by name.

    Attributes:
        pairs: every pair once.
        trials: random configurations that were looked at.
        seed: of those.
    """

    pairs: tuple[LinkPair, ...]
    trials: int
    seed: int

    @property
    def links(self) -> tuple[str, ...]:
        """Links with something to collide with, sorted."""
        return tuple(sorted({name for pair in self.pairs for name in (pair.link1, pair.link2)}))

    def count(self, reason: DisabledReason | None) -> int:
        """Return how many pairs there are of a reason; None for those that are checked."""
        return sum(pair.reason is reason for pair in self.pairs)

    def disabled(self) -> tuple[CollisionPair, ...]:
        """Return the pairs that are not checked, as an SRDF has them."""
        return tuple(
            CollisionPair(pair.link1, pair.link2, pair.reason.value)
            for pair in self.pairs
            if pair.reason is not None
        )


def self_collision_matrix(
    robot: RobotModel,
    *,
    trials: int = 10_000,
    always_fraction: float = 0.95,
    include_never: bool = True,
    seed: int = 0,
    progress: Progress | None = None,
    diagnostics: Diagnostics | None = None,
) -> CollisionMatrix:
    """Return all pairs of links, those that need no check with the reason.

    Args:
        robot: the robot; what its SRDF disables plays no part.
        trials: random configurations for `DisabledReason.NEVER`; MoveIt calls it density.
        always_fraction: from this share of collisions on a pair counts as always colliding.
        include_never: look for pairs that never collide.
        seed: of the configurations.
        progress: is told how much is done, 0 to 1; what it raises ends the search.
        diagnostics: receives shapes that cannot be collided.

    Raises:
        ValueError: a number is out of range.
    """
    if trials < 1 or not 0.0 < always_fraction <= 1.0:
        raise ValueError("at least one trial is needed, and a fraction above 0 and up to 1")
    told = Diagnostics() if diagnostics is None else diagnostics
    search = _Search(robot, told, progress or _ignore)
    search.disable_neighbours()
    search.disable_rigid_pairs()
    search.disable_default()
    search.disable_always(always_fraction, seed)
    if include_never:
        search.disable_never(trials, seed)
    search.told(1.0)
    return CollisionMatrix(search.pairs(), trials, seed)


def random_positions(robot: RobotModel, count: int, rng: np.random.Generator) -> FloatArray:
    """Return configurations (count, v) drawn uniformly from within the limits.

    What has no limits stays where it is, angles turn all around; mimicking joints follow.
    """
    values = np.repeat(robot.default_positions()[None], count, axis=0)
    for joint in robot.joints[1:]:
        if not joint.is_active:
            continue
        if joint.kind is JointKind.FLOATING:
            turns = rng.normal(size=(count, 4))
            length = np.linalg.norm(turns, axis=1, keepdims=True)
            values[:, joint.first + 3 : joint.first + 7] = turns / length
            continue
        for place, limit in enumerate(joint.limits, start=joint.first):
            low, high = limit.lower, limit.upper
            if limit.continuous:
                low, high = -np.pi, np.pi
            if np.isfinite(low) and np.isfinite(high):
                values[:, place] = rng.uniform(low, high, count)
    robot.completed(values.T)
    return values


class _Search:
    """The matrix while it grows; links are numbers, pairs have the lower one first."""

    def __init__(self, robot: RobotModel, diagnostics: Diagnostics, told: Progress) -> None:
        self.told = told
        self._robot = robot
        self._diagnostics = diagnostics
        scene = PlanningScene.of(robot).with_allowed(AllowedCollisions())
        self._bodies = collision_bodies(scene, diagnostics)
        self._scene = scene
        self.links = tuple(sorted(body.owner.name for body in self._bodies))
        self._number = {name: number for number, name in enumerate(self.links)}
        size = len(self.links)
        self._reasons: dict[tuple[int, int], DisabledReason] = {}
        self._met = np.zeros((size, size), np.bool_)
        self._checker = self._compiled()

    def pairs(self) -> tuple[LinkPair, ...]:
        return tuple(
            LinkPair(self.links[first], self.links[second], self._reasons.get((first, second)))
            for first, second in combinations(range(len(self.links)), 2)
        )

    def disable_neighbours(self) -> None:
        for first, second in _neighbours(self._robot, frozenset(self.links)):
            self._disable(self._number[first], self._number[second], DisabledReason.ADJACENT)
        self._checker = self._compiled()

    def disable_rigid_pairs(self) -> None:
        """Look at links that nothing moves against each other; MuJoCo leaves them out."""
        for first, second in self._checker.rigid_overlaps():
            self._disable(first, second, DisabledReason.DEFAULT)

    def disable_default(self) -> None:
        found = self._checker.meetings(self._robot.default_positions()[None])[0]
        for first, second in zip(*np.nonzero(found), strict=True):
            self._disable(int(first), int(second), DisabledReason.DEFAULT)
        self._checker = self._compiled()

    def disable_always(self, fraction: float, seed: int) -> None:
        """Repeat as long as something is found, as MoveIt does."""
        rng = np.random.default_rng([seed, 1])
        found = True
        while found:
            configurations = random_positions(self._robot, _FEW_TRIALS, rng)
            counts = self._checker.meetings(configurations).sum(axis=0)
            self._met |= counts > 0
            always = np.argwhere(counts > int(_FEW_TRIALS * fraction))
            for first, second in always:
                self._disable(int(first), int(second), DisabledReason.ALWAYS)
            found = len(always) > 0
            if found:
                self._checker = self._compiled()

    def disable_never(self, trials: int, seed: int) -> None:
        chunks = [min(_CHUNK, trials - start) for start in range(0, trials, _CHUNK)]
        threads = min(len(chunks), os.cpu_count() or 1)

        def met(number: int) -> BoolArray:
            rng = np.random.default_rng([seed, 2, number])
            configurations = random_positions(self._robot, chunks[number], rng)
            return np.asarray(self._checker.copy().meetings(configurations).any(axis=0))

        with ThreadPoolExecutor(threads) as pool:
            try:
                for done, found in enumerate(pool.map(met, range(len(chunks))), start=1):
                    self._met |= found
                    self.told(0.99 * done / len(chunks))
            except BaseException:
                pool.shutdown(cancel_futures=True)
                raise
        for first, second in combinations(range(len(self.links)), 2):
            if not self._met[first, second]:
                self._disable(first, second, DisabledReason.NEVER)

    def _disable(self, first: int, second: int, reason: DisabledReason) -> None:
        self._reasons.setdefault((min(first, second), max(first, second)), reason)

    def _compiled(self) -> _Checker:
        allowed = {frozenset((self.links[a], self.links[b])): True for a, b in self._reasons}
        scene = self._scene.with_allowed(AllowedCollisions(allowed))
        built = build_collision_model(scene, self._bodies, self._diagnostics)
        return _Checker(built, self._number, frozenset(self._reasons))


class _Checker:
    """Says which links overlap; one for each thread."""

    def __init__(
        self,
        built: CollisionModel,
        numbers: dict[str, int],
        disabled: frozenset[tuple[int, int]],
    ) -> None:
        self._built = built
        self._disabled = disabled
        self._numbers = numbers
        self._link: NDArray[np.intp] = np.array(
            [numbers[owner.name] for owner in built.owners], dtype=np.intp
        )
        self._data: Any = mujoco.MjData(built.model)

    def copy(self) -> _Checker:
        return _Checker(self._built, self._numbers, self._disabled)

    def meetings(self, configurations: FloatArray) -> BoolArray:
        """Return (n, links, links), which overlap in each of the configurations (n, v)."""
        model, data, links = self._built.model, self._data, self._link
        size = len(self._numbers)
        met = np.zeros((len(configurations), size, size), np.bool_)
        for number, positions in enumerate(configurations):
            data.qpos[self._built.addresses] = positions
            mujoco.mj_kinematics(model, data)
            mujoco.mj_collision(model, data)
            if data.ncon:
                both = np.sort(links[data.contact.geom], axis=1)
                met[number, both[:, 0], both[:, 1]] = True
        return met

    def rigid_overlaps(self) -> Iterator[tuple[int, int]]:
        model = self._built.model
        weld = model.body_weldid[model.geom_bodyid]
        mujoco.mj_kinematics(model, self._data)
        for first, second in combinations(range(model.ngeom), 2):
            pair = sorted((int(self._link[first]), int(self._link[second])))
            if weld[first] != weld[second] or pair[0] == pair[1] or tuple(pair) in self._disabled:
                continue
            if mujoco.mj_geomDistance(model, self._data, first, second, 0.01, None) < 0:
                yield pair[0], pair[1]


def _neighbours(robot: RobotModel, solid: frozenset[str]) -> set[tuple[str, str]]:
    """Return pairs of links that a joint connects, or joints with links without shapes between."""
    around: dict[str, set[str]] = {link: set() for link in robot.links}
    for joint in robot.joints[1:]:
        around[joint.parent].add(joint.child)
        around[joint.child].add(joint.parent)
    found: set[tuple[str, str]] = set()
    for link in solid:
        seen, waiting = {link}, list(around[link])
        while waiting:
            other = waiting.pop()
            if other in seen:
                continue
            seen.add(other)
            if other in solid:
                found.add((min(link, other), max(link, other)))
            else:
                waiting += around[other]
    return found


def _ignore(_done: float) -> None:
    pass
