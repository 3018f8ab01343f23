"""Words and files of parameter_bridge, and pairs of types."""

from __future__ import annotations

from pathlib import Path

import pytest

from gazelle.errors import LaunchError
from gazelle.nodes.ros_gz.bridge_config import (
    Direction,
    ServiceRow,
    TopicRow,
    read_argument,
    read_file,
)
from gazelle.nodes.ros_gz.mappings import is_pair, pair_error


@pytest.mark.parametrize("sign", list(Direction))
def test_sign_between_the_types_is_the_direction(sign: Direction) -> None:
    found = read_argument(f"/clock@rosgraph_msgs/msg/Clock{sign.value}gz.msgs.Clock")
    assert found == TopicRow("/clock", "/clock", "rosgraph_msgs/msg/Clock", "gz.msgs.Clock", sign)


@pytest.mark.parametrize("rest", ["", "@gz.msgs.WorldControl@gz.msgs.Boolean"])
def test_services_are_known_by_their_type(rest: str) -> None:
    word = f"/world/w/control@ros_gz_interfaces/srv/ControlWorld{rest}"
    assert read_argument(word) == ServiceRow(
        "/world/w/control", "ros_gz_interfaces/srv/ControlWorld"
    )


@pytest.mark.parametrize("word", ["/clock", "/a@std_msgs/String", "@x@y", "/a@b@c@d"])
def test_other_words_show_the_usage(word: str) -> None:
    with pytest.raises(LaunchError, match=r"is no bridge\nusage: parameter_bridge"):
        read_argument(word)


def test_names_of_a_file_stand_for_each_other(tmp_path: Path) -> None:
    types = "ros_type_name: std_msgs/msg/String, gz_type_name: gz.msgs.StringMsg"
    path = tmp_path / "bridge.yaml"
    path.write_text(
        f"- {{topic_name: a, {types}}}\n- {{ros_topic_name: b, {types}}}\n"
        f"- {{gz_topic_name: c, {types}, lazy: true}}\n"
        f"- {{ros_topic_name: r, gz_topic_name: g, {types}, direction: ROS_TO_GZ,"
        " publisher_queue: 3}\n"
    )
    rows, wrong = read_file(path)
    found = [row for row in rows if isinstance(row, TopicRow)]
    assert [(row.ros_topic, row.gz_topic) for row in found] == [
        ("a", "a"), ("b", "b"), ("c", "c"), ("r", "g"),
    ]  # fmt: skip
    assert [row.lazy for row in found] == [False, False, True, False]
    assert (found[3].direction, found[3].queue_size) == (Direction.ROS_TO_GZ, 3)
    assert wrong == []


def test_wrong_entries_are_told_with_their_place_and_the_rest_is_read(tmp_path: Path) -> None:
    types = "ros_type_name: std_msgs/msg/String, gz_type_name: gz.msgs.StringMsg"
    path = tmp_path / "bridge.yaml"
    path.write_text(
        f"- {{topic_name: a, ros_topic_name: b, {types}}}\n- {{topic_name: a}}\n- 3\n"
        f"- {{topic_name: a, {types}, direction: GZ_TO_ROSE}}\n- {{{types}}}\n"
        f"- {{topic_name: a, {types}, publisher_queue: many}}\n- {{topic_nam: a, {types}}}\n"
        f"- {{topic_name: a, {types}, lazy: seldom}}\n"
        f"- {{topic_name: good, {types}, lazy: 'false'}}\n"
    )
    rows, wrong = read_file(path)
    topics = [row for row in rows if isinstance(row, TopicRow)]
    assert [(row.gz_topic, row.lazy) for row in topics] == [("good", False)]
    expected = [
        "topic_name and ros_topic_name are mutually exclusive",
        "both ros_type_name and gz_type_name must be set",
        "entry must be a YAML map",
        "invalid direction [GZ_TO_ROSE]; there are BIDIRECTIONAL, GZ_TO_ROS, ROS_TO_GZ",
        "one of topic_name, ros_topic_name and gz_topic_name must be set",
        "publisher_queue is a whole number, not 'many'",
        "'topic_nam' is not read; did you mean 'topic_name'",
        "lazy is true or false, not 'seldom'",
    ]
    for number, text in enumerate(expected, 1):
        assert any(text in line and f"entry {number}" in line for line in wrong), text


@pytest.mark.parametrize(
    ("text", "why"),
    [("", "file empty"), ("a: b", "must be a YAML sequence"), ("[", "expected"), (None, "open")],
)
def test_file_that_is_no_list_ends_the_node(tmp_path: Path, text: str | None, why: str) -> None:
    path = tmp_path / "bridge.yaml"
    if text is not None:
        path.write_text(text)
    with pytest.raises(LaunchError, match=rf"(?s)Could not parse config: .*{why}"):
        read_file(path)


def test_pairs_are_those_of_ros_gz_bridge() -> None:
    assert is_pair("geometry_msgs/Twist", "ignition.msgs.Twist")
    assert is_pair("nav_msgs/msg/Odometry", "gz.msgs.OdometryWithCovariance")
    assert not is_pair("nav_msgs/msg/Odometry", "gz.msgs.Twist")
    assert "goes with gz.msgs.Odometry or" in pair_error("nav_msgs/msg/Odometry", "gz.msgs.Pose")
    assert "gz.msgs.IMU goes with sensor_msgs/msg/Imu" in pair_error("a/B", "gz.msgs.IMU")
