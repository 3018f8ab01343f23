"""A recording as a value."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from gazelle.description.model import World

__all__ = ["Recording", "Stretch", "TopicTrack", "WorldMoment", "robot_names"]

_NS = 1e-9


class WorldMoment(NamedTuple):
    """Where the links of a world are; `gazelle.sensors.RayScene.update` takes it.

    Attributes:
        link_names: ``model::link``, one per row of `T`.
        T: (N, 7): x y z in metres, qx qy qz qw, of each link in the world.
    """

    link_names: Sequence[str]
    T: NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Stretch:
    """A time in which the same models were there.

    Attributes:
        world: what was there.
        link_names: ``model::link``.
        times_ns: (T,) simulated times, rising.
        poses: (T, N, 7) float32: x y z in metres, qx qy qz qw, of each link in the world.
    """

    world: World
    link_names: tuple[str, ...]
    times_ns: NDArray[np.int64]
    poses: NDArray[np.float32]

    def moment(self, time_ns: int) -> WorldMoment:
        """Return where all links are at a time, between two recorded ones in proportion."""
        after = int(np.searchsorted(self.times_ns, time_ns))
        last = len(self.times_ns) - 1
        if after > last or self.times_ns[after] == time_ns or after == 0:
            return WorldMoment(self.link_names, self.poses[min(after, last)].astype(np.float64))
        begin, end = self.times_ns[after - 1 : after + 1]
        share = float(time_ns - begin) / float(end - begin)
        first, second = self.poses[after - 1 : after + 1].astype(np.float64)
        return WorldMoment(self.link_names, _between(first, second, share))


@dataclass(frozen=True, slots=True, eq=False)
class TopicTrack:
    """What came on a topic.

    Attributes:
        name: global name.
        type_name: ``pkg/msg/Name``.
        times_ns: (M,) simulated times.
        messages: as they came.
    """

    name: str
    type_name: str
    times_ns: NDArray[np.int64]
    messages: tuple[Any, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Recording:
    """What happened in a world.

    Attributes:
        stretches: in the order of time; each ends where the next begins.
        topics: sorted by name.
    """

    stretches: tuple[Stretch, ...]
    topics: tuple[TopicTrack, ...] = ()

    @property
    def start_ns(self) -> int:
        """Simulated time of the first moment."""
        return int(self.stretches[0].times_ns[0])

    @property
    def end_ns(self) -> int:
        """Simulated time of the last moment."""
        return int(self.stretches[-1].times_ns[-1])

    @property
    def start_s(self) -> float:
        """Simulated time of the first moment."""
        return self.start_ns * _NS

    @property
    def duration_s(self) -> float:
        """How much simulated time it holds."""
        return (self.end_ns - self.start_ns) * _NS

    def part(self, start_s: float = 0.0, duration_s: float | None = None) -> Recording:
        """Return a part of it; of each topic the last message before it comes along.

        Args:
            start_s: simulated seconds behind this recording's start.
            duration_s: simulated seconds; None for all that follows.

        Raises:
            ValueError: it holds nothing there.
        """
        begin = self.start_ns + round(start_s * 1e9)
        end = self.end_ns if duration_s is None else begin + round(duration_s * 1e9)
        if start_s < 0.0 or begin > self.end_ns or end < begin:
            raise ValueError(
                f"the recording holds {self.duration_s:g} s of simulated time, so there is "
                f"nothing {start_s:g} s behind its start"
            )
        stretches = tuple(
            cut for one in self.stretches if len((cut := _cut_stretch(one, begin, end)).times_ns)
        )
        if not stretches:
            moment = self.stretch_at(begin)
            stretches = (_still(moment, begin),)
        return Recording(stretches, tuple(_cut_track(one, begin, end) for one in self.topics))

    def stretch_at(self, time_ns: int) -> Stretch:
        """Return the stretch a time falls into, the first or last one outside of all."""
        begun = [one for one in self.stretches if one.times_ns[0] <= time_ns]
        return begun[-1] if begun else self.stretches[0]


def robot_names(world: World) -> tuple[str, ...]:
    """Return the models that are taken for robots: of several links, and not static."""
    return tuple(one.name for one in world.models if not one.static and len(one.links) > 1)


def _between(
    first: NDArray[np.float64], second: NDArray[np.float64], share: float
) -> NDArray[np.float64]:
    """Return poses between two: straight ways, turns by the shorter one."""
    dots = (first[:, 3:] * second[:, 3:]).sum(axis=1)
    near = np.where(dots < 0.0, -1.0, 1.0)
    mixed = first + share * (second - first)
    quats = first[:, 3:] + share * (near[:, None] * second[:, 3:] - first[:, 3:])
    mixed[:, 3:] = quats / np.linalg.norm(quats, axis=1, keepdims=True)
    return mixed


def _cut_stretch(one: Stretch, begin: int, end: int) -> Stretch:
    inside = (one.times_ns >= begin) & (one.times_ns <= end)
    return replace(one, times_ns=one.times_ns[inside], poses=one.poses[inside])


def _still(one: Stretch, time_ns: int) -> Stretch:
    poses = one.moment(time_ns).T.astype(np.float32)[None]
    return replace(one, times_ns=np.array([time_ns], np.int64), poses=poses)


def _cut_track(one: TopicTrack, begin: int, end: int) -> TopicTrack:
    first = max(0, int(np.searchsorted(one.times_ns, begin, "right")) - 1)
    last = int(np.searchsorted(one.times_ns, end, "right"))
    times = np.maximum(one.times_ns[first:last], begin)
    return replace(one, times_ns=times, messages=one.messages[first:last])
