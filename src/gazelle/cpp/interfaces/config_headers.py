"""Headers of ROS 1's ``.cfg`` files: ``<package>/<Name>Config.h`` for dynamic_reconfigure.

A ``.cfg`` file is a Python program of the user's package; it runs in a process of its own.
"""

from __future__ import annotations

import json
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from gazelle.cpp.interfaces.field_types import literal
from gazelle.cpp.interfaces.header_trees import write_headers
from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.errors import UserFileError
from gazelle.interfaces import RosVersion

__all__ = ["config_header"]

_PROGRAM = "gazelle.compat.dynamic_reconfigure.config_program"
_C_TYPES = {"bool": "bool", "int": "int", "double": "double", "str": "std::string"}
_TYPES = {"bool": "boolean", "int": "integer", "double": "real", "str": "text"}
_CONSTANTS = {"bool": "bool", "int": "int", "double": "double", "str": "char *const"}
_LINE = re.compile(r'File "(?P<file>[^"]+)", line (?P<line>\d+)')


def config_header(cfg: Path, package: str, folder: Path) -> Path:
    """Write the header of a ``.cfg`` file.

    Args:
        cfg: the file.
        package: whose it is.
        folder: becomes an include folder.

    Returns:
        The header.

    Raises:
        UserFileError: the program fails, or generates nothing.
    """
    said = _said(cfg)
    name = f"{cfg.stem}Config"
    text = _header(said["package"] or package, cfg.stem, said)
    return write_headers(folder, [(f"{package}/{name}.h", text)])[0]


def _said(cfg: Path) -> dict[str, Any]:
    done = subprocess.run(
        [sys.executable, "-m", _PROGRAM, str(cfg)], capture_output=True, text=True, check=False
    )
    if done.returncode == 0:
        found: dict[str, Any] = json.loads(done.stdout)
        return found
    lines = done.stderr.strip().splitlines()
    line = 0
    for match in _LINE.finditer(done.stderr):
        if match["file"] == str(cfg):
            line = int(match["line"])
    diagnostics = Diagnostics()
    why = lines[-1] if lines else f"it ended with {done.returncode}"
    diagnostics.report("interfaces.config-program", why, SourceSpan(str(cfg), line))
    raise UserFileError(tuple(diagnostics))


def _header(namespace: str, name: str, said: dict[str, Any]) -> str:
    config = f"{name}Config"
    root = said["group"]
    groups = list(_numbered(root))
    rows = [
        _row(config, parameter, number)
        for number, (group, _) in enumerate(groups)
        for parameter in group["parameters"]
    ]
    members = [
        f"  {_C_TYPES[parameter['type']]} {parameter['name']}{{}};"
        for group, _ in groups
        for parameter in group["parameters"]
    ]
    lines = [
        f"// Made by Gazelle from {name}.cfg.",
        "#pragma once\n",
        "#include <cstddef>",
        "#include <string>\n",
        "#include <gazelle/reconfigure.hpp>\n",
        f"namespace {namespace} {{\n",
        f"class {config} {{",
        " public:",
        *_group_class(root, "  "),
        *members,
        "",
        f"  GAZELLE_CONFIGURATION({config})\n",
        "  static const ::gazelle::reconfigure::Table &__getTable__() {",
        "    using namespace ::gazelle::reconfigure;",
        *_array("Parameter parameters", rows),
        *_array("Group groups_table", [_group_row(config, *group) for group in groups]),
        f"    static const Table found{{{'parameters' if rows else 'nullptr'}, {len(rows)}, "
        f"groups_table, {len(groups)}}};",
        "    return found;",
        "  }",
        "};\n",
        *(_constant(name, row) for row in said["constants"]),
        f"\n}}  // namespace {namespace}",
    ]
    return "\n".join(lines) + "\n"


def _numbered(group: dict[str, Any]) -> Iterator[tuple[Any, str]]:
    """Yield groups in order of their numbers, with the member of the class that each is."""
    found: list[tuple[dict[str, Any], str]] = []

    def visit(one: dict[str, Any], path: str) -> None:
        found.append((one, path))
        for child in one["groups"]:
            visit(child, f"{path}.{child['name'].lower()}")

    visit(group, "groups")
    yield from sorted(found, key=lambda row: row[0]["id"])


def _group_class(group: dict[str, Any], indent: str, member: str = "groups") -> Iterator[str]:
    yield f"{indent}class {group['name'].upper()} {{"
    yield f"{indent} public:"
    yield f'{indent}  std::string name{{"{group["name"]}"}};'
    yield f"{indent}  bool state{{{str(bool(group['state'])).lower()}}};"
    for child in group["groups"]:
        yield from _group_class(child, indent + "  ", child["name"].lower())
    yield f"{indent}}} {member};"


def _array(declaration: str, rows: list[str]) -> list[str]:
    if not rows:
        return []
    return [
        f"    static const {declaration}[] = {{",
        *(f"        {row}," for row in rows),
        "    };",
    ]


def _row(config: str, parameter: dict[str, Any], number: int) -> str:
    kind = parameter["type"]
    values = [parameter[key] for key in ("default", "min", "max")]
    is_text = kind == "str"
    numbers = ["0", "0", "0"] if is_text else [_number(value) for value in values]
    texts = [_text(value) for value in values] if is_text else ['""'] * 3
    return (
        f"{{{_text(parameter['name'])}, Type::{_TYPES[kind]}, "
        f"offsetof({config}, {parameter['name']}), {number}, "
        f"{int(parameter['level']) & 0xFFFFFFFF}u, {_text(parameter['description'])}, "
        f"{_text(parameter['edit_method'])}, {', '.join(numbers)}, {', '.join(texts)}}}"
    )


def _group_row(config: str, group: dict[str, Any], path: str) -> str:
    state = str(bool(group["state"])).lower()
    where = f"offsetof({config}, {path}.state)"
    return (
        f"{{{_text(group['name'])}, {_text(group['type'])}, {group['parent']}, {where}, {state}}}"
    )


def _constant(name: str, row: dict[str, Any]) -> str:
    kind, value = row["type"], row["value"]
    written = _text(value) if kind == "str" else _number(value) if kind == "double" else value
    if kind == "bool":
        written = str(value).lower()
    return f"const {_CONSTANTS[kind]} {name}_{row['name']} = {written};"


def _number(value: Any) -> str:
    if value in (float("inf"), float("-inf")):
        return "infinity" if value > 0 else "-infinity"
    return literal("float64", float(value), RosVersion.ROS1)


def _text(value: Any) -> str:
    return literal("string", str(value), RosVersion.ROS1)
