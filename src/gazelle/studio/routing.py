"""Rows of the tables of methods, streams and paths, over the part that each of them works on.

A row takes a narrow part: a node, the topics listened to, the recorder. A table of an area is over
what holds these parts, and the table of all areas over the Studio that composes them.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, TypeVar

from gazelle.studio.http_answers import Answer
from gazelle.studio.request_params import Params
from gazelle.studio.streams import Channel, OpenStream, StreamKind

__all__ = ["Method", "Route", "methods_of", "methods_without", "routes_of", "streams_of"]

_Part = TypeVar("_Part")
_Whole = TypeVar("_Whole")

Method = Callable[[_Part, Params], Any]
"""Runs in a thread of its own and may wait; returns a JSON value."""

Route = Callable[[_Part, str], Answer | None]
"""What answers the rest of a path; None is 404."""


def methods_of(
    part: Callable[[_Whole], _Part], rows: Mapping[str, Method[_Part]]
) -> dict[str, Method[_Whole]]:
    """Return methods of a part as methods of what holds it."""

    def over(method: Method[_Part]) -> Method[_Whole]:
        return lambda whole, params: method(part(whole), params)

    return {name: over(method) for name, method in rows.items()}


def methods_without(rows: Mapping[str, Callable[[Params], Any]]) -> dict[str, Method[object]]:
    """Return methods that need nothing but their parameters as methods of whatever holds them."""

    def over(method: Callable[[Params], Any]) -> Method[object]:
        return lambda _whole, params: method(params)

    return {name: over(method) for name, method in rows.items()}


def streams_of(
    part: Callable[[_Whole], _Part], rows: Mapping[str, StreamKind[_Part]]
) -> dict[str, StreamKind[_Whole]]:
    """Return streams of a part as streams of what holds it."""

    def over(kind: StreamKind[_Part]) -> StreamKind[_Whole]:
        def start(whole: _Whole, channel: Channel, params: Params) -> OpenStream:
            return kind.open(part(whole), channel, params)

        return StreamKind(kind.latest, start)

    return {name: over(kind) for name, kind in rows.items()}


def routes_of(
    part: Callable[[_Whole], _Part], rows: Mapping[str, Route[_Part]]
) -> dict[str, Route[_Whole]]:
    """Return paths of a part as paths of what holds it."""

    def over(route: Route[_Part]) -> Route[_Whole]:
        return lambda whole, rest: route(part(whole), rest)

    return {name: over(route) for name, route in rows.items()}
