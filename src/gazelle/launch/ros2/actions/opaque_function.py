"""Functions of the user."""

from __future__ import annotations

import asyncio
import inspect
from collections.abc import Awaitable, Callable, Iterable
from typing import TYPE_CHECKING, Any

from gazelle.launch.ros2.action import Action
from gazelle.launch.ros2.event import Event
from gazelle.launch.ros2.event_handlers import OnShutdown
from gazelle.launch.ros2.launch_description_entity import LaunchDescriptionEntity
from gazelle.launch.ros2.utilities import ensure_argument_type

if TYPE_CHECKING:
    from gazelle.launch.ros2.launch_context import LaunchContext

__all__ = ["OpaqueCoroutine", "OpaqueFunction"]


class OpaqueFunction(Action):
    """Calls a function with the context; what it returns is visited."""

    def __init__(
        self,
        *,
        function: Any,
        args: Iterable[Any] | None = None,
        kwargs: dict[str, Any] | None = None,
        **left_over_kwargs: Any,
    ) -> None:
        super().__init__(**left_over_kwargs)
        if not callable(function):
            kind = type(function)
            raise TypeError(f"OpaqueFunction expected a callable for 'function', got '{kind}'")
        _check_arguments(args, kwargs, "OpaqueFunction")
        self.__function = function
        self.__args = tuple(args or ())
        self.__kwargs = dict(kwargs or {})

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity] | None:
        """Call it.

        Raises:
            TypeError: it returned something that cannot be visited.
        """
        found: Any = self.__function(context, *self.__args, **self.__kwargs)
        if isinstance(found, LaunchDescriptionEntity):
            raise TypeError(
                f"the function of OpaqueFunction returned a {type(found).__name__}; "
                "it has to return a list of actions, or None"
            )
        return None if found is None else list(found)


class OpaqueCoroutine(Action):
    """Runs a coroutine beside everything else; it is cancelled when the launch ends."""

    def __init__(
        self,
        *,
        coroutine: Callable[..., Awaitable[None]],
        args: Iterable[Any] | None = None,
        kwargs: dict[str, Any] | None = None,
        ignore_context: bool = False,
        **left_over_kwargs: Any,
    ) -> None:
        super().__init__(**left_over_kwargs)
        if not inspect.iscoroutinefunction(coroutine):
            kind = type(coroutine)
            raise TypeError(
                f"OpaqueCoroutine expected a coroutine function for 'coroutine', got '{kind}'"
            )
        _check_arguments(args, kwargs, "OpaqueCoroutine")
        ensure_argument_type(ignore_context, bool, "ignore_context", "OpaqueCoroutine")
        self.__coroutine = coroutine
        self.__args = tuple(args or ())
        self.__kwargs = dict(kwargs or {})
        self.__ignore_context = ignore_context
        self.__future: asyncio.Future[Any] | None = None

    def execute(self, context: LaunchContext) -> None:
        """Begin it."""
        args = self.__args if self.__ignore_context else (context, *self.__args)
        self.__future = context.asyncio_loop.create_task(self.__coroutine(*args, **self.__kwargs))
        context.register_event_handler(OnShutdown(on_shutdown=self.__cancel))

    def __cancel(self, _event: Event, _context: LaunchContext) -> None:
        if self.__future is not None:
            self.__future.cancel()

    def get_asyncio_future(self) -> asyncio.Future[Any] | None:
        """Return its task, None before it has begun."""
        return self.__future


def _check_arguments(args: Any, kwargs: Any, caller: str) -> None:
    ensure_argument_type(args, (Iterable, type(None)), "args", caller)
    ensure_argument_type(kwargs, (dict, type(None)), "kwargs", caller)
