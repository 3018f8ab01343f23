"""not, and, or, any, all; equals, not-equals, if."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from gazelle.launch.ros2.frontend import expose_substitution
from gazelle.launch.ros2.substitution import SomeSubstitutionsType, Substitution
from gazelle.launch.ros2.substitutions.substitution_failure import SubstitutionFailure, counted
from gazelle.launch.ros2.utilities import (
    normalize_to_list_of_substitutions,
    perform_substitutions,
)
from gazelle.launch.ros2.utilities.type_utils import is_substitution, perform_typed_substitution

if TYPE_CHECKING:
    from gazelle.launch.ros2.launch_context import LaunchContext

__all__ = [
    "AllSubstitution",
    "AndSubstitution",
    "AnySubstitution",
    "EqualsSubstitution",
    "IfElseSubstitution",
    "NotEqualsSubstitution",
    "NotSubstitution",
    "OrSubstitution",
    "bool_text",
    "truth",
]

_BOOLS = {"true": True, "1": True, "false": False, "0": False}


@expose_substitution("not")
class NotSubstitution(Substitution):
    """The opposite of a bool."""

    def __init__(self, value: SomeSubstitutionsType) -> None:
        super().__init__()
        self.value = normalize_to_list_of_substitutions(value)

    @classmethod
    def parse(cls, data: Sequence[Any]) -> tuple[type[NotSubstitution], dict[str, Any]]:
        """Return class and arguments of a ``$(not value)``."""
        return cls, {"value": counted(data, 1, 1, "not")[0]}

    def describe(self) -> str:
        """Return a text for people."""
        return f"NotSubstitution({self.value})"

    def perform(self, context: LaunchContext) -> str:
        """Return ``true`` or ``false``."""
        return bool_text(not truth(context, self.value))


class _Pair(Substitution):
    """Two values.

    Attributes:
        left: the first.
        right: the second.
    """

    def __init__(self, left: SomeSubstitutionsType, right: SomeSubstitutionsType) -> None:
        super().__init__()
        self.left = normalize_to_list_of_substitutions(left)
        self.right = normalize_to_list_of_substitutions(right)

    def describe(self) -> str:
        """Return a text for people."""
        return f"{type(self).__name__}({self.left} {self.right})"

    def _truths(self, context: LaunchContext) -> tuple[bool, bool]:
        return truth(context, self.left), truth(context, self.right)


@expose_substitution("and")
class AndSubstitution(_Pair):
    """Whether two bools are both true."""

    @classmethod
    def parse(cls, data: Sequence[Any]) -> tuple[type[AndSubstitution], dict[str, Any]]:
        """Return class and arguments of a ``$(and left right)``."""
        left, right = counted(data, 2, 2, "and")
        return cls, {"left": left, "right": right}

    def perform(self, context: LaunchContext) -> str:
        """Return ``true`` or ``false``."""
        return bool_text(all(self._truths(context)))


@expose_substitution("or")
class OrSubstitution(_Pair):
    """Whether one of two bools is true."""

    @classmethod
    def parse(cls, data: Sequence[Any]) -> tuple[type[OrSubstitution], dict[str, Any]]:
        """Return class and arguments of a ``$(or left right)``."""
        left, right = counted(data, 2, 2, "or")
        return cls, {"left": left, "right": right}

    def perform(self, context: LaunchContext) -> str:
        """Return ``true`` or ``false``."""
        return bool_text(any(self._truths(context)))


class _Several(Substitution):
    """Any number of values.

    Attributes:
        args: the values.
    """

    def __init__(self, *args: SomeSubstitutionsType) -> None:
        super().__init__()
        self.args = [normalize_to_list_of_substitutions(arg) for arg in args]

    def describe(self) -> str:
        """Return a text for people."""
        return f"{type(self).__name__}({' '.join(str(arg) for arg in self.args)})"

    def _truths(self, context: LaunchContext) -> list[bool]:
        return [truth(context, arg) for arg in self.args]


@expose_substitution("any")
class AnySubstitution(_Several):
    """Whether one of several bools is true."""

    @classmethod
    def parse(cls, data: Sequence[Any]) -> tuple[type[AnySubstitution], dict[str, Any]]:
        """Return class and arguments of a ``$(any …)``."""
        return cls, {"args": data}

    def perform(self, context: LaunchContext) -> str:
        """Return ``true`` or ``false``."""
        return bool_text(any(self._truths(context)))


@expose_substitution("all")
class AllSubstitution(_Several):
    """Whether several bools are all true."""

    @classmethod
    def parse(cls, data: Sequence[Any]) -> tuple[type[AllSubstitution], dict[str, Any]]:
        """Return class and arguments of an ``$(all …)``."""
        return cls, {"args": data}

    def perform(self, context: LaunchContext) -> str:
        """Return ``true`` or ``false``."""
        return bool_text(all(self._truths(context)))


@expose_substitution("equals")
class EqualsSubstitution(Substitution):
    """Whether two values are equal: as bools, as numbers (nearly), else as texts.

    Attributes:
        left: the first.
        right: the second.
    """

    def __init__(self, left: Any, right: Any) -> None:
        super().__init__()
        self.left = _side(left)
        self.right = _side(right)

    @classmethod
    def parse(cls, data: Sequence[Any]) -> tuple[type[EqualsSubstitution], dict[str, Any]]:
        """Return class and arguments of an ``$(equals left right)``."""
        left, right = counted(data, 2, 2, "equals")
        return cls, {"left": left, "right": right}

    def describe(self) -> str:
        """Return a text for people."""
        return f"{type(self).__name__}({self.left} {self.right})"

    def perform(self, context: LaunchContext) -> str:
        """Return ``true`` or ``false``."""
        return bool_text(self._are_equal(context))

    def _are_equal(self, context: LaunchContext) -> bool:
        left = perform_substitutions(context, self.left)
        right = perform_substitutions(context, self.right)
        if left.lower() in _BOOLS and right.lower() in _BOOLS:
            return _BOOLS[left.lower()] == _BOOLS[right.lower()]
        try:
            return math.isclose(float(left), float(right))
        except ValueError:
            return left == right


@expose_substitution("not-equals")
class NotEqualsSubstitution(EqualsSubstitution):
    """Whether two values differ."""

    def perform(self, context: LaunchContext) -> str:
        """Return ``true`` or ``false``."""
        return bool_text(not self._are_equal(context))


@expose_substitution("if")
class IfElseSubstitution(Substitution):
    """One of two values, by a bool.

    Attributes:
        condition: the bool.
        if_value: the value when it is true.
        else_value: the value when it is false.
    """

    def __init__(
        self,
        condition: SomeSubstitutionsType,
        if_value: SomeSubstitutionsType = "",
        else_value: SomeSubstitutionsType = "",
    ) -> None:
        super().__init__()
        if if_value == "" and else_value == "":
            raise RuntimeError("One of if_value and else_value must be specified")
        self.condition = normalize_to_list_of_substitutions(condition)
        self.if_value = normalize_to_list_of_substitutions(if_value)
        self.else_value = normalize_to_list_of_substitutions(else_value)

    @classmethod
    def parse(cls, data: Sequence[Any]) -> tuple[type[IfElseSubstitution], dict[str, Any]]:
        """Return class and arguments of an ``$(if condition value other)``."""
        names = ("condition", "if_value", "else_value")
        return cls, dict(zip(names, counted(data, 2, 3, "if"), strict=False))

    def describe(self) -> str:
        """Return a text for people."""
        return f"IfElseSubstitution({self.condition}, {self.if_value}, {self.else_value})"

    def perform(self, context: LaunchContext) -> str:
        """Return the value that the bool chooses."""
        chosen = self.if_value if truth(context, self.condition) else self.else_value
        return perform_substitutions(context, chosen)


def truth(context: LaunchContext, value: list[Substitution]) -> bool:
    """Return what substitutions come to as a bool.

    Raises:
        SubstitutionFailure: they are neither true nor false.
    """
    try:
        found: bool = perform_typed_substitution(context, value, bool)
    except (TypeError, ValueError) as error:
        raise SubstitutionFailure(str(error)) from error
    return found


def bool_text(value: bool) -> str:
    """Return ``true`` or ``false``."""
    return "true" if value else "false"


def _side(value: Any) -> list[Substitution]:
    if not is_substitution(value):
        value = "" if value is None else bool_text(value) if isinstance(value, bool) else str(value)
    return normalize_to_list_of_substitutions(value)
