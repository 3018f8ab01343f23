"""launch_ros.actions.ros_timer: a timer by the clock of ROS."""

from __future__ import annotations

import asyncio
import threading
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from gazelle.graph import TimeJumpError
from gazelle.launch.ros2.actions import TimerAction
from gazelle.launch.ros2.events import TimerEvent
from gazelle.launch.ros2.frontend import expose_action
from gazelle.launch.ros2.launch_description_entity import LaunchDescriptionEntity
from gazelle.launch.ros2.launch_ros.launch_graph import launch_node
from gazelle.launch.ros2.substitution import SomeSubstitutionsType

if TYPE_CHECKING:
    from gazelle.launch.ros2.launch_context import LaunchContext

__all__ = ["ROSTimer"]


@expose_action("ros_timer")
class ROSTimer(TimerAction):
    """Visits actions after a time of ROS's clock: `SetUseSimTime` makes that simulated time."""

    def __init__(
        self,
        *,
        period: float | SomeSubstitutionsType,
        actions: Iterable[LaunchDescriptionEntity],
        **kwargs: Any,
    ) -> None:
        super().__init__(period=period, actions=actions, **kwargs)

    def describe(self) -> str:
        """Return a text for people."""
        return f"ROSTimer(period={self.period}, actions=<actions>)"

    async def _wait_to_fire_event(self, context: LaunchContext, period_s: float) -> None:
        canceled, completed = self._canceled_future, self._completed_future
        assert canceled is not None
        assert completed is not None
        loop, due = asyncio.get_running_loop(), asyncio.get_running_loop().create_future()

        def finish() -> None:
            if not due.done():
                due.set_result(None)

        def wait() -> None:
            if _sleep(context, period_s):
                loop.call_soon_threadsafe(finish)

        threading.Thread(target=wait, daemon=True).start()
        await asyncio.wait([canceled, due], return_when=asyncio.FIRST_COMPLETED)
        if not canceled.done():
            await context.emit_event(TimerEvent(timer_action=self))
        completed.set_result(None)


def _sleep(context: LaunchContext, period_s: float) -> bool:
    """Sleep by the launch's clock; False when the graph ends first."""
    clock = launch_node(context).clock
    end_ns = clock.now_ns() + int(period_s * 1e9)
    while True:
        try:
            return bool(clock.sleep_until(end_ns))
        except TimeJumpError:
            # Time went back: a timer of ROS waits its period from there.
            end_ns = clock.now_ns() + int(period_s * 1e9)
