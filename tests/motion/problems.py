"""Random problems of arms among ten obstacles, the same ones on every machine."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from gazelle.description.loader import load_models
from gazelle.description.model import Box, Sphere
from gazelle.description.moveit import read_moveit_config
from gazelle.description.srdf import load_srdf
from gazelle.diagnostics import Diagnostics
from gazelle.geometry import Pose
from gazelle.motion.collision import CollisionChecker
from gazelle.motion.joint_space import FloatArray, JointSpace
from gazelle.motion.model import RobotModel
from gazelle.motion.scene import PlanningScene, WorldObject

OBSTACLES = 10
REACHES_M = {"ur_like": 0.9, "seven": 0.9, "luck": 0.7}
"""The robots and how far their arms reach, about."""

_PATIENCE = 2000
_ARMS = Path(__file__).parent / "arms"
_LUCK = Path(__file__).parents[3] / "shared" / "workspaces" / "ros2_ws" / "src" / "luck_robot"


@dataclass(frozen=True)
class Case:
    """One scene with a start and a goal that are free.

    Attributes:
        number: seed of its obstacles.
        space: joints of the group.
        checker: of the scene.
        start: configuration.
        goal: configuration.
    """

    number: int
    space: JointSpace
    checker: CollisionChecker
    start: FloatArray
    goal: FloatArray


def robot_named(name: str) -> RobotModel:
    """Return one of the robots of `REACHES_M`; LUCK needs the sample workspaces."""
    told = Diagnostics()
    if name == "luck":
        config = read_moveit_config(_LUCK, diagnostics=told)
        assert config is not None, [str(item) for item in told]
        return RobotModel.from_config(config, diagnostics=told)
    file = _ARMS / f"{name}.urdf"
    (model,) = load_models(file, workspace=None, diagnostics=told)
    srdf = load_srdf(file.with_suffix(".srdf"), robot=model, workspace=None, diagnostics=told)
    return RobotModel.build(model, srdf, diagnostics=told)


def group_of(name: str) -> str:
    """Return the planning group of a robot."""
    return "test_group" if name == "luck" else "arm"


def case_of(robot: RobotModel, name: str, number: int, start: FloatArray, goal: FloatArray) -> Case:
    """Return a problem whose start and goal were recorded."""
    checker = CollisionChecker(_scene(robot, number, REACHES_M[name]), group_of(name))
    space = robot.group(group_of(name)).space
    return Case(number, space, checker, np.asarray(start), np.asarray(goal))


def random_case(robot: RobotModel, name: str, number: int) -> Case:
    """Return a problem whose start and goal are drawn until they are free."""
    checker = CollisionChecker(_scene(robot, number, REACHES_M[name]), group_of(name))
    rng = np.random.default_rng([2612, number])
    space = robot.group(group_of(name)).space
    free = []
    for _ in range(_PATIENCE):
        # Joints that turn more than once around start and end within half a turn of zero.
        q = np.round(rng.uniform(np.maximum(space.low, -3.1), np.minimum(space.high, 3.1)), 4)
        if checker.is_valid(q):
            free.append(q)
        if len(free) == 2:
            return Case(number, space, checker, free[0], free[1])
    raise AssertionError(f"problem {number} leaves the robot no room")


def _scene(robot: RobotModel, number: int, reach_m: float) -> PlanningScene:
    """Return boxes and spheres around the base, between 40 % of the reach and all of it."""
    rng = np.random.default_rng([2611, number])
    scene = PlanningScene.of(robot)
    for index in range(OBSTACLES):
        distance, angle = rng.uniform(0.4, 1.0) * reach_m, rng.uniform(-math.pi, math.pi)
        height = rng.uniform(0.0, 1.0) * reach_m
        place = (distance * math.cos(angle), distance * math.sin(angle), height)
        shape: Box | Sphere
        if rng.random() < 0.5:
            shape = Sphere(rng.uniform(0.07, 0.14) * reach_m)
        else:
            x, y, z = rng.uniform(0.1, 0.33, 3) * reach_m
            shape = Box((x, y, z))
        item = WorldObject.single(f"obstacle_{index}", shape, Pose(position_m=place))
        scene = scene.with_object(item)
    return scene
