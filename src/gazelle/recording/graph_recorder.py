"""Recording a world that runs elsewhere, over the graph, as Studio looks at it."""

from __future__ import annotations

import json
import threading
import time
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, Self

from gazelle.errors import GazelleError
from gazelle.graph import ANY_TYPE, Graph, RawMessage
from gazelle.interfaces import from_cdr, message_type
from gazelle.recording.recording import Recording
from gazelle.recording.tape import Known, Tape, is_recorded

if TYPE_CHECKING:
    from gazelle.graph import Subscription

__all__ = ["GraphRecorder", "NoWorldError"]

_SCENE = "/_gazelle/scene"
_TRACK = "/_gazelle/track"
_POSES = "/_gazelle/poses"
# The clock of the graph tells when a message came, as far as it is the world's.
_SAME_CLOCK_NS = 1_000_000_000


class NoWorldError(GazelleError):
    """Nobody on the graph simulates a world."""


class GraphRecorder:
    """Records the world of a graph and its topics, from `__init__` to `stop`.

    Where time stands still, so does the recording; `poll` takes up topics that are new.
    """

    def __init__(self, graph: Graph, *, topics: Sequence[str] | None = None) -> None:
        """Join as a node of a name of its own.

        Args:
            graph: where the world is.
            topics: which; all but pictures and clouds when None.
        """
        self._graph = graph
        self._tape = Tape()
        self._node = graph.create_node("_record", anonymous=True, rosout=False, is_ros2=True)
        graph.clock.follow(self._node)
        self._wanted = None if topics is None else tuple(map(self._node.resolve_name, topics))
        self._subscriptions: dict[str, Subscription] = {}
        self._changed = threading.Condition()
        subscribe = self._node.create_subscription
        subscribe(_SCENE, "std_msgs/String", self._take_scene, inline=True)
        subscribe(_TRACK, "gazelle_msgs/Frames", self._take_track, inline=True)
        self._still = subscribe(_POSES, "gazelle_msgs/Frames", self._take_still, inline=True)
        self.poll()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *exc_info: object) -> None:
        self.stop()

    @property
    def seconds(self) -> float:
        """How much simulated time was recorded."""
        return self._tape.seconds

    @property
    def has_begun(self) -> bool:
        """Whether there is a moment of the world."""
        return self._tape.moments > 0

    @property
    def topics(self) -> tuple[str, ...]:
        """What is subscribed."""
        return tuple(self._subscriptions)

    def poll(self, timeout_s: float = 0.0) -> None:
        """Take up topics that are new, and wait until something was recorded or time is up."""
        for one in self._graph.topics():
            is_known = one.name in self._subscriptions or one.type_name == ANY_TYPE
            if not is_known and is_recorded(one.name, one.type_name, self._wanted):
                self._subscriptions[one.name] = self._node.create_subscription(
                    one.name, None, self._taker(one.name), raw=True, inline=True
                )
        with self._changed:
            self._changed.wait(timeout_s)

    def wait_for_world(self, timeout_s: float) -> bool:
        """Wait for the first moment of a world; tell whether it came."""
        end_s = time.monotonic() + timeout_s
        while not self.has_begun and (left_s := end_s - time.monotonic()) > 0:
            self.poll(min(left_s, 0.1))
        return self.has_begun

    def recording(self) -> Recording:
        """Return what was recorded up to now.

        Raises:
            NoWorldError: nothing was.
        """
        found = self._tape.recording(_decoded)
        if found is None:
            raise NoWorldError(
                f"nobody simulates a world on the graph of port {self._graph.port}: no moment of "
                "one came\n  fix: start one, e.g. gazelle roslaunch PACKAGE FILE.launch, or name "
                "the launch file here: gazelle record -o OUT PACKAGE FILE.launch"
            )
        return found

    def stop(self) -> None:
        """Leave the graph, which stays open; what was recorded stays."""
        self._node.shutdown()

    def _take_scene(self, message: Any) -> None:
        # The reader of scenes loads no meshes: a scene is read in milliseconds.
        value = json.loads(message.data)
        names = tuple(body["name"] for body in value["bodies"])

        def world() -> Any:
            from gazelle.sensors.scene_json_reader import world_of_value

            return world_of_value(value)

        self._tape.know(value["version"], Known(world, names))

    def _take_track(self, message: Any) -> None:
        poses = message.values.reshape(-1, message.width)
        self._tape.add_moment(message.version, round(message.stamp * 1e9), poses)
        with self._changed:
            self._changed.notify_all()

    def _take_still(self, message: Any) -> None:
        """Take one look at a world that may stand still: nothing comes on the track then."""
        if not self.has_begun:
            self._take_track(message)

    def _taker(self, name: str) -> Callable[[RawMessage], None]:
        def take(raw: RawMessage) -> None:
            if not self.has_begun:
                # Latched maps and descriptions come first of all.
                self._tape.add_message(name, raw.type_name, 0, raw)
                return
            now_ns, clock_ns = self._tape.now_ns, self._node.clock.now_ns()
            is_same = abs(clock_ns - now_ns) < _SAME_CLOCK_NS
            self._tape.add_message(name, raw.type_name, clock_ns if is_same else now_ns, raw)

        return take


def _decoded(raw: RawMessage) -> Any:
    return from_cdr(message_type(raw.type_name), raw.data)
