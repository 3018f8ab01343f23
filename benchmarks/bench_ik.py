"""Speed of inverse kinematics and of collision checks for three arms.

500 random reachable poses an arm, each from a random seed: the share that is solved (wanted: 99 %
at least), CPU milliseconds (wanted: a median of 1 at most) and the largest error. Then CPU
microseconds of a collision check at 5000 random configurations, in an empty scene and among ten
obstacles. LUCK is left out where the sample workspaces are missing.
"""

from __future__ import annotations

import statistics
import sys
import time
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1]))

from tests.motion.problems import REACHES_M, robot_named

from gazelle.description.model import Box, Sphere
from gazelle.geometry import Pose
from gazelle.motion.collision import CollisionChecker
from gazelle.motion.kinematics import Solver, warm_up
from gazelle.motion.model import RobotModel
from gazelle.motion.scene import PlanningScene, WorldObject

_POSES = 500
_CHECKS = 5000
_OBSTACLES = 10


def main() -> None:
    """Print two tables."""
    warm_up()
    robots: dict[str, RobotModel] = {}
    for name in REACHES_M:
        try:
            robots[name] = robot_named(name)
        except (AssertionError, OSError) as error:
            print(f"{name}: left out ({type(error).__name__})")
    print(
        f"{'inverse kinematics':20}{'solved':>9}{'median':>9}{'p99':>9}{'worst':>9} ms{'error':>12}"
    )
    for name, robot in robots.items():
        _kinematics(name, Solver(robot, next(iter(robot.groups))))
    print(f"{'collision checks':20}{'solids':>9}{'free':>9}{'empty':>9}{'ten':>9} us")
    for name, robot in robots.items():
        _collisions(name, robot, REACHES_M[name])


def _kinematics(name: str, solver: Solver) -> None:
    rng, space = np.random.default_rng(1), solver.group.space
    times_ms, errors = [], []
    for _ in range(_POSES):
        pose, seed = solver.fk(space.sample(rng)), space.sample(rng)
        began = time.process_time()
        q = solver.ik(pose, seed_q=seed, rng=rng)
        times_ms.append(1e3 * (time.process_time() - began))
        if q is not None:
            errors.append(float(np.abs(solver.fk(q) - pose).max()))
    worst = (statistics.median(times_ms), float(np.percentile(times_ms, 99)), max(times_ms))
    figures = "".join(f"{value:9.3f}" for value in worst)
    print(f"{name:20}{100 * len(errors) / _POSES:8.1f}%{figures}   {max(errors):12.1e}")


def _collisions(name: str, robot: RobotModel, reach_m: float) -> None:
    rng = np.random.default_rng(2)
    scene = PlanningScene.of(robot)
    empty = CollisionChecker(scene, next(iter(robot.groups)))
    for number in range(_OBSTACLES):
        place = Pose(tuple(rng.uniform(-reach_m, reach_m, 3).tolist()))
        shape = Sphere(0.08) if number % 2 else Box((0.15, 0.1, 0.2))
        scene = scene.with_object(WorldObject.single(f"thing {number}", shape, place))
    full = empty.follow(scene)
    assert empty.group is not None
    states = [empty.group.space.sample(rng) for _ in range(_CHECKS)]
    free = sum(empty.is_valid(q) for q in states) / _CHECKS
    figures = "".join(f"{_cost_us(checker, states):9.1f}" for checker in (empty, full))
    solids = sum(len(link.collisions) for link in robot.description.links)
    print(f"{name:20}{solids:9d}{100 * free:8.1f}%{figures}")


def _cost_us(checker: CollisionChecker, states: list[np.ndarray]) -> float:
    began = time.process_time()
    for q in states:
        checker.is_valid(q)
    return 1e6 * (time.process_time() - began) / len(states)


if __name__ == "__main__":
    main()
