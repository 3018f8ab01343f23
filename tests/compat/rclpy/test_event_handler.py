"""Events, overrides of quality of service, guard conditions, bytes, and the module's names."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

HEAD = """
import rclpy
from rclpy.qos import *
from std_msgs.msg import String
rclpy.init(args=['x', '--ros-args',
                 '-p', 'qos_overrides./chatter.publisher.reliability:=best_effort',
                 '-p', 'qos_overrides./chatter.subscription_mine.depth:=3'])
node = rclpy.create_node('program')
def spin(until):
    for _ in range(400):
        if until():
            return
        rclpy.spin_once(node, timeout_sec=0.05)
    raise AssertionError('did not happen')
"""


def test_parameters_change_the_quality_of_service(passes: Callable[..., Any]) -> None:
    passes(
        HEAD
        + """
from rclpy.qos_overriding_options import InvalidQosOverridesError, QoSOverridingOptions
from rcl_interfaces.msg import SetParametersResult
default = QoSOverridingOptions.with_default_policies()
pub = node.create_publisher(String, 'chatter', 10, qos_overriding_options=default)
assert pub.qos_profile.reliability == ReliabilityPolicy.BEST_EFFORT
assert node.get_parameter('qos_overrides./chatter.publisher.depth').value == 10
mine = QoSOverridingOptions([QoSPolicyKind.DEPTH, QoSPolicyKind.LIFESPAN], entity_id='mine')
sub = node.create_subscription(String, 'chatter', print, 10, qos_overriding_options=mine)
assert sub.qos_profile.depth == 3
assert not node.has_parameter('qos_overrides./chatter.subscription_mine.lifespan')
def refuse(qos):
    return SetParametersResult(successful=False, reason='too deep')
strict = QoSOverridingOptions([QoSPolicyKind.DEPTH], callback=refuse)
try:
    node.create_publisher(String, 'other', 10, qos_overriding_options=strict)
except InvalidQosOverridesError as error:
    assert 'are not valid: too deep' in str(error)
else:
    raise AssertionError('refused')
assert qos_check_compatible(QoSProfile(depth=1), QoSProfile(depth=1)) == (QoSCompatibility.OK, '')
found = qos_check_compatible(qos_profile_sensor_data, QoSProfile(depth=1))
assert found == (QoSCompatibility.ERROR, 'ERROR: Best effort publisher and reliable subscription;')
words = ['system_default', 'reliable', 'best_effort', 'unknown', 'best_available']
assert ReliabilityPolicy.short_keys() == words
assert qos_policy_name_from_kind(16) == 'RELIABILITY'
"""
    )


def test_wrong_override_names_what_there_is(passes: Callable[..., Any]) -> None:
    passes(
        HEAD.replace("best_effort", "best_efort")
        + """
from rclpy.qos_overriding_options import QoSOverridingOptions
try:
    node.create_publisher(String, 'chatter', 1,
        qos_overriding_options=QoSOverridingOptions.with_default_policies())
except RuntimeError as error:
    assert 'Unexpected QoS override for policy `reliability`: `best_efort`' in str(error)
    assert 'best_effort' in str(error).partition(';')[2], error
else:
    raise AssertionError('no such policy')
"""
    )


def test_events_tell_of_partners_and_deadlines(passes: Callable[..., Any]) -> None:
    passes(
        HEAD
        + """
from rclpy.duration import Duration
from rclpy.event_handler import PublisherEventCallbacks, SubscriptionEventCallbacks
matched, clashes, missed = [], [], []
quick = QoSProfile(depth=1, deadline=Duration(seconds=0.02))
sub = node.create_subscription(String, 'lonely', print, quick, event_callbacks=
    SubscriptionEventCallbacks(deadline=missed.append, incompatible_qos=clashes.append))
spin(lambda: len(missed) >= 2)
assert missed[1].total_count == 2 and missed[1].total_count_change == 1
pub = node.create_publisher(String, 'lonely', qos_profile_sensor_data,
    event_callbacks=PublisherEventCallbacks(matched=matched.append))
spin(lambda: matched and clashes)
assert matched[0] == (1, 1, 1, 1), matched
assert clashes[0].last_policy_kind == QoSPolicyKind.RELIABILITY
node.destroy_subscription(sub)
spin(lambda: len(matched) >= 2)
assert matched[1] == (1, 0, 0, -1), matched
"""
    )


def test_incompatible_quality_of_service_is_warned_of(program: Callable[..., Any]) -> None:
    """Sentences of rclpy 9.1.2, with what is different here; the policies are Fast DDS's."""
    running = program(
        HEAD
        + """
from rclpy.duration import Duration
got = []
node.create_subscription(String, 'scan', got.append, 10)
pub = node.create_publisher(String, 'scan', qos_profile_sensor_data)
eager = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL,
                   deadline=Duration(seconds=1))
node.create_publisher(String, '/late', 1)
node.create_subscription(String, '/late', print, eager)
pub.publish(String(data='x'))
for _ in range(40):
    rclpy.spin_once(node, timeout_sec=0.01)
assert got == [String(data='x')]
print('fine')
"""
    )
    assert running.wait() == 0, running.text
    rest = "in ROS 2 (here they are). Last incompatible policy: "
    for line in (
        "[WARN] ",
        "New publisher discovered on topic 'scan', offering incompatible QoS. "
        f"No messages will be received from it {rest}RELIABILITY",
        "New subscription discovered on topic 'scan', requesting incompatible QoS. "
        f"No messages will be sent to it {rest}RELIABILITY",
        f"topic '/late', offering incompatible QoS. No messages will be received from it {rest}"
        "DEADLINE",
    ):
        assert line in running.text
    assert running.text.count("incompatible QoS") == 4


def test_quality_of_service_is_told_as_it_was_given(passes: Callable[..., Any]) -> None:
    passes(
        HEAD
        + """
from rclpy.duration import Duration
from rclpy.topic_endpoint_info import TopicEndpointTypeEnum
mine = QoSProfile(depth=7, reliability=ReliabilityPolicy.BEST_EFFORT,
                  deadline=Duration(seconds=1.5), liveliness=LivelinessPolicy.MANUAL_BY_TOPIC)
node.create_subscription(String, 'told', print, mine)
(info,) = node.get_subscriptions_info_by_topic('told')
assert info.qos_profile == mine, info.qos_profile
assert info.endpoint_type == TopicEndpointTypeEnum.SUBSCRIPTION
lines = str(info).splitlines()
assert lines[:3] == ['Node name: program', 'Node namespace: /', 'Topic type: std_msgs/msg/String']
assert lines[6:] == ['QoS profile:', '  Reliability: BEST_EFFORT',
    '  History (Depth): KEEP_LAST (7)', '  Durability: VOLATILE', '  Lifespan: Infinite',
    '  Deadline: 1500000000 nanoseconds', '  Liveliness: MANUAL_BY_TOPIC',
    '  Liveliness lease duration: Infinite'], lines
node.create_subscription(String, 'all', print, QoSProfile(history=HistoryPolicy.KEEP_ALL))
assert '  History (Depth): KEEP_ALL' in str(node.get_subscriptions_info_by_topic('all')[0])
"""
    )


def test_callback_of_two_arguments_gets_where_a_message_came_from(
    passes: Callable[..., Any],
) -> None:
    passes(
        HEAD
        + """
import time
got = []
start = time.time_ns()
node.create_subscription(String, 'chat', lambda message, info: got.append(info), 10)
pub = node.create_publisher(String, 'chat', 10)
for _ in range(2):
    pub.publish(String(data='x'))
spin(lambda: len(got) == 2)
(end,) = node.get_publishers_info_by_topic('chat')
for number, info in enumerate(got, 1):
    assert sorted(info) == ['publication_sequence_number', 'publisher_gid',
        'received_timestamp', 'reception_sequence_number', 'source_timestamp'], info
    assert start <= info['source_timestamp'] <= info['received_timestamp'] <= time.time_ns()
    assert info['publication_sequence_number'] == number
    assert list(info['publisher_gid']['data']) == end.endpoint_gid
    assert info['publisher_gid']['implementation_identifier'] == 'rmw_zenoh_cpp'
"""
    )


def test_guard_condition_calls_once_for_several_triggers(passes: Callable[..., Any]) -> None:
    passes(
        HEAD
        + """
import threading
calls = []
guard = node.create_guard_condition(lambda: calls.append(threading.current_thread().name))
for _ in range(3):
    guard.trigger()
rclpy.spin_once(node, timeout_sec=1)
rclpy.spin_once(node, timeout_sec=0)
assert calls == ['MainThread'] and list(node.guards) == [guard]
thread = threading.Thread(target=guard.trigger); thread.start()
spin(lambda: len(calls) == 2)
assert node.destroy_guard_condition(guard)
guard.trigger()
rclpy.spin_once(node, timeout_sec=0)
assert len(calls) == 2
"""
    )


def test_raw_subscription_gets_bytes_that_can_be_sent_again(passes: Callable[..., Any]) -> None:
    passes(
        HEAD
        + """
from rclpy.serialization import deserialize_message, serialize_message
got = []
node.create_subscription(String, 'raw', got.append, 10, raw=True)
pub = node.create_publisher(String, 'raw', 10)
pub.publish(String(data='hello'))
spin(lambda: got)
assert isinstance(got[0], bytes) and got[0] == serialize_message(String(data='hello')), got
assert got[0][:4] == b'\\x00\\x01\\x00\\x00'
assert deserialize_message(got[0], String).data == 'hello'
pub.publish(got[0])
spin(lambda: len(got) == 2)
assert got[1] == got[0]
"""
    )


def test_modules_of_rclpy_can_be_imported(passes: Callable[..., Any]) -> None:
    passes(
        """
import rclpy
from rclpy.expand_topic_name import expand_topic_name
from rclpy.lifecycle import LifecycleNode, Node as LNode, Publisher, State, TransitionCallbackReturn
from rclpy.lifecycle.node import LifecycleState
from rclpy.signals import SignalHandlerOptions
from rclpy.topic_endpoint_info import TopicEndpointInfo
from rclpy.utilities import get_available_rmw_implementations, remove_ros_args
from rclpy.validate_topic_name import validate_topic_name
from rclpy.wait_for_message import wait_for_message
from rclpy.exceptions import InvalidNodeNameException, TimerCancelledError
from std_msgs.msg import String
assert LNode is LifecycleNode and expand_topic_name('a', 'n', '/') == '/a'
assert get_available_rmw_implementations() == {'rmw_zenoh_cpp'}
with rclpy.init(args=['p', 'mine', '--ros-args', '-r', 'a:=b']):
    assert remove_ros_args(['p', 'mine', '--ros-args', '-r', 'a:=b']) == ['p', 'mine']
    with rclpy.create_node('n') as node:
        assert node.wait_for_node('/n', 5.0) and not node.wait_for_node('/other', 0.01)
        assert node.count_services('/n/get_parameters') == 1
        latched = rclpy.qos.qos_profile_action_status_default
        node.create_publisher(String, 'once', latched).publish(String(data='x'))
        ok, message = wait_for_message(String, node, 'once', qos_profile=latched, time_to_wait=5)
        assert ok and message.data == 'x'
        assert wait_for_message(String, node, 'never', time_to_wait=0.01) == (False, None)
        assert node.create_publisher(String, 'once', latched).wait_for_all_acked()
assert not rclpy.ok()
"""
    )
