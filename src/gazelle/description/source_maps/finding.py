"""Finding where the elements of a text come from."""

from __future__ import annotations

from collections.abc import Sequence

from gazelle.description.source_maps.alignment import aligned
from gazelle.description.source_maps.record import SourceMap, digest_of, keys_of, sketch_of
from gazelle.description.source_maps.store import load_map, sketches
from gazelle.description.xml import Tag, parse_xml, with_places
from gazelle.diagnostics import Diagnostics

__all__ = ["placed", "source_map_of"]

_LEAST_ALIKE = 0.3
_LEAST_PAIRED = 0.6


def source_map_of(text: str | Tag, *, exact: bool = False) -> SourceMap | None:
    """Return where the elements of a text come from.

    Args:
        text: a document, also one that was changed after its expansion: without comments, in
            other white space, with other values here and there.
        exact: take no changed text for an expanded one. Files that people edit by hand are
            better shown themselves.

    Returns:
        The places, one for each element; None when no run of xacro is known to have made the text.
    """
    root = parse_xml(text, "", Diagnostics()) if isinstance(text, str) else text
    if root is None:
        return None
    keys = keys_of(root)
    found = load_map(digest_of(keys))
    if found is not None and found.keys == keys:
        return found
    return None if exact else _nearest(keys)


def placed(root: Tag, *, exact: bool = False) -> Tag:
    """Return a tree with the places of the xacro files, where they are known.

    Args:
        root: a document.
        exact: as in `source_map_of`.
    """
    found = source_map_of(root, exact=exact)
    return root if found is None else with_places(root, found.places)


def _nearest(keys: Sequence[int]) -> SourceMap | None:
    sketch = sketch_of(keys)
    ranked = sorted(((_likeness(sketch, other), name) for name, other in sketches()), reverse=True)
    for likeness, name in ranked[:2]:
        found = load_map(name) if likeness >= _LEAST_ALIKE else None
        if found is None:
            continue
        pairs = aligned(found.keys, keys)
        equal = sum(
            old >= 0 and found.keys[old] == key for old, key in zip(pairs, keys, strict=True)
        )
        if equal >= _LEAST_PAIRED * len(keys):
            places = tuple(found.places[old] if old >= 0 else None for old in pairs)
            return SourceMap(tuple(keys), places, is_exact=False)
    return None


def _likeness(one: Sequence[int], other: Sequence[int]) -> float:
    """Estimate which part of two texts' elements is common (Broder's min-wise sketch)."""
    size = max(1, min(len(one), len(other)))
    smallest = set(sorted({*one, *other})[:size])
    return len(smallest & set(one) & set(other)) / size
