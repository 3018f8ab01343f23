"""not, and, or, any, all."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from gazelle.launch.ros2.frontend import expose_substitution
from gazelle.launch.ros2.substitution import SomeSubstitutionsType, Substitution
from gazelle.launch.ros2.substitutions.substitution_failure import SubstitutionFailure, counted
from gazelle.launch.ros2.utilities import normalize_to_list_of_substitutions
from gazelle.launch.ros2.utilities.type_utils import perform_typed_substitution

if TYPE_CHECKING:
    from gazelle.launch.ros2.launch_context import LaunchContext

__all__ = [
    "AllSubstitution",
    "AndSubstitution",
    "AnySubstitution",
    "NotSubstitution",
    "OrSubstitution",
    "bool_text",
    "truth",
]


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
