"""What a script's source says of its topics, and when it says that it does not know."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from gazelle.doctor.script_topics import ScriptTopics, read_script

Read = Callable[[str], ScriptTopics]

_HEAD = "import rospy\nfrom std_msgs.msg import String\n"


@pytest.fixture
def read(tmp_path: Path) -> Read:
    """Reads a source."""

    def run(source: str) -> ScriptTopics:
        path = tmp_path / f"node{len(list(tmp_path.iterdir()))}.py"
        path.write_text(source, encoding="utf-8")
        return read_script(path)

    return run


def test_literal_names_and_types_of_rospy_are_read(read: Read) -> None:
    found = read(
        _HEAD + "rospy.Publisher('out', String, queue_size=1)\n"
        "rospy.Subscriber(name='in', data_class=String, callback=print)\n"
    )
    assert (found.publishes, found.listens) == (
        {"out": "std_msgs/msg/String"},
        {"in": "std_msgs/msg/String"},
    )
    assert found.is_complete
    out, heard = found.uses
    places = [(span.line, span.column) for use in (out, heard) for span in use[3:]]
    assert places == [(3, 17), (3, 24), (4, 23), (4, 40)]


def test_names_of_rclpy_are_read(read: Read) -> None:
    found = read(
        "from rclpy.node import Node\nimport std_msgs.msg\nclass N(Node):\n"
        "    def __init__(self):\n"
        "        self.create_publisher(std_msgs.msg.String, '/out', 10)\n"
        "        self.create_subscription(std_msgs.msg.String, 'in', print, 10)\n"
    )
    assert found.publishes == {"/out": "std_msgs/msg/String"}
    assert found.listens == {"in": "std_msgs/msg/String"}
    assert found.is_complete


def test_constant_of_the_module_is_a_name(read: Read) -> None:
    found = read(_HEAD + "TOPIC = 'out'\nrospy.Publisher(TOPIC, String)\n")
    assert found.publishes == {"out": "std_msgs/msg/String"}
    assert found.is_complete


@pytest.mark.parametrize(
    "source",
    [
        "rospy.Publisher(rospy.get_param('~topic'), String)\n",
        "NAME = 'a'\nNAME = 'b'\nrospy.Publisher(NAME, String)\n",
        "exec(open('other.py').read())\n",
        "from .other import talk\n",
        "import actionlib\nactionlib.SimpleActionClient('move', None)\n",
        "def broken(:\n",
    ],
    ids=["computed", "bound twice", "exec", "own module", "action", "no Python"],
)
def test_what_may_use_other_topics_is_not_complete(read: Read, source: str) -> None:
    assert not read(_HEAD + source).is_complete


def test_python_2_is_read(read: Read) -> None:
    found = read(_HEAD + "print 'hello'\nrospy.Publisher('out', String)\n")
    assert found.publishes == {"out": "std_msgs/msg/String"}


def test_broadcaster_of_tf_is_seen(read: Read) -> None:
    assert read(_HEAD + "import tf\ntf.TransformBroadcaster()\n").sends_transforms
    assert not read(_HEAD).sends_transforms


def test_missing_file_is_not_complete(tmp_path: Path) -> None:
    assert not read_script(tmp_path / "none.py").is_complete


@pytest.mark.parametrize(
    ("source", "kind"),
    [
        ("from std_msgs.msg import String as S\nrospy.Publisher('a', S)\n", "std_msgs/msg/String"),
        ("import std_msgs.msg as m\nrospy.Publisher('a', m.String)\n", "std_msgs/msg/String"),
        ("from std_msgs import msg\nrospy.Publisher('a', msg.String)\n", "std_msgs/msg/String"),
        ("from messages import String\nrospy.Publisher('a', String)\n", "String"),
        ("rospy.Publisher('a', rospy.AnyMsg)\n", ""),
        ("rospy.Publisher('a', kind())\n", ""),
    ],
)
def test_a_type_is_what_its_import_says(read: Read, source: str, kind: str) -> None:
    assert read("import rospy\n" + source).publishes == {"a": kind}


@pytest.mark.parametrize(
    "call",
    [
        "message_filters.Subscriber('a', String)",
        "message_filters.Subscriber(self, String, 'a')",
        "rospy.wait_for_message('a', String)",
        "wait_for_message(String, self, 'a')",
        "self.create_subscription(msg_type=String, topic='a', callback=print, qos_profile=1)",
    ],
)
def test_every_way_to_listen_is_read(read: Read, call: str) -> None:
    assert read(_HEAD + call + "\n").listens == {"a": "std_msgs/msg/String"}
