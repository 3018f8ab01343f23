"""launch_testing.event_handlers."""

from __future__ import annotations

from typing import Any

from gazelle.launch.ros2.event_handlers import OnProcessIO
from gazelle.launch.ros2.launch_description_entity import SomeEntitiesType

__all__ = ["StdoutReadyListener"]


class StdoutReadyListener(OnProcessIO):
    """Visits actions when a process writes a text to standard output."""

    def __init__(self, *, target_action: Any = None, ready_txt: str, actions: Any) -> None:
        super().__init__(
            target_action=target_action,
            on_stdout=lambda event: actions if ready_txt in event.text.decode() else None,
        )
        self.__actions = actions

    def describe(self) -> tuple[str, list[SomeEntitiesType]]:
        """Return a text for people, and the actions."""
        return super().describe()[0], list(self.__actions)
