"""Stands in for compiling: programs are shell scripts that say their arguments."""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import ModuleType
from typing import Any, Self

import pytest

from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.launch import cpp_nodes, node_commands
from gazelle.workspace import Package

__all__ = ["FakeBuild"]

Wanted = Sequence[tuple[Package, str, SourceSpan | None]]


class FakeBuild:
    """Makes shell scripts of programs; those named ``bad…`` it does not compile.

    Attributes:
        batches: the names that were asked for together.
        log: what happened, in order; tests add to it.
    """

    def __init__(self, folder: Path) -> None:
        self.batches: list[list[str]] = []
        self.log: list[str] = []
        self._folder = folder

    @classmethod
    def instead_of_compiling(cls, folder: Path, monkeypatch: pytest.MonkeyPatch) -> Self:
        """Take the place of what compiles while a test runs; scripts go to a folder."""
        fake = cls(folder)
        module = ModuleType("gazelle.cpp.building.build")
        module.ensure_all_built = fake.ensure_all_built  # type: ignore[attr-defined]
        monkeypatch.setitem(sys.modules, "gazelle.cpp.building.build", module)
        for user in (node_commands, cpp_nodes):
            monkeypatch.setattr(user, "host_command", lambda path: (str(path),))
        return fake

    def ensure_all_built(
        self, wanted: Wanted, *, diagnostics: Diagnostics, **_rest: Any
    ) -> Mapping[tuple[str, str], Path]:
        names = [name for _package, name, _span in wanted]
        self.batches.append(names)
        self.log += [f"compile {name}" for name in names]
        made = {}
        for package, name, span in wanted:
            if not name:
                continue
            if name.startswith("bad"):
                text = f"'{name}' of package '{package.name}' does not compile"
                diagnostics.report("launch.compiled-node", text, span)
                continue
            file = self._folder / name
            file.write_text(f'#!/bin/sh\necho "{name} runs: $*"\n', encoding="utf-8")
            file.chmod(0o755)
            made[package.name, name] = file
        return made
