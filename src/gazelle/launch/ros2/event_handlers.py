"""launch.event_handlers."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any

from gazelle.launch.ros2.action import Action
from gazelle.launch.ros2.event import Event
from gazelle.launch.ros2.event_handler import BaseEventHandler, EventHandler
from gazelle.launch.ros2.events import ExecutionComplete, IncludeLaunchDescription, Shutdown
from gazelle.launch.ros2.events.process import ProcessExited, ProcessIO, ProcessStarted
from gazelle.launch.ros2.launch_description_entity import LaunchDescriptionEntity, SomeEntitiesType
from gazelle.launch.ros2.utilities import is_a_subclass

if TYPE_CHECKING:
    from gazelle.launch.ros2.launch_context import LaunchContext

__all__ = [
    "OnActionEventBase",
    "OnExecutionComplete",
    "OnIncludeLaunchDescription",
    "OnProcessExit",
    "OnProcessIO",
    "OnProcessStart",
    "OnShutdown",
    "event_named",
]


def event_named(name: str) -> Callable[[Event], bool]:
    """Return a matcher for events with a name."""
    return lambda event: event.name == name


class OnActionEventBase(BaseEventHandler):
    """A handler of the events of one action, of those a function picks, or of all."""

    def __init__(
        self,
        *,
        action_matcher: Any,
        on_event: Any,
        target_event_cls: type[Event],
        target_action_cls: type[Action],
        **kwargs: Any,
    ) -> None:
        if not issubclass(target_event_cls, Event):
            raise TypeError("'target_event_cls' must be a subclass of 'Event'")
        is_target = isinstance(action_matcher, target_action_cls)
        if action_matcher is not None and not is_target and not callable(action_matcher):
            kind = target_action_cls.__name__
            raise TypeError(f"action_matcher must be an '{kind}' instance or a callable")
        super().__init__(matcher=self._picks, **kwargs)
        self.__event_cls = target_event_cls
        self.__action_cls = target_action_cls
        self.__matcher: Any = action_matcher
        self.__on_event = on_event if callable(on_event) else None
        self.__actions = [] if callable(on_event) else _entities(on_event)

    def _picks(self, event: Any) -> bool:
        if not isinstance(event, self.__event_cls):
            return False
        action: Any = getattr(event, "action", None)
        if self.__matcher is None:
            return True
        if callable(self.__matcher):
            return bool(self.__matcher(action))
        return action is self.__matcher

    def handle(self, event: Event, context: LaunchContext) -> SomeEntitiesType | None:
        """Return the entities, or what the function returns."""
        super().handle(event, context)
        if self.__on_event is None:
            return self.__actions
        found: SomeEntitiesType | None = self.__on_event(event, context)
        return found

    def describe(self) -> tuple[str, list[SomeEntitiesType]]:
        """Return a text for people, and the entities."""
        text, found = super().describe()
        return text, [*found, *self.__actions]

    @property
    def handler_description(self) -> str:
        """What it does, in words."""
        return "<actions>" if self.__on_event is None else str(self.__on_event)

    @property
    def matcher_description(self) -> str:
        """Which events it picks, in words."""
        kind = self.__event_cls.__name__
        if self.__matcher is None:
            return f"event == {kind}"
        return f"event == {kind} and {self.__action_cls.__name__}(event.action)"


def _entities(on_event: Any) -> list[LaunchDescriptionEntity]:
    if not isinstance(on_event, Iterable):
        return [on_event]
    entities = list(on_event)
    for entity in entities:
        if not isinstance(entity, LaunchDescriptionEntity):
            raise TypeError(
                "expected all items in 'on_event' iterable to be of type "
                f"'LaunchDescriptionEntity' but got '{type(entity)}'"
            )
    return entities


class OnExecutionComplete(OnActionEventBase):
    """Does something when an action has been carried out."""

    def __init__(self, *, target_action: Any = None, on_completion: Any, **kwargs: Any) -> None:
        super().__init__(
            action_matcher=target_action,
            on_event=on_completion,
            target_event_cls=ExecutionComplete,
            target_action_cls=Action,
            **kwargs,
        )


class OnProcessStart(OnActionEventBase):
    """Does something when a process has started."""

    def __init__(self, *, target_action: Any = None, on_start: Any, **kwargs: Any) -> None:
        super().__init__(
            action_matcher=target_action,
            on_event=on_start,
            target_event_cls=ProcessStarted,
            target_action_cls=_execute_local(),
            **kwargs,
        )


class OnProcessExit(OnActionEventBase):
    """Does something when a process has ended."""

    def __init__(self, *, target_action: Any = None, on_exit: Any, **kwargs: Any) -> None:
        super().__init__(
            action_matcher=target_action,
            on_event=on_exit,
            target_event_cls=ProcessExited,
            target_action_cls=_execute_local(),
            **kwargs,
        )


_OnIO = Callable[[Any], "SomeEntitiesType | None"]


class OnProcessIO(OnActionEventBase):
    """Does something when a process wrote something."""

    def __init__(
        self,
        *,
        target_action: Any = None,
        on_stdin: _OnIO | None = None,
        on_stdout: _OnIO | None = None,
        on_stderr: _OnIO | None = None,
        **kwargs: Any,
    ) -> None:
        functions = {0: on_stdin, 1: on_stdout, 2: on_stderr}

        def handle(event: ProcessIO, _context: LaunchContext) -> SomeEntitiesType | None:
            function = functions.get(event.fd)
            return None if function is None else function(event)

        super().__init__(
            action_matcher=target_action,
            on_event=handle,
            target_event_cls=ProcessIO,
            target_action_cls=_execute_local(),
            **kwargs,
        )


class OnIncludeLaunchDescription(EventHandler):
    """Visits the description that an IncludeLaunchDescription event brings."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(
            matcher=lambda event: is_a_subclass(event, IncludeLaunchDescription), **kwargs
        )

    def handle(self, event: Any, context: LaunchContext) -> SomeEntitiesType | None:
        """Return the description."""
        super().handle(event, context)
        return [event.launch_description]

    @property
    def handler_description(self) -> str:
        """What it does, in words."""
        return "returns the launch_description in the event"

    @property
    def matcher_description(self) -> str:
        """Which events it picks, in words."""
        return "event issubclass of launch.events.IncludeLaunchDescription"


class OnShutdown(BaseEventHandler):
    """Does something when the launch begins to end."""

    def __init__(self, *, on_shutdown: Any, **kwargs: Any) -> None:
        super().__init__(matcher=lambda event: is_a_subclass(event, Shutdown), **kwargs)
        self.__on_shutdown = on_shutdown

    def handle(self, event: Event, context: LaunchContext) -> SomeEntitiesType | None:
        """Return the entities, or what the function returns."""
        super().handle(event, context)
        found: SomeEntitiesType | None = (
            self.__on_shutdown(event, context)
            if callable(self.__on_shutdown)
            else self.__on_shutdown
        )
        return found

    @property
    def handler_description(self) -> str:
        """What it does, in words."""
        return str(self.__on_shutdown)

    @property
    def matcher_description(self) -> str:
        """Which events it picks, in words."""
        return "event issubclass of launch.events.Shutdown"


def _execute_local() -> type[Action]:
    from gazelle.launch.ros2.actions import ExecuteLocal

    return ExecuteLocal
