"""One turtle on the graph: its topics, services and, in ROS 2, its action."""

from __future__ import annotations

import math
import threading
from collections.abc import Callable
from dataclasses import replace
from typing import Any

from gazelle.graph import Node, ServiceRefusedError
from gazelle.graph.actions import ActionServer, ServerGoal
from gazelle.interfaces import message_type, service_type
from gazelle.nodes.turtlesim.canvas import Canvas
from gazelle.nodes.turtlesim.turtle import Pen, Teleport, Turtle, normalized, single

__all__ = ["Member", "all_finite"]

_WALL = "Oh no! I hit the wall! (Clamping from [x=%f, y=%f])"
_REPLACED = "Rotation goal received before a previous goal finished. Aborting previous goal"
_DRIVEN = "Velocity command received during rotation goal. Aborting goal"


def all_finite(*numbers: float) -> bool:
    """Tell whether no number is NaN or infinite."""
    return all(math.isfinite(number) for number in numbers)


class Member:
    """A turtle with its name, offered to others from the start to `close`.

    Attributes:
        name: below which its topics are.
        turtle: how it moves.
        kind: number of its looks.
    """

    def __init__(
        self,
        node: Node,
        name: str,
        turtle: Turtle,
        kind: int,
        *,
        lock: threading.RLock,
        is_ros2: bool,
        is_holonomic: Callable[[], bool],
    ) -> None:
        """Offer the turtle.

        Args:
            node: the simulator's node.
            name: of the turtle.
            turtle: how it moves.
            kind: number of its looks.
            lock: held while the turtle is changed.
            is_ros2: offer the action too.
            is_holonomic: tells whether it may go sideways.
        """
        self.name = name
        self.turtle = turtle
        self.kind = kind
        self._node = node
        self._lock = lock
        self._is_holonomic = is_holonomic
        self._pose: Any = message_type("turtlesim/msg/Pose")
        self._color: Any = message_type("turtlesim/msg/Color")
        self._goal: ServerGoal | None = None
        self._start_rad = 0.0
        self._pose_out = node.create_publisher(f"{name}/pose", self._pose, queue_size=1)
        self._color_out = node.create_publisher(f"{name}/color_sensor", self._color, queue_size=1)
        twist = message_type("geometry_msgs/msg/Twist")
        self._created: list[Any] = [
            self._pose_out,
            self._color_out,
            node.create_subscription(f"{name}/cmd_vel", twist, self._on_twist, queue_size=1),
            self._serve("set_pen", "SetPen", self._set_pen),
            self._serve("teleport_relative", "TeleportRelative", self._teleport_relative),
            self._serve("teleport_absolute", "TeleportAbsolute", self._teleport_absolute),
        ]
        self._action = self._offer_action() if is_ros2 else None

    def close(self) -> None:
        """Take the turtle off the graph."""
        if self._action is not None:
            self._action.close()
        for one in self._created:
            one.unregister()
            self._node.drop(one)

    def step(self, canvas: Canvas) -> tuple[bool, Callable[[], None]]:
        """Go on by one period; the lock is held.

        Returns:
            Whether the picture changed, and what tells others, to be called without the lock.
        """
        turtle = self.turtle
        before = (turtle.x_m, turtle.down_m, turtle.theta_rad)
        canvas.draw(turtle.jump())
        tell_goal = self._follow_goal()
        strokes, hit = turtle.move()
        color = self._color(**dict(zip("rgb", canvas.color_at(turtle.place_px), strict=True)))
        pose = self._pose(
            x=single(turtle.x_m),
            y=single(turtle.y_m),
            theta=single(turtle.theta_rad),
            linear_velocity=single(math.hypot(turtle.linear_x_m_s, turtle.linear_y_m_s)),
            angular_velocity=single(turtle.angular_rad_s),
        )
        canvas.draw(strokes)

        def tell() -> None:
            if hit is not None:
                self._node.log("warn", _WALL % hit)
            self._pose_out.publish(pose)
            self._color_out.publish(color)
            tell_goal()

        return before != (turtle.x_m, turtle.down_m, turtle.theta_rad) or bool(strokes), tell

    def _serve(self, name: str, kind: str, handler: Callable[[Any], None]) -> Any:
        service = service_type(f"turtlesim/{kind}")

        def answer(request: Any) -> Any:
            handler(request)
            return service.Response()

        return self._node.create_service(f"{self.name}/{name}", service, answer)

    def _on_twist(self, message: Any) -> None:
        x, y, angular = message.linear.x, message.linear.y, message.angular.z
        if not all_finite(x, y, angular):
            text = f"[{self.name}] velocities that are no numbers are left out: "
            self._node.log("warn", f"{text}linear=({x}, {y}), angular={angular}")
            return
        with self._lock:
            sideways = y if self._is_holonomic() else self.turtle.linear_y_m_s
            self.turtle.command(x, sideways, angular)
            goal, self._goal = self._goal, None
        if goal is not None:
            self._node.log("warn", _DRIVEN)
            goal.abort(self._result())

    def _set_pen(self, request: Any) -> None:
        with self._lock:
            if request.off:
                self.turtle.pen = replace(self.turtle.pen, is_on=False)
                return
            # A width of 0 means Qt's default of one pixel.
            color = (int(request.r), int(request.g), int(request.b))
            self.turtle.pen = Pen(color, int(request.width) or 1)

    def _teleport_relative(self, request: Any) -> None:
        _check(request.linear, request.angular)
        self._teleport(Teleport(request.angular, linear_m=request.linear, is_relative=True))

    def _teleport_absolute(self, request: Any) -> None:
        _check(request.x, request.y, request.theta)
        self._teleport(Teleport(request.theta, request.x, request.y))

    def _teleport(self, request: Teleport) -> None:
        with self._lock:
            self.turtle.teleport(request)

    def _offer_action(self) -> ActionServer:
        return ActionServer(
            self._node,
            f"{self.name}/rotate_absolute",
            "turtlesim/RotateAbsolute",
            on_goal=self._on_goal,
            on_cancel=lambda _goal: True,
            ros_version=2,
        )

    def _on_goal(self, goal: ServerGoal) -> None:
        _check(goal.request.theta)
        with self._lock:
            # A command that comes as soon as the goal is known to be accepted ends it already.
            goal.accept()
            result = self._result()
            previous, self._goal = self._goal, goal
            self._start_rad = self.turtle.theta_rad
        if previous is not None:
            self._node.log("warn", _REPLACED)
            previous.abort(result)

    def _result(self) -> dict[str, float]:
        return {"delta": normalized(self._start_rad - self.turtle.theta_rad)}

    def _follow_goal(self) -> Callable[[], None]:
        """Turn towards the goal's heading; return what tells its client, without the lock."""
        goal = self._goal
        if goal is None:
            return lambda: None
        if goal.is_cancel_requested:
            self._goal = None
            self.turtle.halt()
            result = self._result()
            return lambda: self._end(goal.cancel, result, "Rotation goal canceled")
        remaining, is_reached = self.turtle.turn_towards(goal.request.theta)
        result = self._result()
        if not is_reached:
            return lambda: goal.publish_feedback({"remaining": remaining})
        self._goal = None
        return lambda: self._end(goal.succeed, result, "Rotation goal completed successfully")

    def _end(self, end: Callable[[Any], None], result: dict[str, float], text: str) -> None:
        self._node.log("info", text)
        end(result)


def _check(*numbers: float) -> None:
    if not all_finite(*numbers):
        raise ServiceRefusedError(f"not all of {', '.join(map(str, numbers))} are finite numbers")
