"""The end of a process: SIGINT, SIGTERM, SIGKILL."""

from __future__ import annotations

import asyncio
import signal
from typing import TYPE_CHECKING, Any

from gazelle.launch.ros2 import logging as launch_logging
from gazelle.launch.ros2.action import Action
from gazelle.launch.ros2.actions.event_actions import EmitEvent
from gazelle.launch.ros2.actions.opaque_function import OpaqueFunction
from gazelle.launch.ros2.actions.timer_action import TimerAction
from gazelle.launch.ros2.event_handler import BaseEventHandler, EventHandler
from gazelle.launch.ros2.event_handlers import OnProcessStart
from gazelle.launch.ros2.events import Shutdown, matches_action
from gazelle.launch.ros2.events.process import ShutdownProcess, SignalProcess
from gazelle.launch.ros2.utilities import is_a_subclass, perform_substitutions

if TYPE_CHECKING:
    from gazelle.launch.ros2.actions.execute_local import ExecuteLocal
    from gazelle.launch.ros2.launch_context import LaunchContext

__all__ = ["ProcessEnding"]


class _EndSignal(SignalProcess):
    """A signal of the launch itself: it goes to what the process has started too."""


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
        def tell(_context: LaunchContext) -> None:
            name = self._name()
            launch_logging.get_logger(name).error(
                f"process[{name}] failed to terminate '{text}' seconds after receiving "
                f"'{sent.name}', escalating to '{next_signal.name}'"
            )

        return TimerAction(
            period=period_s,
            actions=[OpaqueFunction(function=tell), self._signal_action(next_signal)],
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
