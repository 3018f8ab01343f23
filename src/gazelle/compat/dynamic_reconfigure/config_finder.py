"""Imports of ``PKG.cfg.NAMEConfig``: modules made of a package's ``cfg/NAME.cfg``."""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from importlib.machinery import ModuleSpec
from importlib.util import spec_from_loader
from pathlib import Path
from types import ModuleType
from typing import Any

from gazelle.compat.importlib_abc import Loader, MetaPathFinder

__all__ = ["ConfigFinder"]


class ConfigFinder(MetaPathFinder):
    """Finds ``PKG`` (if nobody else does), ``PKG.cfg`` and ``PKG.cfg.NAMEConfig``."""

    def __init__(self, folder_of: Callable[[str], Path | None]) -> None:
        """`folder_of` returns a package's folder in the workspace, or None."""
        self._folder_of = folder_of

    def find_spec(
        self,
        fullname: str,
        path: Sequence[str] | None,
        target: ModuleType | None = None,
    ) -> ModuleSpec | None:
        """Return how to make a module, None when it is not one of these."""
        package, _, rest = fullname.partition(".")
        part, _, name = rest.partition(".")
        if part not in {"", "cfg"} or fullname.startswith("_"):
            return None
        folder = self._folder_of(package)
        files = {} if folder is None else _files(folder)
        if not files:
            return None
        if not name:
            return spec_from_loader(fullname, _PackageLoader(), is_package=True)
        file = files.get(name.removesuffix("Config")) if name.endswith("Config") else None
        return None if file is None else spec_from_loader(fullname, _ConfigLoader(file))


class _PackageLoader(Loader):
    def exec_module(self, module: ModuleType) -> None:
        module.__path__ = []


class _ConfigLoader(Loader):
    """Runs a ``.cfg`` file, which is a Python program, as its package's build does."""

    def __init__(self, file: Path) -> None:
        self._file = file

    def exec_module(self, module: ModuleType) -> None:
        from gazelle.compat.dynamic_reconfigure.encoding import extract_params

        generator, name = self._run()
        description = generator.group.to_dict()
        rows = extract_params(description)
        module.__file__ = str(self._file)
        found: dict[str, Any] = {"config_description": description, "all_level": 0}
        for key, field in (("min", "min"), ("max", "max"), ("defaults", "default")):
            found[key] = {row["name"]: row[field] for row in rows}
        found["level"] = {row["name"]: row["level"] for row in rows}
        found["type"] = {row["name"]: row["type"] for row in rows}
        for row in rows:
            found["all_level"] |= row["level"]
        found |= {f"{name}_{row['name']}": row["value"] for row in generator.constants}
        vars(module).update(found)

    def _run(self) -> tuple[Any, str]:
        from gazelle.compat.dynamic_reconfigure import parameter_generator
        from gazelle.compat.python2 import compile_source

        file = self._file
        finished = parameter_generator.FINISHED
        before = len(finished)
        code = compile_source(file.read_bytes(), str(file))
        names = {"__name__": "__main__", "__file__": str(file), "__builtins__": __builtins__}
        argv, sys.argv = sys.argv, [str(file)]
        try:
            exec(code, names)  # noqa: S102 - a .cfg file is a program of the user's package
        except SystemExit as stop:
            if stop.code not in (None, 0):
                raise ImportError(f"'{file}' ended with {stop.code!r}") from stop
        finally:
            sys.argv = argv
        made = finished[before:]
        del finished[before:]
        if not made:
            raise ImportError(f"'{file}' does not call generate() of its ParameterGenerator")
        return made[-1]


def _files(folder: Path) -> dict[str, Path]:
    """Return the ``.cfg`` programs of a package by name; a folder ``cfg`` may be a Python one."""
    return {file.stem: file for file in sorted((folder / "cfg").rglob("*.cfg"))}
