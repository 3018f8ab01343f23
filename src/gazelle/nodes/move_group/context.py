"""What all services and actions of one move_group share."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from gazelle.description.moveit import MoveItConfig
from gazelle.diagnostics import Diagnostics
from gazelle.geometry import Pose
from gazelle.graph import Node, Publisher
from gazelle.interfaces import message_type
from gazelle.motion.joint_space import FloatArray
from gazelle.motion.model import JointKind, RobotModel
from gazelle.motion.planning.error_codes import ErrorCode
from gazelle.motion.scene import PlanningScene
from gazelle.nodes.move_group.error_codes import MoveGroupError
from gazelle.nodes.move_group.fake_controller_manager import FakeControllers, initial_positions
from gazelle.nodes.move_group.parameters import MOVE_GROUP
from gazelle.nodes.move_group.planning_problem import ProblemMaker
from gazelle.nodes.move_group.planning_scene_messages import apply_scene
from gazelle.nodes.move_group.planning_scene_monitor import (
    CurrentStateMonitor,
    PlanningSceneMonitor,
    told_topics,
)
from gazelle.nodes.move_group.request_planner import RequestPlanner
from gazelle.nodes.move_group.robot_state_messages import robot_state_message
from gazelle.nodes.move_group.simple_controller_manager import FAKE_TYPES, controller_specs
from gazelle.nodes.move_group.trajectory_execution_manager import TrajectoryExecutor
from gazelle.nodes.parameters import log_findings, node_reader

__all__ = ["MoveGroupContext", "make_context"]

_STATE_S = 1.0


@dataclass(frozen=True)
class MoveGroupContext:
    """A robot with its scene, planner and controllers.

    Attributes:
        node: what services and actions are offered by.
        ros_version: 1 for ROS 1's names and wire of actions, 2 for ROS 2's.
        config: all that the parameters say.
        robot: joints and groups.
        monitor: keeps the scene.
        maker: makes collision models and solvers.
        planner: plans requests.
        executor: sends trajectories to controllers; None where that is not allowed.
        displays: planned trajectories for views.
    """

    node: Node
    ros_version: Literal[1, 2]
    config: MoveItConfig
    robot: RobotModel
    monitor: PlanningSceneMonitor
    maker: ProblemMaker
    planner: RequestPlanner
    executor: TrajectoryExecutor | None
    displays: tuple[Publisher, ...]

    def fresh_scene(self, diff: Any = None) -> PlanningScene:
        """Return the scene with a state that is new, and a ``PlanningScene`` laid over it.

        Raises:
            MoveGroupError: part of the diff cannot be applied.
        """
        states = self.monitor.states
        # Who plans right after the start has not heard of any joint yet.
        states.wait_for_any(_STATE_S)
        states.wait(self._joints(), states.stamp_ns + 1, _STATE_S)
        scene = self.monitor.scene
        if diff is None or not (diff.is_diff or _has_content(diff)):
            return scene
        scene, problems = apply_scene(scene, diff, self.monitor.frame_of)
        if problems:
            raise MoveGroupError(ErrorCode.INVALID_OBJECT_NAME, "; ".join(problems))
        return scene

    def state_message(self, positions: FloatArray) -> Any:
        """Return the ``RobotState`` of the robot's positions (rad, m), (variables,), now."""
        now_ns = self.node.clock.now_ns()
        return robot_state_message(self.robot, positions, frame=self.robot.frame, stamp_ns=now_ns)

    def pose_in_frame(self, scene: PlanningScene, T_robot_link: FloatArray, frame: str) -> Pose:
        """Return a pose of the planning frame, (4, 4), in another frame.

        Raises:
            MoveGroupError: nobody knows the frame.
        """
        T_robot_frame = self.monitor.frame_of(scene, frame).matrix()
        return Pose.from_matrix(np.linalg.inv(T_robot_frame) @ T_robot_link)

    def show(self, trajectory: Any, start: FloatArray) -> None:
        """Publish a planned ``RobotTrajectory`` for views.

        Args:
            trajectory: the message.
            start: the robot's positions at its beginning, rad and m, (variables,).
        """
        message: Any = message_type("moveit_msgs/msg/DisplayTrajectory")(model_id=self.robot.name)
        message.trajectory = [trajectory]
        message.trajectory_start = self.state_message(start)
        for one in self.displays:
            one.publish(message)

    def tell(self, what: str, error: MoveGroupError) -> None:
        """Log a failure with its code and why."""
        self.node.log("error", f"{what}: {error.code.name}: {error.reason}")

    def _joints(self) -> tuple[str, ...]:
        free = (joint for joint in self.robot.joints if joint.is_active and not joint.is_passive)
        known = self.monitor.states.positions
        return tuple(joint.name for joint in free if joint.name in known)


def make_context(
    node: Node,
    config: MoveItConfig,
    robot: RobotModel,
    parameters: Mapping[str, Any],
    *,
    ros_version: Literal[1, 2],
) -> MoveGroupContext:
    """Put everything together; a controller that is not understood is logged.

    Args:
        node: what it all belongs to.
        config: the robot's.
        robot: the same as motion sees it.
        parameters: the node's own, nested.
        ros_version: of names and wires.
    """
    found = Diagnostics()
    own = node_reader(MOVE_GROUP, parameters, node.name, found, ros_version=ros_version)
    states = CurrentStateMonitor(node, own.text("joint_state_topic"))
    monitor = PlanningSceneMonitor(node, robot, states, ros_version=ros_version)
    maker = ProblemMaker(config, robot)
    executor = None
    if own.flag("allow_trajectory_execution"):
        executor = _executor(node, config, robot, states)
        if any(entry.type in FAKE_TYPES for entry in config.controllers):
            FakeControllers(node, config.controllers, initial_positions(robot, parameters))
    log_findings(node, found)
    displays = tuple(
        node.create_publisher(name, "moveit_msgs/msg/DisplayTrajectory", latch=True)
        for name in told_topics("display_planned_path", ros_version)
    )
    return MoveGroupContext(
        node, ros_version, config, robot, monitor, maker, RequestPlanner(maker), executor, displays
    )


def _executor(
    node: Node, config: MoveItConfig, robot: RobotModel, states: CurrentStateMonitor
) -> TrajectoryExecutor:
    try:
        specs = controller_specs(config)
    except MoveGroupError as error:
        node.log("error", error.reason)
        specs = ()
    for spec in specs:
        node.log("info", f"Added {spec.kind.value} controller for {spec.name}")
    endless = [
        joint.name
        for joint in robot.joints
        if joint.kind is JointKind.REVOLUTE and joint.limits and joint.limits[0].continuous
    ]
    return TrajectoryExecutor(node, specs, config.execution, states, endless_joints=endless)


def _has_content(diff: Any) -> bool:
    """A message that is all defaults asks for nothing, whatever its ``is_diff`` says."""
    return bool(
        len(diff.world.collision_objects)
        or len(diff.robot_state.attached_collision_objects)
        or len(diff.robot_state.joint_state.name)
        or len(diff.allowed_collision_matrix.entry_names)
        or len(diff.link_padding)
        or diff.robot_model_name
    )
