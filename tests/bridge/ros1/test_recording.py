"""Bags recorded here and by the real rosbag say the same of their connections, to the byte."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from tests.bridge.ros1.peer import Peer, string_bytes
from tests.bridge.ros1.real import Ros1
from tests.patience import stretched

from gazelle.bag import open_bag
from gazelle.bag.ros1.records import Op, read_record
from gazelle.bridge.ros1 import Bridge
from gazelle.graph import Graph
from gazelle.interfaces import md5sum

Eventually = Callable[[Callable[[], Any]], Any]
TALKERS = """
import rospy
from std_msgs.msg import String
from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import Odometry
rospy.init_node("talker")
outs = [rospy.Publisher("/word", String, queue_size=1),
        rospy.Publisher("/odom", Odometry, queue_size=1),
        rospy.Publisher("/pose", PoseStamped, queue_size=1, latch=True)]
outs[2].publish(PoseStamped())
while not rospy.is_shutdown():
    for out in outs[:2]:
        out.publish(out.data_class())
    rospy.rostime.wallsleep(0.02)
"""


def connection_headers(path: Path) -> dict[str, bytes]:
    """The data of the connection records at the end of a bag, by topic."""
    found: dict[str, bytes] = {}
    with path.open("rb") as file:
        end = file.seek(0, 2)
        header = read_record(file, 13, end)
        assert header is not None
        place = int.from_bytes(header.fields["index_pos"], "little")
        while place < end and (record := read_record(file, place, end)) is not None:
            if record.op == Op.CONNECTION:
                file.seek(record.start)
                found[record.fields["topic"].decode()] = file.read(record.size)
            place = record.end
    return found


def ours(graph: Graph, *words: str, folder: Path) -> subprocess.Popen[str]:
    environ = {**os.environ, "GAZELLE_PORT": str(graph.port)}
    command = [sys.executable, "-m", "gazelle.cli", *words]
    return subprocess.Popen(command, cwd=folder, env=environ, text=True)


@pytest.mark.reference
@pytest.mark.slow
def test_connection_headers_are_those_of_the_real_rosbag(
    graph: Graph, real_ros: None, bridge: Bridge, tmp_path: Path, eventually: Eventually
) -> None:
    ros, topics = Ros1(bridge.master.uri, tmp_path), ("/word", "/odom", "/pose")
    with ros.python(TALKERS):
        eventually(lambda: "/odom" in ros("rostopic", "list"))
        words = ("record", "-l", "1", *topics)
        recorder = ours(graph, "rosbag", *words, "-O", "ours.bag", folder=tmp_path)
        ros("rosbag", *words, "-O", "theirs.bag")
        assert recorder.wait(stretched()) == 0
    mine, theirs = (connection_headers(tmp_path / f"{one}.bag") for one in ("ours", "theirs"))
    assert set(theirs) == set(topics)
    assert mine == theirs
    assert ros("rosbag", "check", "ours.bag") == "Bag file does not need any migrations.\n"


def test_the_text_that_a_publisher_sends_is_recorded(
    graph: Graph, peer: Peer, tmp_path: Path, eventually: Eventually
) -> None:
    text = "# Words of the peer.\nstring data  # said\n"
    messages = [string_bytes(f"{k}") for k in range(3)]
    recorder = ours(graph, "rosbag", "record", "-l", "3", "-O", "a.bag", "/w", folder=tmp_path)
    eventually(lambda: any(one.name == "/w" for one in graph.discovery.known()))
    peer.publish_on("/w", "std_msgs/String", md5sum("std_msgs/String"), *messages, text=text)
    assert recorder.wait(stretched()) == 0
    (one,) = open_bag(tmp_path / "a.bag").connections
    assert (one.definition, one.callerid) == (text, "/peer")
