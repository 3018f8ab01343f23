"""What the page publishes: single messages, joint states of sliders, and ``publisher.*``.

Those are publishers that go on by themselves, with values that follow expressions.
"""

from __future__ import annotations

import threading
import time
from collections import OrderedDict
from typing import Any, TypedDict

from gazelle.errors import GazelleError
from gazelle.graph import Node, Publisher
from gazelle.interfaces import Message, message_type
from gazelle.interfaces.definition import FORMATS, Array, Field, attribute_name
from gazelle.interfaces.stamps import set_stamp
from gazelle.studio.errors import StudioError, unknown
from gazelle.studio.graph_view.expressions import Expression, expression
from gazelle.studio.graph_view.message_forms import filled
from gazelle.studio.pages import Pages
from gazelle.studio.request_params import Params
from gazelle.studio.subscriptions import topic_name

__all__ = [
    "Outbox",
    "PublisherCount",
    "PublisherRow",
    "Publishers",
    "list_publishers",
    "publish",
    "publish_joints",
    "remove_publisher",
    "set_publisher",
]

_KEPT = 32
_MATCH_S = 1.0
_SUBSCRIBER_LOOK_S = 0.005
_TOPIC = "/joint_states"
_MAX_PUBLISHERS = 100
_ALONE_S = 10.0
_LOOK_S = 0.2


def publish(outbox: Outbox, params: Params) -> dict[str, Any]:
    """``topic.publish``."""
    message_class = message_type(params.text("type"))
    message = filled(message_class, params.object("message", {}), outbox.node.clock.now_ns())
    outbox.publisher(params.text("topic"), message_class).publish(message)
    return {}


class Outbox:
    """Publishers that stay for the next message: a new one is heard only after a moment.

    Attributes:
        node: who publishes.
    """

    def __init__(self, node: Node) -> None:
        """Publish as `node`."""
        self.node = node
        self._lock = threading.Lock()
        self._kept: OrderedDict[tuple[str, str], Publisher] = OrderedDict()

    def publisher(self, topic: str, message_class: Any) -> Publisher:
        """Return the publisher of a topic; a new one has met those who listen already."""
        topic = topic_name(self.node, topic)
        key = (topic, message_class.TYPE_NAME)
        with self._lock:
            found = self._kept.get(key)
            if found is None:
                found = self._kept[key] = self.node.create_publisher(topic, message_class)
                self._wait_for_match(found)
            self._kept.move_to_end(key)
            while len(self._kept) > _KEPT:
                self._kept.popitem(last=False)[1].unregister()
            return found

    def _wait_for_match(self, publisher: Publisher) -> None:
        deadline_s = time.monotonic() + _MATCH_S
        pause = threading.Event()
        while not publisher.matched and time.monotonic() < deadline_s:
            if not self.node.graph.subscription_count(publisher.topic):
                return
            pause.wait(_SUBSCRIBER_LOOK_S)


def publish_joints(outbox: Outbox, params: Params) -> dict[str, Any]:
    """``joints.publish``: one ``sensor_msgs/JointState`` of now."""
    names, positions = params.texts("names"), params.numbers("positions")
    if len(names) != len(positions):
        raise StudioError(f"{len(names)} names and {len(positions)} positions do not go together")
    message_class = message_type("sensor_msgs/msg/JointState")
    message = message_class(name=names, position=positions)
    stamp = message.header.stamp
    set_stamp(stamp, outbox.node.clock.now_ns())
    outbox.publisher(params.text("topic", _TOPIC), message_class).publish(message)
    return {}


class PublisherCount(TypedDict):
    """How many messages a publisher has sent."""

    count: int


class _PublisherState(PublisherCount):
    topic: str
    type: str
    rate_hz: float
    message: dict[str, Any]
    expressions: dict[str, Any]
    enabled: bool
    error: str


class PublisherRow(_PublisherState):
    """A publisher that goes on by itself.

    Attributes:
        id: chosen by the page.
        expressions: by the path of a number in the message.
        error: why it went off by itself, empty while nothing is wrong.
    """

    id: str


def set_publisher(publishers: Publishers, params: Params) -> PublisherCount:
    """``publisher.set``: make or change one."""
    return publishers.set(params)


def remove_publisher(publishers: Publishers, params: Params) -> dict[str, Any]:
    """``publisher.remove``."""
    publishers.remove(params.text("id"))
    return {}


def list_publishers(publishers: Publishers, _params: Params) -> list[PublisherRow]:
    """``publisher.list``."""
    return publishers.rows()


class Publishers:
    """All of a graph's pages; they stop when no page has been there for ten seconds."""

    def __init__(self, node: Node, pages: Pages) -> None:
        """Publish as a node, for pages that may go."""
        self._node = node
        self._pages = pages
        self._lock = threading.Lock()
        self._made: dict[str, _Repeater] = {}
        self._closed = threading.Event()
        threading.Thread(target=self._watch, name="studio publishers", daemon=True).start()

    def set(self, params: Params) -> PublisherCount:
        """Make or change one."""
        name = params.text("id")
        with self._lock:
            old = self._made.get(name)
            if old is None and len(self._made) >= _MAX_PUBLISHERS:
                raise StudioError(f"there are {_MAX_PUBLISHERS} publishers already")
            settings = _Settings(params, old.settings if old else None)
            settings.check(self._node)
            if old is not None and old.settings.end == settings.end:
                old.apply(settings)
                return {"count": old.count}
            if old is not None:
                old.close()
            made = self._made[name] = _Repeater(self._node, settings)
            return {"count": made.count}

    def remove(self, name: str) -> None:
        """Stop one and forget it."""
        with self._lock:
            found = self._made.pop(name, None)
            if found is None:
                raise unknown("publisher", name, self._made)
        found.close()

    def rows(self) -> list[PublisherRow]:
        """Return what they do."""
        with self._lock:
            return [{"id": name, **one.row()} for name, one in self._made.items()]

    def close(self) -> None:
        """Stop all."""
        self._closed.set()
        with self._lock:
            made, self._made = self._made, {}
        for one in made.values():
            one.close()

    def _watch(self) -> None:
        """A robot must not go on driving when the page that drives it has gone."""
        seen_s = time.monotonic()
        while not self._closed.wait(_LOOK_S):
            if len(self._pages):
                seen_s = time.monotonic()
            elif time.monotonic() - seen_s > _ALONE_S:
                with self._lock:
                    for one in self._made.values():
                        one.disable()


class _Settings:
    """What a publisher is to do; what a change does not name stays as it was."""

    def __init__(self, params: Params, old: _Settings | None) -> None:
        named = {name: value for name, value in params.values.items() if value is not None}
        given: dict[str, Any] = (old.given if old else {}) | named
        self.given: dict[str, Any] = given
        wanted = Params(params.where, given)
        self.topic = wanted.text("topic")
        self.rate_hz = wanted.number("rate_hz", 1.0, least=0, most=1000)
        self.values = wanted.object("message", {})
        self.expressions = wanted.object("expressions", {})
        self.enabled = wanted.flag("enabled", False)
        self.message_class = message_type(wanted.text("type"))
        self.compiled = [
            (_place(self.message_class, path), _compiled(path, text))
            for path, text in self.expressions.items()
            if text not in ("", None)
        ]

    @property
    def end(self) -> tuple[str, str]:
        """What a publisher is made for."""
        return self.topic, self.message_class.TYPE_NAME

    def check(self, node: Node) -> None:
        """Make the first message, so that what is wrong is told at once."""
        topic_name(node, self.topic)
        self.message(node, 0.0, 0)

    def message(self, node: Node, t_s: float, count: int) -> Message:
        """Return the message of a time and count."""
        made = filled(self.message_class, self.values, node.clock.now_ns())
        for (steps, kind), formula in self.compiled:
            owner: Any = made
            for step in steps[:-1]:
                owner = owner[step] if isinstance(step, int) else getattr(owner, step)
            _put(owner, steps[-1], _cast(formula({"t": t_s, "i": count}), kind))
        return made


class _Repeater:
    """One publisher with its thread, which waits while it is disabled."""

    def __init__(self, node: Node, settings: _Settings) -> None:
        self.settings = settings
        self.count = 0
        self.error = ""
        self._node = node
        self._publisher: Publisher = node.create_publisher(settings.topic, settings.message_class)
        self._changed = threading.Condition()
        self._closed = False
        self._start_s = time.monotonic()
        self._start_count = 0
        self._thread = threading.Thread(target=self._run, name="studio publisher", daemon=True)
        self._thread.start()

    def apply(self, settings: _Settings) -> None:
        with self._changed:
            if settings.enabled and not self.settings.enabled:
                self._start_s, self._start_count = time.monotonic(), self.count
            self.settings, self.error = settings, ""
            self._changed.notify()

    def disable(self) -> None:
        with self._changed:
            self.settings.enabled = False

    def close(self) -> None:
        with self._changed:
            self._closed = True
            self._changed.notify()
        self._publisher.unregister()

    def row(self) -> _PublisherState:
        now = self.settings
        return {
            "topic": now.topic,
            "type": now.message_class.TYPE_NAME,
            "rate_hz": now.rate_hz,
            "message": now.values,
            "expressions": now.expressions,
            "enabled": now.enabled,
            "count": self.count,
            "error": self.error,
        }

    def _run(self) -> None:
        due_s = time.monotonic()
        while True:
            with self._changed:
                while not self._closed and not self._is_due(due_s):
                    self._changed.wait(self._wait_s(due_s))
                if self._closed:
                    return
                settings = self.settings
            self._publish(settings)
            now_s = time.monotonic()
            # Rate 0 publishes once; what was missed is not made up for.
            if settings.rate_hz == 0:
                self.disable()
            else:
                due_s = max(due_s + 1.0 / settings.rate_hz, now_s - 1.0 / settings.rate_hz)

    def _is_due(self, due_s: float) -> bool:
        return self.settings.enabled and time.monotonic() >= due_s

    def _wait_s(self, due_s: float) -> float | None:
        return max(due_s - time.monotonic(), 0.0) if self.settings.enabled else None

    def _publish(self, settings: _Settings) -> None:
        t_s = time.monotonic() - self._start_s
        try:
            message = settings.message(self._node, t_s, self.count - self._start_count)
            self._publisher.publish(message)
        except GazelleError as error:
            if not self._closed:
                self.error = str(error)
                self.disable()
            return
        self.count += 1


def _compiled(path: str, text: Any) -> Expression:
    if not isinstance(text, str | int | float) or isinstance(text, bool):
        raise StudioError(f"the expression of '{path}' is a text, not {text!r}")
    return expression(str(text))


def _place(message_class: Any, path: str) -> tuple[tuple[str | int, ...], Field]:
    """Return the steps to a number: ``linear.x``, ``data[2]`` or ``data.2``."""
    steps: list[str | int] = []
    fields: tuple[Field, ...] = message_class.FIELDS
    found: Field | None = None
    for word in path.replace("[", ".").replace("]", "").replace("/", ".").strip(".").split("."):
        if word.isdigit() and found is not None and found.type.array is not Array.ONE:
            steps.append(int(word))
            found = found._replace(type=found.type._replace(array=Array.ONE))
            continue
        by_name = {one.name: one for one in fields}
        if word not in by_name:
            raise unknown(f"field of {message_class.TYPE_NAME}", path, by_name)
        found = by_name[word]
        steps.append(attribute_name(word))
        fields = message_type(found.type.base).FIELDS if found.type.is_message else ()
    if found is None or found.type.base not in FORMATS or found.type.array is not Array.ONE:
        raise StudioError(f"'{path}' is no number; expressions make numbers")
    return tuple(steps), found


def _put(owner: Any, step: str | int, value: float | int | bool) -> None:
    if isinstance(step, str):
        setattr(owner, step, value)
    elif step < len(owner):
        owner[step] = value
    else:
        raise StudioError(f"there is no item {step}: the array has {len(owner)}")


def _cast(value: float, field: Field) -> float | int | bool:
    letter = FORMATS[field.type.base]
    if letter == "?":
        return bool(value)
    if letter in "fd":
        return value
    try:
        return round(value)
    except (ValueError, OverflowError):
        raise StudioError(
            f"'{field.name}' is a whole number, the expression gives {value}"
        ) from None
