"""The list that collects findings, and the ways to say many of them shortly."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import PurePath
from typing import NamedTuple

from gazelle.diagnostics.catalogue import entry_for
from gazelle.diagnostics.diagnostic import Diagnostic, Severity, SourceSpan
from gazelle.diagnostics.share_links import as_written
from gazelle.errors import UserFileError
from gazelle.rich_display import shown_by

__all__ = ["Brief", "Diagnostics", "brief", "grouped", "groups"]

# What differs between two findings of one kind: quoted names, elements, numbers.
_COUNT = re.compile(r" \(and \d+ more in this file\)")
_VARYING = re.compile(r"'[^'\n]*'|<[^<>\n]*>|(?<![\w.])-?\d[\w.+-]*")
_MIN_COUNT = 3
_SHOWN = 8


class Brief(NamedTuple):
    """Findings as they are said at a start.

    Attributes:
        shown: those that are said.
        kept: those that are for a list elsewhere: what one of the shown sums up, and what nobody
            has to do anything about.
    """

    shown: tuple[Diagnostic, ...]
    kept: tuple[Diagnostic, ...]


@shown_by("findings:findings_bundle")
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


def brief(findings: Iterable[Diagnostic], kept: str = "") -> Brief:
    """Sum up the findings about settings that are known and have no effect here.

    One of them is said as it is, without its general remedy; of several the first is said, with
    their number. What works and asks for nothing is not said. Warnings and errors stay whole, and
    so does everything else.

    Args:
        findings: in the order they were made.
        kept: where all of them can be read, such as a file.
    """
    items = tuple(findings)
    quiet = tuple(item for item in items if _is_quiet(item))
    items = tuple(item for item in items if not _is_quiet(item))
    idle = [item for item in items if _is_idle(item)]
    if not idle:
        return Brief(items, quiet)
    first, summed = idle[0], tuple(idle) if len(idle) > 1 else ()
    if not summed:
        summary = replace(first, fix=_own_fix(first))
    else:
        where = f"; all of them: {kept}" if kept else ""
        line = first.message.partition("\n")[0]
        text = f"{len(idle)} settings are known and have no effect here{where}; the first: {line}"
        summary = replace(first, message=text, fix="", phrase="")
    shown = [summary if item is first else item for item in items
             if item is first or not _is_idle(item)]  # fmt: skip
    return Brief(tuple(shown), (*summed, *quiet))


def grouped(findings: Iterable[Diagnostic], *, most: int = _SHOWN) -> tuple[Diagnostic, ...]:
    """Merge three or more findings that differ only in names, numbers and places.

    The first one stays and lists what the others are about. Errors are merged only when they
    say the very same, such as one missing model that is included ten times.

    Args:
        findings: in the order they were made.
        most: how many of the others are named, and places of each.

    Returns:
        The findings in the order of the first of each group.
    """
    return tuple(
        group[0] if len(group) == 1 else _merged(group, most) for group in groups(findings)
    )


def groups(findings: Iterable[Diagnostic]) -> tuple[tuple[Diagnostic, ...], ...]:
    """Return findings in the groups that `grouped` makes one of, most of them alone."""
    alike: dict[tuple[str, Severity, str], list[Diagnostic]] = {}
    for item in findings:
        alike.setdefault((item.code, item.severity, _kind(item)), []).append(item)
    found: list[tuple[Diagnostic, ...]] = []
    for group in alike.values():
        found += [(item,) for item in group] if len(group) < _MIN_COUNT else [tuple(group)]
    return tuple(found)


def _is_quiet(item: Diagnostic) -> bool:
    return item.severity is Severity.INFO and entry_for(item.code).quiet


def _is_idle(item: Diagnostic) -> bool:
    return item.severity is Severity.INFO and entry_for(item.code).idle


def _own_fix(item: Diagnostic) -> str:
    return "" if item.fix == entry_for(item.code).fix else item.fix


def _kind(item: Diagnostic) -> str:
    line = item.message.partition("\n")[0]
    return line if item.severity is Severity.ERROR else _VARYING.sub("*", _COUNT.sub("", line))


def _merged(group: Sequence[Diagnostic], most: int) -> Diagnostic:
    first, others = group[0], group[1:]
    column = _varying_column(group)
    names = _told_apart({item.span.file for item in group if item.span is not None})
    places: dict[str, list[str]] = {}
    for item in others:
        label = _pieces(item)[column] if column is not None else ""
        places.setdefault(label, []).append(_place(item, first, names))
    shown = [_described(label, lines, most) for label, lines in list(places.items())[:most]]
    rest = len(places) - len(shown)
    tail = f" and {rest} more" if rest else ""
    text = f"{first.message}\n  the same {len(others)} more times: {', '.join(shown)}{tail}"
    return replace(first, message=text)


def _described(label: str, lines: Sequence[str], most: int) -> str:
    where = list(dict.fromkeys(line for line in lines if line))
    text = f"{', '.join(where[:most])}{' …' if len(where) > most else ''}"
    if not label:
        return text or "at the same place"
    return f"{label} ({text})" if text else label


def _pieces(item: Diagnostic) -> list[str]:
    return _VARYING.findall(item.message.partition("\n")[0])


def _varying_column(group: Sequence[Diagnostic]) -> int | None:
    """Return which of the varying pieces tells the findings apart: the first that differs."""
    for index, pieces in enumerate(zip(*map(_pieces, group), strict=False)):
        if len(set(pieces)) > 1:
            return index
    return None


def _place(item: Diagnostic, first: Diagnostic, names: Mapping[str, str]) -> str:
    if item.span is None or item.span == first.span:
        return ""
    name = names[item.span.file]
    if first.span is not None and item.span.file == first.span.file:
        return "" if item.span.line in (0, first.span.line) else f"line {item.span.line}"
    return f"{name}:{item.span.line}" if item.span.line else name


def _told_apart(files: Iterable[str]) -> dict[str, str]:
    """Return the shortest end of each path that no other path has, its name at least."""
    paths = {file: PurePath(file) for file in files}
    alike: dict[str, set[PurePath]] = {}
    for path in paths.values():
        alike.setdefault(path.name, set()).add(path)
    depths = {name: _depth(same) for name, same in alike.items()}
    return {file: str(PurePath(*path.parts[-depths[path.name] :])) for file, path in paths.items()}


def _depth(paths: Collection[PurePath]) -> int:
    """Return how many parts at the end of paths tell all of them apart."""
    most = max(len(path.parts) for path in paths)
    return next(
        count for count in range(1, most + 2)
        if len({path.parts[-count:] for path in paths}) == len(paths)
    )  # fmt: skip


def _of_users_files(item: Diagnostic) -> Diagnostic:
    span = None if item.span is None else item.span.as_written()
    message, fix = as_written(item.message), as_written(item.fix)
    if (span, message, fix) == (item.span, item.message, item.fix):
        return item
    return replace(item, span=span, message=message, fix=fix)
