"""States and transitions of a lifecycle node (https://design.ros2.org/articles/node_lifecycle.html).

Numbers and words are those of ``lifecycle_msgs``; the order is rcl_lifecycle's, as its services
list them.
"""

from __future__ import annotations

import enum
from collections.abc import Iterable
from typing import NamedTuple

__all__ = [
    "STATES",
    "TRANSITIONS",
    "LifecycleState",
    "StateMachine",
    "Transition",
    "TransitionCallbackReturn",
]


class TransitionCallbackReturn(enum.IntEnum):
    """What a node's callback says about a transition."""

    SUCCESS = 97
    FAILURE = 98
    ERROR = 99

    def __str__(self) -> str:
        return f"TransitionCallbackReturnType.{self.name}"

    def to_label(self) -> str:
        """Return the label of the transition that follows."""
        return f"transition_{self.name.lower()}"


class LifecycleState(NamedTuple):
    """A state, as callbacks get it."""

    label: str
    state_id: int


class Transition(NamedTuple):
    """A way from one state to another.

    Attributes:
        start, goal: numbers of the states.
    """

    id: int
    label: str
    start: int
    goal: int


_UNCONFIGURED, _INACTIVE, _ACTIVE, _FINALIZED = 1, 2, 3, 4
_CONFIGURING, _CLEANING, _SHUTTING, _ACTIVATING, _DEACTIVATING, _ERROR = 10, 11, 12, 13, 14, 15

STATES: dict[int, str] = {
    0: "unknown",
    _UNCONFIGURED: "unconfigured",
    _INACTIVE: "inactive",
    _ACTIVE: "active",
    _FINALIZED: "finalized",
    _CONFIGURING: "configuring",
    _CLEANING: "cleaningup",
    _SHUTTING: "shuttingdown",
    _ACTIVATING: "activating",
    _DEACTIVATING: "deactivating",
    _ERROR: "errorprocessing",
}


def _outcomes(
    first_id: int, during: int, success: int, failure: int, error: int
) -> list[Transition]:
    goals = (("success", success), ("failure", failure), ("error", error))
    return [
        Transition(first_id + index, f"transition_{outcome}", during, goal)
        for index, (outcome, goal) in enumerate(goals)
    ]


TRANSITIONS: tuple[Transition, ...] = (
    Transition(1, "configure", _UNCONFIGURED, _CONFIGURING),
    *_outcomes(10, _CONFIGURING, _INACTIVE, _UNCONFIGURED, _ERROR),
    Transition(2, "cleanup", _INACTIVE, _CLEANING),
    *_outcomes(20, _CLEANING, _UNCONFIGURED, _INACTIVE, _ERROR),
    Transition(3, "activate", _INACTIVE, _ACTIVATING),
    *_outcomes(30, _ACTIVATING, _ACTIVE, _INACTIVE, _ERROR),
    Transition(4, "deactivate", _ACTIVE, _DEACTIVATING),
    *_outcomes(40, _DEACTIVATING, _INACTIVE, _ACTIVE, _ERROR),
    Transition(5, "shutdown", _UNCONFIGURED, _SHUTTING),
    Transition(6, "shutdown", _INACTIVE, _SHUTTING),
    Transition(7, "shutdown", _ACTIVE, _SHUTTING),
    *_outcomes(50, _SHUTTING, _FINALIZED, _FINALIZED, _ERROR),
    *_outcomes(60, _ERROR, _UNCONFIGURED, _FINALIZED, _FINALIZED),
)


class StateMachine:
    """The present state, ``unconfigured`` at first."""

    def __init__(self) -> None:
        self.state = self._state(_UNCONFIGURED)

    def available(self) -> list[Transition]:
        """Return the transitions that start here."""
        return [one for one in TRANSITIONS if one.start == self.state.state_id]

    def find(self, transition: int | str) -> Transition | None:
        """Return the transition of a number or label that starts here, or None."""
        return _first(one for one in self.available() if transition in (one.id, one.label))

    def go(self, transition: Transition) -> None:
        """Take a transition."""
        self.state = self._state(transition.goal)

    @staticmethod
    def _state(state_id: int) -> LifecycleState:
        return LifecycleState(STATES[state_id], state_id)


def _first(items: Iterable[Transition]) -> Transition | None:
    return next(iter(items), None)
