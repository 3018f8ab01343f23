"""Modules with kernels in a folder, imported again as another process would."""

from __future__ import annotations

import importlib
import sys
from pathlib import Path
from typing import Any, NamedTuple

import pytest

from gazelle import announcements
from gazelle.kernels import compiling, kept_code, source

__all__ = ["Found", "Modules"]


class Found(NamedTuple):
    """What a call gave, how many kernels were compiled for it, and what the user was told."""

    result: Any
    compiled: int
    told: tuple[str, ...] = ()


class Modules:
    """Modules in a folder; `kernel` has the kernel `f`."""

    def __init__(self, folder: Path, patch: pytest.MonkeyPatch) -> None:
        self._folder, self._patch = folder, patch
        self._names = {"kernel"}
        patch.syspath_prepend(folder)
        patch.setattr(sys, "dont_write_bytecode", True)

    def write(self, **texts: str) -> None:
        """Write modules, by name."""
        for name, text in texts.items():
            (self._folder / f"{name}.py").write_text(text, encoding="utf-8")
        self._names |= texts.keys()

    def change(self, name: str, before: str, after: str) -> None:
        """Change a module's text."""
        text = (self._folder / f"{name}.py").read_text(encoding="utf-8")
        assert text.count(before) == 1
        self.write(**{name: text.replace(before, after)})

    def module(self, name: str = "kernel") -> Any:
        """Import all anew; what this process knows of kernels and has told is forgotten."""
        self._patch.setattr(kept_code, "_folders", {})
        self._patch.setattr(announcements, "_told", set())
        source._functions_of.cache_clear()
        self.forget()
        importlib.invalidate_caches()
        return importlib.import_module(name)

    def forget(self) -> None:
        """Leave no module behind."""
        for name in self._names:
            sys.modules.pop(name, None)

    def call(self, *arguments: Any) -> Found:
        """Call ``kernel.f`` as in a new process."""
        module, seen, told = self.module(), list[str](), list[str]()
        with (
            compiling(lambda one, _: seen.append(one.name)),
            announcements.announced_by(told.append),
        ):
            result = module.f(*arguments)
        return Found(result, len(seen), tuple(told))
