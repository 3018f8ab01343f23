"""``move_base``: drives to goals, as ROS 1's node of this name."""

from __future__ import annotations

import math
import threading
from collections.abc import Iterator, Mapping
from typing import Any

from gazelle.diagnostics import Diagnostics
from gazelle.graph import Graph, Node, ServiceRefusedError
from gazelle.interfaces import message_type, service_type
from gazelle.interfaces.poses import set_plane_pose, unit_pose_of
from gazelle.interfaces.stamps import set_header
from gazelle.navigation.planners import NoPlan
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.move_base.controller_loop import Driver
from gazelle.nodes.move_base.global_planner import GlobalPlanner
from gazelle.nodes.move_base.local_planner import LocalPlanner
from gazelle.nodes.move_base.parameters import MOVE_BASE
from gazelle.nodes.move_base.recovery_behaviors import make_behaviours
from gazelle.nodes.move_base.state_machine import (
    MoveBaseStateMachine,
    Outcome,
    PlanPose,
    State,
    Timing,
)
from gazelle.nodes.navigation.costmap_2d_ros import Costmap2DRos
from gazelle.nodes.navigation.costmap_from_parameters import INHERITED, assemble
from gazelle.nodes.navigation.costmap_publisher import CostmapPublisher
from gazelle.nodes.navigation.robot_pose import Frames, PlanePose
from gazelle.nodes.navigation.simple_action_server import SimpleActionServer
from gazelle.nodes.parameters import (
    log_findings,
    node_reader,
    offer_dynamic_reconfigure,
    parameter_tree,
    start_node,
    ticks,
)
from gazelle.parameters.reader import ParameterReader

__all__ = ["MoveBase", "MoveBaseServices", "run"]


_NANO = 1_000_000_000
_PLANNER_REST_S = 0.05
_COSTMAPS = ("global_costmap", "local_costmap")


class MoveBaseServices:
    """``make_plan`` and ``clear_costmaps``."""

    def __init__(
        self,
        node: Node,
        planner: GlobalPlanner,
        costmaps: Mapping[str, Costmap2DRos],
        goals: SimpleActionServer,
        settings: ParameterReader,
    ) -> None:
        """Offer them below the node's name."""
        self._planner = planner
        self._costmaps = costmaps
        self._goals = goals
        self._settings = settings
        self._empty = service_type("std_srvs/Empty")
        node.create_service("~/make_plan", service_type("nav_msgs/GetPlan"), self._on_make_plan)
        node.create_service("~/clear_costmaps", self._empty, self._on_clear)

    def _on_make_plan(self, request: Any) -> Any:
        if self._goals.current is not None:
            raise ServiceRefusedError(
                "move_base must be in an inactive state to make a plan for an external user"
            )
        global_costmap = self._costmaps["global_costmap"]
        if not global_costmap.is_ready:
            raise ServiceRefusedError(
                "move_base cannot make a plan for you because it doesn't have a costmap"
            )
        if self._settings.flag("make_plan_clear_costmap"):
            self._clear_start(global_costmap, request.start)
        response = self._planner.answer(request)
        if response.plan.poses and self._settings.flag("make_plan_add_unreachable_goal"):
            self._add_goal(response.plan, request.goal, global_costmap)
        return response

    def _clear_start(self, global_costmap: Costmap2DRos, start: Any) -> None:
        radius = self._settings.number("clearing_radius", global_costmap.footprint.circumscribed_m)
        centre = None
        if start.header.frame_id:
            found = global_costmap.frames.message_in(start, global_costmap.global_frame)
            centre = None if isinstance(found, str) else unit_pose_of(found.pose).xy_yaw
        global_costmap.clear_around(2 * radius, inside=True, centre=centre)

    def _add_goal(self, plan: Any, goal: Any, global_costmap: Costmap2DRos) -> None:
        """Let a plan that ends near the goal end in it."""
        found = global_costmap.frames.message_in(goal, global_costmap.global_frame)
        if isinstance(found, str):
            return
        last = plan.poses[-1].pose
        if unit_pose_of(last).xy_yaw != unit_pose_of(found.pose).xy_yaw:
            end: Any = message_type("geometry_msgs/msg/PoseStamped")(
                header=plan.header, pose=found.pose
            )
            plan.poses.append(end)

    def _on_clear(self, _request: Any) -> Any:
        for costmap in self._costmaps.values():
            costmap.reset()
        return self._empty.Response()


class MoveBase:
    """The node: costmaps, planners, goals, and what they do together.

    Attributes:
        node: on the graph.
        costmaps: by name, ``global_costmap`` and ``local_costmap``.
        goals: of the action ``move_base``.
    """

    def __init__(self, node: Node, tree: Mapping[str, Any], diagnostics: Diagnostics) -> None:
        """Bring everything up; what is wrong with the parameters is reported."""
        self.node = node
        self.settings = node_reader(MOVE_BASE, tree, node.name, diagnostics)
        self.frames = Frames(node)
        self.costmaps = {
            name: self._costmap(name, tree, diagnostics) for name in reversed(_COSTMAPS)
        }
        number, text = self.settings.number, self.settings.text
        self._period_s = 1.0 / number("controller_frequency")
        self.planner = GlobalPlanner(
            node, self.global_costmap, text("base_global_planner"), tree, diagnostics
        )
        self.local = LocalPlanner(
            node, self.local_costmap, text("base_local_planner"), tree, self._period_s, diagnostics
        )
        self.goals = SimpleActionServer(node, "move_base", "move_base_msgs/MoveBase")
        self.driver = Driver(node, self.local_costmap, self.global_costmap, self.local, self.goals)
        self.driver.behaviours = self._behaviours(tree, diagnostics)
        self.executive = MoveBaseStateMachine(self.driver, self._timing())
        self._goal: PlanePose | None = None
        self._goal_message: Any = None
        self._wake = threading.Condition()
        self._closed = False
        kind = message_type("geometry_msgs/msg/PoseStamped")
        self._goal_out = node.create_publisher("~/current_goal", kind, queue_size=1)
        node.create_subscription("move_base_simple/goal", kind, self._on_simple_goal, queue_size=1)
        self.services = MoveBaseServices(
            node, self.planner, self.costmaps, self.goals, self.settings
        )
        self._report_rest(tree)
        self._offer_changes()

    @property
    def global_costmap(self) -> Costmap2DRos:
        """The global costmap."""
        return self.costmaps["global_costmap"]

    @property
    def local_costmap(self) -> Costmap2DRos:
        """The local costmap."""
        return self.costmaps["local_costmap"]

    def run(self, stop: threading.Event) -> None:
        """Work on goals until told to stop."""
        self.driver.stopping = stop
        for costmap in self.costmaps.values():
            costmap.start()
        thread = threading.Thread(target=self._plan_on, args=(stop,), name="planner", daemon=True)
        thread.start()
        while not stop.is_set() and not self.node.closed:
            for _now_ns in ticks(self.node, int(self._period_s * _NANO), stop):
                period_s = self._period_s
                self._cycle()
                if self.node.closed or self._period_s != period_s:
                    break
            else:
                break
        self.driver.stop()

    def close(self) -> None:
        """Take everything off the graph."""
        self._closed = True
        with self._wake:
            self._wake.notify_all()
        self.goals.close()
        for costmap in self.costmaps.values():
            costmap.close()

    def _cycle(self) -> None:
        """One round of the control loop."""
        if self.goals.is_cancelled and not self.goals.has_new:
            self.executive.end()
            self.goals.cancel()
            self._goal = None
            return
        if self.goals.has_new:
            self._begin()
        if self.goals.current is None or self._goal is None:
            return
        pose = self.global_costmap.pose()
        if pose is None and not self._has_begun:
            return
        if pose is not None:
            self.driver.watch_distance(pose)
            self._feedback(pose)
        end = self.executive.cycle(None if pose is None else PlanPose(*pose))
        with self._wake:
            self._wake.notify_all()
        if end is None:
            return
        self._goal = None
        self.driver.rest(self.settings.flag("shutdown_costmaps"))
        if end.outcome is Outcome.SUCCEEDED:
            self.goals.succeed(text=end.text)
        else:
            self.node.log("error", f"Aborting because {_lowered(end.text)}")
            self.goals.abort(text=end.text)

    @property
    def _has_begun(self) -> bool:
        """True once tf and maps were there; the original waits for them before it takes goals."""
        return all(costmap.has_begun for costmap in self.costmaps.values())

    def _begin(self) -> None:
        """Take the newest goal, in the global costmap's frame."""
        goal = self.goals.take()
        if goal is None:
            return
        target = goal.request.target_pose
        why = _problem(target.pose.orientation)
        found: Any = why or self.frames.message_in(target, self.global_costmap.global_frame)
        if isinstance(found, str):
            self._goal = None
            self.executive.end()
            self.node.log("error", found)
            if why:
                found = f"Aborting on goal because it was sent with an invalid quaternion: {why}"
            self.goals.abort(text=found)
            return
        self.driver.rest(False)
        self._goal = unit_pose_of(found.pose).xy_yaw
        self._goal_message = found
        self.local.reset()
        self.executive.begin()
        self._goal_out.publish(found)

    def _feedback(self, pose: PlanePose) -> None:
        goal = self.goals.current
        if goal is not None and goal.is_feedback_wanted:
            feedback = message_type("move_base_msgs/msg/MoveBaseFeedback")()
            set_header(
                feedback.base_position, self.node.clock.now_ns(), self.global_costmap.global_frame
            )
            set_plane_pose(feedback.base_position.pose, pose)
            goal.publish_feedback(feedback)

    def _plan_on(self, stop: threading.Event) -> None:
        """Plan whenever a plan is wanted; runs in the planner's thread."""
        for _ in self._wanted_plans(stop):
            goal = self._goal
            pose = self.global_costmap.pose_or_why()
            if goal is None or (isinstance(pose, str) and not self._has_begun):
                continue
            if isinstance(pose, str):
                text = "Unable to get starting pose of robot, unable to create global plan"
                self.executive.planned(None, f"{text}: {pose}")
                continue
            if not self.global_costmap.is_ready:
                continue
            found = self.planner.plan(pose, goal)
            if self._goal is not goal:
                continue
            if isinstance(found, NoPlan):
                if self.executive.state is State.PLANNING:
                    self.frames.say("warn", found.reason)
                self.executive.planned(None, found.reason)
            else:
                self.executive.planned([PlanPose(*map(float, row)) for row in found.poses])

    def _wanted_plans(self, stop: threading.Event) -> Iterator[None]:
        while not stop.is_set() and not self._closed:
            with self._wake:
                self._wake.wait_for(lambda: self.executive.wants_plan or self._closed, 0.2)
            if not self.executive.wants_plan or self._closed:
                continue
            frequency = self.executive.timing.planner_frequency_hz
            rest_s = 1.0 / frequency if frequency > 0 else _PLANNER_REST_S
            until_ns = self.node.clock.now_ns() + int(rest_s * _NANO)
            yield
            self.driver.sleep_until(until_ns)

    def _on_simple_goal(self, message: Any) -> None:
        self.goals.submit(self.goals.goal_class(target_pose=message))

    def _costmap(
        self, name: str, tree: Mapping[str, Any], diagnostics: Diagnostics
    ) -> Costmap2DRos:
        below = tree.get(name)
        own: dict[str, Any] = dict(below) if isinstance(below, Mapping) else {}
        if not own:
            text = f"{self.node.name}: there are no parameters '{name}'; defaults are used"
            diagnostics.report("parameter.bad-value", text, fix=f"load a YAML with ns={name!r}")
        if name == "local_costmap":
            own.setdefault("global_frame", "odom")
        made = assemble(own, f"{self.node.name}/{name}", diagnostics, above=tree)
        frame = made.costmap.options.global_frame.removeprefix("/")
        publisher = CostmapPublisher(self.node, f"~/{name}", frame)
        return Costmap2DRos(self.node, self.frames, made, publisher)

    def _behaviours(self, tree: Mapping[str, Any], diagnostics: Diagnostics) -> Any:
        return make_behaviours(
            tree,
            self.node.name,
            self.driver.recovery_context(),
            diagnostics,
            clearing_rotation=self.settings.flag("clearing_rotation_allowed"),
            conservative_m=self.settings.number("conservative_reset_dist"),
            aggressive_m=4 * self.local_costmap.footprint.circumscribed_m,
        )

    def _timing(self) -> Timing:
        number, flag = self.settings.number, self.settings.flag
        return Timing(
            number("planner_frequency"),
            number("planner_patience"),
            number("controller_patience"),
            self.settings.integer("max_planning_retries"),
            number("oscillation_timeout"),
            number("oscillation_distance"),
            flag("recovery_behavior_enabled"),
        )

    def _report_rest(self, tree: Mapping[str, Any]) -> None:
        """Tell about namespaces that nobody reads."""
        names = {self.planner.name, self.local.name, *_COSTMAPS}
        names |= {behaviour.name for behaviour in self.driver.behaviours}
        idle = [key for key, value in tree.items() if isinstance(value, Mapping)]
        idle = [key for key in idle if key not in names and key != "TrajectoryPlannerROS"]
        for key in idle:
            text = f"the parameters '{key}' are read by nobody: the planners are "
            text += f"{self.planner.name} and {self.local.name}"
            self.settings.report("parameter.idle", text)
        known = (*names, *idle, *INHERITED, "TrajectoryPlannerROS", "recovery_behaviors")
        self.settings.report_unknown(*known)

    def _offer_changes(self) -> None:
        """Offer what dynamic_reconfigure may change."""
        node, local = self.node, self.local
        offer_dynamic_reconfigure(node, node.name, self.settings, self._change)
        below = f"{node.name}/{local.name}"
        offer_dynamic_reconfigure(node, below, local.settings, local.change)
        for name, costmap in self.costmaps.items():
            below = f"{node.name}/{name}"
            offer_dynamic_reconfigure(node, below, costmap.assembly.settings, costmap.change)
            for layer, settings in costmap.assembly.layers.items():
                change = costmap.layer_changer(layer)
                offer_dynamic_reconfigure(node, f"{below}/{layer}", settings, change)

    def _change(self, values: dict[str, Any]) -> None:
        self.settings.tree.update(values)
        self.executive.timing = self._timing()
        self._period_s = 1.0 / self.settings.number("controller_frequency")
        self.driver.behaviours = self._behaviours(self.settings.tree, Diagnostics())


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Drive to goals until told to stop."""
    node = start_node(arguments, graph)
    diagnostics = Diagnostics()
    tree = parameter_tree(node, arguments)
    base = MoveBase(node, tree, diagnostics)
    log_findings(node, diagnostics)
    arguments.ready()
    try:
        base.run(stop)
    finally:
        base.close()
        node.shutdown()
    return 0


def _problem(quaternion: Any) -> str:
    """Return what is wrong with a goal's direction, in move_base's words."""
    x, y, z, w = (float(getattr(quaternion, axis)) for axis in "xyzw")
    if not all(map(math.isfinite, (x, y, z, w))):
        return "Quaternion has nans or infs... discarding as a navigation goal"
    square = x * x + y * y + z * z + w * w
    if square < 1e-6:
        return "Quaternion has length close to zero... discarding as navigation goal"
    upright = 1 - 2 * (x * x + y * y) / square
    if abs(upright - 1) > 1e-3:
        return (
            "Quaternion is invalid... for navigation the z-axis of the quaternion must be close to "
            "vertical."
        )
    return ""


def _lowered(text: str) -> str:
    return text[:1].lower() + text[1:]
