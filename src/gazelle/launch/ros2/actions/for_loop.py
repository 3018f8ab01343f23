"""Loops: the same entities for every set of values, or a number of times."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from copy import deepcopy
from typing import TYPE_CHECKING, Any

from gazelle.documents.yaml import load_yaml
from gazelle.launch.ros2.action import Action
from gazelle.launch.ros2.actions.opaque_function import OpaqueFunction
from gazelle.launch.ros2.frontend import Entity, Parser, expose_action
from gazelle.launch.ros2.launch_description_entity import LaunchDescriptionEntity
from gazelle.launch.ros2.logging import get_logger
from gazelle.launch.ros2.substitution import SomeSubstitutionsType
from gazelle.launch.ros2.substitutions import ForEachVar
from gazelle.launch.ros2.utilities import (
    normalize_to_list_of_substitutions,
    perform_substitutions,
)

if TYPE_CHECKING:
    from gazelle.launch.ros2.launch_context import LaunchContext

__all__ = ["ForEach", "ForLoop"]

_Function = Callable[..., list[LaunchDescriptionEntity] | None]


@expose_action("for_each")
class ForEach(Action):
    """Calls a function for every set of values, and launches what it returns.

    Attributes:
        input_values: sets as flow style YAML, such as ``{name: a, id: 1};{name: b, id: 2}``.
        function: takes the names of a set as keywords.
    """

    SEPARATOR = ";"

    def __init__(
        self, input_values: SomeSubstitutionsType, *, function: _Function, **kwargs: Any
    ) -> None:
        super().__init__(**kwargs)
        self.input_values = normalize_to_list_of_substitutions(input_values)
        self.function = function

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[Any, dict[str, Any]]:
        """Return class and arguments of a ``<for_each>``."""
        _, kwargs = super().parse(entity, parser)
        kwargs["input_values"] = parser.parse_substitution(entity.get_attr("values"))
        children = [parser.parse_action(child) for child in entity.children]
        kwargs["function"] = lambda **values: _round(children, values)
        return cls, kwargs

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity]:
        """Return what the function makes of all sets."""
        text = perform_substitutions(context, self.input_values)
        parts = [part.strip() for part in text.split(self.SEPARATOR) if part.strip()]
        if not parts:
            get_logger("launch.actions.for_loop").warning("no input values: will not iterate")
        entities: list[LaunchDescriptionEntity] = []
        for part in parts:
            values = load_yaml(part)
            if not isinstance(values, dict):
                raise ValueError(
                    f"ForEach: '{part}' is no set of values; write each set as {{name: value}} and"
                    f" '{self.SEPARATOR}' between two of them"
                )
            entities += self.function(**values) or []
        return entities


@expose_action("for")
class ForLoop(Action):
    """Calls a function with 0, 1, 2 ..., and launches what it returns.

    Attributes:
        length: how many times.
        function: takes the number as ``i``.
        name: what the number is called in XML and YAML.
    """

    def __init__(
        self,
        length: SomeSubstitutionsType,
        *,
        function: _Function,
        name: str | None = None,
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        self.length = normalize_to_list_of_substitutions(length)
        self.function = function
        self.name = name

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[Any, dict[str, Any]]:
        """Return class and arguments of a ``<for>``."""
        _, kwargs = super().parse(entity, parser)
        kwargs["length"] = parser.parse_substitution(entity.get_attr("len"))
        kwargs["name"] = name = entity.get_attr("name")
        children = [parser.parse_action(child) for child in entity.children]
        kwargs["function"] = lambda i: _round(children, {name: i})
        return cls, kwargs

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity]:
        """Return what the function makes of all numbers."""
        length = int(perform_substitutions(context, self.length))
        return [entity for i in range(length) for entity in self.function(i=i) or []]


def _round(
    children: Sequence[LaunchDescriptionEntity], values: Mapping[str, Any]
) -> list[LaunchDescriptionEntity]:
    named = {ForEachVar.get_local_arg_name(name): str(value) for name, value in values.items()}

    def begin(context: LaunchContext) -> None:
        context._push_locals()
        context.extend_locals(named)

    def end(context: LaunchContext) -> None:
        context._pop_locals()

    return [OpaqueFunction(function=begin), *deepcopy(list(children)), OpaqueFunction(function=end)]
