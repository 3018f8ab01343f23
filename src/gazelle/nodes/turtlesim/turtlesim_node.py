"""``turtlesim_node``: turtles with their topics and services, and the picture they draw."""

from __future__ import annotations

import math
import threading
import time
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from gazelle.errors import LaunchError
from gazelle.graph import Graph, Node, ServiceRefusedError
from gazelle.graph.actions import ActionServer, ServerGoal
from gazelle.interfaces import message_type, service_type
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.parameters import private_parameters, start_node
from gazelle.nodes.turtlesim.canvas import Canvas, write_png
from gazelle.nodes.turtlesim.parameters import PARAMETERS, settings_of
from gazelle.nodes.turtlesim.turtle import (
    PERIOD_S,
    SIZE_PX,
    WORLD_M,
    Pen,
    Teleport,
    Turtle,
    normalized,
    single,
)

__all__ = ["NamedTurtle", "Simulator", "all_finite", "run"]


_WALL = "Oh no! I hit the wall! (Clamping from [x=%f, y=%f])"
_REPLACED = "Rotation goal received before a previous goal finished. Aborting previous goal"
_DRIVEN = "Velocity command received during rotation goal. Aborting goal"
_USAGE = "usage: turtlesim_node [--png FILE]"

# A turtle that stands still is shown again so often, for those who look later.
_AGAIN_S = 1.0

# Pictures go out at half the rate of steps.
_STEPS_PER_PICTURE = 2


class NamedTurtle:
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


class Simulator:
    """All turtles and their picture."""

    def __init__(self, node: Node, arguments: NodeArguments, png: str = "") -> None:
        """Offer the services and make the first turtle."""
        self._node = node
        self._png = Path(png or "turtlesim.png")
        self._is_ros2 = arguments.ros_version == 2
        self._lock = threading.RLock()
        self._members: dict[str, NamedTurtle] = {}
        self._count = 0
        self._kinds = 0
        self._canvas = Canvas()
        self._settings = settings_of(node, arguments, self._on_background)
        self._canvas.clear(self._settings.background())
        self._image: Any = message_type("sensor_msgs/msg/Image")
        self._out = node.create_publisher("~_canvas", self._image, reliable=False, queue_size=1)
        self._is_changed = True
        self._steps = 0
        self._shown_s = 0.0
        # Whoever calls a service at once finds the first turtle there.
        with self._lock:
            self._offer()
            node.log("info", f"Starting turtlesim with node name {node.name}")
            self._spawn("", single(WORLD_M / 2), single(WORLD_M / 2), 0.0)

    def step(self) -> None:
        """Move every turtle by one period and tell others."""
        telling = []
        with self._lock:
            for _name, member in sorted(self._members.items()):
                is_changed, tell = member.step(self._canvas)
                self._is_changed |= is_changed
                telling.append((member, tell))
        for member, tell in telling:
            with self._lock:
                # It may have been removed meanwhile.
                if self._members.get(member.name) is member:
                    tell()
        self._steps += 1
        if self._steps % _STEPS_PER_PICTURE == 0 and self._out.matched:
            self._show()

    def picture(self) -> Any:
        """Return the picture as an array, rows from the top, red, green and blue."""
        with self._lock:
            turtles = [(one.kind, one.turtle) for _name, one in sorted(self._members.items())]
            return self._canvas.picture(turtles)

    def _show(self) -> None:
        now_s = time.monotonic()
        if not self._is_changed and now_s - self._shown_s < _AGAIN_S:
            return
        self._is_changed, self._shown_s = False, now_s
        message = self._image(
            height=SIZE_PX, width=SIZE_PX, encoding="rgb8", step=3 * SIZE_PX, is_bigendian=0
        )
        message.header.frame_id = "canvas"
        message.header.stamp.sec, message.header.stamp.nanosec = divmod(
            self._node.clock.now_ns(), 1_000_000_000
        )
        message.data = self.picture().tobytes()
        self._out.publish(message)

    def _offer(self) -> None:
        rows = (
            ("clear", "std_srvs/Empty", self._on_clear),
            ("reset", "std_srvs/Empty", self._on_reset),
            ("spawn", "turtlesim/Spawn", self._on_spawn),
            ("kill", "turtlesim/Kill", self._on_kill),
            ("~save_image", "std_srvs/Trigger", self._on_save),
        )
        for name, kind, handler in rows:
            service = service_type(kind)

            def answer(request: Any, service: Any = service, handler: Any = handler) -> Any:
                return service.Response(**handler(request))

            self._node.create_service(name, service, answer)

    def _on_clear(self, _request: Any) -> dict[str, Any]:
        self._node.log("info", "Clearing turtlesim.")
        self._clear()
        return {}

    def _on_reset(self, _request: Any) -> dict[str, Any]:
        self._node.log("info", "Resetting turtlesim.")
        with self._lock:
            for member in self._members.values():
                member.close()
            self._members.clear()
            self._count = 0
            self._spawn("", single(WORLD_M / 2), single(WORLD_M / 2), 0.0)
            self._clear()
        return {}

    def _on_spawn(self, request: Any) -> dict[str, Any]:
        if not all_finite(request.x, request.y, request.theta):
            text = f"x={request.x}, y={request.y}, theta={request.theta}"
            raise ServiceRefusedError(f"a turtle needs numbers for its place, not {text}")
        name = self._spawn(request.name, request.x, request.y, request.theta)
        if not name:
            turtle = "turtle" if self._is_ros2 else "turtled"
            text = f"A {turtle} named [{request.name}] already exists"
            self._node.log("error", text)
            # ROS 2's answers with an empty name, ROS 1's refuses.
            if not self._is_ros2:
                raise ServiceRefusedError(text)
        return {"name": name}

    def _on_kill(self, request: Any) -> dict[str, Any]:
        with self._lock:
            member = self._members.pop(request.name, None)
            if member is not None:
                member.close()
                self._is_changed = True
                return {}
        text = f"Tried to kill turtle [{request.name}], which does not exist"
        self._node.log("error", text)
        if not self._is_ros2:
            there = ", ".join(sorted(self._members)) or "no turtle"
            raise ServiceRefusedError(f"{text}; there is {there}")
        return {}

    def _on_save(self, _request: Any) -> dict[str, Any]:
        try:
            write_png(self.picture(), self._png)
        except LaunchError as error:
            return {"success": False, "message": str(error)}
        return {"success": True, "message": str(self._png.resolve())}

    def _spawn(self, wanted: str, x_m: float, y_m: float, theta_rad: float) -> str:
        """Make a turtle and return its name, empty when another one has it.

        Raises:
            IllegalNameError: there can be no topics below the name.
        """
        with self._lock:
            name = wanted or self._free_name()
            if name in self._members:
                return ""
            self._node.resolve_name(name)
            self._members[name] = NamedTurtle(
                self._node,
                name,
                Turtle.at(x_m, y_m, theta_rad),
                self._kinds,
                lock=self._lock,
                is_ros2=self._is_ros2,
                is_holonomic=self._settings.is_holonomic,
            )
            self._kinds += 1
            self._is_changed = True
        place = f"at x=[{x_m:f}], y=[{y_m:f}], theta=[{theta_rad:f}]"
        self._node.log("info", f"Spawning turtle [{name}] {place}")
        return name

    def _free_name(self) -> str:
        while True:
            self._count += 1
            if (name := f"turtle{self._count}") not in self._members:
                return name

    def _on_background(self, background: tuple[int, int, int]) -> None:
        with self._lock:
            self._canvas.paint_background(background)
            self._is_changed = True

    def _clear(self) -> None:
        with self._lock:
            self._canvas.clear(self._settings.background())
            self._is_changed = True


def all_finite(*numbers: float) -> bool:
    """Tell whether no number is NaN or infinite."""
    return all(math.isfinite(number) for number in numbers)


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Simulate turtles until told to stop."""
    word = _png_of(arguments.rest)
    node = start_node(arguments, graph, offers_parameters=False)
    try:
        with private_parameters(node, arguments, PARAMETERS) as own:
            png = word or own.text("png")
        simulator = Simulator(node, arguments, png)
        next_s = time.monotonic() + PERIOD_S
        while not stop.wait(max(0.0, next_s - time.monotonic())):
            simulator.step()
            # Steps that are missed are not made up for, as with the original's timer.
            next_s = max(next_s, time.monotonic() - PERIOD_S) + PERIOD_S
    finally:
        node.shutdown()
    if png:
        write_png(simulator.picture(), Path(png))
    return 0


def _check(*numbers: float) -> None:
    if not all_finite(*numbers):
        raise ServiceRefusedError(f"not all of {', '.join(map(str, numbers))} are finite numbers")


def _png_of(words: Sequence[str]) -> str:
    """Return the file for the picture, empty when none is asked for.

    Raises:
        LaunchError: the arguments are not understood.
    """
    match list(words):
        case []:
            return ""
        case ["--png", file]:
            return file
        case [word] if word.startswith("--png="):
            return word.removeprefix("--png=")
    raise LaunchError(f"turtlesim_node does not know '{' '.join(words)}'\n{_USAGE}")
