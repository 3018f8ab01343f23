"""Reading the text format of protocol buffers."""

from __future__ import annotations

import math
from typing import Any

import pytest

from gazelle.cli.gz.options import GzError
from gazelle.cli.gz.protobuf_text import read_protobuf_text


@pytest.mark.parametrize(
    ("text", "fields"),
    [
        ("", {}),
        ("linear: {x: 0.5}, angular: {z: -1}", {"linear": {"x": 0.5}, "angular": {"z": -1}}),
        ("linear {x:.5}\nangular<z:1>;", {"linear": {"x": 0.5}, "angular": {"z": 1}}),
        ("v: 1 v: 2 v: [3, 4]", {"v": [1, 2, 3, 4]}),
        ("on: true off: false kind: MODEL", {"on": True, "off": False, "kind": "MODEL"}),
        ("a: 'it\\'s' \" two\"", {"a": "it's two"}),
        ("a: 0x10 b: -2.5e-3 c: 3f d: 007", {"a": 16, "b": -2.5e-3, "c": 3.0, "d": 7}),
        ("a: 1 # words\nb: 2", {"a": 1, "b": 2}),
        ("sdf: '<a b=\"{1}\">\n</a>'", {"sdf": '<a b="{1}">\n</a>'}),
        ("points {x: 1} points {x: 2}", {"points": [{"x": 1}, {"x": 2}]}),
    ],
)
def test_fields_are_read(text: str, fields: dict[str, Any]) -> None:
    assert read_protobuf_text(text) == fields


def test_infinity_is_a_number() -> None:
    assert read_protobuf_text("a: inf b: -inf") == {"a": math.inf, "b": -math.inf}


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("linear: {x: 0.5", "'}' is missing at the end: character 13, near 'linear: {x: 0.5'"),
        ("a: [1, 2", "']' is missing at the end"),
        ("x 0.5", "'x' wants ':' and a value: character 1"),
        ("x:", "a value was expected, not the end"),
        ("x: }", "a value was expected, not '}': character 4"),
        ("{x: 1}", "a field's name was expected, not '{': character 1"),
        ("x: 1.2.3", "'1' is not understood: character 4"),
        ("x: $", "'$' is not understood: character 4"),
        ("x: '\\x'", "'\\x' has an escape that is none"),
    ],
)
def test_broken_text_is_told_with_its_place(text: str, said: str) -> None:
    with pytest.raises(GzError) as raised:
        read_protobuf_text(text)
    assert str(raised.value).startswith(said)
