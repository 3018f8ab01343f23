"""The example arm: its launch file, and the program that carries a cube over a wall."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

pytestmark = [pytest.mark.tutorial, pytest.mark.slow]

_WORKSPACE = Path(__file__).parents[2] / "examples" / "arm_ws"


def test_cube_is_carried_over_the_wall_and_missed_the_second_time(
    gazelle: Callable[..., Any], free_port: int
) -> None:
    launched = gazelle("ros2", "launch", "heron_bringup", "heron.launch.py", cwd=_WORKSPACE)
    launched.wait_for_line("You can start planning now!")
    assert _cube(launched) == pytest.approx([0.36, 0.18, 0.12], abs=1e-3)

    run = gazelle("ros2", "run", "heron_bringup", "pick_and_place", cwd=_WORKSPACE, port=free_port)
    run.wait_for_line("the cube is on the other side")
    assert run.wait() == 0
    assert _cube(launched) == pytest.approx([0.36, -0.18, 0.12], abs=0.02)

    again = gazelle("ros2", "run", "heron_bringup", "pick_and_place", cwd=_WORKSPACE)
    again.wait_for_line(
        r"with nothing in it: the cube is not at x = 0.36 m, y = 0.18 m, where this program "
        r"begins; put it back by 'gazelle ros2 service call /reset_world std_srvs/srv/Empty'"
    )
    assert again.wait() == 1
    assert launched.stop() == 0


def _cube(launched: Any) -> list[float]:
    answer = launched.call(
        "/gazebo/get_model_state", "gazebo_msgs/srv/GetModelState", model_name="cube"
    )
    place = answer.pose.position
    return [place.x, place.y, place.z]
