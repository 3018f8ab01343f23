"""Lines of the log."""

from __future__ import annotations

import logging
from typing import TYPE_CHECKING, Any

from gazelle.launch.ros2 import logging as launch_logging
from gazelle.launch.ros2.action import Action
from gazelle.launch.ros2.frontend import Entity, Parser, expose_action
from gazelle.launch.ros2.substitution import SomeSubstitutionsType
from gazelle.launch.ros2.utilities import (
    normalize_to_list_of_substitutions,
    perform_substitutions,
)

if TYPE_CHECKING:
    from gazelle.launch.ros2.launch_context import LaunchContext

__all__ = ["Log", "LogDebug", "LogError", "LogInfo", "LogWarning"]


@expose_action("log")
class Log(Action):
    """Logs a line.

    Attributes:
        msg: the line.
        level: one of Python's names of levels, such as ``INFO``.
    """

    def __init__(
        self, *, msg: SomeSubstitutionsType, level: SomeSubstitutionsType, **kwargs: Any
    ) -> None:
        super().__init__(**kwargs)
        self.msg = normalize_to_list_of_substitutions(msg)
        self.level = normalize_to_list_of_substitutions(level)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[Any, dict[str, Any]]:
        """Return class and arguments of a ``<log>``; without a level it is a `LogInfo`.

        It has no level up to Jazzy, where `LogInfo` is what ``<log>`` makes.
        """
        _, kwargs = super().parse(entity, parser)
        kwargs["msg"] = parser.parse_substitution(entity.get_attr("message"))
        if cls is not Log:
            return cls, kwargs
        level = entity.get_attr("level", optional=True)
        if level is None:
            return LogInfo, kwargs
        kwargs["level"] = parser.parse_substitution(level)
        return cls, kwargs

    def execute(self, context: LaunchContext) -> None:
        """Log it.

        Raises:
            KeyError: there is no such level.
        """
        name = perform_substitutions(context, self.level).upper()
        levels = logging.getLevelNamesMapping()
        if name not in levels:
            raise KeyError(f"Invalid log level '{name}', expected: {', '.join(levels)}")
        text = perform_substitutions(context, self.msg)
        launch_logging.get_logger("launch.user").log(levels[name], text)


class _Leveled(Log):
    LEVEL = ""

    def __init__(self, *, msg: SomeSubstitutionsType, **kwargs: Any) -> None:
        kwargs["level"] = self.LEVEL
        super().__init__(msg=msg, **kwargs)


@expose_action("log_info")
class LogInfo(_Leveled):
    """Logs a line at the level INFO."""

    LEVEL = "INFO"


@expose_action("log_warning")
class LogWarning(_Leveled):
    """Logs a line at the level WARNING."""

    LEVEL = "WARNING"


@expose_action("log_debug")
class LogDebug(_Leveled):
    """Logs a line at the level DEBUG."""

    LEVEL = "DEBUG"


@expose_action("log_error")
class LogError(_Leveled):
    """Logs a line at the level ERROR."""

    LEVEL = "ERROR"
