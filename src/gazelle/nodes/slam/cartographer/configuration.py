"""What a configuration of cartographer says, by the flags of its nodes.

Files are looked for in ``-configuration_directory``, then in the package ``cartographer`` of the
workspace; cartographer's own ``map_builder.lua`` and the like need not be there: their tables are,
without numbers.
"""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from gazelle.diagnostics import SourceSpan, did_you_mean
from gazelle.documents import read_text_limited
from gazelle.documents.files import is_file
from gazelle.errors import LaunchError
from gazelle.nodes.gflags import Kind, read_flags
from gazelle.nodes.slam.cartographer.lua_interpreter import Builtin, LuaTable, Machine, text_of
from gazelle.nodes.slam.cartographer.lua_parser import failure, parse

__all__ = ["flags_of", "read_configuration"]

_RENAMED = {
    "TRAJECTORY_BUILDER_2D.max_range": "max_range",
    "TRAJECTORY_BUILDER_2D.submaps.grid_options_2d.resolution": "resolution",
}
# The tables of cartographer's own files, with the names under which one holds another.
_OWN_TABLES = {
    "map_builder.lua": (
        ("MAP_BUILDER", {"pose_graph": "POSE_GRAPH"}),
        ("POSE_GRAPH", {}),
        ("SPARSE_POSE_GRAPH", {}),
    ),
    "pose_graph.lua": (("POSE_GRAPH", {}),),
    "sparse_pose_graph.lua": (("SPARSE_POSE_GRAPH", {}),),
    "trajectory_builder.lua": (
        ("TRAJECTORY_BUILDER_2D", {}),
        ("TRAJECTORY_BUILDER_3D", {}),
        (
            "TRAJECTORY_BUILDER",
            {
                "trajectory_builder_2d": "TRAJECTORY_BUILDER_2D",
                "trajectory_builder_3d": "TRAJECTORY_BUILDER_3D",
            },
        ),
    ),
    "trajectory_builder_2d.lua": (("TRAJECTORY_BUILDER_2D", {}),),
    "trajectory_builder_3d.lua": (("TRAJECTORY_BUILDER_3D", {}),),
    "map_builder_server.lua": (("MAP_BUILDER_SERVER", {"map_builder": "MAP_BUILDER"}),),
}
_MAX_INCLUDE_DEPTH = 20
_FLAGS: dict[str, Kind] = {
    **dict.fromkeys(("collect_metrics", "load_frozen_state", "logtostderr", "alsologtostderr",
                     "start_trajectory_with_default_topics"), "bool"),
    **dict.fromkeys(("configuration_basename", "configuration_directory", "load_state_filename",
                     "save_state_filename", "log_dir", "minloglevel", "v"), "string"),
}  # fmt: skip
_MATH: dict[str, Callable[..., float]] = {
    "abs": abs, "acos": math.acos, "asin": math.asin, "atan": math.atan, "atan2": math.atan2,
    "ceil": math.ceil, "cos": math.cos, "deg": math.degrees, "exp": math.exp, "floor": math.floor,
    "fmod": math.fmod, "max": max, "min": min, "pow": math.pow, "rad": math.radians,
    "sin": math.sin, "sqrt": math.sqrt, "tan": math.tan, "log": math.log,
}  # fmt: skip


def flags_of(words: Sequence[str]) -> dict[str, str]:
    """Return the flags of ``cartographer_node`` that are given.

    Raises:
        LaunchError: one is unknown, or has no value.
    """
    return {name: str(value) for name, value in read_flags(words, _FLAGS).items()}


def read_configuration(flags: Mapping[str, str], others: Sequence[Path] = ()) -> dict[str, Any]:
    """Return what a configuration says, by names with dots.

    Args:
        flags: of the node's command line.
        others: folders that are searched after the one that is named.

    Raises:
        LaunchError: the file cannot be read.
        UserFileError: it is not understood.
    """
    name = flags.get("configuration_basename", "")
    if not name:
        return {}
    folder = Path(flags.get("configuration_directory", ""))
    return _Loader((folder, *others)).load(name)


class _Loader:
    def __init__(self, folders: Sequence[Path]) -> None:
        self._folders = folders
        self._depth = 0
        self._machine = Machine({})
        names = self._machine.globals
        names["include"] = Builtin("include", self._include)
        names["choose"] = Builtin("choose", _choose)
        names["read"] = Builtin("read", self._read)
        names["tostring"] = Builtin("tostring", lambda given, _span: text_of(_first(given)))
        names["tonumber"] = Builtin("tonumber", lambda given, _span: _to_number(_first(given)))
        names["print"] = Builtin("print", lambda _given, _span: None)
        names["math"] = LuaTable({
            "pi": math.pi, "huge": math.inf, **{key: _mathematics(key) for key in _MATH},
        })  # fmt: skip
        names["os"] = LuaTable({"getenv": Builtin("getenv", _getenv)})

    def load(self, name: str) -> dict[str, Any]:
        path = self._find(name)
        if path is None:
            raise LaunchError(
                f"cartographer's configuration {self._folders[0] / name} cannot be read\n"
                f"  fix: {self._hint(name)}"
            )
        returned = self._run(path)
        options = returned if isinstance(returned, LuaTable) else None
        if options is None:
            raise failure("the configuration returns no table", SourceSpan(str(path), 0, 0),
                 "end it with: return options")  # fmt: skip
        found: dict[str, Any] = {}
        tables = {key: value for key, value in self._machine.globals.items()
                  if isinstance(value, LuaTable) and key.isupper()}  # fmt: skip
        # Each is told under its own name, however else it can be reached.
        seen = {id(table) for table in tables.values()}
        for key, table in tables.items():
            _flatten(table, f"{key}.", found, seen)
        _flatten(options, "", found, seen)
        return {_RENAMED.get(key, key): value for key, value in found.items()}

    def _find(self, name: str) -> Path | None:
        return next((path for folder in self._folders if is_file(path := folder / name)), None)

    def _hint(self, name: str) -> str:
        there = [path.name for folder in self._folders if folder.is_dir()
                 for path in sorted(folder.glob("*.lua"))]  # fmt: skip
        close = did_you_mean(name, there)
        return close or "-configuration_directory and -configuration_basename name a Lua file"

    def _run(self, path: Path, span: SourceSpan | None = None) -> Any:
        try:
            text = read_text_limited(path)
        except (OSError, UnicodeDecodeError) as error:
            raise failure(f"{path} cannot be read: {error}", span) from error
        return self._machine.run(parse(text, str(path)))

    def _include(self, given: list[Any], span: SourceSpan) -> Any:
        name = str(_first(given))
        path = self._find(name)
        if path is not None:
            self._depth += 1
            if self._depth > _MAX_INCLUDE_DEPTH:
                raise failure(f"'{name}' includes itself", span, "take the include away")
            self._run(path, span)
            self._depth -= 1
        elif name in _OWN_TABLES:
            self._make_tables(name)
        else:
            folders = ", ".join(str(folder) for folder in self._folders)
            hint = did_you_mean(name, _OWN_TABLES) or self._hint(name)
            raise failure(f"File '{name}' was not found: it is in none of {folders}", span, hint)
        return None

    def _make_tables(self, name: str) -> None:
        names = self._machine.globals
        for table, inner in _OWN_TABLES[name]:
            for other in (table, *inner.values()):
                names.setdefault(other, LuaTable(name=other))
            for key, other in inner.items():
                names[table].values.setdefault(key, names[other])

    def _read(self, given: list[Any], span: SourceSpan) -> str:
        path = self._find(str(_first(given)))
        if path is None:
            raise failure(f"File '{_first(given)}' was not found", span)
        try:
            return read_text_limited(path)
        except (OSError, UnicodeDecodeError) as error:
            raise failure(f"{path} cannot be read: {error}", span) from error


def _flatten(table: LuaTable, prefix: str, found: dict[str, Any], seen: set[int]) -> None:
    for key, value in table.values.items():
        if isinstance(value, LuaTable):
            if id(value) in seen:
                continue
            seen.add(id(value))
            _flatten(value, f"{prefix}{text_of(key)}.", found, seen)
        elif isinstance(value, bool | str | float):
            found[f"{prefix}{text_of(key)}"] = value


def _first(given: list[Any]) -> Any:
    return given[0] if given else None


def _choose(given: list[Any], _span: SourceSpan) -> Any:
    condition, one, other = (*given, None, None, None)[:3]
    return other if condition in (None, False) else one


def _getenv(given: list[Any], _span: SourceSpan) -> str | None:
    return os.environ.get(str(_first(given)))


def _to_number(value: Any) -> float | None:
    try:
        return None if value is None or isinstance(value, bool) else float(value)
    except (TypeError, ValueError):
        return None


def _mathematics(name: str) -> Builtin:
    def call(given: list[Any], span: SourceSpan) -> float:
        try:
            return float(_MATH[name](*given))
        except (TypeError, ValueError, OverflowError) as error:
            text = f"bad argument to 'math.{name}': {error}"
            raise failure(text, span, "give it a number") from error

    return Builtin(f"math.{name}", call)
