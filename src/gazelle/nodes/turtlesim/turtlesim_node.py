"""``turtlesim_node``: turtles, the services that make and remove them, and the picture.

There is no window: the picture is on ``~_canvas`` while somebody looks; the
underscore hides it from lists and from recordings of everything. ROS 2's newer turtlesim
says white for ``color_sensor`` where nothing is drawn; here both say the background.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from gazelle.errors import LaunchError
from gazelle.graph import Graph, Node, ServiceRefusedError
from gazelle.interfaces import message_type, service_type
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.parameter_reading import private_parameters
from gazelle.nodes.parameters import start_node
from gazelle.nodes.turtlesim.canvas import Canvas, write_png
from gazelle.nodes.turtlesim.member import Member, all_finite
from gazelle.nodes.turtlesim.parameters import PARAMETERS, settings_of
from gazelle.nodes.turtlesim.turtle import PERIOD_S, SIZE_PX, WORLD_M, Turtle, single

__all__ = ["Simulator", "run"]

_USAGE = "usage: turtlesim_node [--png FILE]"
# A turtle that stands still is shown again so often, for those who look later.
_AGAIN_S = 1.0
# Pictures go out at half the rate of steps.
_STEPS_PER_PICTURE = 2


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


class Simulator:
    """All turtles and their picture."""

    def __init__(self, node: Node, arguments: NodeArguments, png: str = "") -> None:
        """Offer the services and make the first turtle."""
        self._node = node
        self._png = Path(png or "turtlesim.png")
        self._is_ros2 = arguments.ros_version == 2
        self._lock = threading.RLock()
        self._members: dict[str, Member] = {}
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
            self._members[name] = Member(
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
