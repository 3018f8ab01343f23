"""``nav2_velocity_smoother velocity_smoother``: velocity commands within accelerations."""

from __future__ import annotations

import math
import threading
from typing import Any

from gazelle.diagnostics import Diagnostics
from gazelle.graph import Graph
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.nav2.lifecycle_server import ManagedServer, ServerSetup, run_server
from gazelle.nodes.nav2.parameters import VELOCITY_SMOOTHER
from gazelle.nodes.navigation.robot_pose import Odometry
from gazelle.nodes.parameters import ticks
from gazelle.nodes.twist_publisher import TwistPublisher
from gazelle.parameters.reader import ParameterReader

__all__ = ["limited", "run"]

Triple = tuple[float, float, float]
_STAND: Triple = (0.0, 0.0, 0.0)


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Smooth until told to stop."""
    return run_server(_Smoother, arguments, graph, stop)


def limited(
    now: Triple, wanted: Triple, up: Triple, down: Triple, period_s: float, *, keeps_shape: bool
) -> Triple:
    """Return the next velocity on the way from one to another.

    Args:
        now: velocity along x, y and around z.
        wanted: the same, commanded.
        up: accelerations, positive.
        down: decelerations, negative.
        period_s: time until the next one.
        keeps_shape: all axes change by the same share, so that the direction stays.
    """
    steps = []
    for v, w, a, d in zip(now, wanted, up, down, strict=True):
        slows = abs(w) < abs(v) or v * w < 0
        most = (abs(d) if slows else a) * period_s
        steps.append((w - v, most))
    share = 1.0
    if keeps_shape:
        shares = [most / abs(step) for step, most in steps if abs(step) > most]
        share = min(shares, default=1.0)
        moved = [v + share * step for v, (step, _) in zip(now, steps, strict=True)]
    else:
        moved = [
            v + math.copysign(min(abs(step), most), step)
            for v, (step, most) in zip(now, steps, strict=True)
        ]
    return moved[0], moved[1], moved[2]


class _Smoother(ManagedServer):
    def __init__(self, setup: ServerSetup) -> None:
        super().__init__(setup, VELOCITY_SMOOTHER)
        node = self._node
        self._stamped = self._settings.flag("enable_stamped_cmd_vel")
        self._out = TwistPublisher(node, is_stamped=self._stamped, topic="cmd_vel_smoothed")
        self._odometry = Odometry(node, self._settings.text("odom_topic"))
        self._wanted, self._now = _STAND, _STAND
        self._heard_ns: int | None = None
        kind = "geometry_msgs/msg/TwistStamped" if self._stamped else "geometry_msgs/msg/Twist"
        node.create_subscription("cmd_vel", kind, self._on_command, queue_size=1)

    def _configured(self, settings: ParameterReader, diagnostics: Diagnostics) -> bool:
        for key in ("max_velocity", "min_velocity", "max_accel", "max_decel", "deadband_velocity"):
            if len(settings.numbers(key)) != 3:
                text = f"'{key}' has {len(settings.numbers(key))} numbers; write x, y and turn"
                diagnostics.report("parameter.bad-value", text)
                return False
        settings.report_unknown()
        return True

    def _begun(self) -> None:
        work = threading.Thread(
            target=self._smooth, args=(self._ending,), name="smoother", daemon=True
        )
        work.start()

    def _on_command(self, message: Any) -> None:
        twist = message.twist if self._stamped else message
        wanted = (float(twist.linear.x), float(twist.linear.y), float(twist.angular.z))
        if not all(map(math.isfinite, wanted)):
            self._node.log("error", f"a command that is no number is left out: {wanted}")
            return
        self._wanted, self._heard_ns = wanted, self._node.clock.now_ns()

    def _smooth(self, ending: threading.Event) -> None:
        period_ns = int(1e9 / self._settings.number("smoothing_frequency"))
        for now_ns in ticks(self._node, period_ns, ending):
            if self._heard_ns is not None:
                self._round(now_ns, period_ns / 1e9)

    def _round(self, now_ns: int, period_s: float) -> None:
        numbers = self._settings.numbers
        silent = (now_ns - (self._heard_ns or 0)) / 1e9 > self._settings.number("velocity_timeout")
        wanted = _STAND if silent else self._wanted
        high, low = numbers("max_velocity"), numbers("min_velocity")
        bounded = [min(max(w, a), b) for w, a, b in zip(wanted, low, high, strict=True)]
        is_open = self._settings.text("feedback") != "CLOSED_LOOP"
        begin = self._now if is_open else self._odometry.velocity
        self._now = limited(
            begin, _triple(bounded), _triple(numbers("max_accel")), _triple(numbers("max_decel")),
            period_s, keeps_shape=self._settings.flag("scale_velocities"),
        )  # fmt: skip
        dead = numbers("deadband_velocity")
        sent = [0.0 if abs(v) < d else v for v, d in zip(self._now, dead, strict=True)]
        self._out.publish(sent[0], sent[1], sent[2])
        if silent and self._now == _STAND:
            self._heard_ns = None


def _triple(values: Any) -> Triple:
    x, y, turn = values
    return float(x), float(y), float(turn)
