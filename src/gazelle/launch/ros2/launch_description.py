"""A launch description: entities in order."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, Any

from gazelle.launch.ros2 import logging as launch_logging
from gazelle.launch.ros2.action import Action
from gazelle.launch.ros2.launch_description_entity import LaunchDescriptionEntity

if TYPE_CHECKING:
    from gazelle.launch.ros2.launch_context import LaunchContext

__all__ = ["LaunchDescription", "argument_lines"]

_MAX_DEPTH = 50


class LaunchDescription(LaunchDescriptionEntity):
    """What a launch file comes to.

    Attributes:
        entities: in the order of their visit.
        deprecated_reason: what to use instead, None when it is not deprecated.
    """

    def __init__(
        self,
        initial_entities: Iterable[LaunchDescriptionEntity] | None = None,
        *,
        deprecated_reason: str | None = None,
    ) -> None:
        self.entities = list(initial_entities or ())
        for number, item in enumerate(self.entities, start=1):
            if not isinstance(item, LaunchDescriptionEntity):
                raise TypeError(_no_entity(number, item))
        self.deprecated_reason = deprecated_reason

    @property
    def deprecated(self) -> bool:
        """Whether something else should be used."""
        return self.deprecated_reason is not None

    def visit(self, context: LaunchContext) -> list[LaunchDescriptionEntity] | None:
        """Return its entities; warn when it is deprecated."""
        if self.deprecated:
            file = context.get_locals_as_dict().get("current_launch_file_path")
            what = (
                f"launch file [{file}] is deprecated" if file else "deprecated launch description"
            )
            launch_logging.get_logger("launch").warning(f"{what}: {self.deprecated_reason}")
        return self.entities

    def describe(self) -> str:
        """Return a text for people."""
        return repr(self)

    def describe_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """Return its entities."""
        return self.entities

    def add_entity(self, entity: LaunchDescriptionEntity) -> None:
        """Add an entity at the end."""
        self.entities.append(entity)

    def add_action(self, action: Action) -> None:
        """Add an action at the end."""
        self.add_entity(action)

    def get_launch_arguments(self, conditional_inclusion: bool = False) -> list[Any]:
        """Return the declared arguments, those of included files too."""
        pairs = self.get_launch_arguments_with_include_launch_description_actions(
            conditional_inclusion
        )
        return [argument for argument, _includes in pairs]

    def get_launch_arguments_with_include_launch_description_actions(
        self, conditional_inclusion: bool = False
    ) -> list[tuple[Any, list[Any] | None]]:
        """Return the declared arguments, each with the includes on the way to it.

        Of several declarations of a name the first counts. An argument's
        ``_conditionally_included`` says whether a condition stands before it.
        """
        found: dict[str, tuple[Any, list[Any] | None]] = {}
        for argument, includes, conditional in _declared(
            self.entities, None, conditional_inclusion
        ):
            if argument.name not in found:
                argument._conditionally_included = conditional or argument.condition is not None
                found[argument.name] = argument, includes
        return list(found.values())


def _no_entity(number: int, item: Any) -> str:
    hints: dict[type, str] = {
        tuple: "a comma behind an action makes a tuple of it",
        list: "write * before a list",
        type(None): "a function may lack its return",
        type: "write () behind a class",
    }
    hint = hints.get(type(item), "")
    kind = (
        f"the class {item.__name__}" if isinstance(item, type) else f"of type {type(item).__name__}"
    )
    text = f"a LaunchDescription holds actions, but its item {number} is {kind}"
    return f"{text} ({hint})" if hint else text


def argument_lines(description: LaunchDescription) -> list[str]:
    """Return what ``--show-args`` prints about the arguments of a description."""
    lines = ["Arguments (pass arguments as '<name>:=<value>'):"]
    arguments = description.get_launch_arguments()
    for one in arguments:
        star = "*" if one._conditionally_included else ""
        lines += ["", f"    '{one.name}':{star}", f"        {one.description}"]
        if one.default_value is not None:
            default = " + ".join(sub.describe() for sub in one.default_value)
            lines.append(f"        (default: {default})")
    if not arguments:
        lines += ["", "  No arguments."]
    elif any(one._conditionally_included for one in arguments):
        lines += ["", "* argument(s) which are only used if specific conditions occur"]
    return lines


def _declared(
    entities: Iterable[LaunchDescriptionEntity], includes: list[Any] | None, conditional: bool
) -> Iterator[tuple[Any, list[Any] | None, bool]]:
    from gazelle.launch.ros2.actions import (
        DeclareLaunchArgument,
        IncludeLaunchDescription,
        ResetLaunchConfigurations,
    )

    for entity in entities:
        if isinstance(entity, ResetLaunchConfigurations):
            # What is declared behind it is not set from outside.
            return
        inner = includes
        if isinstance(entity, IncludeLaunchDescription):
            inner = [*(includes or ()), entity]
            if len(inner) > _MAX_DEPTH:
                chain = inner[-1].launch_description_source.location
                raise RecursionError(f"launch files include each other without end: {chain}")
        if isinstance(entity, DeclareLaunchArgument):
            yield entity, includes, conditional
        yield from _declared(entity.describe_sub_entities(), inner, conditional)
        for _condition, below in entity.describe_conditional_sub_entities():
            yield from _declared(below, inner, True)
