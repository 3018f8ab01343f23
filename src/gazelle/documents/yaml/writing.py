"""Writing YAML."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from typing import Any

import yaml

__all__ = ["TaggedMapping", "dump_yaml"]

_MAP = "tag:yaml.org,2002:map"


class TaggedMapping(dict[str, Any]):
    """A mapping that is written with a tag before it.

    Attributes:
        tag: such as ``!pair``.
    """

    def __init__(self, tag: str, items: Mapping[str, Any]) -> None:
        super().__init__(items)
        self.tag = tag


def dump_yaml(
    value: Any,
    *,
    flow_style: bool = False,
    blocks: bool = False,
    sort_keys: bool = True,
    allow_unicode: bool = False,
    width: int | None = None,
    quoted: bool = False,
    objects: bool = False,
    libyaml: bool = False,
) -> str:
    """Return a value as YAML, as PyYAML writes it.

    Args:
        value: plain values, and `TaggedMapping`.
        flow_style: lists and mappings stand in brackets.
        blocks: mappings do not.
        sort_keys: keys are sorted.
        allow_unicode: what is not ASCII is not escaped.
        width: where lines are broken, PyYAML's 80 characters when None.
        quoted: every scalar stands in double quotes.
        objects: objects of Python's classes are written with tags of Python, as ``yaml.dump``
            does and ``yaml.safe_dump`` does not.
        libyaml: by the library in C, where it is installed.
    """
    text: str = yaml.dump(
        value,
        Dumper=_dumper(blocks, objects, libyaml),
        default_flow_style=flow_style,
        sort_keys=sort_keys,
        allow_unicode=allow_unicode,
        width=width,
        default_style='"' if quoted else None,
    )
    return text


@cache
def _dumper(blocks: bool, objects: bool, libyaml: bool) -> Any:
    base: Any = yaml.Dumper if objects else yaml.SafeDumper
    if libyaml:
        base = getattr(yaml, "CSafeDumper", base)
    made: Any = type("Dumper", (base,), {})
    made.add_representer(TaggedMapping, _tagged)
    if blocks:
        made.add_representer(dict, _in_block)
    return made


def _tagged(dumper: Any, value: TaggedMapping) -> Any:
    return dumper.represent_mapping(value.tag, dict(value))


def _in_block(dumper: Any, value: dict[str, Any]) -> Any:
    return dumper.represent_mapping(_MAP, value, flow_style=False)
