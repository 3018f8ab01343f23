"""What recorders write on: moments of a world and messages, as they come."""

from __future__ import annotations

import threading
from collections.abc import Callable, Hashable, Sequence
from itertools import groupby
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from gazelle.description.model import World
from gazelle.errors import GazelleError
from gazelle.graph.names import is_hidden
from gazelle.recording.recording import Recording, Stretch, TopicTrack

__all__ = ["Known", "Tape", "is_recorded"]

_SHORTEST_GAP_NS = 12_000_000
"""Of one topic; faster ones are thinned out."""

# Topics with several publishers, of which each message counts, however close they are.
_WHOLE = frozenset({"tf2_msgs/msg/TFMessage", "tf/msg/tfMessage", "rcl_interfaces/msg/Log"})
_LEFT_OUT = frozenset(
    {
        "bond/msg/Status",
        "dynamic_reconfigure/msg/Config",
        "dynamic_reconfigure/msg/ConfigDescription",
        "gazebo_msgs/msg/LinkStates",
        "gazebo_msgs/msg/ModelStates",
        "rcl_interfaces/msg/ParameterEvent",
        "rosgraph_msgs/msg/Clock",
        "sensor_msgs/msg/CameraInfo",
        "sensor_msgs/msg/CompressedImage",
        "sensor_msgs/msg/Image",
        "sensor_msgs/msg/PointCloud",
        "sensor_msgs/msg/PointCloud2",
        "stereo_msgs/msg/DisparityImage",
        "theora_image_transport/msg/Packet",
        "visualization_msgs/msg/Marker",
        "visualization_msgs/msg/MarkerArray",
    }
)
"""Pictures and clouds make a simulator work that nobody looks at; poses are recorded as such."""

# All that is on /rosout comes there once more.
_AGAIN = "/rosout_agg"

Decode = Callable[[Any], Any]


def is_recorded(topic: str, type_name: str, wanted: Sequence[str] | None) -> bool:
    """Tell whether a topic is recorded.

    Args:
        topic: global name.
        type_name: ``pkg/msg/Name``.
        wanted: names asked for; None for all but pictures, clouds and hidden ones.
    """
    if wanted is not None:
        return topic in wanted
    return not (is_hidden(topic) or type_name in _LEFT_OUT or topic == _AGAIN)


class Known(NamedTuple):
    """A world that moments are of.

    Attributes:
        world: makes it; asked for once, when the recording is.
        link_names: in the order of the moments' rows.
    """

    world: Callable[[], World]
    link_names: tuple[str, ...]


class _Moment(NamedTuple):
    world: Hashable
    time_ns: int
    poses: NDArray[np.float32]


class Tape:
    """Moments and messages in the order they came; may be written and read from any thread.

    Time that goes back, as after a reset, goes on here: a recording has no time twice.
    """

    def __init__(self) -> None:
        """Hold nothing."""
        self._lock = threading.Lock()
        self._worlds: dict[Hashable, Known] = {}
        self._moments: list[_Moment] = []
        self._topics: dict[tuple[str, str], list[tuple[int, Any]]] = {}
        self._shift_ns = 0

    @property
    def moments(self) -> int:
        """How many there are."""
        return len(self._moments)

    @property
    def seconds(self) -> float:
        """How much simulated time there is."""
        with self._lock:
            moments = self._moments
            return (moments[-1].time_ns - moments[0].time_ns) * 1e-9 if moments else 0.0

    @property
    def now_ns(self) -> int:
        """Time of the last moment on the recording's own scale, 0 before the first."""
        with self._lock:
            return self._moments[-1].time_ns if self._moments else 0

    def knows(self, world: Hashable) -> bool:
        """Tell whether a world was named."""
        return world in self._worlds

    def know(self, world: Hashable, known: Known) -> None:
        """Name a world; moments of it may come before."""
        with self._lock:
            self._worlds[world] = known

    def add_moment(self, world: Hashable, time_ns: int, poses: NDArray[np.floating[Any]]) -> None:
        """Write where the links of a world are; one of the time of the last replaces it."""
        with self._lock:
            moments, at_ns = self._moments, time_ns + self._shift_ns
            if moments and at_ns < moments[-1].time_ns:
                self._shift_ns = moments[-1].time_ns - time_ns
                at_ns = moments[-1].time_ns
            if moments and moments[-1].time_ns == at_ns:
                moments.pop()
            moments.append(_Moment(world, at_ns, np.array(poses, np.float32)))

    def add_message(self, topic: str, type_name: str, time_ns: int, message: Any) -> None:
        """Write a message; what comes faster than 80 times a second is thinned out."""
        with self._lock:
            track = self._topics.setdefault((topic, type_name), [])
            at_ns = max(time_ns + self._shift_ns, track[-1][0] if track else 0)
            is_thin = not track or at_ns - track[-1][0] >= _SHORTEST_GAP_NS
            if is_thin or type_name in _WHOLE:
                track.append((at_ns, message))

    def recording(self, decode: Decode = lambda message: message) -> Recording | None:
        """Return what is there; None before the first moment of a world that was named.

        Args:
            decode: makes messages of what was written; what it raises leaves a topic out.
        """
        with self._lock:
            worlds = dict(self._worlds)
            moments = [one for one in self._moments if one.world in worlds]
            topics = {key: list(track) for key, track in self._topics.items()}
        stretches = tuple(
            _stretch(worlds[key], list(group)) for key, group in groupby(moments, _world_of)
        )
        if not stretches:
            return None
        first_ns, last_ns = stretches[0].times_ns[0], stretches[-1].times_ns[-1]
        tracks = []
        for (name, type_name), track in sorted(topics.items()):
            within = [(min(at_ns, last_ns), one) for at_ns, one in track]
            times = np.array([max(at_ns, first_ns) for at_ns, _ in within], np.int64)
            try:
                messages = tuple(decode(message) for _, message in within)
            except GazelleError:
                continue
            tracks.append(TopicTrack(name, type_name, times, messages))
        return Recording(stretches, tuple(tracks))


def _world_of(moment: _Moment) -> Hashable:
    return moment.world


def _stretch(known: Known, moments: list[_Moment]) -> Stretch:
    names = known.link_names
    fitting = [one for one in moments if len(one.poses) == len(names)]
    times = np.array([one.time_ns for one in fitting], np.int64)
    poses = np.array([one.poses for one in fitting], np.float32).reshape(-1, len(names), 7)
    return Stretch(known.world(), names, times, poses)
