"""Finding where the elements of a text come from."""

from __future__ import annotations

from gazelle.description.source_maps.record import SourceMap, digest_of, keys_of
from gazelle.description.source_maps.store import load_map
from gazelle.description.xml import Tag, parse_xml, with_places
from gazelle.diagnostics import Diagnostics

__all__ = ["placed", "source_map_of"]


def source_map_of(text: str | Tag) -> SourceMap | None:
    """Return where the elements of a text come from.

    Args:
        text: a document, also one without comments or in other white space. A text that was
            changed otherwise may be another robot's and is no one's.

    Returns:
        The places, one for each element; None when no run of xacro is known to have made the text.
    """
    root = parse_xml(text, "", Diagnostics()) if isinstance(text, str) else text
    if root is None:
        return None
    keys = keys_of(root)
    found = load_map(digest_of(keys))
    return found if found is not None and found.keys == keys else None


def placed(root: Tag) -> Tag:
    """Return a tree with the places of the xacro files, where they are known."""
    found = source_map_of(root)
    return root if found is None else with_places(root, found.places)
