"""Importing single Python files of a user's package: controllers, plug-ins."""

from __future__ import annotations

import importlib.util
import sys
from collections.abc import Sequence
from functools import lru_cache
from pathlib import Path
from types import ModuleType

__all__ = ["import_python_file"]


def import_python_file(path: Path, name: str, *, folders: Sequence[Path] = ()) -> ModuleType:
    """Import a file as a module; once, and again when it has changed.

    Args:
        path: the file.
        name: of the module, such as ``gazelle_user_controllers.package.file``.
        folders: where it may import from, besides its own folder; those that are not there are
            left out.

    Raises:
        Exception: whatever the file raises.
    """
    places = tuple(str(folder) for folder in (path.parent, *folders) if folder.is_dir())
    return _imported(str(path), path.stat().st_mtime_ns, name, places)


@lru_cache(maxsize=64)
def _imported(path: str, mtime_ns: int, name: str, folders: tuple[str, ...]) -> ModuleType:
    sys.path.extend(folder for folder in folders if folder not in sys.path)
    spec = importlib.util.spec_from_file_location(name, path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    try:
        spec.loader.exec_module(module)
    except BaseException:
        sys.modules.pop(name, None)
        raise
    return module
