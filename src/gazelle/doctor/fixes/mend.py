"""Trying fixes: one is kept when its finding goes and nothing comes for it."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from typing import NamedTuple, Protocol

from gazelle.diagnostics import Diagnostic, Severity
from gazelle.doctor.fixes.candidates import Candidate, candidates, unreadable
from gazelle.doctor.fixes.edits import SourceText, edited

__all__ = ["Mended", "Ward", "mend"]

# Codes of readers: what a robot is kept away by.
_READING = ("launch.", "urdf.", "xacro.", "xml.")
_MAX_FINDINGS = 300
_CLAUSE = re.compile(r"[:;] ")
_NUMBER = re.compile(r"\d+")


class Ward(Protocol):
    """Files that may be changed, and what the doctor says of them."""

    def read(self, file: str) -> SourceText | None:
        """Return a file's text, None for one that is not the user's."""

    def write(self, file: str, text: str) -> None:
        """Change a file."""

    def examine(self) -> Sequence[Diagnostic]:
        """Return what is found now."""


class Mended(NamedTuple):
    """A finding and what was written for it.

    Attributes:
        finding: that is gone.
        candidate: what made it go.
    """

    finding: Diagnostic
    candidate: Candidate


def mend(
    ward: Ward,
    findings: Sequence[Diagnostic],
    *,
    wanted: Callable[[Diagnostic], bool] = lambda item: item.severity > Severity.INFO,
    only_certain: bool = False,
    say: Callable[[str], None] = lambda _text: None,
) -> list[Mended]:
    """Mend what can be mended, in the files of a ward.

    Args:
        ward: its files are changed.
        findings: of them, as they are.
        wanted: which of them.
        only_certain: leave out what is one of several ways, or an estimate.
        say: told what is tried.
    """
    mended: list[Mended] = []
    hopeless: set[tuple[str, str, str]] = set()
    for _ in range(_MAX_FINDINGS):
        left = [item for item in findings if wanted(item) and _kind(item) not in hopeless]
        if not left:
            break
        item = max(left, key=lambda one: one.severity)
        say(item.message.partition("\n")[0])
        found = _tried(ward, item, findings, only_certain=only_certain)
        if found is None:
            hopeless.add(_kind(item))
            continue
        candidate, findings = found
        mended.append(Mended(item, candidate))
    return mended


def _tried(
    ward: Ward, finding: Diagnostic, before: Sequence[Diagnostic], *, only_certain: bool
) -> tuple[Candidate, Sequence[Diagnostic]] | None:
    """Keep the first candidate after which the finding is gone and none has come.

    Mending what cannot be read brings out what else is wrong: there it is the one after which
    the fewest come.
    """
    best: tuple[tuple[int, int], Candidate, Sequence[Diagnostic]] | None = None
    known = Counter(map(_kind, before))
    for candidate in candidates(finding, ward.read):
        source = ward.read(candidate.file)
        if source is None or (only_certain and not candidate.is_certain):
            continue
        ward.write(candidate.file, edited(source.text, candidate.edits))
        after = ward.examine()
        ward.write(candidate.file, source.text)
        if Counter(map(_kind, after))[_kind(finding)] >= known[_kind(finding)]:
            continue
        come = _come(known, after)
        if come and not _may_come(come, finding, candidate):
            continue
        if any(_is_alike(item, finding, candidate) for item in come):
            continue
        errors = sum(item.severity is Severity.ERROR for item in come)
        order = errors, len(come)
        if best is None or order < best[0]:
            best = order, candidate, after
        if not come:
            break
    if best is None:
        return None
    _, candidate, after = best
    source = ward.read(candidate.file)
    assert source is not None
    ward.write(candidate.file, edited(source.text, candidate.edits))
    return candidate, after


def _may_come(come: Sequence[Diagnostic], finding: Diagnostic, candidate: Candidate) -> bool:
    """Tell whether what has come may have been there, unseen: an error keeps a robot away."""
    if not unreadable(finding.code) and finding.severity is not Severity.ERROR:
        return False
    errors = [item for item in come if item.severity is Severity.ERROR]
    is_read = not any(item.code.startswith(_READING) for item in errors)
    return is_read or (unreadable(finding.code) and candidate.is_certain)


def _is_alike(item: Diagnostic, finding: Diagnostic, candidate: Candidate) -> bool:
    """Tell the same mistake in other words from another one of its kind further down the file."""
    if item.code != finding.code or item.span is None or finding.span is None:
        return False
    is_below = item.span.line > finding.span.line and candidate.is_certain
    return item.span.file == finding.span.file and not is_below


def _come(known: Counter[tuple[str, str, str]], after: Iterable[Diagnostic]) -> list[Diagnostic]:
    left = Counter(known)
    come = []
    for item in after:
        if left[_kind(item)] > 0:
            left[_kind(item)] -= 1
        elif item.severity > Severity.INFO:
            come.append(item)
    return come


def _kind(item: Diagnostic) -> tuple[str, str, str]:
    """Name a finding: lines and numbers may move, and what is said of it further on."""
    first = item.message.partition("\n")[0]
    if not unreadable(item.code):
        first = _CLAUSE.split(first)[0]
    message = _NUMBER.sub("0", first)
    return item.code, item.span.file if item.span else "", message
