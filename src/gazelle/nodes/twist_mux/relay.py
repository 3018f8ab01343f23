"""``twist_mux joystick_relay.py``: velocities in shares of 1 to m/s and rad/s, in steps.

``joy_vel_in`` to ``joy_vel_out`` while the joystick has priority, which ``joy_priority`` tells and
the action ``joy_priority_action`` toggles; ``joy_turbo_increase``, ``joy_turbo_decrease``, the two
``joy_turbo_angular_…`` and ``joy_turbo_reset`` go up and down the steps.

| name | default | meaning |
| --- | --- | --- |
| ~priority | true | as it begins |
| ~turbo/steps | 1 | how many steps |
| ~turbo/init_step | the middle one | as it begins |
| ~turbo/linear_forward_min, _max | 1 | m/s at the first and the last step |
| ~turbo/linear_backward_min, _max | those forward | |
| ~turbo/linear_lateral_min, _max | 1 | |
| ~turbo/angular_min, _max | 1 | rad/s |
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping
from typing import Any, Literal

from gazelle.errors import LaunchError
from gazelle.graph import Graph, Node
from gazelle.graph.actions import ActionServer, ServerGoal
from gazelle.interfaces import message_type
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.parameters import parameter_tree, start_node, ticks

__all__ = ["Steps", "run"]

_SECOND_NS = 1_000_000_000
_TEXT_VIEW_FACING = 9
_TWIST = "geometry_msgs/msg/Twist"


class Steps:
    """How fast full deflection is.

    Args:
        turbo: the group of parameters of this name.

    Attributes:
        step, angular_step: 1 to the number of steps.

    Raises:
        LaunchError: a speed or the number of steps is not greater than 0.
    """

    def __init__(self, turbo: Mapping[str, Any]) -> None:
        """Begin at ``init_step``."""
        self._count = int(_positive(turbo, "steps", 1))
        forward = _range(turbo, "linear_forward", (1.0, 1.0))
        self._ranges = {
            "forward": forward,
            "backward": _range(turbo, "linear_backward", forward),
            "lateral": _range(turbo, "linear_lateral", (1.0, 1.0)),
            "angular": _range(turbo, "angular", (1.0, 1.0)),
        }
        middle = (self._count + 1) // 2
        wanted = int(turbo.get("init_step", middle))
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


def _positive(turbo: Mapping[str, Any], key: str, default: float) -> float:
    value = turbo.get(key, default)
    if isinstance(value, bool) or not isinstance(value, int | float) or value <= 0:
        raise LaunchError(f"parameter 'turbo/{key}' is {value!r}, not a number greater than 0")
    return float(value)


def _range(turbo: Mapping[str, Any], key: str, default: tuple[float, float]) -> tuple[float, float]:
    low, high = default
    return _positive(turbo, f"{key}_min", low), _positive(turbo, f"{key}_max", high)


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Relay until told to stop."""
    node = start_node(arguments, graph)
    tree = parameter_tree(node, arguments)
    turbo = tree.get("turbo")
    steps = Steps(turbo if isinstance(turbo, dict) else {})
    relay = _Relay(node, steps, tree.get("priority"), arguments.generation)
    arguments.ready()
    for _now_ns in ticks(node, _SECOND_NS, stop):
        relay.show()
    relay.close()
    node.shutdown()
    return 0


class _Relay:
    def __init__(self, node: Node, steps: Steps, priority: Any, generation: Literal[1, 2]) -> None:
        self._node, self._steps, self._generation = node, steps, generation
        self._servers: list[ActionServer] = []
        self._has_priority = priority is None or str(priority).lower() == "true"
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
                generation=self._generation,
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
