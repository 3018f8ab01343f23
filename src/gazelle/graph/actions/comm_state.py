"""actionlib's state machine of a goal at the client.

Source: http://wiki.ros.org/actionlib/DetailedDescription, "Client State Machine".
"""

from __future__ import annotations

import enum
from collections.abc import Mapping

from gazelle.graph.actions.goal import ActionlibStatus

__all__ = ["TRANSITIONS", "CommState", "steps"]


class CommState(enum.IntEnum):
    """How far the talk with the server about one goal has come."""

    WAITING_FOR_GOAL_ACK = 0
    PENDING = 1
    ACTIVE = 2
    WAITING_FOR_RESULT = 3
    WAITING_FOR_CANCEL_ACK = 4
    RECALLING = 5
    PREEMPTING = 6
    DONE = 7
    LOST = 8


_S, _C = ActionlibStatus, CommState
_ENDS = (_S.REJECTED, _S.RECALLED, _S.PREEMPTED, _S.SUCCEEDED, _S.ABORTED)
_RESULT = (_C.WAITING_FOR_RESULT,)
_STAY: tuple[CommState, ...] = ()

TRANSITIONS: Mapping[CommState, Mapping[ActionlibStatus, tuple[CommState, ...]]] = {
    _C.WAITING_FOR_GOAL_ACK: {
        _S.PENDING: (_C.PENDING,),
        _S.ACTIVE: (_C.ACTIVE,),
        _S.REJECTED: (_C.PENDING, *_RESULT),
        _S.RECALLING: (_C.PENDING, _C.RECALLING),
        _S.RECALLED: (_C.PENDING, *_RESULT),
        _S.PREEMPTED: (_C.ACTIVE, _C.PREEMPTING, *_RESULT),
        _S.SUCCEEDED: (_C.ACTIVE, *_RESULT),
        _S.ABORTED: (_C.ACTIVE, *_RESULT),
        _S.PREEMPTING: (_C.ACTIVE, _C.PREEMPTING),
    },
    _C.PENDING: {
        _S.PENDING: _STAY,
        _S.ACTIVE: (_C.ACTIVE,),
        _S.REJECTED: _RESULT,
        _S.RECALLING: (_C.RECALLING,),
        _S.RECALLED: (_C.RECALLING, *_RESULT),
        _S.PREEMPTED: (_C.ACTIVE, _C.PREEMPTING, *_RESULT),
        _S.SUCCEEDED: (_C.ACTIVE, *_RESULT),
        _S.ABORTED: (_C.ACTIVE, *_RESULT),
        _S.PREEMPTING: (_C.ACTIVE, _C.PREEMPTING),
    },
    _C.ACTIVE: {
        _S.ACTIVE: _STAY,
        _S.PREEMPTED: (_C.PREEMPTING, *_RESULT),
        _S.SUCCEEDED: _RESULT,
        _S.ABORTED: _RESULT,
        _S.PREEMPTING: (_C.PREEMPTING,),
    },
    _C.WAITING_FOR_RESULT: dict.fromkeys((_S.ACTIVE, *_ENDS), _STAY),
    _C.WAITING_FOR_CANCEL_ACK: {
        _S.PENDING: _STAY,
        _S.ACTIVE: _STAY,
        _S.REJECTED: _RESULT,
        _S.RECALLING: (_C.RECALLING,),
        _S.RECALLED: (_C.RECALLING, *_RESULT),
        _S.PREEMPTED: (_C.PREEMPTING, *_RESULT),
        _S.SUCCEEDED: (_C.PREEMPTING, *_RESULT),
        _S.ABORTED: (_C.PREEMPTING, *_RESULT),
        _S.PREEMPTING: (_C.PREEMPTING,),
    },
    _C.RECALLING: {
        _S.REJECTED: _RESULT,
        _S.RECALLING: _STAY,
        _S.RECALLED: _RESULT,
        _S.PREEMPTED: (_C.PREEMPTING, *_RESULT),
        _S.SUCCEEDED: (_C.PREEMPTING, *_RESULT),
        _S.ABORTED: (_C.PREEMPTING, *_RESULT),
        _S.PREEMPTING: (_C.PREEMPTING,),
    },
    _C.PREEMPTING: {
        _S.PREEMPTED: _RESULT,
        _S.SUCCEEDED: _RESULT,
        _S.ABORTED: _RESULT,
        _S.PREEMPTING: _STAY,
    },
    _C.DONE: dict.fromkeys(_ENDS, _STAY),
}
"""States passed one after the other when the server tells a status; what is missing is invalid."""


def steps(state: CommState, status: ActionlibStatus) -> tuple[CommState, ...] | None:
    """Return the states that a told status leads through, None when it makes no sense."""
    return TRANSITIONS.get(state, {}).get(status)
