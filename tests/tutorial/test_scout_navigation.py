"""The example maps its workshop, finds itself and drives to goals: what T8–T10 print."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.patience import stretched

from gazelle.diagnostics import Diagnostics
from gazelle.graph.actions import ActionClient
from gazelle.interfaces import fill, message_type, to_plain
from gazelle.mapping.grids import OccupancyGrid, read_map

pytestmark = [pytest.mark.tutorial, pytest.mark.slow(13)]

_WORKSPACE = Path(__file__).parents[2] / "examples" / "scout_ws"
_FACTOR = 2.0
# The room's inner walls, the ball and half a cell.
_WALL_X_M, _WALL_Y_M = 4.0, 3.0
_BALL_M, _BALL_RADIUS_M = (-2.0, 1.0), 0.3
_CELL_M = 0.05
_GOAL = (1.2, 0.3, math.pi / 2)


def test_scout_maps_its_workshop_and_drives_to_a_goal(
    gazelle: Callable[..., Any], free_port: int, tmp_path: Path
) -> None:
    world = gazelle("roslaunch", "scout_robot", "scout.launch", cwd=_WORKSPACE)
    world.wait_for_line("spawn_scout.*finished cleanly")
    _hurry(world)

    slam = gazelle("roslaunch", "scout_robot", "map.launch", cwd=_WORKSPACE, port=free_port)
    maps: list[Any] = []
    world.node.create_subscription("/map", "nav_msgs/msg/OccupancyGrid", maps.append)
    world.eventually(lambda: maps)
    first = _known(maps[0])
    _drive(world, 0.3, 0.4, until=lambda: _truth(world)[2] > 1.0)
    world.eventually(lambda: _known(maps[-1]) > first)
    _drive(world, 0.0, -0.8, until=lambda: _truth(world)[2] < 0.0)
    saver = gazelle(
        "rosrun", "map_server", "map_saver", "-f", str(tmp_path / "map"), cwd=_WORKSPACE
    )
    assert saver.wait() == 0, saver.text
    assert slam.stop() == 0, slam.text
    grid = read_map(tmp_path / "map.yaml", Diagnostics())
    assert grid is not None
    _check_walls(grid)

    x, y, yaw = _truth(world)
    navigation = gazelle(
        "roslaunch", "scout_robot", "navigate.launch", f"map_file:={tmp_path / 'map.yaml'}",
        f"x:={x + 0.1}", f"y:={y - 0.1}", f"yaw:={yaw + 0.1}",
        cwd=_WORKSPACE, port=free_port,
    )  # fmt: skip
    client = ActionClient(world.node, "/move_base", "move_base_msgs/MoveBase")
    assert _send(world, client, _GOAL) == "Goal reached."
    x, y, yaw = _truth(world)
    assert math.hypot(x - _GOAL[0], y - _GOAL[1]) < 0.2
    assert abs(math.remainder(yaw - _GOAL[2], math.tau)) < 0.4
    assert navigation.stop() == 0, navigation.text


def _hurry(world: Any) -> None:
    kind = "gazebo_msgs/srv/{}PhysicsProperties"
    now = to_plain(world.call("/gazebo/get_physics_properties", kind.format("Get")))
    kept = {name: now[name] for name in ("time_step", "gravity", "ode_config")}
    rate_hz = _FACTOR / now["time_step"]
    set_ = world.call(
        "/gazebo/set_physics_properties", kind.format("Set"), max_update_rate=rate_hz, **kept
    )
    assert set_.success


def _truth(world: Any) -> tuple[float, float, float]:
    answer = world.call(
        "/gazebo/get_model_state", "gazebo_msgs/srv/GetModelState", model_name="scout"
    )
    place, turn = answer.pose.position, answer.pose.orientation
    return place.x, place.y, 2 * math.atan2(turn.z, turn.w)


def _drive(world: Any, speed: float, turn: float, *, until: Callable[[], bool]) -> None:
    out = world.publish(
        "/cmd_vel", "geometry_msgs/msg/Twist", linear={"x": speed}, angular={"z": turn}
    )
    world.eventually(until)
    out.publish(message_type("geometry_msgs/msg/Twist")())
    out.unregister()


def _known(message: Any) -> int:
    return int(np.count_nonzero(np.asarray(message.data) >= 0))


def _check_walls(grid: OccupancyGrid) -> None:
    """What is occupied lies on walls or things; each wall is there."""
    rows, columns = np.nonzero(grid.cells > 50)
    x, y = (np.asarray(one) for one in grid.cell_to_world(columns, rows))
    at_wall = (np.abs(np.abs(x) - _WALL_X_M) < 2 * _CELL_M) | (
        np.abs(np.abs(y) - _WALL_Y_M) < 2 * _CELL_M
    )
    for wall in (x > 3.9, x < -3.9, y > 2.9, y < -2.9):
        assert np.count_nonzero(at_wall & wall) > 40
    at_ball = np.hypot(x - _BALL_M[0], y - _BALL_M[1])
    near = at_ball < 0.6
    assert np.count_nonzero(near) > 5
    assert np.median(at_ball[near]) == pytest.approx(_BALL_RADIUS_M, abs=0.08)
    inside = (np.abs(x) < _WALL_X_M + 0.15) & (np.abs(y) < _WALL_Y_M + 0.15)
    assert np.mean(inside) > 0.98


def _send(world: Any, client: ActionClient, goal: tuple[float, float, float]) -> str:
    assert client.wait_for_server(stretched())
    message = client.types.Goal()
    x, y, yaw = goal
    fill(message.target_pose, {
        "header": {"frame_id": "map"},
        "pose": {
            "position": {"x": x, "y": y},
            "orientation": {"z": math.sin(yaw / 2), "w": math.cos(yaw / 2)},
        },
    })  # fmt: skip
    sent = client.send_goal(message)
    world.eventually(
        lambda: sent.is_done,
    )
    return str(sent.text)
