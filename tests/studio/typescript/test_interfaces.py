"""Types of messages in TypeScript's words."""

from __future__ import annotations

from typing import Any, Literal, NotRequired, TypedDict

import pytest

from gazelle.studio.typescript.interfaces import interface, type_text


class Part(TypedDict):
    """One part."""

    name: str


class Whole(TypedDict):
    """What has
    parts.

    Attributes:
        size: metres, of all
            of it.
    """

    size: float
    parts: list[Part]
    note: NotRequired[str | None]


def test_typed_dict_becomes_an_interface_with_its_docstring() -> None:
    assert interface(Whole) == (
        "/** What has parts. */\n"
        "export interface Whole {\n"
        "  /** metres, of all of it. */\n"
        "  size: number;\n"
        "  parts: Part[];\n"
        "  note?: string | null;\n"
        "}\n"
    )


@pytest.mark.parametrize(
    ("kind", "text"),
    [
        (Any, "Json"),
        (bool, "boolean"),
        (list[float | None], "(number | null)[]"),
        (tuple[float, ...], "number[]"),
        (tuple[float, float], "[number, number]"),
        (dict[str, list[int]], "Record<string, number[]>"),
        (Literal["world", "robot"], '"world" | "robot"'),
    ],
)
def test_types_of_json_have_words(kind: Any, text: str) -> None:
    assert type_text(kind) == text


def test_type_that_json_lacks_is_refused() -> None:
    with pytest.raises(TypeError, match=r"^<class 'complex'> is no type of JSON values$"):
        type_text(complex)
