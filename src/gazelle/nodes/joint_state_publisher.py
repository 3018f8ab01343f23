"""``joint_state_publisher``: states for every joint of a robot that nothing else moves.

ROS 2's node takes a file as its first argument too, and without a robot waits for the topic
``robot_description``.

Unlike ROS's, it leaves out joints that another publisher of the same topic owns: two publishers
for one wheel make its tf frame jump between two poses.
"""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from gazelle.description.model import Joint, JointType, Model
from gazelle.graph import Graph, Node
from gazelle.interfaces import message_type
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.link_tree import published_robot_of, robot_of
from gazelle.nodes.parameters import private_parameters, start_node, ticks
from gazelle.parameters import Parameter, ParameterTable, refused
from gazelle.parameters.reader import ParameterReader, number_of
from gazelle.parameters.trees import flattened

__all__ = ["PARAMETERS", "default_position", "run"]

PARAMETERS = ParameterTable(
    "joint_state_publisher",
    "Publishes states for every joint of a robot that nothing else moves.",
    (
        "joint_state_publisher/joint_state_publisher",
        "joint_state_publisher_gui/joint_state_publisher_gui",
    ),
    (
        Parameter("robot_description", "text", None, "the robot, searched upwards in ROS 1"),
        Parameter("rate", "number", 10.0, "how often states are sent", "Hz"),
        Parameter("source_list", "texts", (), "topics of JointState that are passed on"),
        Parameter("zeros", "group", None, "values of joints that nothing moves", "m or rad"),
        Parameter("dependent_joints", "group", None, "`{joint: {parent, factor, offset}}`"),
        Parameter("use_mimic_tags", "flag", True, "follow `<mimic>`"),
        Parameter("publish_default_positions", "flag", True, "send positions"),
        Parameter("publish_default_velocities", "flag", False, "send velocities of 0"),
        Parameter("publish_default_efforts", "flag", False, "send efforts of 0"),
        Parameter("use_gui", "flag", False, "show the sliders, as up to ROS Melodic"),
        *refused("joints stand where nothing moves them", "delta"),
        *refused("limits have no part in what is sent", "use_smallest_joint_limits"),
        *refused("the page shows what fits", "num_rows"),
    ),
)

_MOVING = frozenset({JointType.REVOLUTE, JointType.CONTINUOUS, JointType.PRISMATIC})

# Messages of our own that were sent and not heard, at most.
_UNHEARD = 1000


@dataclass(frozen=True, slots=True)
class _Dependent:
    parent: str
    factor: float
    offset: float


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Publish ``joint_states`` until told to stop."""
    node = start_node(arguments, graph)
    if arguments.ros_version == 2:
        model = published_robot_of(node, arguments.rest, stop)
    else:
        model = robot_of(node)
    if model is None:
        node.shutdown()
        return 0 if stop.is_set() else 1
    publisher = _Publisher(node, arguments, model)
    for _ in ticks(node, publisher.period_ns, stop):
        publisher.publish()
    node.shutdown()
    return 0


def default_position(joint: Joint, zeros: Mapping[str, float]) -> float:
    """Return where a joint stands when nothing moves it: 0, or mid-range when 0 is forbidden."""
    if joint.name in zeros:
        return float(zeros[joint.name])
    if joint.axis is None or joint.axis.lower <= 0 <= joint.axis.upper:
        return 0.0
    return (joint.axis.lower + joint.axis.upper) / 2


class _Publisher:
    def __init__(self, node: Node, arguments: NodeArguments, model: Model) -> None:
        self._node = node
        self._type: Any = message_type("sensor_msgs/msg/JointState")
        self._out = node.create_publisher("joint_states", self._type, queue_size=5)
        with private_parameters(node, arguments, PARAMETERS) as own:
            self.period_ns = int(1e9 / own.number("rate"))
            use_mimics = own.flag("use_mimic_tags")
            self._with = {
                word: own.flag(f"publish_default_{word}")
                for word in ("positions", "velocities", "efforts")
            }
            sources = own.texts("source_list")
            zeros = _zeros(own, model)
            self._dependents = _dependents(own, model, use_mimics=use_mimics)
        self._positions = {
            joint.name: default_position(joint, zeros)
            for joint in model.joints
            if joint.type in _MOVING and joint.name not in self._dependents
        }
        self._names = [
            joint.name
            for joint in model.joints
            if joint.name in self._positions or joint.name in self._dependents
        ]
        # On a busy machine messages of our own come back only after more of them were sent.
        self._sent: deque[Any] = deque(maxlen=_UNHEARD)
        self._sending = threading.Lock()
        self._foreign: set[str] = set()
        node.create_subscription("joint_states", self._type, self._on_others)
        for topic in sources:
            node.create_subscription(topic, self._type, self._on_source)

    def publish(self) -> None:
        self._take_back()
        names = [name for name in self._names if name not in self._foreign]
        if not names:
            return
        message = self._type(name=names)
        message.header.stamp.sec, message.header.stamp.nanosec = divmod(
            self._node.clock.now_ns(), 1_000_000_000
        )
        if self._with["positions"]:
            message.position = [self._position(name) for name in names]
        if self._with["velocities"]:
            message.velocity = [0.0] * len(names)
        if self._with["efforts"]:
            message.effort = [0.0] * len(names)
        with self._sending:
            self._sent.append(message)
        self._out.publish(message)

    def _position(self, name: str) -> float:
        factor, offset = 1.0, 0.0
        # Joints that mimic each other in a ring stand at their offsets.
        for _ in self._names:
            dependent = self._dependents.get(name)
            if dependent is None:
                return factor * self._positions.get(name, 0.0) + offset
            offset += factor * dependent.offset
            factor, name = factor * dependent.factor, dependent.parent
        return offset

    def _on_others(self, message: Any) -> None:
        with self._sending:
            if any(message is one for one in self._sent):
                while self._sent.popleft() is not message:
                    pass
                return
        new = set(message.name) & set(self._names) - self._foreign
        if new:
            self._foreign |= new
            joints = ", ".join(sorted(new))
            self._node.log("info", f"joints that another node publishes are left to it: {joints}")

    def _take_back(self) -> None:
        """Joints are ours again when nobody else is left who could publish them."""
        if self._foreign and self._node.graph.publisher_count(self._out.topic) <= 1:
            self._foreign.clear()

    def _on_source(self, message: Any) -> None:
        for name, position in zip(message.name, message.position, strict=False):
            if name in self._positions:
                self._positions[name] = float(position)


def _by_joint(own: ParameterReader, key: str) -> dict[str, Any]:
    """Return the leaves of a group, by names with dots; names of joints may have dots, too."""
    value = own.raw(key, {})
    if isinstance(value, Mapping):
        return dict(flattened(value))
    text = f"parameter '{key}' is {value!r}, not a group with names of joints; it is left out"
    own.report("parameter.bad-value", text, key=key)
    return {}


def _dotted(name: str) -> str:
    """Return a joint's name as parameters write it, whose slashes are branches."""
    return name.replace("/", ".")


def _number(own: ParameterReader, key: str, value: Any, default: float) -> float:
    number = number_of(value)
    if number is None:
        text = f"parameter '{key}' is {value!r}, not a number; {default:g} is used"
        own.report("parameter.bad-value", text, "write a number", key=key)
    return default if number is None else number


def _zeros(own: ParameterReader, model: Model) -> dict[str, float]:
    given = _by_joint(own, "zeros")
    return {
        joint.name: _number(own, f"zeros.{name}", given[name], default_position(joint, {}))
        for joint in model.joints
        if (name := _dotted(joint.name)) in given
    }


def _dependents(own: ParameterReader, model: Model, *, use_mimics: bool) -> dict[str, _Dependent]:
    given = _by_joint(own, "dependent_joints")
    joints = {_dotted(joint.name): joint.name for joint in model.joints}
    found: dict[str, _Dependent] = {}
    for name in dict.fromkeys(key.rpartition(".")[0] for key in given):
        place = f"dependent_joints.{name}"
        if f"{name}.parent" not in given:
            text = f"parameter '{place}' has no parent; it is left out"
            own.report("parameter.bad-value", text, key=place)
        elif name in joints:
            factor, offset = (
                _number(own, f"{place}.{one}", given.get(f"{name}.{one}", otherwise), otherwise)
                for one, otherwise in (("factor", 1.0), ("offset", 0.0))
            )
            found[joints[name]] = _Dependent(str(given[f"{name}.parent"]), factor, offset)
    if use_mimics:
        for joint in model.joints:
            if joint.mimic is not None and joint.name not in found:
                mimic = joint.mimic
                found[joint.name] = _Dependent(mimic.joint, mimic.multiplier, mimic.offset)
    return found
