"""What controllers need of the outside world; the simulator offers it, tests do without."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

__all__ = [
    "GoalPort",
    "LiveParameter",
    "LivePort",
    "Ports",
    "PublisherPort",
]


class PublisherPort(Protocol):
    """Sends messages of one type on one topic."""

    @property
    def matched(self) -> bool:
        """True when somebody subscribes; cheap enough to ask at every tick."""
        ...

    def publish(self, message: Any) -> None:
        """Send one message."""
        ...


class GoalPort(Protocol):
    """One goal of an action, of actionlib or ROS 2, as the controller sees it.

    A goal is new until `accept` or `reject`; it ends with one of `succeed`, `abort`, `cancel`.
    """

    @property
    def goal_id(self) -> str:
        """Unique name of the goal."""
        ...

    @property
    def request(self) -> Any:
        """The goal message."""
        ...

    @property
    def is_active(self) -> bool:
        """True from `accept` to the end."""
        ...

    @property
    def is_cancel_requested(self) -> bool:
        """True once a client asked to cancel and the server agreed."""
        ...

    @property
    def is_feedback_wanted(self) -> bool:
        """True when somebody would get feedback; cheap enough to ask at every tick."""
        ...

    def accept(self) -> None:
        """Take the goal; it is being executed from now on."""
        ...

    def reject(self, result: Any = None, text: str = "") -> None:
        """Do not take the goal."""
        ...

    def publish_feedback(self, feedback: Any) -> None:
        """Tell how it goes."""
        ...

    def succeed(self, result: Any = None, text: str = "") -> None:
        """End it well."""
        ...

    def abort(self, result: Any = None, text: str = "") -> None:
        """End it because it cannot be reached or was replaced."""
        ...

    def cancel(self, result: Any = None, text: str = "") -> None:
        """End it because a client wanted so."""
        ...


@dataclass(frozen=True, slots=True)
class LiveParameter:
    """A parameter that can be changed while a controller runs.

    Attributes:
        name: relative to its group, such as ``p``.
        kind: ``bool``, ``int``, ``double`` or ``str``, as dynamic_reconfigure calls them.
        value: at the start.
        description: one line.
        lowest, highest: limits, None for none.
    """

    name: str
    kind: str
    value: bool | int | float | str
    description: str = ""
    lowest: float | None = None
    highest: float | None = None


class LivePort(Protocol):
    """A group of live parameters that others can see and change."""

    def update(self, values: Mapping[str, Any]) -> None:
        """Tell others values that changed by themselves."""
        ...


class Ports(Protocol):
    """Topics, services, actions and parameters of one controller.

    Names: ``~/command`` is the controller's own (``/mira/roll_controller/command``),
    ``joint_states`` lies in the namespace of the controller manager (``/mira/joint_states``),
    ``/tf`` is global. All callbacks run in the thread of the control loop, between two steps.
    """

    def publisher(
        self, topic: str, type_name: str, *, latch: bool = False, reliable: bool = True
    ) -> PublisherPort:
        """Offer a topic; `type_name` as ``sensor_msgs/JointState``."""
        ...

    def subscription(
        self, topic: str, type_name: str | Sequence[str], callback: Callable[[Any], None]
    ) -> None:
        """Listen; of several types all are taken, and the first one is announced."""
        ...

    def service(self, name: str, type_name: str, handler: Callable[[Any, Any], None]) -> None:
        """Answer a service: `handler(request, response)` fills the response."""
        ...

    def action_server(
        self,
        name: str,
        type_name: str,
        *,
        on_goal: Callable[[GoalPort], None],
        on_cancel: Callable[[GoalPort], bool],
    ) -> None:
        """Offer an action; `on_cancel` tells whether it agrees, and ends the goal itself."""
        ...

    def live_parameters(
        self,
        group: str,
        parameters: Sequence[LiveParameter],
        on_change: Callable[[dict[str, Any]], None],
    ) -> LivePort:
        """Let others change parameters while the controller runs.

        ROS 1: a dynamic_reconfigure server at ``<controller>/<group>``. ROS 2: parameters
        ``<group>.<name>`` of the controller's node. `on_change` gets the new values of all.
        """
        ...

    def log(self, level: str, text: str) -> None:
        """Say something on the console and on ``/rosout``."""
        ...
