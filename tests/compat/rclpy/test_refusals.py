"""What rclpy 9.1.2 refuses, and what it offers without being asked."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

HEAD = """
import rclpy
from rclpy.parameter import Parameter
from std_msgs.msg import String
rclpy.init(args=['x', '--ros-args', '-p', 'd:=3', '-p', 'da:=[1, 2]', '-r', 'a:=b', '-r', 'b:=a'])
node = rclpy.create_node('program')
def error_of(call):
    try:
        call()
    except Exception as error:
        return f'{type(error).__name__}: {error}'
    raise AssertionError('was taken')
"""


@pytest.mark.reference
def test_integer_is_no_double(passes: Callable[..., Any]) -> None:
    passes(
        HEAD
        + """
text = error_of(lambda: node.declare_parameter('d', 1.0))
assert text == ("InvalidParameterTypeException: Trying to set parameter 'd' to '3' of type "
                "'INTEGER', expecting type 'DOUBLE': d"), text
text = error_of(lambda: node.declare_parameter('da', [1.0]))
assert text.endswith("to '[1, 2]' of type 'INTEGER_ARRAY', expecting type 'DOUBLE_ARRAY': da")
node.declare_parameters('', [('e', 1.0), ('f', [1.0])])
for name, value, reason in (
    ('e', 2, "Wrong parameter type, expected '3' got '2'"),
    ('f', [2, 3], "Wrong parameter type, expected '8' got '7'"),
    ('e', 2.5, ''),
):
    (result,) = node.set_parameters([Parameter(name, value=value)])
    assert (result.successful, result.reason) == (not reason, reason), result
assert node.get_parameter('e').value == 2.5
assert error_of(lambda: Parameter('g', Parameter.Type.DOUBLE, 3)) == (
    "ValueError: Type '3' and value '3' do not agree")
"""
    )


@pytest.mark.reference
def test_names_may_begin_with_an_underscore(passes: Callable[..., Any]) -> None:
    passes(
        HEAD
        + """
assert rclpy.create_node('_hidden').get_fully_qualified_name() == '/_hidden'
assert rclpy.create_node('__a').get_fully_qualified_name() == '/__a'
assert node.create_publisher(String, '_x', 1).topic_name == '/_x'
assert node.create_publisher(String, '{node}/x', 1).topic_name == '/program/x'
# Two names that are swapped are each remapped once.
assert node.create_publisher(String, 'a', 1).topic_name == '/b'
assert node.create_publisher(String, 'b', 1).topic_name == '/a'
assert error_of(lambda: node.create_publisher(String, 'a b', 1)).startswith(
    'InvalidTopicNameException: Invalid topic name: topic name must not contain characters other')
assert error_of(lambda: node.create_subscription(String, '{bad}/x', print, 1)).startswith(
    "ValueError: topic name '{bad}/x' is invalid: unknown substitution: {bad}")
from example_interfaces.srv import AddTwoInts
assert error_of(lambda: node.create_service(AddTwoInts, 'a b', print)).startswith(
    'InvalidServiceNameException: Invalid service name: ')
"""
    )


@pytest.mark.reference
def test_types_in_use_are_described(passes: Callable[..., Any]) -> None:
    passes(
        HEAD
        + """
import threading
from geometry_msgs.msg import Twist
from type_description_interfaces.srv import GetTypeDescription
threading.Thread(target=rclpy.spin, args=(node,), daemon=True).start()
node.create_publisher(String, 'x', 1)
node.create_publisher(Twist, 'y', 1)
client = node.create_client(GetTypeDescription, '/program/get_type_description')
assert client.wait_for_service(5)
def ask(name, digest, sources=True):
    return client.call(GetTypeDescription.Request(
        type_name=name, type_hash=digest, include_type_sources=sources))
known = 'RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18'
found = ask('std_msgs/msg/String', known)
assert found.successful and not found.failure_reason
(field,) = found.type_description.type_description.fields
assert (field.name, field.type.type_id) == ('data', 17)
assert [one.type_name for one in found.type_sources] == ['std_msgs/msg/String']
assert found.type_sources[0].encoding == 'msg'
assert 'string data' in found.type_sources[0].raw_file_contents
assert ask('std_msgs/msg/String', known, sources=False).type_sources == []
twist = 'RIHS01_9c45bf16fe0983d80e3cfe750d6835843d265a9a6c46bd2e609fcddde6fb8d2a'
found = ask('geometry_msgs/msg/Twist', twist)
(part,) = found.type_description.referenced_type_descriptions
assert part.type_name == 'geometry_msgs/msg/Vector3'
assert ask('std_msgs/msg/String', '').failure_reason == 'Failed to parse type hash'
for name in ('std_msgs/msg/String', 'std_msgs/msg/Nope', 'sensor_msgs/msg/Image'):
    answer = ask(name, 'RIHS01_' + '0' * 64)
    assert answer.failure_reason == 'Type not currently in use by this node', answer
known = node.describe_parameter('start_type_description_service')
assert known.read_only and known.description.startswith('If enabled, start the ~/get_type')
off = [Parameter('start_type_description_service', value=False)]
rclpy.create_node('quiet', parameter_overrides=off)
assert node.count_services('/quiet/get_type_description') == 0
assert node.count_services('/quiet/get_parameters') == 1
"""
    )


def test_levels_of_loggers_are_set_by_service(passes: Callable[..., Any]) -> None:
    passes(
        HEAD
        + """
import threading
from rclpy.impl.logging_severity import LoggingSeverity
from rcl_interfaces.msg import LoggerLevel
from rcl_interfaces.srv import GetLoggerLevels, SetLoggerLevels
talkative = rclpy.create_node('talkative', enable_logger_service=True)
executor = rclpy.executors.SingleThreadedExecutor()
executor.add_node(node)
executor.add_node(talkative)
threading.Thread(target=executor.spin, daemon=True).start()
setter = node.create_client(SetLoggerLevels, '/talkative/set_logger_levels')
assert setter.wait_for_service(5)
asked = [LoggerLevel(name='talkative', level=40), LoggerLevel(name='talkative', level=7)]
done, refused = setter.call(SetLoggerLevels.Request(levels=asked)).results
assert done.successful and not refused.successful
assert refused.reason == 'Failed reason: Invalid logger level.'
assert talkative.get_logger().get_effective_level() == LoggingSeverity.ERROR
getter = node.create_client(GetLoggerLevels, '/talkative/get_logger_levels')
found = getter.call(GetLoggerLevels.Request(names=['talkative', 'other'])).levels
assert [(one.name, one.level) for one in found] == [('talkative', 40), ('other', 0)]
assert node.count_services('/program/get_logger_levels') == 0
"""
    )


def test_futures_are_awaited_by_asyncio_and_by_executors(passes: Callable[..., Any]) -> None:
    passes(
        HEAD
        + """
import asyncio
from rclpy.task import Future
first, second = Future(), Future()
node.create_timer(0.01, lambda: first.set_result(1))
async def in_executor():
    second.set_result(await first + 1)
rclpy.get_global_executor().create_task(in_executor)
async def spin():
    while not second.done():
        rclpy.spin_once(node, timeout_sec=0)
        await asyncio.sleep(0.001)
async def main():
    spinning = asyncio.ensure_future(spin())
    found = await first, await second
    await spinning
    return found
assert asyncio.run(asyncio.wait_for(main(), 10)) == (1, 2)
"""
    )


def test_names_of_events_and_overrides_can_be_imported(passes: Callable[..., Any]) -> None:
    passes("""
from rclpy.event_handler import IncompatibleTypeInfo, QoSOfferedDeadlineMissedInfo
from rclpy.event_handler import QoSOfferedIncompatibleQoSInfo, QoSPublisherMatchedInfo
from rclpy.event_handler import QoSRequestedDeadlineMissedInfo, QoSRequestedIncompatibleQoSInfo
from rclpy.event_handler import QoSSubscriptionMatchedInfo
from rclpy.qos_overriding_options import QosCallbackResult
assert QosCallbackResult(successful=True).reason == ''
""")
