"""``nav2_collision_monitor collision_monitor``: the last that looks at a velocity command."""

from __future__ import annotations

import math
import threading
from typing import Any

from gazelle.diagnostics import Diagnostics
from gazelle.graph import Graph
from gazelle.interfaces import message_type, service_type
from gazelle.interfaces.stamps import set_header
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.nav2.collision_monitor.parameters import (
    COLLISION_MONITOR,
    read_polygons,
    read_sources,
    report_others,
)
from gazelle.nodes.nav2.collision_monitor.polygons import (
    Action,
    Points,
    Polygon,
    Velocity,
    Verdict,
    guarded,
)
from gazelle.nodes.nav2.collision_monitor.sources import Source, WorldFrames
from gazelle.nodes.nav2.costmap_node import outline_in_base
from gazelle.nodes.nav2.lifecycle_server import ServerSetup, run_server
from gazelle.nodes.navigation.robot_pose import Frames
from gazelle.nodes.parameters import log_findings, node_reader, offer_parameters
from gazelle.nodes.twist_publisher import TwistPublisher
from gazelle.parameters.reader import ParameterReader

__all__ = ["run"]

_STAND: Velocity = (0.0, 0.0, 0.0)
_POLYGON = "geometry_msgs/msg/PolygonStamped"
_WORDS = {
    Action.STOP: "Robot to stop due to {}",
    Action.SLOWDOWN: "Robot to slowdown for {} of the velocity due to {}",
    Action.LIMIT: "Robot to limit speed due to {}",
    Action.APPROACH: "Robot to approach for a collision ahead due to {}",
    Action.NONE: "Robot to continue normal operation",
}
_BLIND = "invalid source"


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Guard commands until told to stop."""
    return run_server(_Monitor, arguments, graph, stop)


class _Monitor:
    def __init__(self, setup: ServerSetup) -> None:
        node, tree, *_ = setup
        self._node, self._tree = node, tree
        self._settings = node_reader(COLLISION_MONITOR, tree, node.name, Diagnostics())
        self._frames = Frames(node)
        self._stamped = self._settings.flag("enable_stamped_cmd_vel")
        self._base = self._settings.text("base_frame_id").removeprefix("/")
        self._polygons: list[Polygon] = []
        self._sources: list[Source] = []
        self._shown: list[tuple[Polygon, Any]] = []
        self._open: list[Any] = []
        self._out: TwistPublisher | None = None
        self._state_out: Any = None
        self._is_active, self._is_on = False, True
        self._last, self._stopped_ns = Verdict(_STAND, Action.NONE, ""), 0
        self._lock = threading.Lock()
        node.create_service("~/toggle", service_type("nav2_msgs/srv/Toggle"), self._toggle)
        self._parameters = offer_parameters(node, tree, self._change)

    def configure(self) -> bool:
        diagnostics = Diagnostics()
        settings = node_reader(COLLISION_MONITOR, self._tree, self._node.name, diagnostics)
        self._settings, text = settings, settings.text
        polygons = read_polygons(settings)
        fixed = text("odom_frame_id") if settings.flag("base_shift_correction") else ""
        frames = WorldFrames(
            self._frames, self._base, fixed.removeprefix("/"),
            settings.number("transform_tolerance"),
        )  # fmt: skip
        self._sources = [Source(self._node, one, frames) for one in read_sources(settings)]
        report_others(settings)
        self._polygons = [polygon for polygon, _ in polygons]
        for polygon, own in polygons:
            self._connect(polygon, own)
        self._out = TwistPublisher(
            self._node, is_stamped=self._stamped, topic=text("cmd_vel_out_topic")
        )
        kind = "geometry_msgs/msg/TwistStamped" if self._stamped else "geometry_msgs/msg/Twist"
        topic = text("cmd_vel_in_topic")
        self._open.append(self._node.create_subscription(topic, kind, self._hear, queue_size=1))
        if text("state_topic"):
            state = message_type("nav2_msgs/msg/CollisionMonitorState")
            self._state_out = self._node.create_publisher(text("state_topic"), state)
        return log_findings(self._node, diagnostics)

    def activate(self) -> bool:
        self._last, self._is_active = Verdict(_STAND, Action.NONE, ""), True
        return True

    def deactivate(self) -> bool:
        if self._is_active and self._out is not None:
            self._out.stop()
        self._is_active = False
        return True

    def cleanup(self) -> bool:
        self.deactivate()
        for one in (*self._sources, self._out):
            if one is not None:
                one.close()
        for each in (*self._open, *(out for _, out in self._shown), self._state_out):
            if each is not None:
                each.unregister()
        self._sources, self._open, self._shown, self._polygons = [], [], [], []
        self._out = self._state_out = None
        return True

    def _connect(self, polygon: Polygon, own: ParameterReader) -> None:
        """Let a topic give a zone's outline, and show it, where that is asked for."""
        if polygon.radius_m is None and polygon.outline is None and not polygon.sub_polygons:
            topic = own.text("polygon_sub_topic")
            if not topic and polygon.action is Action.APPROACH:
                topic = own.text("footprint_topic")

            def take(message: Any) -> None:
                found = outline_in_base(self._frames, message, self._base)
                if found is not None:
                    polygon.outline = found

            self._open.append(self._node.create_subscription(topic, _POLYGON, take))
        if own.flag("visualize"):
            topic = own.text("polygon_pub_topic") or polygon.name
            out = self._node.create_publisher(topic, message_type(_POLYGON))
            self._shown.append((polygon, out))

    def _hear(self, message: Any) -> None:
        twist = message.twist if self._stamped else message
        command = (float(twist.linear.x), float(twist.linear.y), float(twist.angular.z))
        if not all(map(math.isfinite, command)):
            self._node.log("error", f"a command that is no number is left out: {command}")
            return
        with self._lock:
            if self._is_active and self._out is not None:
                self._guard(command)

    def _guard(self, command: Velocity) -> None:
        now_ns = self._node.clock.now_ns()
        verdict = self._verdict(command, now_ns)
        if (verdict.polygon, verdict.action) != (self._last.polygon, self._last.action):
            self._tell(verdict)
        for polygon, out in self._shown:
            self._show(polygon, out, now_ns)
        if verdict.velocity == _STAND:
            if self._last.velocity != _STAND or not self._stopped_ns:
                self._stopped_ns = now_ns
            still_s = (now_ns - self._stopped_ns) / 1e9
            if still_s > self._settings.number("stop_pub_timeout"):
                self._last = verdict
                return
        self._last = verdict
        assert self._out is not None
        self._out.publish(*verdict.velocity, self._base)

    def _verdict(self, command: Velocity, now_ns: int) -> Verdict:
        if not self._is_on:
            return Verdict(command, Action.NONE, "")
        seen: dict[str, Points] = {}
        for source in self._sources:
            if not source.enabled:
                continue
            found = source.points(now_ns)
            if not isinstance(found, str):
                seen[source.options.name] = found
                continue
            self._frames.say("warn", f"[{source.options.name}]: {found}", source.options.name)
            if source.options.timeout_s > 0:
                return Verdict(_STAND, Action.STOP, _BLIND)
        return guarded(command, self._polygons, seen)

    def _tell(self, verdict: Verdict) -> None:
        """Say what happens now, once."""
        words = _WORDS[verdict.action]
        polygon = next((one for one in self._polygons if one.name == verdict.polygon), None)
        name = f"{verdict.polygon} polygon" if polygon is not None else verdict.polygon
        ratio = f"{100 * polygon.ratio:.3g} %" if polygon is not None else ""
        values = (ratio, name) if verdict.action is Action.SLOWDOWN else (name,)
        self._node.log("info", words.format(*values))
        if self._state_out is not None:
            kind = self._state_out.message_class
            state = kind(action_type=verdict.action.value, polygon_name=verdict.polygon)
            self._state_out.publish(state)

    def _show(self, polygon: Polygon, out: Any, now_ns: int) -> None:
        if not out.matched:
            return
        message = out.message_class()
        set_header(message, now_ns, self._base)
        point: Any = message_type("geometry_msgs/msg/Point32")
        message.polygon.points = [point(x=x, y=y) for x, y in polygon.corners()]
        out.publish(message)

    def _toggle(self, request: Any) -> Any:
        self._is_on = bool(request.enable)
        word = "on" if self._is_on else "off: commands pass as they are"
        self._node.log("info", f"collision monitor is {word}")
        response: Any = service_type("nav2_msgs/srv/Toggle").Response()
        response.success, response.message = True, word
        return response

    def _change(self, changes: dict[str, Any]) -> str:
        """Take ``<zone>.enabled`` and ``<sensor>.enabled`` while the node runs."""
        named: dict[str, Any] = {polygon.name: polygon for polygon in self._polygons}
        named.update((source.options.name, source) for source in self._sources)
        for key, value in changes.items():
            name, _, word = key.partition(".")
            if word != "enabled" or name not in named:
                return f"'{key}' is read at the start; only enabled of a zone or sensor changes"
            if not isinstance(value, bool):
                return f"'{key}' is {value!r}, not true or false"
        for key, value in changes.items():
            named[key.partition(".")[0]].enabled = value
        return ""
