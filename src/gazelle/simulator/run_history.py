"""What joints and links did over a run, kept for plots; what else is asked for, from then on."""

from __future__ import annotations

import math
from array import array
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gazelle.simulator.scheduler import ORDER_STATE, Task, period_in_steps

if TYPE_CHECKING:
    from gazelle.simulator.world_server import WorldServer

__all__ = ["RunHistory", "Samples", "Track"]

_RATE_HZ = 50.0
_MAX_ROWS = 4096
_MAX_BYTES = 16 << 20
_MAX_SAMPLES = 200_000
_FIRST_ROWS = 256

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Samples:
    """Values over time.

    Attributes:
        times_s: (N,) simulated time, increasing.
        values: (N,) or (N, M); NaN where there was nothing.
    """

    times_s: Floats
    values: Floats


@dataclass(slots=True, eq=False)
class Track:
    """A number that is noted whenever it comes; of very many, every second one is dropped."""

    times_s: array[float] = field(default_factory=lambda: array("d"))
    values: array[float] = field(default_factory=lambda: array("d"))

    def note(self, time_s: float, value: float) -> None:
        """Add a value; what was noted of a later time belongs to a run that was reset."""
        if self.times_s and time_s < self.times_s[-1]:
            self.times_s, self.values = array("d"), array("d")
        self.times_s.append(time_s)
        self.values.append(value)
        if len(self.times_s) > _MAX_SAMPLES:
            self.times_s, self.values = self.times_s[::2], self.values[::2]

    def samples(self) -> Samples:
        """Return what was noted."""
        return Samples(np.array(self.times_s), np.array(self.values))


class RunHistory:
    """Joints' positions and velocities and links' poses over the whole run, coarser as it grows.

    A moment costs some microseconds, 50 times in a simulated second at first. When there are 4096
    of them every second one is dropped, and half as many are taken from then on.

    Attributes:
        tracks: what else is noted, by name.
    """

    def __init__(self, server: WorldServer) -> None:
        """Begin with the present moment."""
        self.tracks: dict[str, Track] = {}
        self._server = server
        self._ends: list[Callable[[], None]] = []
        self._revision = -1
        self._rows: NDArray[np.float64] = np.empty((0, 0))
        self._times_s: Floats = np.empty(0)
        self._count = 0
        self._joints: dict[str, tuple[int, int]] = {}
        self._links: dict[str, int] = {}
        self._older: list[_Stretch] = []
        period = period_in_steps(_RATE_HZ, server.engine.step_ns)
        self._task = server.scheduler.add(Task("history", period, self._take, ORDER_STATE))
        self._take()

    def joint(self, name: str) -> Samples | None:
        """Return position and velocity, (N, 2), of a ``model::joint``; None where it has none."""
        return self._gathered(lambda one: one.joint(name))

    def link(self, name: str) -> Samples | None:
        """Return x y z qx qy qz qw in the world, (N, 7), of a ``model::link``."""
        return self._gathered(lambda one: one.link(name))

    def follow(self, name: str, read: Callable[[], float], rate_hz: float = _RATE_HZ) -> None:
        """Note a number from now on, so many times in a simulated second."""
        track = self.tracks[name] = Track()
        server = self._server

        def take() -> None:
            track.note(server.time_ns * 1e-9, read())

        period = period_in_steps(rate_hz, server.engine.step_ns)
        task = server.scheduler.add(Task(f"plot of {name}", period, take, ORDER_STATE))
        self._ends.append(lambda: server.scheduler.remove(task))
        take()

    def listen(self, topic: str, take: Callable[[Any], None]) -> None:
        """Take the messages of a topic from now on."""
        made = self._server.node.create_subscription(topic, None, take, inline=True)
        self._ends.append(made.unregister)

    def close(self) -> None:
        """Note nothing any more."""
        self._server.scheduler.remove(self._task)
        for end in self._ends:
            end()
        self._ends.clear()

    def _take(self) -> None:
        engine = self._server.engine
        snapshot = engine.snapshot()
        if snapshot.revision != self._revision:
            self._begin_stretch(snapshot.link_names, snapshot.revision)
        time_s = snapshot.time_ns * 1e-9
        if self._count and time_s <= self._times_s[self._count - 1]:
            # The world was reset.
            self._count, self._older = 0, []
        if self._count == len(self._times_s):
            self._make_room()
        row, data = self._rows[self._count], engine.data
        size = 7 * len(self._links)
        row[:size] = snapshot.T.ravel()
        row[size : size + data.qpos.size] = data.qpos
        row[size + data.qpos.size :] = data.qvel
        self._times_s[self._count] = time_s
        self._count += 1

    def _begin_stretch(self, link_names: tuple[str, ...], revision: int) -> None:
        """Models have come or gone: rows have another form from here on."""
        engine = self._server.engine
        if self._count:
            self._older.append(self._stretch())
        self._revision = revision
        self._links = {name: place for place, name in enumerate(link_names)}
        size, data = 7 * len(link_names), engine.data
        handles = {name: engine.joint(name) for name in engine.joint_names}
        addresses = {name: one.addresses() for name, one in handles.items() if one.is_driveable}
        self._joints = {
            name: (size + position, size + data.qpos.size + velocity)
            for name, (position, velocity) in addresses.items()
        }
        width = size + data.qpos.size + data.qvel.size
        self._rows, self._times_s = np.empty((_FIRST_ROWS, width)), np.empty(_FIRST_ROWS)
        self._count = 0

    def _make_room(self) -> None:
        width = max(1, self._rows.shape[1])
        most = max(_FIRST_ROWS, min(_MAX_ROWS, _MAX_BYTES // (8 * width)))
        if self._count < most:
            more = min(2 * self._count, most)
            self._rows = np.concatenate([self._rows, np.empty((more - self._count, width))])
            self._times_s = np.concatenate([self._times_s, np.empty(more - self._count)])
            return
        half = math.ceil(self._count / 2)
        self._rows[:half] = self._rows[: self._count : 2].copy()
        self._times_s[:half] = self._times_s[: self._count : 2].copy()
        self._count = half
        self._older = [one.halved() for one in self._older]
        self._server.scheduler.change_period(self._task, 2 * self._task.period_steps)

    def _stretch(self) -> _Stretch:
        return _Stretch(
            self._times_s[: self._count].copy(),
            self._rows[: self._count].copy(),
            self._joints,
            self._links,
        )

    def _gathered(self, read: Callable[[_Stretch], Samples | None]) -> Samples | None:
        now = self._stretch()
        found = [one for one in map(read, (*self._older, now)) if one is not None]
        if not found:
            return None
        times = np.concatenate([one.times_s for one in found])
        return Samples(times, np.concatenate([one.values for one in found]))


@dataclass(frozen=True, slots=True, eq=False)
class _Stretch:
    """Rows of one form: poses of links, then positions, then velocities."""

    times_s: Floats
    rows: Floats
    joints: dict[str, tuple[int, int]]
    links: dict[str, int]

    def joint(self, name: str) -> Samples | None:
        place = self.joints.get(name)
        return None if place is None else Samples(self.times_s, self.rows[:, list(place)])

    def link(self, name: str) -> Samples | None:
        place = self.links.get(name)
        if place is None:
            return None
        return Samples(self.times_s, self.rows[:, 7 * place : 7 * place + 7])

    def halved(self) -> _Stretch:
        return _Stretch(self.times_s[::2], self.rows[::2], self.joints, self.links)
