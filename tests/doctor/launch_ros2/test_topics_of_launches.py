"""Both ends of topics in a launch of ROS 2: types that differ, names that were misspelt."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from tests.doctor.conftest import Examine, Write

from gazelle.diagnostics import Diagnostic
from gazelle.doctor import Report

MANIFEST = """<package format="3"><name>bot</name><version>1.0.0</version>
<export><build_type>ament_python</build_type></export></package>"""
SETUP = """from setuptools import setup
setup(name="bot", packages=["bot"],
      entry_points={"console_scripts": ["look = bot.look:main", "talk = bot.talk:main"]})
"""
ROBOT = """<robot name="r"><link name="base"><inertial><mass value="1"/>
<inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial>
<collision><geometry><box size="0.2 0.2 0.2"/></geometry></collision></link>
<gazebo reference="base"><sensor type="ray" name="laser"><update_rate>5</update_rate>
<ray><scan><horizontal><samples>3</samples><resolution>1</resolution><min_angle>-1</min_angle>
<max_angle>1</max_angle></horizontal></scan><range><min>0.1</min><max>9</max></range></ray>
<plugin name="laser" filename="libgazebo_ros_ray_sensor.so"><ros><remapping>~/out:=scan</remapping>
</ros><output_type>sensor_msgs/LaserScan</output_type><frame_name>base</frame_name></plugin>
</sensor></gazebo></robot>"""
LAUNCH = """from ament_index_python.packages import get_package_share_directory as share
from launch import LaunchDescription
from launch.actions import IncludeLaunchDescription
from launch_ros.actions import Node, PushRosNamespace
def generate_launch_description():
    robot = open(share("bot") + "/urdf/bot.urdf").read()
    return LaunchDescription([
        IncludeLaunchDescription(share("gazebo_ros") + "/launch/gazebo.launch.py"),
        Node(package="robot_state_publisher", executable="robot_state_publisher",
             parameters=[{{"robot_description": robot, "use_sim_time": True}}]),
        Node(package="gazebo_ros", executable="spawn_entity.py",
             arguments=["-topic", "robot_description", "-entity", "bot"]),
        {nodes}
    ])
"""
SCRIPT = """import rclpy
from rclpy.node import Node
from sensor_msgs.msg import Image, LaserScan
from std_msgs.msg import Int32, String


class Own(Node):
    def __init__(self):
        super().__init__("own")
        {}


def main():
    rclpy.spin(Own())
"""
HEAR = "self.create_subscription({}, '{}', print, 1)"
TALK = "self.create_publisher({}, '{}', 1)"

Told = Callable[..., list[Diagnostic]]


@pytest.fixture
def told(written: Write, examined: Examine) -> Told:
    """What is told of topics in a launch of ``look`` and ``talk``."""

    def run(nodes: str, look: str, talk: str = "pass") -> list[Diagnostic]:
        folder = written(
            **{
                "package.xml": MANIFEST,
                "setup.py": SETUP,
                "urdf__bot.urdf": ROBOT,
                "launch__bot.launch.py": LAUNCH.format(nodes=nodes),
            }
        )
        (folder / "bot").mkdir(exist_ok=True)
        (folder / "bot" / "__init__.py").touch()
        for name, text in {"look": look, "talk": talk}.items():
            (folder / "bot" / f"{name}.py").write_text(SCRIPT.format(text))
        return _of_topics(examined(folder, "bot", "bot.launch.py"))

    return run


def _of_topics(report: Report) -> list[Diagnostic]:
    return [item for item in report.findings if item.code.startswith("doctor.topic-")]


def _node(name: str, more: str = "") -> str:
    return f'Node(package="bot", executable="{name}"{more}),'


def _place(item: Diagnostic) -> str:
    assert item.span is not None
    return f"{Path(item.span.file).name}:{item.span.line}:{item.span.column}"


def test_type_that_a_sensor_does_not_send(told: Told) -> None:
    (item,) = told(_node("look"), HEAR.format("Image", "scan"))
    assert item.code == "doctor.topic-type"
    assert item.message == (
        "'/look' listens to '/scan' as sensor_msgs/Image, and '/gazebo' publishes it as "
        "sensor_msgs/LaserScan: no message arrives"
    )
    assert _place(item) == "look.py:10:34"
    assert item.phrase == "Cannot echo topic '/scan', as it contains more than one type"


def test_two_scripts_of_two_types_are_one_finding(told: Told) -> None:
    nodes = _node("look") + _node("talk", ', remappings=[("say", "/chatter")]')
    (item,) = told(nodes, HEAR.format("Int32", "chatter"), TALK.format("String", "say"))
    assert "'/talk' (talk.py:10) publishes it as std_msgs/String" in item.message
    assert _place(item) == "look.py:10:34"


@pytest.mark.parametrize(
    "nodes",
    [
        _node("look", ', remappings=[("scan", "picture")]'),
        _node("look", ', namespace="robot"'),
        _node("look", ", namespace=unknown"),
        'PushRosNamespace("robot"),' + _node("look"),
    ],
    ids=["remapped", "in a namespace", "in an unknown one", "in one around it"],
)
def test_topics_that_may_be_others_are_not_told(told: Told, nodes: str) -> None:
    assert told(nodes, HEAR.format("Image", "scan")) == []


def test_misspelt_topic_is_told_at_its_place(told: Told) -> None:
    (item,) = told(_node("look"), HEAR.format("LaserScan", "/scna"))
    assert item.code == "doctor.topic-misspelt"
    assert item.message == (
        "'/look' listens to '/scna', which nobody in this launch is known to publish; there is "
        "'/scan'"
    )
    assert (_place(item), item.fix) == ("look.py:10:45", "did you mean '/scan'?")


def test_misspelt_topic_beside_nodes_of_which_nothing_is_known(told: Told) -> None:
    nodes = _node("look") + 'Node(package="elsewhere", executable="go"),'
    (item,) = told(nodes, HEAR.format("LaserScan", "scna"))
    assert "which nobody in this launch is known to publish" in item.message
    assert told(nodes, HEAR.format("LaserScan", "laser")) == []


@pytest.mark.parametrize("look", [HEAR.format("LaserScan", "scan"), HEAR.format("Image", "eye")])
def test_topics_that_are_right_are_not_told(told: Told, look: str) -> None:
    assert told(_node("look"), look) == []


def test_script_that_is_run_by_hand_is_compared_with_the_launch(told: Told) -> None:
    (item,) = told("", HEAR.format("LaserScan", "scna"))
    assert item.message.startswith("'look.py' listens to '/scna', which nobody here is known to")


def test_topic_that_is_in_another_namespace(told: Told) -> None:
    (item,) = told(_node("look"), HEAR.format("LaserScan", "robot/scan"))
    assert item.code == "doctor.topic-misspelt"
    assert item.fix == "did you mean 'scan'?"


def test_two_scripts_that_miss_each_other_by_a_letter(told: Told) -> None:
    nodes = _node("look") + _node("talk")
    found = told(nodes, HEAR.format("String", "cmd_val"), TALK.format("String", "cmd_vel"))
    assert [_place(item) for item in found] == ["look.py:10:42", "talk.py:10:39"]
    assert told(nodes, HEAR.format("String", "plan"), TALK.format("String", "state")) == []
