"""``topic.plot``: numbers of messages over time, none left out.

What is plotted has a name such as ``/odom/twist/twist/linear/x``, which says how to read it.
"""

from __future__ import annotations

import math
import re
import threading
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from typing import Any, NamedTuple, TypedDict

from gazelle.diagnostics import nearest_names
from gazelle.errors import GazelleError
from gazelle.graph import ANY_TYPE, Entity, Kind
from gazelle.interfaces import RosVersion, definition
from gazelle.interfaces.definition import FORMATS, Array, Field, attribute_name
from gazelle.studio.errors import StudioError
from gazelle.studio.request_params import Params
from gazelle.studio.streams import Channel, OpenStream
from gazelle.studio.subscriptions import Sample, Subscriptions, stamp_s

__all__ = ["Curve", "PlotCurves", "PlotPoints", "curves_of", "open_plot", "read_number"]

_MAX_ITEMS = 50
_STEP = re.compile(r"(\w+)((?:\[\d+\])*)")
_INDEX = re.compile(r"\[(\d+)\]")
_SKIPPED = (
    "std_msgs/msg/Header",
    "builtin_interfaces/msg/Time",
    "builtin_interfaces/msg/Duration",
)
Step = str | int
_FIRST_MESSAGE_S = 3.0
_GATHER_S = 0.03


class Curve(NamedTuple):
    """One plotted value.

    Attributes:
        name: as the legend has it, ``/joint_states/position[0]``.
        topic: where it comes from.
        steps: attributes and indices down to the number.
    """

    name: str
    topic: str
    steps: tuple[Step, ...]


def curves_of(
    name: str, known: Iterable[Entity], last_message: Callable[[str], Any]
) -> list[Curve]:
    """Return the curves that a name stands for; a message stands for all its numbers.

    Args:
        name: topic and fields; array items as ``[0]`` or ``/0``.
        known: what is on the graph.
        last_message: a topic's newest message or None, which tells how long its arrays are.

    Raises:
        StudioError: there is no such topic or field, nothing in it is a number, or no message has
            come that tells how many there are.
    """
    topic, type_name, rest = _split(name, known)
    steps, field = _walk(name, type_name, rest)
    message = last_message(topic) if field is None or _is_open(field) else None
    found = list(_numbers(topic, type_name, steps, field, message))
    if not found and field is not None and message is None and _is_open(field):
        later = f"try again when {topic} has had a message"
        is_list = field.type.array is Array.SEQUENCE
        raise StudioError(
            f"'{name}': no message has come yet that says how many items it has",
            hint=f"name one, {name}[0], or {later}" if is_list else later,
        )
    if not found:
        raise StudioError(f"'{name}': nothing in it is a number")
    return found


def read_number(message: Any, steps: tuple[Step, ...]) -> float | None:
    """Return a curve's value in a message; None for what is missing or no finite number."""
    value = message
    for step in steps:
        if isinstance(step, int):
            if step >= len(value):
                return None
            value = value[step]
        else:
            value = getattr(value, step)
    number = float(value)
    return number if math.isfinite(number) else None


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


def open_plot(subscriptions: Subscriptions, channel: Channel, params: Params) -> OpenStream:
    """Stream ``topic.plot``; ``opened.info`` names the curves."""
    looker = _Looker(subscriptions)
    known = subscriptions.node.graph.entities()
    curves: list[Curve] = []
    for name in params.texts("curves"):
        curves += [one for one in curves_of(name, known, looker.last) if one not in curves]
    plot = _Plot(subscriptions, channel, curves)
    info: PlotCurves = {"curves": [one.name for one in curves]}
    return OpenStream(plot.close, info)


class _Looker:
    """Waits a moment for a topic's message, which tells how long its arrays are."""

    def __init__(self, subscriptions: Subscriptions) -> None:
        self._subscriptions = subscriptions

    def last(self, topic: str) -> Any:
        came = threading.Event()
        found: list[Sample] = []

        def take(sample: Sample) -> None:
            found.append(sample)
            came.set()

        end = self._subscriptions.listen(topic, take)
        came.wait(_FIRST_MESSAGE_S)
        end()
        return found[0].message() if found else None


class _Plot:
    def __init__(self, subscriptions: Subscriptions, channel: Channel, curves: list[Curve]) -> None:
        self._subscriptions = subscriptions
        self._channel = channel
        self._curves = curves
        self._lock = threading.Lock()
        # Of two workers that empty the queue, the first one's points go out first.
        self._turn = threading.Lock()
        by_topic: dict[str, list[int]] = {}
        for index, curve in enumerate(curves):
            by_topic.setdefault(curve.topic, []).append(index)
        self._queue: deque[tuple[list[int], Sample]] = deque()
        self._ends = [self._listen(topic, indices) for topic, indices in by_topic.items()]

    def close(self) -> None:
        for end in self._ends:
            end()

    def _listen(self, topic: str, indices: list[int]) -> Any:
        def take(sample: Sample) -> None:
            with self._lock:
                self._queue.append((indices, sample))
                first = len(self._queue) == 1
            if first:
                self._channel.later(_GATHER_S, self._start)

        return self._subscriptions.listen(topic, take)

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
        for indices, sample in queue:
            try:
                message = sample.message()
            except GazelleError as error:
                self._channel.status("error", str(error))
                continue
            at_s = stamp_s(message, sample.time_s)
            for index in indices:
                times.setdefault(index, []).append(at_s)
                number = read_number(message, self._curves[index].steps)
                values.setdefault(index, []).append(number)
        for index in sorted(times):
            points: PlotPoints = {"curve": index, "t": times[index], "v": values[index]}
            self._channel.add(points)


def _split(name: str, known: Iterable[Entity]) -> tuple[str, str, list[str]]:
    types = {
        one.name: one.type_name
        for one in known
        if one.kind in (Kind.PUBLISHER, Kind.SUBSCRIPTION) and one.type_name != ANY_TYPE
    }
    parts = name.strip("/").split("/")
    for count in range(len(parts), 0, -1):
        topic = "/" + "/".join(parts[:count])
        if topic in types:
            return topic, types[topic], parts[count:]
    near = nearest_names(name, types)
    hint = "" if types else "no topic is there yet"
    raise StudioError(f"'{name}': there is no such topic", hint=hint, known=near)


def _walk(name: str, type_name: str, parts: list[str]) -> tuple[tuple[Step, ...], Field | None]:
    """Follow fields; returns the steps and the field they end at, None for the message itself."""
    steps: list[Step] = []
    field: Field | None = None
    owner = type_name
    for part in parts:
        if part.isdigit() and field is not None and field.type.array is not Array.ONE:
            steps.append(int(part))
            field = _item(field)
            continue
        match = _STEP.fullmatch(part)
        fields = {one.name: one for one in definition(owner, RosVersion.ROS2).fields}
        if match is None or match[1] not in fields or (field and not field.type.is_message):
            near = nearest_names(part, fields)
            known = near or tuple(fields)
            raise StudioError(f"'{name}': {owner} has no field '{part}'", known=known)
        field = fields[match[1]]
        steps.append(attribute_name(match[1]))
        for index in _INDEX.findall(match[2]):
            steps.append(int(index))
            field = _item(field)
        owner = field.type.base if field.type.is_message else owner
    return tuple(steps), field


def _item(field: Field) -> Field:
    return field._replace(type=field.type._replace(array=Array.ONE))


def _is_open(field: Field) -> bool:
    return field.type.is_message or field.type.array is Array.SEQUENCE


def _numbers(
    name: str, type_name: str, steps: tuple[Step, ...], field: Field | None, message: Any
) -> Iterator[Curve]:
    topic = name
    label = name + _label(steps)
    value = _value(message, steps)
    if field is None:
        yield from _inside(topic, type_name, steps, message)
    elif field.type.array is not Array.ONE:
        count = field.type.size if field.type.array is Array.FIXED else _length(value)
        for index in range(min(count, _MAX_ITEMS)):
            yield from _numbers(topic, type_name, (*steps, index), _item(field), message)
    elif field.type.is_message:
        yield from _inside(topic, field.type.base, steps, message)
    elif field.type.base in FORMATS:
        yield Curve(label, topic, steps)


def _inside(topic: str, owner: str, steps: tuple[Step, ...], message: Any) -> Iterator[Curve]:
    for one in definition(owner, RosVersion.ROS2).fields:
        if one.type.base not in _SKIPPED:
            yield from _numbers(topic, owner, (*steps, attribute_name(one.name)), one, message)


def _label(steps: tuple[Step, ...]) -> str:
    return "".join(f"[{step}]" if isinstance(step, int) else f"/{step}" for step in steps)


def _value(message: Any, steps: tuple[Step, ...]) -> Any:
    for step in steps:
        if message is None or (isinstance(step, int) and step >= len(message)):
            return None
        message = message[step] if isinstance(step, int) else getattr(message, step)
    return message


def _length(value: Any) -> int:
    return 0 if value is None else len(value)
