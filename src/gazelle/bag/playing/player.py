"""Publishes the messages of bags at the times they were recorded.

Messages are chosen, put in order, converted to CDR and read ahead of the time when they are due.
"""

from __future__ import annotations

import heapq
import sys
import threading
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from queue import Queue
from typing import Any, NamedTuple

from gazelle.bag.message_definitions import TextShare
from gazelle.bag.playing.controls import Controls
from gazelle.bag.rosbag2.metadata import read_qos
from gazelle.bag.storage import BagMessage, BagReader, Connection, Encoding
from gazelle.bag.types import bag_types, converter, wire_name_of
from gazelle.errors import GazelleError
from gazelle.graph import Node, Publisher
from gazelle.interfaces import TypeStore, message_type
from gazelle.interfaces.stamps import set_stamp

__all__ = ["PlayOptions", "Player", "Timeline", "ahead", "outgoing"]

_READ_AHEAD = 200
_MAX_WAIT_S = 0.05
_SWITCH_S = 0.0002
_LAST_PART_NS = 1_000_000
_CLOCK = "rosgraph_msgs/msg/Clock"


class _Outgoing(NamedTuple):
    """A message that is ready to be published."""

    bag_number: int
    connection: Connection
    stamp_ns: int
    data: bytes


class Timeline:
    """Maps stamps to the wall's clock, at a rate; it can be held and shifted.

    Attributes:
        rate: seconds of the bag in a second.
    """

    def __init__(
        self, start_ns: int, rate: float, now_ns: Callable[[], int] = time.monotonic_ns
    ) -> None:
        """Start now at a stamp."""
        self.rate = rate
        self._now_ns = now_ns
        self._stamp_ns = start_ns
        self._wall_ns = now_ns()
        self._held = False

    @property
    def held(self) -> bool:
        """Whether time stands still."""
        return self._held

    def wait_ns(self, stamp_ns: int) -> int:
        """Return how long it is until a stamp is due; not positive when it is."""
        due_ns = self._wall_ns + int((stamp_ns - self._stamp_ns) / self.rate)
        return due_ns - self._now_ns()

    def stamp_ns(self) -> int:
        """Return the stamp that is due now."""
        if self._held:
            return self._stamp_ns
        return self._stamp_ns + int((self._now_ns() - self._wall_ns) * self.rate)

    def hold(self, stamp_ns: int | None = None) -> None:
        """Stand still, at a stamp or at that of now."""
        self._stamp_ns = self.stamp_ns() if stamp_ns is None else stamp_ns
        self._held = True

    def go_on(self) -> None:
        """Run from where it was held."""
        self._wall_ns = self._now_ns()
        self._held = False

    def jump(self, stamp_ns: int) -> None:
        """Be at a stamp now."""
        self._stamp_ns, self._wall_ns = stamp_ns, self._now_ns()

    def set_rate(self, rate: float) -> None:
        """Go on from now at another rate."""
        self.jump(self.stamp_ns())
        self.rate = rate


@dataclass(frozen=True, slots=True)
class PlayOptions:
    """How bags are played.

    Attributes:
        rate: seconds of the bag in a second.
        start_s: where to start, from the beginning.
        duration_s: how much to play, None for all.
        skip_empty_s: gaps longer than this are skipped, None for none.
        immediate: do not wait between messages.
        last_only: at once, and of every topic the last message only.
        clock_hz: how often ``/clock`` is published, 0 for not at all.
        topics: only these, all when empty.
        pause_topics: pause when one of these comes.
        prefix: in front of every topic.
    """

    rate: float = 1.0
    start_s: float = 0.0
    duration_s: float | None = None
    skip_empty_s: float | None = None
    immediate: bool = False
    last_only: bool = False
    clock_hz: float = 0.0
    topics: frozenset[str] = frozenset()
    pause_topics: frozenset[str] = frozenset()
    prefix: str = ""


class Player:
    """Plays bags on a node's graph.

    Attributes:
        timeline: when a stamp is due.
        start_ns: stamp of the beginning.
        length_ns: how long the bags are.
    """

    def __init__(
        self,
        node: Node,
        bags: Sequence[BagReader],
        options: PlayOptions,
        controls: Controls,
        say: Callable[[str, str], None],
        show: Callable[[Player, str, int], None],
    ) -> None:
        """Announce the topics.

        Args:
            node: publishes; its remaps apply.
            bags: played together.
            options: how.
            controls: pause, step, stop.
            say: called with level and text of what goes wrong.
            show: called with this, ``RUNNING``, ``PAUSED`` or ``DELAYED``, and the stamp of now.
        """
        self._node = node
        self._bags = bags
        self._options = options
        self._controls = controls
        self._say = say
        self._show = show
        summaries = [one.summary for one in bags]
        filled = [one for one in summaries if one.messages] or summaries
        self.start_ns = min(one.start_ns for one in filled)
        self.length_ns = max(one.end_ns for one in filled) - self.start_ns
        self.timeline = Timeline(self.start_ns, options.rate)
        self._publishers: dict[tuple[int, int], Publisher] = {}
        self._clock: Publisher | None = None
        self._clock_ns = 0
        self._types = tuple(bag_types(one.connections).store for one in bags)
        self._texts = TextShare(node.graph, self._types)
        self._announce()

    @property
    def publishers(self) -> tuple[Publisher, ...]:
        """One for every topic."""
        return tuple(dict.fromkeys(self._publishers.values()))

    def play(self) -> None:
        """Publish everything once."""
        usual_s = sys.getswitchinterval()
        # The thread that reads ahead must not keep this one waiting for 5 ms at a time.
        sys.setswitchinterval(_SWITCH_S)
        try:
            self._play()
        finally:
            sys.setswitchinterval(usual_s)

    def _play(self) -> None:
        options = self._options
        start_ns = self.start_ns + int(options.start_s * 1e9)
        end_ns = None
        if options.duration_s is not None:
            end_ns = start_ns + int(options.duration_s * 1e9)
        if options.last_only:
            self._publish_last(start_ns, end_ns)
            return
        self.timeline = Timeline(start_ns, options.rate)
        self._clock_ns = 0
        if self._controls.paused:
            self.timeline.hold(start_ns)
        last_ns = start_ns
        for one in ahead(self._outgoing(start_ns, end_ns)):
            gap_s = (one.stamp_ns - last_ns) / 1e9
            if options.immediate or (
                options.skip_empty_s is not None and gap_s > options.skip_empty_s
            ):
                self.timeline.jump(one.stamp_ns)
            if not self._wait_for(one.stamp_ns):
                return
            self._publish(one)
            last_ns = one.stamp_ns

    def _outgoing(self, start_ns: int, end_ns: int | None) -> Iterator[_Outgoing]:
        return outgoing(self._bags, self._wants, start_ns, end_ns, self._on_unread, self._types)

    def _publish_last(self, start_ns: int, end_ns: int | None) -> None:
        last: dict[str, _Outgoing] = {}
        for one in self._outgoing(start_ns, end_ns):
            if self._controls.stopped:
                return
            last[one.connection.topic] = one
        for one in last.values():
            self._publish(one)

    def tick(self) -> None:
        """Publish ``/clock`` when it is due again."""
        if self._clock is None:
            return
        stamp_ns = self.timeline.stamp_ns()
        period_ns = int(1e9 / self._options.clock_hz * self.timeline.rate)
        if self._clock_ns - 2 * period_ns > stamp_ns or stamp_ns >= self._clock_ns:
            # On a grid, so that being late once does not make all later ones late.
            due_ns = self._clock_ns + period_ns
            near = stamp_ns < due_ns < stamp_ns + 2 * period_ns
            self._clock_ns = due_ns if near else stamp_ns + period_ns
            message = self._clock.message_class()
            set_stamp(message.clock, stamp_ns)
            self._clock.publish(message)

    def _wait_for(self, stamp_ns: int) -> bool:
        """Wait until a stamp is due; False when told to stop."""
        controls, timeline = self._controls, self.timeline
        while not controls.stopped:
            if controls.paused != timeline.held:
                if timeline.held:
                    timeline.go_on()
                else:
                    timeline.hold()
            self.tick()
            if timeline.held:
                if controls.take_step():
                    timeline.hold(stamp_ns)
                    self.tick()
                    return True
                self._show(self, "PAUSED", timeline.stamp_ns())
                controls.wait(_MAX_WAIT_S)
                continue
            wait_ns = timeline.wait_ns(stamp_ns)
            if wait_ns <= 0:
                return True
            self._show(self, "RUNNING", timeline.stamp_ns())
            self._sleep(wait_ns)
        return False

    def _sleep(self, wait_ns: int) -> None:
        if self._options.clock_hz:
            wait_ns = min(wait_ns, max(self.timeline.wait_ns(self._clock_ns), 0))
        # Waits on a condition are late by up to a millisecond on a busy machine; short ones less.
        rest_ns = wait_ns - _LAST_PART_NS if wait_ns > 2 * _LAST_PART_NS else wait_ns
        self._controls.wait(min(rest_ns / 1e9, _MAX_WAIT_S))

    def _publish(self, one: _Outgoing) -> None:
        publisher = self._publishers.get((one.bag_number, one.connection.id))
        if publisher is not None:
            publisher.publish_raw(one.data)
        self._show(self, "PAUSED" if self.timeline.held else "RUNNING", one.stamp_ns)
        if one.connection.topic in self._options.pause_topics:
            self._controls.pause(True)

    def _announce(self) -> None:
        made: dict[tuple[str, str, str, bool], Publisher] = {}
        for bag_number, bag in enumerate(self._bags):
            for one in filter(self._wants, bag.connections):
                latched = one.latching or read_qos(one.qos).latched
                topic = f"{self._options.prefix}{one.topic}"
                try:
                    name, types = wire_name_of(one), self._types[bag_number]
                    kind: Any = types.message_type(name)
                    # Bags may define a type of one name differently.
                    key = (topic, name, types.type_hash(name), latched)
                    if key not in made:
                        made[key] = self._node.create_publisher(
                            topic, kind, latch=latched, queue_size=100
                        )
                except GazelleError as error:
                    self._on_unread(one, error)
                else:
                    self._publishers[bag_number, one.id] = made[key]
        if self._options.clock_hz:
            self._clock = self._node.create_publisher("/clock", message_type(_CLOCK))

    def _wants(self, one: Connection) -> bool:
        topics = self._options.topics
        own_clock = one.topic == "/clock" and self._options.clock_hz > 0
        return (not topics or one.topic in topics) and not own_clock

    def _on_unread(self, one: Connection, error: GazelleError) -> None:
        text = f"topic {one.topic} ({one.type_name}) is not played: {error}"
        self._say("error", f"{text} [bag.not-converted]")


def outgoing(
    bags: Sequence[BagReader],
    wanted: Callable[[Connection], bool],
    start_ns: int,
    end_ns: int | None,
    on_error: Callable[[Connection, GazelleError], None],
    types: Sequence[TypeStore] = (),
) -> Iterator[_Outgoing]:
    """Yield the messages of several bags by stamp, in CDR.

    Args:
        bags: where they come from.
        wanted: which connections.
        start_ns: stamp of the first.
        end_ns: stamp of the last, None for the end.
        on_error: told once of each connection whose messages cannot be read; they are left out.
        types: of each bag; the process's own when empty.
    """
    streams = [
        _converted(
            index, bag.messages(wanted, start_ns, end_ns), on_error, types[index] if types else None
        )
        for index, bag in enumerate(bags)
    ]
    return heapq.merge(*streams, key=lambda one: one.stamp_ns)


def ahead(items: Iterable[_Outgoing]) -> Iterator[_Outgoing]:
    """Yield the same, read by another thread so that reading costs no punctuality."""
    queue: Queue[Any] = Queue(_READ_AHEAD)
    ended = threading.Event()

    def fill() -> None:
        try:
            for item in items:
                queue.put(item)
                if ended.is_set():
                    return
            queue.put(None)
        except Exception as error:  # noqa: BLE001 - raised again where the items are taken
            queue.put(error)

    threading.Thread(target=fill, name="bag reader", daemon=True).start()
    try:
        while (item := queue.get()) is not None:
            if isinstance(item, Exception):
                raise item
            yield item
    finally:
        ended.set()
        while not queue.empty():
            queue.get()


def _converted(
    bag_number: int,
    messages: Iterable[BagMessage],
    on_error: Callable[[Connection, GazelleError], None],
    types: TypeStore | None,
) -> Iterator[_Outgoing]:
    converters: dict[int, Callable[[bytes], bytes] | None] = {}
    for one, stamp_ns, data in messages:
        try:
            if one.id not in converters:
                converters[one.id] = None
                converters[one.id] = converter(one, Encoding.CDR, types)
            convert = converters[one.id]
            if convert is not None:
                yield _Outgoing(bag_number, one, stamp_ns, convert(data))
        except GazelleError as error:
            converters[one.id] = None
            on_error(one, error)
