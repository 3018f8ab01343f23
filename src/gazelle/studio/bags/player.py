"""``bag.open`` … ``bag.close``: one bag, played with a timeline."""

from __future__ import annotations

import threading
from collections.abc import Callable
from pathlib import Path
from typing import TypedDict

from gazelle.bag import open_bag
from gazelle.bag.playing import Controls, Player, PlayOptions
from gazelle.bag.storage import BagReader
from gazelle.graph import Graph, Node
from gazelle.studio.errors import StudioError

__all__ = ["BagTopic", "PlayerState", "Playing"]

_LAST_LOOK_S = 2.0
_CLOCK_HZ = 100.0


class BagTopic(TypedDict):
    """A topic of a bag."""

    name: str
    type: str
    count: int


class PlayerState(TypedDict):
    """A bag that is open; seconds of its stamps.

    Attributes:
        problems: what could not be published.
    """

    path: str
    playing: bool
    rate: float
    begin_s: float
    end_s: float
    time_s: float
    topics: list[BagTopic]
    problems: list[str]


class Playing:
    """The bag of a graph's pages; all pages see and steer the same one."""

    def __init__(self, graph: Graph) -> None:
        """Have no bag open; it is played on a graph."""
        self._graph = graph
        self._lock = threading.RLock()
        self._bag: BagReader | None = None
        self._node: Node | None = None
        self._rate = 1.0
        self._clock = False
        self._held_s: float = 0.0
        self._controls: Controls | None = None
        self._player: Player | None = None
        self._thread: threading.Thread | None = None
        self.problems: list[str] = []

    def open(self, path: str) -> None:
        """Open a bag, in the place of the one that is.

        Raises:
            BagError: it cannot be read.
        """
        bag = open_bag(Path(path).expanduser())
        with self._lock:
            self.close()
            self._bag, self._held_s, self.problems = bag, 0.0, []
            self._node = self._graph.create_node("play", anonymous=True, rosout=False)

    def close(self) -> None:
        """Close the bag and forget its topics."""
        with self._lock:
            self._stop()
            node, bag = self._node, self._bag
            self._node = self._bag = None
        if node is not None:
            node.shutdown()
        if bag is not None:
            bag.close()

    def play(self, *, clock: bool) -> None:
        """Play on from where it stands; from the beginning at the end.

        Args:
            clock: publish ``/clock`` too, for nodes under ``use_sim_time``.

        Raises:
            StudioError: no bag is open.
        """
        with self._lock:
            bag, _ = self._opened()
            self._clock = clock
            if self._time_s() >= bag.summary.duration_ns * 1e-9:
                self._held_s = 0.0
            self._start(self._held_s)

    def pause(self) -> None:
        """Stand still where it is."""
        with self._lock:
            self._opened()
            self._held_s = self._time_s()
            self._stop()

    def seek(self, time_s: float) -> None:
        """Go to a stamp; standing still, the last message of each topic before it is published.

        Args:
            time_s: stamp in the bag, seconds since 1970.

        Raises:
            StudioError: no bag is open.
        """
        with self._lock:
            bag, _ = self._opened()
            length_s = bag.summary.duration_ns * 1e-9
            offset_s = min(max(0.0, time_s - bag.summary.start_ns * 1e-9), length_s)
            was_playing = self._is_playing()
            self._stop()
            self._held_s = offset_s
            if was_playing:
                self._start(offset_s)
            else:
                self._start(max(0.0, offset_s - _LAST_LOOK_S), until_s=offset_s)

    def set_rate(self, rate: float) -> None:
        """Play faster or slower from now on."""
        with self._lock:
            self._rate = rate
            if self._is_playing():
                self._held_s = self._time_s()
                self._start(self._held_s)

    def state(self) -> PlayerState | None:
        """Return what the page shows; None without a bag."""
        with self._lock:
            bag = self._bag
            if bag is None:
                return None
            begin_s, end_s = bag.summary.start_ns * 1e-9, bag.summary.end_ns * 1e-9
            return {
                "path": str(bag.path),
                "playing": self._is_playing(),
                "rate": self._rate,
                "begin_s": begin_s,
                "end_s": end_s,
                "time_s": begin_s + self._time_s(),
                "topics": _topics(bag),
                "problems": self.problems,
            }

    def _opened(self) -> tuple[BagReader, Node]:
        if self._bag is None or self._node is None:
            raise StudioError("no bag is open", hint="open one first")
        return self._bag, self._node

    def _start(self, start_s: float, *, until_s: float | None = None) -> None:
        """Play from a time on in a thread; up to a time it is done at once, as scrubbing wants."""
        self._stop()
        bag, node = self._opened()
        options = PlayOptions(
            rate=self._rate,
            start_s=start_s,
            duration_s=None if until_s is None else until_s - start_s,
            last_only=until_s is not None,
            clock_hz=_CLOCK_HZ if self._clock and until_s is None else 0.0,
        )
        controls = Controls()
        player = Player(node, [bag], options, controls, self._say, lambda *_: None)
        self._controls = controls
        self._player = player if until_s is None else None
        self._thread = threading.Thread(
            target=_run, args=(player, self._ended), name="bag player", daemon=True
        )
        self._thread.start()

    def _stop(self) -> None:
        controls, thread = self._controls, self._thread
        self._controls = self._thread = self._player = None
        if controls is not None:
            controls.stop()
        if thread is not None and thread is not threading.current_thread():
            thread.join()

    def _ended(self, player: Player) -> None:
        """The player's thread: hold where it ended, unless it was told to."""
        controls = self._controls
        if self._player is player and controls is not None and not controls.stopped:
            self._held_s = player.length_ns * 1e-9
            self._player = None

    def _is_playing(self) -> bool:
        return self._player is not None and self._thread is not None and self._thread.is_alive()

    def _time_s(self) -> float:
        player = self._player
        if player is None or not self._is_playing():
            return self._held_s
        now_s = (player.timeline.stamp_ns() - player.start_ns) * 1e-9
        return min(max(now_s, 0.0), player.length_ns * 1e-9)

    def _say(self, level: str, text: str) -> None:
        if level in ("warn", "error"):
            self.problems.append(text)


def _run(player: Player, ended: Callable[[Player], None]) -> None:
    try:
        player.play()
    finally:
        ended(player)
        for publisher in player.publishers:
            publisher.unregister()


def _topics(bag: BagReader) -> list[BagTopic]:
    counts: dict[tuple[str, str], int] = {}
    for one in bag.connections:
        key = (one.topic, one.type_name)
        counts[key] = counts.get(key, 0) + bag.summary.counts.get(one.id, 0)
    return [
        {"name": topic, "type": kind, "count": count}
        for (topic, kind), count in sorted(counts.items())
    ]
