"""Running a process: start, output, respawn, and its end by SIGINT, SIGTERM, SIGKILL."""

from __future__ import annotations

import asyncio
import os
import signal
from typing import TYPE_CHECKING, Any

from gazelle.launch.node_process import StoppedProcess
from gazelle.launch.ros2 import logging as launch_logging
from gazelle.launch.ros2.action import Action
from gazelle.launch.ros2.actions.event_actions import EmitEvent
from gazelle.launch.ros2.actions.opaque_function import OpaqueFunction
from gazelle.launch.ros2.actions.timer_action import TimerAction
from gazelle.launch.ros2.child_process import ChildProcess, OutputLines, start_child
from gazelle.launch.ros2.conditions import evaluate_condition_expression
from gazelle.launch.ros2.descriptions import Executable
from gazelle.launch.ros2.error_diagnostics import not_started
from gazelle.launch.ros2.event_handler import BaseEventHandler, EventHandler
from gazelle.launch.ros2.event_handlers import (
    OnProcessExit,
    OnProcessIO,
    OnProcessStart,
    OnShutdown,
)
from gazelle.launch.ros2.events import Shutdown, matches_action
from gazelle.launch.ros2.events.process import (
    ProcessExited,
    ProcessIO,
    ProcessStarted,
    ProcessStderr,
    ProcessStdin,
    ProcessStdout,
    ShutdownProcess,
    SignalProcess,
)
from gazelle.launch.ros2.launch_description_entity import LaunchDescriptionEntity
from gazelle.launch.ros2.substitution import SomeSubstitutionsType
from gazelle.launch.ros2.substitutions import LaunchConfiguration
from gazelle.launch.ros2.utilities import (
    is_a_subclass,
    normalize_to_list_of_substitutions,
    perform_substitutions,
)
from gazelle.launch.ros2.utilities.type_utils import (
    normalize_typed_substitution,
    perform_typed_substitution,
)

if TYPE_CHECKING:
    from gazelle.launch.ros2.launch_context import LaunchContext

__all__ = ["ExecuteLocal", "ProcessEnding"]

_SIGTERM_TIMEOUT = LaunchConfiguration("sigterm_timeout", default=5)
_SIGKILL_TIMEOUT = LaunchConfiguration("sigkill_timeout", default=5)
_EVENTS = {1: ProcessStdout, 2: ProcessStderr}
_LOOK_S = 1.0


class ProcessEnding:
    """Ends one process when it is asked to, or when the launch ends.

    Attributes:
        began: is done as soon as the process is to end; it is not respawned then.
    """

    def __init__(self, action: ExecuteLocal, context: LaunchContext) -> None:
        self.began: asyncio.Future[None] = context.asyncio_loop.create_future()
        self._action = action
        self._context = context
        self._timers: list[TimerAction] = []
        self._is_awaiting_start = False

    def handlers(self) -> list[BaseEventHandler]:
        """Return the handlers of the events that ask for an end or send a signal."""
        return [
            EventHandler(
                matcher=lambda event: is_a_subclass(event, ShutdownProcess),
                entities=OpaqueFunction(function=self._on_shutdown_process),
            ),
            EventHandler(
                matcher=lambda event: is_a_subclass(event, SignalProcess),
                entities=OpaqueFunction(function=self._on_signal),
            ),
        ]

    def on_launch_shutdown(self, event: Shutdown, context: LaunchContext) -> list[Action] | None:
        """Begin the end with that of the launch.

        Ctrl-C reaches what runs in a terminal at once and says nothing; processes of ours are not
        in the launcher's terminal, so they get it from here.
        """
        quietly = event.due_to_sigint and not context.noninteractive
        return self._begin(context, quietly=quietly)

    def cancel(self) -> None:
        """Stop the timers of the stronger signals: the process has ended."""
        for timer in self._timers:
            timer.cancel()

    def _on_shutdown_process(self, context: LaunchContext) -> list[Action] | None:
        event = context.locals.event
        return self._begin(context) if event.process_matcher(self._action) else None

    def _begin(self, context: LaunchContext, *, quietly: bool = False) -> list[Action] | None:
        completed = self._action.get_asyncio_future()
        if self.began.done() or completed is None or completed.done():
            return None
        if "pid" not in (self._action.process_details or {}):
            self._begin_after_start(context)
            return None
        self.began.set_result(None)
        if quietly:
            self._action.send_signal(signal.SIGINT, whole_group=True)
            return self._stronger_signals()
        return [self._signal_action(signal.SIGINT), *self._stronger_signals()]

    def _begin_after_start(self, context: LaunchContext) -> None:
        if self._is_awaiting_start:
            return
        self._is_awaiting_start = True
        context.register_event_handler(
            OnProcessStart(
                target_action=self._action,
                on_start=lambda _event, context: self._begin(context),
                handle_once=True,
            )
        )

    def _stronger_signals(self) -> list[Action]:
        context, action = self._context, self._action
        sigterm = perform_substitutions(context, action.sigterm_timeout)
        sigkill = perform_substitutions(context, action.sigkill_timeout)
        total_s = float(sigterm) + float(sigkill)
        self._timers = [
            self._timer(float(sigterm), sigterm, signal.SIGINT, signal.SIGTERM),
            self._timer(total_s, str(total_s), signal.SIGTERM, signal.SIGKILL),
        ]
        return [*self._timers]

    def _timer(
        self, period_s: float, text: str, sent: signal.Signals, next_signal: signal.Signals
    ) -> TimerAction:
        def report(_context: LaunchContext) -> None:
            name = self._name()
            launch_logging.get_logger(name).error(
                f"process[{name}] failed to terminate '{text}' seconds after receiving "
                f"'{sent.name}', escalating to '{next_signal.name}'"
            )

        return TimerAction(
            period=period_s,
            actions=[OpaqueFunction(function=report), self._signal_action(next_signal)],
            cancel_on_shutdown=False,
        )

    def _signal_action(self, number: signal.Signals) -> Action:
        matcher = matches_action(self._action)
        return EmitEvent(event=_EndSignal(signal_number=number, process_matcher=matcher))

    def _on_signal(self, context: LaunchContext) -> None:
        event: Any = context.locals.event
        if not event.process_matcher(self._action):
            return
        if "pid" not in (self._action.process_details or {}):
            raise RuntimeError("Signal event received before subprocess transport available.")
        name = self._name()
        logger = launch_logging.get_logger(name)
        number = signal.Signals[event.signal_name]
        if self._action.send_signal(number, whole_group=isinstance(event, _EndSignal)):
            logger.info(f"sending signal '{event.signal_name}' to process[{name}]")
        else:
            logger.debug(f"signal '{event.signal_name}' not sent to '{name}': it has ended already")

    def _name(self) -> str:
        return str(self._action.process_description.final_name)


class ExecuteLocal(Action):
    """Runs a process on this machine.

    It ends with SIGINT, ``sigterm_timeout`` seconds later with SIGTERM, and ``sigkill_timeout``
    seconds after that with SIGKILL. Signals at the end of the launch go to what it has started
    too, as those of a terminal do.

    Attributes:
        process_description: what is run.
        shell: by a shell.
        emulate_tty: with terminals for output; the configuration ``emulate_tty`` wins.
        sigterm_timeout: seconds, see above.
        sigkill_timeout: seconds, see above.
        output: where its output goes, see `launch.logging.get_output_loggers`.
        process_details: name, cmd, cwd, env and pid; None before it is prepared.
    """

    def __init__(  # noqa: PLR0913 - the signature of launch
        self,
        *,
        process_description: Executable,
        shell: bool = False,
        sigterm_timeout: SomeSubstitutionsType = _SIGTERM_TIMEOUT,
        sigkill_timeout: SomeSubstitutionsType = _SIGKILL_TIMEOUT,
        emulate_tty: bool = False,
        output: SomeSubstitutionsType | dict[str, Any] = "log",
        output_format: str = "[{this.process_description.final_name}] {line}",
        cached_output: bool = False,
        log_cmd: bool = False,
        on_exit: Any = None,
        respawn: bool | SomeSubstitutionsType = False,
        respawn_delay: float | None = None,
        respawn_max_retries: int = -1,
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        self.process_description = process_description
        self.shell = shell
        self.emulate_tty = emulate_tty
        self.sigterm_timeout = normalize_to_list_of_substitutions(sigterm_timeout)
        self.sigkill_timeout = normalize_to_list_of_substitutions(sigkill_timeout)
        chosen: Any = os.environ.get("OVERRIDE_LAUNCH_PROCESS_OUTPUT", output)
        is_dict = isinstance(chosen, dict)
        self.output: Any = chosen if is_dict else normalize_to_list_of_substitutions(chosen)
        self.process_details: dict[str, Any] | None = None
        self.__output_format = output_format
        self.__is_cached = cached_output
        self.__log_cmd = log_cmd
        self.__on_exit = on_exit
        self.__respawn = normalize_typed_substitution(respawn, bool)
        self.__respawn_delay_s = respawn_delay or 0.0
        self.__retries_left = respawn_max_retries
        self.__was_executed = False
        self.__lines: dict[int, OutputLines] = {}
        self.__ending: ProcessEnding | None = None
        self.__completed: asyncio.Future[Any] | None = None
        self.__child: ChildProcess | None = None

    def get_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """Return the actions of ``on_exit``."""
        return self.__on_exit if isinstance(self.__on_exit, list) else []

    def prepare(self, context: LaunchContext) -> None:
        """Find out everything that depends on the running launch."""
        what = self.process_description
        what.prepare(context, self)
        self.process_details = {
            "action": self,
            "name": what.final_name,
            "cmd": what.final_cmd,
            "cwd": what.final_cwd,
            "env": what.final_env,
        }
        self.__respawn = perform_typed_substitution(context, self.__respawn, bool)

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity] | None:
        """Begin to start it.

        Raises:
            RuntimeError: it has been executed already.
        """
        self.prepare(context)
        name = str(self.process_description.final_name)
        if self.__was_executed:
            raise RuntimeError(
                f"ExecuteLocal action '{name}': executed more than once: {self.describe()}"
            )
        self.__was_executed = True
        if context.is_shutdown:
            # What is visited while the launch ends does not begin any more.
            return None
        self.__open_output(context, name)
        self.__completed = context.asyncio_loop.create_future()
        self.__ending = ProcessEnding(self, context)
        self.__register_handlers(context)
        context.asyncio_loop.create_task(self.__run(context))
        return None

    def __open_output(self, context: LaunchContext, name: str) -> None:
        output = self.output
        if not isinstance(output, dict):
            output = perform_substitutions(context, output)
        for fd, logger in enumerate(launch_logging.get_output_loggers(name, output), start=1):
            self.__lines[fd] = OutputLines(logger, self.__format, is_cached=self.__is_cached)

    def __format(self, line: str) -> str:
        return self.__output_format.format(line=line, this=self)

    def __register_handlers(self, context: LaunchContext) -> None:
        assert self.__ending is not None
        handlers: list[Any] = [*self.__ending.handlers()]
        handlers.append(
            OnProcessIO(
                target_action=self,
                on_stdin=self.__on_stdin,
                on_stdout=self.__on_output,
                on_stderr=self.__on_output,
            )
        )
        handlers.append(OnShutdown(on_shutdown=self.__ending.on_launch_shutdown))
        if self.__on_exit is not None:
            handlers.append(OnProcessExit(target_action=self, on_exit=self.__on_exit))
        handlers.append(OnProcessExit(target_action=self, on_exit=self.__on_end))
        for handler in handlers:
            context.register_event_handler(handler)

    def __on_stdin(self, event: ProcessStdin) -> None:
        if self.__child is not None:
            self.__child.write(event.text)

    def __on_output(self, event: ProcessIO) -> None:
        self.__lines[event.fd].add(event.text)

    def __on_end(self, event: ProcessExited, _context: LaunchContext) -> None:
        """Log what it wrote last, then that it has ended."""
        for lines in self.__lines.values():
            lines.end()
        logger = launch_logging.get_logger(event.process_name)
        if event.returncode == 0:
            logger.info(f"process has finished cleanly [pid {event.pid}]")
            return
        words = " ".join(word for word in event.cmd if word.strip())
        logger.error(
            f"process has died [pid {event.pid}, exit code {event.returncode}, cmd '{words}']."
        )

    async def __run(self, context: LaunchContext) -> None:
        """Start the process, await its end, and so on while it is to be respawned."""
        assert self.__ending is not None
        assert self.__completed is not None
        try:
            assert self.process_details is not None
            if not await self._may_start(context, self.process_details):
                return
            while await self.__run_once(context):
                if not await self.__may_respawn(context):
                    break
        finally:
            self.__ending.cancel()
            self.__completed.set_result(None)

    async def _may_start(self, context: LaunchContext, details: dict[str, Any]) -> bool:
        """Wait for what has to be there before it; False when it is not to start any more.

        Args:
            context: of the launch.
            details: of the process; its command may change.
        """
        return await context.cpp_builds.finished()

    async def __run_once(self, context: LaunchContext) -> bool:
        """Run the process to its end; False when it cannot be started."""
        details = self.process_details
        assert details is not None
        logger = launch_logging.get_logger(details["name"])
        if self.__log_cmd:
            words = " ".join(word for word in details["cmd"] if word.strip())
            own = details["env"] is not None
            logger.info(
                f"process details: cmd='{words}', cwd='{details['cwd']}', custom_env?={own}"
            )
        try:
            child = await self.__start(context, details)
        except (OSError, ValueError) as error:
            logger.error(f"exception occurred while executing process: {error}")
            context.report(not_started(error, details["cmd"], details["cwd"], self.span))
            return False
        code = await _end_of(child, logger)
        await context.emit_event(ProcessExited(returncode=code, **details))
        child.close()
        if context.watched_groups is not None:
            context.watched_groups.ended(child.pid)
        return True

    async def __start(self, context: LaunchContext, details: dict[str, Any]) -> ChildProcess:
        def on_start(child: ChildProcess) -> None:
            context.watch(child.pid)
            self.__child = child
            details["pid"] = child.pid
            logger = launch_logging.get_logger(details["name"])
            logger.info(f"process started with pid [{child.pid}]")
            context.emit_event_sync(ProcessStarted(**details))

        def on_output(fd: int, data: bytes) -> None:
            context.emit_event_sync(_EVENTS[fd](text=data, **details))

        return await start_child(
            on_start,
            on_output,
            cmd=details["cmd"],
            cwd=details["cwd"],
            env=details["env"],
            shell=self.shell,
            emulate_tty=self.__has_terminal(context),
        )

    def __has_terminal(self, context: LaunchContext) -> bool:
        chosen = context.launch_configurations.get("emulate_tty")
        if chosen is None:
            return self.emulate_tty
        return evaluate_condition_expression(context, normalize_to_list_of_substitutions(chosen))

    async def __may_respawn(self, context: LaunchContext) -> bool:
        """Return whether it is to be started again, after the delay for that."""
        ending = self.__ending
        assert ending is not None
        if not self.__respawn or self.__retries_left == 0 or context.is_shutdown:
            return False
        self.__retries_left -= 1
        if self.__respawn_delay_s > 0.0 and not ending.began.done():
            await asyncio.wait([ending.began], timeout=self.__respawn_delay_s)
        return not ending.began.done()

    def send_signal(self, number: signal.Signals, *, whole_group: bool = False) -> bool:
        """Send the process a signal; False when there is nothing to get it any more.

        Args:
            number: of the signal.
            whole_group: what it has started gets it too.
        """
        child = self.__child
        if child is None or child.complete.done():
            return False
        try:
            child.send_signal(number, whole_group=whole_group)
        except ProcessLookupError:
            return False
        return True

    def get_asyncio_future(self) -> asyncio.Future[Any] | None:
        """Return what is done when it has ended for good."""
        return self.__completed

    def get_stdout(self) -> str:
        """Return everything it wrote to standard output.

        Raises:
            RuntimeError: ``cached_output`` is not set.
        """
        return self.__cached(1)

    def get_stderr(self) -> str:
        """Return everything it wrote to standard error.

        Raises:
            RuntimeError: ``cached_output`` is not set.
        """
        return self.__cached(2)

    def __cached(self, fd: int) -> str:
        if not self.__is_cached:
            name = self.process_description.final_name or self.process_description.cmd
            what = "stdout" if fd == 1 else "stderr"
            raise RuntimeError(
                f"cached output must be true to be able to get {what}, proc '{name}'"
            )
        return self.__lines[fd].text() if self.__lines else ""

    @property
    def return_code(self) -> int | None:
        """Its exit code, None while it runs and before."""
        child = self.__child
        if child is None or not child.complete.done():
            return None
        return child.complete.result()


class _EndSignal(SignalProcess):
    """A signal of the launch itself: it goes to what the process has started too."""


async def _end_of(child: ChildProcess, logger: Any) -> int:
    """Return a process's exit code; say when it is stopped meanwhile, and when it goes on."""
    stopped = StoppedProcess(child.pid)
    while not child.complete.done():
        await asyncio.wait({child.complete}, timeout=_LOOK_S)
        if news := stopped.news():
            logger.warning(news)
    return child.complete.result()
