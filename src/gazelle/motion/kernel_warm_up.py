"""Compiled kernels of motion planning before they are needed."""

from __future__ import annotations

import numpy as np

from gazelle.description.model import Box, Collision, Joint, JointAxis, JointType, Link, Model
from gazelle.description.srdf import Group, Srdf
from gazelle.diagnostics import Diagnostics
from gazelle.geometry import Pose
from gazelle.motion import kinematics
from gazelle.motion.collision import CollisionChecker
from gazelle.motion.collision.gjk_kernels import outside_m
from gazelle.motion.model import RobotModel
from gazelle.motion.planning import warm_up as warm_up_planning
from gazelle.motion.scene import PlanningScene, WorldObject

__all__ = ["warm_up"]


def warm_up() -> None:
    """Compile or load all kernels of kinematics, collision and planning."""
    kinematics.warm_up()
    robot = _robot()
    box = WorldObject.single("box", Box((0.1, 0.1, 0.1)), Pose((3.0, 0.0, 0.0)))
    checker = CollisionChecker(PlanningScene.of(robot).with_object(box), "g")
    space = robot.group("g").space
    warm_up_planning(space, checker)
    corners = np.zeros((4, 3))
    corners[1:] = np.eye(3)
    outside_m(corners, corners)


def _robot() -> RobotModel:
    """Return an arm of one joint."""
    collision = Collision("c", Box((0.1, 0.1, 0.1)))
    links = (Link("a", collisions=(collision,)), Link("b", collisions=(collision,)))
    joint = Joint(
        "j", JointType.REVOLUTE, "a", "b", T_model_joint=Pose((1.0, 0.0, 0.0)),
        axis=JointAxis(lower=-1.0, upper=1.0),
    )  # fmt: skip
    srdf = Srdf("warm", groups=(Group("g", joints=("j",)),))
    return RobotModel.build(
        Model("warm", links=links, joints=(joint,)), srdf, diagnostics=Diagnostics()
    )
