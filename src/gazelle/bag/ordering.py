"""Messages by time from chunks that may overlap."""

from __future__ import annotations

import heapq
from collections.abc import Callable, Iterable, Iterator
from itertools import count
from typing import NamedTuple

from gazelle.bag.storage import BagMessage

__all__ = ["Piece", "by_time"]


class Piece(NamedTuple):
    """Some messages that are loaded together: the first one's stamp, and how to load them."""

    start_ns: int
    load: Callable[[], Iterable[BagMessage]]


def by_time(pieces: Iterable[Piece]) -> Iterator[BagMessage]:
    """Yield the messages of all pieces by stamp, those of one stamp as they lie in the file.

    No more pieces are held than overlap.
    """
    waiting: list[tuple[int, int, BagMessage]] = []
    numbers = count()
    for piece in sorted(pieces, key=lambda one: one.start_ns):
        while waiting and waiting[0][0] < piece.start_ns:
            yield heapq.heappop(waiting)[2]
        for message in piece.load():
            heapq.heappush(waiting, (message.stamp_ns, next(numbers), message))
    while waiting:
        yield heapq.heappop(waiting)[2]
