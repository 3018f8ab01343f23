"""Topics for viewers: the scene at each change, poses and other moving things by the wall clock."""

from __future__ import annotations

import json
import threading
import time
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, TypedDict

import numpy as np
from numpy.typing import NDArray

from gazelle.errors import GazelleError
from gazelle.interfaces import message_type
from gazelle.simulator.gui.fields import Fields
from gazelle.simulator.gui.gz_topics import GzTopics
from gazelle.simulator.gui.requests import Requests
from gazelle.simulator.scheduler import ORDER_STATE, period_in_steps

if TYPE_CHECKING:
    from gazelle.engine import Engine
    from gazelle.simulator.gui.gz_topics import GzTopics
    from gazelle.simulator.plugins.context import Resources
    from gazelle.simulator.world_server import WorldServer

__all__ = ["Broadcast", "WorldStats", "moving_joints", "offer_views"]


def moving_joints(engine: Engine) -> tuple[str, ...]:
    """Return the joints with one position each, ``model::joint``, as the scene value has them."""
    return tuple(name for name in engine.joint_names if engine.joint(name).is_driveable)


_FRAME_S = 1.0 / 30.0

# Every so many frames.
_STATS_EVERY = 6

_JOINTS_EVERY = 3

# What stands still is told again now and then, for those who have just come.
_REPEAT_EVERY = 30

_SCENE_WAIT_S = 1.0

# Of simulated time: whoever records wants exact times, however fast the world runs.
_TRACK_HZ = 50.0

Floats = NDArray[np.float32]


class WorldStats(TypedDict):
    """How a world's time goes.

    Attributes:
        rtf: simulated per real time; 0 while it is paused.
        wanted_rtf: null for as fast as it goes.
        step_s: a step of the physics.
        version: of the scene.
    """

    sim_s: float
    real_s: float
    rtf: float
    wanted_rtf: float | None
    paused: bool
    step_s: float
    iterations: int
    version: int


class Broadcast:
    """Asks for a look at the world 30 times a second of real time, while somebody listens.

    The look itself is a command like any other: it happens between two steps, in the thread that
    owns the world, also while time stands still.
    """

    def __init__(self, server: WorldServer, resources: Resources) -> None:
        """Offer the topics; nothing is sent before `start`."""
        self._server = server
        self._scene = resources.publisher("/_gazelle/scene", "std_msgs/String", latch=True)
        self._stats = resources.publisher("/_gazelle/stats", "std_msgs/String", reliable=False)
        frames = "gazelle_msgs/Frames"
        self._poses = resources.publisher("/_gazelle/poses", frames, reliable=False)
        self._contacts = resources.publisher("/_gazelle/contacts", frames, reliable=False)
        self._joints = resources.publisher("/_gazelle/joints", frames, reliable=False)
        self._track = resources.publisher("/_gazelle/track", frames)
        resources.task(
            "/_gazelle/track",
            period_in_steps(_TRACK_HZ, server.engine.step_ns),
            self._send_track,
            order=ORDER_STATE,
            wanted=lambda: self._track.matched,
        )
        self._gz: GzTopics | None = None
        self._ended = threading.Event()
        self._looking = threading.Event()
        self._version = 0
        self._shown: tuple[int, object] | None = None
        self._count = 0
        self._last_poses: Floats | None = None
        self._pace = _Pace()

    def start(self) -> None:
        """Publish the scene and begin to look."""
        self._server.commands.post(self._show_scene)
        threading.Thread(target=self._run, name="gazelle-views", daemon=True).start()

    def tell_gz(self, topics: GzTopics) -> None:
        """Publish what a world of the new Gazebo does, too: statistics 5 times a second."""
        self._gz = topics

    def touch(self) -> None:
        """Have the scene sent again: something that it shows was changed."""
        self._shown = None

    def close(self) -> None:
        """Look no more."""
        self._ended.set()

    def _run(self) -> None:
        while not self._ended.wait(_FRAME_S):
            # One look at a time: a world that is busy is not sent a queue of them.
            if not self._looking.is_set():
                self._looking.set()
                self._server.commands.post(self._look)

    def _look(self) -> None:
        try:
            self._count += 1
            self._show_scene()
            if self._poses.matched:
                self._send_poses()
            if self._gz is not None:
                self._gz.send_poses()
            if self._contacts.matched:
                self._send(self._contacts, self._contact_rows())
            if self._count % _JOINTS_EVERY == 0 and self._joints.matched:
                self._send(self._joints, self._joint_rows())
            if self._count % _STATS_EVERY == 0:
                self._send_statistics()
        finally:
            self._looking.clear()

    def _show_scene(self) -> None:
        engine = self._server.engine
        now = (engine.revision, self._server.sensors.lights)
        if self._shown == now or not (self._scene.matched or self._shown is None):
            return
        from gazelle.sensors.scene_json import light_value, world_value

        self._version += self._shown is None or self._shown[0] != now[0] or self._version == 0
        self._shown = now
        value = world_value(engine.world, version=self._version)
        value["lights"] = [light_value(light) for light in self._server.sensors.lights]
        value["moving"] = list(moving_joints(engine))
        self._scene.publish(_text(value))
        self._last_poses = None

    def _send_poses(self) -> None:
        poses = self._server.engine.snapshot().T.astype(np.float32)
        known = self._last_poses
        if (
            known is not None
            and self._count % _REPEAT_EVERY
            and poses.shape == known.shape
            and bool((poses == known).all())
        ):
            return
        self._last_poses = poses
        self._send(self._poses, poses)

    def _send_track(self) -> None:
        """Tell of poses at an exact simulated time, after the scene that they belong to."""
        self._show_scene()
        self._send(self._track, self._server.engine.snapshot().T.astype(np.float32))

    def _contact_rows(self) -> Floats:
        rows = [
            np.concatenate((contact.points_m, contact.normals, contact.depths_m[:, None]), axis=1)
            for contact in self._server.engine.contacts()
        ]
        return np.concatenate(rows).astype(np.float32) if rows else np.zeros((0, 7), np.float32)

    def _joint_rows(self) -> Floats:
        engine = self._server.engine
        handles = [engine.joint(name) for name in moving_joints(engine)]
        rows = [(one.position, one.velocity, one.effort) for one in handles]
        return np.array(rows, np.float32).reshape(-1, 3)

    def _send(self, publisher: Any, rows: Floats) -> None:
        publisher.publish(
            message_type("gazelle_msgs/Frames")(
                stamp=self._server.time_ns * 1e-9,
                version=self._version,
                width=rows.shape[1],
                values=rows.ravel(),
            )
        )

    def _send_statistics(self) -> None:
        for_gz = self._gz if self._gz is not None and self._gz.wants_statistics() else None
        if for_gz is None and not self._stats.matched:
            return
        value = self._statistics()
        if self._stats.matched:
            self._stats.publish(_text(value))
        if for_gz is not None:
            for_gz.send_statistics(value)

    def _statistics(self) -> WorldStats:
        server = self._server
        real_s, factor = self._pace.look(server.time_ns)
        return {
            "sim_s": server.time_ns * 1e-9,
            "real_s": real_s,
            "rtf": 0.0 if server.paused else factor,
            "wanted_rtf": server.pace.factor,
            "paused": server.paused,
            "step_s": server.engine.step_ns * 1e-9,
            "iterations": server.engine.iteration,
            "version": self._version,
        }


class _Pace:
    """How fast simulated time goes, between two looks."""

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self._start_s = self._last_s = clock()
        self._last_ns = 0

    def look(self, time_ns: int) -> tuple[float, float]:
        """Return real seconds since the start, and simulated per real time since the last look."""
        now_s = self._clock()
        passed_s = now_s - self._last_s
        factor = max(0.0, (time_ns - self._last_ns) * 1e-9 / passed_s) if passed_s > 0 else 0.0
        self._last_s, self._last_ns = now_s, time_ns
        return now_s - self._start_s, factor


def _text(value: Mapping[str, Any]) -> Any:
    return message_type("std_msgs/String")(data=json.dumps(value))


def offer_views(server: WorldServer, *, is_gz: bool = False) -> None:
    """Publish ``/_gazelle/*`` while somebody looks, and answer ``/_gazelle/do``.

    A world of the new Gazebo (`is_gz`) has its statistics, clock and poses under ``/world/NAME``.

    Nothing is computed for a topic that nobody listens to.
    """
    resources = server.world_resources
    broadcast = Broadcast(server, resources)
    if is_gz:
        broadcast.tell_gz(GzTopics(server, resources))
    requests = Requests(server, broadcast.touch)

    def answer(request: Any, response: Any) -> None:
        response.response = json.dumps(_answer(requests, request.request))

    resources.service("/_gazelle/do", "gazelle_msgs/Do", answer)
    resources.on_close(broadcast.close)
    broadcast.start()


def _answer(requests: Requests, text: str) -> dict[str, Any]:
    try:
        return {"value": requests.handle(Fields.read(text))}
    except GazelleError as error:
        return {"error": {"message": str(error)}}
