from __future__ import annotations

import itertools

import pytest

from gazelle.graph.actions import ActionlibStatus, GoalEvent, Ros2Status
from gazelle.graph.actions.goal import next_status, state_error
from gazelle.interfaces import message_type

# Rows: from, then what each event leads to; a dot where it cannot happen.
EVENTS = ("ACCEPT", "EXECUTE", "REJECT", "REQUEST_CANCEL", "CANCEL", "SUCCEED", "ABORT")
ACTIONLIB = """
PENDING    ACTIVE     . REJECTED RECALLING  RECALLED  .         .
RECALLING  PREEMPTING . REJECTED .          RECALLED  .         .
ACTIVE     .          . .        PREEMPTING PREEMPTED SUCCEEDED ABORTED
PREEMPTING .          . .        .          PREEMPTED SUCCEEDED ABORTED
PREEMPTED  .          . .        .          .         .         .
SUCCEEDED  .          . .        .          .         .         .
ABORTED    .          . .        .          .         .         .
REJECTED   .          . .        .          .         .         .
RECALLED   .          . .        .          .         .         .
LOST       .          . .        .          .         .         .
"""
ROS2 = """
UNKNOWN    ACCEPTED   .         REJECTED .         .        .         .
ACCEPTED   .          EXECUTING .        CANCELING .        .         .
EXECUTING  .          .         .        CANCELING .        SUCCEEDED ABORTED
CANCELING  .          .         .        .         CANCELED SUCCEEDED ABORTED
REJECTED   .          .         .        .         .        .         .
SUCCEEDED  .          .         .        .         .        .         .
CANCELED   .          .         .        .         .        .         .
ABORTED    .          .         .        .         .        .         .
"""


def _rows(table: str) -> dict[str, list[str]]:
    words = (line.split() for line in table.strip().splitlines())
    return {first: rest for first, *rest in words}


@pytest.mark.parametrize(("kind", "table"), [(ActionlibStatus, ACTIONLIB), (Ros2Status, ROS2)])
def test_every_event_in_every_state_leads_where_ros_says(kind: type, table: str) -> None:
    rows = _rows(table)
    assert set(rows) == set(kind.__members__)
    for status, (place, event) in itertools.product(kind, enumerate(EVENTS)):
        wanted = rows[status.name][place]
        found = next_status(status, GoalEvent[event])
        assert (found.name if found else ".") == wanted, (status, event)


@pytest.mark.parametrize("kind", [ActionlibStatus, Ros2Status])
def test_a_state_is_terminal_exactly_when_no_event_leads_out_of_it(kind: type) -> None:
    for status in kind:
        leads_on = any(next_status(status, event) for event in GoalEvent)
        assert status.is_terminal == (not leads_on)


def test_numbers_are_those_of_the_messages() -> None:
    actionlib = message_type("actionlib_msgs/GoalStatus")
    ros2 = message_type("action_msgs/msg/GoalStatus")
    for status in ActionlibStatus:
        assert getattr(actionlib, status.name) == status
    for status in Ros2Status:
        if status is not Ros2Status.REJECTED:
            assert getattr(ros2, f"STATUS_{status.name}") == status


def test_error_says_what_cannot_happen_and_why() -> None:
    text = str(state_error("g-1", ActionlibStatus.PENDING, GoalEvent.SUCCEED))
    assert text == (
        "goal g-1 is PENDING: the server cannot succeed it now\n"
        "  ROS says: To transition to a succeeded state, the goal must be in an active or "
        "preempting state, it is currently in state: 0"
    )
