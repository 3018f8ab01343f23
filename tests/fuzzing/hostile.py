"""What a hostile program on a graph may send: packets, tokens, messages, requests; by number.

Nothing here asks for what is allowed and ends things: deleting models, ending nodes, pausing.
"""

from __future__ import annotations

import contextlib
import json
import math
import random
from collections.abc import Callable
from typing import Any

from gazelle.errors import GazelleError
from gazelle.graph import Graph, Kind, Node
from gazelle.graph.key_expressions import control_key, parameter_key, service_key, topic_key
from gazelle.interfaces import message_type, service_type
from gazelle.interfaces.definition import Array, attribute_name

__all__ = ["Hostile"]

_NUMBERS = (math.nan, math.inf, -math.inf, 1e300, -1e300, 1e6, -1e6, 0.0, -1.0, 1e-300)
_TEXTS = (
    "",
    "/",
    "world",
    "scout",
    "scout::base_link",
    "\U0001f916" * 50,
    "/" * 2000,
    "a\0b",
    "%s{}",
)
_LEFT_OUT = ("delete", "pause", "reset", "shutdown", "kill", "terminate", "switch", "unload")
_ASK_S = 1.0
_CALL_S = 5.0


class Hostile:
    """Does one hostile thing after the other, the same for the same number."""

    def __init__(self, graph: Graph, node: Node) -> None:
        """Look at what there is to be attacked."""
        self._graph = graph
        self._node = node
        self._entities = [one for one in graph.entities() if one.zid != graph.zid]
        self._tokens: list[Any] = []

    def do(self, number: int) -> str:
        """Do the thing of a number; returns which."""
        chance = random.Random(number)
        act = chance.choice(_ACTS)
        with contextlib.suppress(GazelleError, KeyError):
            act(self, chance)
        return act.__name__

    def close(self) -> None:
        """Take the tokens back."""
        for one in self._tokens:
            one.undeclare()

    def _packet(self, chance: random.Random) -> None:
        zids = sorted({one.zid for one in self._entities})
        keys = [parameter_key("store"), *(control_key(self._graph.domain, zid) for zid in zids)]
        key = chance.choice(keys)
        for _reply in self._graph.session.get(key, payload=_bytes(chance), timeout=_ASK_S):
            pass

    def _update(self, chance: random.Random) -> None:
        self._graph.session.put(parameter_key("update"), _bytes(chance))

    def _token(self, chance: random.Random) -> None:
        parts = ["@ros2_lv", str(self._graph.domain), "z", "1", "2", "MP", "%", "%", "n"]
        parts += ["%topic", "std_msgs::msg::dds_::String_", "hash", "::,:,:,:,,"]
        place = chance.randrange(2, len(parts))
        parts[place] = chance.choice(("²", "9" * 5000, "\x1b[2J", "-1", "%", "٣", "x" * 9000))
        key = "/".join(parts)
        self._tokens.append(self._graph.session.liveliness().declare_token(key))

    def _bytes_on_a_topic(self, chance: random.Random) -> None:
        one = self._one(chance, Kind.SUBSCRIPTION)
        key = topic_key(self._graph.domain, one.name, one.type_name, one.type_hash)
        self._graph.session.put(key, chance.randbytes(chance.choice((0, 1, 7, 60, 5000))))

    def _bytes_to_a_service(self, chance: random.Random) -> None:
        one = self._one(chance, Kind.SERVICE)
        if not any(word in one.name for word in _LEFT_OUT):
            key = service_key(self._graph.domain, one.name, one.type_name, one.type_hash)
            data = chance.randbytes(chance.choice((0, 1, 7, 60, 5000)))
            for _reply in self._graph.session.get(key, payload=data, timeout=_ASK_S):
                pass

    def _message(self, chance: random.Random) -> None:
        one = self._one(chance, Kind.SUBSCRIPTION)
        message = _filled(message_type(one.type_name)(), chance)
        publisher = self._node.create_publisher(one.name, type(message))
        publisher.publish(message)
        publisher.unregister()
        self._node.drop(publisher)

    def _call(self, chance: random.Random) -> None:
        services = [one for one in self._of(Kind.SERVICE) if "gazebo" in one.name]
        one = chance.choice(services)
        if any(word in one.name for word in _LEFT_OUT):
            return
        kind = service_type(one.type_name)
        client = self._node.create_client(one.name, kind)
        try:
            request = _filled(kind.Request(), chance)
            client.call(request, timeout_s=_CALL_S)
        finally:
            client.unregister()
            self._node.drop(client)

    def _one(self, chance: random.Random, kind: Kind) -> Any:
        return chance.choice(self._of(kind))

    def _of(self, kind: Kind) -> list[Any]:
        return [one for one in self._entities if one.kind is kind and one.type_name != "*"]


_ACTS: tuple[Callable[[Hostile, random.Random], None], ...] = (
    Hostile._packet, Hostile._update, Hostile._token, Hostile._bytes_on_a_topic,
    Hostile._bytes_to_a_service, Hostile._message, Hostile._call, Hostile._call,
)  # fmt: skip


def _bytes(chance: random.Random) -> bytes:
    op = chance.choice(("get", "set", "root", "names", "search", "info", "?", 7, None, ["a"]))
    value = chance.choice((1, None, [[]], {"$bytes": 7}, {"$date": "x"}, math.nan, "x" * 1000))
    request = {
        "op": op,
        "name": chance.choice(("/hostile", "/", "", 3, "/x" * 300)),
        "value": value,
    }
    data = json.dumps(request).encode()
    return chance.choice((data, data[: len(data) // 2], chance.randbytes(40), b"[" * 9000, b""))


def _filled(message: Any, chance: random.Random) -> Any:
    """Fill what a message has with what nobody expects."""
    for item in message.FIELDS:
        name, kind = attribute_name(item.name), item.type
        if kind.array is Array.FIXED:
            continue
        if kind.is_message:
            if kind.array is Array.ONE:
                _filled(getattr(message, name), chance)
            elif chance.random() < 0.5:
                inner = message_type(kind.base)
                setattr(
                    message, name, [_filled(inner(), chance) for _ in range(chance.randint(1, 3))]
                )
            continue
        value = _value(kind, chance)
        if value is not None:
            is_one = kind.array is Array.ONE
            setattr(message, name, value if is_one else [value] * chance.randint(0, 4))
    return message


def _value(kind: Any, chance: random.Random) -> Any:
    if kind.base in ("float32", "float64"):
        value = chance.choice(_NUMBERS)
        return value if kind.base == "float64" or abs(value) < 1e30 else math.nan
    if kind.is_string:
        return chance.choice(_TEXTS)
    if kind.base == "bool":
        return chance.random() < 0.5
    return None
