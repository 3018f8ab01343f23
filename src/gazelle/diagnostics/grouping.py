"""Findings that say the same of many places, said once."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import replace
from pathlib import PurePath

from gazelle.diagnostics.diagnostic import Diagnostic, Severity

__all__ = ["grouped"]

# What differs between two findings of one kind: quoted names, elements, numbers.
_COUNT = re.compile(r" \(and \d+ more in this file\)")
_VARYING = re.compile(r"'[^'\n]*'|<[^<>\n]*>|(?<![\w.])-?\d[\w.+-]*")
_FEWEST = 3
_SHOWN = 8


def grouped(findings: Iterable[Diagnostic]) -> tuple[Diagnostic, ...]:
    """Merge three or more findings that differ only in names, numbers and places.

    The first one stays and lists what the others are about. Errors are merged only when they
    say the very same, such as one missing model that is included ten times.

    Args:
        findings: in the order they were made.

    Returns:
        The findings in the order of the first of each group.
    """
    groups: dict[tuple[str, Severity, str], list[Diagnostic]] = {}
    for item in findings:
        groups.setdefault((item.code, item.severity, _kind(item)), []).append(item)
    merged: list[Diagnostic] = []
    for group in groups.values():
        merged += group if len(group) < _FEWEST else [_merged(group)]
    return tuple(merged)


def _kind(item: Diagnostic) -> str:
    line = item.message.partition("\n")[0]
    return line if item.severity is Severity.ERROR else _VARYING.sub("*", _COUNT.sub("", line))


def _merged(group: Sequence[Diagnostic]) -> Diagnostic:
    first, others = group[0], group[1:]
    column = _varying_column(group)
    places: dict[str, list[str]] = {}
    for item in others:
        label = _pieces(item)[column] if column is not None else ""
        places.setdefault(label, []).append(_place(item, first))
    shown = [_described(label, lines) for label, lines in list(places.items())[:_SHOWN]]
    rest = len(places) - len(shown)
    tail = f" and {rest} more" if rest else ""
    text = f"{first.message}\n  the same {len(others)} more times: {', '.join(shown)}{tail}"
    return replace(first, message=text)


def _described(label: str, lines: Sequence[str]) -> str:
    where = list(dict.fromkeys(line for line in lines if line))
    text = f"{', '.join(where[:_SHOWN])}{' …' if len(where) > _SHOWN else ''}"
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


def _place(item: Diagnostic, first: Diagnostic) -> str:
    if item.span is None or not item.span.line or item.span == first.span:
        return ""
    if first.span is not None and item.span.file == first.span.file:
        return "" if item.span.line == first.span.line else f"line {item.span.line}"
    return f"{PurePath(item.span.file).name}:{item.span.line}"
