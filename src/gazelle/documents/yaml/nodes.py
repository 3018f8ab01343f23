"""The nodes of a YAML text: what is written, and where."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import NamedTuple

import yaml

from gazelle.diagnostics import SourceSpan

__all__ = [
    "YamlEntry",
    "YamlMapping",
    "YamlNode",
    "YamlScalar",
    "YamlSequence",
    "duplicates",
    "entries",
    "node_of",
]


@dataclass(frozen=True, slots=True, eq=False)
class YamlScalar:
    """A text, number, bool or nothing, as it is written.

    Attributes:
        text: without quotes.
        is_plain: it has no quotes and is no block.
        tag: what YAML 1.1 (or the dialect it was read by) takes it for: ``str``, ``int``,
            ``float``, ``bool``, ``null``, …
        span: where it stands; its length is 0 when it has several lines.
        composed: PyYAML's node.
    """

    text: str
    is_plain: bool
    tag: str
    span: SourceSpan
    composed: yaml.Node = field(repr=False)


@dataclass(frozen=True, slots=True, eq=False)
class YamlSequence:
    """A list.

    Attributes:
        items: what is in it.
        span: where it stands; its length is 0 when it has several lines.
        composed: PyYAML's node.
    """

    items: tuple[YamlNode, ...]
    span: SourceSpan
    composed: yaml.Node = field(repr=False)

    @property
    def text(self) -> str:
        """The list as it is written."""
        return _written(self.composed)


@dataclass(frozen=True, slots=True, eq=False)
class YamlMapping:
    """Names with values.

    Attributes:
        pairs: keys and values, in the order of the text; a key may be there twice.
        span: where it stands; its length is 0 when it has several lines.
        composed: PyYAML's node.
    """

    pairs: tuple[tuple[YamlNode, YamlNode], ...]
    span: SourceSpan
    composed: yaml.Node = field(repr=False)

    @property
    def text(self) -> str:
        """The mapping as it is written."""
        return _written(self.composed)

    def pair(self, name: str) -> tuple[YamlNode, YamlNode] | None:
        """Return the first key of this text and its value; None without one."""
        return next((pair for pair in self.pairs if pair[0].text == name), None)


YamlNode = YamlScalar | YamlSequence | YamlMapping


class YamlEntry(NamedTuple):
    """An entry of a mapping, or an item of a list.

    Attributes:
        path: the texts of the keys that lead to it, positions in lists as ``0``, ``1``, …
        key: the key; the item itself in a list.
        value: what stands there.
        first: the first key of this text in the mapping, when this is another one.
    """

    path: tuple[str, ...]
    key: YamlNode
    value: YamlNode
    first: YamlNode | None = None


def entries(
    node: YamlNode, path: tuple[str, ...] = (), *, lists: bool = False
) -> Iterator[YamlEntry]:
    """Yield all entries of mappings in mappings, outer before inner, in the order of the text.

    Args:
        node: where to begin.
        path: put before the paths.
        lists: the items of lists, too, and what is in them.
    """
    if isinstance(node, YamlMapping):
        known = duplicates(node)
        for key, value in node.pairs:
            inner = (*path, key.text)
            yield YamlEntry(inner, key, value, known.get(key))
            yield from entries(value, inner, lists=lists)
    elif lists and isinstance(node, YamlSequence):
        for index, item in enumerate(node.items):
            inner = (*path, str(index))
            yield YamlEntry(inner, item, item)
            yield from entries(item, inner, lists=lists)


def duplicates(mapping: YamlMapping) -> dict[YamlNode, YamlNode]:
    """Return the keys of a mapping that were there before, with the first one of their text."""
    first: dict[str, YamlNode] = {}
    pairs = ((key, first.setdefault(key.text, key)) for key, _ in mapping.pairs)
    return {key: known for key, known in pairs if known is not key}


def node_of(composed: yaml.Node, file: str) -> YamlNode:
    """Return PyYAML's node with places in a file; what an alias names is there once."""
    return _converted(composed, file, {})


def _converted(node: yaml.Node, file: str, known: dict[int, YamlNode]) -> YamlNode:
    found = known.get(id(node))
    if found is not None:
        return found
    span = _span(node, file)
    if isinstance(node, yaml.MappingNode):
        pairs = tuple(
            (_converted(key, file, known), _converted(value, file, known))
            for key, value in node.value
        )
        found = YamlMapping(pairs, span, node)
    elif isinstance(node, yaml.SequenceNode):
        found = YamlSequence(tuple(_converted(i, file, known) for i in node.value), span, node)
    else:
        found = YamlScalar(
            node.value,
            getattr(node, "style", None) is None,
            node.tag.rpartition(":")[2],
            span,
            node,
        )
    known[id(node)] = found
    return found


def _span(node: yaml.Node, file: str) -> SourceSpan:
    start, end = node.start_mark, node.end_mark
    length = end.column - start.column if end.line == start.line else 0
    return SourceSpan(file, start.line + 1, start.column + 1, length)


def _written(node: yaml.Node) -> str:
    start, end = node.start_mark, node.end_mark
    text = start.buffer
    return "" if text is None else str(text[start.pointer : end.pointer])
