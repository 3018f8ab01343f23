"""Names that programs take from rospy.core, rospy.names, rospy.msg and their like."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

Run = Callable[..., Any]

_NAMES = """
import rospy, rospy.core, rospy.names
assert rospy.names.get_mappings() == {"scan": "laser", "__ns": "robot"}
assert rospy.names.resolve_name_without_node_name("scan") == "/robot/laser"
try:
    rospy.names.resolve_name_without_node_name("~scan")
    raise SystemExit("nothing raised")
except ValueError as error:
    assert str(error) == "~name topics cannot be created before init_node() has been called"
assert rospy.names.get_resolved_mappings() == {}
rospy.init_node("one")
assert rospy.names.get_resolved_mappings()["/robot/scan"] == "/robot/laser"
assert rospy.remap_name("scan", caller_id="/other/node") == "/other/laser"
assert rospy.remap_name("camera") == "camera"
assert rospy.names.scoped_name("/robot/one", "/robot/arm/joint") == "arm/joint"
assert rospy.core.is_topic("topic")("a//b/", "/robot/one") == "/robot/a/b"
assert rospy.names.valid_name("name", resolve=False)("a", "/x") == "a"
for check, value, words in (
    (rospy.names.valid_name("name"), "http://x", "parameter [name] contains illegal chars"),
    (rospy.names.global_name("name"), "a", "must be a globally referenced name"),
    (rospy.core.is_topic("name"), "/", "cannot be the global namespace"),
):
    try:
        check(value, "/robot/one")
        raise SystemExit("nothing raised")
    except rospy.core.ParameterInvalid as error:
        assert words in str(error), error
assert rospy.parse_rosrpc_uri("rosrpc://host:80/more") == ("host", 80)
assert rospy.core.loginfo is rospy.topics.logout is rospy.loginfo
assert rospy.client.wait_for_message is rospy.wait_for_message
"""

_BYTES = """
import io
from rospy.msg import deserialize_messages, serialize_message
from std_msgs.msg import Int32, String, Header
buffer = io.BytesIO()
for number in range(3):
    serialize_message(buffer, number, Int32(number))
assert buffer.getvalue()[:8] == b"\\x04\\0\\0\\0\\0\\0\\0\\0"
buffer.write(b"\\x04\\0\\0")
found = []
deserialize_messages(buffer, found, Int32, queue_size=2)
assert [one.data for one in found] == [1, 2], found
assert buffer.getvalue() == b"\\x04\\0\\0" and buffer.tell() == 3
"""

_HOOKS = """
import rospy, rospy.core
rospy.init_node("hooked")
told = []
rospy.core.add_shutdown_hook(lambda reason: told.append(("after", reason, rospy.is_shutdown())))
rospy.core.add_preshutdown_hook(lambda reason: told.append(("before", reason)))
rospy.core.add_client_shutdown_hook(lambda: told.append(rospy.is_shutdown()))
rospy.on_shutdown(h=lambda: told.append("h"))
rospy.signal_shutdown("done")
assert told == [("before", "done"), False, "h", ("after", "done", True)], told
"""

_MASTER = """
import rospy
master = rospy.MasterProxy("http://localhost:11311")
master["/gain"] = 2.5
assert "/gain" in master and master["/gain"] == 2.5 and "/gain" in list(master)
del master["/gain"]
assert "/gain" not in master
rospy.init_node("loader")
rospy.client.load_command_line_node_params(["_rate:=5"])
assert rospy.get_param("/loader/rate") == 5
topic = rospy.topics.Topic("chatter", rospy.Header, "pub")
assert topic.reg_type == "pub" and topic.get_num_connections() == 0
"""


def test_names_are_remapped_scoped_and_checked_as_in_rospy(passes: Run) -> None:
    passes(_NAMES, "scan:=laser", "__ns:=robot")


def test_messages_become_bytes_with_lengths_and_back(passes: Run) -> None:
    passes(_BYTES)


def test_hooks_of_the_core_run_around_the_shutdown(passes: Run) -> None:
    passes(_HOOKS)


def test_the_master_is_a_mapping_of_parameters(passes: Run) -> None:
    passes(_MASTER)
