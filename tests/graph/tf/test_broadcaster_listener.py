from __future__ import annotations

from collections.abc import Callable
from typing import Any

from tests.patience import stretched

from gazelle.geometry import Pose
from gazelle.graph import Graph
from gazelle.graph.tf import (
    StampedPose,
    StaticTransformBroadcaster,
    TransformBroadcaster,
    TransformBuffer,
    TransformListener,
)
from gazelle.interfaces import message_type, ros1_message_type

S = 1_000_000_000
POSE = Pose.from_xyz_rpy((1.0, 2.0, 3.0), (0.1, 0.2, 0.3))


def test_transforms_travel_between_processes(graph: Graph, other: Graph) -> None:
    sender = graph.create_node("sender")
    static = StaticTransformBroadcaster(sender)
    static.send(StampedPose("base", "laser", 0, POSE))
    static.send([StampedPose("base", "camera", 0, POSE), StampedPose("laser", "tip", 0, POSE)])
    buffer = TransformBuffer()
    listener = TransformListener(buffer, other.create_node("listener"))
    assert buffer.can_transform("base", "tip", timeout_s=stretched(30))
    assert buffer.can_transform("base", "camera", timeout_s=stretched(30))
    moving = TransformBroadcaster(sender)
    while not buffer.can_transform("odom", "tip", S, timeout_s=0.01):
        moving.send(StampedPose("odom", "base", S, POSE))
    assert buffer.lookup_transform("odom", "base", S).pose == POSE
    assert {one.name: one.authority for one in buffer.frames()}["base"] == "/sender"
    listener.close()
    moving.close()
    static.close()


def test_all_static_broadcasters_of_a_process_are_heard(graph: Graph, other: Graph) -> None:
    for number in range(5):
        node = graph.create_node(f"static{number}")
        StaticTransformBroadcaster(node).send(StampedPose("base", f"f{number}", 0, POSE))
    buffer = TransformBuffer()
    TransformListener(buffer, other.create_node("listener"))
    for number in range(5):
        assert buffer.can_transform("base", f"f{number}", timeout_s=stretched(30))


def test_messages_of_both_generations_can_be_sent(graph: Graph) -> None:
    node = graph.create_node("n")
    buffer = TransformBuffer()
    TransformListener(buffer, node)
    broadcaster = TransformBroadcaster(node)
    for number, message in enumerate(
        (
            message_type("geometry_msgs/msg/TransformStamped")(),
            ros1_message_type("geometry_msgs/TransformStamped")(),
        )
    ):
        message.header.frame_id = "base"
        message.child_frame_id = f"f{number}"
        message.transform.rotation.w = 1.0
        broadcaster.send(message)
        assert buffer.can_transform("base", f"f{number}", timeout_s=stretched(30))


def test_moving_frames_are_forgotten_when_time_goes_back(
    graph: Graph, eventually: Callable[..., Any]
) -> None:
    graph.parameters.set("/use_sim_time", True)
    node = graph.create_node("n")
    buffer = TransformBuffer()
    TransformListener(buffer, node)
    clock_class = message_type("rosgraph_msgs/msg/Clock")
    clock = node.create_publisher("/clock", clock_class)

    def show(second: int) -> None:
        message = clock_class()
        message.clock.sec = second
        clock.publish(message)

    show(10)
    TransformBroadcaster(node).send(StampedPose("odom", "base", 10 * S, POSE))
    assert buffer.can_transform("odom", "base", timeout_s=stretched(30))
    show(1)
    eventually(lambda: not buffer.can_transform("odom", "base"))
