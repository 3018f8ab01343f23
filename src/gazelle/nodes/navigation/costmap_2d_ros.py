"""A costmap that lives in a node: it listens to maps and sensors and follows the robot."""

from __future__ import annotations

import threading
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from gazelle.geometry import Pose
from gazelle.graph.tf import MessageFilter, TransformError
from gazelle.interfaces.stamps import ns_of
from gazelle.navigation.costmap import (
    CostGrid,
    Footprint,
    Observation,
    SourceOptions,
    StaticLayer,
    Window,
)
from gazelle.nodes.map_server.occupancy_grid import grid_of_message
from gazelle.nodes.navigation.costmap_from_parameters import Assembly
from gazelle.nodes.navigation.costmap_publisher import CostmapPublisher
from gazelle.nodes.navigation.observations import MESSAGE_TYPES, observation_of
from gazelle.nodes.navigation.robot_pose import Frames, PlanePose
from gazelle.nodes.parameters import ticks

if TYPE_CHECKING:
    from gazelle.graph import Node, Subscription

__all__ = ["Costmap2DRos"]

# As many wait for a lock, and, as in the originals, for tf.
_WAITING, _WAIT_FOR_TF = 20, 50
_NANO = 1_000_000_000
_LONG_WAIT_NS = _NANO
_LAST_UPDATE_S = 2.0


class Costmap2DRos:
    """Layers with their topics, updated by a thread of their own.

    Attributes:
        assembly: layers and parameters.
        frames: tf.
        lock: held while costs change; hold it to read them for longer than a moment.
        is_updating: costs are being computed; the first time kernels may have to be compiled.
    """

    def __init__(
        self,
        node: Node,
        frames: Frames,
        assembly: Assembly,
        publisher: CostmapPublisher,
        *,
        topics_in: str = "",
        refuses_late: bool = True,
    ) -> None:
        """Listen; nothing is updated before `start` or `update`.

        Args:
            node: the owner.
            frames: tf.
            assembly: layers and parameters.
            publisher: topics of the costmap itself.
            topics_in: namespace of maps and sensors, the node's own when empty.
            refuses_late: the robot's pose counts as not known where tf is late; see `Frames.robot`.
        """
        self.assembly = assembly
        self.frames = frames
        self.lock = threading.RLock()
        self.rests = False
        self.is_updating = False
        self._node = node
        self._topics_in = topics_in.rstrip("/")
        self._within = bool(topics_in)
        self._refuses_late = refuses_late
        self._publisher = publisher
        self._waiting: dict[tuple[str, str], MessageFilter[Observation | None]] = {}
        self._map_frame = ""
        self._subscriptions: list[Subscription] = []
        self._updated_ns: int | None = None
        self._changed: Window | None = None
        self._published_ns: int | None = None
        self._stop = threading.Event()
        self._thread: threading.Thread | None = None
        self._listen()

    @property
    def name(self) -> str:
        """What messages call it."""
        return self.assembly.settings.name

    @property
    def global_frame(self) -> str:
        """Frame of the costs."""
        return self.assembly.costmap.options.global_frame.removeprefix("/")

    @property
    def base_frame(self) -> str:
        """Frame of the robot."""
        return self.assembly.costmap.options.robot_base_frame.removeprefix("/")

    @property
    def grid(self) -> CostGrid:
        """The costs as they are; hold `lock`."""
        return self.assembly.costmap.grid

    @property
    def footprint(self) -> Footprint:
        """The robot's outline, padded."""
        return self.assembly.costmap.footprint

    def snapshot(self) -> CostGrid:
        """Return a copy of the costs."""
        with self.lock:
            grid = self.grid
            return CostGrid(grid.costs.copy(), grid.resolution_m, grid.origin)

    def raw_message(self) -> Any:
        """Return the costs as a ``nav2_msgs/Costmap``."""
        with self.lock:
            return self._publisher.raw_message(self.grid, self._node.clock.now_ns())

    def pose(self) -> PlanePose | None:
        """Return where the robot is in the costmap's frame; why not is said."""
        found = self.pose_or_why()
        return None if isinstance(found, str) else found

    def pose_or_why(self) -> PlanePose | str:
        """Return where the robot is in the costmap's frame, or why not; that is said."""
        tolerance = self.assembly.costmap.options.transform_tolerance
        found = self.frames.robot(
            self.global_frame, self.base_frame, tolerance, refuses_late=self._refuses_late
        )
        if isinstance(found, str):
            self.frames.say("warn", f"{self.name}: {found}", key=f"{self.name} pose", every_s=1.0)
            return found
        return found.pose

    def stale(self) -> list[str]:
        """Return what keeps the costmap from being current, in words."""
        now_ns = self._node.clock.now_ns()
        with self.lock:
            found = self.assembly.costmap.stale(now_ns)
        # Without a pose it never will be; that is told by who asks for the pose.
        if not self.is_ready and self.pose() is not None:
            found.append("it was not updated yet")
        return found

    @property
    def is_ready(self) -> bool:
        """True once it was updated with everything that its layers need."""
        return self._updated_ns is not None

    @property
    def has_begun(self) -> bool:
        """True once tf has the robot, however late, and the map came where one is needed."""
        if self.is_ready:
            return True
        T_global_base = self.frames.between(self.global_frame, self.base_frame)
        return not isinstance(T_global_base, str) and self._map_to_global() is not None

    def start(self) -> None:
        """Update at the costmap's rate from now on."""
        if self._thread is None:
            self._stop.clear()
            self._thread = threading.Thread(target=self._run, name=self.name, daemon=True)
            self._thread.start()

    def close(self) -> None:
        """Stop updating and listening."""
        self._stop.set()
        thread, self._thread = self._thread, None
        if thread is not None and thread is not threading.current_thread():
            # An update at work publishes at its end.
            thread.join(_LAST_UPDATE_S)
        for one in self._subscriptions:
            one.unregister()
        self._subscriptions.clear()
        self._publisher.close()

    def update(self) -> bool:
        """Take in what was seen; False while the robot's pose or the map is missing."""
        pose = self.pose()
        if pose is None:
            return False
        T_map_global = self._map_to_global()
        if T_map_global is None:
            return False
        now_ns = self._node.clock.now_ns()
        self.is_updating = True
        try:
            with self.lock:
                for source, held in self._waiting.items():
                    self._observe(source, held.ready())
                before = self.grid
                window = self.assembly.costmap.update(pose, now_ns, T_map_global)
                if window is not None:
                    whole = self.grid.whole if self.grid is not before else window
                    self._changed = whole if self._changed is None else self._changed.union(whole)
            self._updated_ns = now_ns
        finally:
            self.is_updating = False
        self._publish(pose, now_ns)
        return True

    def clear_around(
        self,
        size_m: float,
        *,
        layers: tuple[str, ...] | None = None,
        inside: bool = False,
        centre: PlanePose | None = None,
    ) -> bool:
        """Forget obstacles outside (or inside) of a square around the robot."""
        pose = centre or self.pose()
        if pose is None:
            return False
        with self.lock:
            self.assembly.costmap.clear(layers, pose, size_m, inside=inside)
        return True

    def reset(self) -> None:
        """Forget what sensors saw."""
        with self.lock:
            self.assembly.costmap.reset()
            for held in self._waiting.values():
                held.clear()

    def set_footprint(self, footprint: Footprint) -> None:
        """Give the robot another outline; padding is added."""
        padding = self.assembly.costmap.options.footprint_padding
        with self.lock:
            self.assembly.base_footprint = footprint
            self.assembly.costmap.footprint = footprint.padded(padding)

    def _run(self) -> None:
        while not self._stop.is_set() and not self._node.closed:
            rate = max(self.assembly.costmap.options.update_frequency, 0.1)
            for _now_ns in ticks(self._node, int(_NANO / rate), self._stop):
                if not self.rests:
                    self.update()
                if self.assembly.costmap.options.update_frequency != rate:
                    break
            else:
                return

    def _listen(self) -> None:
        for (owner, name), source in self.assembly.sources.items():
            kind = MESSAGE_TYPES.get(source.data_type)
            if kind is None:
                known = ", ".join(MESSAGE_TYPES)
                text = (
                    f"{self.name}/{owner}/{name}: data_type '{source.data_type}' is none of {known}"
                )
                self._node.log("error", f"{text}; the sensor is left out")
                continue
            place, drop = partial(self._placed, source), partial(self._drop, source)
            self._waiting[owner, name] = MessageFilter(place, drop, size=_WAIT_FOR_TF)
            self._subscribe(source.topic, kind, partial(self._on_seen, (owner, name)))
        for layer in self.assembly.costmap.layers:
            if isinstance(layer, StaticLayer):
                topic = layer.options.map_topic or "map"
                self._subscribe(topic, "nav_msgs/msg/OccupancyGrid", self._on_map)
                if layer.options.subscribe_to_updates:
                    kind = "map_msgs/msg/OccupancyGridUpdate"
                    self._subscribe(f"{topic}_updates", kind, self._on_map_update)

    def _subscribe(self, topic: str, kind: str, callback: Callable[[Any], None]) -> None:
        name = self._topic(topic)
        made = self._node.create_subscription(name, kind, callback, queue_size=_WAITING)
        self._subscriptions.append(made)

    def _topic(self, name: str) -> str:
        """Return a topic's name; Nav2's costmaps look for relative ones beside their servers."""
        is_relative = self._within and not name.startswith(("/", "~"))
        return f"{self._topics_in}/{name}" if is_relative else name

    def _on_map(self, message: Any) -> None:
        info = message.info
        try:
            grid = grid_of_message(message)
        except ValueError as error:
            self._node.log("error", f"{self.name}: the map is left out: {error}")
            return
        x, y, yaw = grid.origin
        if abs(yaw) > 1e-6:
            text = f"the map's origin is turned by {yaw:.3f} rad; costmaps ignore that, as ROS's do"
            self._node.log("warn", f"{self.name}: {text}")
            grid = replace(grid, origin=(x, y, 0.0))
        with self.lock:
            self._map_frame = str(message.header.frame_id).removeprefix("/") or self.global_frame
            self.assembly.costmap.set_static_map(grid)
        size = f"{info.width} X {info.height} map at {info.resolution:f} m/pix"
        self._node.log("info", f"{self.name}: Received a {size}")

    def _on_map_update(self, message: Any) -> None:
        cells = np.asarray(message.data, np.int8).reshape(int(message.height), int(message.width))
        with self.lock:
            self.assembly.costmap.update_static_map(int(message.x), int(message.y), cells)

    def _map_to_global(self) -> PlanePose | None:
        """Return the costmap's frame in the map's; None while it is needed and not known."""
        statics = [one for one in self.assembly.costmap.layers if isinstance(one, StaticLayer)]
        if not any(one.options.enabled for one in statics):
            return (0.0, 0.0, 0.0)
        if not self._map_frame:
            topic = self._topic(statics[0].options.map_topic or "map")
            text = f"{self.name}: waits for a map on topic {self._node.resolve_name(topic)}"
            self.frames.say("warn", f"{text}; map_server or SLAM publishes one")
            return None
        if self._map_frame == self.global_frame:
            return (0.0, 0.0, 0.0)
        found = self.frames.between(self._map_frame, self.global_frame)
        if isinstance(found, str):
            self.frames.say("warn", f"{self.name}: the map is in frame {self._map_frame}: {found}")
            return None
        return found.xy_yaw

    def _on_seen(self, source: tuple[str, str], message: Any) -> None:
        """Take a sensor's message in as soon as tf knows where it was taken."""
        if self.rests:
            return
        with self.lock:
            held = self._waiting[source]
            self._observe(source, held.add(message))
            oldest = held.oldest
        if oldest is not None:
            waited_ns = self._node.clock.now_ns() - ns_of(oldest[0].header.stamp)
            if waited_ns > _LONG_WAIT_NS:
                self._tell_of_tf(self.assembly.sources[source], *oldest)

    def _observe(self, source: tuple[str, str], seen: list[Observation | None]) -> None:
        layer, name = source
        now_ns = self._node.clock.now_ns()
        for one in seen:
            if one is not None:
                self.assembly.costmap.observe(name, one, layer, heard_ns=now_ns)

    def _placed(self, source: SourceOptions, message: Any) -> Observation | None:
        """Return what a message shows, None where there is something wrong with it."""
        stamp_ns = ns_of(message.header.stamp)
        frame = str(message.header.frame_id).removeprefix("/")
        lookup = self.frames.buffer.lookup_transform
        T_global_frame = lookup(self.global_frame, frame, stamp_ns).pose
        origin: Pose | None = None
        if source.sensor_frame and source.sensor_frame != frame:
            origin = lookup(self.global_frame, source.sensor_frame, stamp_ns).pose
        try:
            return observation_of(
                message, T_global_frame, origin=origin, inf_is_valid=source.inf_is_valid
            )
        except ValueError as error:
            self.frames.say("error", f"{self.name}: {source.topic}: {error}")
            return None

    def _drop(self, source: SourceOptions, message: Any, why: TransformError) -> None:
        # What was seen before tf began is missed by nobody.
        if self.is_ready:
            self._tell_of_tf(source, message, why)

    def _tell_of_tf(self, source: SourceOptions, message: Any, why: TransformError) -> None:
        frame = str(message.header.frame_id).removeprefix("/")
        text = f"a {source.data_type} of frame '{frame}' on {source.topic} cannot be used: {why}"
        key = f"{self.name} {source.topic}"
        self.frames.say("warn", f"{self.name}: {text}", key=key, every_s=1.0)

    def _publish(self, pose: PlanePose, now_ns: int) -> None:
        frequency = self.assembly.costmap.options.publish_frequency
        last_ns = self._published_ns
        if frequency <= 0:
            return
        if last_ns is not None and 0 <= now_ns - last_ns < int(_NANO / frequency) - 1_000_000:
            return
        self._published_ns = now_ns
        with self.lock:
            changed, self._changed = self._changed, None
            options = self.assembly.costmap.options
            self._publisher.publish(
                self.grid, changed, now_ns, always_full=options.always_send_full_costmap
            )
            corners = self.footprint.at(pose)
        self._publisher.publish_footprint(corners, now_ns)

    def change(self, values: dict[str, Any]) -> None:
        """Take new values of the costmap's own parameters."""
        with self.lock:
            options = self.assembly.costmap.options
            known = {key: value for key, value in values.items() if hasattr(options, key)}
            self.assembly.costmap.options = replace(options, **known)

    def layer_changer(self, name: str) -> Callable[[dict[str, Any]], None]:
        """Return what takes new values of a layer's parameters."""
        return lambda values: self.change_layer(name, values)

    def change_layer(self, name: str, values: dict[str, Any]) -> None:
        """Take new values of a layer's parameters."""
        with self.lock:
            for layer in self.assembly.costmap.layers:
                if layer.name == name:
                    known = {k: v for k, v in values.items() if hasattr(layer.options, k)}
                    layer.options = replace(layer.options, **known)
