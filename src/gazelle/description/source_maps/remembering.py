"""Keeping where an expanded text comes from."""

from __future__ import annotations

from typing import TYPE_CHECKING

from gazelle.description.source_maps.record import SourceMap, keys_of
from gazelle.description.source_maps.store import save_map
from gazelle.description.xml import parse_xml
from gazelle.diagnostics import Diagnostics

if TYPE_CHECKING:
    from gazelle.description.xacro import Expanded

__all__ = ["remember"]

_MOST_ELEMENTS = 200_000


def remember(expanded: Expanded) -> None:
    """Keep the places of a text that leaves this process, in the user's cache folder.

    Args:
        expanded: what xacro made.
    """
    if len(expanded.places) > _MOST_ELEMENTS:
        return
    root = parse_xml(expanded.text, expanded.file, Diagnostics())
    if root is not None:
        save_map(SourceMap(keys_of(root), expanded.places))
