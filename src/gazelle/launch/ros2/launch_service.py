"""Running launch descriptions."""

from __future__ import annotations

import asyncio
import collections.abc
import contextlib
import logging
import signal
import threading
import traceback
from collections.abc import Coroutine, Iterable, Iterator, Sequence
from typing import Any

from gazelle.diagnostics.share_links import as_written
from gazelle.launch.ros2 import logging as launch_logging
from gazelle.launch.ros2.error_diagnostics import diagnose
from gazelle.launch.ros2.event import Event
from gazelle.launch.ros2.event_handler import BaseEventHandler
from gazelle.launch.ros2.event_handlers import OnIncludeLaunchDescription, OnShutdown
from gazelle.launch.ros2.events import IncludeLaunchDescription, Shutdown
from gazelle.launch.ros2.launch_context import LaunchContext
from gazelle.launch.ros2.launch_description import LaunchDescription
from gazelle.launch.ros2.launch_description_entity import LaunchDescriptionEntity
from gazelle.launch.ros2.utilities import (
    AsyncSafeSignalManager,
    visit_all_entities_and_collect_futures,
)

__all__ = ["LaunchService"]

_own_loops = threading.local()


class LaunchService:
    """Visits launch descriptions and handles events until nothing is left to do.

    When it has run, no process that it started is left, and none outlives its own process,
    whatever ends that.

    Attributes:
        context: of the launch.
        event_loop: the loop it runs in, None when it does not run.
        task: the task it runs in, None when it does not run.
    """

    def __init__(
        self,
        *,
        argv: Iterable[str] | None = None,
        noninteractive: bool = False,
        debug: bool = False,
    ) -> None:
        launch_logging.launch_config.level = logging.DEBUG if debug else logging.INFO
        self.context = LaunchContext(argv=argv, noninteractive=noninteractive)
        self.context.register_event_handler(OnIncludeLaunchDescription())
        self.context.register_event_handler(OnShutdown(on_shutdown=self.__on_shutdown))
        self.event_loop: asyncio.AbstractEventLoop | None = None
        self.task: asyncio.Task[Any] | None = None
        self.__debug = debug
        self.__logger = launch_logging.get_logger("launch")
        self.__lock = threading.RLock()
        self.__pairs: list[tuple[LaunchDescriptionEntity, asyncio.Future[Any]]] = []
        self.__shutting_down = False
        self.__interrupts = 0

    def emit_event(self, event: Event) -> None:
        """Queue an event, from any thread."""
        with self.__lock:
            loop = self.event_loop
            if loop is None:
                self.context.emit_event_sync(event)
                return
            if _running_loop() is loop:
                self.context.emit_event_sync(event)
                return
            future = asyncio.run_coroutine_threadsafe(self.context.emit_event(event), loop)
        future.result()

    def include_launch_description(self, launch_description: LaunchDescription) -> None:
        """Let a description be visited, from any thread."""
        self.emit_event(IncludeLaunchDescription(launch_description))

    def run(self, *, shutdown_when_idle: bool = True) -> int:
        """Run to the end, and return 0, or 1 when something raised an error.

        Raises:
            RuntimeError: this is not the main thread.
        """
        loop = _own_loop()
        task = loop.create_task(self.run_async(shutdown_when_idle=shutdown_when_idle))
        while True:
            # Signals are handled in the loop.
            with contextlib.suppress(KeyboardInterrupt):
                return loop.run_until_complete(task)

    async def run_async(self, *, shutdown_when_idle: bool = True) -> int:
        """Run to the end within a loop that runs, see `run`.

        Raises:
            RuntimeError: this is not the main thread, or it runs already.
        """
        if threading.current_thread() is not threading.main_thread():
            raise RuntimeError("LaunchService can only be run in the main thread.")
        problems: list[Any] = []
        with self.__running(problems):
            launch_logging.log_launch_config(logger=self.__logger)
            while True:
                try:
                    if not await self.__advance(shutdown_when_idle):
                        break
                except KeyboardInterrupt:
                    continue
                except asyncio.CancelledError:
                    self.__logger.error("run task was canceled")
                    problems.append("canceled")
                    break
                except Exception as error:  # noqa: BLE001 - a launch file may raise anything
                    problems.append(error)
                    self.__tell(error)
        return 1 if problems else 0

    async def __advance(self, shutdown_when_idle: bool) -> bool:
        """Handle the next event, or await what takes time; False when all is done."""
        self.__raise_from(self.__take_done())
        is_idle = self.__is_idle()
        if is_idle and self.__shutting_down:
            return False
        if is_idle and shutdown_when_idle:
            self.__begin_shutdown("idle")
            return True
        if not self.context._event_queue.empty():
            self.__process_event(self.context._event_queue.get_nowait())
            # Everything else in the loop gets its turn between two events.
            await asyncio.sleep(0)
            return True
        waiting = asyncio.ensure_future(self.context._event_queue.get())
        futures = [future for _entity, future in self.__pairs]
        try:
            done, _ = await asyncio.wait(
                [waiting, *futures, *self.context._completion_futures],
                return_when=asyncio.FIRST_COMPLETED,
            )
            if waiting in done:
                self.__process_event(waiting.result())
        finally:
            if not waiting.done():
                waiting.cancel()
        return True

    def __take_done(self) -> list[asyncio.Future[Any]]:
        """Forget the futures that are done, and return them."""
        futures = [future for _entity, future in self.__pairs]
        done = [one for one in (*futures, *self.context._completion_futures) if one.done()]
        self.__pairs = [pair for pair in self.__pairs if not pair[1].done()]
        waited_for = self.context._completion_futures
        self.context._completion_futures = [one for one in waited_for if not one.done()]
        return done

    def __raise_from(self, done: Iterable[asyncio.Future[Any]]) -> None:
        """Raise the first error of what has ended, and log the others."""
        found = [future.exception() for future in done if not future.cancelled()]
        self.__raise_first([error for error in found if error is not None])

    def __raise_first(self, errors: Sequence[BaseException]) -> None:
        for error in errors[1:]:
            self.__logger.error(error)
        if errors:
            raise errors[0]

    def __is_idle(self) -> bool:
        return (
            not self.__pairs
            and not self.context._completion_futures
            and self.context._event_queue.empty()
        )

    def __process_event(self, event: Event) -> None:
        self.__logger.debug(f"processing event: '{event}'")
        errors: list[Exception] = []
        for handler in tuple(self.context._event_handlers):
            try:
                self.__let_handle(handler, event)
            except Exception as error:  # noqa: BLE001 - raised when the others have been told
                # A handler that fails must not keep processes from hearing of their end.
                errors.append(error)
        self.__raise_first(errors)

    def __let_handle(self, handler: BaseEventHandler, event: Event) -> None:
        if not handler.matches(event):
            return
        self.__logger.debug(f"processing event: '{event}' ✓ '{handler}'")
        self.context._push_locals()
        try:
            found: Any = handler.handle(event, self.context)
            entities = found if isinstance(found, collections.abc.Iterable) else [found]
            for entity in entities:
                self.__visit(entity)
        finally:
            self.context._pop_locals()

    def __visit(self, entity: Any) -> None:
        if entity is None:
            return
        if not isinstance(entity, LaunchDescriptionEntity):
            raise RuntimeError(
                f"expected a LaunchDescriptionEntity from event_handler, got '{entity}'"
            )
        visit_all_entities_and_collect_futures(entity, self.context, self.__pairs)

    def __tell(self, error: Exception) -> None:
        message = f"Caught exception in launch (see debug for traceback): {as_written(str(error))}"
        self.__logger.debug("".join(traceback.format_exception(error)))
        self.__logger.error(message)
        for diagnostic in diagnose(error):
            self.context.report(diagnostic)
        self.__begin_shutdown(message)

    @contextlib.contextmanager
    def __running(self, problems: list[Any]) -> Iterator[None]:
        loop = asyncio.get_running_loop()
        with self.__lock:
            if self.event_loop is not None:
                raise RuntimeError("LaunchService cannot be run multiple times concurrently.")
            self.event_loop = loop
            self.task = asyncio.current_task()
        self.context._set_asyncio_loop(loop)
        self.context._set_is_shutdown(False)
        self.__renew_queue()
        if self.__debug:
            loop.set_debug(True)

        def on_exception(loop: asyncio.AbstractEventLoop, what: dict[str, Any]) -> None:
            problems.append(what)
            loop.default_exception_handler(what)

        loop.set_exception_handler(on_exception)
        try:
            with AsyncSafeSignalManager(loop) as signals:
                signals.handle(signal.SIGINT, self.__on_sigint)
                signals.handle(signal.SIGTERM, self.__on_sigterm)
                signals.handle(signal.SIGQUIT, self.__on_sigterm)
                yield
        finally:
            loop.set_exception_handler(None)
            self.__end()

    def __end(self) -> None:
        """End what is left of the processes, and let it be run again."""
        if self.context.watched_groups is not None:
            self.context.watched_groups.close()
            self.context.watched_groups = None
        with self.__lock:
            self.event_loop = None
            self.task = None
            self.__shutting_down = False
            self.__interrupts = 0
        self.context._set_asyncio_loop(None)

    def __renew_queue(self) -> None:
        """Move what was queued before the run to a queue of this loop."""
        old, new = self.context._event_queue, asyncio.Queue[Event]()
        while not old.empty():
            new.put_nowait(old.get_nowait())
        self.context._event_queue = new

    def __on_sigint(self, _number: int) -> None:
        self.__interrupts += 1
        message = "user interrupted with ctrl-c (SIGINT)"
        if self.__interrupts > 1:
            self.__logger.warning(f"{message} again, ignoring...")
            return
        self.__logger.warning(message)
        self.__begin_shutdown("ctrl-c (SIGINT)", due_to_sigint=True)

    def __on_sigterm(self, number: int) -> None:
        """End in order, and at once when it comes again; ROS 2 leaves orphans at the first."""
        name = signal.Signals(number).name
        if not self.__shutting_down:
            self.__logger.error(f"user interrupted with ctrl-\\ ({name}), terminating...")
            self.__begin_shutdown(f"ctrl-\\ ({name})")
        elif self.task is not None:
            self.__logger.error(f"{name} again, ending all processes at once")
            self.task.cancel()

    def __on_shutdown(self, _event: Event, _context: LaunchContext) -> None:
        self.__shutting_down = True
        self.context._set_is_shutdown(True)

    def __begin_shutdown(self, reason: str, *, due_to_sigint: bool = False) -> None:
        if not self.__shutting_down:
            event = Shutdown(reason=reason, due_to_sigint=due_to_sigint)
            self.context.emit_event_sync(event)
        self.__shutting_down = True
        self.context._set_is_shutdown(True)

    def shutdown(self, force_sync: bool = False) -> Coroutine[Any, Any, None] | None:
        """End the launch, from any thread.

        Args:
            force_sync: return None within the loop too.

        Returns:
            Something to await when called within the loop, None elsewhere.
        """
        reason = "LaunchService.shutdown() called"
        with self.__lock:
            loop = self.event_loop
            if loop is None:
                return None
            if _running_loop() is loop:
                self.__begin_shutdown(reason)
                return None if force_sync else _nothing()
            loop.call_soon_threadsafe(self.__begin_shutdown, reason)
        return None


async def _nothing() -> None:
    """Be what a caller within the loop awaits."""


def _running_loop() -> asyncio.AbstractEventLoop | None:
    try:
        return asyncio.get_running_loop()
    except RuntimeError:
        return None


def _own_loop() -> asyncio.AbstractEventLoop:
    """Return this thread's loop, which stays for the next run."""
    loop: asyncio.AbstractEventLoop | None = getattr(_own_loops, "loop", None)
    if loop is None or loop.is_closed():
        loop = asyncio.new_event_loop()
        _own_loops.loop = loop
        asyncio.set_event_loop(loop)
    return loop
