"""Where the elements of one expanded text come from."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable
from dataclasses import dataclass
from zlib import crc32

from gazelle.description.xml import Tag
from gazelle.diagnostics import SourceSpan

__all__ = ["SourceMap", "digest_of", "keys_of"]


@dataclass(frozen=True, slots=True)
class SourceMap:
    """Places of a text's elements.

    Attributes:
        keys: `keys_of` the text's elements in document order.
        places: where each was written, None where that is not known any more.
    """

    keys: tuple[int, ...]
    places: tuple[SourceSpan | None, ...]


def keys_of(root: Tag) -> tuple[int, ...]:
    """Return a number for each element, which stands for its name, attributes and text.

    Comments, white space, the order of attributes and declarations of namespaces do not matter.
    """
    return tuple(_key(tag) for tag in root.walk())


def digest_of(keys: Iterable[int]) -> str:
    """Return a name for a sequence of keys."""
    return hashlib.sha256(",".join(map(str, keys)).encode()).hexdigest()[:32]


def _key(tag: Tag) -> int:
    attributes = sorted(item for item in tag.attributes.items() if item[0][:5] != "xmlns")
    said = repr((attributes, tag.text.split())).encode()
    return crc32(tag.name.encode()) << 32 | crc32(said)
