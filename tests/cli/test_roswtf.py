"""roswtf."""

from __future__ import annotations

import itertools
from pathlib import Path
from typing import Any

import pytest

from gazelle.cli import roswtf
from gazelle.cli.roswtf import Findings, look_at_graph, summary
from gazelle.graph import Graph, Node
from gazelle.interfaces import message_type, service_type

_LAUNCH = """<launch><node pkg="demo_pkg" type="nope.py" name="nope"/></launch>"""


@pytest.fixture
def demo(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A package with a launch file whose node does not exist."""
    package = tmp_path / "demo_pkg"
    (package / "launch").mkdir(parents=True)
    (package / "package.xml").write_text(
        "<package format='2'><name>demo_pkg</name><version>0.1.0</version><description>d"
        "</description><maintainer email='a@b.example'>A</maintainer><license>MIT</license>"
        "<buildtool_depend>catkin</buildtool_depend></package>",
        encoding="utf-8",
    )
    (package / "launch" / "e.launch").write_text(_LAUNCH, encoding="utf-8")
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path))
    monkeypatch.chdir(tmp_path)
    return package / "launch" / "e.launch"


def test_summaries_are_laid_out_as_those_of_ros(recorded: Any) -> None:
    wanted = recorded("roswtf_launch").out
    names = ["ROS Dep database not updated: Please update rosdep database with 'rosdep update'."]
    names += ["You are missing core ROS Python modules: rosdep2 -- ", "pycrypto is not installed"]
    found = Findings(names)
    found.errors.append("ROS_ROOT [/usr/share/ros] does not point to a directory")
    found.blame(
        "Several nodes in your launch file could not be located. These are either typed "
        "incorrectly or need to be built:",
        [" * node [nope.py] in package [demo_pkg]"],
    )
    assert summary("Static checks summary:", found) + "\n" + "=" * 80 in wanted
    assert summary("Online checks summary:", Findings()) + "\n" in wanted


def test_launch_file_is_examined(port: int, demo: Path, capsys: Any) -> None:
    assert roswtf.main([str(demo)]) == 0
    out = capsys.readouterr().out
    assert out.startswith("=" * 80 + "\nStatic checks summary:\n\n")
    assert "ERROR\033[0m " in out
    assert "nope.py" in out
    assert "ROS Master does not appear to be running.\nOnline graph checks will not" in out


def test_folder_without_a_package(graph: Graph, tmp_path: Path, capsys: Any, demo: Path) -> None:
    assert roswtf.main([]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == "No package or stack in the current directory"
    at = lines.index("Beginning tests of your ROS graph. These may take a while...")
    assert lines[at + 1 :] == [
        "analyzing graph...",
        "... done analyzing graph",
        "running graph rules...",
        "... done running graph rules",
        "",
        "Online checks summary:",
        "",
        "No errors or warnings",
    ]


def test_package_of_the_folder_is_examined(
    port: int, demo: Path, capsys: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(demo.parent)
    assert roswtf.main(["--offline"]) == 0
    out = capsys.readouterr().out
    assert out.startswith("Package: demo_pkg\n")
    assert "nope.py" in out
    assert "Master" not in out


def _transform(parent: str, child: str) -> Any:
    message = message_type("tf2_msgs/TFMessage")()
    one = message_type("geometry_msgs/TransformStamped")()
    one.header.frame_id, one.child_frame_id = parent, child
    one.header.stamp.sec, one.transform.rotation.w = 5, 1.0
    message.transforms = [one]
    return message


def test_rules_of_the_graph(graph: Graph, robot: Node) -> None:
    other = graph.create_node("other", rosout=False)
    robot.create_subscription("/cmd_vel", "geometry_msgs/Twist", lambda message: None)
    robot.create_publisher("/count", "std_msgs/Int32")
    other.create_subscription("/count", "std_msgs/Float64", lambda message: None)
    for node in (robot, other):
        node.create_service("/twice", service_type("std_srvs/Empty"), lambda request: request)
    graph.parameters.set("/use_sim_time", True)
    for frames in (("map", "odom"), ("base_link", "laser")):
        talker = robot.create_publisher("/tf_static", "tf2_msgs/TFMessage", latch=True)
        talker.publish(_transform(*frames))
    found = look_at_graph(graph, 0.3)
    unconnected = "The following node subscriptions are unconnected:\n * /robot:\n   * /cmd_vel\n"
    assert unconnected in found.warnings
    assert "/use_sim_time is set but no publisher of /clock is present" in found.warnings
    assert any(
        " * service [/twice] is provided by /other, /robot\n" in one for one in found.warnings
    )
    assert any("their roots:\n * base_link\n * map\n" in one for one in found.warnings)
    (types,) = found.errors
    assert " * topic [/count] is std_msgs/msg/Float64 for /other\n" in types
    assert " * topic [/count] is std_msgs/msg/Int32 for /robot\n" in types


def test_contention_about_a_frame_is_an_error(graph: Graph, robot: Node, pump: Any) -> None:
    other = graph.create_node("other", rosout=False)
    talkers = [node.create_publisher("/tf", "tf2_msgs/TFMessage") for node in (robot, other)]
    stamps = itertools.count(1)

    def send() -> None:
        for one in talkers:
            message = _transform("odom", "base_link")
            message.transforms[0].header.stamp.sec = next(stamps)
            one.publish(message)

    pump(send)
    (text,) = look_at_graph(graph, 0.5).errors
    assert text.startswith("TF problems:\n * ")
    assert "'base_link' is published by /other and by /robot" in text


def test_missing_file_ends_with_one(capsys: Any) -> None:
    assert roswtf.main(["no.launch"]) == 1
    assert "roswtf: cannot locate file: no.launch" in capsys.readouterr().out
