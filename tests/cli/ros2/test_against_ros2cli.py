"""Outputs of the real ros2cli (0.36.1, with rclpy 9.1.2), command by command."""

from __future__ import annotations

import json
import shlex
from pathlib import Path
from typing import Any

import pytest

from gazelle.graph import Node
from gazelle.interfaces import fill, message_type, service_type

_RECORDED = json.loads((Path(__file__).parent / "recorded.json").read_text(encoding="utf-8"))
_WAITING = "Waiting for at least 1 matching subscription(s)...\n"
_LATCHED: tuple[tuple[str, str, dict[str, Any]], ...] = (
    (
        "/diag",
        "diagnostic_msgs/msg/DiagnosticArray",
        {
            "status": [
                {"level": 1, "name": "übel: a", "values": [{"key": "", "value": "x"}]},
                {},
            ]
        },
    ),
    (
        "/scan",
        "sensor_msgs/msg/LaserScan",
        {
            "header": {"frame_id": "laser"},
            "ranges": [float("inf"), 0.1, float("nan"), 1.5, 1.5, 1.5, 1.5],
            "angle_min": -3.1415,
        },
    ),
    ("/imu", "sensor_msgs/msg/Imu", {"orientation_covariance": [0.1] * 9}),
    (
        "/joints",
        "sensor_msgs/msg/JointState",
        {"name": ["a", "b"], "position": [0.1, 1e-7], "velocity": [1e22]},
    ),
    ("/text", "std_msgs/msg/String", {"data": 'line\n"two" ' + "é🦌 " * 4}),
    ("/empty", "std_msgs/msg/String", {}),
    ("/bytes", "std_msgs/msg/ByteMultiArray", {"data": [0, 97]}),
    ("/float", "std_msgs/msg/Float32", {"data": 0.1}),
    (
        "/image",
        "sensor_msgs/msg/Image",
        {"height": 2, "width": 2, "encoding": "rgb8", "data": list(range(12))},
    ),
)


@pytest.fixture
def demo(robot: Node) -> Node:
    """The node that the recording was made of, as far as these commands see it."""
    switch = service_type("std_srvs/srv/SetBool")

    def answer(request: Any) -> Any:
        text = "it's on" if request.data else ""
        return switch.Response(success=request.data, message=text)

    robot.create_service("/switch", switch, answer)
    robot.create_subscription("/cmd_vel", "geometry_msgs/msg/Twist", lambda _: None)
    robot.create_publisher("/sensor", "std_msgs/msg/Float32", reliable=False, queue_size=5)
    for topic, kind, values in _LATCHED:
        message = message_type(kind)()
        fill(message, values)
        robot.create_publisher(topic, kind, latch=True, queue_size=1).publish(message)
    return robot


@pytest.mark.reference
def test_outputs_are_those_of_ros2cli(demo: Node, run: Any) -> None:
    wrong = []
    for words, (code, text, error) in _RECORDED.items():
        found = run("ros2", *shlex.split(words))
        # What we find more is told behind the original's words; whether somebody has to be waited
        # for depends on the machine.
        out = found.out.removeprefix(_WAITING) if "/cmd_vel" in words else found.out
        if (found.code, out) != (code, text) or not found.err.startswith(error):
            wrong.append(f"{words}\nros2cli: {code} {text}{error}\nhere: {found}")
    assert not wrong, "\n\n".join(wrong)
