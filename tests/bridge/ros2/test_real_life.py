"""Begin and end of the bridge with the real rclpy."""

from __future__ import annotations

import os
import signal
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from tests.bridge.ros2.real import Ros2, skip_module_without_rclpy
from tests.patience import at_most

from gazelle.bridge.ros2 import Bridge
from gazelle.errors import GraphError
from gazelle.graph import Graph

skip_module_without_rclpy()
pytestmark = pytest.mark.reference
Eventually = Callable[[Callable[[], Any]], Any]
LOOKER = """
node = Node("looker")
while True:
    say(sorted(name for name in node.get_node_names() if name != "looker"))
    time.sleep(0.02)
"""


def _is_running(pid: int) -> bool:
    status = Path(f"/proc/{pid}/stat")
    return status.exists() and status.read_text().rsplit(")")[-1].split()[0] != "Z"


def test_second_bridge_is_refused(bridge: Bridge, make_bridge: Callable[..., Bridge]) -> None:
    with pytest.raises(GraphError, match="a bridge to ROS 2 already runs on this graph"):
        make_bridge()


def test_nodes_leave_ros_with_the_bridge(
    bridge: Bridge, ros2: Ros2, graph: Graph, eventually: Eventually
) -> None:
    graph.create_node("robot")
    program = ros2(LOOKER)
    program.wait_for("['robot', 'ros2_bridge']")
    pid = bridge.about.pid
    bridge.close()
    with at_most(2.0):
        eventually(lambda: program.lines[-1] == "[]")
    assert not _is_running(pid)
    eventually(lambda: graph.node_names() == ("/robot",))


def test_killed_half_is_started_again(
    bridge: Bridge, ros2: Ros2, graph: Graph, eventually: Eventually, notices: Any, inbox: Any
) -> None:
    program = ros2("""
from std_msgs.msg import String
node = Node("mouth")
out = node.create_publisher(String, "/chatter", 10)
node.create_timer(0.05, lambda: out.publish(String(data="from rclpy")))
rclpy.spin(node)
""")
    node = graph.create_node("ears")
    node.create_subscription("/chatter", "std_msgs/msg/String", inbox)
    inbox.wait_for(1)
    pid = bridge.about.pid
    os.kill(pid, signal.SIGKILL)
    eventually(lambda: bridge.about.pid != pid)
    place = len(inbox.items)
    inbox.wait_for(place + 5)
    # The dead half's nodes, in which ROS believes for a while, are not taken for ROS's own.
    eventually(lambda: bridge.nodes == (("/ears", "/listener"), ("/mouth",)))
    assert sorted(graph.node_names()) == ["/ears", "/listener", "/mouth", "/ros2_bridge"]
    assert "has ended (exit code -9); it is started again" in notices.wait_for(1)[0]
    assert program.process.poll() is None


def test_half_ends_with_a_killed_bridge(
    gazelle: Callable[..., Any], ros2_python: str, domain: int, eventually: Eventually
) -> None:
    run = gazelle("bridge", "ros2", "--python", ros2_python, ROS_DOMAIN_ID=str(domain))
    run.wait_for_line(
        rf"^the bridge has joined ROS 2: rmw_\w+, domain {domain}, this machine only$"
    )
    children = Path(f"/proc/{run.popen.pid}/task/{run.popen.pid}/children").read_text().split()
    assert len(children) == 1
    os.kill(run.popen.pid, signal.SIGKILL)
    eventually(lambda: not _is_running(int(children[0])))


def test_bridge_ends_in_peace(gazelle: Callable[..., Any], ros2_python: str, domain: int) -> None:
    run = gazelle("bridge", "ros2", "--python", ros2_python, ROS_DOMAIN_ID=str(domain))
    run.wait_for_line("rclpy of ")
    assert run.stop() == 0
    assert "Traceback" not in run.text


def test_open_network_is_told(gazelle: Callable[..., Any], ros2_python: str, domain: int) -> None:
    run = gazelle(
        "bridge", "ros2", "--python", ros2_python, ROS_DOMAIN_ID=str(domain),
        ROS_AUTOMATIC_DISCOVERY_RANGE="SUBNET",
    )  # fmt: skip
    run.wait_for_line("other machines can reach it, and ROS 2 asks nobody for a password")
    assert run.stop() == 0
