"""Writing YAML."""

from __future__ import annotations

from collections.abc import Mapping
from enum import Enum
from functools import cache
from typing import Any, NamedTuple

import yaml

__all__ = [
    "MESSAGE_STYLE",
    "PYTHON_STYLE",
    "Layout",
    "TaggedMapping",
    "Writer",
    "YamlStyle",
    "dump_yaml",
]

_MAP = "tag:yaml.org,2002:map"
_NO_WRAP = 2**31 - 1


class TaggedMapping(dict[str, Any]):
    """A mapping that is written with a tag before it.

    Attributes:
        tag: such as ``!pair``.
    """

    def __init__(self, tag: str, items: Mapping[str, Any]) -> None:
        super().__init__(items)
        self.tag = tag


class Layout(Enum):
    """How lists and mappings stand.

    BLOCK gives an item a line, FLOW puts them in brackets, FLOW_LISTS only the lists.
    """

    BLOCK = "block"
    FLOW = "flow"
    FLOW_LISTS = "flow lists"


class Writer(Enum):
    """Who writes.

    SAFE is ``yaml.safe_dump``. PYTHON is ``yaml.dump``, which writes objects of classes with tags
    of Python. LIBYAML is the library in C, where it is installed.
    """

    SAFE = "safe"
    PYTHON = "python"
    LIBYAML = "libyaml"


class YamlStyle(NamedTuple):
    """How values are written; without a word as ``yaml.safe_dump`` does.

    Attributes:
        writer: decides what is written as what.
        layout: of lists and mappings.
        sort_keys: keys are sorted.
        allow_unicode: what is not ASCII is not escaped.
        is_wrapped: lines are broken after 80 characters.
        is_quoted: every scalar stands in double quotes.
    """

    writer: Writer = Writer.SAFE
    layout: Layout = Layout.BLOCK
    sort_keys: bool = True
    allow_unicode: bool = False
    is_wrapped: bool = True
    is_quoted: bool = False


_SAFE_STYLE = YamlStyle()
PYTHON_STYLE = YamlStyle(writer=Writer.PYTHON)
MESSAGE_STYLE = YamlStyle(sort_keys=False, allow_unicode=True, is_wrapped=False)


def dump_yaml(value: Any, style: YamlStyle = _SAFE_STYLE) -> str:
    """Return a value as YAML, as PyYAML writes it.

    Args:
        value: plain values, and `TaggedMapping`.
        style: how; as ``yaml.safe_dump`` by default, ``PYTHON_STYLE`` as ``yaml.dump``,
            ``MESSAGE_STYLE`` as ROS 2 shows messages: fields in order, a line each.
    """
    text: str = yaml.dump(
        value,
        Dumper=_dumper(style.writer, style.layout),
        default_flow_style=style.layout is not Layout.BLOCK,
        sort_keys=style.sort_keys,
        allow_unicode=style.allow_unicode,
        width=None if style.is_wrapped else _NO_WRAP,
        default_style='"' if style.is_quoted else None,
    )
    return text


@cache
def _dumper(writer: Writer, layout: Layout) -> Any:
    base: Any = yaml.Dumper if writer is Writer.PYTHON else yaml.SafeDumper
    if writer is Writer.LIBYAML:
        base = getattr(yaml, "CSafeDumper", base)
    made: Any = type("Dumper", (base,), {})
    made.add_representer(TaggedMapping, _tagged)
    if layout is Layout.FLOW_LISTS:
        made.add_representer(dict, _in_block)
    return made


def _tagged(dumper: Any, value: TaggedMapping) -> Any:
    return dumper.represent_mapping(value.tag, dict(value))


def _in_block(dumper: Any, value: dict[str, Any]) -> Any:
    return dumper.represent_mapping(_MAP, value, flow_style=False)
