"""``topic.plot``: numbers of messages over time, none left out."""

from __future__ import annotations

import threading
from collections import deque
from typing import Any, TypedDict

from gazelle.errors import GazelleError
from gazelle.studio.graph_view.curves import Curve, curves_of, read_number
from gazelle.studio.request_params import Params
from gazelle.studio.stamps import stamp_s
from gazelle.studio.streams import Channel, OpenStream
from gazelle.studio.subscriptions import Sample, Taps

__all__ = ["PlotCurves", "PlotPoints", "open_plot"]

_FIRST_MESSAGE_S = 3.0
_GATHER_S = 0.03


class PlotCurves(TypedDict):
    """What is told when the stream `topic.plot` is open: the names of its curves."""

    curves: list[str]


class PlotPoints(TypedDict):
    """New points of a curve.

    Attributes:
        curve: its place among the names.
        t: seconds.
        v: values; null for what is no number.
    """

    curve: int
    t: list[float]
    v: list[float | None]


def open_plot(taps: Taps, channel: Channel, params: Params) -> OpenStream:
    """Stream ``topic.plot``; ``opened.info`` names the curves."""
    looker = _Looker(taps)
    known = taps.node.graph.entities()
    curves: list[Curve] = []
    for name in params.texts("curves"):
        curves += [one for one in curves_of(name, known, looker.last) if one not in curves]
    plot = _Plot(taps, channel, curves)
    info: PlotCurves = {"curves": [one.name for one in curves]}
    return OpenStream(plot.close, info)


class _Looker:
    """Waits a moment for a topic's message, which tells how long its arrays are."""

    def __init__(self, taps: Taps) -> None:
        self._taps = taps

    def last(self, topic: str) -> Any:
        came = threading.Event()
        found: list[Sample] = []

        def take(sample: Sample) -> None:
            found.append(sample)
            came.set()

        end = self._taps.listen(topic, take)
        came.wait(_FIRST_MESSAGE_S)
        end()
        return found[0].message() if found else None


class _Plot:
    def __init__(self, taps: Taps, channel: Channel, curves: list[Curve]) -> None:
        self._taps = taps
        self._channel = channel
        self._curves = curves
        self._lock = threading.Lock()
        # Of two workers that empty the queue, the first one's points go out first.
        self._turn = threading.Lock()
        by_topic: dict[str, list[int]] = {}
        for index, curve in enumerate(curves):
            by_topic.setdefault(curve.topic, []).append(index)
        self._queue: deque[tuple[list[int], Sample]] = deque()
        self._ends = [self._listen(topic, places) for topic, places in by_topic.items()]

    def close(self) -> None:
        for end in self._ends:
            end()

    def _listen(self, topic: str, places: list[int]) -> Any:
        def take(sample: Sample) -> None:
            with self._lock:
                self._queue.append((places, sample))
                first = len(self._queue) == 1
            if first:
                self._channel.later(_GATHER_S, self._start)

        return self._taps.listen(topic, take)

    def _start(self) -> None:
        self._channel.work(self._drain)

    def _drain(self) -> None:
        with self._turn:
            self._send()

    def _send(self) -> None:
        with self._lock:
            queue, self._queue = self._queue, deque()
        times: dict[int, list[float]] = {}
        values: dict[int, list[float | None]] = {}
        for places, sample in queue:
            try:
                message = sample.message()
            except GazelleError as error:
                self._channel.status("error", str(error))
                continue
            at_s = stamp_s(message, sample.time_s)
            for place in places:
                times.setdefault(place, []).append(at_s)
                number = read_number(message, self._curves[place].steps)
                values.setdefault(place, []).append(number)
        for place in sorted(times):
            points: PlotPoints = {"curve": place, "t": times[place], "v": values[place]}
            self._channel.add(points)
