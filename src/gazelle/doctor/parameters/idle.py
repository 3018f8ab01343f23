"""Parameters of nodes in a file of ROS 2 that are known and change nothing here."""

from __future__ import annotations

from collections.abc import Iterator

from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.doctor.parameters.document import Document, plain
from gazelle.doctor.parameters.parameter_file import MARK
from gazelle.documents.yaml import YamlMapping, YamlNode
from gazelle.nodes.idle_parameters import idle_parameters, node_of_name

__all__ = ["check_idle"]


def check_idle(document: Document, diagnostics: Diagnostics) -> None:
    """Report what the nodes of a file read and do not use, each at its line.

    Args:
        document: a file of ROS 2: names of nodes, ``ros__parameters``, parameters.
        diagnostics: receives ``parameter.idle``.
    """
    for path, values in _nodes(document.root, ()):
        node = node_of_name(path[-1])
        found = plain(values)
        if not node or not isinstance(found, dict):
            continue
        for item in idle_parameters(node, found, 2):
            text = f"/{'/'.join(path)}: parameter '{item.key}' has no effect here: {item.reason}"
            diagnostics.report("parameter.idle", text, _span(values, item.key))


def _nodes(node: YamlMapping, above: tuple[str, ...]) -> Iterator[tuple[tuple[str, ...], YamlNode]]:
    for key, value in node.pairs:
        if key.text == MARK and above:
            yield above, value
        elif isinstance(value, YamlMapping):
            yield from _nodes(value, (*above, key.text.strip("/")))


def _span(node: YamlNode, name: str) -> SourceSpan:
    """Return the place of a key; levels may be written as mappings or with dots."""
    place = node
    words = name.split(".")
    while words and isinstance(node, YamlMapping):
        for count in range(len(words), 0, -1):
            key = ".".join(words[:count])
            pair = node.pair(key)
            if pair is not None:
                place, node, words = pair[0], pair[1], words[count:]
                break
        else:
            break
    return place.span
