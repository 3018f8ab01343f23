"""What processes ask each other beside ROS's own ways, and answer: dictionaries as JSON.

Whoever is on the graph can send anything, so what arrives is read here and nowhere else: it is a
dictionary whose named entries are what they should be, or it is told in one sentence.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from gazelle.errors import GraphError
from gazelle.graph.parameter_tree import from_json, to_json

__all__ = ["answer_in", "read_query", "read_sample", "reply_to"]

_SHOWN = 60
_LONGEST = 4096

Kinds = Mapping[str, type | tuple[type, ...]]


def read_query(query: Any, kinds: Kinds) -> dict[str, Any]:
    """Return what a query asks.

    Args:
        query: a query of the transport.
        kinds: the entries that have to be of a type where they are there.

    Raises:
        GraphError: it is nothing that can be read.
    """
    return _read(query.payload, kinds)


def read_sample(sample: Any, kinds: Kinds) -> dict[str, Any]:
    """Return what a sample says, as `read_query` does.

    Raises:
        GraphError: it is nothing that can be read.
    """
    return _read(sample.payload, kinds)


def reply_to(query: Any, key: str, answer: dict[str, Any]) -> None:
    """Answer a query, and be done with it."""
    query.reply(key, to_json(answer))
    query.drop()


def answer_in(reply: Any) -> dict[str, Any] | None:
    """Return the answer of a reply; None for an error and for what is no answer."""
    if reply.ok is None:
        return None
    try:
        return _read(reply.ok.payload, {})
    except GraphError:
        return None


def _read(payload: Any, kinds: Kinds) -> dict[str, Any]:
    data = b"" if payload is None else payload.to_bytes()
    found = from_json(data)
    if not isinstance(found, dict):
        raise GraphError(f"a request is a dictionary, not {_shown(found)}")
    for name, kind in kinds.items():
        value = found.get(name)
        if name in found and (not isinstance(value, kind) or isinstance(value, bool)):
            raise GraphError(f"'{name}' of a request cannot be {_shown(value)}")
        if isinstance(value, str) and len(value) > _LONGEST:
            raise GraphError(f"'{name}' of a request is {len(value)} characters long")
    return found


def _shown(value: Any) -> str:
    text = repr(value)
    return text if len(text) <= _SHOWN else f"{text[:_SHOWN]}…"
