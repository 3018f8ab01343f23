"""The controllers of MoveIt 1's demo.launch, which drive nothing."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
from tests.nodes.move_group.conftest import JOINTS, READY, ArmBench, joint_goal, parameters


def _fake(kind: str) -> dict[str, Any]:
    row = {"name": "fake_arm_controller", "type": kind, "joints": JOINTS}
    known = [key for key in parameters() if key.startswith("moveit_")]
    return {
        **dict.fromkeys(known, ""),
        "moveit_controller_manager": "moveit_fake_controller_manager/MoveItFakeControllerManager",
        "controller_list": [row],
        "initial": [{"group": "arm", "pose": "ready"}],
    }


@pytest.mark.parametrize(
    ("kind", "least", "most"), [("interpolate", 8, 60), ("via points", 8, 60), ("last point", 1, 1)]
)
def test_fake_controllers_tell_where_the_joints_would_be(
    make_arm: Callable[..., ArmBench], kind: str, least: int, most: int
) -> None:
    arm = make_arm(1, **_fake(kind))
    told = arm.bench.listen(
        "/move_group/fake_controller_joint_states", "sensor_msgs/msg/JointState"
    )
    arm.bench.eventually(lambda: told)
    begin = dict(zip(told[0].name, told[0].position, strict=True))
    assert [begin[name] for name in JOINTS] == pytest.approx(READY, abs=1e-6)
    goal = [0.8, *READY[1:]]
    assert arm.move(goal_constraints=joint_goal(goal)).error_code.val == 1
    arm.bench.eventually(lambda: told[-1].position[0] == pytest.approx(0.8, abs=1e-3))
    assert least <= len(told) - 1 <= most
    assert list(told[-1].position) == pytest.approx(goal, abs=1e-3)
