"""rospy.Publisher, Subscriber, wait_for_message, AnyMsg and numpy_msg."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from gazelle.graph import Node
from gazelle.interfaces import message_type

Run = Callable[..., Any]

_PUBLISH = """
import rospy
from std_msgs.msg import ColorRGBA, Header, Int32, String
rospy.init_node("talker")

def raises(kind, function, *args, **kwds):
    try:
        function(*args, **kwds)
    except kind as error:
        return str(error)
    raise AssertionError("nothing raised")

pub = rospy.Publisher("chatter", String, queue_size=10)
got = []
rospy.Subscriber("chatter", String, lambda m, extra: got.append((m.data, extra)), "more")
colours = []
rospy.Subscriber("colour", ColorRGBA, colours.append)
colour = rospy.Publisher("colour", ColorRGBA, queue_size=1)
assert (pub.name, pub.type, pub.get_num_connections()) == ("/chatter", "std_msgs/String", 1)
assert pub.md5sum == "992ce8a1687cec8c8bd883ec73ca41d1"

pub.publish("plain")
pub.publish(String("made"))
pub.publish(data="keyword")
colour.publish(1, 0.5, 0, 1)
colour.publish(r=1, a=0.25)
while len(got) < 3 or len(colours) < 2:
    rospy.rostime.wallsleep(0.005)
assert got == [("plain", "more"), ("made", "more"), ("keyword", "more")]
assert (colours[0].g, colours[1].r, colours[1].a) == (0.5, 1.0, 0.25)

text = raises(TypeError, pub.publish, Int32(1))
assert "expected [std_msgs/String] but got [std_msgs/Int32]" in text
assert "but not both" in raises(TypeError, pub.publish, "a", data="b")
raises(AttributeError, pub.publish, dta="typo")
raises(rospy.ROSSerializationException, pub.publish, 5)
raises(ValueError, rospy.Publisher, "", String)
pub.unregister()
assert "unregistered() handle" in raises(rospy.ROSException, pub.publish, "late")
text = raises(rospy.ROSException, rospy.wait_for_message, "/silence", String, timeout=0.05)
assert text == "timeout exceeded while waiting for message on topic /silence"
"""


def test_messages_are_made_of_whatever_publish_is_given(passes: Run) -> None:
    passes(_PUBLISH)


_LATCHED = """
import rospy
from std_msgs.msg import String
from sensor_msgs.msg import LaserScan
from nav_msgs.msg import Odometry
rospy.init_node("listener")
assert rospy.wait_for_message("/map_name", String, timeout=30).data == "office"
odom = rospy.wait_for_message("/odom", Odometry, timeout=rospy.Duration(5))
assert (odom.header.frame_id, odom.header.stamp.secs, odom.header.stamp.nsecs) == ("odom", 3, 500)
assert odom.header.seq >= 0 and odom.header.stamp == rospy.Time(3, 500)
odom.pose.pose.position.x = 7.0

from rospy.numpy_msg import numpy_msg
import numpy
scan = rospy.wait_for_message("/scan", numpy_msg(LaserScan), timeout=30)
assert isinstance(scan.ranges, numpy.ndarray) and scan.ranges.dtype == numpy.float32
assert numpy.allclose(scan.ranges, [0.5, 1.5])

raw = rospy.wait_for_message("/map_name", rospy.AnyMsg, timeout=30)
assert raw._connection_header["type"] == "std_msgs/String"
assert String().deserialize(raw._buff).data == "office"
plain = rospy.wait_for_message("/scan", LaserScan, timeout=30)
assert list(plain.ranges) == [0.5, 1.5]
assert ["/scan", "sensor_msgs/LaserScan"] in rospy.get_published_topics()
"""


def test_latched_messages_of_others_arrive_in_ros_1_form(passes: Run, node: Node) -> None:
    latched: dict[str, Any] = {"latch": True}
    name = message_type("std_msgs/msg/String")
    node.create_publisher("/map_name", name, **latched).publish(name(data="office"))
    odometry = message_type("nav_msgs/msg/Odometry")()
    odometry.header.frame_id = "odom"
    odometry.header.stamp.sec, odometry.header.stamp.nanosec = 3, 500
    node.create_publisher("/odom", type(odometry), **latched).publish(odometry)
    scan = message_type("sensor_msgs/msg/LaserScan")(ranges=[0.5, 1.5])
    node.create_publisher("/scan", type(scan), **latched).publish(scan)
    passes(_LATCHED)


_LISTENER = """
import rospy
from std_msgs.msg import String

class Peers(rospy.SubscribeListener):
    def peer_subscribe(self, topic_name, topic_publish, peer_publish):
        peer_publish(String(rospy.get_param("/greeting_word")))
    def peer_unsubscribe(self, topic_name, num_peers):
        print("left", topic_name, num_peers, flush=True)
        rospy.signal_shutdown("seen enough")

rospy.init_node("greeter")
rospy.Publisher("greeting", String, subscriber_listener=Peers(), queue_size=1, latch=True)
print("ready", flush=True)
rospy.spin()
"""


def test_publisher_tells_its_listener_who_comes_and_goes(program: Run, node: Node) -> None:
    node.graph.parameters.set("/greeting_word", "welcome")
    greeter = program(_LISTENER)
    greeter.wait_for_line("^ready$")
    heard: list[str] = []
    subscription = node.create_subscription(
        "/greeting", "std_msgs/msg/String", lambda message: heard.append(message.data)
    )
    greeter.eventually(lambda: heard == ["welcome"])
    subscription.unregister()
    greeter.wait_for_line("left /greeting 0")
    assert greeter.wait() == 0


_CALLBACK = """
import rospy, threading
from std_msgs.msg import Int32
rospy.init_node("fragile")
done = threading.Event()
def callback(message):
    if message.data == 1:
        raise RuntimeError("first one breaks")
    done.set()
sub = rospy.Subscriber("numbers", Int32, callback)
pub = rospy.Publisher("numbers", Int32, queue_size=2)
pub.publish(1)
pub.publish(2)
assert done.wait(30)
sub.unregister()
assert pub.get_num_connections() == 0
"""


def test_callback_that_raises_is_shown_and_the_next_message_comes(passes: Run) -> None:
    done = passes(_CALLBACK)
    assert "bad callback: <function callback" in done.text
    assert "RuntimeError: first one breaks" in done.text


_NUMPY = """
import numpy, rospy, threading
from rospy.numpy_msg import numpy_msg
from std_msgs.msg import Float32MultiArray
rospy.init_node("arrays")
got, done = [], threading.Event()
rospy.Subscriber("floats", numpy_msg(Float32MultiArray), lambda m: (got.append(m), done.set()))
pub = rospy.Publisher("floats", numpy_msg(Float32MultiArray), queue_size=1)
message = numpy_msg(Float32MultiArray)()
message.data = numpy.array([1.0, 2.5], dtype=numpy.float32)
pub.publish(message)
assert done.wait(30)
assert isinstance(got[0].data, numpy.ndarray) and got[0].data.tolist() == [1.0, 2.5]
"""


def test_numpy_messages_go_both_ways(passes: Run) -> None:
    passes(_NUMPY)


def test_topics_may_be_made_before_the_node(passes: Callable[..., Any]) -> None:
    passes(
        """
import rospy
from std_msgs.msg import String
got = []
pub = rospy.Publisher('chatter', String, queue_size=10)
sub = rospy.Subscriber('~private', String, lambda m: got.append(m.data))
gone = rospy.Publisher('gone', String, queue_size=1)
gone.unregister()
try:
    pub.publish('too early')
except rospy.ROSException as error:
    assert str(error) == 'ROS node has not been initialized yet. Please call init_node() first'
else:
    raise AssertionError('there is no node')
assert pub.get_num_connections() == 0
rospy.init_node('talker')
assert pub.resolved_name == '/chatter' and sub.name == '/talker/private'
other = rospy.Publisher('/talker/private', String, queue_size=10)
while not got:
    other.publish('now')
    rospy.sleep(0.01)
pub.publish('in time')
try:
    gone.publish('x')
except rospy.ROSException as error:
    assert 'unregistered' in str(error)
"""
    )


def test_messages_and_requests_say_where_they_come_from(passes: Callable[..., Any]) -> None:
    passes("""
import rospy
from std_msgs.msg import String
from std_srvs.srv import SetBool, SetBoolResponse
rospy.init_node('program')
got = []
rospy.Subscriber('chat', String, got.append)
rospy.Subscriber('chat', rospy.AnyMsg, got.append)
talker = rospy.Publisher('chat', String, latch=True, queue_size=1)
talker.publish('hello')
while len(got) < 2:
    rospy.sleep(0.01)
for message in got:
    header = message._connection_header
    assert header['callerid'] == '/program' and header['topic'] == '/chat', header
    assert header['type'] == 'std_msgs/String' and header['latching'] == '1', header
    assert header['md5sum'] == String._md5sum
    assert header['message_definition'] == String._full_text
asked = []
def answer(request):
    asked.append(request._connection_header)
    return SetBoolResponse(success=True)
rospy.Service('switch', SetBool, answer)
rospy.ServiceProxy('switch', SetBool)(True)
assert asked[0]['callerid'] == '/program' and asked[0]['service'] == '/switch', asked
assert asked[0]['type'] == 'std_srvs/SetBool' and asked[0]['md5sum'] == SetBool._md5sum
""")


def test_headers_of_ones_own_are_told_to_be_lost(program: Callable[..., Any]) -> None:
    running = program("""
import rospy
from std_msgs.msg import String
rospy.init_node('program')
rospy.Publisher('chat', String, queue_size=1, headers={'cookies': 'oreo'})
""")
    assert running.wait() == 0, running.text
    line = "headers are not sent: cookies will not be in anybody's _connection_header"
    assert line in running.text


_SLEEPING = """
import rospy
from std_msgs.msg import String
import gazelle.graph.subscription as subscription
subscription._MAX_WAITING_BYTES = 1 << 20
rospy.init_node("slow")
numbers, begun = [], []

def sleep(message):
    begun.append(1)
    while not rospy.has_param("/go_on"):
        rospy.rostime.wallsleep(0.01)
    numbers.append(int(message.data[:4]))

rospy.Subscriber("words", String, sleep, queue_size=None)
while numbers[-1:] != [300]:
    rospy.rostime.wallsleep(0.01)
assert numbers[0] == 0 and len(numbers) < 301, numbers
"""


def test_sleeping_subscriber_without_a_queue_size_holds_the_newest_within_its_bound(
    node: Node, program: Run, eventually: Run
) -> None:
    text = message_type("std_msgs/msg/String")
    out = node.create_publisher("/words", text)
    run = program(_SLEEPING)
    eventually(lambda: out.matched)
    for number in range(301):
        out.publish(text(data=f"{number:04}" + "x" * 10_000))
    run.wait_for_line("the callback of /words is slower than its messages: 1 MiB of them wait")
    node.graph.parameters.set("/go_on", True)
    assert run.wait() == 0
