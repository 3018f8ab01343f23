"""Parameters of other nodes, and what is heard of them."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from gazelle.compat.rclpy.parameter import get_parameter_value, parameter_dict_from_yaml_file

PROGRAM = """
import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.parameter import Parameter
from rclpy.parameter_client import AsyncParameterClient
from rclpy.parameter_event_handler import ParameterEventHandler
from rcl_interfaces.msg import ParameterDescriptor, FloatingPointRange
rclpy.init()
other = rclpy.create_node('other')
other.declare_parameter('speed', 1.0)
other.declare_parameter('arm.joints', ['a', 'b'])
asker = rclpy.create_node('asker')
executor = SingleThreadedExecutor()
executor.add_node(other); executor.add_node(asker)
def of(future):
    executor.spin_until_future_complete(future, timeout_sec=10)
    return future.result()
"""


def test_async_client_asks_and_sets(passes: Callable[..., Any], tmp_path: Path) -> None:
    file = tmp_path / "other.yaml"
    file.write_text("/other:\n  ros__parameters:\n    speed: 7.5\n    arm: {joints: [c]}\n")
    passes(
        PROGRAM
        + f"FILE = {str(file)!r}\n"
        + """
client = AsyncParameterClient(asker, 'other')
assert client.wait_for_services(timeout_sec=10)
assert not AsyncParameterClient(asker, 'nobody').wait_for_services(timeout_sec=0.05)
assert 'speed' in of(client.list_parameters()).result.names
assert of(client.list_parameters(['arm'], 1)).result.names == ['arm.joints']
told = []
results = of(client.set_parameters([Parameter('speed', value=2.5)], told.append)).results
assert results[0].successful
executor.spin_once(timeout_sec=0.5)
assert told and told[0].result().results[0].successful
values = of(client.get_parameters(['speed', 'nope'])).values
assert values[0].double_value == 2.5 and values[1].type == 0
assert list(of(client.get_parameter_types(['speed'])).types) == [3]
assert of(client.describe_parameters(['speed'])).descriptors[0].name == 'speed'
two = [Parameter('speed', value=3.5), Parameter('nope', value=1).to_parameter_msg()]
assert not of(client.set_parameters_atomically(two)).result.successful
assert other.get_parameter('speed').value == 2.5
assert not of(client.delete_parameters(['speed'])).results[0].successful
assert all(one.successful for one in of(client.load_parameter_file(FILE)).results)
assert other.get_parameter('speed').value == 7.5
assert other.get_parameter('arm.joints').value == ['c']
assert other.list_parameters(['arm'], 0).names == ['arm.joints']
limits = ParameterDescriptor()
limits.floating_point_range = [FloatingPointRange(from_value=0.0, to_value=5.0)]
try:
    other.set_descriptor('speed', limits)
except Exception as error:
    assert "doesn't comply with range [0, 5]" in str(error), error
else:
    raise AssertionError('7.5 is too much')
four = Parameter('x', value=4.0).get_parameter_value()
assert other.set_descriptor('speed', limits, four).double_value == 4.0
"""
    )


def test_event_handler_tells_of_one_parameter_and_of_all(passes: Callable[..., Any]) -> None:
    passes(
        PROGRAM
        + """
handler = ParameterEventHandler(asker)
heard, events = [], []
one = handler.add_parameter_callback('speed', 'other', lambda p: heard.append(p.value.double_value))
every = handler.add_parameter_event_callback(lambda e: events.append(e.node))
for value in (2.0, 3.0):
    other.set_parameters([Parameter('speed', value=value)])
while len(heard) < 2:
    executor.spin_once(timeout_sec=10)
assert heard == [2.0, 3.0] and '/other' in events
handler.remove_parameter_callback(one)
handler.remove_parameter_event_callback(every)
try:
    handler.remove_parameter_callback(one)
except RuntimeError as error:
    assert str(error) == "Callback doesn't exist"
else:
    raise AssertionError('it was removed')
"""
    )


@pytest.mark.reference
def test_parameter_file_gives_messages_of_the_nodes_asked_for(tmp_path: Path) -> None:
    file = tmp_path / "p.yaml"
    file.write_text(
        "/**:\n  ros__parameters:\n    a: 1\n"
        "/ns/me:\n  ros__parameters:\n    b: [1, 2]\n    c: {d: x, e: 2.0}\n"
    )

    def names(**options: Any) -> list[str]:
        return list(parameter_dict_from_yaml_file(str(file), **options))

    assert names(target_nodes=["/ns/me"]) == ["b", "c.d", "c.e"]
    assert names(target_nodes=["ns/me"], use_wildcard=True) == ["a", "b", "c.d", "c.e"]
    assert names(target_nodes=["/nope"], use_wildcard=True, namespace="q") == ["qa"]
    with pytest.raises(RuntimeError, match=r"does not contain any valid parameters.*/ns/me"):
        names(target_nodes=["/nope"])


def test_texts_of_the_command_line_become_values() -> None:
    assert get_parameter_value("3").integer_value == 3
    assert get_parameter_value("[1.5, 2.0]").double_array_value == [1.5, 2.0]
    assert get_parameter_value("hello").string_value == "hello"
    assert get_parameter_value("{a: 1}").string_value == "{a: 1}"
