"""Real programs of ROS 1 against the bridge, where they are installed (Debian's packages)."""

from __future__ import annotations

import re
import threading
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from tests.bridge.ros1.real import Ros1, skip_module_without_ros1
from tests.patience import stretched

from gazelle.bridge.ros1 import Bridge, MasterAddress
from gazelle.graph import Graph
from gazelle.interfaces import message_type, service_type

skip_module_without_ros1()
pytestmark = pytest.mark.reference
Eventually = Callable[[Callable[[], Any]], Any]

DRIVER = """
import rospy
from geometry_msgs.msg import Twist
rospy.init_node("driver")
out = rospy.Publisher("/cmd_vel", Twist, queue_size=1)
ahead = Twist()
ahead.linear.x = 0.2
while not rospy.is_shutdown():
    out.publish(ahead)
    rospy.rostime.wallsleep(0.05)
"""
SERVER = """
import rospy
from std_srvs.srv import SetBool, SetBoolResponse
rospy.init_node("server")
rospy.Service("/theirs", SetBool, lambda request: SetBoolResponse(request.data, "from rospy"))
rospy.spin()
"""


@pytest.fixture
def ros(real_ros: None, bridge: Bridge, tmp_path: Path) -> Ros1:
    return Ros1(bridge.master.uri, tmp_path)


@pytest.fixture
def talking(graph: Graph) -> Iterator[None]:
    """``/talker`` says ``hello`` on ``/chatter`` all the time."""
    out = graph.create_node("talker").create_publisher("/chatter", "std_msgs/msg/String")
    ended = threading.Event()

    def run() -> None:
        while not ended.wait(0.02):
            out.publish(out.message_class(data="hello"))

    thread = threading.Thread(target=run)
    thread.start()
    yield
    ended.set()
    thread.join()


@pytest.mark.usefixtures("talking")
def test_rostopic_and_rosnode_see_the_graph(ros: Ros1, eventually: Eventually) -> None:
    eventually(lambda: "/chatter" in ros("rostopic", "list"))
    assert ros("rostopic", "list") == "/chatter\n/rosout\n"
    assert ros("rostopic", "echo", "-n", "2", "/chatter") == 'data: "hello"\n---\n' * 2
    info = ros("rostopic", "info", "/chatter")
    assert re.search(r"Type: std_msgs/String\n\nPublishers: \n \* /talker \(http://127", info)
    assert ros("rosnode", "list") == "/talker\n"
    assert "xmlrpc reply from http://127.0.0.1:" in ros("rosnode", "ping", "-c", "1", "/talker")
    info = ros("rosnode", "info", "/talker")
    assert " * /chatter [std_msgs/String]\n * /rosout [rosgraph_msgs/Log]\n" in info
    assert re.search(r"\nPid: \d+\n", info)


@pytest.mark.usefixtures("talking")
def test_rosbag_records_the_graph(ros: Ros1, eventually: Eventually, tmp_path: Path) -> None:
    eventually(lambda: "/chatter" in ros("rostopic", "list"))
    ros("rosbag", "record", "-O", str(tmp_path / "a.bag"), "-l", "5", "/chatter")
    info = ros("rosbag", "info", str(tmp_path / "a.bag"))
    assert "/chatter   5 msgs    : std_msgs/String" in info
    assert "[992ce8a1687cec8c8bd883ec73ca41d1]" in info


def test_rospy_drives_what_listens_here(
    graph: Graph, ros: Ros1, inbox: Any, eventually: Eventually
) -> None:
    node = graph.create_node("base", rosout=False)
    node.create_subscription("/cmd_vel", "geometry_msgs/msg/Twist", inbox)
    with ros.python(DRIVER):
        assert {one.linear.x for one in inbox.wait_for(5)} == {0.2}
        assert "/driver" in graph.node_names()
    eventually(lambda: "/driver" not in graph.node_names())


def test_services_are_called_both_ways(graph: Graph, ros: Ros1, eventually: Eventually) -> None:
    kind = service_type("std_srvs/srv/SetBool")
    node = graph.create_node("here")
    node.create_service("/ours", kind, lambda request: kind.Response(message="from here"))
    eventually(lambda: "/ours" in ros("rosservice", "list"))
    assert ros("rosservice", "call", "/ours", "true") == 'success: False\nmessage: "from here"\n'
    assert ros("rosservice", "type", "/ours") == "std_srvs/SetBool\n"
    with ros.python(SERVER):
        client = node.create_client("/theirs", kind)
        assert client.wait_for_service(stretched())
        response = client.call(kind.Request(data=True), timeout_s=stretched())
        assert (response.success, response.message) == (True, "from rospy")


def test_parameters_are_read_and_set(graph: Graph, ros: Ros1) -> None:
    ros("rosparam", "set", "/arm", "{p: 1.5, names: [a, b]}")
    assert graph.parameters.get("/arm") == {"p": 1.5, "names": ["a", "b"]}
    graph.parameters.set("/arm/i", True)
    assert ros("rosparam", "get", "/arm") == "i: true\nnames:\n- a\n- b\np: 1.5\n\n"
    ros("rosparam", "delete", "/arm")
    assert not graph.parameters.has("/arm")


def test_image_arrives_whole(graph: Graph, ros: Ros1, eventually: Eventually) -> None:
    image: Any = message_type("sensor_msgs/msg/Image")
    out = graph.create_node("camera").create_publisher("/image", image, latch=True)
    out.publish(image(height=480, width=640, encoding="rgb8", step=1920, data=bytes(921600)))
    eventually(lambda: "/image" in ros("rostopic", "list"))
    lines = ros("rostopic", "echo", "-n", "1", "--noarr", "/image").splitlines()
    assert lines[lines.index("height: 480") + 1] == "width: 640"
    assert 'data: "<array type: uint8, length: 921600>"' in lines


@pytest.mark.slow
def test_real_master_is_joined_and_left_in_order(
    real_ros: None, graph: Graph, make_bridge: Callable[..., Bridge],
    next_port: Callable[[], int], tmp_path: Path, eventually: Eventually,
) -> None:  # fmt: skip
    port = next_port()
    ros = Ros1(f"http://127.0.0.1:{port}", tmp_path)
    graph.create_node("rosout")
    with ros.running("roscore", "-p", str(port)) as core:
        assert core.stdout is not None
        assert any("started core service [/rosout]" in line for line in core.stdout)
        bridge = make_bridge(MasterAddress("127.0.0.1", port))
        assert not bridge.master.is_embedded
        eventually(lambda: "/rosout_gazelle" in ros("rosnode", "list"))
        assert graph.parameters.get("/roslaunch/uris")
        bridge.close()
        assert ros("rosnode", "list") == "/rosout\n"
        assert [one.name for one in graph.nodes] == ["/rosout"]
