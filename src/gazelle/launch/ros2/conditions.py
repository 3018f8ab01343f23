"""launch.conditions."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from gazelle.launch.ros2.condition import Condition
from gazelle.launch.ros2.deprecation import warn_once
from gazelle.launch.ros2.substitution import SomeSubstitutionsType, Substitution
from gazelle.launch.ros2.utilities import (
    normalize_to_list_of_substitutions,
    perform_substitutions,
)

if TYPE_CHECKING:
    from gazelle.launch.ros2.launch_context import LaunchContext

__all__ = [
    "VALID_FALSE_EXPRESSIONS",
    "VALID_TRUE_EXPRESSIONS",
    "IfCondition",
    "InvalidConditionExpressionError",
    "LaunchConfigurationEquals",
    "LaunchConfigurationNotEquals",
    "UnlessCondition",
    "evaluate_condition_expression",
]

VALID_TRUE_EXPRESSIONS = ["true", "1"]
VALID_FALSE_EXPRESSIONS = ["false", "0"]


class InvalidConditionExpressionError(ValueError):
    """A condition is neither true nor false."""

    def __init__(
        self,
        expression: str,
        unexpanded_expression: Iterable[Substitution],
        valid_expressions: Iterable[str],
    ) -> None:
        known = ", ".join(valid_expressions)
        written = " + ".join(sub.describe() for sub in unexpanded_expression)
        super().__init__(
            f"invalid condition expression, expected one of [{known}] "
            f"but got '{expression}', expanded from '{written}'"
        )


def evaluate_condition_expression(
    context: LaunchContext, expression: Iterable[Substitution]
) -> bool:
    """Return whether substitutions come to ``true`` or ``1``, or to ``false`` or ``0``.

    Case and blanks around do not matter.

    Raises:
        InvalidConditionExpressionError: they come to something else.
    """
    written = list(expression)
    text = perform_substitutions(context, written).strip().lower()
    if text in VALID_TRUE_EXPRESSIONS:
        return True
    if text in VALID_FALSE_EXPRESSIONS:
        return False
    valid = [*VALID_TRUE_EXPRESSIONS, *VALID_FALSE_EXPRESSIONS]
    raise InvalidConditionExpressionError(text, written, valid)


class IfCondition(Condition):
    """Holds when an expression comes to true."""

    def __init__(self, predicate_expression: SomeSubstitutionsType) -> None:
        self.__expression = normalize_to_list_of_substitutions(predicate_expression)
        super().__init__(predicate=self._predicate_func)

    def _predicate_func(self, context: LaunchContext) -> bool:
        return evaluate_condition_expression(context, self.__expression)


class UnlessCondition(IfCondition):
    """Holds when an expression comes to false."""

    def _predicate_func(self, context: LaunchContext) -> bool:
        return not super()._predicate_func(context)


class LaunchConfigurationEquals(Condition):
    """Holds when a launch configuration has a value; with None, when it is not set.

    Deprecated since Humble for IfCondition(EqualsSubstitution(…)).
    """

    def __init__(
        self, launch_configuration_name: str, expected_value: SomeSubstitutionsType | None
    ) -> None:
        warn_once(
            f"The '{type(self).__name__}' condition is deprecated, use IfCondition("
            "EqualsSubstitution(LaunchConfiguration(…), …)) or NotEqualsSubstitution"
        )
        self.__name = launch_configuration_name
        self.__expected = (
            None if expected_value is None else normalize_to_list_of_substitutions(expected_value)
        )
        super().__init__(predicate=self._predicate_func)

    def _predicate_func(self, context: LaunchContext) -> bool:
        value = context.launch_configurations.get(self.__name)
        if self.__expected is None:
            return value is None
        return value == perform_substitutions(context, self.__expected)


class LaunchConfigurationNotEquals(LaunchConfigurationEquals):
    """Holds when a launch configuration lacks a value; with None, when it is set."""

    def _predicate_func(self, context: LaunchContext) -> bool:
        return not super()._predicate_func(context)
