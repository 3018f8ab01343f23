"""``twist_mux joystick_relay.py``: velocities in shares of 1 to m/s and rad/s, in steps.

``joy_vel_in`` to ``joy_vel_out`` while the joystick has priority, which ``joy_priority`` tells and
the action ``joy_priority_action`` toggles; ``joy_turbo_increase``, ``joy_turbo_decrease``, the two
``joy_turbo_angular_…`` and ``joy_turbo_reset`` go up and down the steps.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any, Literal

from gazelle.errors import LaunchError
from gazelle.graph import Graph, Node
from gazelle.graph.actions import ActionServer, ServerGoal
from gazelle.interfaces import message_type
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.parameters import private_parameters, start_node, ticks
from gazelle.parameters import Parameter, ParameterTable
from gazelle.parameters.reader import ParameterReader

__all__ = ["PARAMETERS", "Steps", "run"]

_FIRST, _LAST = "{} at full deflection at the first step", "{} at full deflection at the last step"


def _speeds(name: str, default: float | None, what: str, unit: str) -> tuple[Parameter, Parameter]:
    return (
        Parameter(f"turbo.{name}_min", "number", default, _FIRST.format(what), unit),
        Parameter(f"turbo.{name}_max", "number", default, _LAST.format(what), unit),
    )


PARAMETERS = ParameterTable(
    "joystick_relay",
    "Makes velocities of a joystick's shares, in steps. A speed must be greater than 0.",
    ("twist_mux/joystick_relay.py",),
    (
        Parameter("priority", "flag", True, "whether the joystick has it at the start"),
        Parameter("turbo.steps", "number", 1, "how many steps there are"),
        Parameter("turbo.init_step", "integer", None, "the first one; the middle when absent"),
        *_speeds("linear_forward", 1.0, "forward", "m/s"),
        *_speeds("linear_backward", None, "backward (as forward when absent)", "m/s"),
        *_speeds("linear_lateral", 1.0, "sideways", "m/s"),
        *_speeds("angular", 1.0, "turning", "rad/s"),
    ),
)

_SECOND_NS = 1_000_000_000
_TEXT_VIEW_FACING = 9
_TWIST = "geometry_msgs/msg/Twist"


class Steps:
    """How fast full deflection is.

    Args:
        own: the parameters; those below ``turbo`` are read.

    Attributes:
        step, angular_step: 1 to the number of steps.

    Raises:
        LaunchError: a speed or the number of steps is not greater than 0.
    """

    def __init__(self, own: ParameterReader) -> None:
        """Begin at ``init_step``."""
        self._count = int(_positive(own, "turbo.steps"))
        forward = _range(own, "linear_forward")
        self._ranges = {
            "forward": forward,
            "backward": _range(own, "linear_backward", forward),
            "lateral": _range(own, "linear_lateral"),
            "angular": _range(own, "angular"),
        }
        middle = (self._count + 1) // 2
        wanted = own.integer("turbo.init_step", middle)
        self.refused = wanted if not 1 <= wanted <= self._count else 0
        self._first = middle if self.refused else wanted
        self.step = self.angular_step = self._first

    def speed(self, kind: str, share: float) -> float:
        """Return m/s or rad/s of a share from -1 to 1."""
        low, high = self._ranges[kind]
        place = self.angular_step if kind == "angular" else self.step
        rise = (high - low) / (self._count - 1) if self._count > 1 else 0.0
        return share * (low + rise * (place - 1))

    def move(self, by: int, *, angular_only: bool = False) -> None:
        """Go up or down, the linear ones too unless told otherwise."""
        self.angular_step = min(max(self.angular_step + by, 1), self._count)
        if not angular_only:
            self.step = min(max(self.step + by, 1), self._count)

    def reset(self) -> None:
        """Go back to the first one."""
        self.step = self.angular_step = self._first


def _positive(own: ParameterReader, key: str, default: float | None = None) -> float:
    value = own.raw(key, own.default(key, default, None))
    if isinstance(value, bool) or not isinstance(value, int | float) or value <= 0:
        raise LaunchError(f"parameter '{key}' is {value!r}, not a number greater than 0")
    return float(value)


def _range(
    own: ParameterReader, key: str, default: tuple[float, float] | None = None
) -> tuple[float, float]:
    low, high = default or (None, None)
    return _positive(own, f"turbo.{key}_min", low), _positive(own, f"turbo.{key}_max", high)


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Relay until told to stop."""
    node = start_node(arguments, graph)
    with private_parameters(node, arguments, PARAMETERS) as own:
        steps, has_priority = Steps(own), own.flag("priority")
    relay = _Relay(node, steps, arguments.ros_version, has_priority=has_priority)
    arguments.ready()
    for _now_ns in ticks(node, _SECOND_NS, stop):
        relay.show()
    relay.close()
    node.shutdown()
    return 0


class _Relay:
    def __init__(
        self, node: Node, steps: Steps, ros_version: Literal[1, 2], *, has_priority: bool
    ) -> None:
        self._node, self._steps, self._ros_version = node, steps, ros_version
        self._servers: list[ActionServer] = []
        self._has_priority = has_priority
        if steps.refused:
            node.log("warn", f"Initial step {steps.refused} outside of the range! Falling back to "
                             f"default {steps.step}")  # fmt: skip
        self._twist: Any = message_type(_TWIST)
        self._bool: Any = message_type("std_msgs/msg/Bool")
        self._out = node.create_publisher("joy_vel_out", self._twist, queue_size=1)
        self._told = node.create_publisher("joy_priority", self._bool, latch=True, queue_size=1)
        self._marker = _marker()
        self._marker_out = node.create_publisher(
            "text_marker", type(self._marker), latch=True, queue_size=1
        )
        self._told.publish(self._bool(data=self._has_priority))
        self.show()
        node.create_subscription("joy_vel_in", self._twist, self._on_velocity, queue_size=1)
        self._offer("joy_priority_action", "JoyPriority", self._toggle)
        for name, act in (
            ("joy_turbo_increase", lambda: steps.move(1)),
            ("joy_turbo_decrease", lambda: steps.move(-1)),
            ("joy_turbo_angular_increase", lambda: steps.move(1, angular_only=True)),
            ("joy_turbo_angular_decrease", lambda: steps.move(-1, angular_only=True)),
            ("joy_turbo_reset", steps.reset),
        ):
            self._offer(name, "JoyTurbo", act)

    def show(self) -> None:
        """Tell who drives in RViz."""
        self._marker.text = "Manual" if self._has_priority else "Autonomous"
        self._marker_out.publish(self._marker)

    def close(self) -> None:
        """Take the actions off the graph."""
        for server in self._servers:
            server.close()

    def _offer(self, name: str, kind: str, act: Callable[[], None]) -> None:
        def on_goal(goal: ServerGoal) -> None:
            goal.accept()
            act()
            goal.succeed()

        self._servers.append(
            ActionServer(
                self._node,
                name,
                f"twist_mux_msgs/{kind}",
                on_goal=on_goal,
                ros_version=self._ros_version,
            )
        )

    def _toggle(self) -> None:
        self._has_priority = not self._has_priority
        self._node.log("info", f"Toggled joy_priority, current status is: {self._has_priority}")
        self._told.publish(self._bool(data=self._has_priority))
        self.show()
        if self._has_priority:
            self._out.publish(self._twist())

    def _on_velocity(self, given: Any) -> None:
        if self._has_priority:
            self._out.publish(self._scaled(given))
        self.show()

    def _scaled(self, given: Any) -> Any:
        twist = self._twist()
        shares = (given.linear.x, given.linear.y, given.angular.z)
        if given.linear.z or given.angular.x or given.angular.y:
            self._node.log("error", "Joystick provided invalid values, only linear.x, linear.y and "
                                    "angular.z may be non-zero.")  # fmt: skip
        elif not all(abs(share) <= 1 for share in shares):
            text = ", ".join(f"{share:g}" for share in shares)
            self._node.log(
                "error", f"Joystick provided invalid values ({text}), not in [-1, 1] range."
            )
        else:
            speed = self._steps.speed
            twist.linear.x = speed("forward" if shares[0] >= 0 else "backward", shares[0])
            twist.linear.y = speed("lateral", shares[1])
            twist.angular.z = speed("angular", shares[2])
        return twist


def _marker() -> Any:
    marker: Any = message_type("visualization_msgs/msg/Marker")()
    marker.type = _TEXT_VIEW_FACING
    marker.header.frame_id = "base_footprint"
    marker.pose.position.z, marker.pose.orientation.w = 2.0, 1.0
    marker.scale.z = 0.5
    marker.color.a = marker.color.r = marker.color.g = marker.color.b = 1.0
    return marker
