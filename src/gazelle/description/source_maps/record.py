"""Where the elements of one expanded text come from."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from zlib import crc32

from gazelle.description.xml import Tag
from gazelle.diagnostics import SourceSpan

__all__ = ["SourceMap", "digest_of", "keys_of", "name_part", "sketch_of"]

_SKETCH_SIZE = 64


@dataclass(frozen=True, slots=True)
class SourceMap:
    """Places of a text's elements.

    Attributes:
        keys: `keys_of` the text's elements in document order.
        places: where each was written, None where that is not known any more.
        is_exact: the text has the very elements that xacro wrote.
    """

    keys: tuple[int, ...]
    places: tuple[SourceSpan | None, ...]
    is_exact: bool = True


def keys_of(root: Tag) -> tuple[int, ...]:
    """Return a number for each element, which stands for its name and attributes.

    Text, comments, white space, the order of attributes and declarations of namespaces do not
    matter.
    """
    return tuple(_key(tag) for tag in root.walk())


def name_part(key: int) -> int:
    """Return the part of a key that stands for the element's name alone."""
    return key >> 32


def digest_of(keys: Iterable[int]) -> str:
    """Return a name for a sequence of keys."""
    return hashlib.sha256(",".join(map(str, keys)).encode()).hexdigest()[:32]


def sketch_of(keys: Sequence[int]) -> list[int]:
    """Return the smallest of the keys' hashes: two texts share as many as they have in common."""
    return sorted({key & 0xFFFFFFFF for key in keys})[:_SKETCH_SIZE]


def _key(tag: Tag) -> int:
    name = tag.name.encode()
    attributes = sorted(item for item in tag.attributes.items() if item[0][:5] != "xmlns")
    return (crc32(name) & 0xFFFF) << 32 | crc32(repr(attributes).encode(), crc32(name))
