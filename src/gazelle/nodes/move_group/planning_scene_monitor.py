"""The planning scene that a node keeps up to date: joint states, tf, objects that others send."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from typing import Any

from gazelle.errors import NotFoundError
from gazelle.geometry import Pose
from gazelle.graph import Node
from gazelle.graph.tf import TransformBuffer, TransformError, TransformListener
from gazelle.interfaces import message_type
from gazelle.interfaces.stamps import ns_of
from gazelle.motion.model import RobotModel
from gazelle.motion.planning.error_codes import ErrorCode
from gazelle.motion.scene import PlanningScene
from gazelle.nodes.move_group.collision_object_messages import apply_attached, apply_object
from gazelle.nodes.move_group.error_codes import MoveGroupError
from gazelle.nodes.move_group.planning_scene_messages import (
    Components,
    apply_scene,
    scene_message,
)

__all__ = ["CurrentStateMonitor", "PlanningSceneMonitor", "told_topics"]


_NAME = "(noname)"
_PERIOD_S = 0.25


class CurrentStateMonitor:
    """Collects joint states; several publishers may each tell some of the joints."""

    def __init__(self, node: Node, topic: str = "joint_states") -> None:
        """Listen to a topic."""
        self._changed = threading.Condition()
        self._positions: dict[str, float] = {}
        self._velocities: dict[str, float] = {}
        self._stamps_ns: dict[str, int] = {}
        self._listeners: list[Callable[[], None]] = []
        self._clock = node.clock
        self.topic = node.resolve_name(topic)
        node.create_subscription(
            topic, message_type("sensor_msgs/msg/JointState"), self._take, queue_size=10
        )
        node.clock.on_jump(self._on_jump)

    @property
    def positions(self) -> dict[str, float]:
        """Last position of every joint that was told of, rad or m."""
        with self._changed:
            return dict(self._positions)

    @property
    def velocities(self) -> dict[str, float]:
        """Last velocity of the joints that have one, rad/s or m/s."""
        with self._changed:
            return dict(self._velocities)

    @property
    def stamp_ns(self) -> int:
        """Stamp of the newest message, 0 before the first."""
        with self._changed:
            return max(self._stamps_ns.values(), default=0)

    def on_change(self, listener: Callable[[], None]) -> None:
        """Call back after each message, in the graph's thread."""
        self._listeners.append(listener)

    def missing(self, joints: Iterable[str], since_ns: int = 0) -> tuple[str, ...]:
        """Return the joints of which no position is known that is as new as a time."""
        with self._changed:
            return tuple(name for name in joints if self._stamps_ns.get(name, -1) < since_ns)

    def wait(self, joints: Iterable[str], since_ns: int, timeout_s: float) -> tuple[str, ...]:
        """Wait in wall time for states as new as a time; return the joints that never came."""
        wanted, deadline = tuple(joints), time.monotonic() + timeout_s
        with self._changed:
            while self.missing(wanted, since_ns):
                left_s = deadline - time.monotonic()
                if left_s <= 0 or not self._changed.wait(left_s):
                    break
            return self.missing(wanted, since_ns)

    def wait_for_any(self, timeout_s: float) -> bool:
        """Wait in wall time until any joint is known; tell whether one is."""
        with self._changed:
            return self._changed.wait_for(lambda: bool(self._positions), timeout_s)

    def wait_for_next(self, timeout_s: float) -> bool:
        """Wait in wall time for any message; tell whether one came."""
        with self._changed:
            return self._changed.wait(timeout_s)

    def _take(self, message: Any) -> None:
        stamp = message.header.stamp
        # States without a stamp are those of now, as fake publishers send them.
        stamp_ns = ns_of(stamp) or self._clock.now_ns()
        with self._changed:
            self._store(self._positions, message.name, message.position)
            self._store(self._velocities, message.name, message.velocity)
            for name, _ in zip(message.name, message.position, strict=False):
                self._stamps_ns[name] = stamp_ns
            self._changed.notify_all()
        for listener in tuple(self._listeners):
            listener()

    def _store(self, into: dict[str, float], names: Iterable[str], values: Iterable[Any]) -> None:
        into.update(zip(names, map(float, values), strict=False))

    def _on_jump(self, _delta_ns: int) -> None:
        with self._changed:
            self._stamps_ns = dict.fromkeys(self._stamps_ns, 0)


class PlanningSceneMonitor:
    """Holds the scene, takes changes of it from topics and tells others of it.

    Attributes:
        robot: the robot.
        states: where its joints are.
        version: counts changes of everything but joint states.
    """

    def __init__(
        self, node: Node, robot: RobotModel, states: CurrentStateMonitor, *, ros_version: int = 2
    ) -> None:
        """Begin with an empty scene.

        Args:
            node: listens and tells.
            robot: the robot.
            states: where its joints are.
            ros_version: 1 for MoveIt 1's names of topics too.
        """
        self.robot = robot
        self.states = states
        self.version = 0
        self._node = node
        self._lock = threading.RLock()
        self._scene = PlanningScene.of(robot)
        self._colors: dict[str, Any] = {}
        self._variables = frozenset(robot.variables)
        self._buffer = TransformBuffer()
        self._listener = TransformListener(self._buffer, node)
        self._changed = threading.Event()
        self._is_new = True
        self._outs = [
            node.create_publisher(name, "moveit_msgs/msg/PlanningScene", queue_size=100)
            for name in told_topics("monitored_planning_scene", ros_version)
        ]
        states.on_change(self._changed.set)

    @property
    def scene(self) -> PlanningScene:
        """The scene with the robot where it is now."""
        known = self.states.positions
        values = {name: value for name, value in known.items() if name in self._variables}
        with self._lock:
            return self._scene.with_positions({**self._rooted(), **values})

    def frame_of(self, scene: PlanningScene, name: str) -> Pose:
        """Return the pose of a frame in the planning frame; an empty name is the planning frame.

        Raises:
            MoveGroupError: neither robot, objects nor tf know it.
        """
        frame = name.lstrip("/")
        if not frame:
            return Pose()
        try:
            return scene.pose_of(frame)
        except NotFoundError as error:
            unknown = error
        try:
            found = self._buffer.lookup_transform(self.robot.frame, frame, 0)
        except TransformError as error:
            text = f"frame '{frame}' is not known: {unknown}; tf says: {error}"
            raise MoveGroupError(ErrorCode.FRAME_TRANSFORM_FAILURE, text) from error
        return found.pose

    def apply_object(self, message: Any) -> None:
        """Take a ``CollisionObject``; what is wrong with it is logged."""
        self._change(lambda scene: apply_object(scene, message, self.frame_of))

    def apply_attached(self, message: Any) -> None:
        """Take an ``AttachedCollisionObject``; what is wrong with it is logged."""
        self._change(lambda scene: apply_attached(scene, message, self.frame_of))

    def apply(self, message: Any) -> bool:
        """Take a ``PlanningScene``; tells whether all of it could be done, the rest is logged."""
        with self._lock:
            self._scene, problems = apply_scene(self.scene, message, self.frame_of)
            if not message.is_diff:
                self._colors.clear()
            self._colors.update({row.id: row.color for row in message.object_colors})
        self._tell_change()
        for problem in problems:
            self._node.log("warn", f"planning scene: {problem}")
        return not problems

    def replace(self, scene: PlanningScene, colors: Mapping[str, Any]) -> None:
        """Take a scene in place of the present one, and the colours of some of its objects."""
        with self._lock:
            self._scene = scene
            self._colors.update(colors)
        self._tell_change()

    def apply_world(self, message: Any) -> bool:
        """Take a ``PlanningSceneWorld``, which replaces all objects."""
        with self._lock:
            self._scene = replace(self._scene, objects={})
        scene: Any = message_type("moveit_msgs/msg/PlanningScene")(is_diff=True)
        scene.world = message
        scene.robot_state.is_diff = True
        return self.apply(scene)

    def message(self, parts: Components) -> Any:
        """Return the ``PlanningScene`` message of the scene."""
        stamp_ns = self.states.stamp_ns or self._node.clock.now_ns()
        return scene_message(self.scene, parts, name=_NAME, stamp_ns=stamp_ns, colors=self._colors)

    def publish_until(self, stop: threading.Event) -> None:
        """Tell changes, four times a second at most, while somebody listens."""
        while not stop.is_set():
            if self._changed.wait(_PERIOD_S):
                self._changed.clear()
                if any(one.matched for one in self._outs):
                    self._publish()
            stop.wait(_PERIOD_S)

    def _publish(self) -> None:
        with self._lock:
            everything, self._is_new = self._is_new, False
        if everything:
            self._tell(self.message(Components.asked(0)))
            return
        diff = self.message(Components.SCENE_SETTINGS | Components.ROBOT_STATE)
        diff.is_diff = diff.robot_state.is_diff = True
        diff.robot_state.attached_collision_objects = []
        self._tell(diff)

    def _tell(self, message: Any) -> None:
        for one in self._outs:
            one.publish(message)

    def _change(self, change: Callable[[PlanningScene], PlanningScene]) -> None:
        try:
            with self._lock:
                self._scene = change(self.scene)
        except MoveGroupError as error:
            self._node.log("error", f"planning scene: {error.reason}")
            return
        self._tell_change()

    def _tell_change(self) -> None:
        with self._lock:
            self._is_new = True
            self.version += 1
        self._changed.set()

    def _rooted(self) -> dict[str, float]:
        """Positions of the joint between world and robot, of tf when that is not a fixed one."""
        root = self.robot.joints[0]
        if not root.variables:
            return {}
        try:
            found = self._buffer.lookup_transform(self.robot.frame, root.child, 0).pose
        except TransformError:
            return {}
        x, y, z = found.position_m
        if len(root.variables) == 3:
            return dict(zip(root.variables, (x, y, found.rpy_rad[2]), strict=True))
        return dict(zip(root.variables, (x, y, z, *found.quat_xyzw), strict=True))


def told_topics(name: str, ros_version: int) -> tuple[str, ...]:
    """Return the names of a topic that views listen to: MoveIt 1 has them below the node's."""
    return (name, f"~{name}") if ros_version == 1 else (name,)
