"""Options of rclpy that act, and those that are told of because they cannot."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

_HEAD = """
import threading
import rclpy
from rclpy.duration import Duration
from rclpy.qos import QoSProfile, ReliabilityPolicy
from std_msgs.msg import String
from std_srvs.srv import Trigger
rclpy.init()
def error_of(call):
    try:
        call()
    except Exception as error:
        return f'{type(error).__name__}: {error}'
    raise AssertionError('was taken')
"""


def test_node_without_parameter_services_offers_none(passes: Callable[..., Any]) -> None:
    passes(
        _HEAD
        + """
node = rclpy.create_node('shut', start_parameter_services=False)
names = [name for name, _ in node.get_service_names_and_types_by_node('shut', '/')]
assert names == ['/shut/get_type_description'], names
assert node.declare_parameter('rate', 5).value == 5
"""
    )


def test_unusual_qos_of_services_and_actions_is_told_once(passes: Callable[..., Any]) -> None:
    done = passes(
        _HEAD
        + """
from example_interfaces.action import Fibonacci
from rclpy.action import ActionClient, ActionServer
node = rclpy.create_node('asker')
lossy = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
for _ in range(2):
    node.create_client(Trigger, 'push', qos_profile=lossy)
node.create_client(Trigger, 'pull', qos_profile=QoSProfile(depth=1))
client = ActionClient(node, Fibonacci, 'count', feedback_sub_qos_profile=lossy)
told = {name: one.qos_profile for name, one in
        ((one.topic_name, one) for one in node.subscriptions)}
assert told['/count/_action/feedback'] == lossy, told
ActionServer(node, Fibonacci, 'count', lambda goal: None, feedback_pub_qos_profile=lossy)
text = error_of(lambda: ActionClient(node, Fibonacci, 'count', feedback_qos=lossy))
assert text.endswith("got an unexpected keyword argument 'feedback_qos'"), text
"""
    )
    said = [line for line in done.lines if "QoS" in line]
    end = "its QoS is not heeded; here every request and answer arrives, once"
    assert said == [f"[WARN] client of 'push': {end}", f"[WARN] action 'count': {end}"]


def test_lifecycle_publisher_takes_the_options_of_a_publisher(passes: Callable[..., Any]) -> None:
    passes(
        _HEAD
        + """
from rclpy.lifecycle import LifecycleNode
from rclpy.qos_overriding_options import QoSOverridingOptions
node = LifecycleNode('talker')
options = QoSOverridingOptions.with_default_policies()
made = node.create_lifecycle_publisher(String, 'chatter', 10, qos_overriding_options=options)
assert node.has_parameter('qos_overrides./chatter.publisher.depth')
assert made in list(node.publishers)
text = error_of(lambda: node.create_lifecycle_publisher(String, 'chatter', 10, depth=1))
assert text.endswith("got an unexpected keyword argument 'depth'"), text
"""
    )


def test_shutdown_of_an_executor_waits_for_callbacks_as_long_as_told(
    passes: Callable[..., Any],
) -> None:
    passes(
        _HEAD
        + """
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
for kind in (SingleThreadedExecutor, MultiThreadedExecutor):
    begun, go_on = threading.Event(), threading.Event()
    def callback():
        begun.set()
        go_on.wait()
    executor = kind()
    executor.create_task(callback)
    spinning = threading.Thread(target=executor.spin)
    spinning.start()
    assert begun.wait(20)
    assert executor.shutdown(timeout_sec=0) is False
    assert executor.shutdown(timeout_sec=0.05) is False
    go_on.set()
    assert executor.shutdown() is True
    spinning.join()
"""
    )


def test_jump_callback_hears_of_jumps_as_long_as_its_threshold(passes: Callable[..., Any]) -> None:
    done = passes(
        _HEAD
        + """
from rclpy.clock import JumpThreshold, ROSClock
class Source:
    use_sim_time = True
    def on_jump(self, listener):
        self.listener = listener
clock, source, heard = ROSClock(), Source(), []
clock.attach(source)
def listen(**limits):
    threshold = JumpThreshold(**limits)
    clock.create_jump_callback(threshold, post_callback=lambda jump: heard.append(jump))
    return source.listener
second = Duration(seconds=-1)
listener = listen(min_backward=second, on_clock_change=False)
for delta_ns in (-999_999_999, -1_000_000_000, -5_000_000_000):
    listener(delta_ns)
assert [jump.delta.nanoseconds for jump in heard] == [-1_000_000_000, -5_000_000_000], heard
listen(min_forward=Duration(seconds=1), min_backward=second)(-1)
assert len(heard) == 2
text = error_of(lambda: JumpThreshold(min_backward=Duration(seconds=1)))
assert text == 'ValueError: min_backward must be a negative non-zero duration', text
text = error_of(lambda: clock.create_jump_callback(JumpThreshold(min_backward=second)))
assert text == 'ValueError: One of pre_callback or post_callback must be callable', text
"""
    )
    text = "create_jump_callback: jumps of time forward are not told, only backwards"
    assert done.text.count(text) == 1
