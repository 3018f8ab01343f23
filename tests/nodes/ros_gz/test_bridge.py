"""parameter_bridge over a graph: what is passed on, and what needs no passing."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from gazelle.interfaces import message_type, service_type

_BRIDGE = "ros_gz_bridge/parameter_bridge"
_STRING: Any = message_type("std_msgs/msg/String")
_TWIST: Any = message_type("geometry_msgs/msg/Twist")


def _logged(bench: Any) -> list[Any]:
    return bench.listen("/rosout", "rcl_interfaces/msg/Log")  # type: ignore[no-any-return]


def _send(bench: Any, topic: str, message: Any) -> Any:
    publisher = bench.node.create_publisher(topic, type(message), latch=True)
    bench.eventually(lambda: publisher.matched)
    publisher.publish(message)
    return publisher


def test_renamed_topic_is_passed_on(bench: Any) -> None:
    got = bench.listen("/odom", "std_msgs/msg/String")
    bench.start(
        _BRIDGE, "/model/r/odometry@std_msgs/msg/String[gz.msgs.StringMsg",
        "--ros-args", "-r", "/model/r/odometry:=/odom",
    )  # fmt: skip
    _send(bench, "/model/r/odometry", _STRING(data="here"))
    bench.eventually(lambda: got)
    assert got[0].data == "here"
    assert bench.stop() == [0]


def test_clock_of_a_world_is_not_told_by_two(bench: Any) -> None:
    got = bench.listen("/b", "std_msgs/msg/String")
    bench.start(
        _BRIDGE, "/world/w/clock@rosgraph_msgs/msg/Clock[gz.msgs.Clock",
        "/a@std_msgs/msg/String[gz.msgs.StringMsg",
        "--ros-args", "-r", "/world/w/clock:=/clock", "-r", "/a:=/b",
    )  # fmt: skip
    _send(bench, "/a", _STRING(data="both rows are made"))
    bench.eventually(lambda: got)
    clocks = [one for one in bench.graph.topics() if one.name == "/clock"]
    assert not any(one.publishers for one in clocks)


def test_both_directions_do_not_go_round_in_circles(bench: Any, tmp_path: Path) -> None:
    path = tmp_path / "bridge.yaml"
    path.write_text(
        "- {ros_topic_name: /ros, gz_topic_name: /gz, ros_type_name: std_msgs/msg/String,"
        " gz_type_name: gz.msgs.StringMsg}"
    )
    ros = bench.listen("/ros", "std_msgs/msg/String")
    gz = bench.listen("/gz", "std_msgs/msg/String")
    bench.start(_BRIDGE, "--ros-args", "-p", f"config_file:={path}")
    _send(bench, "/gz", _STRING(data="from gz"))
    bench.eventually(lambda: ros)
    _send(bench, "/ros", _STRING(data="from ros"))
    # Each of the two topics has a thread of its own here.
    bench.eventually(lambda: len(gz) == 2 and len(ros) == 2)
    assert [one.data for one in ros] == ["from gz", "from ros"]
    assert [one.data for one in gz] == ["from gz", "from ros"]


def test_header_is_put_around_and_taken_away(bench: Any) -> None:
    stamped = bench.listen("/stamped", "geometry_msgs/msg/TwistStamped")
    bench.start(
        _BRIDGE, "/plain@geometry_msgs/msg/TwistStamped[gz.msgs.Twist",
        "--ros-args", "-r", "/plain:=/stamped",
    )  # fmt: skip
    message = _TWIST()
    message.linear.x = 0.5
    _send(bench, "/plain", message)
    bench.eventually(lambda: stamped)
    assert stamped[0].twist.linear.x == 0.5


def test_same_name_needs_no_passing_and_another_type_is_told(bench: Any) -> None:
    said = _logged(bench)
    bench.node.create_publisher("/cmd_vel", _TWIST)
    bench.start(
        _BRIDGE,
        "/cmd_vel@geometry_msgs/msg/TwistStamped]gz.msgs.Twist",
        "/clock@rosgraph_msgs/msg/Clock[gz.msgs.Clock",
        "/x@a/B[gz.msgs.Clock",
    )
    text = "/cmd_vel carries geometry_msgs/msg/Twist here, which is not turned into geometry_msgs/m"
    bench.eventually(lambda: any(one.msg.startswith(text) for one in said))
    lines = [one.msg for one in said]
    arrow = "GZ->ROS Bridge: [/clock (gz.msgs.Clock) -> /clock (rosgraph_msgs/msg/Clock)] (Lazy 0)"
    assert f"Creating {arrow}" in lines
    assert any("no bridge between [a/B] and [gz.msgs.Clock]" in line for line in lines)


def test_the_bridges_type_is_the_topics(bench: Any) -> None:
    # As a drive of a world: it shows one type and takes both.
    got: list[Any] = []
    bench.node.create_subscription("/cmd_vel", None, got.append, announced=_TWIST.TYPE_NAME)
    bench.start(_BRIDGE, "/cmd_vel@geometry_msgs/msg/TwistStamped]gz.msgs.Twist")
    stamped = "geometry_msgs/msg/TwistStamped"
    bench.eventually(lambda: dict(bench.graph.topic_names_and_types()).get("/cmd_vel") == stamped)
    _send(bench, "/cmd_vel", _TWIST())
    bench.eventually(lambda: got)
    assert bench.stop() == [0]


def test_who_listens_without_the_header_is_not_told_of(bench: Any) -> None:
    said = _logged(bench)
    bench.listen("/cmd_vel", "geometry_msgs/msg/Twist")
    bench.listen("/cmd_vel", "std_msgs/msg/String")
    bench.start(_BRIDGE, "/cmd_vel@geometry_msgs/msg/TwistStamped]gz.msgs.Twist")
    bench.eventually(lambda: any("/cmd_vel carries std_msgs/msg/String" in one.msg for one in said))
    assert not [one.msg for one in said if "geometry_msgs/msg/Twist here" in one.msg]


def test_lazy_bridge_listens_only_while_somebody_listens_to_it(bench: Any) -> None:
    bench.start(
        _BRIDGE, "/a@std_msgs/msg/String[gz.msgs.StringMsg",
        "--ros-args", "-r", "/a:=/b", "-p", "lazy:=true",
    )  # fmt: skip
    publisher = bench.node.create_publisher("/a", _STRING, latch=True)
    bench.eventually(lambda: "/ros_gz_bridge" in bench.graph.node_names())
    assert not publisher.matched
    got = bench.listen("/b", "std_msgs/msg/String")
    bench.eventually(lambda: publisher.matched)
    publisher.publish(_STRING(data="now"))
    bench.eventually(lambda: got)


def test_a_text_that_says_false_is_no_laziness_and_slips_are_told(bench: Any) -> None:
    said = _logged(bench)
    bench.start(
        _BRIDGE, "/a@std_msgs/msg/String[gz.msgs.StringMsg",
        "--ros-args", "-r", "/a:=/b", "-p", "lazy:='false'", "-p", "config_fil:=b.yaml",
        "-p", "override_timestamps_with_wall_time:=true", "-p", "override_frame_id:=''",
    )  # fmt: skip
    expected = [
        "parameter 'config_fil' is not one of parameter_bridge; it has no effect",
        "'override_timestamps_with_wall_time' (True) has no effect here: stamps stay",
        "Creating GZ->ROS Bridge: [/a (gz.msgs.StringMsg) -> /b (std_msgs/msg/String)] (Lazy 0)",
    ]
    bench.eventually(lambda: all(any(text in one.msg for one in said) for text in expected))
    assert not any("override_frame_id" in one.msg for one in said)


def test_service_of_a_world_is_offered(bench: Any) -> None:
    kind: Any = service_type("ros_gz_interfaces/srv/ControlWorld")
    asked: list[Any] = []

    def control(request: Any) -> Any:
        asked.append(request.world_control.pause)
        return kind.Response(success=True)

    bench.node.create_service("/gazebo/control_world", kind, control)
    name = "/world/w/control"
    bench.start(_BRIDGE, f"{name}@ros_gz_interfaces/srv/ControlWorld")
    wanted = message_type("ros_gz_interfaces/msg/WorldControl")(pause=True)
    kind_name = "ros_gz_interfaces/srv/ControlWorld"
    assert bench.call(name, kind_name, world_control=wanted).success
    assert asked == [True]


def test_unknown_service_is_told(bench: Any) -> None:
    said = _logged(bench)
    bench.start(_BRIDGE, "/world/w/x@std_srvs/srv/Empty")
    text = "Failed to create a bridge for service [std_srvs/srv/Empty]; there are ros_gz_interfaces"
    bench.eventually(lambda: any(one.msg.startswith(text) for one in said))


@pytest.mark.parametrize("package", ["ros_gz_image", "ros_ign_image"])
def test_images_are_bridged_by_name(bench: Any, package: str) -> None:
    got = bench.listen("/rgb", "sensor_msgs/msg/Image")
    bench.start(f"{package}/image_bridge", "/camera", "--ros-args", "-r", "/camera:=/rgb")
    _send(bench, "/camera", message_type("sensor_msgs/msg/Image")(height=3, encoding="rgb8"))
    bench.eventually(lambda: got)
    assert got[0].height == 3
