"""``nav2_controller controller_server``: drives along paths, checks goals and progress."""

from __future__ import annotations

import math
import threading
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from gazelle.diagnostics import Diagnostics, did_you_mean
from gazelle.graph import Graph
from gazelle.graph.actions import ServerGoal
from gazelle.interfaces import action_type, message_type
from gazelle.interfaces.poses import unit_pose_of
from gazelle.mapping.se2 import compose
from gazelle.navigation.controllers import (
    CONTROLLERS,
    REFUSED_CONTROLLERS,
    Command,
    Controller,
    ControllerSetting,
    RobotState,
)
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.nav2.lifecycle_server import ManagedServer, ServedAction, ServerSetup, run_server
from gazelle.nodes.nav2.parameters import (
    CONTROLLER_SERVER,
    GOAL_CHECKERS,
    PROGRESS_CHECKERS,
    controller_table,
)
from gazelle.nodes.navigation.robot_pose import Odometry, PlanePose, path_message
from gazelle.nodes.navigation.simple_action_server import SimpleActionServer
from gazelle.nodes.parameters import ticks
from gazelle.nodes.twist_publisher import TwistPublisher
from gazelle.parameters import ParameterTable
from gazelle.parameters.reader import ParameterReader

__all__ = ["GoalChecker", "ProgressChecker", "goal_checker", "progress_checker", "run"]


_NANO = 1e9

_DEFAULTS = {
    "controller": "dwb_core::DWBLocalPlanner",
    "goal checker": "nav2_controller::SimpleGoalChecker",
    "progress checker": "nav2_controller::SimpleProgressChecker",
}


@dataclass(slots=True)
class GoalChecker:
    """In place and direction, and standing where that is asked for.

    Attributes:
        xy_m, yaw_rad: tolerances.
        stateful: once in place only the direction counts.
        stopped: fastest that counts as standing, m/s and rad/s.
    """

    xy_m: float
    yaw_rad: float
    stateful: bool
    stopped: tuple[float, float]
    _in_place: bool = False

    def reset(self) -> None:
        """Begin with a new goal."""
        self._in_place = False

    def is_reached(
        self, pose: PlanePose, goal: PlanePose, velocity: tuple[float, float, float]
    ) -> bool:
        """Tell whether the goal is reached."""
        away = math.hypot(pose[0] - goal[0], pose[1] - goal[1])
        if not (self.stateful and self._in_place):
            if away > self.xy_m:
                return False
            self._in_place = True
        if abs(math.remainder(pose[2] - goal[2], math.tau)) > self.yaw_rad:
            return False
        speed = math.hypot(velocity[0], velocity[1])
        return speed <= self.stopped[0] and abs(velocity[2]) <= self.stopped[1]


@dataclass(slots=True)
class ProgressChecker:
    """Whether the robot gets away from where it was.

    Attributes:
        radius_m, angle_rad: how far it has to get, or to turn; infinite for not by turning.
        allowance_s: within this time.
    """

    radius_m: float
    angle_rad: float
    allowance_s: float
    now_ns: Callable[[], int]
    _base: PlanePose | None = None
    _since_ns: int = 0

    def reset(self) -> None:
        """Begin to count."""
        self._base = None

    def gets_on(self, pose: PlanePose) -> bool:
        """Tell whether it does."""
        now_ns = self.now_ns()
        base = self._base
        moved = math.inf if base is None else math.hypot(pose[0] - base[0], pose[1] - base[1])
        turned = 0.0 if base is None else abs(math.remainder(pose[2] - base[2], math.tau))
        if moved > self.radius_m or turned > self.angle_rad or now_ns < self._since_ns:
            self._base, self._since_ns = pose, now_ns
            return True
        return (now_ns - self._since_ns) / _NANO <= self.allowance_s


class _EndError(Exception):
    """Driving cannot go on; the arguments are the word of the error code and the reason."""


class _ControllerServer(ManagedServer):
    def __init__(self, setup: ServerSetup) -> None:
        super().__init__(setup, CONTROLLER_SERVER, "local_costmap")
        node = self._node
        self._controllers: dict[str, Controller] = {}
        self._goal_checkers: dict[str, GoalChecker] = {}
        self._progress_checkers: dict[str, ProgressChecker] = {}
        stamped = self._settings.flag("enable_stamped_cmd_vel")
        self._out = TwistPublisher(node, is_stamped=stamped)
        self._odometry = Odometry(node, self._settings.text("odom_topic"))
        path = message_type("nav_msgs/msg/Path")
        self._local_out = node.create_publisher("local_plan", path, queue_size=1)
        self._received_out = node.create_publisher("received_global_plan", path, queue_size=1)
        topic = self._settings.text("speed_limit_topic")
        node.create_subscription(topic, "nav2_msgs/msg/SpeedLimit", self._on_speed_limit)

    def _configured(self, settings: ParameterReader, diagnostics: Diagnostics) -> bool:
        old_progress = settings.text("progress_checker_plugin").split()
        old_goal = settings.text("goal_checker_plugin").split()
        progress = old_progress or list(settings.texts("progress_checker_plugins"))
        goals = old_goal or list(settings.texts("goal_checker_plugins"))
        clock = self._node.clock
        self._goal_checkers = {
            name: goal_checker(below)
            for name, below in self._plugins("goal checker", goals, GOAL_CHECKERS)
        }
        self._progress_checkers = {
            name: progress_checker(below, clock.now_ns)
            for name, below in self._plugins("progress checker", progress, PROGRESS_CHECKERS)
        }
        tables = {
            name: controller_table(name) for name in CONTROLLERS if "::" in name or "/" in name
        }
        names = list(settings.texts("controller_plugins"))
        self._controllers = {
            name: self._controller(below)
            for name, below in self._plugins("controller", names, tables)
        }
        settings.report_unknown(*goals, *progress, *names)
        return all((self._controllers, self._goal_checkers, self._progress_checkers))

    def _served(self) -> Iterable[ServedAction]:
        return (ServedAction("follow_path", "FollowPath", self._answer),)

    def _left(self) -> None:
        self._out.stop()

    def _plugins(
        self, what: str, names: list[str], tables: Mapping[str, ParameterTable]
    ) -> list[tuple[str, ParameterReader]]:
        """Return settings of plug-ins by name; types that are not known are reported."""
        found = []
        for name in names:
            below = self._tree.get(name)
            tree = dict(below) if isinstance(below, Mapping) else {}
            plugin = str(tree.pop("plugin", _DEFAULTS[what]))
            table = tables.get(plugin)
            if table is None:
                why = REFUSED_CONTROLLERS.get(plugin) or did_you_mean(plugin, tables)
                known = ", ".join(sorted(one for one in tables if "::" in one))
                text = f"{what} '{name}' is of type '{plugin}', which is not known; there are "
                self._settings.report("navigation.unknown-plugin", text + known, why)
                continue
            settings = self._settings.with_table(table, tree, name)
            settings.report_unknown()
            found.append((name, settings))
        return found

    def _controller(self, settings: ParameterReader) -> Controller:
        kind = CONTROLLERS[settings.table.types[0]]
        critics = {key: value for key, value in settings.tree.items() if isinstance(value, dict)}
        # Scores of critics stand beside the controller's own parameters, by the critic's name.
        checker = next(iter(self._goal_checkers.values()), None)
        tolerance = (0.25, 0.25) if checker is None else (checker.xy_m, checker.yaw_rad)
        period_s = 1.0 / self._settings.number("controller_frequency")
        setting = ControllerSetting(period_s, critics, tolerance)
        return kind.make(settings.fill(kind.options), setting)

    def _answer(self, action: SimpleActionServer, goal: ServerGoal) -> None:
        try:
            self._follow(action, goal, self._ending)
        except _EndError as end:
            word, reason = end.args
            self._node.log("error", reason)
            result = action.result_class()
            codes = action_type("nav2_msgs/FollowPath").Result
            result.error_code, result.error_msg = int(getattr(codes, word, 0)), reason
            self._out.stop()
            action.abort(result, reason)

    def _follow(
        self, action: SimpleActionServer, goal: ServerGoal, ending: threading.Event
    ) -> None:
        """Follow paths until one is at its end; a newer one takes the place of an older."""
        drive = self._begin(goal)
        last_ns = self._node.clock.now_ns()
        period_ns = int(1e9 / self._settings.number("controller_frequency"))
        for now_ns in ticks(self._node, period_ns, ending):
            if action.is_cancelled:
                drive.controller.reset()
                self._out.stop()
                action.cancel()
                return
            if action.has_new and (newer := action.take()) is not None:
                drive = self._begin(newer, before=drive)
            pose = self._pose()
            if not drive.progress.gets_on(pose):
                raise _EndError("FAILED_TO_MAKE_PROGRESS", "Failed to make progress")
            velocity = self._odometry.velocity
            if drive.goals.is_reached(pose, drive.target(), velocity):
                if self._settings.flag("publish_zero_velocity"):
                    self._out.stop()
                drive.controller.reset()
                action.succeed()
                return
            last_ns = self._command(drive, pose, now_ns, last_ns)
            action.feedback(drive.feedback(pose, velocity))
        raise _EndError("UNKNOWN", "the controller server was deactivated")

    def _begin(self, goal: ServerGoal, before: _Drive | None = None) -> _Drive:
        """Return what drives along the path of a goal."""
        request = goal.request
        controller = _chosen(request.controller_id, self._controllers, "controller")
        goals = _chosen(request.goal_checker_id, self._goal_checkers, "goal checker")
        wanted = getattr(request, "progress_checker_id", "")
        progress = _chosen(wanted, self._progress_checkers, "progress checker")
        if not request.path.poses:
            raise _EndError("INVALID_PATH", "Invalid path, Path is empty.")
        frame = str(request.path.header.frame_id or request.path.poses[0].header.frame_id)
        poses = np.array([unit_pose_of(one.pose).xy_yaw for one in request.path.poses])
        drive = _Drive(poses, frame.removeprefix("/"), controller, goals, progress)
        if before is None or before.controller is not controller:
            controller.reset()
        if before is None:
            progress.reset()
            goals.reset()
        if self._received_out.matched:
            self._received_out.publish(request.path)
        self._place(drive)
        return drive

    def _place(self, drive: _Drive) -> None:
        """Give the path to the controller where its frame has moved."""
        assert self._costmap is not None
        live = self._costmap.live
        found = live.frames.between(live.global_frame, drive.frame)
        if isinstance(found, str):
            raise _EndError("TF_ERROR", f"the path's frame {drive.frame} is not known: {found}")
        drive.place(found.xy_yaw)

    def _pose(self) -> PlanePose:
        assert self._costmap is not None
        pose = self._costmap.live.pose()
        if pose is None:
            raise _EndError("TF_ERROR", "Failed to obtain robot pose")
        return pose

    def _command(self, drive: _Drive, pose: PlanePose, now_ns: int, last_ns: int) -> int:
        """Send the next velocity; returns when there was one last."""
        assert self._costmap is not None
        live = self._costmap.live
        stale = live.stale()
        if stale:
            self._out.stop()
            live.frames.say("warn", f"Costmap timed out waiting for update: {'; '.join(stale)}")
            return last_ns
        self._place(drive)
        with live.lock:
            state = RobotState(pose, self._odometry.velocity)
            found = drive.controller.compute(state, live.grid, live.footprint)
        if isinstance(found, Command):
            if found.note:
                live.frames.say("warn", found.note, key="maneuver")
            x, y, turn = found.velocity
            self._out.publish(x, y, turn, live.base_frame)
            if self._local_out.matched:
                message = path_message(found.trajectory, live.global_frame, now_ns)
                self._local_out.publish(message)
            return now_ns
        self._out.stop()
        tolerance_s = self._settings.number("failure_tolerance")
        if tolerance_s == 0:
            raise _EndError("NO_VALID_CONTROL", found.reason)
        if tolerance_s > 0 and now_ns - last_ns > tolerance_s * 1e9:
            raise _EndError("PATIENCE_EXCEEDED", f"Controller patience exceeded: {found.reason}")
        live.frames.say("warn", found.reason, key="no velocity")
        return last_ns

    def _on_speed_limit(self, message: Any) -> None:
        limit = float(message.speed_limit)
        if message.percentage:
            self._node.log("warn", "speed limits in per cent are not there; send m/s")
            return
        for controller in self._controllers.values():
            controller.limit_speed(limit if limit > 0 else None)


class _Drive:
    """A path that is followed, and with what.

    Attributes:
        frame: of the path.
    """

    def __init__(
        self,
        poses: Any,
        frame: str,
        controller: Controller,
        goals: GoalChecker,
        progress: ProgressChecker,
    ) -> None:
        self.frame = frame
        self.controller, self.goals, self.progress = controller, goals, progress
        self._poses = poses
        self._placed: PlanePose | None = None
        self._local = poses

    def place(self, T_local_path: PlanePose) -> None:
        """Take the path's frame in that of the local costmap."""
        if self._placed == T_local_path:
            return
        has_moved = self._placed is not None
        self._placed = T_local_path
        self._local = compose(T_local_path, self._poses)
        self.controller.set_plan(self._local, has_moved=has_moved)

    def target(self) -> PlanePose:
        """Return the path's end in the local costmap's frame."""
        x, y, yaw = map(float, self._local[-1])
        return x, y, yaw

    def feedback(self, pose: PlanePose, velocity: tuple[float, float, float]) -> Any:
        """Return how far it is, and how fast the robot is."""
        away = np.hypot(*(self._local[:, :2] - pose[:2]).T)
        nearest = int(away.argmin())
        steps = np.hypot(*np.diff(self._local[nearest:, :2], axis=0).T)
        made: Any = action_type("nav2_msgs/FollowPath").Feedback()
        made.distance_to_goal = float(steps.sum() + away[nearest])
        made.speed = math.hypot(velocity[0], velocity[1])
        return made


def goal_checker(settings: ParameterReader) -> GoalChecker:
    """Make a goal checker of its settings."""
    known = {row.key for row in settings.table.rows}
    stopped = (math.inf, math.inf)
    if "trans_stopped_velocity" in known:
        stopped = (
            settings.number("trans_stopped_velocity"), settings.number("rot_stopped_velocity"),
        )  # fmt: skip
    number = settings.number
    return GoalChecker(
        number("xy_goal_tolerance"), number("yaw_goal_tolerance"), settings.flag("stateful"),
        stopped,
    )  # fmt: skip


def progress_checker(settings: ParameterReader, now_ns: Callable[[], int]) -> ProgressChecker:
    """Make a progress checker of its settings."""
    known = {row.key for row in settings.table.rows}
    turns = "required_movement_angle" in known
    return ProgressChecker(
        settings.number("required_movement_radius"),
        settings.number("required_movement_angle") if turns else math.inf,
        settings.number("movement_time_allowance"),
        now_ns,
    )


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Drive until told to stop."""
    return run_server(_ControllerServer, arguments, graph, stop)


def _chosen(name: str, known: Mapping[str, Any], what: str) -> Any:
    """Return what a goal names; without a name the only one there is."""
    if not name and len(known) == 1:
        return next(iter(known.values()))
    if name in known:
        return known[name]
    text = f"FollowPath called with {what} name '{name}', which does not exist. Available {what}s"
    hint = did_you_mean(name, known)
    raise _EndError("INVALID_CONTROLLER", f"{text} are: {', '.join(known)}. {hint}")
