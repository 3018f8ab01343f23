"""SLAM and navigation at once: a goal beyond the map is reached, and the map has grown."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from tests.patience import eventually, stretched

from gazelle.graph.actions import ActionClient
from gazelle.interfaces import fill, to_plain

pytestmark = [pytest.mark.tutorial, pytest.mark.slow(15)]

# In the room behind the wall, which the lidar does not see from where the robot starts.
_GOAL_M = (3.0, 1.4)
_FACTOR = 3.0
_UNKNOWN = -1


def test_a_goal_that_the_map_does_not_show_yet_is_reached(
    gazelle: Callable[..., Any], tmp_path: Path
) -> None:
    world = gazelle("ros2", "launch", "surveyor_robot", "mapping.launch.py", cwd=tmp_path)
    maps: list[Any] = []
    world.node.create_subscription("/map", "nav_msgs/msg/OccupancyGrid", maps.append)
    world.eventually(lambda: maps)
    _hurry(world)
    client = ActionClient(world.node, "/navigate_to_pose", "nav2_msgs/NavigateToPose")
    assert client.wait_for_server(stretched())
    assert _at_goal(maps[0]) == _UNKNOWN
    goal = client.types.Goal()
    place = {"position": {"x": _GOAL_M[0], "y": _GOAL_M[1]}, "orientation": {"w": 1.0}}
    fill(goal.pose, {"header": {"frame_id": "map"}, "pose": place})
    sent = world.eventually(lambda: _accepted(client, goal))
    world.eventually(lambda: sent.is_done)
    answer = world.call(
        "/gazebo/get_model_state", "gazebo_msgs/srv/GetModelState", model_name="surveyor"
    )
    at = answer.pose.position
    assert math.dist((at.x, at.y), _GOAL_M) < 0.35
    assert _known(maps[-1]) > 1.1 * _known(maps[0])
    assert world.stop() == 0


def _accepted(client: ActionClient, goal: Any) -> Any:
    """Return a goal that was taken, None while Nav2 is not active."""
    sent = client.send_goal(goal)
    eventually(lambda: sent.is_accepted or sent.is_done)
    return sent if sent.is_accepted else None


def _at_goal(message: Any) -> int:
    """Return what a map says of the cell of the goal; what is beyond it is unknown."""
    info = message.info
    origin = info.origin.position.x, info.origin.position.y
    column, row = (
        int((at - begin) / info.resolution) for at, begin in zip(_GOAL_M, origin, strict=True)
    )
    if not (0 <= column < info.width and 0 <= row < info.height):
        return _UNKNOWN
    return int(message.data[row * info.width + column])


def _known(message: Any) -> int:
    return sum(1 for cell in message.data if cell != _UNKNOWN)


def _hurry(world: Any) -> None:
    kind = "gazebo_msgs/srv/{}PhysicsProperties"
    now = to_plain(world.call("/gazebo/get_physics_properties", kind.format("Get")))
    kept = {name: now[name] for name in ("time_step", "gravity", "ode_config")}
    rate_hz = _FACTOR / now["time_step"]
    assert world.call(
        "/gazebo/set_physics_properties", kind.format("Set"), max_update_rate=rate_hz, **kept
    ).success
