"""Topics between the graph and nodes of the real rclpy."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pytest
from tests.bridge.ros2.real import Ros2, skip_module_without_rclpy
from tests.patience import at_most

from gazelle.bridge.ros2 import Bridge
from gazelle.graph import Graph
from gazelle.interfaces import message_type

skip_module_without_rclpy()
pytestmark = pytest.mark.reference
Eventually = Callable[[Callable[[], Any]], Any]
STRING = message_type("std_msgs/msg/String")

LISTENER = """
from std_msgs.msg import String
node = Node("ears")
node.create_subscription(String, "/chatter", lambda message: say("heard", message.data), 10)
say("ready")
rclpy.spin(node)
"""
TALKER = """
from std_msgs.msg import String
node = Node("mouth", namespace="/ns")
out = node.create_publisher(String, "/chatter", 10)
node.create_timer(0.05, lambda: out.publish(String(data="from rclpy")))
rclpy.spin(node)
"""


@pytest.fixture
def talking(graph: Graph) -> Iterator[None]:
    """``/talker`` says ``hello`` on ``/chatter`` all the time."""
    out = graph.create_node("talker").create_publisher("/chatter", STRING)
    ended = threading.Event()

    def run() -> None:
        while not ended.wait(0.02):
            out.publish(STRING(data="hello"))

    thread = threading.Thread(target=run)
    thread.start()
    yield
    ended.set()
    thread.join()


@pytest.mark.usefixtures("bridge", "talking")
def test_topic_of_the_graph_reaches_rclpy(ros2: Ros2) -> None:
    ros2(LISTENER).wait_for("heard hello")


@pytest.mark.usefixtures("bridge")
def test_topic_of_rclpy_reaches_the_graph(
    ros2: Ros2, graph: Graph, inbox: Any, eventually: Eventually
) -> None:
    node = graph.create_node("ears")
    node.create_subscription(
        "/chatter", STRING, lambda message, info: inbox((message.data, info.publisher)),
        with_info=True,
    )  # fmt: skip
    ros2(TALKER)
    # Its very first messages may come before ROS tells whose they are.
    eventually(lambda: ("from rclpy", "/ns/mouth") in inbox.items)


@pytest.mark.usefixtures("talking")
def test_nodes_and_topics_of_both_sides_show_on_the_other(
    ros2: Ros2, graph: Graph, bridge: Bridge, eventually: Eventually
) -> None:
    program = ros2(
        TALKER.replace(
            "rclpy.spin",
            """
def look():
    say("nodes", sorted(node.get_node_names_and_namespaces()))
    found = node.get_publishers_info_by_topic("/chatter")
    say("publishers", sorted(one.node_namespace + one.node_name for one in found))
node.create_timer(0.1, look)
rclpy.spin""",
        )
    )
    program.wait_for("nodes [('mouth', '/ns'), ('ros2_bridge', '/'), ('talker', '/')]")
    program.wait_for("publishers ['/nsmouth', '/talker']")
    eventually(lambda: "/ns/mouth" in graph.node_names())
    assert bridge.nodes == (("/talker",), ("/ns/mouth",))
    publishers = eventually(
        lambda: [one.node for one in graph.publishers_info("/chatter") if one.node != "/talker"]
    )
    assert publishers == ["/ns/mouth"]
    program.end()
    with at_most(2.0):
        eventually(lambda: "/ns/mouth" not in graph.node_names())


def test_name_that_ros_takes_later_gets_an_ending(
    ros2: Ros2, graph: Graph, bridge: Bridge, eventually: Eventually, inbox: Any
) -> None:
    node = graph.create_node("mouth", namespace="/ns")
    node.create_subscription("/chatter", STRING, inbox)
    eventually(lambda: bridge.nodes == (("/ns/mouth",), ()))
    program = ros2(TALKER)
    eventually(lambda: bridge.nodes == (("/ns/mouth_gazelle",), ("/ns/mouth",)))
    inbox.wait_for(3)
    program.end()
    eventually(lambda: bridge.nodes == (("/ns/mouth",), ()))


@pytest.mark.usefixtures("bridge")
def test_name_that_ros_does_not_allow_is_told(
    ros2: Ros2, graph: Graph, notices: Any, eventually: Eventually
) -> None:
    node = graph.create_node("cam", namespace="/robot/2nd")
    node.create_publisher("/chatter", STRING, latch=True).publish(STRING(data="hello"))
    found = eventually(lambda: [one for one in notices.items if "2nd" in one])
    assert found[0].startswith("ROS 2 does not take a name of the graph: Invalid")
    ros2(LISTENER.replace("10)", "LATCHED)")).wait_for("heard hello")


@pytest.mark.usefixtures("bridge")
def test_node_that_ends_leaves_ros(ros2: Ros2, graph: Graph, eventually: Eventually) -> None:
    node = graph.create_node("short")
    program = ros2("""
node = Node("looker")
while True:
    say(sorted(node.get_node_names()))
    time.sleep(0.05)
""")
    program.wait_for("'ros2_bridge', 'short']")
    node.shutdown()
    place = len(program.lines)
    with at_most(1.5):
        eventually(
            lambda: len(program.lines) > place and program.lines[-1] == "['looker', 'ros2_bridge']"
        )


@pytest.mark.usefixtures("bridge")
def test_each_message_arrives_once(
    ros2: Ros2, graph: Graph, inbox: Any, eventually: Eventually
) -> None:
    _exchange(ros2, graph, inbox, eventually)


def test_each_message_arrives_once_where_rclpy_does_not_tell_who_speaks(
    ros2: Ros2,
    graph: Graph,
    inbox: Any,
    eventually: Eventually,
    make_bridge: Callable[..., Bridge],
    tmp_path: Any,
) -> None:
    """Before Kilted a message did not name its publisher; here it forgets to."""
    (tmp_path / "sitecustomize.py").write_text("""
import sys
class Finder:
    def find_spec(self, name, path=None, target=None):
        if name == "rclpy.executors":
            import rclpy.subscription
            rclpy.subscription.MessageInfo.__annotations__.pop("publisher_gid")
sys.meta_path.insert(0, Finder())
""")
    make_bridge(PYTHONPATH=str(tmp_path))
    _exchange(ros2, graph, inbox, eventually)


def _exchange(ros2: Ros2, graph: Graph, inbox: Any, eventually: Eventually) -> None:
    """Both sides publish and subscribe on one topic; each message is counted on each side."""
    node = graph.create_node("both")
    out = node.create_publisher("/chatter", STRING)
    node.create_subscription("/chatter", STRING, lambda message: inbox(message.data))
    program = ros2("""
from std_msgs.msg import String
node = Node("both_of_ros")
out = node.create_publisher(String, "/chatter", 100)
node.create_subscription(String, "/chatter", lambda message: say("heard", message.data), 100)
threading.Thread(target=rclpy.spin, args=(node,), daemon=True).start()
while out.get_subscription_count() < 2:
    time.sleep(0.01)
say("ready")
sys.stdin.readline()
for number in range(50):
    out.publish(String(data=f"ros {number}"))
    time.sleep(0.01)
say("done")
time.sleep(60)
""")
    program.wait_for("ready")

    def heard_hi() -> int:
        out.publish(STRING(data="hi"))
        return program.count("heard hi")

    eventually(heard_hi)
    # Its publisher is known on the graph too.
    eventually(lambda: "/both_of_ros" in [p.node for p in graph.publishers_info("/chatter")])
    program.say()
    pause = threading.Event()
    for number in range(50):
        out.publish(STRING(data=f"graph {number}"))
        pause.wait(0.01)
    program.wait_for("done")
    program.wait_for("heard graph 49")
    eventually(lambda: "ros 49" in inbox.items)
    pause.wait(0.3)
    assert [one for one in inbox.items if one.startswith("ros")] == [f"ros {n}" for n in range(50)]
    heard = [line for line in program.lines if line.startswith("heard graph")]
    assert heard == [f"heard graph {number}" for number in range(50)]
    assert len([one for one in inbox.items if one.startswith("graph")]) == 50


@pytest.mark.usefixtures("bridge")
def test_late_subscriptions_get_what_was_latched_on_the_graph(ros2: Ros2, graph: Graph) -> None:
    out = graph.create_node("map_server").create_publisher("/map_name", STRING, latch=True)
    out.publish(STRING(data="old"))
    out.publish(STRING(data="house"))
    code = """
from std_msgs.msg import String
node = Node("late")
node.create_subscription(String, "/map_name", lambda message: say("got", message.data), LATCHED)
rclpy.spin(node)
"""
    ros2(code).wait_for("got house")
    program = ros2(code)
    program.wait_for("got house")
    assert program.count("got old") == 0


@pytest.mark.usefixtures("bridge")
def test_late_subscriptions_get_what_was_latched_in_rclpy(
    ros2: Ros2, graph: Graph, inbox: Any
) -> None:
    ros2("""
from std_msgs.msg import String
node = Node("map_server")
out = node.create_publisher(String, "/map_name", LATCHED)
out.publish(String(data="old"))
out.publish(String(data="house"))
say("ready")
rclpy.spin(node)
""").wait_for("ready")
    node = graph.create_node("late")
    node.create_subscription("/map_name", STRING, lambda message: inbox(message.data))
    assert inbox.wait_for(1) == ["house"]
    node.create_subscription("/map_name", STRING, lambda message: inbox(message.data))
    assert inbox.wait_for(2) == ["house", "house"]


@pytest.mark.usefixtures("bridge")
def test_images_arrive_to_the_byte_both_ways(ros2: Ros2, graph: Graph, inbox: Any) -> None:
    image_type = message_type("sensor_msgs/msg/Image")
    node = graph.create_node("camera")
    out = node.create_publisher("/image", image_type)
    node.create_subscription("/image_back", image_type, inbox)
    program = ros2("""
from sensor_msgs.msg import Image
node = Node("mirror")
out = node.create_publisher(Image, "/image_back", 5)
node.create_subscription(Image, "/image", lambda message: out.publish(message), 5)
while out.get_subscription_count() < 1 or not node.count_publishers("/image"):
    time.sleep(0.01)
say("ready")
rclpy.spin(node)
""")
    program.wait_for("ready")
    pixels = np.random.default_rng(4).integers(0, 256, 640 * 480 * 3, dtype=np.uint8)
    message = image_type(height=480, width=640, step=1920, encoding="rgb8", data=pixels)
    message.header.frame_id = "camera_link"
    pause = threading.Event()
    while not inbox.items:
        out.publish(message)
        pause.wait(0.05)
    back = inbox.items[0]
    assert back.header.frame_id == "camera_link"
    assert np.array_equal(np.asarray(back.data), pixels)


@pytest.mark.usefixtures("bridge")
def test_best_effort_publisher_is_heard_by_a_reliable_subscription_with_a_warning(
    ros2: Ros2, graph: Graph, notices: Any, eventually: Eventually
) -> None:
    out = graph.create_node("lidar").create_publisher("/chatter", STRING, reliable=False)
    program = ros2(LISTENER)

    def heard_scan() -> int:
        out.publish(STRING(data="scan"))
        return program.count("heard scan")

    eventually(heard_scan)
    found = eventually(lambda: [one for one in notices.items if "bridge.qos-adapted" in one])
    assert found == [
        "topic /chatter: /lidar publishes best effort and /ears of ROS 2 asks for reliable; ROS 2 "
        "would not connect them [bridge.qos-adapted]\n  fix: the bridge sends reliably; set the "
        "subscription to best effort (sensor data)\n  ROS says: requesting incompatible QoS. No "
        "messages will be sent to it. Last incompatible policy: RELIABILITY"
    ]


@pytest.mark.usefixtures("bridge")
def test_best_effort_publisher_of_ros_is_heard(ros2: Ros2, graph: Graph, inbox: Any) -> None:
    graph.create_node("ears").create_subscription("/chatter", STRING, lambda m: inbox(m.data))
    ros2(TALKER.replace('"/chatter", 10', '"/chatter", BEST_EFFORT'))
    assert inbox.wait_for(3)[0] == "from rclpy"


@pytest.mark.usefixtures("bridge")
def test_types_that_ros_lacks_are_told_once(
    graph: Graph, notices: Any, eventually: Eventually
) -> None:
    node = graph.create_node("mover")
    node.create_publisher("/goal_a", "move_base_msgs/msg/MoveBaseActionGoal")
    node.create_publisher("/goal_b", "move_base_msgs/msg/MoveBaseActionFeedback")
    node.create_publisher("/speed", "nav2_msgs/msg/SpeedLimit")
    eventually(lambda: len(notices.items) >= 2)
    first, second = sorted(notices.items)
    assert first == (
        "topic /goal_a of /mover cannot go to ROS 2: its type move_base_msgs/msg/"
        "MoveBaseActionGoal exists only in ROS 1; neither can other types of move_base_msgs that "
        "ROS 2 does not have"
    )
    assert second.startswith(
        "topic /speed of /mover does not go to ROS 2, whose Python lacks its type nav2_msgs/msg/"
        "SpeedLimit: ModuleNotFoundError: No module named 'nav2_msgs' [bridge.type-missing]\n"
        "  fix: apt install ros-"
    )


@pytest.mark.usefixtures("bridge")
def test_any_type_is_taken_from_ros(ros2: Ros2, graph: Graph, inbox: Any) -> None:
    node = graph.create_node("recorder")
    node.create_subscription("/chatter", None, lambda m: inbox(m.type_name), raw=True)
    ros2(TALKER)
    assert inbox.wait_for(2)[0] == "std_msgs/msg/String"
