"""Where a launch description comes from."""

from __future__ import annotations

import traceback

from gazelle.launch.ros2 import logging as launch_logging
from gazelle.launch.ros2.launch_context import LaunchContext
from gazelle.launch.ros2.launch_description import LaunchDescription
from gazelle.launch.ros2.substitution import SomeSubstitutionsType
from gazelle.launch.ros2.substitutions.substitution_failure import described
from gazelle.launch.ros2.utilities import (
    normalize_to_list_of_substitutions,
    perform_substitutions,
)

__all__ = ["LaunchDescriptionSource"]


class LaunchDescriptionSource:
    """A launch description, or where to read one when it is wanted.

    Attributes:
        method: how it is read, in words.
    """

    def __init__(
        self,
        launch_description: LaunchDescription | None = None,
        location: SomeSubstitutionsType = "<string>",
        method: str = "unspecified mechanism from a script",
    ) -> None:
        self.__launch_description = launch_description
        self.__location = normalize_to_list_of_substitutions(location)
        self.__expanded_location: str | None = None
        self.method = method

    def try_get_launch_description_without_context(self) -> LaunchDescription | None:
        """Return the description, None when that takes a running launch or fails."""
        if self.__launch_description is not None:
            return self.__launch_description
        try:
            location = perform_substitutions(LaunchContext(), self.__location)
            return self._get_launch_description(location)
        except Exception as error:  # noqa: BLE001 - whatever it is, the run tells it
            logger = launch_logging.get_logger("launch.launch_description_source")
            logger.debug(traceback.format_exc())
            logger.debug(f"Failed to load the launch file without a context: {error}")
            return None

    def get_launch_description(self, context: LaunchContext) -> LaunchDescription:
        """Return the description; it is read once.

        Raises:
            RuntimeError: there is none.
        """
        if self.__expanded_location is None:
            self.__expanded_location = perform_substitutions(context, self.__location)
        if self.__launch_description is None:
            self.__launch_description = self._get_launch_description(self.__expanded_location)
        return self.__launch_description

    def _get_launch_description(self, location: str) -> LaunchDescription:
        raise RuntimeError(
            "LaunchDescriptionSource.get_launch_description(): "
            "called without launch description being set"
        )

    @property
    def location(self) -> str:
        """The path of its file, or the substitutions it is made of."""
        if self.__expanded_location is None:
            return described(self.__location)
        return self.__expanded_location
