"""What move_base does when: planning, controlling, clearing, and the end of a goal.

The rules, their order and the words are those of ``move_base.cpp`` (ROS Noetic); threads, topics
and time are somebody else's. Times are nanoseconds of the node's clock. One rule is our own: a
robot that gets nowhere for ``controller_patience`` though the controller has commands is
oscillating, too. There ``oscillation_timeout`` 0 lets it swing or stand for ever.
"""

from __future__ import annotations

import enum
import math
import threading
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple, Protocol

__all__ = [
    "Drive",
    "End",
    "MoveBaseStateMachine",
    "Outcome",
    "Plan",
    "PlanPose",
    "State",
    "Timing",
    "Trigger",
]

_NANO = 1_000_000_000
# What counts as getting on: so far away, or so far round; not more than once around on the spot.
_WAY_M, _WAY_RAD = 0.1, 0.5


class PlanPose(NamedTuple):
    """A pose in the plane: metres and radians."""

    x_m: float
    y_m: float
    yaw_rad: float


Plan = Sequence[PlanPose]


class State(enum.Enum):
    """What the robot is about."""

    PLANNING = "planning"
    CONTROLLING = "controlling"
    CLEARING = "clearing"


class Trigger(enum.Enum):
    """Why recovery behaviours run; the value is the text at their end."""

    PLANNING = "Failed to find a valid plan. Even after executing recovery behaviors."
    CONTROLLING = "Failed to find a valid control. Even after executing recovery behaviors."
    OSCILLATION = "Robot is oscillating. Even after executing recovery behaviors."


class Outcome(enum.Enum):
    """How a goal ends by itself."""

    SUCCEEDED = "succeeded"
    ABORTED = "aborted"


class End(NamedTuple):
    """The end of a goal and what is said about it."""

    outcome: Outcome
    text: str


@dataclass(frozen=True, slots=True)
class Timing:
    """move_base's own parameters that decide when something is given up.

    Attributes:
        planner_frequency_hz: how often plans are made anew, 0 for only when need be.
        planner_patience_s, controller_patience_s: how long without success before clearing.
        max_planning_retries: how many failures before clearing, negative for no limit.
        oscillation_timeout_s: how long within `oscillation_distance_m` before clearing, 0 for ever.
        recovery_enabled: whether recovery behaviours run at all.
    """

    planner_frequency_hz: float = 0.0
    planner_patience_s: float = 5.0
    controller_patience_s: float = 15.0
    max_planning_retries: int = -1
    oscillation_timeout_s: float = 0.0
    oscillation_distance_m: float = 0.5
    recovery_enabled: bool = True


class Drive(Protocol):
    """What the executive has done."""

    def is_current(self) -> bool:
        """Tell whether the local costmap's sensors are up to date."""
        ...

    def set_plan(self, plan: Plan) -> bool:
        """Give the controller a plan; False when it does not take it."""
        ...

    def is_goal_reached(self) -> bool:
        """Ask the controller."""
        ...

    def control(self) -> str:
        """Send the next velocity; return why there is none, empty when it was sent."""
        ...

    def stop(self) -> None:
        """Send zero velocity."""
        ...

    def recover(self, index: int, trigger: Trigger) -> None:
        """Run a recovery behaviour to its end."""
        ...

    @property
    def recovery_count(self) -> int:
        """How many recovery behaviours there are."""
        ...

    def log(self, level: str, text: str) -> None:
        """Say something."""
        ...

    def now_ns(self) -> int:
        """Tell the time."""
        ...


class _Progress:
    """When a robot that has commands last got on."""

    def __init__(self, now_ns: int, pose: PlanPose) -> None:
        self.last_ns = now_ns
        self._pose = pose
        self._turned_rad = 0.0

    def look(self, now_ns: int, pose: PlanPose) -> None:
        """Take in where the robot is."""
        last = self._pose
        turned_rad = abs(math.remainder(pose.yaw_rad - last.yaw_rad, math.tau))
        if math.hypot(pose.x_m - last.x_m, pose.y_m - last.y_m) >= _WAY_M:
            self._turned_rad = 0.0
        elif turned_rad < _WAY_RAD or self._turned_rad + turned_rad > math.tau:
            return
        else:
            self._turned_rad += turned_rad
            # It has not left the place that it turns on.
            pose = pose._replace(x_m=last.x_m, y_m=last.y_m)
        self.last_ns, self._pose = now_ns, pose


class MoveBaseStateMachine:
    """One goal after another: what comes next.

    `cycle` is called by the control loop, `wants_plan` and `planned` by the planner's thread.

    Attributes:
        state: what the robot is about.
        trigger: why it cleared last, None before the first time.
        why: why planner or controller failed last, empty after success.
    """

    def __init__(self, drive: Drive, timing: Timing) -> None:
        """Begin without a goal."""
        self.timing = timing
        self.state = State.PLANNING
        self.trigger: Trigger | None = None
        self.why = ""
        self._drive = drive
        self._lock = threading.RLock()
        self._runs_planner = False
        self._new_plan: Plan | None = None
        self._recovery_index = 0
        self._retries = 0
        self._last_plan_ns = self._last_control_ns = self._last_reset_ns = 0
        self._rest_pose: PlanPose | None = None
        self._way: _Progress | None = None

    @property
    def wants_plan(self) -> bool:
        """True while the planner is to run."""
        return self._runs_planner

    def begin(self) -> None:
        """Take a new goal; clearing starts at the first behaviour again."""
        now_ns = self._drive.now_ns()
        with self._lock:
            self.state, self.why = State.PLANNING, ""
            self._recovery_index = self._retries = 0
            self.trigger, self._new_plan, self._rest_pose = None, None, None
            self._runs_planner = True
            self._last_plan_ns = self._last_control_ns = self._last_reset_ns = now_ns
            self._way = None

    def end(self) -> None:
        """Be without a goal: the planner rests and the robot stands."""
        with self._lock:
            self.state, self._runs_planner, self._new_plan = State.PLANNING, False, None
        self._drive.stop()

    def planned(self, plan: Plan | None, why: str = "") -> None:
        """Take what the planner found: a plan, or why there is none."""
        now_ns = self._drive.now_ns()
        with self._lock:
            if not self._runs_planner:
                return
            if plan:
                self._new_plan, self._last_plan_ns, self._retries = plan, now_ns, 0
                self.state = State.CONTROLLING
                if self.timing.planner_frequency_hz <= 0:
                    self._runs_planner = False
                return
            self.why = why
            if self.state is State.PLANNING:
                self._plan_failed(now_ns)

    def _plan_failed(self, now_ns: int) -> None:
        self._retries += 1
        patience_ns = int(self.timing.planner_patience_s * _NANO)
        most = self.timing.max_planning_retries
        late = now_ns > self._last_plan_ns + patience_ns
        if late or 0 <= most < self._retries:
            self._runs_planner = False
            self._clear(Trigger.PLANNING)

    def cycle(self, pose: PlanPose | None) -> End | None:
        """Do one round of the control loop; returns the goal's end when this is it.

        Args:
            pose: where the robot is in the global costmap's frame, None while that is not known.
        """
        now_ns = self._drive.now_ns()
        if pose is not None:
            self._watch_oscillation(now_ns, pose)
        if not self._drive.is_current():
            self._drive.log(
                "warn",
                "Sensor data is out of date, we're not going to allow commanding of the base for"
                " safety",
            )
            self._drive.stop()
            self._way = None
            return None
        with self._lock:
            plan, self._new_plan = self._new_plan, None
        if plan is not None:
            if not self._drive.set_plan(plan):
                return self._abort("Failed to pass global plan to the controller.")
            if self.trigger is Trigger.PLANNING:
                self._recovery_index = 0
        if self.state is State.PLANNING:
            self._runs_planner = True
            return None
        return self._control(now_ns, pose) if self.state is State.CONTROLLING else self._recover()

    def _watch_oscillation(self, now_ns: int, pose: PlanPose) -> None:
        rest = self._rest_pose
        moved = math.inf if rest is None else math.hypot(pose.x_m - rest.x_m, pose.y_m - rest.y_m)
        if moved >= self.timing.oscillation_distance_m:
            self._last_reset_ns, self._rest_pose = now_ns, pose
            if self.trigger is Trigger.OSCILLATION and rest is not None:
                self._recovery_index = 0

    def _control(self, now_ns: int, pose: PlanPose | None) -> End | None:
        if self._drive.is_goal_reached():
            self.end()
            return End(Outcome.SUCCEEDED, "Goal reached.")
        timeout_ns = int(self.timing.oscillation_timeout_s * _NANO)
        if timeout_ns > 0 and self._last_reset_ns + timeout_ns < now_ns:
            self._clear(Trigger.OSCILLATION)
            return None
        why = self._drive.control()
        if not why:
            self._last_control_ns, self.why = now_ns, ""
            if self.trigger is Trigger.CONTROLLING:
                self._recovery_index = 0
            if pose is not None:
                self._watch_way(now_ns, pose)
            return None
        self.why = why
        if now_ns > self._last_control_ns + int(self.timing.controller_patience_s * _NANO):
            self._clear(Trigger.CONTROLLING)
            return None
        with self._lock:
            self._last_plan_ns, self._retries = now_ns, 0
            self.state, self._runs_planner = State.PLANNING, True
        self._drive.stop()
        return None

    def _watch_way(self, now_ns: int, pose: PlanPose) -> None:
        if self._way is None:
            self._way = _Progress(now_ns, pose)
        self._way.look(now_ns, pose)
        patience_s = self.timing.controller_patience_s
        if now_ns > self._way.last_ns + int(patience_s * _NANO):
            text = f"got nowhere for {patience_s:g} s, though the controller has commands"
            self.why = f"the robot {text}"
            self._drive.log("warn", f"The robot {text}: clearing what may be in its way")
            self._clear(Trigger.OSCILLATION)

    def _clear(self, trigger: Trigger) -> None:
        with self._lock:
            self.state, self.trigger = State.CLEARING, trigger
        self._drive.stop()

    def _recover(self) -> End | None:
        assert self.trigger is not None
        if self.timing.recovery_enabled and self._recovery_index < self._drive.recovery_count:
            self._drive.recover(self._recovery_index, self.trigger)
            # Behaviours take seconds.
            now_ns = self._drive.now_ns()
            with self._lock:
                self._last_reset_ns = self._last_plan_ns = now_ns
                self._way = None
                self._retries, self.state = 0, State.PLANNING
                self._recovery_index += 1
            return None
        self._drive.log(
            "debug", "All recovery behaviors have failed, locking the planner and disabling it."
        )
        why = f" Last reason: {self.why}" if self.why else ""
        return self._abort(self.trigger.value + why)

    def _abort(self, text: str) -> End:
        self.end()
        return End(Outcome.ABORTED, text)
