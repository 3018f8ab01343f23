"""Environment variables."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

from gazelle.launch.ros2.action import Action
from gazelle.launch.ros2.frontend import Entity, Parser, expose_action
from gazelle.launch.ros2.substitution import SomeSubstitutionsType
from gazelle.launch.ros2.utilities import (
    normalize_to_list_of_substitutions,
    perform_substitutions,
)
from gazelle.launch.ros2.utilities.type_utils import (
    normalize_typed_substitution,
    perform_typed_substitution,
)

if TYPE_CHECKING:
    from gazelle.launch.ros2.launch_context import LaunchContext

__all__ = [
    "AppendEnvironmentVariable",
    "PopEnvironment",
    "PushEnvironment",
    "ResetEnvironment",
    "SetEnvironmentVariable",
    "UnsetEnvironmentVariable",
]

_Parsed = tuple[Any, dict[str, Any]]


@expose_action("set_env")
class SetEnvironmentVariable(Action):
    """Sets an environment variable.

    Attributes:
        name: of the variable.
        value: of the variable.
    """

    def __init__(
        self, name: SomeSubstitutionsType, value: SomeSubstitutionsType, **kwargs: Any
    ) -> None:
        super().__init__(**kwargs)
        self.name = normalize_to_list_of_substitutions(name)
        self.value = normalize_to_list_of_substitutions(value)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> _Parsed:
        """Return class and arguments of a ``<set_env>``."""
        _, kwargs = super().parse(entity, parser)
        kwargs["name"] = parser.parse_substitution(entity.get_attr("name"))
        kwargs["value"] = parser.parse_substitution(entity.get_attr("value"))
        return cls, kwargs

    def execute(self, context: LaunchContext) -> None:
        """Set it."""
        name = perform_substitutions(context, self.name)
        context.environment[name] = perform_substitutions(context, self.value)


@expose_action("append_env")
class AppendEnvironmentVariable(Action):
    """Adds to an environment variable that is a list, at its end or its beginning.

    Attributes:
        name: of the variable.
        value: what is added.
        prepend: at the beginning.
        separator: what stands between the items.
    """

    def __init__(
        self,
        name: SomeSubstitutionsType,
        value: SomeSubstitutionsType,
        prepend: bool | SomeSubstitutionsType = False,
        separator: SomeSubstitutionsType = os.pathsep,
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        self.name = normalize_to_list_of_substitutions(name)
        self.value = normalize_to_list_of_substitutions(value)
        self.prepend = normalize_typed_substitution(prepend, bool)
        self.separator = normalize_to_list_of_substitutions(separator)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> _Parsed:
        """Return class and arguments of an ``<append_env>``."""
        _, kwargs = super().parse(entity, parser)
        kwargs["name"] = parser.parse_substitution(entity.get_attr("name"))
        kwargs["value"] = parser.parse_substitution(entity.get_attr("value"))
        prepend = entity.get_attr("prepend", optional=True, data_type=bool, can_be_str=True)
        if prepend is not None:
            kwargs["prepend"] = parser.parse_if_substitutions(prepend)
        separator = entity.get_attr("separator", optional=True)
        if separator is not None:
            kwargs["separator"] = parser.parse_substitution(separator)
        return cls, kwargs

    def execute(self, context: LaunchContext) -> None:
        """Add to it, or set it."""
        name = perform_substitutions(context, self.name)
        items = [perform_substitutions(context, self.value)]
        if name in context.environment:
            at_front = perform_typed_substitution(context, self.prepend, bool)
            items.insert(1 if at_front else 0, context.environment[name])
        context.environment[name] = perform_substitutions(context, self.separator).join(items)


@expose_action("unset_env")
class UnsetEnvironmentVariable(Action):
    """Takes an environment variable out, if it is set.

    Attributes:
        name: of the variable.
    """

    def __init__(self, name: SomeSubstitutionsType, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.name = normalize_to_list_of_substitutions(name)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> _Parsed:
        """Return class and arguments of an ``<unset_env>``."""
        _, kwargs = super().parse(entity, parser)
        kwargs["name"] = parser.parse_substitution(entity.get_attr("name"))
        return cls, kwargs

    def execute(self, context: LaunchContext) -> None:
        """Take it out."""
        context.environment.pop(perform_substitutions(context, self.name), None)


class PushEnvironment(Action):
    """Keeps the environment for a PopEnvironment."""

    def execute(self, context: LaunchContext) -> None:
        """Keep it."""
        context._push_environment()


class PopEnvironment(Action):
    """Goes back to the environment of the last PushEnvironment."""

    def execute(self, context: LaunchContext) -> None:
        """Go back."""
        context._pop_environment()


@expose_action("reset_env")
class ResetEnvironment(Action):
    """Goes back to the environment that the launch began with."""

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> _Parsed:
        """Return class and arguments of a ``<reset_env>``."""
        _, kwargs = super().parse(entity, parser)
        return cls, kwargs

    def execute(self, context: LaunchContext) -> None:
        """Go back."""
        context._reset_environment()
