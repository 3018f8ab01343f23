"""Tables as text: a row on one line as wide as it is, or folded where a terminal ends.

A word of a cell is broken nowhere but behind a part of a path or of a scoped name, so that places
and names can be copied and searched for.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from gazelle.doctor import Section

__all__ = ["table_lines", "table_title"]

_GAP = "   "
_RULE = "─"
_LEAST = 8
# A word, or a part of a path with what parts it from the next.
_PIECES = re.compile(r"\s+|[^\s/:]*(?:/|:+(?!\d))|[^\s/:]+(?::\d+)*[^\s/:]*|\S")


def table_title(section: Section) -> str:
    """Return the headline of a table with what it is about."""
    return f"{section.title} of {section.subject}" if section.subject else section.title


def table_lines(
    section: Section, width: int | None = None, rows: Sequence[Sequence[str]] | None = None
) -> list[str]:
    """Return the head and the rows of a table.

    Args:
        section: the table.
        width: columns of the terminal; None where nobody asks for less than the table needs.
        rows: those of its rows that are shown; all when None.
    """
    shown = section.rows if rows is None else rows
    cells = [[_printable(cell) for cell in row] for row in (section.columns, *shown)]
    widths = [max(map(_width, column)) for column in zip(*cells, strict=True)]
    if width is not None:
        widths = _narrowed(cells, widths, width - len(_GAP) * (len(widths) - 1))
    head, *body = (list(_row(row, widths)) for row in cells)
    rule = _RULE * (sum(widths) + len(_GAP) * (len(widths) - 1))
    return [*head, rule, *(line for lines in body for line in lines)]


def _printable(cell: str) -> str:
    """Return a text of a user's file that does not steer the terminal."""
    return "".join(one if one.isprintable() else " " for one in cell)


def _width(text: str) -> int:
    from rich.cells import cell_len

    return cell_len(text)


def _narrowed(cells: Sequence[Sequence[str]], widths: Sequence[int], room: int) -> list[int]:
    """Take from the widest columns what is too much, as far as their words can be parted."""
    least = [
        min(widest, max(_LEAST, *(_longest_piece(cell) for cell in column)))
        for widest, column in zip(widths, zip(*cells, strict=True), strict=True)
    ]
    found = list(widths)
    while sum(found) > room:
        index = max(range(len(found)), key=lambda at: (found[at] > least[at], found[at]))
        if found[index] <= least[index]:
            break
        found[index] -= 1
    return [max(map(_width, _folded_column(column, width)))
            for column, width in zip(zip(*cells, strict=True), found, strict=True)]  # fmt: skip


def _folded_column(column: Sequence[str], width: int) -> list[str]:
    return [line for cell in column for line in _folded(cell, width)]


def _longest_piece(cell: str) -> int:
    return max(map(_width, _PIECES.findall(cell)), default=0)


def _folded(cell: str, width: int) -> Iterator[str]:
    if _width(cell) <= width:
        yield cell.rstrip()
        return
    line = indent = cell[: len(cell) - len(cell.lstrip())]
    for piece in _PIECES.findall(cell.lstrip()):
        if line.strip() and _width(line) + _width(piece.rstrip()) > width:
            yield line.rstrip()
            line = indent
        line += "" if not line.strip() and piece.isspace() else piece
    yield line.rstrip()


def _row(row: Sequence[str], widths: Sequence[int]) -> Iterator[str]:
    columns = [list(_folded(cell, width)) for cell, width in zip(row, widths, strict=True)]
    for at in range(max(map(len, columns))):
        texts = [lines[at] if at < len(lines) else "" for lines in columns]
        padded = [text + " " * (width - _width(text))
                  for text, width in zip(texts, widths, strict=True)]  # fmt: skip
        yield _GAP.join(padded).rstrip()
