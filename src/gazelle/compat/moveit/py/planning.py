"""MoveItPy, PlanningComponent and what planning answers."""

from __future__ import annotations

import sys
import threading
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from gazelle.compat.moveit.goal_constraints import joint_constraints, pose_constraints
from gazelle.compat.moveit.py.robot import RobotModel, RobotState, RobotTrajectory
from gazelle.compat.moveit.py.scene import PlanningSceneMonitor
from gazelle.description.moveit import config_from_parameters
from gazelle.diagnostics import Diagnostics, did_you_mean
from gazelle.errors import GazelleError
from gazelle.graph import Graph
from gazelle.interfaces import convert, message_type
from gazelle.interfaces.poses import pose_of
from gazelle.motion.model import RobotModel as MotionRobot
from gazelle.motion.planning.error_codes import ErrorCode
from gazelle.nodes.arguments import read_arguments
from gazelle.nodes.move_group.context import MoveGroupContext, make_context
from gazelle.nodes.move_group.error_codes import MoveGroupError, code_message
from gazelle.nodes.move_group.planning_scene_services import offer_scene_answers, offer_scene_topics
from gazelle.nodes.move_group.trajectory_execution_manager import ExecutionStatus
from gazelle.parameters.trees import nested
from gazelle.workspace import Workspace

__all__ = [
    "MotionPlanResponse",
    "MoveItPy",
    "MultiPipelinePlanRequestParameters",
    "PlanRequestParameters",
    "PlanningComponent",
    "PlanningSceneMonitor",
]


@dataclass
class PlanRequestParameters:
    """How to plan; `MoveItPy` gives the parameters of a namespace such as ``ompl_rrtc``."""

    moveit_py: Any = None
    namespace: str = ""
    planner_id: str = ""
    planning_pipeline: str = ""
    planning_attempts: int = 1
    planning_time: float = 5.0
    max_velocity_scaling_factor: float = 1.0
    max_acceleration_scaling_factor: float = 1.0

    def __post_init__(self) -> None:
        tree: Any = getattr(self.moveit_py, "parameters", {})
        for word in filter(None, self.namespace.split(".")):
            tree = tree.get(word, {}) if isinstance(tree, Mapping) else {}
        values = tree.get("plan_request_params", tree) if isinstance(tree, Mapping) else {}
        for name in ("planner_id", "planning_pipeline", "planning_attempts", "planning_time",
                     "max_velocity_scaling_factor", "max_acceleration_scaling_factor"):  # fmt: skip
            if name in values:
                setattr(self, name, values[name])


class MultiPipelinePlanRequestParameters:
    """Several ways to plan, by the namespaces of their parameters."""

    def __init__(self, moveit_py: Any, planning_pipeline_names: list[str]) -> None:
        self.parameters = [
            PlanRequestParameters(moveit_py, name) for name in planning_pipeline_names
        ]


@dataclass(frozen=True)
class MotionPlanResponse:
    """What planning answers; true when there is a trajectory."""

    trajectory: RobotTrajectory | None
    error_code: Any
    planning_time: float = 0.0
    planner_id: str = ""
    start_state: Any = field(default=None, repr=False)

    def __bool__(self) -> bool:
        return self.trajectory is not None


class MoveItPy:
    """A robot that is planned for in this process and executed through its controllers.

    Args:
        node_name: of the node it makes.
        launch_params_filepaths: files of parameters, besides those of the command line.
        config_dict: parameters such as ``MoveItConfigsBuilder(…).to_moveit_configs().to_dict()``.
        provide_planning_service: offer ``get_planning_scene``.

    Raises:
        RuntimeError: the parameters have no robot.
    """

    def __init__(
        self,
        node_name: str = "moveit_py",
        name_space: str = "",
        launch_params_filepaths: list[str] | None = None,
        config_dict: Mapping[str, Any] | None = None,
        provide_planning_service: bool = True,
    ) -> None:
        files = [
            argument for one in launch_params_filepaths or () for argument in ("--params-file", one)
        ]
        argv = [*sys.argv[1:], *(["--ros-args", *files] if files else [])]
        arguments = read_arguments(argv, node_name, namespace=name_space or "/")
        self.parameters = nested({**(config_dict or {}), **arguments.params})
        self._graph = Graph.open()
        self._node = self._graph.create_node(arguments.name, namespace=arguments.namespace)
        self._context = self._made(self.parameters)
        offer_scene_topics(self._context)
        if provide_planning_service:
            offer_scene_answers(self._context)
        self._monitor = PlanningSceneMonitor(self._context)

    def get_robot_model(self) -> RobotModel:
        """Return the robot."""
        return RobotModel(self._context.robot)

    def get_planning_component(self, planning_component_name: str) -> PlanningComponent:
        """Return what plans for a group.

        Raises:
            RuntimeError: there is no such group.
        """
        groups = self._context.robot.groups
        if planning_component_name not in groups:
            hint = did_you_mean(planning_component_name, groups)
            text = f"there is no planning group '{planning_component_name}'; {hint}"
            raise RuntimeError(text)
        return PlanningComponent(self._context, planning_component_name)

    def get_planning_scene_monitor(self) -> PlanningSceneMonitor:
        """Return the scene, which follows joint states and what others publish."""
        return self._monitor

    def execute(
        self,
        robot_trajectory: Any = None,
        *more: Any,
        group_name: str = "",
        blocking: bool = True,
        controllers: list[str] | None = None,
    ) -> ExecutionStatus | None:
        """Execute a trajectory.

        Args:
            robot_trajectory: of `PlanningComponent.plan`, or a message.
            more: the controllers; where the first word is a group's name, as in Humble, the
                trajectory and `blocking`.
            group_name: without effect: the trajectory knows its joints by itself.
            blocking: wait for the end.
            controllers: names of the controllers to use, any when empty.

        Returns:
            How it ended, None where that is not waited for; the log says why when it is not well.
        """
        if isinstance(robot_trajectory, str):
            robot_trajectory, *rest = more
            blocking = rest[0] if rest else blocking
        elif more:
            controllers = more[0]
        execution = (robot_trajectory, list(controllers or ()))
        if blocking:
            return self._execute(*execution)
        threading.Thread(target=self._execute, args=execution, daemon=True).start()
        return None

    def _execute(self, trajectory: Any, controllers: list[str]) -> ExecutionStatus:
        if isinstance(trajectory, RobotTrajectory):
            trajectory = trajectory.get_robot_trajectory_msg()
        own = convert(trajectory, message_type("moveit_msgs/msg/RobotTrajectory"))
        assert self._context.executor is not None
        outcome = self._context.executor.execute(own.joint_trajectory, controllers)
        if outcome.why:
            self._node.log("error", f"execution: {outcome.status.value}: {outcome.why}")
        return outcome.status

    def shutdown(self) -> None:
        """Leave the graph."""
        self._node.shutdown()
        self._graph.close()

    def _made(self, parameters: Mapping[str, Any]) -> MoveGroupContext:
        diagnostics = Diagnostics()
        config = config_from_parameters(
            parameters, workspace=Workspace.discover(), diagnostics=diagnostics
        )
        if config is None:
            found = "; ".join(one.message for one in diagnostics.errors)
            raise RuntimeError(f"Unable to construct robot model: {found}")
        robot = MotionRobot.from_config(config, diagnostics=diagnostics)
        made = make_context(self._node, config, robot, {}, ros_version=2)
        made.maker.warm_up(made.monitor.scene)
        return made


class PlanningComponent:
    """Plans for one group.

    Attributes:
        planning_group_name: the group.
        named_target_states: names of its states in the SRDF.
    """

    def __init__(self, context: MoveGroupContext, name: str) -> None:
        self._context = context
        self.planning_group_name = name
        self.named_target_states = list(context.robot.group(name).states)
        self._start: Any = None
        self._goals: list[Any] = []
        self._path: Any = None

    def named_target_state_values(self, name: str) -> dict[str, float]:
        """Return the positions of a named state.

        Raises:
            KeyError: there is none of this name.
        """
        return dict(self._context.robot.group(self.planning_group_name).states[name])

    def set_start_state_to_current_state(self) -> bool:
        """Plan from where the robot is."""
        self._start = None
        return True

    def set_start_state(
        self, configuration_name: str | None = None, robot_state: RobotState | None = None
    ) -> bool:
        """Plan from a named state or a `RobotState`."""
        state = robot_state or self._named(configuration_name or "")
        self._start = state.message()
        return True

    def set_goal_state(
        self,
        configuration_name: str | None = None,
        robot_state: RobotState | None = None,
        pose_stamped_msg: Any = None,
        pose_link: str | None = None,
        motion_plan_constraints: list[Any] | None = None,
    ) -> bool:
        """Set where to go: a named state, a `RobotState`, a pose of a link, or constraints.

        Raises:
            ValueError: none or several of them are given.
        """
        given = (configuration_name, robot_state, pose_stamped_msg, motion_plan_constraints)
        if sum(one is not None for one in given) != 1:
            raise ValueError("exactly one kind of goal is needed: a name, a state, a pose or "
                             "constraints")  # fmt: skip
        if motion_plan_constraints is not None:
            kind = message_type("moveit_msgs/msg/Constraints")
            self._goals = [convert(one, kind) for one in motion_plan_constraints]
        elif pose_stamped_msg is not None:
            self._goals = [self._of_pose(pose_stamped_msg, pose_link or "")]
        else:
            state = robot_state or self._named(configuration_name or "")
            group = self._context.robot.group(self.planning_group_name)
            values = {name: state.joint_positions[name] for name in group.variables}
            self._goals = [joint_constraints(values, 1e-4)]
        return True

    def set_path_constraints(self, path_constraints: Any) -> None:
        """Set what must hold all along."""
        self._path = convert(path_constraints, message_type("moveit_msgs/msg/Constraints"))

    def plan(
        self,
        single_plan_parameters: PlanRequestParameters | None = None,
        multi_plan_parameters: MultiPipelinePlanRequestParameters | None = None,
        planning_scene: Any = None,
    ) -> MotionPlanResponse:
        """Plan to the goal; false when there is no plan, with the code and why in `error_code`.

        Args:
            single_plan_parameters: how to plan.
            multi_plan_parameters: several ways, of which the fastest trajectory is taken.
            planning_scene: what to plan in, of `PlanningSceneMonitor`; the present scene if None.
        """
        if multi_plan_parameters is not None:
            ways = multi_plan_parameters.parameters
            found = [self._plan(one, planning_scene) for one in ways]
            good = [one for one in found if one.trajectory is not None]
            return min(good, key=_duration_s, default=found[0])
        return self._plan(single_plan_parameters, planning_scene)

    def _plan(
        self, single_plan_parameters: PlanRequestParameters | None, planning_scene: Any
    ) -> MotionPlanResponse:
        context, settings = self._context, single_plan_parameters or PlanRequestParameters()
        request: Any = message_type("moveit_msgs/msg/MotionPlanRequest")(
            group_name=self.planning_group_name,
            pipeline_id=settings.planning_pipeline,
            planner_id=settings.planner_id,
            num_planning_attempts=int(settings.planning_attempts),
            allowed_planning_time=float(settings.planning_time),
            max_velocity_scaling_factor=float(settings.max_velocity_scaling_factor),
            max_acceleration_scaling_factor=float(settings.max_acceleration_scaling_factor),
            goal_constraints=self._goals,
        )
        if self._start is not None:
            request.start_state = self._start
        if self._path is not None:
            request.path_constraints = self._path
        try:
            scene = context.fresh_scene() if planning_scene is None else planning_scene.scene
            planned = context.planner.plan(scene, request, context.monitor.frame_of)
        except MoveGroupError as error:
            context.tell("plan", error)
            return MotionPlanResponse(None, code_message(error.code, error.reason))
        model = RobotModel(context.robot)
        trajectory = RobotTrajectory(model, planned.trajectory, planned.group)
        start = context.state_message(planned.start)
        code = code_message(ErrorCode.SUCCESS)
        context.show(trajectory.get_robot_trajectory_msg(), planned.start)
        return MotionPlanResponse(trajectory, code, planned.time_s, planned.planner, start)

    def _named(self, name: str) -> RobotState:
        state = RobotState(RobotModel(self._context.robot))
        state._positions = self._context.monitor.scene.positions
        if not state.set_to_default_values(self.planning_group_name, name):
            hint = did_you_mean(name, self.named_target_states)
            text = f"group '{self.planning_group_name}' has no state '{name}'; {hint}"
            raise GazelleError(text)
        return state

    def _of_pose(self, stamped: Any, link: str) -> Any:
        pose = pose_of(stamped.pose)
        return pose_constraints(
            link or self._context.robot.group(self.planning_group_name).tip_link,
            stamped.header.frame_id,
            position_m=pose.position_m,
            quat_xyzw=pose.quat_xyzw,
        )


def _duration_s(response: MotionPlanResponse) -> float:
    return response.trajectory.duration if response.trajectory is not None else float("inf")
