"""Rows of a part in the table of what holds the part."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, cast

from gazelle.studio.http_answers import Answer
from gazelle.studio.request_params import Params
from gazelle.studio.routing import methods_of, methods_without, routes_of, streams_of
from gazelle.studio.streams import Channel, OpenStream, StreamKind


@dataclass(frozen=True)
class _Whole:
    name: str
    number: int


WHOLE = _Whole("whole", 7)
PARAMS = Params("a", {"by": 2})


def test_a_method_gets_its_part_alone() -> None:
    rows = methods_of(
        lambda whole: whole.number, {"a": lambda number, params: (number, params.whole("by"))}
    )
    assert rows["a"](WHOLE, PARAMS) == (7, 2)


def test_a_method_without_a_part_is_of_any_table() -> None:
    rows = methods_without({"a": lambda params: params.whole("by")})
    assert rows["a"](WHOLE, PARAMS) == 2


def test_a_stream_gets_its_part_and_stays_of_its_class() -> None:
    opened: list[Any] = []

    def start(name: str, channel: Channel, params: Params) -> OpenStream:
        opened.append((name, channel, params))
        return OpenStream(lambda: None, name)

    rows = streams_of(lambda whole: whole.name, {"s": StreamKind(latest=True, open=start)})
    channel = cast(Channel, object())
    assert rows["s"].latest
    assert rows["s"].open(WHOLE, channel, PARAMS).info == "whole"
    assert opened == [("whole", channel, PARAMS)]


def test_a_path_gets_its_part_and_the_rest() -> None:
    def answer(name: str, rest: str) -> Answer | None:
        return Answer(f"{name} {rest}".encode(), "text/plain") if rest else None

    rows = routes_of(lambda whole: whole.name, {"p": answer})
    found = rows["p"](WHOLE, "a/b")
    assert found is not None
    assert found.body == b"whole a/b"
    assert rows["p"](WHOLE, "") is None
