"""PlanningScene and PlanningSceneMonitor of moveit_py."""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

import numpy as np

from gazelle.compat.moveit.py.robot import RobotModel, RobotState, RobotTrajectory
from gazelle.errors import NotFoundError
from gazelle.geometry import Pose
from gazelle.interfaces import convert, message_type
from gazelle.motion.collision import CollisionChecker
from gazelle.motion.joint_space import FloatArray
from gazelle.motion.planning import FINE_STEP, ErrorCode
from gazelle.motion.scene import PlanningScene as MotionScene
from gazelle.nodes.move_group.collision_object_messages import apply_attached, apply_object
from gazelle.nodes.move_group.context import MoveGroupContext
from gazelle.nodes.move_group.error_codes import MoveGroupError
from gazelle.nodes.move_group.planning_scene_messages import (
    Components,
    apply_scene,
    scene_message,
)

__all__ = ["PlanningScene", "PlanningSceneMonitor"]


class PlanningScene:
    """What there is around a robot, and where the robot is.

    Attributes:
        name: of the scene.
        robot_model: the robot.
        scene: what motion plans in.
        colors: ``ColorRGBA`` by object, of those that were given one here.
    """

    def __init__(self, robot_model: RobotModel, *, context: MoveGroupContext | None = None) -> None:
        """Begin empty, or with the scene of a `MoveItPy`."""
        self.name = "(noname)"
        self.robot_model = robot_model
        self._context = context
        self.colors: dict[str, Any] = {}
        self.scene = MotionScene.of(robot_model._robot)
        if context is not None:
            self.scene = context.monitor.scene
        self._state = RobotState(robot_model)
        self._state._positions = self.scene.positions

    @property
    def current_state(self) -> RobotState:
        """Where the robot is; changing it changes the scene."""
        return self._state

    @current_state.setter
    def current_state(self, robot_state: RobotState) -> None:
        self._state = robot_state

    @property
    def planning_frame(self) -> str:
        """The frame that everything is planned in."""
        return str(self.robot_model.model_frame)

    @property
    def planning_scene_message(self) -> Any:
        """The whole scene as ``moveit_msgs/PlanningScene``."""
        parts = Components.asked(0)
        return scene_message(self._now(), parts, name=self.name, stamp_ns=0, colors=self.colors)

    def knows_frame_transform(self, frame_id: str) -> bool:
        """Return whether the scene has a link or object of this name."""
        try:
            self._frame_of(self.scene, frame_id)
        except MoveGroupError:
            return False
        return True

    def get_frame_transform(self, frame_id: str) -> FloatArray:
        """Return the pose of a link or object in the planning frame, 4×4.

        Raises:
            MoveGroupError: nobody knows it.
        """
        return self._frame_of(self._now(), frame_id).matrix()

    def apply_collision_object(self, collision_object_msg: Any, color_msg: Any = None) -> bool:
        """Add, move or remove an object, with a colour where an ``ObjectColor`` is given.

        Raises:
            MoveGroupError: that cannot be done, with why.
        """
        own = convert(collision_object_msg, message_type("moveit_msgs/msg/CollisionObject"))
        self.scene = apply_object(self._now(), own, self._frame_of)
        if color_msg is not None:
            color = convert(color_msg, message_type("moveit_msgs/msg/ObjectColor"))
            self.colors[own.id] = color.color
        return True

    def process_attached_collision_object(self, object: Any) -> bool:
        """Attach an object or let it go.

        Raises:
            MoveGroupError: that cannot be done, with why.
        """
        own = convert(object, message_type("moveit_msgs/msg/AttachedCollisionObject"))
        self.scene = apply_attached(self._now(), own, self._frame_of)
        return True

    def process_planning_scene_message(self, scene_msg: Any) -> bool:
        """Take a diff or a whole scene.

        Raises:
            MoveGroupError: part of it cannot be done, with why.
        """
        own = convert(scene_msg, message_type("moveit_msgs/msg/PlanningScene"))
        self.scene, problems = apply_scene(self._now(), own, self._frame_of)
        self._state._positions = self.scene.positions
        if problems:
            raise MoveGroupError(ErrorCode.INVALID_OBJECT_NAME, "; ".join(problems))
        return True

    def remove_all_collision_objects(self) -> None:
        """Remove all objects that are not attached."""
        for name in tuple(self.scene.objects):
            self.scene = self.scene.without_object(name)

    def is_state_colliding(
        self,
        robot_state: RobotState | str | None = None,
        joint_model_group_name: str = "",
        verbose: bool = False,
    ) -> bool:
        """Return whether anything collides, with the robot where it is or elsewhere."""
        if isinstance(robot_state, str):
            return self.is_state_colliding(None, robot_state, verbose)
        state = robot_state or self._state
        found = self._checker(joint_model_group_name).contacts(
            self._taken(state, joint_model_group_name)
        )
        for contact in found if verbose else ():
            self._tell(str(contact))
        return bool(found)

    def is_state_valid(
        self, robot_state: RobotState, joint_model_group_name: str = "", verbose: bool = False
    ) -> bool:
        """Return whether nothing collides and all joints are within their limits."""
        robot = self.robot_model._robot
        names = [joint_model_group_name] if joint_model_group_name else list(robot.groups)
        for name in names:
            outside = robot.group(name).space.outside(self._taken(robot_state, name))
            for text in outside if verbose else ():
                self._tell(text)
            if outside:
                return False
        return not self.is_state_colliding(robot_state, joint_model_group_name, verbose)

    def is_path_valid(
        self,
        trajectory: RobotTrajectory | Sequence[RobotState],
        joint_model_group_name: str = "",
        verbose: bool = False,
    ) -> bool:
        """Return whether nothing collides all along a trajectory, looked at every 0.005 rad."""
        if isinstance(trajectory, RobotTrajectory):
            name = joint_model_group_name or trajectory.joint_model_group_name
            rows = list(trajectory._trajectory.positions)
        else:
            name = joint_model_group_name
            rows = [self._taken(state, name) for state in trajectory]
        checker = self._checker(name)
        pairs = zip(rows, rows[1:] or rows, strict=False)
        bad = next((q1 for q0, q1 in pairs if not checker.motion_is_valid(q0, q1, FINE_STEP)), None)
        if bad is not None and verbose:
            self._tell(checker.why(bad) or "a motion between two points of the path collides")
        return bad is None

    def _now(self) -> MotionScene:
        """The scene with the robot where its state was set to."""
        self.scene = self.scene.with_positions(np.asarray(self._state._positions))
        return self.scene

    def _checker(self, group: str) -> CollisionChecker:
        own = self.robot_model._robot.group(group) if group else None
        if self._context is not None:
            return self._context.maker.checker(self._now(), group)
        return CollisionChecker(self._now(), own)

    def _taken(self, state: RobotState, group: str) -> FloatArray:
        q = np.asarray(state._positions)
        return self.robot_model._robot.group(group).take(q) if group else q

    def _frame_of(self, scene: MotionScene, name: str) -> Pose:
        if self._context is not None:
            return self._context.monitor.frame_of(scene, name)
        try:
            return scene.pose_of(name.lstrip("/")) if name else Pose()
        except NotFoundError as error:
            raise MoveGroupError(ErrorCode.FRAME_TRANSFORM_FAILURE, str(error)) from error

    def _tell(self, text: str) -> None:
        if self._context is not None:
            self._context.node.log("info", text)
        else:
            sys.stdout.write(f"{text}\n")


class PlanningSceneMonitor:
    """The scene of a `MoveItPy`."""

    def __init__(self, context: MoveGroupContext) -> None:
        self._context = context

    @contextmanager
    def read_only(self) -> Iterator[PlanningScene]:
        """Give the scene as it is now."""
        yield self._made()

    @contextmanager
    def read_write(self) -> Iterator[PlanningScene]:
        """Give the scene and take it back with what was changed in it."""
        handle = self._made()
        yield handle
        self._context.monitor.replace(handle.scene, handle.colors)

    def _made(self) -> PlanningScene:
        return PlanningScene(RobotModel(self._context.robot), context=self._context)
