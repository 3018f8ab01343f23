"""Arguments and launch configurations."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from gazelle.diagnostics import did_you_mean
from gazelle.launch.ros2.action import Action
from gazelle.launch.ros2.frontend import Entity, Parser, expose_action
from gazelle.launch.ros2.substitution import SomeSubstitutionsType
from gazelle.launch.ros2.utilities import (
    normalize_to_list_of_substitutions,
    perform_substitutions,
)

if TYPE_CHECKING:
    from gazelle.launch.ros2.launch_context import LaunchContext

__all__ = [
    "DeclareLaunchArgument",
    "PopLaunchConfigurations",
    "PushLaunchConfigurations",
    "ResetLaunchConfigurations",
    "SetLaunchConfiguration",
    "UnsetLaunchConfiguration",
    "kept_configurations",
]

_Parsed = tuple[Any, dict[str, Any]]


@expose_action("arg")
class DeclareLaunchArgument(Action):
    """Declares an argument of a launch file; its value is a launch configuration.

    Attributes:
        name: of the argument.
        default_value: its value when none is given, None when one has to be.
        description: for people.
        choices: the values it may have, None for any.
    """

    def __init__(
        self,
        name: str,
        *,
        default_value: SomeSubstitutionsType | None = None,
        description: str | None = None,
        choices: Sequence[str] | None = None,
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        if choices is not None and not choices:
            raise RuntimeError("Provided choices arg is empty. Use None to ignore the choice list.")
        is_text = isinstance(default_value, str)
        if choices is not None and is_text and default_value not in choices:
            raise RuntimeError(
                f'Provided default_value "{default_value}" '
                f'is not in provided choices "{list(choices)}".'
            )
        self.name = name
        self.default_value = (
            None if default_value is None else normalize_to_list_of_substitutions(default_value)
        )
        self.description = _description(description, choices)
        self.choices = None if choices is None else list(choices)
        self._conditionally_included = False

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> _Parsed:
        """Return class and arguments of an ``<arg>``."""
        _, kwargs = super().parse(entity, parser)
        kwargs["name"] = parser.escape_characters(entity.get_attr("name"))
        default = entity.get_attr("default", optional=True)
        if default is not None:
            kwargs["default_value"] = parser.parse_substitution(default)
        description = entity.get_attr("description", optional=True)
        if description is not None:
            kwargs["description"] = parser.escape_characters(description)
        choices = entity.get_attr("choice", data_type=list[Entity], optional=True)
        if choices is not None:
            kwargs["choices"] = [parser.escape_characters(c.get_attr("value")) for c in choices]
            for choice in choices:
                choice.assert_entity_completely_parsed()
        return cls, kwargs

    def execute(self, context: LaunchContext) -> None:
        """Set its default unless it has a value.

        Raises:
            RuntimeError: it has neither, or a value that is no choice.
        """
        values = context.launch_configurations
        if self.name not in values:
            if self.default_value is None:
                raise RuntimeError(f'Required launch argument "{self.name}" was not provided.')
            values[self.name] = perform_substitutions(context, self.default_value)
        value = values[self.name]
        if self.choices is not None and value not in self.choices:
            hint = did_you_mean(value, self.choices)
            message = (
                f'Argument "{self.name}" provided value "{value}" is not valid. '
                f"Valid options are: {self.choices}"
            )
            raise RuntimeError(f"{message}; {hint}" if hint else message)


def _description(description: str | None, choices: Sequence[str] | None) -> str:
    if choices is None:
        return description or "no description given"
    if description is None:
        return f"One of: {list(choices)}"
    stop = "" if description.endswith(".") else "."
    return f"{description}{stop} Valid choices are: {list(choices)}"


@expose_action("let")
class SetLaunchConfiguration(Action):
    """Sets a launch configuration.

    Attributes:
        name: of the configuration.
        value: of the configuration.
    """

    def __init__(
        self, name: SomeSubstitutionsType, value: SomeSubstitutionsType, **kwargs: Any
    ) -> None:
        super().__init__(**kwargs)
        self.name = normalize_to_list_of_substitutions(name)
        self.value = normalize_to_list_of_substitutions(value)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> _Parsed:
        """Return class and arguments of a ``<let>``."""
        _, kwargs = super().parse(entity, parser)
        kwargs["name"] = parser.parse_substitution(entity.get_attr("name"))
        kwargs["value"] = parser.parse_substitution(entity.get_attr("value"))
        return cls, kwargs

    def execute(self, context: LaunchContext) -> None:
        """Set it."""
        name = perform_substitutions(context, self.name)
        context.launch_configurations[name] = perform_substitutions(context, self.value)


class UnsetLaunchConfiguration(Action):
    """Takes a launch configuration out, if it is set.

    Attributes:
        name: of the configuration.
    """

    def __init__(self, name: SomeSubstitutionsType, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.name = normalize_to_list_of_substitutions(name)

    def execute(self, context: LaunchContext) -> None:
        """Take it out."""
        context.launch_configurations.pop(perform_substitutions(context, self.name), None)


class PushLaunchConfigurations(Action):
    """Keeps the launch configurations for a PopLaunchConfigurations."""

    def execute(self, context: LaunchContext) -> None:
        """Keep them."""
        context._push_launch_configurations()


class PopLaunchConfigurations(Action):
    """Goes back to the launch configurations of the last PushLaunchConfigurations."""

    def execute(self, context: LaunchContext) -> None:
        """Go back."""
        context._pop_launch_configurations()


@expose_action("reset")
class ResetLaunchConfigurations(Action):
    """Forgets all launch configurations but those given here."""

    def __init__(
        self, launch_configurations: Mapping[Any, Any] | None = None, **kwargs: Any
    ) -> None:
        super().__init__(**kwargs)
        self.__kept = dict(launch_configurations or {})

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> _Parsed:
        """Return class and arguments of a ``<reset>``."""
        _, kwargs = super().parse(entity, parser)
        kept = kept_configurations(entity, parser)
        if kept is not None:
            kwargs["launch_configurations"] = kept
        return cls, kwargs

    def execute(self, context: LaunchContext) -> None:
        """Forget them; the values of those kept may still use the others."""
        kept = {_text(context, key): _text(context, value) for key, value in self.__kept.items()}
        context.launch_configurations.clear()
        context.launch_configurations.update(kept)


def kept_configurations(entity: Entity, parser: Parser) -> dict[Any, Any] | None:
    """Return the ``<keep name=… value=…/>`` of an element, None when it has none."""
    found = entity.get_attr("keep", data_type=list[Entity], optional=True)
    if found is None:
        return None
    kept = {}
    for one in found:
        name = tuple(parser.parse_substitution(one.get_attr("name")))
        kept[name] = parser.parse_substitution(one.get_attr("value"))
        one.assert_entity_completely_parsed()
    return kept


def _text(context: LaunchContext, value: Any) -> str:
    return perform_substitutions(context, normalize_to_list_of_substitutions(value))
