"""Nodes of C++ and of Python send one another frames, and hold messages back for them."""

from __future__ import annotations

import math
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from tests.conftest import Launched, Run
from tests.patience import eventually

from gazelle.cpp.building.toolchain import NoToolchainError, find_toolchain
from gazelle.geometry import Pose
from gazelle.graph import Graph
from gazelle.graph.tf import (
    StampedPose,
    StaticTransformBroadcaster,
    TransformBroadcaster,
    TransformBuffer,
    TransformListener,
)
from gazelle.interfaces import message_type

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="nodes of C++ run on Linux for now")
_PROGRAMS = Path(__file__).parent / "programs"
_LIBRARIES = {1: "tf", 2: "tf2_ros2"}


@pytest.fixture(scope="session", params=[1, 2], ids=["ros1", "ros2"])
def frames_file(
    request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory, shared_cpp_cache: Path
) -> Path:
    """The node file of one of the programs."""
    del shared_cpp_cache
    try:
        find_toolchain()
    except NoToolchainError as error:
        pytest.skip(str(error))
    generation = request.param
    name = f"frames_ros{generation}"
    file = tmp_path_factory.mktemp("frames") / name
    command = [sys.executable, "-m", "gazelle.cpp.compile", str(_PROGRAMS / f"{name}.cpp")]
    command += ["-o", str(file), "--ros", str(generation), "--lib", _LIBRARIES[generation]]
    outcome = subprocess.run(command, check=False, capture_output=True)
    assert outcome.returncode == 0, outcome.stderr.decode()
    return file


@pytest.fixture
def graph(free_port: int) -> Iterator[Graph]:
    """A graph of the test's own."""
    with Graph.open(port=free_port, role="hub", environ={}) as one:
        yield one


@pytest.fixture
def frames(gazelle: Run, graph: Graph, frames_file: Path) -> Launched:
    """The program, running."""
    return gazelle(str(frames_file), module="gazelle.cpp.host")


def test_python_hears_of_frames_of_cpp(graph: Graph, frames: Launched) -> None:
    buffer = TransformBuffer()
    TransformListener(buffer, graph.create_node("hears"))
    eventually(lambda: buffer.can_transform("odom", "camera"))
    found = buffer.lookup_transform("odom", "camera").pose
    assert found.position_m == pytest.approx((1.0, 2.0, 0.5))
    half = math.sqrt(0.5)
    assert found.quat_xyzw == pytest.approx((0.0, 0.0, half, half))
    eventually(lambda: buffer.can_transform("odom", "laser"))
    kinds = {one.name: one.is_static for one in buffer.frames()}
    assert kinds == {"camera": True, "laser": True, "base_link": False}
    assert frames.popen.poll() is None


def test_cpp_waits_for_a_frame_of_python(graph: Graph, frames: Launched) -> None:
    _offer_gripper(graph)
    # Turned by a quarter at base_link: x becomes y.
    frames.wait_for_line("gripper 1.000 2.250 0.000")
    frames.wait_for_line('"nowhere" passed to lookupTransform argument source_frame does not exist')


def test_messages_are_held_back_until_their_frame_is_known(graph: Graph, frames: Launched) -> None:
    point = message_type("geometry_msgs/msg/PointStamped")
    node = graph.create_node("points_out")
    publisher = node.create_publisher("points", point)
    eventually(lambda: publisher.matched)
    message = point()
    message.header.frame_id = "tool"
    message.point.x = 0.5
    sender = TransformBroadcaster(node)
    buffer = TransformBuffer()
    TransformListener(buffer, node)
    eventually(lambda: buffer.can_transform("odom", "base_link"))
    latest = buffer.latest_common_time_ns("odom", "base_link")
    _stamp(message, latest)
    publisher.publish(message)
    _offer_gripper(graph)
    frames.wait_for_line("gripper")
    assert "filtered" not in frames.text

    def placed() -> bool:
        sender.send(
            [StampedPose("base_link", "tool", latest + one, Pose()) for one in (-(10**6), 10**6)]
        )
        return "filtered 1.000 2.500 0.000" in frames.text

    eventually(placed)


def _offer_gripper(graph: Graph) -> None:
    sender = StaticTransformBroadcaster(graph.create_node("offers"))
    sender.send(StampedPose("base_link", "gripper", 1, Pose((0.25, 0.0, 0.0))))


def _stamp(message: Any, stamp_ns: int) -> None:
    message.header.stamp.sec, message.header.stamp.nanosec = divmod(stamp_ns, 10**9)
