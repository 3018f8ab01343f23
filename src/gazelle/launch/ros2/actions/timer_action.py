"""Timers: they count the wall's time; RosTimer counts a node's."""

from __future__ import annotations

import asyncio
import warnings
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from gazelle.launch.ros2.action import Action
from gazelle.launch.ros2.event import Event
from gazelle.launch.ros2.event_handler import EventHandler
from gazelle.launch.ros2.event_handlers import OnShutdown
from gazelle.launch.ros2.events import TimerEvent
from gazelle.launch.ros2.frontend import Entity, Parser, expose_action
from gazelle.launch.ros2.launch_description_entity import LaunchDescriptionEntity, SomeEntitiesType
from gazelle.launch.ros2.substitution import SomeSubstitutionsType, Substitution
from gazelle.launch.ros2.utilities import ensure_argument_type, is_a_subclass
from gazelle.launch.ros2.utilities.type_utils import (
    normalize_typed_substitution,
    perform_typed_substitution,
)

if TYPE_CHECKING:
    from gazelle.launch.ros2.launch_context import LaunchContext

__all__ = ["TimerAction"]


@expose_action("timer")
class TimerAction(Action):
    """Visits actions once, after a time, unless it is cancelled before.

    Attributes:
        period: seconds of wall time.
        actions: what is visited.
    """

    def __init__(
        self,
        *,
        period: float | SomeSubstitutionsType,
        actions: Iterable[LaunchDescriptionEntity],
        cancel_on_shutdown: bool | SomeSubstitutionsType = True,
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        allowed = (str, Substitution, Iterable, float)
        if isinstance(period, int):
            # Refused in ROS 2 too, which says less about it.
            raise TypeError(
                f"'TimerAction' expected 'period' to be a float, but got '{period}': "
                f"write {period}.0"
            )
        ensure_argument_type(period, allowed, "period", "TimerAction")
        ensure_argument_type(actions, (Iterable,), "actions", "TimerAction")
        if isinstance(period, str):
            warnings.warn(
                "The parameter 'period' must be a float or substitution, "
                "passing a string literal was deprecated",
                stacklevel=2,
            )
            period = float(period)
        self.period = normalize_typed_substitution(period, float)
        self.actions = actions
        self.__cancel_on_shutdown = normalize_typed_substitution(cancel_on_shutdown, bool)
        self.__locals: dict[str, Any] = {}
        self.__is_cancelled = False
        self._completed_future: asyncio.Future[Any] | None = None
        self._canceled_future: asyncio.Future[Any] | None = None

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[Any, dict[str, Any]]:
        """Return class and arguments of a ``<timer>``."""
        _, kwargs = super().parse(entity, parser)
        period = entity.get_attr("period", data_type=float, can_be_str=True)
        kwargs["period"] = parser.parse_if_substitutions(period)
        kwargs["actions"] = [parser.parse_action(child) for child in entity.children]
        cancel = entity.get_attr(
            "cancel_on_shutdown", optional=True, data_type=bool, can_be_str=True
        )
        if cancel is not None:
            kwargs["cancel_on_shutdown"] = parser.parse_if_substitutions(cancel)
        return cls, kwargs

    def describe(self) -> str:
        """Return a text for people."""
        return f"TimerAction(period={self.period}, actions=<actions>)"

    def describe_conditional_sub_entities(
        self,
    ) -> list[tuple[str, Iterable[LaunchDescriptionEntity]]]:
        """Return its actions."""
        return [(f"{self.period} seconds pass without being canceled", self.actions)]

    def handle(self, context: LaunchContext) -> SomeEntitiesType | None:
        """Return its actions, with the locals of the time it was started at."""
        context.extend_locals(self.__locals)
        return self.actions

    def cancel(self) -> None:
        """Cancel it: before it starts, while it runs, or to no effect afterwards."""
        self.__is_cancelled = True
        future = self._canceled_future
        if future is not None and not future.done():
            future.set_result(True)

    def execute(self, context: LaunchContext) -> None:
        """Start it."""
        self._completed_future = context.asyncio_loop.create_future()
        self._canceled_future = context.asyncio_loop.create_future()
        if self.__is_cancelled:
            self._completed_future.set_result(None)
            return
        _OnTimer.install(context)
        self.__locals = dict(context.get_locals_as_dict())
        period_s = perform_typed_substitution(context, self.period, float)
        context.asyncio_loop.create_task(self._wait_to_fire_event(context, period_s))
        if perform_typed_substitution(context, self.__cancel_on_shutdown, bool):
            context.register_event_handler(OnShutdown(on_shutdown=lambda *_: self.cancel()))

    async def _wait_to_fire_event(self, context: LaunchContext, period_s: float) -> None:
        assert self._canceled_future is not None
        assert self._completed_future is not None
        await asyncio.wait([self._canceled_future], timeout=period_s)
        if not self._canceled_future.done():
            await context.emit_event(TimerEvent(timer_action=self))
        self._completed_future.set_result(None)

    def get_asyncio_future(self) -> asyncio.Future[Any] | None:
        """Return what is done when its time is up or it is cancelled."""
        return self._completed_future


class _OnTimer(EventHandler):
    """Visits the actions of any timer whose time is up; once per context."""

    def __init__(self) -> None:
        super().__init__(matcher=lambda event: is_a_subclass(event, TimerEvent))

    @classmethod
    def install(cls, context: LaunchContext) -> None:
        if not any(isinstance(handler, cls) for handler in context._event_handlers):
            context.register_event_handler(cls())

    def handle(self, event: Event, context: LaunchContext) -> SomeEntitiesType | None:
        super().handle(event, context)
        assert isinstance(event, TimerEvent)
        found: SomeEntitiesType | None = event.timer_action.handle(context)
        return found
