"""Smoother paths and smoother commands."""

from __future__ import annotations

import numpy as np
import pytest
from tests.patience import stretched

from gazelle.graph.actions import ActionClient
from gazelle.interfaces import message_type
from gazelle.navigation.costmap import CostGrid
from gazelle.nodes.nav2.smoother_server import smoothed
from gazelle.nodes.nav2.velocity_smoother import limited

_WEIGHTS = {"w_data": 0.2, "w_smooth": 0.3, "tolerance_m": 1e-10, "most": 1000}


def _zigzag() -> np.ndarray:
    return np.column_stack([np.arange(11) * 0.1, 0.1 * (np.arange(11) % 2)])


def test_smoothing_keeps_the_ends_and_shortens_the_path() -> None:
    path = _zigzag()
    found = smoothed(path, **_WEIGHTS)
    np.testing.assert_array_equal(found[[0, -1]], path[[0, -1]])
    assert np.hypot(*np.diff(found, axis=0).T).sum() < np.hypot(*np.diff(path, axis=0).T).sum()
    # Where it ends, both forces are in balance.
    pull = 0.2 * (path - found)[1:-1] + 0.3 * (found[2:] + found[:-2] - 2 * found[1:-1])
    assert np.abs(pull).max() < 1e-8


def test_smoothing_does_not_lead_through_obstacles() -> None:
    costs = np.zeros((20, 20), np.uint8)
    costs[0, 5] = 254
    grid = CostGrid(costs, 0.1, (0.0, 0.0))
    corner = np.array([[0.05, 0.05], [0.05, 0.55], [1.05, 0.55], [1.05, 0.05]])
    found = smoothed(corner, **_WEIGHTS, grid=grid)
    assert all(grid.cost_at(x, y) < 253 for x, y in found)


@pytest.mark.parametrize(
    ("now", "wanted", "expected"),
    [
        ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.1, 0.0, 0.0)),
        ((1.0, 0.0, 0.0), (0.0, 0.0, 0.0), (0.8, 0.0, 0.0)),
        ((0.5, 0.0, 0.0), (0.52, 0.0, 0.0), (0.52, 0.0, 0.0)),
        ((-1.0, 0.0, 0.0), (1.0, 0.0, 0.0), (-0.8, 0.0, 0.0)),
    ],
)
def test_commands_change_by_the_acceleration(now, wanted, expected) -> None:
    up, down = (1.0, 1.0, 1.0), (-2.0, -2.0, -2.0)
    found = limited(now, wanted, up, down, 0.1, keeps_shape=False)
    assert found == pytest.approx(expected)


def test_scaled_commands_keep_their_direction() -> None:
    up = down = (1.0, 1.0, 10.0)
    found = limited((0.0, 0.0, 0.0), (1.0, 0.0, 2.0), up, down, 0.1, keeps_shape=True)
    assert found == pytest.approx((0.1, 0.0, 0.2))


def _bring_up(bench, name: str) -> None:
    kind = "lifecycle_msgs/srv/ChangeState"
    transition = message_type("lifecycle_msgs/msg/Transition")
    for label in ("configure", "activate"):
        request = {"transition": transition(label=label)}
        assert bench.call(f"/{name}/change_state", kind, **request).success


def test_smoother_server_answers(bench) -> None:
    bench.start("nav2_smoother/smoother_server")
    _bring_up(bench, "smoother_server")
    client = ActionClient(bench.node, "smooth_path", "nav2_msgs/SmoothPath", ros_version=2)
    client.require_server(stretched(10.0))
    pose = message_type("geometry_msgs/msg/PoseStamped")
    path = message_type("nav_msgs/msg/Path")()
    path.header.frame_id = "map"
    for x, y in _zigzag():
        one = pose()
        one.pose.position.x, one.pose.position.y = float(x), float(y)
        path.poses.append(one)
    goal = client.send_goal(client.types.Goal(path=path))
    bench.eventually(lambda: goal.is_done)
    assert goal.result.was_completed
    assert goal.result.path.poses[5].pose.position.y < 0.09
    goal = client.send_goal(client.types.Goal(path=path, smoother_id="none"))
    bench.eventually(lambda: goal.is_done)
    assert goal.result.error_code == 501
    assert "Smoother names are: simple_smoother" in goal.result.error_msg


def test_velocity_smoother_ramps_and_stops(bench) -> None:
    out = bench.node.create_publisher("/cmd_vel", "geometry_msgs/msg/Twist")
    words = ("-p", "velocity_timeout:=0.3", "-p", "smoothing_frequency:=50.0")
    bench.start("nav2_velocity_smoother/velocity_smoother", "--ros-args", *words)
    _bring_up(bench, "velocity_smoother")
    sent = bench.listen("/cmd_vel_smoothed", "geometry_msgs/msg/Twist")
    bench.eventually(lambda: out.matched)
    twist = out.message_class()
    twist.linear.x = 5.0
    out.publish(twist)
    bench.eventually(lambda: sent and sent[-1].linear.x == 0.5)
    speeds = [one.linear.x for one in sent]
    assert max(np.diff(speeds)) <= 2.5 / 50 + 1e-9
    bench.eventually(lambda: sent[-1].linear.x == 0.0)
