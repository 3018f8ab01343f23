"""Action servers: one policy-free server of goals over actionlib's or ROS 2's wire."""

from __future__ import annotations

import itertools
import threading
import traceback
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from hashlib import blake2b
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol, TypeVar

from gazelle.errors import GraphError
from gazelle.graph.actions.goal import LocalGoal, Ros2Status, ServerGoal, StatusTimer
from gazelle.graph.actions.types import RosVersion, action_types, as_message
from gazelle.graph.errors import ServiceRefusedError

if TYPE_CHECKING:
    from gazelle.graph.actions.node_interface import ActionNode

__all__ = ["ActionServer", "ActionTiming", "Wire"]

_T = TypeVar("_T")
_NANO = 1_000_000_000
_STATUS_LIST_TIMEOUT_S = 5.0
_EARLIER_CANCEL = (
    "This goal handle was canceled by the action server because its timestamp is before the "
    "timestamp of the last cancel request"
)

Run = Callable[[Callable[[], object]], object]
OnGoal = Callable[[ServerGoal], None]
OnCancel = Callable[[ServerGoal], bool | None]


class ActionTiming(NamedTuple):
    """The clock and the periods of an action server.

    Attributes:
        now_ns: the clock, the node's own when None, 0 for a node without one.
        status_hz: how often actionlib's status is told besides on each change, 0 for never.
        result_timeout_s: how long ROS 2 results are kept.
    """

    now_ns: Callable[[], int] | None = None
    status_hz: float = 5.0
    result_timeout_s: float = 900.0


_USUAL_TIMING = ActionTiming()


class Wire(Protocol):
    """The topics and services of an action server."""

    @property
    def wants_feedback(self) -> bool:
        """True when somebody listens to feedback."""
        ...

    @property
    def wants_status(self) -> bool:
        """True when somebody listens to the status."""
        ...

    def listen(self) -> None:
        """Take goals and cancel requests."""
        ...

    def send_status(self, goals: list[ServerGoal]) -> None:
        """Tell the status of all goals."""
        ...

    def send_result(self, goal: ServerGoal) -> None:
        """Tell the result of a goal that has ended."""
        ...

    def send_feedback(self, goal: ServerGoal, feedback: Any) -> None:
        """Tell how a goal goes."""
        ...

    def close(self) -> None:
        """Take topics and services off the graph."""
        ...


class ActionServer:
    """Takes goals of one action and tells their status, feedback and results.

    It makes no policy: several goals may be active at once. On a node without a graph nothing
    happens by itself; whoever runs the clock calls `tick` for the periodic status.

    Attributes:
        name: the action's global name.
        types: its messages.
    """

    def __init__(
        self,
        node: ActionNode,
        name: str,
        action_type: Any,
        *,
        on_goal: OnGoal,
        on_cancel: OnCancel | None = None,
        ros_version: RosVersion = 1,
        run: Run | None = None,
        timing: ActionTiming = _USUAL_TIMING,
    ) -> None:
        """Offer an action.

        Args:
            node: a graph's node, or a stand-in without a graph.
            name: any legal name.
            action_type: ``pkg/Name``, or a class of either generation; actionlib's message class
                in ROS 1's form gives goals of that form.
            on_goal: called with each new goal; accepts or rejects it, now or later.
            on_cancel: called when a client asks to cancel a goal; ends the goal itself, now or
                later. Its value tells whether the server agrees, which matters in ROS 2 only;
                without it ROS 2 goals cannot be cancelled.
            ros_version: 1 for actionlib's wire, 2 for ROS 2's.
            run: brings calls of `on_goal` and `on_cancel` into the owner's thread; without it
                they run in the graph's threads. With it there is no thread for the status:
                call `tick`.
            timing: whose time counts, and how often and how long goals are told of.

        Raises:
            NotFoundError: nothing defines the action.
        """
        self.types = action_types(action_type, ros_version)
        self.name = node.resolve_name(name)
        self.lock = threading.RLock()
        self._node = node
        self._on_goal = on_goal
        self._on_cancel = on_cancel
        self._run = run or _at_once
        self._goals: dict[str, ServerGoal] = {}
        self._cancelled_early: dict[str, int] = {}
        self._last_cancel_ns = 0
        self._numbers = itertools.count(1)
        keep_s = _STATUS_LIST_TIMEOUT_S if ros_version == 1 else timing.result_timeout_s
        self._keep_ns = int(keep_s * _NANO)
        self._waiting: set[threading.Event] = set()
        self._closed = False
        self._is_silent = False
        self._clock: Any = getattr(node, "clock", None)
        own = self._clock.now_ns if self._clock else _zero
        self.now_ns: Callable[[], int] = timing.now_ns or own
        is_periodic = timing.status_hz > 0 and ros_version == 1
        period_ns = int(_NANO / timing.status_hz) if is_periodic else 0
        self._timer = StatusTimer(period_ns, self.now_ns, self._periodic_status)
        with node.announced_together():
            self._wire = self._offer(inline=run is not None)
            self._wire.send_status([])
            # The last thing: goals come at once.
            self._wire.listen()
        if self._clock is not None:
            self._clock.on_jump(self._on_jump)
            if run is None:
                self._timer.start(self._clock, self.name)
        # A stand-in for a node has no end of its own.
        if on_shutdown := getattr(node, "on_shutdown", None):
            on_shutdown(self._fall_silent)

    @property
    def goals(self) -> tuple[ServerGoal, ...]:
        """The goals that are known: running, and ended not long ago."""
        with self.lock:
            return tuple(self._goals.values())

    def submit(
        self,
        goal: Any,
        *,
        goal_id: str = "",
        on_feedback: Callable[[Any], None] | None = None,
        on_done: Callable[[LocalGoal], None] | None = None,
    ) -> LocalGoal:
        """Send a goal from the same process, without any transport.

        Args:
            goal: the goal message, or a mapping or other message with fields of the same names.
            goal_id: its unique name, made up when empty.
            on_feedback: called with each feedback message, in the thread of the server's owner.
            on_done: called with the handle at the end, in the same thread.

        Raises:
            InterfaceError: a field's value does not fit.
            GraphError: the server is closed, or has a goal of this name.
        """
        if self._closed:
            raise GraphError(f"action server {self.name} is closed")
        message = as_message(goal, self.types.Goal)
        made = ServerGoal(self, goal_id or self.new_id(), self.now_ns(), message)
        handle = made.attach()
        made.on_feedback = on_feedback
        if on_done is not None:
            made.on_done = lambda _goal: on_done(handle)
        if made.goal_id in self._goals:
            raise GraphError(f"action server {self.name} already has a goal {made.goal_id}")
        self._run(lambda: self.take(made))
        return handle

    def tick(self) -> None:
        """Tell the periodic status when it is due; cheap enough for every step."""
        self._timer.tick()

    def publish_status(self) -> None:
        """Tell the status of all goals now."""
        self._send_status()

    def close(self) -> None:
        """Stop offering the action; goals that run are aborted. Twice does nothing."""
        with self.lock:
            if self._closed:
                return
            for goal in self.goals:
                if goal.is_active:
                    goal.abort(text="the action server was closed")
            self._closed = self._is_silent = True
        for event in tuple(self._waiting):
            event.set()
        self._timer.close()
        self._wire.close()

    def _fall_silent(self, _reason: str) -> None:
        # Goals may end in other threads while the node goes, and nobody hears of them any more.
        with self.lock:
            self._is_silent = True

    # What the wires call, from any thread.

    def goal_with(self, goal_id: str) -> ServerGoal | None:
        """Return a goal that is known."""
        with self.lock:
            self._forget_old()
            return self._goals.get(goal_id)

    def post(self, work: Callable[[], object]) -> None:
        """Do something in the owner's thread."""
        if not self._closed:
            self._run(work)

    def ask(self, work: Callable[[], _T]) -> _T:
        """Do something in the owner's thread and wait for its value.

        Raises:
            ServiceRefusedError: the server was closed meanwhile.
        """
        return self.asked(work)()

    def asked(self, work: Callable[[], _T]) -> Callable[[], _T]:
        """Let something be done in the owner's thread; return a function that waits for its value.

        What is asked for first is done first.
        """
        found: list[_T] = []
        done = threading.Event()
        self._waiting.add(done)
        if self._closed:
            done.set()

        def do() -> None:
            try:
                found.append(work())
            finally:
                done.set()

        def value() -> _T:
            with self.waiting(done):
                done.wait()
            if not found:
                raise ServiceRefusedError(f"action server {self.name} could not answer")
            return found[0]

        self._run(do)
        return value

    @contextmanager
    def waiting(self, event: threading.Event | None = None) -> Iterator[threading.Event]:
        """Give an event that closing the server sets too."""
        waiting = event or threading.Event()
        self._waiting.add(waiting)
        try:
            if self._closed:
                waiting.set()
            yield waiting
        finally:
            self._waiting.discard(waiting)

    def take(self, goal: ServerGoal) -> bool:
        """Take a new goal, in the owner's thread; False when it is known already."""
        with self.lock:
            self._forget_old()
            if self._closed or goal.goal_id in self._goals:
                return False
            self._goals[goal.goal_id] = goal
            goal.stamp_ns = goal.stamp_ns or self.now_ns()
            known = self._cancelled_early.pop(goal.goal_id, None)
            if known is not None or 0 < goal.stamp_ns <= self._last_cancel_ns:
                # The cancel request came before the goal itself.
                goal.cancel(text=_EARLIER_CANCEL if known is None else "")
                return True
        self._call(self._on_goal, goal)
        return True

    def cancel_matching(
        self, goal_id: str, stamp_ns: int
    ) -> tuple[list[ServerGoal], list[ServerGoal]]:
        """Ask to cancel by id, by stamp, or all with neither; in the owner's thread.

        Returns:
            The goals that could be cancelled, and those that now are.
        """
        with self.lock:
            self._forget_old()
            chosen = [
                goal
                for goal in self._goals.values()
                if goal.goal_id == goal_id
                or (not goal_id and not stamp_ns)
                or (stamp_ns and goal.stamp_ns <= stamp_ns)
            ]
            if self.types.ros_version == 1:
                if goal_id and goal_id not in self._goals:
                    self._cancelled_early[goal_id] = self.now_ns()
                self._last_cancel_ns = max(self._last_cancel_ns, stamp_ns)
        chosen = [goal for goal in chosen if goal.is_cancelable]
        return chosen, [goal for goal in chosen if self._cancel(goal)]

    # What goals call.

    def goal_changed(self, goal: ServerGoal) -> None:
        """Tell others the goal's new status."""
        self._send_status()

    def goal_ended(self, goal: ServerGoal) -> None:
        """Tell others the goal's result and status."""
        goal.ended_ns = self.now_ns()
        if goal.status is Ros2Status.REJECTED:
            self._goals.pop(goal.goal_id, None)
            return
        with self.lock:
            if not self._is_silent:
                self._wire.send_result(goal)
        self._send_status()

    def goal_feedback(self, goal: ServerGoal, feedback: Any) -> None:
        """Tell others how the goal goes."""
        with self.lock:
            if not self._is_silent and self._wire.wants_feedback:
                self._wire.send_feedback(goal, as_message(feedback, self.types.Feedback))

    def wants_feedback(self) -> bool:
        """Tell whether anybody elsewhere listens to feedback."""
        return not self._is_silent and self._wire.wants_feedback

    def request_cancel(self, goal: ServerGoal) -> None:
        """Ask the owner to cancel a goal."""
        self.post(lambda: self._cancel(goal))

    def _cancel(self, goal: ServerGoal) -> bool:
        if self.types.ros_version == 1:
            changed = goal.begin_canceling()
            if changed and self._on_cancel is not None:
                self._call(self._on_cancel, goal)
            return changed
        if not goal.is_cancelable:
            return False
        goal.cancel_asked = True
        agreed = self._on_cancel is not None and self._call(self._on_cancel, goal)
        goal.cancel_asked = False
        if agreed and not goal.status.is_terminal:
            goal.begin_canceling()
        return bool(agreed) or goal.status is Ros2Status.CANCELED

    def _call(self, callback: Callable[[ServerGoal], Any], goal: ServerGoal) -> Any:
        try:
            return callback(goal)
        except Exception:  # noqa: BLE001 - the owner's callback may raise anything
            text = f"action {self.name}, goal {goal.goal_id}: {traceback.format_exc().rstrip()}"
            self._node.log("error", text)
            if goal.is_active:
                goal.abort(text="the server's callback failed")
            elif not goal.status.is_terminal:
                goal.reject(text="the server's callback failed")
            return None

    def _offer(self, *, inline: bool) -> Wire:
        from gazelle.graph.actions.actionlib_wire import ActionlibWire
        from gazelle.graph.actions.ros2_wire import Ros2Wire

        if self.types.ros_version == 1:
            return ActionlibWire(self._node, self, inline=inline)
        return Ros2Wire(self._node, self)

    def _send_status(self) -> None:
        with self.lock:
            if not self._is_silent:
                self._wire.send_status(list(self._goals.values()))

    def _periodic_status(self) -> None:
        with self.lock:
            self._forget_old()
            if not self._is_silent and self._wire.wants_status:
                self._send_status()

    def _forget_old(self) -> None:
        now_ns = self.now_ns()
        old = [
            goal.goal_id
            for goal in self._goals.values()
            if goal.ended_ns is not None and not 0 <= now_ns - goal.ended_ns <= self._keep_ns
        ]
        for goal_id in old:
            del self._goals[goal_id]
        for goal_id, since_ns in tuple(self._cancelled_early.items()):
            if not 0 <= now_ns - since_ns <= self._keep_ns:
                del self._cancelled_early[goal_id]

    def _on_jump(self, _delta_ns: int) -> None:
        # Stamps of before mean nothing now, or every new goal would count as cancelled.
        self._last_cancel_ns = 0

    def new_id(self) -> str:
        """Return a name that no goal has, as the original makes them."""
        node = str(getattr(self._node, "name", "")) or "/gazelle"
        number, now_ns = next(self._numbers), self.now_ns()
        if self.types.ros_version == 1:
            return f"{node}-{number}-{now_ns // _NANO}.{now_ns % _NANO}"
        return blake2b(f"{node}{self.name}-{number}-{now_ns}".encode(), digest_size=16).hexdigest()


def _at_once(work: Callable[[], object]) -> None:
    work()


def _zero() -> int:
    return 0
