"""Parameters of MoveIt with the places they were written at, read one by one."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

from gazelle.diagnostics import Diagnostics, SourceSpan, did_you_mean

__all__ = ["Settings"]

Spans = Mapping[tuple[str, ...], SourceSpan]


@dataclass(frozen=True)
class Settings:
    """A branch of a parameter tree.

    Attributes:
        values: the branch, nested.
        diagnostics: receives what is wrong.
        path: keys from the root of the tree to this branch.
        spans: where each key was written, by its path from the root; empty for parameters that
            came without files.
    """

    values: Mapping[str, Any]
    diagnostics: Diagnostics
    path: tuple[str, ...] = ()
    spans: Spans = field(default_factory=dict)

    def span(self, key: str = "") -> SourceSpan | None:
        """Return where a key was written, or the nearest key above it that has a place."""
        path = (*self.path, key) if key else self.path
        while path and path not in self.spans:
            path = path[:-1]
        return self.spans.get(path)

    def name(self, key: str = "") -> str:
        """Return the full name of a key, with dots."""
        return ".".join((*self.path, key) if key else self.path)

    def branch(self, key: str) -> Settings:
        """Return the branch below a key; an empty one (reported) when it is something else."""
        value = self.values.get(key)
        if value is not None and not isinstance(value, Mapping):
            self._report_type(key, value, "a mapping")
        values = value if isinstance(value, Mapping) else {}
        return Settings(values, self.diagnostics, (*self.path, key), self.spans)

    def branches(self) -> Iterator[tuple[str, Settings]]:
        """Yield the keys that hold mappings."""
        for key, value in self.values.items():
            if isinstance(value, Mapping):
                yield str(key), self.branch(str(key))

    def entries(self) -> Iterator[tuple[str, Settings]]:
        """Yield every key as a branch; those that hold something else are reported."""
        for key in self.values:
            branch = self.branch(str(key))
            if isinstance(self.values[key], Mapping):
                yield str(key), branch
            elif self.values[key] is None:
                message = f"{self.name(str(key))} is empty; it has no effect"
                self.diagnostics.report("moveit.wrong-type", message, self.span(str(key)))

    def number(self, key: str) -> float | None:
        """Return a finite number; None when it is absent or (reported) something else."""
        value = self.values.get(key)
        if value is None:
            return None
        number = _number(value)
        if number is None:
            self._report_type(key, value, "a number")
        elif isinstance(value, str):
            message = f"{self.name(key)} is the text '{value}'; it is taken as {number:g}, MoveIt"
            message += " refuses it (YAML wants a dot and a signed exponent, as in 1.0e-3)"
            self.diagnostics.report("moveit.wrong-type", message, self.span(key))
        return number

    def flag(self, key: str) -> bool | None:
        """Return a truth value; None when it is absent or (reported) something else."""
        value = self.values.get(key)
        if value is None or isinstance(value, bool):
            return value
        if isinstance(value, str) and value.strip().lower() in ("true", "false"):
            return value.strip().lower() == "true"
        self._report_type(key, value, "true or false")
        return None

    def text(self, key: str, default: str = "") -> str:
        """Return a text; `default` when it is absent or (reported) something else."""
        value = self.values.get(key)
        if isinstance(value, str):
            return value.strip()
        if value is not None:
            self._report_type(key, value, "a text")
        return default

    def texts(self, key: str) -> tuple[str, ...]:
        """Return a list of texts, or the words of a text; empty when it is absent."""
        value = self.values.get(key)
        if isinstance(value, str):
            return tuple(value.split())
        if isinstance(value, list | tuple) and all(isinstance(item, str) for item in value):
            return tuple(item.strip() for item in value)
        if value is not None:
            self._report_type(key, value, "a list of texts")
        return ()

    def check_keys(self, known: Collection[str]) -> None:
        """Report keys that nothing reads."""
        for key in self.values:
            if key not in known:
                hint = did_you_mean(str(key), known)
                message = f"{self.name(str(key))} is not a parameter of MoveIt; it has no effect"
                self.diagnostics.report(
                    "moveit.unknown-key", message, self.span(str(key)), fix=hint
                )

    def check_name(self, name: str, kind: str, known: Collection[str]) -> bool:
        """Return whether the robot has what a key names; report it otherwise."""
        if name in known:
            return True
        owner = "the SRDF" if kind == "group" else "the robot"
        message = f"{self.name()} names {kind} '{name}'; {owner} has no such {kind}, the entry has"
        message += " no effect"
        hint = did_you_mean(name, known) or f"there are: {', '.join(known) or 'none'}"
        self.diagnostics.report("parameters.moveit-name", message, self.span(name), fix=hint)
        return False

    def _report_type(self, key: str, value: Any, wanted: str) -> None:
        message = f"{self.name(key)} is {_shown(value)}, not {wanted}; it has no effect"
        self.diagnostics.report("moveit.wrong-type", message, self.span(key))


def _number(value: Any) -> float | None:
    if isinstance(value, bool) or not isinstance(value, int | float | str):
        return None
    try:
        number = float(value)
    except (OverflowError, ValueError):
        return None
    return number if math.isfinite(number) else None


def _shown(value: Any) -> str:
    if isinstance(value, Mapping):
        return "a mapping"
    if isinstance(value, list | tuple):
        return "a list"
    return f"'{value}'"
