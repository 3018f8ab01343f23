"""What a running launch knows: configurations, environment, handlers, the queue of events."""

from __future__ import annotations

import asyncio
import collections
import os
from collections.abc import Iterable, MutableMapping
from typing import Any

from gazelle.diagnostics import Diagnostic, Diagnostics, render
from gazelle.launch.ros2.child_process import WatchedGroups
from gazelle.launch.ros2.cpp_builds import CppBuilds
from gazelle.launch.ros2.event import Event
from gazelle.launch.ros2.event_handler import BaseEventHandler
from gazelle.launch.ros2.substitution import Substitution
from gazelle.launch.ros2.user_spans import keep_span
from gazelle.launch.watchdog import Watchdog

__all__ = ["LaunchContext"]


class _Locals:
    """The locals of a context as attributes."""

    def __init__(self, values: dict[str, Any]) -> None:
        self.__dict__["_values"] = values

    def __getattr__(self, name: str) -> Any:
        values = self.__dict__["_values"]
        if name not in values:
            known = ", ".join(values)
            message = f"context.locals does not contain attribute '{name}', it contains: [{known}]"
            raise AttributeError(message)
        return values[name]

    def __setattr__(self, name: str, value: Any) -> None:
        raise AttributeError(f"can't set attribute '{name}', locals are read-only")


class LaunchContext:
    """The state of a launch that entities see when they are visited.

    The environment is the process's own, as in ROS 2: what a launch file sets there, its
    processes inherit.

    Attributes:
        diagnostics: what is wrong with the user's files, everything so far.
        watched_groups: the processes, which end when the launcher does; None before the first.
        cpp_builds: C++ that is compiled before processes start.
    """

    def __init__(self, *, argv: Iterable[str] | None = None, noninteractive: bool = False) -> None:
        self.__argv = list(argv) if argv is not None else []
        self.__noninteractive = noninteractive
        self.diagnostics = Diagnostics()
        self.watched_groups: WatchedGroups | None = None
        self.cpp_builds = CppBuilds(
            lambda: self.asyncio_loop, self.report, lambda: self.is_shutdown
        )
        self._event_queue: asyncio.Queue[Event] = asyncio.Queue()
        self._event_handlers: collections.deque[BaseEventHandler] = collections.deque()
        self._completion_futures: list[asyncio.Future[Any]] = []
        self.__globals: dict[str, Any] = {}
        self.__locals: dict[str, Any] = {}
        self.__locals_stack: list[dict[str, Any]] = []
        self.__launch_configurations: dict[str, str] = {}
        self.__launch_configurations_stack: list[dict[str, str]] = []
        self.__environment_stack: list[dict[str, str]] = []
        self.__environment_at_start = dict(os.environ)
        self.__is_shutdown = False
        self.__asyncio_loop: asyncio.AbstractEventLoop | None = None

    @property
    def argv(self) -> list[str]:
        """The words of the command line."""
        return self.__argv

    @property
    def noninteractive(self) -> bool:
        """Whether no person sits at the terminal."""
        return self.__noninteractive

    @property
    def is_shutdown(self) -> bool:
        """Whether the launch is ending."""
        return self.__is_shutdown

    @property
    def asyncio_loop(self) -> Any:
        """The event loop of the running launch, None when it does not run."""
        return self.__asyncio_loop

    @property
    def launch_configurations(self) -> dict[str, str]:
        """The values of arguments and of everything else that was set, by name."""
        return self.__launch_configurations

    @property
    def environment(self) -> MutableMapping[str, str]:
        """The environment of processes to come."""
        return os.environ

    def report(self, diagnostic: Diagnostic) -> None:
        """Keep a finding about the user's files and show it on the terminal, once."""
        known = len(self.diagnostics)
        self.diagnostics.add(diagnostic)
        if len(self.diagnostics) > known:
            render([diagnostic])

    def watch(self, group: int) -> WatchedGroups:
        """Let a process group end with the launcher, even when that is killed."""
        if self.watched_groups is None:
            self.watched_groups = WatchedGroups(Watchdog(), set())
        self.watched_groups.begun(group)
        return self.watched_groups

    def add_completion_future(self, completion_future: asyncio.Future[Any]) -> None:
        """Let the launch go on at least until this is done."""
        self._completion_futures.append(completion_future)

    def extend_globals(self, extensions: dict[str, Any]) -> None:
        """Add to the locals for good; `extend_locals` wins over it."""
        self.__globals.update(extensions)

    def extend_locals(self, extensions: dict[str, Any]) -> None:
        """Add to the locals until the event at hand is done with."""
        self.__locals.update(extensions)

    def get_locals_as_dict(self) -> dict[str, Any]:
        """Return the locals as a dictionary."""
        return {**self.__globals, **self.__locals}

    @property
    def locals(self) -> Any:
        """The locals as attributes, such as ``context.locals.event``."""
        return _Locals(self.get_locals_as_dict())

    def would_handle_event(self, event: Event) -> bool:
        """Return whether any handler wants the event."""
        return any(handler.matches(event) for handler in self._event_handlers)

    def register_event_handler(self, event_handler: BaseEventHandler, append: bool = False) -> None:
        """Add a handler in front of the others, or behind them.

        What is registered later is asked first, so processes end in the reverse order of their
        start.
        """
        if append:
            self._event_handlers.append(event_handler)
        else:
            self._event_handlers.appendleft(event_handler)

    def unregister_event_handler(self, event_handler: BaseEventHandler) -> None:
        """Take a handler out.

        Raises:
            ValueError: it is not registered.
        """
        self._event_handlers.remove(event_handler)

    def emit_event_sync(self, event: Event) -> None:
        """Queue an event."""
        self._event_queue.put_nowait(event)

    async def emit_event(self, event: Event) -> None:
        """Queue an event."""
        await self._event_queue.put(event)

    def perform_substitution(self, substitution: Substitution) -> str:
        """Return the text of a substitution."""
        try:
            return substitution.perform(self)
        except Exception as error:
            keep_span(error, getattr(substitution, "span", None))
            raise

    def _set_is_shutdown(self, state: bool) -> None:
        self.__is_shutdown = state

    def _set_asyncio_loop(self, loop: asyncio.AbstractEventLoop | None) -> None:
        self.__asyncio_loop = loop

    def _push_locals(self) -> None:
        self.__locals_stack.append(dict(self.__locals))

    def _pop_locals(self) -> None:
        self.__locals = _popped(self.__locals_stack, "locals")

    def _push_environment(self) -> None:
        self.__environment_stack.append(dict(os.environ))

    def _pop_environment(self) -> None:
        _restore_environment(_popped(self.__environment_stack, "environment"))

    def _reset_environment(self) -> None:
        _restore_environment(self.__environment_at_start)

    def _push_launch_configurations(self) -> None:
        self.__launch_configurations_stack.append(dict(self.__launch_configurations))

    def _pop_launch_configurations(self) -> None:
        stack = self.__launch_configurations_stack
        self.__launch_configurations = _popped(stack, "launch_configurations")


def _popped(stack: list[dict[str, Any]], name: str) -> dict[str, Any]:
    if not stack:
        raise RuntimeError(f"{name} stack unexpectedly empty")
    return stack.pop()


def _restore_environment(values: dict[str, str]) -> None:
    os.environ.clear()
    os.environ.update(values)
