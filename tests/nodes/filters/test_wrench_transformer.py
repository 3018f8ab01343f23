"""wrench_transformer_node: wrenches in other frames."""

from __future__ import annotations

import threading
from typing import Any

import pytest

from gazelle.errors import LaunchError
from gazelle.interfaces import message_type
from gazelle.nodes.host import run_node

_NODE = "force_torque_sensor_broadcaster/wrench_transformer_node"
_WRENCH = "geometry_msgs/msg/WrenchStamped"


def _turned_about_z(bench: Any) -> Any:
    """Publish that ``tool`` is turned by 90° about z in ``base``."""
    kind: Any = message_type("tf2_msgs/msg/TFMessage")
    transform: Any = message_type("geometry_msgs/msg/TransformStamped")()
    transform.header.frame_id, transform.child_frame_id = "base", "tool"
    transform.transform.rotation.z = transform.transform.rotation.w = 0.5**0.5
    out = bench.node.create_publisher("/tf_static", kind, latch=True)
    out.publish(kind(transforms=[transform]))
    return out


def _wrench(frame: str) -> Any:
    message: Any = message_type(_WRENCH)()
    message.header.frame_id, message.header.stamp.sec = frame, 7
    message.wrench.force.x, message.wrench.torque.z = 2.0, 3.0
    return message


def test_force_and_torque_are_turned_and_stamps_stay(bench: Any) -> None:
    _turned_about_z(bench)
    got = bench.listen("/fts_wrench_transformer/base/wrench", _WRENCH)
    bench.start(_NODE, "--ros-args", "-p", "target_frames:=[base, nowhere]", "-r",
                "~/wrench:=/fts/wrench")  # fmt: skip
    log = bench.listen("/rosout", "rcl_interfaces/msg/Log")
    out = bench.node.create_publisher("/fts/wrench", message_type(_WRENCH))
    bench.eventually(lambda: out.matched)

    def heard() -> Any:
        out.publish(_wrench("tool"))
        return got

    bench.eventually(heard)
    force, torque = got[0].wrench.force, got[0].wrench.torque
    assert (got[0].header.frame_id, got[0].header.stamp.sec) == ("base", 7)
    assert [force.x, force.y, force.z] == pytest.approx([0.0, 2.0, 0.0])
    assert torque.z == pytest.approx(3.0)
    text = "Failed to transform wrench for frame nowhere, skipping publication"
    bench.eventually(lambda: any(text in one.msg for one in log))


def test_filtered_wrenches_have_their_own_topic_below_the_namespace(bench: Any) -> None:
    bench.start(_NODE, "base", "--ros-args", "-r", "__ns:=/arm", "-r",
                "~/wrench:=/fts/wrench_filtered")  # fmt: skip
    got = bench.listen("/arm/base/wrench_filtered", _WRENCH)
    _turned_about_z(bench)
    out = bench.node.create_publisher("/fts/wrench_filtered", message_type(_WRENCH))
    bench.eventually(lambda: out.matched)
    out.publish(_wrench("base"))
    bench.eventually(lambda: got)
    assert got[0].wrench.force.x == 2.0


def test_frames_must_be_named(bench: Any) -> None:
    with pytest.raises(LaunchError, match="parameter 'target_frames': it cannot be empty"):
        run_node({"node": _NODE, "argv": ["--ros-args"]}, bench.graph, threading.Event())
