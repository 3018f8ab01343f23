"""Parameters that a launch gives to a node and that nothing reads."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from tests.doctor.conftest import Examine, Write

from gazelle.diagnostics import Diagnostic
from gazelle.doctor import Report
from gazelle.doctor.script_parameters import ScriptParameters, read_script_parameters

CODES = ("doctor.parameter-unread", "parameter.unknown")
ROS1 = "#!/usr/bin/env python3\nimport rospy\n"
ROS2_MANIFEST = """<package format="3"><name>bot</name><version>1.0.0</version>
<export><build_type>ament_python</build_type></export></package>"""
ROS2_SETUP = """from setuptools import setup
setup(name="bot", packages=["bot"], entry_points={"console_scripts": ["go = bot.go:main"]})
"""
ROS2_SCRIPT = """import rclpy
from rclpy.node import Node


class Go(Node):
    def __init__(self):
        super().__init__("go")
        {}


def main():
    rclpy.spin(Go())
"""
ROS2_LAUNCH = """from launch import LaunchDescription
from launch_ros.actions import Node
from ament_index_python.packages import get_package_share_directory as share
def generate_launch_description():
    return LaunchDescription([
        {}
    ])
"""


def _told(report: Report) -> list[Diagnostic]:
    return [item for item in report.findings if item.code in CODES]


def _line(item: Diagnostic) -> str:
    assert item.span is not None
    return f"{Path(item.span.file).name}:{item.span.line}"


@pytest.fixture
def ros1(written: Write, examined: Examine) -> Callable[..., list[Diagnostic]]:
    """What is told of a launch of ROS 1 with ``go.py`` and these nodes."""

    def run(nodes: str, script: str = "", yaml: str = "") -> list[Diagnostic]:
        folder = written(
            **{
                "launch__go.launch": f"<launch>\n{nodes}\n</launch>",
                "config__go.yaml": yaml,
                "scripts__go.py": ROS1 + script,
            }
        )
        (folder / "scripts" / "go.py").chmod(0o755)
        return _told(examined(folder, "bot", "go.launch"))

    return run


@pytest.fixture
def ros2(written: Write, examined: Examine) -> Callable[..., list[Diagnostic]]:
    """What is told of a launch of ROS 2 with ``go`` and these nodes."""

    def run(nodes: str, script: str = "pass", yaml: str = "") -> list[Diagnostic]:
        folder = written(
            **{
                "package.xml": ROS2_MANIFEST,
                "setup.py": ROS2_SETUP,
                "launch__go.launch.py": ROS2_LAUNCH.format(nodes),
                "config__go.yaml": yaml,
                "bot__go.py": ROS2_SCRIPT.format(script),
            }
        )
        (folder / "bot" / "__init__.py").touch()
        return _told(examined(folder, "bot", "go.launch.py"))

    return run


@pytest.mark.parametrize(
    ("source", "names"),
    [
        ("rospy.get_param('~speed', 1)\nrospy.has_param(param_name='/x')", {"~speed", "/x"}),
        ("NAME = '~speed'\nrospy.get_param(NAME)", {"~speed"}),
        ("rospy.search_param('speed')", {"speed", "~speed"}),
        ("node.declare_parameters('', [('a', 1), ('b.c', 2)])", {"a", "b.c"}),
        ("node.declare_parameters('top', parameters=[('a',)])", {"top.a"}),
    ],
)
def test_plain_names_are_read(tmp_path: Path, source: str, names: set[str]) -> None:
    (tmp_path / "go.py").write_text(f"import rospy\n{source}\n")
    found = read_script_parameters(tmp_path / "go.py")
    assert found == ScriptParameters(frozenset(names), True)


@pytest.mark.parametrize(
    "source",
    [
        "rospy.get_param('~' + name)",
        "rospy.get_param_names()",
        "from dynamic_reconfigure.server import Server",
        "super().__init__('a', automatically_declare_parameters_from_overrides=True)",
        "node.declare_parameters('', rows)",
        "from .other import read",
    ],
)
def test_computed_names_are_not_complete(tmp_path: Path, source: str) -> None:
    (tmp_path / "go.py").write_text(f"import rospy\n{source}\n")
    assert not read_script_parameters(tmp_path / "go.py").is_complete


def test_parameter_of_a_script_of_ros1_is_told_where_it_is_set(ros1) -> None:
    nodes = '<node name="go" pkg="bot" type="go.py">\n<param name="spede" value="1"/>\n'
    nodes += '<rosparam file="$(find bot)/config/go.yaml"/>\n<rosparam>{other: 1}</rosparam></node>'
    script = "rospy.get_param('~speed', 1)\nrospy.get_param('~limits/turn')"
    told = ros1(nodes, script, "good: 1\nlimits:\n  tunr: 2\n  turn: 1\n")
    by_place = {_line(item): item for item in told}
    item = by_place["go.launch:3"]
    assert item.message == "'/go': parameter 'spede' is set, and go.py never reads it"
    assert (item.fix, str(item.severity)) == ("did you mean 'speed'?", "warning")
    assert by_place["go.yaml:3"].fix == "did you mean 'limits/turn'?"
    assert str(by_place["go.yaml:1"].severity) == "info"
    assert str(by_place["go.launch:5"].severity) == "info"
    assert len(told) == 4


def test_parameter_that_is_read_beside_the_node_is_told(ros1) -> None:
    nodes = '<node name="go" pkg="bot" type="go.py"><param name="speed" value="1"/></node>'
    (item,) = ros1(nodes, "rospy.get_param('speed', 1)")
    assert item.fix == "write '~speed' in go.py"
    assert item.message.endswith("never reads it: 'speed' there is a parameter of its namespace")


@pytest.mark.parametrize(
    "script",
    [
        "rospy.get_param('~speed')",
        "rospy.get_param('/go/speed')",
        "rospy.get_param('go')",
        "rospy.get_param('~')",
        "rospy.get_param('~' + NAME)",
        "rospy.search_param('speed')",
    ],
)
def test_parameter_that_may_be_read_is_not_told(ros1, script: str) -> None:
    nodes = '<node name="go" pkg="bot" type="go.py"><param name="speed" value="1"/></node>'
    assert ros1(nodes, script) == []


def test_misspelt_parameter_of_a_built_in_node_of_ros1(ros1) -> None:
    nodes = '<node name="amcl" pkg="amcl" type="amcl">\n<param name="min_particels" value="9"/>\n'
    nodes += '<param name="something_else" value="1"/></node>'
    (item,) = ros1(nodes)
    assert (item.code, _line(item)) == ("parameter.unknown", "go.launch:3")
    assert item.message == "'/amcl': parameter 'min_particels' is not known; it has no effect"
    assert item.fix.startswith("did you mean 'min_particles'")


def test_parameter_of_a_script_of_ros2_is_told_where_it_is_set(ros2) -> None:
    nodes = "Node(package='bot', executable='go', name='go', parameters=[\n"
    nodes += "share('bot') + '/config/go.yaml', {\n'spede': 1.0, 'use_sim_time': True}])"
    script = "self.declare_parameter('speed', 1.0)\n        self.declare_parameter('limits.turn')"
    yaml = "go:\n  ros__parameters:\n    limits:\n      tunr: 2.0\nother:\n  ros__parameters:\n"
    told = ros2(nodes, script, yaml + "    x: 1\n")
    by_place = {_line(item): item for item in told}
    assert by_place["go.launch.py:8"].fix == "did you mean 'speed'?"
    assert by_place["go.yaml:4"].message == (
        "'go': parameter 'limits.tunr' is set, and go.py never reads it"
    )
    assert by_place["go.yaml:4"].fix == "did you mean 'limits.turn'?"
    assert len(told) == 2


@pytest.mark.parametrize(
    "script",
    [
        "self.declare_parameter('speed', 1.0)",
        "self.declare_parameters('', [('speed', 1.0)])",
        "self.declare_parameter(self.name_of('speed'))",
    ],
)
def test_parameter_that_a_script_declares_is_not_told(ros2, script: str) -> None:
    node = "Node(package='bot', executable='go', parameters=[{'speed': 1.0}])"
    assert ros2(node, script) == []


def test_misspelt_parameter_of_a_built_in_node_of_ros2(ros2) -> None:
    node = "Node(package='nav2_amcl', executable='amcl', name='amcl',\nparameters=["
    yaml = "amcl:\n  ros__parameters:\n    max_particels: 9\n    min_particles: 5\n"
    node += "share('bot') + '/config/go.yaml', {'min_particels': 9, 'use_sim_time': True}])"
    told = ros2(node, yaml=yaml)
    assert sorted((item.code, _line(item)) for item in told) == [
        ("parameter.unknown", "go.launch.py:7"),
        ("parameter.unknown", "go.yaml:3"),
    ]
