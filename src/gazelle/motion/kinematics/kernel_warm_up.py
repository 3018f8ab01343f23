"""Compiled kernels before they are needed."""

from __future__ import annotations

import numpy as np

from gazelle.description.model import Joint, JointAxis, JointType, Link, Model
from gazelle.description.srdf import Group, Srdf
from gazelle.diagnostics import Diagnostics
from gazelle.motion.kinematics.solver import Solver, link_poses
from gazelle.motion.model import RobotModel

__all__ = ["warm_up"]


def warm_up() -> None:
    """Compile or load the kernels of kinematics, which takes some seconds the first time.

    Programs call it in a thread while they start, so that the first request does not wait.
    """
    joint = Joint("j", JointType.REVOLUTE, "a", "b", axis=JointAxis(lower=-1.0, upper=1.0))
    model = Model("warm", links=(Link("a"), Link("b")), joints=(joint,))
    srdf = Srdf("warm", groups=(Group("g", joints=("j",)),))
    robot = RobotModel.build(model, srdf, diagnostics=Diagnostics())
    solver = Solver(robot, "g")
    solver.ik(solver.fk(np.zeros(1)), seed_q=np.zeros(1))
    solver.jacobian(np.zeros(1))
    link_poses(robot, robot.default_positions())
