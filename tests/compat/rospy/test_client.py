"""Names, remapping arguments, parameters, shutdown."""

from __future__ import annotations

import signal
from collections.abc import Callable
from typing import Any

import pytest

from gazelle.graph import Graph

Run = Callable[..., Any]

_NAMES = """
import sys, rospy
assert rospy.myargv(sys.argv)[1:] == ["--own", "word"]
assert rospy.get_name() == "/robot/unnamed"
rospy.init_node("original")
assert rospy.get_name() == "/robot/given", rospy.get_name()
assert rospy.get_namespace() == "/robot/"
assert rospy.get_param("~rate") == 5 and rospy.get_param("/robot/given/who") == "me"
assert rospy.resolve_name("scan") == "/robot/laser"
assert rospy.resolve_name("~own") == "/robot/given/own"
assert rospy.resolve_name("/abs") == "/abs" and rospy.resolve_name("other") == "/robot/other"
assert rospy.remap_name("scan") == "/robot/laser"
from std_msgs.msg import String
assert rospy.Publisher("scan", String, queue_size=1).resolved_name == "/robot/laser"
assert rospy.Publisher("~status", String, queue_size=1).resolved_name == "/robot/given/status"
try:
    rospy.init_node("another")
    raise AssertionError("nothing raised")
except rospy.ROSException as error:
    assert "has already been called with different arguments" in str(error)
"""


def test_remapping_arguments_give_names_parameters_and_namespace(passes: Run) -> None:
    passes(
        _NAMES, "--own", "scan:=laser", "_rate:=5", "_who:=me", "__name:=given", "__ns:=robot",
        "word",
    )  # fmt: skip


def test_anonymous_nodes_have_names_of_their_own(passes: Run) -> None:
    passes(
        "import re, rospy\nrospy.init_node('watcher', anonymous=True)\n"
        "assert re.fullmatch(r'/watcher_\\w+_\\d+_\\d+', rospy.get_name()), rospy.get_name()\n"
    )


_PARAMETERS = """
import rospy
assert rospy.get_param("/before", 3) == 3
rospy.init_node("params")
rospy.set_param("~gains", {"p": 1.5, "d": [1, 2]})
assert rospy.get_param("~gains/p") == 1.5 and rospy.get_param("/params/gains")["d"] == [1, 2]
assert rospy.get_param_cached("~gains/p") == 1.5
assert rospy.has_param("~gains") and not rospy.has_param("~none")
rospy.set_param("/robot_description", "<robot/>")
assert rospy.search_param("robot_description") == "/robot_description"
assert rospy.search_param("nothing") is None
assert "/params/gains/p" in rospy.get_param_names()
rospy.delete_param("~gains/p")
for missing in ("~gains/p", "nothing"):
    try:
        rospy.get_param(missing)
        raise AssertionError("nothing raised")
    except KeyError as error:
        assert error.args[0] == rospy.resolve_name(missing)
assert rospy.get_param("nothing", None) is None
assert rospy.get_param("/of_test") == "hello"
"""


_BYTES = """
import rospy, rosparam, yaml
from xmlrpc.client import Binary
rospy.init_node("bytes")
found = rospy.get_param("/file")
assert isinstance(found, Binary) and found.data == b"\\x00\\xff", found
assert rospy.get_param("/")["file"].data == found.data
rospy.set_param("/copy", {"of": [found]})
assert rospy.get_param("/copy/of")[0] == found
rosparam.dump_params("dumped.yaml", "/copy")
assert yaml.safe_load(open("dumped.yaml")) == {"of": [b"\\x00\\xff"]}
"""


def test_bytes_are_binary_as_in_rospy(passes: Run, graph: Graph) -> None:
    graph.parameters.set("/file", b"\x00\xff")
    passes(_BYTES)
    assert graph.parameters.get("/copy/of") == [b"\x00\xff"]


def test_parameters_are_shared_with_the_graph(passes: Run, graph: Graph) -> None:
    graph.parameters.set("/of_test", "hello")
    passes(_PARAMETERS)
    assert graph.parameters.get("/params/gains/d") == [1, 2]


_SHUTDOWN = """
import rospy
from std_msgs.msg import String
rospy.init_node("ending")
pub = rospy.Publisher("last_words", String, queue_size=1)
def first():
    print("first", rospy.is_shutdown(), rospy.is_shutdown_requested(), flush=True)
    pub.publish("bye")
def broken():
    raise RuntimeError("a hook may fail")
rospy.on_shutdown(first)
rospy.on_shutdown(broken)
rospy.on_shutdown(lambda: print("third", flush=True))
print("ready", flush=True)
{wait}
print("after", rospy.is_shutdown(), flush=True)
rospy.on_shutdown(lambda: print("at once", flush=True))
rospy.sleep(0.01)
print("slept", flush=True)
pub.publish("too late")
print("published to nobody", pub.get_num_connections(), flush=True)
"""
_WAYS = {
    "spin": "rospy.spin()",
    "rate": "rate = rospy.Rate(100)\nwhile not rospy.is_shutdown():\n    rate.sleep()",
    "sleep": "rospy.sleep(60)",
}


@pytest.mark.parametrize("way", sorted(_WAYS))
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_hooks_run_before_the_node_is_shut_down_and_may_publish(
    program: Run, node: Any, way: str, number: signal.Signals
) -> None:
    heard: list[str] = []
    node.create_subscription(
        "/last_words", "std_msgs/msg/String", lambda message: heard.append(message.data)
    )
    ending = program(_SHUTDOWN.format(wait=_WAYS[way]))
    ending.wait_for_line("^ready$")
    assert ending.stop(number) == 0, ending.text
    said = [line for line in ending.lines if line.split()[0] in {"first", "third", "after", "at"}]
    assert said == ["first False True", "third", "after True", "at once"]
    assert "RuntimeError: a hook may fail" in ending.text
    assert "slept" in ending.lines and "published to nobody 0" in ending.lines
    ending.eventually(lambda: heard == ["bye"])


def test_node_of_the_same_name_ends_the_older_one(program: Run, graph: Graph) -> None:
    older = program(
        "import rospy\nrospy.init_node('twin')\nprint('ready', flush=True)\nrospy.spin()"
    )
    older.wait_for_line("^ready$")
    graph.create_node("twin")
    assert older.wait() == 0


def test_loop_that_never_asks_is_ended_by_sigterm(program: Run) -> None:
    deaf = program(
        "import rospy, time\nrospy.init_node('deaf')\nprint('ready', flush=True)\n"
        "while True:\n    time.sleep(0.01)\n"
    )
    deaf.wait_for_line("^ready$")
    assert deaf.stop(signal.SIGTERM) == 128 + signal.SIGTERM


_FROM_CALLBACK = """
import rospy
from std_msgs.msg import Empty
rospy.init_node("brief")
pub = rospy.Publisher("over", Empty, queue_size=1)
rospy.Subscriber("over", Empty, lambda message: rospy.signal_shutdown("heard it"))
pub.publish()
rospy.spin()
"""


def test_callback_may_shut_the_node_down(passes: Run) -> None:
    passes(_FROM_CALLBACK)
