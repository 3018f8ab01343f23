"""Where something stands in a text the user wrote."""

from __future__ import annotations

from dataclasses import dataclass, replace

from gazelle.diagnostics.share_links import as_written

__all__ = ["SourceSpan"]


@dataclass(frozen=True, slots=True, order=True)
class SourceSpan:
    """A place in a file.

    Attributes:
        file: path as the user knows it, or a name in angle brackets such as
            ``<robot_description>`` for a text that has no file.
        line: line number from 1; 0 when only the file is known.
        column: column from 1; 0 when only the line is known.
        length: characters to underline; 0 when unknown.
        via: how one got there: include and macro stack, innermost first.
    """

    file: str
    line: int = 0
    column: int = 0
    length: int = 0
    via: tuple[SourceSpan, ...] = ()

    def __str__(self) -> str:
        text = self.file
        if self.line:
            text += f":{self.line}"
            if self.column:
                text += f":{self.column}"
        return text

    def as_written(self) -> SourceSpan:
        """Return the place in the user's file where `file` is a link to it."""
        file, via = as_written(self.file), tuple(item.as_written() for item in self.via)
        if file == self.file and via == self.via:
            return self
        return replace(self, file=file, via=via)
