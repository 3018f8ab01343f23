"""``ParameterGenerator``: what ``.cfg`` files are written with."""

from __future__ import annotations

import math
import re
from typing import Any

from gazelle.graph.dynamic_reconfigure import EnumConstant, enum_edit_method

__all__ = [
    "FINISHED",
    "ParameterGenerator",
    "bool_t",
    "double_t",
    "int_t",
    "str_t",
]

str_t, bool_t, int_t, double_t = "str", "bool", "int", "double"

_TYPES: dict[str, type[Any]] = {str_t: str, bool_t: bool, int_t: int, double_t: float}
_MIN = {str_t: "", bool_t: False, int_t: -0x80000000, double_t: -math.inf}
_MAX = {str_t: "", bool_t: True, int_t: 0x7FFFFFFF, double_t: math.inf}
_NAME = re.compile(r"[a-zA-Z][a-zA-Z0-9_]*")


class _Group:
    """Parameters and groups below, in the order they are added."""

    def __init__(
        self, generator: ParameterGenerator, name: str, type: str, state: bool, parent: int
    ) -> None:
        self.name = name.replace(" ", "_")
        self.type = type
        self.state = state
        self.parent = parent
        self.id = generator.next_id()
        self.groups: list[_Group] = []
        self.parameters: list[dict[str, Any]] = []
        self._generator = generator

    def add_group(self, name: str, type: str = "", state: bool = True) -> _Group:
        """Add a group below this one."""
        self.groups.append(_Group(self._generator, name, type, state, self.id))
        return self.groups[-1]

    def add(
        self,
        name: str,
        paramtype: str,
        level: int,
        description: str,
        default: Any = None,
        min: Any = None,
        max: Any = None,
        edit_method: str = "",
    ) -> None:
        """Add a parameter.

        Raises:
            TypeError: a value has the wrong type.
            ValueError: the name is not legal, or the type has no limits.
        """
        if paramtype in (str_t, bool_t) and (max is not None or min is not None):
            raise ValueError(f"Max or min specified for {name}, which is of '{paramtype}' type")
        if not _NAME.fullmatch(name):
            raise ValueError(
                f"The name of field '{name}' does not follow the ROS naming conventions, "
                "see http://wiki.ros.org/ROS/Patterns/Conventions"
            )
        zero = _TYPES[paramtype]()
        self.parameters.append(
            {
                "name": name,
                "type": paramtype,
                "default": _checked(name, paramtype, "default", default, zero),
                "level": level,
                "description": description,
                "min": _checked(name, paramtype, "min", min, _MIN[paramtype]),
                "max": _checked(name, paramtype, "max", max, _MAX[paramtype]),
                "edit_method": edit_method,
            }
        )

    def to_dict(self) -> dict[str, Any]:
        """Return the description that configuration types have."""
        return {
            "name": self.name,
            "type": self.type,
            "state": self.state,
            "id": self.id,
            "parent": self.parent,
            "parameters": self.parameters,
            "groups": [group.to_dict() for group in self.groups],
        }


class ParameterGenerator:
    """Collects parameters; `generate` ends a ``.cfg`` file.

    Attributes:
        group: the default group.
        constants: of `const`.
        package: what `generate` was told, the namespace of the class in C++.
    """

    def __init__(self) -> None:
        self.package = ""
        self._ids = 0
        self.group = _Group(self, "Default", "", True, 0)
        self.constants: list[dict[str, Any]] = []

    def next_id(self) -> int:
        """Return the number of the next group."""
        self._ids += 1
        return self._ids - 1

    def add(
        self,
        name: str,
        paramtype: str,
        level: int,
        description: str,
        default: Any = None,
        min: Any = None,
        max: Any = None,
        edit_method: str = "",
    ) -> None:
        """Add a parameter to the default group."""
        self.group.add(name, paramtype, level, description, default, min, max, edit_method)

    def add_group(self, name: str, type: str = "", state: bool = True) -> _Group:
        """Add a group."""
        return self.group.add_group(name, type=type, state=state)

    def const(self, name: str, type: str, value: Any, descr: str) -> dict[str, Any]:
        """Return a named value for `enum`; the configuration type has it as ``Name_<name>``.

        Raises:
            TypeError: the value has another type.
        """
        checked = _checked(name, type, "value", value, value)
        made = {"name": name, "type": type, "value": checked, "description": descr}
        self.constants.append(made)
        return made

    def enum(self, constants: list[dict[str, Any]], description: str) -> str:
        """Return the edit method that offers the constants by name.

        Raises:
            ValueError: they are of different types.
        """
        rows = [EnumConstant(row["name"], row["value"], row["description"]) for row in constants]
        return enum_edit_method(rows, description)

    def generate(self, pkgname: str, nodename: str, name: str) -> int:
        """End the file; what was collected becomes the module ``<name>Config``.

        Args:
            pkgname: the namespace of the class in C++; the module is found in the package that
                the file is in.
            nodename: without effect: the original writes it into documentation.
            name: of the module, without ``Config``.
        """
        self.package = pkgname
        FINISHED.append((self, name))
        return 0


# Generators whose files called `generate`, with the names they gave; the importer empties it.
FINISHED: list[tuple[ParameterGenerator, str]] = []


def _checked(name: str, kind: str, field: str, value: Any, default: Any) -> Any:
    if value is None:
        return default
    wanted = _TYPES[kind]
    if type(value) is not wanted and not (wanted is float and type(value) is int):
        raise TypeError(f"'{name}' has type {kind}, but {field} is {value!r}")
    return wanted(value)
