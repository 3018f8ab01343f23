"""What nodes of rclpy do on the graph; each program asserts and prints ``fine``."""

from __future__ import annotations

import itertools
from collections.abc import Callable
from typing import Any

from tests.patience import stretched

from gazelle.graph import Node
from gazelle.graph.actions import ActionClient
from gazelle.interfaces import message_type, service_type

HEAD = """
import time
import rclpy
from rclpy.node import Node
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
from std_msgs.msg import String
from std_srvs.srv import Trigger, SetBool
rclpy.init()
node = rclpy.create_node('program')
"""


def test_timers_and_stamps_follow_simulated_time(program: Callable[..., Any], node: Node) -> None:
    running = program(
        HEAD
        + """
assert node.get_parameter('use_sim_time').value is True
assert node.get_clock().ros_time_is_active
print('ready', flush=True)
ticks = []
node.create_timer(0.5, lambda: ticks.append(node.get_clock().now().nanoseconds))
while len(ticks) < 3:
    rclpy.spin_once(node)
assert all(tick % 500_000_000 == 0 and tick >= 10_000_000_000 for tick in ticks), ticks
assert ticks == sorted(ticks) and ticks[2] > ticks[0], ticks
print('fine')
""",
        "--ros-args",
        "-p",
        "use_sim_time:=true",
    )
    running.wait_for_line("ready")
    clock = message_type("rosgraph_msgs/Clock")
    publisher = node.create_publisher("/clock", clock)
    running.eventually(lambda: publisher.matched)

    def tell(milliseconds: int) -> None:
        message = clock()
        message.clock.sec, rest = divmod(milliseconds, 1000)
        message.clock.nanosec = rest * 1_000_000
        publisher.publish(message)

    # Each message is one period later than the one before.
    now = itertools.count(10_000, 500)
    running.eventually(lambda: (tell(next(now)), running.popen.poll() is not None)[1])
    assert running.wait() == 0, running.text
    assert running.lines[-1] == "fine", running.text


def test_services_may_be_coroutines_that_call_others(
    passes: Callable[..., Any], node: Node
) -> None:
    kind = service_type("std_srvs/Trigger")
    node.create_service(
        "deep", kind, lambda _request: kind.Response(success=True, message="from below")
    )
    passes(
        HEAD
        + """
import threading
client = node.create_client(Trigger, 'deep', callback_group=ReentrantCallbackGroup())
async def answer(request, response):
    below = await client.call_async(Trigger.Request())
    response.success, response.message = below.success, below.message + '!'
    return response
node.create_service(Trigger, 'high', answer, callback_group=ReentrantCallbackGroup())
asker = rclpy.create_node('asker')
executor = SingleThreadedExecutor()
executor.add_node(node)
executor.add_node(asker)
high = asker.create_client(Trigger, 'high')
assert high.wait_for_service(timeout_sec=5.0)
future = high.call_async(Trigger.Request())
executor.spin_until_future_complete(future, timeout_sec=10)
assert future.result().message == 'from below!', future.result()
threading.Thread(target=executor.spin, daemon=True).start()
assert high.call(Trigger.Request()).success
assert not asker.create_client(Trigger, 'nowhere').wait_for_service(timeout_sec=0.1)
executor.shutdown()
rclpy.shutdown()
"""
    )


def test_groups_say_what_runs_at_the_same_time(passes: Callable[..., Any]) -> None:
    passes(
        HEAD
        + """
import threading
def measure(group):
    now, most, lock = [0], [0], threading.Lock()
    done = threading.Semaphore(0)
    def work():
        with lock:
            now[0] += 1
            most[0] = max(most[0], now[0])
        time.sleep(0.03)
        with lock:
            now[0] -= 1
        done.release()
    timers = [node.create_timer(0.02, work, callback_group=group) for _ in range(3)]
    executor = MultiThreadedExecutor(4)
    executor.add_node(node)
    threading.Thread(target=executor.spin, daemon=True).start()
    for _ in range(6):
        done.acquire()
    for timer in timers:
        node.destroy_timer(timer)
    executor.shutdown()
    return most[0]
assert measure(MutuallyExclusiveCallbackGroup()) == 1
assert measure(ReentrantCallbackGroup()) > 1
rclpy.shutdown()
"""
    )


def test_latched_topics_infos_and_waiting_for_a_message(passes: Callable[..., Any]) -> None:
    passes(
        HEAD
        + """
from rclpy.qos import QoSProfile, DurabilityPolicy, ReliabilityPolicy, qos_profile_sensor_data
from rclpy.wait_for_message import wait_for_message
latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
publisher = node.create_publisher(String, 'chat', latched)
publisher.publish(String(data='early'))
got = []
node.create_subscription(String, 'chat', lambda m, info: got.append((m.data, info)), latched)
raw, late = [], []
node.create_subscription(String, 'chat', raw.append, latched, raw=True)
node.create_subscription(String, 'chat', late.append, 1)
while len(got) < 1 or len(raw) < 1:
    rclpy.spin_once(node, timeout_sec=1)
assert got[0][0] == 'early' and got[0][1]['source_timestamp'] > 0
assert isinstance(raw[0], bytes)
found = wait_for_message(String, node, 'chat', qos_profile=latched, time_to_wait=5)
assert found[1].data == 'early'
assert wait_for_message(String, node, 'chat', time_to_wait=0.05) == (False, None)
publisher.publish(String(data='now'))
while not late:
    rclpy.spin_once(node, timeout_sec=1)
assert late == [String(data='now')]
assert wait_for_message(String, node, 'silence', time_to_wait=0.05) == (False, None)
info = node.get_publishers_info_by_topic('chat')[0]
assert info.qos_profile.durability == DurabilityPolicy.TRANSIENT_LOCAL
assert (info.node_name, info.topic_type) == ('program', 'std_msgs/msg/String')
assert ('/chat', ['std_msgs/msg/String']) in node.get_topic_names_and_types()
assert ('program', '/') in node.get_node_names_and_namespaces()
assert node.get_publisher_names_and_types_by_node('program', '/')
assert node.destroy_publisher(publisher) and not node.destroy_publisher(publisher)
rclpy.shutdown()
"""
    )


def test_loggers_filter_by_level_once_and_throttle(program: Callable[..., Any]) -> None:
    running = program(
        HEAD
        + """
log = node.get_logger()
for number in range(3):
    log.info(f'once {number}', once=True)
    log.info(f'later {number}', skip_first=True)
    log.info(f'rare {number}', throttle_duration_sec=100)
    log.debug('hidden')
log.set_level(rclpy.logging.LoggingSeverity.DEBUG)
log.get_child('part').debug('shown')
print('fine')
"""
    )
    assert running.wait() == 0, running.text
    texts = [line.rpartition("]: ")[2] for line in running.lines if line.startswith("[")]
    assert texts == ["once 0", "rare 0", "later 1", "later 2", "shown"]
    assert running.lines[-2].startswith("[DEBUG] [") and "[program.part]: " in running.lines[-2]


def test_parameter_callbacks_judge_what_others_set(program: Callable[..., Any], node: Node) -> None:
    running = program(
        HEAD
        + """
from rcl_interfaces.msg import SetParametersResult
node.declare_parameter('speed', 1.0)
heard = []
def judge(parameters):
    return SetParametersResult(successful=parameters[0].value < 5, reason='too fast')
node.add_on_set_parameters_callback(judge)
node.add_post_set_parameters_callback(lambda ps: print('now', ps[0].value, flush=True))
print('ready', flush=True)
rclpy.spin(node)
"""
    )
    kind = service_type("rcl_interfaces/SetParameters")
    client = node.create_client("/program/set_parameters", kind)
    running.wait_for_line("ready")
    make = message_type("rcl_interfaces/Parameter")

    def set_speed(value: float) -> Any:
        parameter = make(name="speed")
        parameter.value.type, parameter.value.double_value = 3, value
        return client.call(kind.Request(parameters=[parameter]), timeout_s=stretched(30)).results[0]

    assert set_speed(3.0).successful
    running.wait_for_line("now 3.0")
    refused = set_speed(7.0)
    assert (refused.successful, refused.reason) == (False, "too fast")


def test_deferred_goals_wait_for_their_turn(program: Callable[..., Any], node: Node) -> None:
    running = program(
        HEAD
        + """
from rclpy.action import ActionServer, CancelResponse
from example_interfaces.action import Fibonacci
queue = []
def accepted(handle):
    queue.append(handle)
    assert handle.status == 1, handle.status
    if len(queue) == 2:
        queue.pop().execute()
        queue.pop().execute()
async def execute(handle):
    print('executing', handle.request.order, flush=True)
    handle.succeed()
    return Fibonacci.Result(sequence=[handle.request.order])
server = ActionServer(node, Fibonacci, 'count', execute, handle_accepted_callback=accepted,
                      cancel_callback=lambda handle: CancelResponse.ACCEPT)
rclpy.spin(node)
"""
    )
    client = ActionClient(node, "count", "example_interfaces/Fibonacci")
    assert client.wait_for_server(stretched(20)), running.text
    goals = [client.send_goal({"order": 1})]
    running.eventually(lambda: goals[0].is_accepted)
    goals.append(client.send_goal({"order": 2}))
    assert all(goal.wait(stretched(30)) for goal in goals), running.text
    assert [list(goal.result.sequence) for goal in goals] == [[1], [2]]
    # Results can come before the words that were printed before them.
    running.wait_for_line("executing 1")
    assert [line for line in running.lines if "exec" in line] == ["executing 2", "executing 1"]


def test_names_of_a_users_own_node_get_in_nobodys_way(passes: Callable[..., Any]) -> None:
    """Many a node has a method ``run`` or ``post``, a ``_count`` or a ``_graph``."""
    passes(
        HEAD
        + """
class Robot(Node):
    def __init__(self):
        super().__init__('robot')
        self.ticks = 0
        self.create_service(Trigger, 'start', self.start)
        self.create_timer(0.01, self.tick)
        self.declare_parameter('speed', 1.0)
        self._count = self._info = self._graph = self._full = self._pending = None
        self._created = self._answers = self._overrides = self._events = None

    def start(self, request, response):
        response.success = True
        return response

    def tick(self):
        self.ticks += 1

    def run(self):
        raise AssertionError('nobody called it')

    post = keep = stop = update = _keep = _destroy = _refusal = run

robot = Robot()
executor = SingleThreadedExecutor()
executor.add_node(robot)
executor.add_node(node)
answer = node.create_client(Trigger, '/start').call_async(Trigger.Request())
executor.spin_until_future_complete(answer)
assert answer.result().success
from rcl_interfaces.srv import GetParameters
asked = GetParameters.Request(names=['speed'])
answer = node.create_client(GetParameters, '/robot/get_parameters').call_async(asked)
executor.spin_until_future_complete(answer)
assert answer.result().values[0].double_value == 1.0
while robot.ticks < 2:
    executor.spin_once()
assert robot.count_publishers('/rosout') == 2
assert ('/start', ['std_srvs/srv/Trigger']) in (
    robot.get_service_names_and_types_by_node('robot', '/')
)
robot.set_parameters([rclpy.Parameter('speed', value=2.0)])
assert robot.get_parameter('speed').value == 2.0
robot.destroy_node()
"""
    )
