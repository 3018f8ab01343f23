"""``teleop_twist_joy teleop_node``: a joystick's axes as velocities, while a button is held.

| name | default ROS 1 | default ROS 2 | meaning |
| --- | --- | --- | --- |
| ~enable_button | 0 | 5 | held, the axes count |
| ~enable_turbo_button | -1 | -1 | held, they count with the turbo's scales; -1 for none |
| ~require_enable_button | – | true | ROS 2: false lets the axes count without a button |
| ~axis_linear | 1 | x 5 | axis, or axes by x, y, z; -1 for none |
| ~scale_linear, ~scale_linear_turbo | 0.5, 1 | x 0.5, x 1 | m/s at full deflection |
| ~axis_angular | 0 | yaw 2 | axis, or axes by yaw, pitch, roll |
| ~scale_angular, ~scale_angular_turbo | 0.5, as that | yaw 0.5, yaw 1 | rad/s at full deflection |
| ~inverted_reverse | – | false | ROS 2: turn the other way when driving backwards |
| ~publish_stamped_twist, ~frame | – | false, teleop_twist_joy | ROS 2: ``TwistStamped`` |

Letting go sends one standstill, then nothing. Names and rules are those of ``teleop_twist_joy``.
"""

from __future__ import annotations

import threading
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from gazelle.diagnostics import Diagnostics
from gazelle.graph import Graph, Node
from gazelle.interfaces import message_type
from gazelle.interfaces.stamps import set_header
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.parameters import (
    log_findings,
    node_reader,
    offer_parameters,
    parameter_tree,
    start_node,
)
from gazelle.parameters import Parameter, ParameterTable
from gazelle.parameters.trees import flattened, nested, values_only

__all__ = ["PARAMETERS", "JoyDriving", "read_driving", "run"]

_LINEAR, _ANGULAR = ("x", "y", "z"), ("yaw", "pitch", "roll")
_FIELDS = (*_LINEAR, *_ANGULAR)
_GROUPS = {
    "axis_linear": _LINEAR,
    "axis_angular": _ANGULAR,
    "scale_linear": _LINEAR,
    "scale_angular": _ANGULAR,
    "scale_linear_turbo": _LINEAR,
    "scale_angular_turbo": _ANGULAR,
}
_ROS1 = {"axis_linear.x": 1, "axis_angular.yaw": 0}
_ROS2 = {"axis_linear.x": 5, "axis_angular.yaw": 2}
_SCALES = {
    "scale_linear.x": 0.5,
    "scale_angular.yaw": 0.5,
    "scale_linear_turbo.x": 1.0,
    "scale_angular_turbo.yaw": 1.0,
}
_ROWS = (
    Parameter("enable_button", "integer", 5, "held, the axes count"),
    Parameter("enable_turbo_button", "integer", -1, "held, they count with the turbo's scales"),
    Parameter(
        "require_enable_button", "flag", True, "the axes count while the button is held only"
    ),
    Parameter("inverted_reverse", "flag", False, "turn the other way when driving backwards"),
    Parameter("publish_stamped_twist", "flag", False, "send TwistStamped"),
    Parameter("frame", "text", "teleop_twist_joy", "frame of TwistStamped"),
    *(
        Parameter(
            f"{group}.{field}",
            "integer" if group.startswith("axis") else "number",
            _ROS2.get(f"{group}.{field}", -1)
            if group.startswith("axis")
            else _SCALES.get(f"{group}.{field}", 0.0),
            "axis, -1 for none" if group.startswith("axis") else "at full deflection",
        )
        for group, fields in _GROUPS.items()
        for field in fields
    ),
)
PARAMETERS = ParameterTable(
    "teleop_node", "axes as velocities", ("teleop_twist_joy/teleop_node",), _ROWS
)


@dataclass(frozen=True, slots=True)
class JoyDriving:
    """What buttons and axes mean.

    Attributes:
        axes: of each field (x, y, z, yaw, pitch, roll), -1 for none.
        scales, turbo_scales: m/s and rad/s at full deflection, of each field.
        enable_button, turbo_button: their numbers, -1 for none.
        needs_button: nothing counts without the first.
        inverts_reverse: turns go the other way backwards.
    """

    axes: Mapping[str, int]
    scales: Mapping[str, float]
    turbo_scales: Mapping[str, float]
    enable_button: int
    turbo_button: int
    needs_button: bool
    inverts_reverse: bool

    def velocities(self, joy: Any) -> dict[str, float] | None:
        """Return m/s and rad/s by field, None when nothing counts."""
        if _is_held(joy, self.turbo_button):
            return self._scaled(joy, self.turbo_scales)
        if not self.needs_button or _is_held(joy, self.enable_button):
            return self._scaled(joy, self.scales)
        return None

    def _scaled(self, joy: Any, scales: Mapping[str, float]) -> dict[str, float]:
        speeds = {
            field: float(joy.axes[axis]) * scales[field] if 0 <= axis < len(joy.axes) else 0.0
            for field, axis in self.axes.items()
        }
        if self.inverts_reverse and speeds["x"] < 0:
            speeds["yaw"] = -speeds["yaw"]
        return speeds


def _is_held(joy: Any, button: int) -> bool:
    return 0 <= button < len(joy.buttons) and bool(joy.buttons[button])


def read_driving(
    tree: Mapping[str, Any], name: str, found: Diagnostics, *, is_ros2: bool
) -> JoyDriving:
    """Read the parameters of a node.

    Args:
        tree: the parameters, nested.
        name: of the node.
        found: receives what is wrong.
        is_ros2: its defaults are ROS 2's.
    """
    whole = dict(tree) if is_ros2 else _ros1_tree(tree)
    settings = node_reader(PARAMETERS, whole, name, found)

    def by_field(read: Any, linear: str, angular: str) -> dict[str, Any]:
        return {field: read(f"{linear if field in _LINEAR else angular}.{field}")
                for field in _FIELDS}  # fmt: skip

    settings.report_unknown()
    return JoyDriving(
        by_field(settings.integer, "axis_linear", "axis_angular"),
        by_field(settings.number, "scale_linear", "scale_angular"),
        by_field(settings.number, "scale_linear_turbo", "scale_angular_turbo"),
        settings.integer("enable_button"),
        settings.integer("enable_turbo_button"),
        settings.flag("require_enable_button"),
        settings.flag("inverted_reverse"),
    )


def _ros1_tree(tree: Mapping[str, Any]) -> dict[str, Any]:
    """Return ROS 1's parameters as ROS 2 has them: one number stands for x or for yaw.

    With axes by name, scales that are not given are 0; without, they have defaults.
    """
    whole: dict[str, Any] = {"enable_button": 0, **tree}
    for kind, first in (("linear", "x"), ("angular", "yaw")):
        axis, scale, turbo = (f"{word}_{kind}" for word in ("axis", "scale", "scale"))
        turbo += "_turbo"
        if isinstance(tree.get(axis), Mapping):
            for group in (scale, turbo):
                given = tree.get(group)
                whole[group] = {first: 0.0, **(given if isinstance(given, Mapping) else {})}
            whole[axis] = {first: -1, **tree[axis]}
            continue
        whole[axis] = {first: tree.get(axis, _ROS1[f"{axis}.{first}"])}
        whole[scale] = {first: tree.get(scale, 0.5)}
        as_slow = 1.0 if kind == "linear" else whole[scale][first]
        whole[turbo] = {first: tree.get(turbo, as_slow)}
    return whole


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Drive until told to stop."""
    node = start_node(arguments, graph, offers_parameters=False)
    tree = parameter_tree(node, arguments)
    is_ros2 = arguments.ros_version == 2
    found = Diagnostics()
    driving = read_driving(tree, node.name, found, is_ros2=is_ros2)
    log_findings(node, found)
    teleop = _Teleop(node, tree, driving)
    if is_ros2:
        teleop.offer_parameters()
    _tell(node, driving)
    node.create_subscription("joy", "sensor_msgs/msg/Joy", teleop.on_joy, queue_size=10)
    arguments.ready()
    stop.wait()
    node.shutdown()
    return 0


class _Teleop:
    def __init__(self, node: Node, tree: dict[str, Any], driving: JoyDriving) -> None:
        self._node, self._tree, self._driving = node, tree, driving
        self._stamped = str(tree.get("publish_stamped_twist", False)).lower() == "true"
        self._frame = str(tree.get("frame", "teleop_twist_joy"))
        self._has_stopped = False
        kind = f"geometry_msgs/msg/Twist{'Stamped' if self._stamped else ''}"
        self._out = node.create_publisher("cmd_vel", message_type(kind), queue_size=10)

    def offer_parameters(self) -> None:
        """Let ``ros2 param set`` change buttons, axes and scales."""
        values = dict(values_only(flattened(nested({row.key: row.default for row in _ROWS}))))
        values |= values_only(flattened(self._tree))
        offer_parameters(self._node, nested(values), self._change)

    def _change(self, changes: dict[str, Any]) -> str:
        found = Diagnostics()
        tree = nested({**dict(values_only(flattened(self._tree))), **changes})
        driving = read_driving(tree, self._node.name, found, is_ros2=True)
        if len(found):
            return next(iter(found)).message
        self._tree, self._driving = tree, driving
        return ""

    def on_joy(self, joy: Any) -> None:
        """Send what the joystick says."""
        speeds = self._driving.velocities(joy)
        if speeds is None and self._has_stopped:
            return
        self._has_stopped = speeds is None
        message: Any = self._out.message_class()
        twist = message
        if self._stamped:
            set_header(message, self._node.clock.now_ns(), self._frame)
            twist = message.twist
        fields = speeds or dict.fromkeys(_FIELDS, 0.0)
        twist.linear.x, twist.linear.y, twist.linear.z = (fields[one] for one in _LINEAR)
        twist.angular.z, twist.angular.y, twist.angular.x = (fields[one] for one in _ANGULAR)
        self._out.publish(message)


def _tell(node: Node, driving: JoyDriving) -> None:
    if driving.needs_button:
        node.log("info", f"Teleop enable button {driving.enable_button}.")
    if driving.turbo_button >= 0:
        node.log("info", f"Turbo on button {driving.turbo_button}.")
    for field, axis in driving.axes.items():
        if axis < 0:
            continue
        kind = "Linear" if field in _LINEAR else "Angular"
        node.log("info", f"{kind} axis {field} on {axis} at scale {driving.scales[field]:f}.")
        if driving.turbo_button >= 0:
            scale = driving.turbo_scales[field]
            node.log("info", f"Turbo for {kind.lower()} axis {field} is scale {scale:f}.")
