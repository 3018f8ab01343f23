"""What a ``.cfg`` file says: parameters with limits, in groups, some with named values."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

__all__ = ["DynamicGroup", "DynamicParameter", "EnumConstant", "Value", "enum_edit_method"]

Value = bool | int | float | str

_INT_LIMIT = 0x80000000
_MIN: dict[str, Value] = {"bool": False, "int": -_INT_LIMIT, "double": -math.inf, "str": ""}
_MAX: dict[str, Value] = {"bool": True, "int": _INT_LIMIT - 1, "double": math.inf, "str": ""}


@dataclass(frozen=True, slots=True)
class DynamicParameter:
    """One parameter; `type` is bool, int, double or str.

    Attributes:
        lowest, highest: limits of int and double; None for none.
        edit_method: of parameters with named values, see `enum_edit_method`.
        level: bits that tell the node what a change of this parameter means to it.
    """

    name: str
    type: str
    default: Value
    description: str
    lowest: Value | None = None
    highest: Value | None = None
    edit_method: str = ""
    level: int = 1

    @property
    def minimum(self) -> Value:
        """The lower limit as descriptions tell it; the type's own where there is none."""
        return self._typed(_MIN[self.type] if self.lowest is None else self.lowest)

    @property
    def maximum(self) -> Value:
        """The upper limit as descriptions tell it; the type's own where there is none."""
        return self._typed(_MAX[self.type] if self.highest is None else self.highest)

    def accepts(self, value: object) -> bool:
        """Tell whether a value is of this type; whole numbers are doubles too, NaN is none."""
        if self.type == "double":
            is_number = isinstance(value, int | float) and not isinstance(value, bool)
            return is_number and value == value  # noqa: PLR0124 - only NaN is not
        if self.type == "int":
            return isinstance(value, int) and not isinstance(value, bool)
        return isinstance(value, bool if self.type == "bool" else str)

    def clamped(self, value: Value) -> Value:
        """Return a value of this type within the limits."""
        if isinstance(value, bool | str):
            return value
        low, high = float(self.minimum), float(self.maximum)
        return self._typed(max(low, min(value, high)))

    def _typed(self, value: Value) -> Value:
        if self.type == "double":
            return float(value)
        return int(value) if self.type == "int" else value


@dataclass(frozen=True, slots=True)
class DynamicGroup:
    """Parameters that belong together, and groups below.

    Attributes:
        type: how clients show it: empty, ``collapse``, ``tab``, ``hide`` or ``apply``.
        state: whether it begins unfolded.
    """

    name: str = "Default"
    parameters: tuple[DynamicParameter, ...] = ()
    groups: tuple[DynamicGroup, ...] = ()
    type: str = ""
    state: bool = True

    def every_parameter(self) -> Iterator[DynamicParameter]:
        """Yield the parameters of this group and all below."""
        yield from self.parameters
        for group in self.groups:
            yield from group.every_parameter()

    def numbered(self) -> list[tuple[int, int, DynamicGroup]]:
        """Return (id, parent's id, group) of this group and all below; this one is 0."""
        found: list[tuple[int, int, DynamicGroup]] = []

        def visit(group: DynamicGroup, parent: int) -> None:
            own = len(found)
            found.append((own, parent, group))
            for child in group.groups:
                visit(child, own)

        visit(self, 0)
        return found


@dataclass(frozen=True, slots=True)
class EnumConstant:
    """A named value of a parameter."""

    name: str
    value: Value
    description: str = ""


def enum_edit_method(constants: Sequence[EnumConstant], description: str) -> str:
    """Return the text that lets clients offer the values by name.

    It is the Python literal that parameter_generator writes; rqt and dynparam evaluate it.

    Raises:
        ValueError: the constants are of different types.
    """
    kinds = {bool: "bool", int: "int", float: "double", str: "str"}
    c_types = {"bool": "bool", "int": "int", "double": "double", "str": "std::string"}
    if len({type(constant.value) for constant in constants}) != 1:
        raise ValueError("Inconsistent types in enum!")
    rows = []
    for constant in constants:
        kind = kinds[type(constant.value)]
        c_const = "const char * const" if kind == "str" else f"const {c_types[kind]}"
        rows.append(
            {
                "name": constant.name,
                "type": kind,
                "value": constant.value,
                "srcline": 0,
                "srcfile": "",
                "description": constant.description,
                "ctype": c_types[kind],
                "cconsttype": c_const,
            }
        )
    return repr({"enum": rows, "enum_description": description})
