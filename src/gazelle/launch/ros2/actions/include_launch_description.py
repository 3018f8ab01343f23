"""Including other launch files."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gazelle.diagnostics import did_you_mean
from gazelle.documents.files import exists
from gazelle.launch.ros2 import logging as launch_logging
from gazelle.launch.ros2.action import Action
from gazelle.launch.ros2.actions.launch_configurations import SetLaunchConfiguration
from gazelle.launch.ros2.frontend import Entity, Parser, expose_action
from gazelle.launch.ros2.launch_context import LaunchContext
from gazelle.launch.ros2.launch_description_entity import LaunchDescriptionEntity
from gazelle.launch.ros2.launch_description_source import LaunchDescriptionSource
from gazelle.launch.ros2.launch_description_sources import AnyLaunchDescriptionSource
from gazelle.launch.ros2.substitution import SomeSubstitutionsType
from gazelle.launch.ros2.user_spans import keep_span
from gazelle.launch.ros2.utilities import (
    normalize_to_list_of_substitutions,
    perform_substitutions,
)

if TYPE_CHECKING:
    from gazelle.launch.ros2.launch_description import LaunchDescription

__all__ = ["IncludeLaunchDescription"]


@expose_action("include")
class IncludeLaunchDescription(Action):
    """Visits the entities of another launch file.

    Attributes:
        launch_description_source: where they come from.
        launch_arguments: names and values that are set before.
    """

    def __init__(
        self,
        launch_description_source: LaunchDescriptionSource | SomeSubstitutionsType,
        *,
        launch_arguments: Iterable[tuple[SomeSubstitutionsType, SomeSubstitutionsType]]
        | None = None,
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        source = launch_description_source
        if not isinstance(source, LaunchDescriptionSource):
            source = AnyLaunchDescriptionSource(source)
        if isinstance(launch_arguments, Mapping):
            raise TypeError(
                "launch_arguments of IncludeLaunchDescription has to be pairs of names and "
                "values: write {…}.items()"
            )
        self.launch_description_source = source
        self.launch_arguments = tuple(launch_arguments or ())

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[Any, dict[str, Any]]:
        """Return class and arguments of an ``<include>``."""
        _, kwargs = super().parse(entity, parser)
        kwargs["launch_description_source"] = parser.parse_substitution(entity.get_attr("file"))
        pairs = []
        # ROS 2 calls them arg, and let since Kilted.
        for tag in ("arg", "let"):
            given = entity.get_attr(tag, data_type=list[Entity], optional=True)
            for one in given or ():
                name = parser.parse_substitution(one.get_attr("name"))
                pairs.append((name, parser.parse_substitution(one.get_attr("value"))))
                one.assert_entity_completely_parsed()
        kwargs["launch_arguments"] = pairs
        return cls, kwargs

    def get_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """Return the description, if it can be read without a running launch."""
        found = self.launch_description_source.try_get_launch_description_without_context()
        return [] if found is None else [found]

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity]:
        """Read the file, check its arguments, and return them and what it holds.

        Raises:
            RuntimeError: an argument of the file has neither value nor default.
        """
        description = self.launch_description_source.get_launch_description(context)
        location = self.launch_description_source.location
        file = Path(location).absolute()
        # A description that a script made has a location such as <script>.
        folder = str(file.parent) if exists(file) else location
        places = {"current_launch_file_path": str(file), "current_launch_file_directory": folder}
        context.extend_locals(places)
        self.__check_arguments(description, context)
        settings = [SetLaunchConfiguration(name, value) for name, value in self.launch_arguments]
        for setting in settings:
            setting.span = self.span
        return [*settings, description]

    def __check_arguments(self, description: LaunchDescription, context: LaunchContext) -> None:
        given = self._argument_names(context)
        pairs = description.get_launch_arguments_with_include_launch_description_actions()
        for argument, includes in pairs:
            if argument._conditionally_included or argument.default_value is not None:
                continue
            names = [*given]
            for include in includes or ():
                names += include._try_get_arguments_names_without_context() or ()
            if argument.name not in names:
                hint = did_you_mean(argument.name, names)
                message = (
                    f"Included launch description missing required argument '{argument.name}' "
                    f"(description: '{argument.description}'), given: [{', '.join(names)}]"
                )
                error = RuntimeError(f"{message}; {hint}" if hint else message)
                # Of the command line's own include no line is the user's.
                inner = includes[-1].span if includes else self.span
                keep_span(error, inner or argument.span)
                raise error

    def _argument_names(self, context: LaunchContext) -> list[str]:
        return [
            perform_substitutions(context, normalize_to_list_of_substitutions(name))
            for name, _value in self.launch_arguments
        ]

    def _try_get_arguments_names_without_context(self) -> list[str] | None:
        try:
            return self._argument_names(LaunchContext())
        except Exception as error:  # noqa: BLE001 - whatever it is, the run tells it
            launch_logging.get_logger("launch.include").debug(
                "Failed to get launch arguments names for launch description "
                f"'{self.launch_description_source.location}', with exception: {error}"
            )
            return None
