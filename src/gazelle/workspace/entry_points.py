"""Console scripts of Python packages, read from setup files without running them."""

from __future__ import annotations

import ast
import configparser
from pathlib import Path

__all__ = ["console_scripts"]


def console_scripts(folder: Path) -> dict[str, str]:
    """Return executable names and their ``module:function`` of a package's source folder.

    Reads ``setup.py`` as a syntax tree (code in it does not run), ``setup.cfg`` and
    ``pyproject.toml``. A file that cannot be parsed gives nothing.
    """
    scripts: dict[str, str] = {}
    for reader, name in (
        (_from_pyproject, "pyproject.toml"),
        (_from_cfg, "setup.cfg"),
        (_from_setup, "setup.py"),
    ):
        path = folder / name
        if path.is_file():
            try:
                scripts.update(reader(path.read_text(encoding="utf-8")))
            except (
                OSError,
                ValueError,
                SyntaxError,
                MemoryError,
                RecursionError,
                configparser.Error,
            ):
                continue
    return scripts


def _from_setup(text: str) -> dict[str, str]:
    tree = ast.parse(text)
    names = {
        node.targets[0].id: node.value.value
        for node in tree.body
        if isinstance(node, ast.Assign)
        and isinstance(node.targets[0], ast.Name)
        and isinstance(node.value, ast.Constant)
        and isinstance(node.value.value, str)
    }
    found: dict[str, str] = {}
    for node in ast.walk(tree):
        if isinstance(node, ast.Dict):
            for key, value in zip(node.keys, node.values, strict=True):
                if isinstance(key, ast.Constant) and key.value == "console_scripts":
                    found.update(_pairs(_strings(value, names)))
    return found


def _strings(node: ast.expr, names: dict[str, str]) -> list[str]:
    if isinstance(node, ast.List | ast.Tuple):
        texts = (_text(item, names) for item in node.elts)
        return [text for text in texts if text is not None]
    text = _text(node, names)
    return text.splitlines() if text is not None else []


def _text(node: ast.expr, names: dict[str, str]) -> str | None:
    """Evaluate the string expressions people write: literals, ``+``, f-strings, names."""
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        return node.value
    if isinstance(node, ast.Name):
        return names.get(node.id)
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add):
        left, right = _text(node.left, names), _text(node.right, names)
        return left + right if left is not None and right is not None else None
    if isinstance(node, ast.FormattedValue):
        return _text(node.value, names)
    if isinstance(node, ast.JoinedStr):
        parts = [_text(value, names) for value in node.values]
        return None if None in parts else "".join(part for part in parts if part is not None)
    return None


def _from_cfg(text: str) -> dict[str, str]:
    parser = configparser.ConfigParser(interpolation=None)
    parser.read_string(text)
    value = parser.get("options.entry_points", "console_scripts", fallback="")
    return _pairs(value.splitlines())


def _from_pyproject(text: str) -> dict[str, str]:
    # Few packages of ROS have the file, and its reader takes as long to import as Python itself.
    import tomllib

    scripts = tomllib.loads(text).get("project", {}).get("scripts", {})
    return {str(name): str(target) for name, target in scripts.items()}


def _pairs(lines: list[str]) -> dict[str, str]:
    split = (line.partition("=") for line in lines if "=" in line)
    return {name.strip(): target.strip() for name, _, target in split}
