"""Does a robot go where velocity commands tell it?"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from gazelle.description.model import Model
from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.doctor.probes.robot_motion import base_pose, motion_between
from gazelle.doctor.report import Section
from gazelle.interfaces import message_type
from gazelle.simulator.simulation import Simulation

__all__ = ["probe_drive", "twist_topics"]

_AHEAD_M_S = 0.2
_TURN_RAD_S = 0.5
_SPEED_UP_S = 1.0
_WATCH_S = 1.0
_PERIOD_S = 0.05
_SHARE = 0.1
_TOLERANCE = 0.25
_STRAY_RAD_S = 0.1
_COLUMNS = ("robot", "topic", "told", "drives", "verdict")


class _Drive(NamedTuple):
    """Speeds of a robot under a command, in its own frame."""

    ahead_m_s: float
    yaw_rad_s: float


class _Test(NamedTuple):
    """What a robot did when it was told to go straight on, and when it was told to turn left."""

    straight: _Drive
    turning: _Drive


def twist_topics(heard: Mapping[str, str]) -> dict[str, str]:
    """Return the topics that take velocity commands, with the full names of their types.

    Args:
        heard: types of the topics listened to, by name.
    """
    kinds = {"Twist": "geometry_msgs/msg/Twist", "TwistStamped": "geometry_msgs/msg/TwistStamped"}
    found = {topic: kinds.get(kind.rpartition("/")[2], "") for topic, kind in heard.items()}
    return {topic: kind for topic, kind in found.items() if kind}


def probe_drive(
    simulation: Simulation,
    robots: Sequence[Model],
    topics: Mapping[str, str],
    diagnostics: Diagnostics,
) -> Section:
    """Tell each base to go straight on and to turn left, and see what it does."""
    rows = []
    for topic, kind in sorted(topics.items()):
        before = {robot.name: base_pose(simulation, robot) for robot in robots}
        straight = _driven(simulation, robots, topic, kind, _AHEAD_M_S, 0.0)
        turning = _driven(simulation, robots, topic, kind, _AHEAD_M_S, _TURN_RAD_S)
        _driven(simulation, robots, topic, kind, 0.0, 0.0)
        moved = {
            robot.name: motion_between(before[robot.name], base_pose(simulation, robot)).moved_m
            for robot in robots
        }
        robot = max(robots, key=lambda one: moved[one.name])
        test = _Test(straight[robot.name], turning[robot.name])
        verdict = _judge(robot, topic, test, diagnostics)
        told = f"{_AHEAD_M_S:g} m/s, {_TURN_RAD_S:g} rad/s"
        shown = f"{test.straight.ahead_m_s:.3g} m/s, {test.turning.yaw_rad_s:.3g} rad/s"
        rows.append((robot.name, topic, told, shown, verdict))
    return Section("probe_drive", "velocity commands", _COLUMNS, tuple(rows))


def _driven(
    simulation: Simulation,
    robots: Sequence[Model],
    topic: str,
    kind: str,
    ahead_m_s: float,
    turn_rad_s: float,
) -> dict[str, _Drive]:
    """Command speeds, give 1 s to speed up, and return the mean speeds of the second after."""
    _hold(simulation, topic, kind, (ahead_m_s, turn_rad_s), _SPEED_UP_S)
    before = {robot.name: base_pose(simulation, robot) for robot in robots}
    way = dict.fromkeys(before, 0.0)
    turned = dict.fromkeys(before, 0.0)
    for _ in range(round(_WATCH_S / _PERIOD_S)):
        _hold(simulation, topic, kind, (ahead_m_s, turn_rad_s), _PERIOD_S)
        for robot in robots:
            after = base_pose(simulation, robot)
            step = motion_between(before[robot.name], after)
            way[robot.name] += step.ahead_m
            turned[robot.name] += step.yaw_rad
            before[robot.name] = after
    return {name: _Drive(way[name] / _WATCH_S, turned[name] / _WATCH_S) for name in way}


def _hold(
    simulation: Simulation, topic: str, kind: str, speeds: tuple[float, float], seconds: float
) -> None:
    for _ in range(max(1, round(seconds / _PERIOD_S))):
        simulation.publish(topic, _command(simulation, kind, speeds))
        simulation.run(seconds=_PERIOD_S)


def _command(simulation: Simulation, kind: str, speeds: tuple[float, float]) -> Any:
    message = message_type(kind)()
    twist = message
    if kind.endswith("TwistStamped"):
        twist = message.twist
        message.header.stamp.sec, message.header.stamp.nanosec = divmod(
            simulation.time_ns, 1_000_000_000
        )
    twist.linear.x, twist.angular.z = speeds
    return message


def _judge(robot: Model, topic: str, test: _Test, diagnostics: Diagnostics) -> str:
    span = _plugin_span(robot)
    ahead_m_s, turn_rad_s = test.straight.ahead_m_s, test.turning.yaw_rad_s
    ahead, turn = ahead_m_s / _AHEAD_M_S, turn_rad_s / _TURN_RAD_S
    who = f"robot '{robot.name}', told on {topic}"
    if abs(ahead) < _SHARE and abs(turn) < _SHARE:
        text = (
            f"{who} to drive {_AHEAD_M_S:g} m/s and to turn {_TURN_RAD_S:g} rad/s, does not move: "
            f"{ahead_m_s:.2g} m/s, {turn_rad_s:.2g} rad/s"
        )
        diagnostics.report("probe.does-not-drive", text, span)
        return "does not move"
    if abs(test.straight.yaw_rad_s) > _STRAY_RAD_S:
        text = (
            f"{who} to drive straight on with {_AHEAD_M_S:g} m/s, turns with "
            f"{test.straight.yaw_rad_s:.3g} rad/s and drives {ahead_m_s:.3g} m/s"
        )
        fix = "let the axes of both wheels point to the left, and both wheels touch the ground"
        diagnostics.report("probe.drives-wrong", text, span, fix=fix)
        return "does not drive straight"
    verdict = []
    if turn < -_SHARE:
        text = f"{who} to turn left with {_TURN_RAD_S:g} rad/s, turns right: {turn_rad_s:.3g} rad/s"
        diagnostics.report("probe.turns-wrong", text, span)
        verdict.append("turns the wrong way")
    if ahead < -_SHARE:
        text = f"{who} to drive ahead with {_AHEAD_M_S:g} m/s, drives back: {ahead_m_s:.3g} m/s"
        diagnostics.report("probe.drives-wrong", text, span)
        verdict.append("drives backwards")
    elif abs(ahead - 1.0) > _TOLERANCE:
        text = (
            f"{who} to drive {_AHEAD_M_S:g} m/s, drives {ahead_m_s:.3g} m/s: odometry from the "
            "wheels will be wrong by that, too"
        )
        diagnostics.report("probe.speed-differs", text, span)
        verdict.append(f"{ahead:.2f} times as fast")
    return ", ".join(verdict) or "good"


def _plugin_span(robot: Model) -> SourceSpan | None:
    """Return the place of the drive's plug-in."""
    for plugin in robot.plugins:
        if any(word in plugin.filename.lower() for word in ("drive", "planar", "control")):
            return plugin.span
    return robot.span
