"""The messages of bags as they are published: chosen, in order, in CDR, read ahead."""

from __future__ import annotations

import heapq
import threading
from collections.abc import Callable, Iterable, Iterator, Sequence
from queue import Queue
from typing import Any, NamedTuple

from gazelle.bag.storage import BagMessage, BagReader, Connection, Encoding
from gazelle.bag.types import converter
from gazelle.errors import GazelleError
from gazelle.interfaces import TypeStore

__all__ = ["Outgoing", "ahead", "outgoing"]

_READ_AHEAD = 200


class Outgoing(NamedTuple):
    """A message that is ready to be published."""

    place: int
    connection: Connection
    stamp_ns: int
    data: bytes


def outgoing(
    bags: Sequence[BagReader],
    wanted: Callable[[Connection], bool],
    start_ns: int,
    end_ns: int | None,
    on_error: Callable[[Connection, GazelleError], None],
    types: Sequence[TypeStore] = (),
) -> Iterator[Outgoing]:
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
            place, bag.messages(wanted, start_ns, end_ns), on_error, types[place] if types else None
        )
        for place, bag in enumerate(bags)
    ]
    return heapq.merge(*streams, key=lambda one: one.stamp_ns)


def ahead(items: Iterable[Outgoing]) -> Iterator[Outgoing]:
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
    place: int,
    messages: Iterable[BagMessage],
    on_error: Callable[[Connection, GazelleError], None],
    types: TypeStore | None,
) -> Iterator[Outgoing]:
    converters: dict[int, Callable[[bytes], bytes] | None] = {}
    for one, stamp_ns, data in messages:
        try:
            if one.id not in converters:
                converters[one.id] = None
                converters[one.id] = converter(one, Encoding.CDR, types)
            convert = converters[one.id]
            if convert is not None:
                yield Outgoing(place, one, stamp_ns, convert(data))
        except GazelleError as error:
            converters[one.id] = None
            on_error(one, error)
