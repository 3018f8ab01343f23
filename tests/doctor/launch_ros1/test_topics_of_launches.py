"""Both ends of topics in a launch of ROS 1: types that differ, names that were misspelt."""

from __future__ import annotations

from pathlib import Path

import pytest
from tests.doctor.conftest import Examine, Write

from gazelle.diagnostics import Diagnostic
from gazelle.doctor import Report

ROBOT = """<robot name="r"><link name="base"><inertial><mass value="1"/>
<inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial>
<collision><geometry><box size="0.2 0.2 0.2"/></geometry></collision></link>
<gazebo reference="base"><sensor type="ray" name="laser"><update_rate>5</update_rate>
<ray><scan><horizontal><samples>3</samples><resolution>1</resolution><min_angle>-1</min_angle>
<max_angle>1</max_angle></horizontal></scan><range><min>0.1</min><max>9</max></range></ray>
<plugin name="laser" filename="libgazebo_ros_laser.so"><topicName>scan</topicName>
<frameName>base</frameName></plugin></sensor></gazebo></robot>"""
LAUNCH = """<launch><param name="/use_sim_time" value="true"/>
<param name="robot_description" textfile="$(find bot)/urdf/bot.urdf"/>
<node name="gazebo" pkg="gazebo_ros" type="gzserver"/>
<node name="spawn" pkg="gazebo_ros" type="spawn_model"
      args="-urdf -param robot_description -model bot"/>
{nodes}
</launch>"""
SCRIPT = """#!/usr/bin/env python3
import rospy
from sensor_msgs.msg import Image, LaserScan
from std_msgs.msg import Int32, String

rospy.init_node("node")
{}
rospy.spin()
"""


def _node(name: str, inside: str = "", ns: str = "") -> str:
    space = f' ns="{ns}"' if ns else ""
    return f'<node name="{name}" pkg="bot" type="{name}.py"{space}>{inside}</node>'


def _launch(written: Write, nodes: str, **scripts: str) -> Path:
    files = {f"scripts__{name}.py": SCRIPT.format(text) for name, text in scripts.items()}
    folder = written(
        **files,
        **{"urdf__bot.urdf": ROBOT, "launch__bot.launch": LAUNCH.format(nodes=nodes)},
    )
    for name in scripts:
        (folder / "scripts" / f"{name}.py").chmod(0o755)
    return folder


def _told(report: Report) -> list[Diagnostic]:
    return [item for item in report.findings if item.code.startswith("doctor.topic-")]


def _place(item: Diagnostic) -> str:
    assert item.span is not None
    return f"{item.span.file.rpartition('/')[2]}:{item.span.line}:{item.span.column}"


def test_type_that_a_sensor_does_not_send(written: Write, examined: Examine) -> None:
    folder = _launch(written, _node("look"), look="rospy.Subscriber('scan', Image, print)")
    (item,) = _told(examined(folder, "bot", "bot.launch"))
    assert item.code == "doctor.topic-type"
    assert item.message == (
        "'/look' listens to '/scan' as sensor_msgs/Image, and '/gazebo' publishes it as "
        "sensor_msgs/LaserScan: no message arrives"
    )
    assert _place(item) == "look.py:7:26"
    assert item.fix == "from sensor_msgs.msg import LaserScan"
    assert item.phrase == (
        "topic types do not match: [sensor_msgs/Image] vs. [sensor_msgs/LaserScan]"
    )


def test_two_scripts_of_two_types_are_one_finding(written: Write, examined: Examine) -> None:
    folder = _launch(
        written,
        _node("talk") + _node("hear"),
        talk="rospy.Publisher('chatter', String, queue_size=1)",
        hear="rospy.Subscriber('/chatter', Int32, print)",
    )
    (item,) = _told(examined(folder, "bot", "bot.launch"))
    assert item.message == (
        "'/hear' listens to '/chatter' as std_msgs/Int32, and '/talk' (talk.py:7) publishes it as "
        "std_msgs/String: no message arrives"
    )
    assert _place(item) == "hear.py:7:30"


def test_of_three_scripts_the_odd_one_is_told(written: Write, examined: Examine) -> None:
    hear = "rospy.Subscriber('chatter', Int32, print)"
    talk = "rospy.Publisher('chatter', String, queue_size=1)"
    nodes = _node("talk") + _node("hear") + _node("also")
    folder = _launch(written, nodes, talk=talk, hear=hear, also=hear)
    (item,) = _told(examined(folder, "bot", "bot.launch"))
    assert _place(item) == "talk.py:7:28"
    assert "'/hear' (hear.py:7), '/also' (also.py:7) listen to it as std_msgs/Int32" in item.message


@pytest.mark.parametrize(
    ("code", "inside"),
    [
        ("rospy.Subscriber('scan', LaserScan, print)", ""),
        ("rospy.Subscriber('scan', rospy.AnyMsg, print)", ""),
        ("rospy.Subscriber('other', Image, print)", ""),
        ("rospy.Subscriber('scan', Image, print)", '<remap from="scan" to="picture"/>'),
        ("[rospy.Subscriber('scan', Image), rospy.Subscriber('scan', LaserScan)]", ""),
    ],
    ids=["same type", "any type", "another topic", "remapped", "in two branches"],
)
def test_types_that_may_meet_are_not_told(
    written: Write, examined: Examine, code: str, inside: str
) -> None:
    folder = _launch(written, _node("look", inside), look=code)
    assert _told(examined(folder, "bot", "bot.launch")) == []


@pytest.mark.parametrize(
    ("code", "ns", "wrong", "fix"),
    [
        ("rospy.Subscriber('scna', LaserScan, print)", "", "/scna", "scan"),
        ("rospy.Subscriber('/scann', LaserScan, print)", "robot", "/scann", "/scan"),
        ("rospy.Subscriber('laser_scan', LaserScan, print)", "", "/laser_scan", "scan"),
    ],
)
def test_misspelt_topic_is_told_at_its_place(
    written: Write, examined: Examine, code: str, ns: str, wrong: str, fix: str
) -> None:
    folder = _launch(written, _node("look", ns=ns), look=code)
    (item,) = _told(examined(folder, "bot", "bot.launch"))
    assert item.code == "doctor.topic-misspelt"
    node = f"/{ns}/look" if ns else "/look"
    assert item.message == (
        f"'{node}' listens to '{wrong}', which nobody in this launch is known to publish; there is "
        "'/scan'"
    )
    assert _place(item) == "look.py:7:18"
    assert item.fix == f"did you mean '{fix}'?"


def test_misspelt_topic_of_a_publisher(written: Write, examined: Examine) -> None:
    folder = _launch(
        written,
        _node("talk") + _node("hear"),
        talk="rospy.Publisher('/comands', String, queue_size=1)",
        hear="rospy.Subscriber('commands', String, print)",
    )
    told = _told(examined(folder, "bot", "bot.launch"))
    assert sorted(map(_place, told)) == ["hear.py:7:18", "talk.py:7:17"]
    assert (
        "which nobody in this launch is known to listen to; there is '/commands'" in told[0].message
    )


@pytest.mark.parametrize(
    ("code", "nodes"),
    [
        ("rospy.Subscriber('scan_1', LaserScan, print)", ""),
        ("rospy.Subscriber('scam', Image, print)", ""),
        ("rospy.Publisher('scans', LaserScan, queue_size=1)", ""),
        (
            "rospy.Subscriber('scna', LaserScan, print)",
            '<node name="x" pkg="bot" type="native"><remap from="a" to="scna"/></node>',
        ),
    ],
    ids=["numbered", "of another type", "nobody hears the other", "of a node nobody knows"],
)
def test_names_on_purpose_are_not_told(
    written: Write, examined: Examine, code: str, nodes: str
) -> None:
    folder = _launch(written, _node("look") + nodes, look=code)
    (folder / "native").write_bytes(b"\x7fELF")
    (folder / "native").chmod(0o755)
    assert _told(examined(folder, "bot", "bot.launch")) == []


def test_a_slip_is_told_beside_nodes_of_which_nothing_is_known(
    written: Write, examined: Examine
) -> None:
    nodes = _node("look") + '<node name="x" pkg="bot" type="native"/>'
    folder = _launch(written, nodes, look="rospy.Subscriber('scna', LaserScan, print)")
    (folder / "native").write_bytes(b"\x7fELF")
    (folder / "native").chmod(0o755)
    (item,) = _told(examined(folder, "bot", "bot.launch"))
    assert "which nobody in this launch is known to publish; there is '/scan'" in item.message


@pytest.mark.parametrize(
    ("remap", "fix"),
    [
        ('from="scann" to="picture"', "scan"),
        ('from="/laser/scan" to="picture"', "/scan"),
        # What is at the other end says which name is meant.
        ('from="laser" to="echo"', "scan"),
        ('from="imag" to="echo"', "scan"),
    ],
)
def test_remap_of_a_name_that_nobody_uses_offers_one_that_helps(
    written: Write, examined: Examine, remap: str, fix: str
) -> None:
    look = "rospy.Subscriber('scan', LaserScan, print)\n"
    look += "rospy.Publisher('image', Image, queue_size=1)\nrospy.Subscriber('text', String)"
    nodes = _node("look", f"\n<remap {remap}/>\n") + _node("talk")
    talk = "rospy.Publisher('echo', LaserScan, queue_size=1)"
    folder = _launch(written, nodes, look=look, talk=talk)
    report = examined(folder, "bot", "bot.launch")
    (item,) = (one for one in report.findings if one.code == "doctor.remap-unused")
    assert item.message.endswith(
        "is of no use: /look does not use " + f"'{remap.split(chr(34))[1]}'"
    )
    assert _place(item) == "bot.launch:7:14"
    assert item.fix == f"did you mean '{fix}'?"


def test_remap_that_is_used_is_not_told(written: Write, examined: Examine) -> None:
    inside = '<remap from="scan" to="picture"/><remap from="~text" to="echo"/>'
    look = "rospy.Subscriber('scan', LaserScan, print)\nrospy.Subscriber('~text', String)"
    folder = _launch(written, _node("look", inside), look=look)
    report = examined(folder, "bot", "bot.launch")
    assert [one for one in report.findings if one.code == "doctor.remap-unused"] == []


@pytest.mark.parametrize("words", [("bot", "bot.launch"), ("bot",)])
@pytest.mark.parametrize(
    ("code", "place", "words_told"),
    [
        (
            "rospy.Subscriber('scna', LaserScan, print)",
            "hand.py:7:18",
            "'hand.py' listens to '/scna', which nobody here is known to publish; there is '/scan'",
        ),
        (
            "rospy.Subscriber('scan', Image, print)",
            "hand.py:7:26",
            "'hand.py' listens to '/scan' as sensor_msgs/Image, and '/gazebo' publishes it as "
            "sensor_msgs/LaserScan: no message arrives",
        ),
    ],
)
def test_script_that_is_run_by_hand_is_compared_with_the_launch(
    written: Write,
    examined: Examine,
    words: tuple[str, ...],
    code: str,
    place: str,
    words_told: str,
) -> None:
    folder = _launch(written, "", hand=code)
    (item,) = _told(examined(folder, *words))
    assert (item.message, _place(item)) == (words_told, place)
    assert str(item.severity) == "warning"


def test_scripts_that_are_run_by_hand_are_compared_with_each_other(
    written: Write, examined: Examine
) -> None:
    talk = "rospy.Publisher('chatter', String, queue_size=1)"
    folder = _launch(written, "", talk=talk, hear="rospy.Subscriber('chater', String, print)")
    told = _told(examined(folder, "bot"))
    assert sorted(map(_place, told)) == ["hear.py:7:18", "talk.py:7:17"]


@pytest.mark.parametrize(
    "code",
    [
        "rospy.Subscriber('scan', LaserScan, print)",
        "rospy.Publisher('cmd_vel', String, queue_size=1)",
        "rospy.Subscriber('front_scan', LaserScan, print)",
    ],
)
def test_script_that_is_run_by_hand_may_have_topics_of_its_own(
    written: Write, examined: Examine, code: str
) -> None:
    assert _told(examined(_launch(written, "", hand=code), "bot")) == []
