"""The list that collects findings."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from gazelle.diagnostics.catalogue import entry_for
from gazelle.diagnostics.diagnostic import Diagnostic, Severity
from gazelle.diagnostics.share_links import as_written
from gazelle.diagnostics.span import SourceSpan
from gazelle.errors import UserFileError

__all__ = ["Diagnostics"]


class Diagnostics:
    """Collects findings; the same finding at the same place is kept once.

    Readers take one of these, report everything they see and go on; the caller decides with
    `raise_if_errors` when it is time to stop.
    """

    def __init__(self) -> None:
        self._items: dict[Diagnostic, None] = {}

    def __iter__(self) -> Iterator[Diagnostic]:
        return iter(self._items)

    def __len__(self) -> int:
        return len(self._items)

    def add(self, diagnostic: Diagnostic) -> None:
        """Keep one finding, unless the very same one is there already.

        Links that stand for installed files are told as the user's files.
        """
        self._items.setdefault(_of_users_files(diagnostic))

    def report(
        self,
        code: str,
        message: str,
        span: SourceSpan | None = None,
        *,
        fix: str = "",
        severity: Severity | None = None,
        phrase: str = "",
    ) -> None:
        """Add a finding by its catalogue code.

        Args:
            code: a code of the catalogue; gives the severity and the ROS phrase.
            message: what is wrong here, with the names and values of this case.
            span: where.
            fix: what to do here; the catalogue's general remedy when empty.
            severity: overrides the catalogue's.
            phrase: what ROS or Gazebo prints in this very case; the catalogue's when empty.

        Raises:
            KeyError: `code` is not in the catalogue.
        """
        entry = entry_for(code)
        chosen = Severity[entry.severity.upper()] if severity is None else severity
        self.add(Diagnostic(code, chosen, message, span, fix or entry.fix, phrase or entry.phrase))

    def extend(self, other: Diagnostics) -> None:
        """Keep all findings of another collection."""
        for item in other:
            self.add(item)

    def by_code(self, code: str) -> tuple[Diagnostic, ...]:
        """Return the findings with this code, in the order found."""
        return tuple(item for item in self._items if item.code == code)

    @property
    def errors(self) -> tuple[Diagnostic, ...]:
        """The findings of severity error, in the order found."""
        return tuple(item for item in self._items if item.severity is Severity.ERROR)

    @property
    def worst(self) -> Severity | None:
        """The highest severity collected, None when there is no finding."""
        return max((item.severity for item in self._items), default=None)

    def raise_if_errors(self) -> None:
        """Raise `UserFileError` with all findings when at least one is an error.

        Raises:
            UserFileError: an error was collected.
        """
        if self.errors:
            raise UserFileError(tuple(self._items))


def _of_users_files(item: Diagnostic) -> Diagnostic:
    span = None if item.span is None else item.span.as_written()
    message, fix = as_written(item.message), as_written(item.fix)
    if (span, message, fix) == (item.span, item.message, item.fix):
        return item
    return replace(item, span=span, message=message, fix=fix)
