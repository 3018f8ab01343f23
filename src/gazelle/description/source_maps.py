"""From an expanded text, whatever process expanded it, back to the lines of the xacro files.

Every run of xacro keeps where its elements come from in the user's cache folder: files that are
few, small, whole or not there at all. Whoever gets the text later, as a parameter or from a file,
finds the places again by the text's elements, so comments, white space and the order of attributes
do not matter.
"""

from __future__ import annotations

import hashlib
import json
import os
import tempfile
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any
from zlib import crc32

from gazelle.cache_folders import is_trusted, is_usable, tell_not_kept
from gazelle.description.xml import Tag, parse_xml, with_spans
from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.user_folders import cache_folder

if TYPE_CHECKING:
    from gazelle.description.xacro import Expanded

__all__ = [
    "SourceMap",
    "digest_of",
    "keys_of",
    "load_map",
    "placed",
    "remember",
    "save_map",
    "source_map_of",
]

_VERSION = 2
_MAX_FILES = 64
_MAX_BYTES = 32_000_000
_MAX_ELEMENTS = 200_000


@dataclass(frozen=True, slots=True)
class SourceMap:
    """Places of a text's elements.

    Attributes:
        keys: `keys_of` the text's elements in document order.
        spans: where each was written, None where that is not known any more.
    """

    keys: tuple[int, ...]
    spans: tuple[SourceSpan | None, ...]


def keys_of(root: Tag) -> tuple[int, ...]:
    """Return a number for each element, which stands for its name, attributes and text.

    Comments, white space, the order of attributes and declarations of namespaces do not matter.
    """
    return tuple(_key(tag) for tag in root.walk())


def digest_of(keys: Iterable[int]) -> str:
    """Return a name for a sequence of keys; it begins with their number."""
    items = tuple(keys)
    digest = hashlib.sha256(",".join(map(str, items)).encode()).hexdigest()[:32]
    return f"{len(items)}-{digest}"


def save_map(source_map: SourceMap) -> None:
    """Keep a map; where that cannot be it is told once, since it is a help only."""
    head = json.dumps({"version": _VERSION})
    data = f"{head}\n{json.dumps(_packed(source_map), separators=(',', ':'))}\n"
    folder = _folder()
    if not is_usable(folder):
        return
    made: Path | None = None
    try:
        number, name = tempfile.mkstemp(dir=folder, prefix=".new-")
        made = Path(name)
        with os.fdopen(number, "w", encoding="utf-8") as stream:
            stream.write(data)
        made.replace(folder / f"{digest_of(source_map.keys)}.json")
        _drop_oldest(folder)
    except OSError as error:
        tell_not_kept("places of xacro files", folder, error)
        if made is not None:
            made.unlink(missing_ok=True)


def load_map(name: str) -> SourceMap | None:
    """Return the map of this digest, None when there is none that can be read.

    Places in files that have changed since are left out.
    """
    if not is_trusted(_folder()):
        return None
    try:
        lines = (_folder() / f"{name}.json").read_text(encoding="utf-8").split("\n")
        known = json.loads(lines[0])["version"] == _VERSION
        return _unpacked(json.loads(lines[1])) if known else None
    except (OSError, ValueError, LookupError, TypeError):
        return None


def source_map_of(text: str | Tag) -> SourceMap | None:
    """Return where the elements of a text come from.

    Args:
        text: a document, also one without comments or in other white space. A text that was
            changed otherwise may be another robot's and is no one's.

    Returns:
        The places, one for each element; None when no run of xacro is known to have made the text.
    """
    root = parse_xml(text, "", Diagnostics()) if isinstance(text, str) else text
    if root is None or not _has_maps_of(sum(1 for _ in root.walk())):
        return None
    keys = keys_of(root)
    found = load_map(digest_of(keys))
    return found if found is not None and found.keys == keys else None


def placed(root: Tag) -> Tag:
    """Return a tree with the places of the xacro files, where they are known."""
    found = source_map_of(root)
    return root if found is None else with_spans(root, found.spans)


def remember(expanded: Expanded) -> None:
    """Keep the places of a text that leaves this process, in the user's cache folder.

    Args:
        expanded: what xacro made.
    """
    if len(expanded.spans) > _MAX_ELEMENTS:
        return
    root = parse_xml(expanded.text, expanded.file, Diagnostics())
    if root is not None:
        save_map(SourceMap(keys_of(root), expanded.spans))


def _key(tag: Tag) -> int:
    attributes = sorted(item for item in tag.attributes.items() if item[0][:5] != "xmlns")
    said = repr((attributes, tag.text.split())).encode()
    return crc32(tag.name.encode()) << 32 | crc32(said)


def _has_maps_of(count: int) -> bool:
    """Tell whether a text of so many elements is known, which is sooner known than its keys."""
    try:
        return any(path.name.startswith(f"{count}-") for path in _folder().iterdir())
    except OSError:
        return False


def _folder() -> Path:
    return cache_folder() / "xacro_maps"


def _packed(source_map: SourceMap) -> dict[str, Any]:
    """Return a map as numbers that point into tables of files, places and ways there."""
    files: dict[str, int] = {}
    spans: dict[tuple[int, ...], int] = {}
    ways: dict[tuple[int, ...], int] = {}

    def place_number(span: SourceSpan) -> int:
        # The folder a later process runs in is another one.
        file = files.setdefault(os.path.abspath(span.file), len(files))  # noqa: PTH100
        key = (file, span.line, span.column, span.length)
        return spans.setdefault(key, len(spans))

    elements: list[tuple[int, int]] = []
    for span in source_map.spans:
        if span is None:
            elements.append((-1, -1))
            continue
        way = tuple(place_number(call) for call in span.via)
        elements.append((place_number(span), ways.setdefault(way, len(ways))))
    return {
        "files": [[name, *_state(name)] for name in files],
        "places": list(spans),
        "ways": list(ways),
        "keys": source_map.keys,
        "elements": elements,
    }


def _unpacked(data: dict[str, Any]) -> SourceMap:
    names = [name if [size, time] == _state(name) else "" for name, size, time in data["files"]]
    table = [
        SourceSpan(names[file], line, column, length)
        for file, line, column, length in data["places"]
    ]
    ways = [tuple(table[index] for index in way if table[index].file) for way in data["ways"]]
    spans: list[SourceSpan | None] = []
    for place, way in data["elements"]:
        span = table[place] if place >= 0 else None
        known = span is not None and span.file
        spans.append(_with_way(span, ways[way]) if span is not None and known else None)
    return SourceMap(tuple(data["keys"]), tuple(spans))


def _with_way(span: SourceSpan, way: tuple[SourceSpan, ...]) -> SourceSpan:
    return SourceSpan(span.file, span.line, span.column, span.length, way)


def _state(name: str) -> list[int]:
    """Return what changes when a file is edited."""
    try:
        found = Path(name).stat()
    except OSError:
        return [-1, -1]
    return [found.st_size, found.st_mtime_ns]


def _drop_oldest(folder: Path) -> None:
    found = [(path.stat().st_mtime_ns, path.stat().st_size, path) for path in folder.iterdir()]
    total = 0
    for index, (_, size, path) in enumerate(sorted(found, reverse=True)):
        total += size
        if index >= _MAX_FILES or (total > _MAX_BYTES and index):
            path.unlink(missing_ok=True)
