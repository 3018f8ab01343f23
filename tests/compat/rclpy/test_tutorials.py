"""The programs of the ROS 2 tutorials (docs.ros.org), unmodified but for shorter waits."""

from __future__ import annotations

import itertools
import signal
from collections.abc import Callable
from typing import Any

import pytest
from tests.patience import stretched

from gazelle.graph import Graph, Node
from gazelle.graph.actions import ActionClient, Ros2Status
from gazelle.interfaces import fill, service_type

PUBLISHER = """
import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node

from std_msgs.msg import String


class MinimalPublisher(Node):

    def __init__(self):
        super().__init__('minimal_publisher')
        self.publisher_ = self.create_publisher(String, 'topic', 10)
        timer_period = 0.05  # seconds
        self.timer = self.create_timer(timer_period, self.timer_callback)
        self.i = 0

    def timer_callback(self):
        msg = String()
        msg.data = 'Hello World: %d' % self.i
        self.publisher_.publish(msg)
        self.get_logger().info('Publishing: "%s"' % msg.data)
        self.i += 1


def main(args=None):
    try:
        with rclpy.init(args=args):
            minimal_publisher = MinimalPublisher()

            rclpy.spin(minimal_publisher)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass


if __name__ == '__main__':
    main()
"""
SUBSCRIBER = """
from std_msgs.msg import String
import rclpy
from rclpy.node import Node


class MinimalSubscriber(Node):

    def __init__(self):
        super().__init__('minimal_subscriber')
        self.subscription = self.create_subscription(
            String,
            'topic',
            self.listener_callback,
            10)
        self.subscription  # prevent unused variable warning

    def listener_callback(self, msg):
        self.get_logger().info('I heard: "%s"' % msg.data)


def main(args=None):
    rclpy.init(args=args)

    minimal_subscriber = MinimalSubscriber()

    rclpy.spin(minimal_subscriber)

    minimal_subscriber.destroy_node()
    rclpy.shutdown()


if __name__ == '__main__':
    main()
"""
SERVICE = """
from example_interfaces.srv import AddTwoInts

import rclpy
from rclpy.node import Node


class MinimalService(Node):

    def __init__(self):
        super().__init__('minimal_service')
        self.srv = self.create_service(AddTwoInts, 'add_two_ints', self.add_two_ints_callback)

    def add_two_ints_callback(self, request, response):
        response.sum = request.a + request.b
        self.get_logger().info('Incoming request\\na: %d b: %d' % (request.a, request.b))

        return response


def main():
    rclpy.init()

    minimal_service = MinimalService()

    rclpy.spin(minimal_service)

    rclpy.shutdown()


if __name__ == '__main__':
    main()
"""
CLIENT = """
import sys

from example_interfaces.srv import AddTwoInts
import rclpy
from rclpy.node import Node


class MinimalClientAsync(Node):

    def __init__(self):
        super().__init__('minimal_client_async')
        self.cli = self.create_client(AddTwoInts, 'add_two_ints')
        while not self.cli.wait_for_service(timeout_sec=1.0):
            self.get_logger().info('service not available, waiting again...')
        self.req = AddTwoInts.Request()

    def send_request(self, a, b):
        self.req.a = a
        self.req.b = b
        self.future = self.cli.call_async(self.req)
        rclpy.spin_until_future_complete(self, self.future)
        return self.future.result()


def main():
    rclpy.init()

    minimal_client = MinimalClientAsync()
    response = minimal_client.send_request(int(sys.argv[1]), int(sys.argv[2]))
    minimal_client.get_logger().info(
        'Result of add_two_ints: for %d + %d = %d' %
        (int(sys.argv[1]), int(sys.argv[2]), response.sum))

    minimal_client.destroy_node()
    rclpy.shutdown()


if __name__ == '__main__':
    main()
"""
PARAMETERS = """
import rclpy
import rclpy.node

class MinimalParam(rclpy.node.Node):
    def __init__(self):
        super().__init__('minimal_param_node')

        from rcl_interfaces.msg import ParameterDescriptor
        my_parameter_descriptor = ParameterDescriptor(description='This parameter is mine!')
        self.declare_parameter('my_parameter', 'world', my_parameter_descriptor)

        self.timer = self.create_timer(0.05, self.timer_callback)

    def timer_callback(self):
        my_param = self.get_parameter('my_parameter').get_parameter_value().string_value

        self.get_logger().info('Hello %s!' % my_param)

        my_new_param = rclpy.parameter.Parameter(
            'my_parameter',
            rclpy.Parameter.Type.STRING,
            'world'
        )
        all_new_parameters = [my_new_param]
        self.set_parameters(all_new_parameters)

def main():
    rclpy.init()
    node = MinimalParam()
    rclpy.spin(node)

if __name__ == '__main__':
    main()
"""
ACTION_SERVER = """
import time

import rclpy
from rclpy.action import ActionServer
from rclpy.node import Node

from action_tutorials_interfaces.action import Fibonacci


class FibonacciActionServer(Node):

    def __init__(self):
        super().__init__('fibonacci_action_server')
        self._action_server = ActionServer(
            self,
            Fibonacci,
            'fibonacci',
            self.execute_callback)

    def execute_callback(self, goal_handle):
        self.get_logger().info('Executing goal...')

        feedback_msg = Fibonacci.Feedback()
        feedback_msg.partial_sequence = [0, 1]

        for i in range(1, goal_handle.request.order):
            feedback_msg.partial_sequence.append(
                feedback_msg.partial_sequence[i] + feedback_msg.partial_sequence[i-1])
            self.get_logger().info('Feedback: {0}'.format(feedback_msg.partial_sequence))
            goal_handle.publish_feedback(feedback_msg)
            time.sleep(0.02)

        goal_handle.succeed()

        result = Fibonacci.Result()
        result.sequence = feedback_msg.partial_sequence
        return result


def main(args=None):
    rclpy.init(args=args)

    fibonacci_action_server = FibonacciActionServer()

    rclpy.spin(fibonacci_action_server)


if __name__ == '__main__':
    main()
"""
ACTION_CLIENT = """
import rclpy
from rclpy.action import ActionClient
from rclpy.node import Node

from action_tutorials_interfaces.action import Fibonacci


class FibonacciActionClient(Node):

    def __init__(self):
        super().__init__('fibonacci_action_client')
        self._action_client = ActionClient(self, Fibonacci, 'fibonacci')

    def send_goal(self, order):
        goal_msg = Fibonacci.Goal()
        goal_msg.order = order

        self._action_client.wait_for_server()

        self._send_goal_future = self._action_client.send_goal_async(
            goal_msg, feedback_callback=self.feedback_callback)

        self._send_goal_future.add_done_callback(self.goal_response_callback)

    def goal_response_callback(self, future):
        goal_handle = future.result()
        if not goal_handle.accepted:
            self.get_logger().info('Goal rejected :(')
            return

        self.get_logger().info('Goal accepted :)')

        self._get_result_future = goal_handle.get_result_async()
        self._get_result_future.add_done_callback(self.get_result_callback)

    def get_result_callback(self, future):
        result = future.result().result
        self.get_logger().info('Result: {0}'.format(list(map(int, result.sequence))))
        rclpy.shutdown()

    def feedback_callback(self, feedback_msg):
        feedback = feedback_msg.feedback
        self.get_logger().info('Received feedback: {0}'.format(len(feedback.partial_sequence)))


def main(args=None):
    rclpy.init(args=args)

    action_client = FibonacciActionClient()

    action_client.send_goal(6)

    rclpy.spin(action_client)


if __name__ == '__main__':
    main()
"""


@pytest.fixture
def run(gazelle: Callable[..., Any], graph: Graph, tmp_path: Any) -> Callable[..., Any]:
    """Runs a program's text as `python` would in a shell of `gazelle env`."""
    numbers = itertools.count()

    def start(text: str, *words: str, **environ: str) -> Any:
        file = tmp_path / f"program{next(numbers)}.py"
        file.write_text(text, encoding="utf-8")
        return gazelle(str(file), *words, module="gazelle.compat.script_runner", **environ)

    return start


@pytest.mark.tutorial
def test_minimal_publisher_and_subscriber(run: Callable[..., Any], node: Node) -> None:
    listener, talker = run(SUBSCRIBER), run(PUBLISHER)
    line = listener.wait_for_line(r'I heard: "Hello World: \d+"')
    assert line.startswith("[INFO] [") and "[minimal_subscriber]: I heard" in line
    talker.wait_for_line(r'\[minimal_publisher\]: Publishing: "Hello World: 3"')
    names = node.graph.node_names()
    assert {"/minimal_publisher", "/minimal_subscriber"} <= set(names)
    assert talker.stop() == 0, talker.text
    listener.stop()


@pytest.mark.tutorial
def test_minimal_publisher_obeys_ros_args(run: Callable[..., Any], node: Node) -> None:
    words = "--ros-args -r __node:=other -r __ns:=/robot -r topic:=chat --log-level warn"
    talker = run(PUBLISHER, *words.split())
    got: list[Any] = []
    heard = node.create_subscription("/robot/chat", "std_msgs/String", got.append)
    talker.eventually(lambda: got)
    assert got[0].data.startswith("Hello World: ")
    assert "/robot/other" in node.graph.node_names()
    assert talker.stop(signal.SIGTERM) == 0
    assert "Publishing" not in talker.text
    heard.unregister()


@pytest.mark.tutorial
def test_minimal_service_and_client(run: Callable[..., Any]) -> None:
    server = run(SERVICE)
    client = run(CLIENT, "2", "3")
    assert client.wait() == 0, client.text
    client.wait_for_line("Result of add_two_ints: for 2 . 3 = 5")
    server.wait_for_line("a: 2 b: 3")
    server.stop()


@pytest.mark.tutorial
def test_minimal_parameters_are_seen_and_set_by_others(
    run: Callable[..., Any], node: Node, tmp_path: Any
) -> None:
    file = tmp_path / "params.yaml"
    file.write_text("minimal_param_node:\n  ros__parameters:\n    my_parameter: file\n")
    running = run(PARAMETERS, "--ros-args", "--params-file", str(file))
    running.wait_for_line("Hello file!")
    running.wait_for_line("Hello world!")
    kind = service_type("rcl_interfaces/DescribeParameters")
    client = node.create_client("/minimal_param_node/describe_parameters", kind)
    answer = client.call(kind.Request(names=["my_parameter"]), timeout_s=stretched(30))
    assert answer.descriptors[0].description == "This parameter is mine!"
    kind = service_type("rcl_interfaces/SetParameters")
    request = kind.Request()
    fill(request, {"parameters": [{"name": "my_parameter", "value": {
        "type": 4, "string_value": "earth"}}]})  # fmt: skip
    client = node.create_client("/minimal_param_node/set_parameters", kind)
    assert client.call(request, timeout_s=stretched(30)).results[0].successful
    running.wait_for_line("Hello earth!")
    running.stop()


@pytest.mark.tutorial
def test_fibonacci_action_server_and_client(run: Callable[..., Any], node: Node) -> None:
    server, client = run(ACTION_SERVER), run(ACTION_CLIENT)
    client.wait_for_line("Goal accepted")
    client.wait_for_line(r"Result: \[0, 1, 1, 2, 3, 5, 8\]")
    assert client.wait() == 0, client.text
    assert "Received feedback: 4" in client.text
    ours = ActionClient(node, "fibonacci", "action_tutorials_interfaces/Fibonacci")
    assert ours.wait_for_server(stretched(10))
    goal = ours.send_goal({"order": 2})
    assert goal.wait(stretched(30))
    assert goal.status is Ros2Status.SUCCEEDED
    assert list(goal.result.sequence) == [0, 1, 1]
    server.stop()


def test_messages_imported_before_rclpy_have_the_form_of_ros2(
    passes: Callable[..., Any],
) -> None:
    passes("""
from geometry_msgs.msg import TransformStamped
t = TransformStamped()
t.header.stamp.nanosec = 5
import rclpy
""")


def test_messages_of_rospy_programs_have_the_form_of_ros1(passes: Callable[..., Any]) -> None:
    passes("""
from geometry_msgs.msg import TransformStamped
t = TransformStamped()
t.header.stamp.nsecs = 5
import rospy
""", ROS_VERSION="2")  # fmt: skip


def test_ros1_messages_are_refused_with_the_way_out(passes: Callable[..., Any]) -> None:
    passes("""
import rclpy
from gazelle.interfaces import ros1_message_type
rclpy.init()
node = rclpy.create_node('n')
try:
    node.create_publisher(ros1_message_type('std_msgs/String'), 'x', 1)
except AttributeError as error:
    assert 'std_msgs/String has the form of ROS 1' in str(error), error
    assert 'it should be a ROS 2 message type' in str(error)
else:
    raise AssertionError
rclpy.shutdown()
""")
