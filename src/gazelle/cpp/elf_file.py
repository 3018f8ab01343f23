"""What an ELF file says of itself: the libraries it needs, and whether it is a node of ours."""

from __future__ import annotations

import mmap
import struct
from collections.abc import Iterator
from pathlib import Path

__all__ = ["NODE_MARK", "is_node_file", "needed_libraries"]

NODE_MARK = b"gazelle-node-abi-1"
"""What `runtime/core/node_start.c` writes into every node's file."""

_PT_LOAD, _PT_DYNAMIC = 1, 2
_NEEDED, _STRTAB, _RPATH, _RUNPATH = 1, 5, 15, 29


def is_node_file(file: Path) -> bool:
    """Tell whether a file is a node that Gazelle's toolchain has linked."""
    try:
        with file.open("rb") as opened:
            if opened.read(4) != b"\x7fELF":
                return False
            with mmap.mmap(opened.fileno(), 0, access=mmap.ACCESS_READ) as data:
                return data.find(NODE_MARK) >= 0
    except (OSError, ValueError):
        return False


def needed_libraries(file: Path) -> list[tuple[str, Path | None]]:
    """Return the names of the libraries a file needs, with the place where its path has them."""
    try:
        data = file.read_bytes()
        return list(_needed(data, file))
    except (OSError, struct.error, ValueError, IndexError):
        # No ELF file, or a damaged one: what loads it will say so.
        return []


def _needed(data: bytes, file: Path) -> Iterator[tuple[str, Path | None]]:
    if data[:5] != b"\x7fELF\x02":
        return
    (table,) = struct.unpack_from("<Q", data, 32)
    size, count = struct.unpack_from("<HH", data, 54)
    segments = [struct.unpack_from("<IIQQQQ", data, table + size * row) for row in range(count)]
    entries: list[tuple[int, int]] = []
    for kind, _, offset, _, _, length in segments:
        if kind == _PT_DYNAMIC:
            entries = [struct.unpack_from("<qQ", data, offset + at) for at in range(0, length, 16)]
    strings = next((value for tag, value in entries if tag == _STRTAB), None)
    if strings is None:
        return
    for kind, _, offset, address, _, length in segments:
        if kind == _PT_LOAD and address <= strings < address + length:
            strings = strings - address + offset
            break

    def text(at: int) -> str:
        start = strings + at
        return data[start : data.index(b"\0", start)].decode(errors="surrogateescape")

    folders: list[Path] = []
    for tag, value in entries:
        if tag in (_RPATH, _RUNPATH):
            words = text(value).replace("$ORIGIN", str(file.parent)).split(":")
            folders += [Path(word) for word in words if word]
    for tag, value in entries:
        if tag == _NEEDED:
            name = text(value)
            places = (folder / name for folder in folders)
            yield name, next((place for place in places if place.is_file()), None)
