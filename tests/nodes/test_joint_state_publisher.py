"""Where joints stand that nothing moves."""

from __future__ import annotations

import threading
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import pytest
from tests.patience import await_change, stretched

from gazelle.description.model import Joint, JointAxis, JointType, Link, Model
from gazelle.graph import Graph
from gazelle.interfaces import message_type
from gazelle.nodes.arguments import read_arguments
from gazelle.nodes.joint_state_publisher import _Publisher, default_position, run

_STATE: Any = message_type("sensor_msgs/JointState")
_LIMIT = '<limit lower="-1" upper="1" effort="1" velocity="1"/>'
_ROBOT = f"""<robot name="r"><link name="a"/><link name="b"/><link name="c"/>
  <joint name="left" type="revolute"><parent link="a"/><child link="b"/>{_LIMIT}</joint>
  <joint name="right" type="revolute"><parent link="a"/><child link="c"/>{_LIMIT}</joint>
</robot>"""


class _Heard:
    """The names of the joints in the last message."""

    def __init__(self) -> None:
        self._names: list[str] = []
        self._changed = threading.Condition()

    def __call__(self, message: Any) -> None:
        with self._changed:
            self._names = sorted(message.name)
            self._changed.notify_all()

    def until(self, names: list[str]) -> None:
        with self._changed:
            assert await_change(self._changed, lambda: self._names == names), self._names


def _joint(lower: float, upper: float) -> Joint:
    return Joint("j", JointType.REVOLUTE, "a", "b", axis=JointAxis(lower=lower, upper=upper))


@pytest.mark.parametrize(
    ("lower", "upper", "expected"), [(-1.0, 1.0, 0.0), (0.5, 1.5, 1.0), (-2.0, -1.0, -1.5)]
)
def test_joint_stands_at_zero_or_in_the_middle_when_zero_is_out_of_range(
    lower: float, upper: float, expected: float
) -> None:
    assert default_position(_joint(lower, upper), {}) == expected


def test_zeros_parameter_wins() -> None:
    assert default_position(_joint(-1.0, 1.0), {"j": 0.3}) == 0.3


def test_joints_are_ours_again_when_their_publisher_ends(free_port: int) -> None:
    with Graph.open(port=free_port, role="hub", environ={}) as graph:
        graph.parameters.set("/robot_description", _ROBOT)
        stop, heard = threading.Event(), _Heard()
        arguments = read_arguments(["_rate:=50"], "joint_state_publisher")
        running = threading.Thread(target=run, args=(arguments, graph, stop))
        ear = Graph.open(port=free_port, environ={})
        ear.create_node("ear", rosout=False).create_subscription("/joint_states", _STATE, heard)
        running.start()
        heard.until(["left", "right"])
        with Graph.open(port=free_port, environ={}) as other:
            publisher = other.create_node("other", rosout=False).create_publisher(
                "/joint_states", _STATE, latch=True
            )
            publisher.publish(_STATE(name=["left"], position=[1.0]))
            heard.until(["right"])
        heard.until(["left", "right"])
        stop.set()
        running.join(stretched())
        ear.close()


def test_own_messages_that_come_back_late_are_known(bench: Any) -> None:
    joints = tuple(replace(_joint(-1.0, 1.0), name=name) for name in ("left", "right"))
    arguments = read_arguments([], "joint_state_publisher")
    model = Model("r", links=(Link("a"), Link("b")), joints=joints)
    publisher, sent = _Publisher(bench.node, arguments, model), []
    publisher._out = SimpleNamespace(publish=sent.append, topic="/joint_states")
    publisher.publish()
    publisher.publish()
    publisher._on_others(sent[0])
    publisher.publish()
    assert [message.name for message in sent] == [["left", "right"]] * 3


def _publisher(bench: Any, parameters: dict[str, Any]) -> _Publisher:
    joints = tuple(replace(_joint(-1.0, 1.0), name=name) for name in ("l.eft", "ri/ght"))
    model = Model("r", links=(Link("a"), Link("b")), joints=joints)
    bench.graph.parameters.set(bench.node.name, parameters)
    return _Publisher(bench.node, read_arguments([], "joint_state_publisher"), model)


def test_joints_with_dots_and_slashes_stand_where_parameters_say(bench: Any) -> None:
    of_ros2 = {"zeros": {"l.eft": 0.3, "ri/ght": 0.4}}
    publisher = _publisher(bench, {"me": {"ros__parameters": of_ros2}})
    assert publisher._positions == {"l.eft": 0.3, "ri/ght": 0.4}
    publisher = _publisher(
        bench, {"dependent_joints": {"ri/ght": {"parent": "l.eft", "factor": 2}}}
    )
    assert publisher._position("ri/ght") == 0.0
    assert publisher._dependents["ri/ght"].factor == 2.0


def test_values_of_joints_that_are_none_are_told(bench: Any, capfd: Any) -> None:
    parameters = {
        "zeros": {"l.eft": "up"},
        "dependent_joints": {
            "ri/ght": {"parent": "l.eft", "offset": "much"},
            "l.eft": {"factor": 2.0},
        },
    }
    publisher = _publisher(bench, parameters)
    assert publisher._positions == {"l.eft": 0.0}
    assert publisher._dependents["ri/ght"].offset == 0.0
    _publisher(bench, {"zeros": 5})
    told = capfd.readouterr().err
    assert "parameter 'zeros.l.eft' is 'up', not a number; 0 is used" in told
    assert "'dependent_joints.ri.ght.offset' is 'much', not a number; 0 is used" in told
    assert "parameter 'dependent_joints.l.eft' has no parent; it is left out" in told
    assert "parameter 'zeros' is 5, not a group with names of joints; it is left out" in told


def test_robot_may_come_on_the_topic_in_ros2(bench: Any) -> None:
    states = bench.listen("/joint_states", "sensor_msgs/msg/JointState")
    bench.start("joint_state_publisher/joint_state_publisher", "--ros-args", "-p", "rate:=100")
    kind: Any = message_type("std_msgs/msg/String")
    publisher = bench.node.create_publisher("/robot_description", kind, latch=True)
    robot = """<robot name="r"><link name="a"/><link name="b"/><joint name="j" type="continuous">
      <parent link="a"/><child link="b"/></joint></robot>"""
    publisher.publish(kind(data=robot))
    bench.eventually(lambda: states)
    assert states[0].name == ["j"]
    assert bench.stop() == [0]
