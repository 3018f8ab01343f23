"""Parts that are made when somebody asks first."""

from __future__ import annotations

from contextlib import ExitStack
from threading import Barrier, Thread

import pytest

from gazelle.studio.lazy_parts import Lazy, closed_with


class _Part:
    def __init__(self, closed: list[str], name: str) -> None:
        self._closed = closed
        self._name = name

    def close(self) -> None:
        self._closed.append(self._name)


def test_a_part_is_made_once_also_for_many_threads() -> None:
    made: list[object] = []
    ready = Barrier(8)

    def make() -> object:
        made.append(object())
        return made[-1]

    part = Lazy(make)
    assert not made

    def ask() -> None:
        ready.wait()
        part()

    threads = [Thread(target=ask) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert made == [part()]


def test_a_part_that_could_not_be_made_is_tried_again() -> None:
    errors = [ValueError("not yet")]

    def make() -> str:
        if errors:
            raise errors.pop()
        return "made"

    part = Lazy(make)
    with pytest.raises(ValueError, match="not yet"):
        part()
    assert part() == "made"


def test_what_was_made_last_is_closed_first() -> None:
    closed: list[str] = []
    with ExitStack() as ending:
        first = closed_with(ending, _Part(closed, "first"))
        closed_with(ending, _Part(closed, "second"))
        assert isinstance(first, _Part)
        assert not closed
    assert closed == ["second", "first"]
