"""launch_testing.actions."""

from __future__ import annotations

import sys
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from gazelle.launch.ros2 import logging as launch_logging
from gazelle.launch.ros2.action import Action
from gazelle.launch.ros2.actions import EmitEvent, ExecuteProcess, TimerAction
from gazelle.launch.ros2.event_handlers import OnProcessExit
from gazelle.launch.ros2.events import matches_action
from gazelle.launch.ros2.events.process import ShutdownProcess
from gazelle.launch.ros2.launch_description_entity import LaunchDescriptionEntity
from gazelle.launch.ros2.substitution import SomeSubstitutionsType

if TYPE_CHECKING:
    from gazelle.launch.ros2.launch_context import LaunchContext

__all__ = ["GTest", "PyTest", "ReadyToTest", "Test"]


class ReadyToTest(Action):
    """Says that tests may begin."""

    def __init__(self) -> None:
        super().__init__()
        self._callbacks: list[Callable[[], object]] = []

    def _add_callback(self, callback: Callable[[], object]) -> None:
        self._callbacks.append(callback)

    def execute(self, context: LaunchContext) -> None:
        """Tell whoever waits."""
        for callback in self._callbacks:
            try:
                callback()
            except Exception as error:  # noqa: BLE001 - the others are told all the same
                launch_logging.get_logger("launch_testing").error(str(error))


class Test(ExecuteProcess):
    """Runs a program that tests something; it may take so long and no longer.

    Attributes:
        timeout: seconds, None for any time.
    """

    # Not a class of tests itself, whatever its name.
    __test__ = False

    def __init__(
        self,
        *,
        timeout: float | SomeSubstitutionsType | None = None,
        kill_timeout: float = 5.0,
        **kwargs: Any,
    ) -> None:
        kwargs.setdefault("sigterm_timeout", str(kill_timeout))
        super().__init__(**kwargs)
        self.timeout = timeout

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity] | None:
        """Start it, and the timer that ends it."""
        actions = super().execute(context)
        if not self.timeout:
            return actions
        event = ShutdownProcess(process_matcher=matches_action(self))
        timer = TimerAction(period=self.timeout, actions=[EmitEvent(event=event)])
        context.register_event_handler(
            OnProcessExit(target_action=self, on_exit=lambda *_: timer.cancel())
        )
        return [*(actions or ()), timer]


class GTest(Test):
    """Runs a program made with gtest.

    Attributes:
        path: of the program.
    """

    __test__ = False

    def __init__(self, *, path: SomeSubstitutionsType, **kwargs: Any) -> None:
        super().__init__(cmd=[path], **kwargs)
        self.path = path


class PyTest(Test):
    """Runs a file with pytest.

    Attributes:
        path: of the file.
    """

    __test__ = False

    def __init__(self, *, path: SomeSubstitutionsType, **kwargs: Any) -> None:
        super().__init__(cmd=[sys.executable, "-m", "pytest", path], **kwargs)
        self.path = path
