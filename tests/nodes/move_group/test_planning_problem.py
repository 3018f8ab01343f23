"""What move_group keeps for requests."""

from __future__ import annotations

from typing import Any

import pytest
from tests.nodes.move_group.conftest import ARM_WS

from gazelle.description.moveit import read_moveit_config
from gazelle.diagnostics import Diagnostics
from gazelle.motion.model import RobotModel
from gazelle.motion.planning import rrt_connect
from gazelle.motion.scene import PlanningScene
from gazelle.nodes.move_group.planning_problem import ProblemMaker


def test_kernels_of_planning_are_there_before_the_first_request(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    told = Diagnostics()
    config = read_moveit_config(ARM_WS / "src" / "heron_moveit_config", diagnostics=told)
    assert config is not None, [str(item) for item in told]
    robot = RobotModel.from_config(config, diagnostics=told)
    kernel, draws = rrt_connect.connect_trees, []

    def connect_trees(*arguments: Any) -> Any:
        draws.append(len(arguments[2].chances))
        return kernel(*arguments)

    monkeypatch.setattr(rrt_connect, "connect_trees", connect_trees)
    ProblemMaker(config, robot).warm_up(PlanningScene.of(robot))
    # One call a group, and nothing is searched for.
    assert draws == [0] * len(robot.groups)
