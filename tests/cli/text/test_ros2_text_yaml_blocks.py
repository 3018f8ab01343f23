"""The fast writer of YAML blocks writes what PyYAML writes."""

from __future__ import annotations

import random
from collections.abc import Callable
from typing import Any

import pytest
import yaml

from gazelle.cli.text.ros2_text import NotSimpleError, yaml_blocks

_TEXTS = (
    "", "a", "base_link", "a: b", "- a", "#a", "a #b", "yes", "no", "on", "null", "~", "1", "1.5",
    "1e-3", "0x1f", "2020-01-01", "=", "'", '"', "it's", "\t", "\0", " a", "a ", "{a}", "[a]", "%a",
    "@a", "`a", "!a", "&a", "*a", "?", "? a", "|", ">", "ü", "\U0001f98c", "\x85", "\ufeff",
    "x" * 200, "a, b", "<xml a='b'/>", "...", "---", ":", "a:", "/tf", "\u2028",
)  # fmt: skip
_FLOATS = (0.0, -0.0, 1.0, 0.1, 1e-7, 1e22, 1.5e300, -2.5e-10, float("inf"), float("-inf"))


def _value(rng: random.Random, depth: int) -> Any:
    kind = rng.choice("ifstb" if depth > 2 else "ifstbdl")
    if kind == "d":
        return _fields(rng, depth + 1)
    if kind == "l":
        one = rng.choice(("i", "f", "t", "d"))
        makers: dict[str, Callable[[], Any]] = {
            "i": lambda: rng.randint(-300, 2**63),
            "f": lambda: rng.choice(_FLOATS),
            "t": lambda: rng.choice(_TEXTS),
            "d": lambda: _fields(rng, depth + 1),
        }
        return [makers[one]() for _ in range(rng.randrange(4))]
    if kind == "b":
        return rng.random() < 0.5
    if kind in "st":
        return rng.choice(_TEXTS)
    return rng.choice(_FLOATS) if kind == "f" else rng.randint(-(2**63), 2**63)


def _fields(rng: random.Random, depth: int = 0) -> dict[str, Any]:
    names = rng.sample(("x", "y", "data", "on", "no", "header", "from", "null"), rng.randrange(5))
    return {name: _value(rng, depth) for name in names}


def _dumped(fields: dict[str, Any]) -> str:
    return str(
        yaml.dump(
            fields,
            Dumper=_NoAliases,
            allow_unicode=True,
            width=2**31,
            default_flow_style=False,
            sort_keys=False,
        )
    )


class _NoAliases(yaml.SafeDumper):
    def ignore_aliases(self, data: Any) -> bool:
        return True


@pytest.mark.parametrize("seed", range(0, 300, 50))
def test_random_fields_are_as_pyyaml_writes_them(seed: int) -> None:
    for one in range(seed, seed + 50):
        fields = _fields(random.Random(one))
        try:
            found = yaml_blocks(fields)
        except NotSimpleError:
            assert any(text in repr(fields) for text in (r"\x85", r"\u2028"))
            continue
        assert found == _dumped(fields)


@pytest.mark.parametrize("text", _TEXTS)
def test_texts_and_not_a_number(text: str) -> None:
    fields = {"a": text, "l": [text, text], "n": float("nan"), "e": {}, "d": [{"k": text}, {}]}
    try:
        found = yaml_blocks(fields)
    except NotSimpleError:
        assert text in ("\x85", "\u2028")
        return
    assert found == _dumped(fields)


def test_several_lines_are_left_to_pyyaml() -> None:
    with pytest.raises(NotSimpleError):
        yaml_blocks({"a": "b\nc"})
    with pytest.raises(NotSimpleError):
        yaml_blocks({"a": None})
