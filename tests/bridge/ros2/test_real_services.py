"""Services, actions and parameters between the graph and nodes of the real rclpy."""

from __future__ import annotations

import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from tests.bridge.ros2.real import Ros2, skip_module_without_rclpy
from tests.patience import stretched

from gazelle.bridge.ros2 import Bridge
from gazelle.graph import Graph
from gazelle.graph.actions import ActionClient, ActionServer
from gazelle.graph.ros2_node_parameters import NodeParameters
from gazelle.graph.ros2_parameter_values import value_message
from gazelle.interfaces import RosVersion, add_package, message_type, service_type

skip_module_without_rclpy()
pytestmark = pytest.mark.reference
Eventually = Callable[[Callable[[], Any]], Any]
SET_BOOL = service_type("std_srvs/srv/SetBool")

CALLER = """
from std_srvs.srv import SetBool
node = Node("caller")
client = node.create_client(SetBool, "/lamp")
say("there", client.wait_for_service(timeout_sec=20))
future = client.call_async(SetBool.Request(data=True))
rclpy.spin_until_future_complete(node, future, timeout_sec=SECONDS)
say("answer", future.result() and future.result().message)
"""
SERVER = """
from std_srvs.srv import SetBool
node = Node("server")
def answer(request, response):
    response.success, response.message = request.data, "from rclpy"
    return response
node.create_service(SetBool, "/theirs", answer)
rclpy.spin(node)
"""


@pytest.fixture
def fibonacci(ros2_python: str) -> str:
    """An action that rclpy brings and the graph does not know: ROS's definition is read."""
    share = Path(ros2_python).parents[1] / "share" / "test_msgs"
    if not share.is_dir():
        pytest.skip("test_msgs is not installed beside rclpy")
    add_package("test_msgs", share, RosVersion.ROS2)
    return "test_msgs/action/Fibonacci"


@pytest.mark.usefixtures("bridge")
def test_service_of_the_graph_answers_rclpy(ros2: Ros2, graph: Graph) -> None:
    def answer(request: Any) -> Any:
        return SET_BOOL.Response(success=request.data, message="from the graph")

    graph.create_node("house").create_service("/lamp", SET_BOOL, answer)
    ros2(CALLER.replace("SECONDS", "20")).wait_for("answer from the graph")


@pytest.mark.usefixtures("bridge")
def test_failure_of_a_service_of_the_graph_is_told(
    ros2: Ros2, graph: Graph, notices: Any, eventually: Eventually
) -> None:
    def fail(request: Any) -> Any:
        raise ValueError("no bulb")

    graph.create_node("house", rosout=False).create_service("/lamp", SET_BOOL, fail)
    ros2(CALLER.replace("SECONDS", "2")).wait_for("answer None")
    told = eventually(lambda: [one for one in notices.items if "no bulb" in one])
    assert told[0].startswith("a call from ROS 2 got no answer, and ROS 2 has no way to say so: ")


@pytest.mark.usefixtures("bridge")
def test_service_of_rclpy_answers_the_graph(
    ros2: Ros2, graph: Graph, eventually: Eventually
) -> None:
    program = ros2(SERVER)
    client = graph.create_node("caller").create_client("/theirs", SET_BOOL)
    assert client.wait_for_service(stretched(20))
    response = client.call(SET_BOOL.Request(data=True), 20)
    assert (response.success, response.message) == (True, "from rclpy")
    assert client.call(SET_BOOL.Request(data=False), 20).success is False
    program.end()
    eventually(lambda: not graph.has_service("/theirs"))


@pytest.mark.usefixtures("bridge")
def test_many_calls_wait_side_by_side(ros2: Ros2, graph: Graph) -> None:
    """A call that waits long, as for an action's result, holds up no other."""
    go, asked = threading.Event(), threading.Semaphore(0)

    def answer(request: Any) -> Any:
        asked.release()
        if request.data:
            assert go.wait(stretched(20))
        return SET_BOOL.Response(message="slow" if request.data else "quick")

    graph.create_node("house").create_service("/lamp", SET_BOOL, answer)
    program = ros2("""
from std_srvs.srv import SetBool
node = Node("caller")
client = node.create_client(SetBool, "/lamp")
client.wait_for_service(timeout_sec=20)
slow = [client.call_async(SetBool.Request(data=True)) for _ in range(8)]
quick = client.call_async(SetBool.Request(data=False))
rclpy.spin_until_future_complete(node, quick, timeout_sec=20)
say(quick.result().message, sum(one.done() for one in slow))
for one in slow:
    rclpy.spin_until_future_complete(node, one, timeout_sec=20)
say("all", sum(one.result().message == "slow" for one in slow))
""")
    program.wait_for("quick 0")
    go.set()
    program.wait_for("all 8")


ACTION_CLIENT = """
from rclpy.action import ActionClient
from test_msgs.action import Fibonacci
node = Node("counter")
client = ActionClient(node, Fibonacci, "/fibonacci")
say("server", client.wait_for_server(timeout_sec=20))
def until(future):
    rclpy.spin_until_future_complete(node, future, timeout_sec=20)
    return future.result()
def feedback(message):
    say("feedback", list(message.feedback.sequence))
goal = until(client.send_goal_async(Fibonacci.Goal(order=3), feedback_callback=feedback))
say("accepted", goal.accepted)
found = until(goal.get_result_async())
say("result", found.status, list(found.result.sequence))
goal = until(client.send_goal_async(Fibonacci.Goal(order=-1)))
say("canceling", len(until(goal.cancel_goal_async()).goals_canceling))
say("status", until(goal.get_result_async()).status)
"""
ACTION_SERVER = """
from rclpy.action import ActionServer, CancelResponse
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from test_msgs.action import Fibonacci
node = Node("server")
def execute(goal):
    result = Fibonacci.Result()
    if goal.request.order < 0:
        while not goal.is_cancel_requested:
            time.sleep(0.01)
        goal.canceled()
        return result
    # Connections of topics need a moment, and rclpy starts at once.
    time.sleep(0.5)
    goal.publish_feedback(Fibonacci.Feedback(sequence=[0, 1]))
    time.sleep(0.1)
    goal.succeed()
    result.sequence = [0, 1, 1]
    return result
server = ActionServer(node, Fibonacci, "/fibonacci", execute,
    callback_group=ReentrantCallbackGroup(), cancel_callback=lambda goal: CancelResponse.ACCEPT)
executor = MultiThreadedExecutor(8)
executor.add_node(node)
executor.spin()
"""


@pytest.mark.usefixtures("bridge")
def test_action_of_the_graph_serves_rclpy(ros2: Ros2, graph: Graph, fibonacci: str) -> None:
    def on_goal(goal: Any) -> None:
        goal.accept()
        if goal.request.order > 0:
            goal.publish_feedback({"sequence": [0, 1]})
            goal.succeed({"sequence": [0, 1, 1]})

    node = graph.create_node("counter_server")
    ActionServer(
        node, "/fibonacci", fibonacci, on_goal=on_goal, on_cancel=lambda goal: goal.cancel(),
        ros_version=2,
    )  # fmt: skip
    program = ros2(ACTION_CLIENT)
    program.wait_for("status 5")
    assert [line for line in program.lines if not line.startswith("feedback")] == [
        "server True", "accepted True", "result 4 [0, 1, 1]", "canceling 1", "status 5",
    ]  # fmt: skip


@pytest.mark.usefixtures("bridge")
def test_action_of_rclpy_serves_the_graph(
    ros2: Ros2, graph: Graph, fibonacci: str, inbox: Any
) -> None:
    ros2(ACTION_SERVER)
    client = ActionClient(graph.create_node("counter"), "/fibonacci", fibonacci, ros_version=2)
    assert client.wait_for_server(stretched(20))
    goal = client.send_goal({"order": 3}, on_feedback=lambda one: inbox(list(one.sequence)))
    assert goal.wait(stretched(20))
    assert (int(goal.status), list(goal.result.sequence)) == (4, [0, 1, 1])
    assert inbox.wait_for(1) == [[0, 1]]
    goal = client.send_goal({"order": -1})
    goal.cancel()
    assert goal.wait(stretched(20))
    assert int(goal.status) == 5


def _parameters(graph: Graph, changes: list[dict[str, Any]]) -> None:
    node = graph.create_node("arm")

    def on_set(values: dict[str, Any]) -> str:
        changes.append(values)
        return ""

    NodeParameters(node, "/arm", {"gain": 1.5, "name": "left"}, on_set)


@pytest.mark.usefixtures("bridge")
def test_rclpy_lists_gets_and_sets_parameters_of_the_graph(ros2: Ros2, graph: Graph) -> None:
    changes: list[dict[str, Any]] = []
    _parameters(graph, changes)
    program = ros2("""
from rclpy.parameter import Parameter
from rclpy.parameter_client import AsyncParameterClient
node = Node("tuner")
client = AsyncParameterClient(node, "/arm")
say("there", client.wait_for_services(timeout_sec=20))
def until(future):
    rclpy.spin_until_future_complete(node, future, timeout_sec=20)
    return future.result()
say("list", sorted(until(client.list_parameters()).result.names))
say("gain", until(client.get_parameters(["gain"])).values[0].double_value)
done = until(client.set_parameters([Parameter("gain", value=2.5)])).results[0]
say("set", done.successful, until(client.get_parameters(["gain"])).values[0].double_value)
""")
    program.wait_for("list ['gain', 'name']")
    program.wait_for("gain 1.5")
    program.wait_for("set True 2.5")
    assert changes == [{"gain": 2.5}]


@pytest.mark.usefixtures("bridge")
def test_the_graph_gets_and_sets_parameters_of_rclpy(
    ros2: Ros2, graph: Graph, bridge: Bridge
) -> None:
    program = ros2("""
node = Node("tuned")
node.declare_parameter("speed", 3)
def changed(parameters):
    say("changed", parameters[0].name, parameters[0].value)
    from rcl_interfaces.msg import SetParametersResult
    return SetParametersResult(successful=True)
node.add_on_set_parameters_callback(changed)
rclpy.spin(node)
""")
    node = graph.create_node("tool")
    kind = service_type("rcl_interfaces/srv/GetParameters")
    get = node.create_client("/tuned/get_parameters", kind)
    assert get.wait_for_service(stretched(20))
    assert get.call(kind.Request(names=["speed"]), 20).values[0].integer_value == 3
    kind = service_type("rcl_interfaces/srv/SetParameters")
    request = kind.Request()
    request.parameters = [
        message_type("rcl_interfaces/msg/Parameter")(name="speed", value=value_message(4))
    ]
    assert node.create_client("/tuned/set_parameters", kind).call(request, 20).results[0].successful
    program.wait_for("changed speed 4")
