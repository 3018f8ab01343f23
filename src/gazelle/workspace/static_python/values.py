"""What an expression may come to besides Python's own plain values, and the functions that make it.

Functions of the standard library that launch and setup files call work on names only.
"""

from __future__ import annotations

import ast
import glob
import os
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from itertools import islice
from pathlib import Path, PurePath
from typing import Any

__all__ = ["UNKNOWN", "Call", "Function", "Name", "Unknown", "is_known", "library", "method"]

_MAX_DEPTH = 40
_MAX = 5000
_MAX_LENGTH = 1_000_000
# A width that a format would fill the memory with.
_WIDE = re.compile(r"[%{:][^{}]*\d{5}")
_TEXT_METHODS = frozenset(
    {
        "capitalize", "endswith", "format", "join", "lower", "lstrip", "partition", "removeprefix",
        "removesuffix", "replace", "rpartition", "rsplit", "rstrip", "split", "splitlines",
        "startswith", "strip", "title", "upper", "%",
    }
)  # fmt: skip
_PATH_METHODS = frozenset({"as_posix", "joinpath", "with_name", "with_suffix", "relative_to"})
_DICT_METHODS = frozenset({"copy", "get", "items", "keys", "values"})


class Unknown:
    """A value that only running the file would tell."""

    def __repr__(self) -> str:
        return "UNKNOWN"


@dataclass(frozen=True, slots=True)
class Name:
    """Something imported or built in, by its full dotted name."""

    dotted: str

    @property
    def last(self) -> str:
        """The name after the last dot."""
        return self.dotted.rpartition(".")[2]


@dataclass(frozen=True, slots=True, eq=False)
class Call:
    """A call of something whose outcome is not computed, such as ``Node(package=…)``.

    Attributes:
        function: full dotted name of what is called; a method's begins with that of its object.
        arguments: values of the arguments by position.
        keywords: values of the arguments by name.
        node: the call in the syntax tree, for its place.
        owner: the object whose method it is, None for functions.
    """

    function: str
    arguments: tuple[Any, ...]
    keywords: Mapping[str, Any]
    node: ast.Call = field(repr=False)
    owner: Any = None

    @property
    def name(self) -> str:
        """The function's name after the last dot."""
        return self.function.rpartition(".")[2]

    def get(self, name: str, position: int | None = None, default: Any = None) -> Any:
        """Return an argument by name, or by its position when it has no name."""
        if name in self.keywords:
            return self.keywords[name]
        if position is not None and position < len(self.arguments):
            return self.arguments[position]
        return default


@dataclass(frozen=True, slots=True, eq=False)
class Function:
    """A function defined in the file."""

    node: ast.FunctionDef | ast.Lambda


UNKNOWN = Unknown()


def is_known(value: Any, depth: int = 0) -> bool:
    """Tell whether a value has nothing in it that only running the file would tell."""
    if depth > _MAX_DEPTH:
        return False
    if isinstance(value, list | tuple | set):
        return all(is_known(item, depth + 1) for item in value)
    if isinstance(value, dict):
        return all(is_known(item, depth + 1) for item in value.values())
    return value is None or isinstance(value, str | bytes | int | float | PurePath)


def library(folder: Path, file: Path, environ: Mapping[str, str]) -> dict[str, Callable[..., Any]]:
    """Return what is computed, by dotted name.

    Args:
        folder: what relative paths are relative to; only names of files are looked at.
        file: the file being read, for ``__file__``.
        environ: environment variables.
    """

    def found(pattern: str, recursive: bool = False, **_others: Any) -> list[str]:
        names = islice(glob.iglob(pattern, root_dir=folder, recursive=recursive), _MAX)  # noqa: PTH207
        return sorted(names)

    def inside(base: PurePath, pattern: str) -> list[PurePath]:
        return [PurePath(name) for name in found(str(base / pattern), recursive=True)]

    def walked(top: str, **_others: Any) -> list[tuple[str, list[str], list[str]]]:
        base = folder / top
        rows = islice(os.walk(base), _MAX)
        return [(os.path.join(top, os.path.relpath(r, base)) if r != str(base) else top, d, f)  # noqa: PTH118
                for r, d, f in rows]  # fmt: skip

    def listed(top: str = ".") -> list[str]:
        return sorted(path.name for path in islice((folder / top).iterdir(), _MAX))

    def variable(name: str, default: Any = UNKNOWN) -> Any:
        return environ.get(name, default)

    own: dict[str, Callable[..., Any]] = {
        "glob.glob": found,
        "os.walk": walked,
        "os.listdir": listed,
        "os.getenv": variable,
        "os.environ.get": variable,
        "os.getcwd": lambda: str(folder),
        "os.path.abspath": lambda path: str(folder / path),
        "os.path.realpath": lambda path: str(folder / path),
        "os.path.exists": lambda path: (folder / path).exists(),
        "os.path.isfile": lambda path: (folder / path).is_file(),
        "os.path.isdir": lambda path: (folder / path).is_dir(),
        "pathlib.Path.glob": inside,
        "pathlib.Path.iterdir": lambda base: inside(base, "*"),
        "pathlib.Path.rglob": lambda base, pattern: inside(base / "**", pattern),
        "pathlib.Path.cwd": lambda: PurePath(folder),
    }
    return {**_PURE, **own}


def method(owner: Any, name: str, arguments: tuple[Any, ...], keywords: dict[str, Any]) -> Any:
    """Return what a method of a plain value gives, `UNKNOWN` when it is none of the harmless."""
    if isinstance(owner, str) and name in _TEXT_METHODS:
        if not is_known(arguments) or not is_known(keywords):
            return UNKNOWN
        if (len(owner) + 1) * _length(arguments) > _MAX_LENGTH or _WIDE.search(owner):
            return UNKNOWN
        return owner % arguments[0] if name == "%" else getattr(owner, name)(*arguments, **keywords)
    if isinstance(owner, PurePath) and name in _PATH_METHODS and is_known(arguments):
        return getattr(owner, name)(*arguments)
    if isinstance(owner, PurePath) and name in {"resolve", "absolute", "expanduser"}:
        return owner
    if isinstance(owner, dict) and name in _DICT_METHODS:
        found = getattr(owner, name)(*arguments)
        return found if name in {"get", "copy"} else list(found)
    return UNKNOWN


def _length(arguments: tuple[Any, ...]) -> int:
    return 1 + sum(len(item) if isinstance(item, str) else len(str(item)) for item in arguments)


def _joined(*parts: Any) -> str:
    return os.path.join(*map(str, parts))  # noqa: PTH118


_PURE: dict[str, Callable[..., Any]] = {
    "os.path.join": _joined,
    "os.path.basename": os.path.basename,
    "os.path.dirname": os.path.dirname,
    "os.path.normpath": os.path.normpath,
    "os.path.splitext": os.path.splitext,
    "os.path.expanduser": os.path.expanduser,
    "os.path.relpath": os.path.relpath,
    "pathlib.Path": PurePath,
    "pathlib.PurePath": PurePath,
    "bool": bool,
    "dict": dict,
    "enumerate": lambda items, start=0: list(enumerate(items, start)),
    "float": float,
    "int": int,
    "len": len,
    "list": list,
    "range": lambda *numbers: list(islice(range(*numbers), _MAX)),
    "set": lambda items=(): list(dict.fromkeys(items)),
    "sorted": sorted,
    "str": str,
    "tuple": tuple,
    "zip": lambda *lists: list(zip(*lists, strict=False)),
}
