"""Which panels a Python file has, read without running it."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

__all__ = ["PanelClass", "Unreadable", "panel_classes"]

_MODULES = ("gazelle.studio.plugins", "gazelle.studio.plugins.panel")
_MARK = "gazelle.studio"
_MAX_BYTES = 2 << 20
_TEXTS = ("title", "group", "about", "module")


class PanelClass(NamedTuple):
    """A class that derives from `Panel`.

    Attributes:
        name: of the class.
        line: where it begins.
        texts: class attributes that are written as plain texts: title, group, about, module.
    """

    name: str
    line: int
    texts: dict[str, str]


class Unreadable(NamedTuple):
    """Why a file's panels are not known; it names file and line."""

    reason: str


def panel_classes(file: Path) -> tuple[PanelClass, ...] | Unreadable:
    """Return the panels of a file in order; none when it does not speak of Studio."""
    try:
        if file.stat().st_size > _MAX_BYTES:
            return ()
        text = file.read_text(encoding="utf-8", errors="replace")
        if _MARK not in text:
            return ()
        tree = ast.parse(text, str(file))
    except SyntaxError as error:
        return Unreadable(f"{file}:{error.lineno}: SyntaxError: {error.msg}")
    except (OSError, ValueError, MemoryError, RecursionError) as error:
        return Unreadable(f"{file}: {error}")
    bases = set(_names_of_panel(tree))
    found = []
    for node in tree.body:
        if not isinstance(node, ast.ClassDef):
            continue
        if any(ast.unparse(base) in bases for base in node.bases):
            bases.add(node.name)
            if not node.name.startswith("_"):
                found.append(PanelClass(node.name, node.lineno, dict(_texts(node))))
    return tuple(found)


def _names_of_panel(tree: ast.Module) -> Iterator[str]:
    """Yield how the file may write the class `Panel`."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            for alias in node.names:
                if alias.name in _MODULES:
                    yield f"{alias.asname or alias.name}.Panel"
        elif isinstance(node, ast.ImportFrom):
            for alias in node.names:
                name = alias.asname or alias.name
                if node.module in _MODULES and alias.name in ("Panel", "*"):
                    yield "Panel" if alias.name == "*" else name
                elif f"{node.module}.{alias.name}" in _MODULES:
                    yield f"{name}.Panel"


def _texts(node: ast.ClassDef) -> Iterator[tuple[str, str]]:
    for statement in node.body:
        match statement:
            case ast.Assign(targets=[ast.Name(id=name)], value=ast.Constant(value=str(text))):
                pass
            case ast.AnnAssign(target=ast.Name(id=name), value=ast.Constant(value=str(text))):
                pass
            case _:
                continue
        if name in _TEXTS:
            yield name, text
