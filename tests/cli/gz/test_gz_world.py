"""``gz model``, ``world``, ``stats``, ``joint`` and ``topic`` against a world."""

from __future__ import annotations

import io
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from gazelle.cli.gz.protobuf_text import number_text, protobuf_text
from gazelle.cli.gz.stats import stats_line
from gazelle.cli.gz.world_link import pose_line
from gazelle.graph import Graph
from gazelle.simulator import Simulation

Run = Callable[..., Any]

BOX = """<sdf version="1.6"><model name="box"><link name="link"><collision name="c"><geometry>
<box><size>0.2 0.2 0.2</size></box></geometry></collision></link></model></sdf>"""


def test_pose_of_a_model(world: Simulation, gz: Run) -> None:
    found = gz("model", "-m", "arm", "-p")
    assert found == (0, "1 -0.5 0.15 0 0 0.25\n", "")


def test_pose_keeps_coordinates_that_are_not_given(world: Simulation, gz: Run) -> None:
    assert gz("model", "-m", "arm", "-x", "-2", "-Y", "1.5").code == 0
    assert gz("model", "-m", "arm", "-p").out == "-2 -0.5 0.15 0 0 1.5\n"


def test_model_is_spawned_and_deleted(
    world: Simulation, gz: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = tmp_path / "box.sdf"
    file.write_text(BOX, encoding="utf-8")
    assert gz("model", "-m", "crate", "-f", str(file), "-z", "2").code == 0
    assert gz("model", "-m", "crate", "-p").out == "0 0 2 0 0 0\n"
    again = gz("model", "-m", "crate", "-f", str(file))
    assert (again.code, again.err) == (255, "SpawnModel: Failure - entity already exists.\n")
    assert gz("model", "-m", "crate", "-d").code == 0
    monkeypatch.setattr("sys.stdin", io.StringIO(BOX))
    assert gz("model", "-m", "piped", "-s").code == 0
    assert "crate" not in {model.name for model in world.server.engine.world.models}
    assert "piped" in {model.name for model in world.server.engine.world.models}


def test_facts_of_a_model_are_in_gazebos_layout(world: Simulation, gz: Run) -> None:
    lines = gz("model", "-m", "arm", "-i").out.splitlines()
    assert lines[:5] == ['name: "arm"', "is_static: false", "pose {", "  position {", "    x: 1"]
    at = lines.index("joint {")
    assert lines[at + 1 : at + 5] == [
        '  name: "arm::swing"', "  angle: 0", "  type: REVOLUTE", "}",
    ]  # fmt: skip
    assert '  name: "arm::bob"' in lines


def test_unknown_model_names_what_is_spelled_alike(world: Simulation, gz: Run) -> None:
    found = gz("model", "-m", "amr", "-p")
    assert found.code == 255
    assert found.err.startswith("Unable to get info on model[amr]: it is not in the world; ")
    assert "arm" in found.err
    assert gz("model", "-p").err.startswith("A model name is required")
    assert gz("model", "-m", "arm", "-f", "no.sdf").err.startswith("Unable to open file[no.sdf]")
    endless = gz("model", "-m", "arm", "-f", "/dev/zero").err
    assert endless.startswith("Unable to open file[/dev/zero]: ")
    assert "it is a device, not a file" in endless
    assert gz("model", "-m", "arm", "-x", "far").err == "--pose-x: 'far' is not a number\n"


def test_world_takes_exactly_so_many_steps(world: Simulation, gz: Run) -> None:
    assert gz("world", "-m", "25").code == 0
    assert world.server.time_ns == 25_000_000
    assert gz("world", "-s").code == 0
    assert world.server.time_ns == 26_000_000
    assert world.server.paused
    assert gz("world", "-o").code == 0
    assert world.server.time_ns == 26_000_000
    assert gz("world", "-r").code == 0
    assert world.server.time_ns == 0


def test_world_is_paused_and_goes_on(world: Simulation, gz: Run) -> None:
    assert gz("world", "-p", "0").code == 0
    assert [world.server.paused, gz("world", "-p", "1").code] == [False, 0]
    assert [world.server.paused] == [True]
    assert gz("world", "-p", "yes").err == "--pause is 0 or 1, not 'yes'\n"
    assert gz("world", "-m", "1.5").err.startswith("--multi-step is a whole number above 0")
    assert gz("world", "-t").err.startswith("time alone is not reset here")
    assert gz("world").err == "nothing to do; see gz help world\n"


def test_force_on_a_joint_stays(world: Simulation, gz: Run) -> None:
    assert gz("joint", "-m", "arm", "-j", "swing", "-f", "0.5").code == 0
    gz("world", "-m", "100")
    slow = world.server.engine.joint("arm::swing").velocity
    gz("world", "-m", "100")
    assert world.server.engine.joint("arm::swing").velocity > 1.5 * slow > 0
    wrong = gz("joint", "-m", "arm", "-j", "swign", "-f", "1")
    assert wrong.err.startswith("model[arm] has no joint[swign]; ")
    assert "use" in gz("help", "joint").err
    refused = gz("joint", "-m", "arm", "-j", "swing", "--pos-t", "1")
    assert refused.code == 255
    assert "effort_controllers/JointPositionController" in refused.err


def test_stats_of_a_paused_world(world: Simulation, gz: Run) -> None:
    found = gz("stats", "-p", "-d", "0.3")
    head, line = found.out.splitlines()[:2]
    assert head == "# real-time factor (percent), simtime (sec), realtime (sec), paused (T or F)"
    assert re.fullmatch(r"0\.00,         0\.000000,         0\.\d{6}, T", line)
    assert "realtime is counted from here on" in found.err


def test_stats_lines_are_those_of_gazebo(own_workspaces_dir: Path) -> None:
    text = (own_workspaces_dir / "recorded/gazebo/gzserver_tools.txt").read_text("utf-8")
    assert stats_line(1.03, 7.833, 8.156617, paused=False, plot=True) in text.splitlines()
    assert pose_line((-0.000119, -3.2e-05, 0.15, 0.0, -1e-9, 3.7e-05)) in text.splitlines()
    line = stats_line(1.0, 2.5, 2.75, paused=True, plot=False)
    assert line == "Factor[1.00] SimTime[2.50] RealTime[2.75] Paused[T]"


def test_numbers_have_the_digits_of_protocol_buffers() -> None:
    assert number_text(0.1998109413747528) == "0.1998109413747528"
    assert number_text(-4.2517397209277283e-05) == "-4.2517397209277283e-05"
    assert number_text(0.15) == "0.15"
    assert number_text(float("nan")) == "nan"
    text = protobuf_text({"scan": {"frame": 'a"b', "ranges": [1.5, 2.0]}, "on": True})
    assert text == 'scan {\n  frame: "a\\"b"\n  ranges: 1.5\n  ranges: 2\n}\non: true\n'


def test_topics_are_listed_and_told(world: Simulation, graph: Graph, gz: Run) -> None:
    node = graph.create_node("robot", rosout=False)
    talker = node.create_publisher("/robot/pose", "geometry_msgs/PoseStamped", latch=True)
    message = talker.message_class()
    message.header.stamp.sec, message.pose.position.x = 3, 0.5
    talker.publish(message)
    assert "/robot/pose" in gz("topic", "-l").out.splitlines()
    told = gz("topic", "-i", "pose").out
    assert told.startswith("Type: geometry_msgs/msg/PoseStamped\n\nPublishers:\n\tgazelle://")
    assert " /robot\n\nSubscribers:\n\n" in told
    echoed = gz("topic", "-e", "/robot/pose", "-d", "0.5").out
    assert "  stamp {\n    sec: 3\n    nsec: 0\n  }\n" in echoed
    assert "pose {\n  position {\n    x: 0.5\n" in echoed
    assert gz("topic", "-e", "/robot/psoe").err.startswith("Unable to find topic[/robot/psoe]; ")
    assert "rostopic pub" in gz("topic", "-p", "/x", "-m", "1").err


def test_rate_and_bandwidth_of_a_topic(world: Simulation, gz: Run) -> None:
    gz("world", "-p", "0")
    assert re.match(r"Hz: +\d+\.\d\d\n", gz("topic", "-z", "/clock", "-d", "0.3").out)
    told = gz("topic", "-b", "/clock", "-d", "0.3").out
    sizes = r"Total\[ *[\d.]+ K?B/s\] Mean\[ *[\d.]+ B\] Min\[.*\] Max\[.*\] Messages\[\d+\]\n"
    assert re.match(sizes, told)


def test_without_a_world_nothing_is_done(graph: Graph, gz: Run, monkeypatch: Any) -> None:
    monkeypatch.setattr("gazelle.cli.gz.world_link._WAIT_S", 0.05)
    found = gz("world", "-p", "1")
    assert found.code == 255
    assert found.err.startswith("no world is running on this graph (/gazebo/control_world is not")
    assert gz("world", "--paws", "1").err.startswith("Invalid arguments: option --paws not")
    assert gz("world", "-s", "now").err == "Invalid arguments: 'now' belongs to no option\n"
    assert "-p [ --pause ] arg" in gz("world", "-h").err
