"""gz-sim's ``JointTrajectoryController``: follows the points of a trajectory by PIDs."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from gazelle.description.model import JointType
from gazelle.diagnostics import did_you_mean
from gazelle.engine import JointHandle
from gazelle.interfaces import message_type
from gazelle.interfaces.stamps import ns_of
from gazelle.simulator.plugins.context import PluginContext, join_names
from gazelle.simulator.plugins.gazebo_pid import GazeboPid
from gazelle.simulator.plugins.gz_joints import TRAJECTORY_TABLE
from gazelle.simulator.plugins.plugin_parameters import PluginReader

__all__ = ["TRAJECTORY_TABLE", "load"]

_SINGLE_AXIS = frozenset({JointType.REVOLUTE, JointType.CONTINUOUS, JointType.PRISMATIC})
_GAINS = ("p_gain", "i_gain", "d_gain", "i_max", "i_min", "cmd_max", "cmd_min", "cmd_offset")


def load(context: PluginContext) -> None:
    """Start following trajectories."""
    parameters = context.reader(TRAJECTORY_TABLE)
    joints = _joints(context, parameters)
    if joints:
        _Controller(context, parameters, joints)
    else:
        text = f"plug-in '{context.plugin.name}' finds no joint with a single axis in "
        context.report("plugin.missing-joint", f"{text}{context.owner}; it is left out")
    parameters.report_unread()


@dataclass(slots=True)
class _Actuated:
    """A joint with its loops and what they aim at."""

    joint: JointHandle
    by_position: GazeboPid
    by_velocity: GazeboPid
    initial: float
    position: float = 0.0
    velocity: float = 0.0
    effort: float = 0.0

    def aim(self, point: Any, index: int) -> None:
        """Take the values of a point; what it does not give stays as it was."""
        if index < len(point.positions):
            self.position = float(point.positions[index])
        if index < len(point.velocities):
            self.velocity = float(point.velocities[index])
        if index < len(point.effort):
            self.effort = float(point.effort[index])

    def drive(self, step_s: float) -> None:
        """Apply the sum of both loops and the effort."""
        joint, near, fast = self.joint, self.by_position, self.by_velocity
        effort = near.update(joint.position - self.position, step_s)
        effort += fast.update(joint.velocity - self.velocity, step_s)
        joint.set_feedback(effort + self.effort, near.p, near.d + fast.p)

    def reset(self) -> None:
        """Aim at the start again."""
        self.position, self.velocity, self.effort = self.initial, 0.0, 0.0
        self.by_position.reset()
        self.by_velocity.reset()


@dataclass(slots=True)
class _Course:
    """A trajectory that is under way; without a start it begins with its first step."""

    names: list[str]
    points: list[Any]
    start_ns: int | None
    index: int = -1

    def advance(self, time_ns: int) -> bool:
        """Go on to the point that is next in time; tell whether it is another one."""
        before = self.index
        if self.start_ns is None:
            self.start_ns = time_ns
        self.index = max(self.index, 0)
        elapsed_ns = time_ns - self.start_ns
        while not self.is_at_end and ns_of(self.points[self.index].time_from_start) < elapsed_ns:
            self.index += 1
        return self.index != before

    @property
    def is_at_end(self) -> bool:
        return self.index + 1 >= len(self.points)


class _Controller:
    """One running plug-in."""

    def __init__(
        self, context: PluginContext, parameters: PluginReader, joints: list[JointHandle]
    ) -> None:
        self._context = context
        self._engine = context.host.engine
        self._step_s = self._engine.step_ns * 1e-9
        self._uses_stamp = parameters.flag("use_header_start_time")
        self._course: _Course | None = None
        by_position = _pids(parameters, "position", len(joints))
        by_velocity = _pids(parameters, "velocity", len(joints))
        initial = _each(parameters, "initial_position", len(joints))
        self._joints = {
            joint.joint.name: _Actuated(joint, near, fast, start, start)
            for joint, near, fast, start in zip(
                joints, by_position, by_velocity, initial, strict=True
            )
        }
        resources = context.resources
        default = f"/model/{context.model.name}/joint_trajectory"
        topic = join_names("/", parameters.text("topic", default))
        self._progress = resources.publisher(f"{topic}_progress", "std_msgs/Float32")
        resources.subscription(topic, "trajectory_msgs/JointTrajectory", self._take)
        resources.task(f"{context.plugin.name} {topic}", Fraction(1), self._update)
        resources.on_reset(self._reset)
        resources.on_close(self._release)

    def _take(self, message: Any) -> None:
        for name in message.joint_names:
            if name not in self._joints:
                text = f"plug-in '{self._context.plugin.name}' was sent a trajectory for joint "
                text += f"'{name}', which it does not drive; that joint is left out"
                fix = did_you_mean(name, tuple(self._joints))
                self._context.report("plugin.missing-joint", text, fix=fix)
        stamp_ns = ns_of(message.header.stamp)
        start_ns = stamp_ns if self._uses_stamp and stamp_ns else None
        points = list(message.points)
        names = list(message.joint_names)
        self._course = _Course(names, points, start_ns) if points and names else None

    def _update(self) -> None:
        course = self._course
        if course is not None and course.advance(self._engine.time_ns):
            self._aim(course)
        for one in self._joints.values():
            one.drive(self._step_s)

    def _aim(self, course: _Course) -> None:
        for index, name in enumerate(course.names):
            if name in self._joints:
                self._joints[name].aim(course.points[course.index], index)
        if course.is_at_end:
            self._course = None
        done = (course.index + 1) / len(course.points)
        self._progress.publish(message_type("std_msgs/Float32")(data=done))

    def _reset(self) -> None:
        self._course = None
        for one in self._joints.values():
            one.reset()

    def _release(self) -> None:
        for one in self._joints.values():
            one.joint.release()


def _joints(context: PluginContext, parameters: PluginReader) -> list[JointHandle]:
    """Return the joints it names, or all, that turn about or slide along a single axis."""
    wanted = parameters.texts("joint_name")
    if wanted:
        found = [context.joint_name(name) for name in dict.fromkeys(wanted)]
    else:
        found = [f"{context.model.name}::{joint.name}" for joint in context.model.joints]
    handles = [context.host.engine.joint(name) for name in found if name is not None]
    return [one for one in handles if one.type in _SINGLE_AXIS and one.is_driveable]


def _pids(parameters: PluginReader, kind: str, count: int) -> list[GazeboPid]:
    columns = [_each(parameters, f"{kind}_{gain}", count) for gain in _GAINS]
    return [GazeboPid(*row) for row in zip(*columns, strict=True)]


def _each(parameters: PluginReader, key: str, count: int) -> list[float]:
    """Return a number for each joint, in the order of the elements; the rest have the default."""
    given = parameters.numbers(key)[:count]
    return [*given, *[parameters.default_number(key)] * (count - len(given))]
