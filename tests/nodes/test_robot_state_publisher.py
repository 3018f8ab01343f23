"""Joint states to tf: poses, rates, mimic joints, time jumps."""

from __future__ import annotations

import math
import re
from pathlib import Path
from typing import Any

import pytest
import yaml

from gazelle.errors import LaunchError
from gazelle.graph import Node
from gazelle.interfaces import message_type
from gazelle.nodes import robot_state_publisher
from gazelle.nodes.link_tree import joint_tree, read_description, segment_names
from gazelle.nodes.robot_state_publisher import StateToTf

ROBOT = """<robot name="r">
  <link name="base"/><link name="arm"/><link name="slide"/><link name="cam"/><link name="twin"/>
  <joint name="turn" type="revolute"><parent link="base"/><child link="arm"/>
    <origin xyz="1 0 0" rpy="0 0 1.5707963267948966"/><axis xyz="0 0 1"/>
    <limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
  <joint name="lift" type="prismatic"><parent link="arm"/><child link="slide"/>
    <axis xyz="0 0 1"/><limit lower="0" upper="1" effort="1" velocity="1"/></joint>
  <joint name="mount" type="fixed"><parent link="slide"/><child link="cam"/>
    <origin xyz="0 0 0.5"/></joint>
  <joint name="copy" type="continuous"><parent link="base"/><child link="twin"/>
    <axis xyz="0 0 1"/><mimic joint="turn" multiplier="-2" offset="0.1"/></joint>
</robot>"""


def _states(**options: Any) -> StateToTf:
    return StateToTf(joint_tree(read_description(ROBOT)), **options)


def _joint_state(stamp_ns: int, **positions: float) -> Any:
    message: Any = message_type("sensor_msgs/msg/JointState")()
    message.header.stamp.sec, message.header.stamp.nanosec = divmod(stamp_ns, 1_000_000_000)
    message.name = list(positions)
    message.position = list(positions.values())
    return message


def _by_child(transforms: list[Any]) -> dict[str, Any]:
    return {item.child_frame_id: item for item in transforms}


def test_fixed_joints_are_static_and_moving_ones_are_not() -> None:
    (fixed,) = _states().fixed(0)
    assert (fixed.header.frame_id, fixed.child_frame_id) == ("slide", "cam")
    assert fixed.transform.translation.z == 0.5


SDF_ROBOT = """<sdf version="1.8"><model name="r" canonical_link="base">
  <link name="base"><pose>0 0 0.5 0 0 0</pose></link>
  <link name="arm"><pose>2 0 0.5 0 0 0</pose></link>
  <link name="tip"><pose>3 0 0.5 0 0 0</pose></link>
  <joint name="turn" type="revolute"><parent>base</parent><child>arm</child>
    <pose>-1 0 0 0 0 0</pose><axis><xyz>0 0 1</xyz></axis></joint>
  <joint name="mount" type="fixed"><parent>arm</parent><child>tip</child></joint>
</model></sdf>"""


def test_robot_in_sdf_has_its_frames_at_its_joints() -> None:
    states = StateToTf(joint_tree(read_description(SDF_ROBOT)))
    (mount,) = states.fixed(0)
    # 'arm' stands at its joint, one metre before its own pose.
    assert (mount.header.frame_id, mount.child_frame_id) == ("arm", "tip")
    assert mount.transform.translation.x == pytest.approx(2.0)
    arm = _by_child(states.moving(_joint_state(10**9, turn=math.pi / 2)))["arm"]
    assert arm.header.frame_id == "base"
    assert arm.transform.translation.x == pytest.approx(1.0)
    assert arm.transform.translation.z == pytest.approx(0.0)
    assert arm.transform.rotation.z == pytest.approx(math.sqrt(0.5))


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (
            '<sdf version="1.8"><world name="w"/></sdf>',
            "SDFormat xml has 0 models, and a robot is one",
        ),
        (
            SDF_ROBOT.replace('<joint name="mount"', '<link name="loose"/><joint name="mount"'),
            "model 'r' has 2 root links ('base', 'loose'), and a robot has one",
        ),
        (
            SDF_ROBOT.replace(
                "</model>",
                '<joint name="again" type="fixed"><parent>base</parent><child>tip</child></joint>'
                "</model>",
            ),
            "Link [tip] must only be a child of one joint",
        ),
    ],
)
def test_sdf_that_is_no_tree_is_no_robot(text: str, said: str) -> None:
    with pytest.raises(LaunchError, match=re.escape(said)):
        read_description(text)


def test_turning_joint_turns_about_its_axis_after_its_origin() -> None:
    found = _by_child(_states().moving(_joint_state(10**9, turn=math.pi / 2)))["arm"]
    assert found.header.frame_id == "base"
    assert found.transform.translation.x == pytest.approx(1.0)
    # 90° of the origin and 90° of the joint.
    assert abs(found.transform.rotation.z) == pytest.approx(1.0)


def test_sliding_joint_moves_along_its_axis() -> None:
    found = _by_child(_states().moving(_joint_state(10**9, lift=0.25)))["slide"]
    assert found.transform.translation.z == pytest.approx(0.25)


def test_mimic_joint_follows_with_multiplier_and_offset() -> None:
    found = _by_child(_states().moving(_joint_state(10**9, turn=0.2)))["twin"]
    angle = 2 * math.atan2(found.transform.rotation.z, found.transform.rotation.w)
    assert angle == pytest.approx(-2 * 0.2 + 0.1)


def test_no_joint_is_published_more_often_than_the_frequency() -> None:
    states = _states(period_ns=20_000_000)
    stamps = range(10**9, 10**9 + 10**9, 10_000_000)
    sent = sum(bool(states.moving(_joint_state(stamp, lift=0.1))) for stamp in stamps)
    assert sent == 50


def test_time_that_jumps_back_starts_anew() -> None:
    states = _states(period_ns=20_000_000)
    assert states.moving(_joint_state(5 * 10**9, lift=0.1))
    assert states.moving(_joint_state(10**9, lift=0.1))


def test_unknown_joints_of_a_message_change_nothing() -> None:
    assert _states().moving(_joint_state(10**9, nobody=1.0)) == []


def test_prefix_stands_before_every_frame() -> None:
    (fixed,) = _states(prefix="r1/").fixed(0)
    assert (fixed.header.frame_id, fixed.child_frame_id) == ("r1/slide", "r1/cam")


_NODE = "robot_state_publisher/robot_state_publisher"


@pytest.mark.parametrize("way", ["parameters", "file"])
def test_node_of_ros2_publishes_its_description(bench: Any, tmp_path: Path, way: str) -> None:
    if way == "file":
        (tmp_path / "r.urdf").write_text(ROBOT)
        words = [str(tmp_path / "r.urdf"), "--ros-args", "-p", "frame_prefix:=r1/"]
    else:
        values = {"robot_description": ROBOT, "frame_prefix": "r1/", "use_sim_time": True}
        text = yaml.dump({"/**": {"ros__parameters": values}})
        (tmp_path / "p.yaml").write_text(text)
        words = ["--ros-args", "--params-file", str(tmp_path / "p.yaml")]
    bench.start(_NODE, *words)
    text = bench.listen("/robot_description", "std_msgs/msg/String")
    static = bench.listen("/tf_static", "tf2_msgs/msg/TFMessage")
    bench.eventually(lambda: text and static)
    assert text[0].data == ROBOT
    assert static[0].transforms[0].child_frame_id == "r1/cam"
    stamp = static[0].transforms[0].header.stamp
    # Before /clock simulated time is 0, not that of the wall.
    assert (stamp.sec == 0) is (way == "parameters")
    assert bench.stop() == [0]


def test_prefix_of_ros1_gets_its_slash(bench: Any) -> None:
    bench.graph.parameters.set("/robot_description", ROBOT)
    static = bench.listen("/tf_static", "tf2_msgs/msg/TFMessage")
    described = bench.listen("/robot_description", "std_msgs/msg/String")
    bench.start(_NODE, "_tf_prefix:=/r1")
    bench.eventually(lambda: static)
    assert static[0].transforms[0].child_frame_id == "r1/cam"
    assert not described
    assert bench.stop() == [0]


def test_two_nodes_of_ros2_with_one_name_stay(bench: Any, tmp_path: Path) -> None:
    (tmp_path / "r.urdf").write_text(ROBOT)
    got = bench.listen("/robot_description", "std_msgs/msg/String")
    for _ in range(2):
        bench.start(_NODE, str(tmp_path / "r.urdf"), "--ros-args")
    bench.eventually(lambda: len(got) == 2)
    assert bench.stop() == [0, 0]


def test_description_stays_when_another_node_of_its_name_takes_the_parameter(
    bench: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A node of ROS 2 that starts forgets the parameters of one that had its name."""
    read = robot_state_publisher.take_description_file

    def read_and_lose(node: Node, name: str) -> str:
        text = read(node, name)
        node.parameters.delete(node.name)
        return text

    monkeypatch.setattr(robot_state_publisher, "take_description_file", read_and_lose)
    (tmp_path / "r.urdf").write_text(ROBOT)
    got = bench.listen("/robot_description", "std_msgs/msg/String")
    bench.start(_NODE, str(tmp_path / "r.urdf"), "--ros-args")
    bench.eventually(lambda: [one.data for one in got] == [ROBOT])
    assert bench.stop() == [0]


_ON_WORLD = ROBOT.replace(
    '<link name="base"/>',
    '<link name="world"/><link name="base"/><joint name="stand" type="fixed">'
    '<origin xyz="0 0 2"/><parent link="world"/><child link="base"/></joint>',
)


@pytest.mark.parametrize("ros_version", [1, 2])
def test_a_root_link_called_world_is_a_frame(bench: Any, tmp_path: Path, ros_version: int) -> None:
    static = bench.listen("/tf_static", "tf2_msgs/msg/TFMessage")
    if ros_version == 2:
        (tmp_path / "r.urdf").write_text(_ON_WORLD)
        bench.start(_NODE, str(tmp_path / "r.urdf"), "--ros-args")
    else:
        bench.graph.parameters.set("/robot_description", _ON_WORLD)
        bench.start(_NODE)
    bench.eventually(lambda: static)
    found = _by_child(static[0].transforms)["base"]
    assert (found.header.frame_id, found.transform.translation.z) == ("world", 2.0)
    assert bench.stop() == [0]


def test_segments_hold_the_root_link_called_world() -> None:
    names = segment_names(read_description(_ON_WORLD))
    assert names == ("arm", "base", "cam", "slide", "twin", "world")
