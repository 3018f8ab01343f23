"""Time as nodes see it: wall time, or simulated time from ``/clock``, and waiting for it."""

from __future__ import annotations

import contextlib
import heapq
import itertools
import threading
import time
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from gazelle.errors import GraphError
from gazelle.graph.errors import TimeJumpError
from gazelle.graph.shared_clock_discovery import ClockFinder
from gazelle.graph.type_support import resolve_type
from gazelle.interfaces.stamps import ns_of

if TYPE_CHECKING:
    from gazelle.graph.node import Node
    from gazelle.graph.shared_memory_clock import PageView
    from gazelle.graph.subscription import Subscription

__all__ = ["Clock", "Waits"]

_MIN_DURATION_S = 0.0005
_MAX_DURATION_S = 0.1
# What is so far off is met by halves, for time may come to run faster meanwhile.
_NEAR_S = 0.04
# Time that stands still comes on soon, or with word of it: publishers give that after 50 ms, and
# so many looks take twice as long.
_STILL_LOOKS = 28
_STILL_S = (0.0005, 0.001, 0.002, 0.004)
_LONG_STILL_S = 0.05
_WINDOW_S = 0.1
_MAX_SPEED = 100.0
# A simulator takes some steps at a time. Who sleeps for less than those misses them on a page.
_SHORT_NS = 2_500_000
_MANY = 200
_CLOCK_TYPE = "rosgraph_msgs/msg/Clock"
_STOP_SLICE_S = 0.2


class Waits:
    """Reckons, from how fast simulated time ran of late, when it is worth looking again.

    Looking early costs a look, some microseconds; looking late makes whoever waits late. So time
    that runs slowly is expected to run at the wall's speed from now on.
    """

    def __init__(self) -> None:
        self._rates = (1.0, 1.0)
        self._mark_ns = 0
        self._mark_s = 0.0
        self._short = 0
        self._mostly_short = False

    def begin(self, left_ns: int) -> bool:
        """Take in how long a sleep will be; return whether most are too short for a page.

        Messages tell of each step, one after the other.
        """
        self._short = min(max(self._short + (1 if left_ns < _SHORT_NS else -1), 0), _MANY)
        if self._short in (0, _MANY):
            self._mostly_short = self._short == _MANY
        return self._mostly_short

    def until(self, left_ns: int) -> float:
        """Return how many seconds to wait before looking, with so much simulated time left."""
        left_s = left_ns * 1e-9 / max(self._rates)
        if left_s > _NEAR_S:
            left_s = min(left_s / 2, _MAX_DURATION_S)
        return max(left_s, _MIN_DURATION_S)

    def still(self, looks: int) -> float:
        """Return how many seconds to wait while time stands still.

        Args:
            looks: how many have seen that.
        """
        if looks > _STILL_LOOKS:
            return _LONG_STILL_S
        return _STILL_S[min(looks, len(_STILL_S)) - 1]

    def note(self, now_ns: int) -> None:
        """Take in what a look has shown."""
        now_s = time.monotonic()
        since_s = now_s - self._mark_s
        if since_s < _WINDOW_S:
            return
        rate = (now_ns - self._mark_ns) * 1e-9 / since_s
        self._rates = (self._rates[1], min(max(rate, 1.0), _MAX_SPEED))
        self._mark_ns, self._mark_s = now_ns, now_s


class Clock:
    """The clock of all nodes of a process.

    It follows ``/clock`` while the parameter ``/use_sim_time`` is true, and subscribes only
    then. Simulated time is 0 until the first message, as in ROS 1. Where the publisher shows its
    time on a page (`gazelle.graph.shared_clock_discovery`), that is looked at and no messages come.
    """

    def __init__(self, read_parameter: Callable[[], Any]) -> None:
        """Show wall time.

        Args:
            read_parameter: gives the value of ``/use_sim_time``.
        """
        self._read_parameter = read_parameter
        self._switching = threading.RLock()
        self._lock = threading.RLock()
        # Who sleeps, by the time at which it wakes: at 1 kHz, waking everybody each time costs
        # a process with four sleepers a tenth of a core.
        self._sleepers: list[tuple[int, int, threading.Event]] = []
        self._numbers = itertools.count()
        self._nodes: list[Node] = []
        self._subscription: Subscription | None = None
        self._finder: ClockFinder | None = None
        self._page: PageView | None = None
        self._page_jumps = 0
        self._waits = Waits()
        self._owner: Node | None = None
        self._use_sim_time = False
        self._chosen: bool | None = None
        self._closed = False
        self._sim_ns = 0
        self._jumps = 0
        self._switches = 0
        self._last_jump_ns = 0
        self._listeners: list[Callable[[int], None]] = []
        self._watchers: tuple[Callable[[], None], ...] = ()
        self._untold: list[int] = []
        self._telling = threading.RLock()

    @property
    def use_sim_time(self) -> bool:
        """True while the clock follows ``/clock``."""
        return self._use_sim_time

    @property
    def page(self) -> PageView | None:
        """The page that shows the time just now, None where messages tell it."""
        return self._page if self._use_sim_time else None

    @property
    def last_jump_ns(self) -> int:
        """How far time went back when it did so last, negative; 0 when it never did."""
        return self._last_jump_ns

    @property
    def told_jumps(self) -> int:
        """How often time went backwards, without looking at the page."""
        return self._jumps

    def watch(self, act: Callable[[], None]) -> None:
        """Call something, in any thread, whenever the clock is switched or told a time."""
        self._watchers = (*self._watchers, act)

    def prefer_messages(self, *, messages: bool) -> None:
        """Let messages tell the time although there is a page, or go back to that."""
        if self._finder is not None:
            self._finder.prefer(messages=messages)

    @property
    def jumps(self) -> int:
        """How often time went backwards, the change from wall time to simulated one included."""
        self.now_ns()
        return self._jumps

    def now_ns(self) -> int:
        """Return the time in nanoseconds: simulated, or since 1970."""
        if not self._use_sim_time:
            return time.time_ns()
        page = self._page
        return self._sim_ns if page is None else self._read(page)

    def on_jump(self, listener: Callable[[int], None]) -> None:
        """Call `listener(delta_ns)` whenever simulated time goes backwards."""
        self._listeners.append(listener)

    def sleep(self, duration_ns: int) -> bool:
        """Sleep on this clock; see `sleep_until`. Waits for the first ``/clock`` if need be."""
        while True:
            if self._use_sim_time and not self._wait_for_start():
                return False
            switches, jumps = self._switches, self.jumps
            try:
                return self.sleep_until(self.now_ns() + duration_ns, since=jumps)
            except TimeJumpError:
                # Of a clock that became another one the end of the sleep is not known.
                if self._switches == switches:
                    raise

    def sleep_until(
        self, target_ns: int, stop: threading.Event | None = None, *, since: int | None = None
    ) -> bool:
        """Sleep until the clock shows a time.

        Args:
            target_ns: the time.
            stop: ends the sleep early, also while simulated time stands still.
            since: `jumps` when the target was reckoned, now unless given.

        Returns:
            True when it does, False when the graph was closed or `stop` was set first.

        Raises:
            TimeJumpError: time went backwards meanwhile.
        """
        wake = threading.Event()
        jumps = self.jumps if since is None else since
        while stop is None or not stop.is_set():
            wake.clear()
            with self._lock:
                if self._closed:
                    break
                left_ns = target_ns - self.now_ns()
                if self._jumps != jumps:
                    raise TimeJumpError(self._last_jump_ns)
                if left_ns <= 0:
                    return True
                number = next(self._numbers)
                heapq.heappush(self._sleepers, (target_ns, number, wake))
                page = self._page if self._use_sim_time else None
                if self._finder is not None:
                    self._finder.prefer(messages=self._waits.begin(left_ns))
            if page is None:
                self._rest(wake, left_ns, stop)
            else:
                self._look_out(page, wake, target_ns, stop)
            self._forget(number)
        return False

    def _look_out(
        self,
        page: PageView,
        wake: threading.Event,
        target_ns: int,
        stop: threading.Event | None,
    ) -> None:
        """Look at a page until its time has come or gone back, or wait to be woken."""
        before_ns, still, waits = -1, 0, self._waits
        while True:
            now_ns, jumps, _ = page.read()
            if now_ns >= target_ns or jumps != self._page_jumps:
                return
            waits.note(now_ns)
            still = still + 1 if now_ns == before_ns else 0
            before_ns = now_ns
            pause_s = waits.still(still) if still else waits.until(target_ns - now_ns)
            if wake.wait(pause_s) or (stop is not None and stop.is_set()):
                return

    def _rest(self, wake: threading.Event, left_ns: int, stop: threading.Event | None) -> None:
        """Wait to be woken, for the end of wall time, or for `stop`."""
        if not self._use_sim_time:
            left_s = left_ns / 1e9
            wake.wait(left_s if stop is None else min(left_s, _STOP_SLICE_S))
        elif stop is None:
            wake.wait()
        else:
            while not wake.wait(_STOP_SLICE_S) and not stop.is_set():
                pass

    def _forget(self, number: int) -> None:
        """Take a sleeper out who woke by itself."""
        with self._lock:
            kept = [one for one in self._sleepers if one[1] != number]
            if len(kept) != len(self._sleepers):
                heapq.heapify(kept)
                self._sleepers = kept

    def _wake(self, *, everybody: bool) -> None:
        """Wake those whose time has come; hold the lock."""
        now_ns = self._sim_ns
        while self._sleepers and (everybody or self._sleepers[0][0] <= now_ns):
            heapq.heappop(self._sleepers)[2].set()

    def follow(self, node: Node) -> None:
        """Let a node carry the subscription of ``/clock`` when it is needed."""
        with self._switching:
            self._nodes.append(node)
            self.refresh()

    def leave(self, node: Node) -> None:
        """Count on a node no more; another one takes the subscription over."""
        with self._switching:
            self._nodes = [one for one in self._nodes if one is not node]
            if self._owner is node and self._subscription is not None:
                self._unsubscribe()
            self.refresh()

    def use(self, sim_time: bool | None) -> None:
        """Choose simulated or wall time whatever ``/use_sim_time`` says; None lets it say.

        ROS 2 has a parameter ``use_sim_time`` for each node.
        """
        self._chosen = sim_time
        self.refresh()

    def refresh(self) -> None:
        """Use simulated or wall time, as the parameter says now."""
        with self._switching:
            if self._closed:
                # What waits for time has been woken; the subscription goes with its node.
                return
            wanted = bool(self._nodes) and self._is_sim_time_wanted()
            if self._nodes and wanted != self._use_sim_time:
                with self._lock:
                    before_ns = self.now_ns()
                    self._use_sim_time = wanted
                    self._switches += 1
                    if self.now_ns() < before_ns:
                        # A target of wall time is 1.8e18 ns of simulated time away.
                        self._jumps += 1
                        self._last_jump_ns = self.now_ns() - before_ns
                    self._wake(everybody=True)
            if wanted and self._subscription is None:
                self._subscribe()
            elif not wanted and self._subscription is not None:
                self._unsubscribe()
        self._show()

    def _subscribe(self) -> None:
        """Let the first node that is not about to end carry the subscription."""
        for node in self._nodes:
            try:
                subscription = node.create_subscription(
                    "/clock", resolve_type(_CLOCK_TYPE), self._on_clock, inline=True
                )
            except GraphError:
                if not node.closed:
                    raise
                continue
            self._owner, self._subscription = node, subscription
            self._finder = ClockFinder(node.graph, subscription, self._use_page, self._look)
            self._finder.start()
            return

    def _unsubscribe(self) -> None:
        finder, subscription = self._finder, self._subscription
        self._owner = self._subscription = self._finder = None
        self._use_page(None, None)
        if finder is not None:
            finder.close()
        if subscription is not None:
            subscription.unregister()

    def close(self) -> None:
        """Wake everybody who sleeps."""
        with self._lock:
            self._closed = True
            self._wake(everybody=True)

    def _on_clock(self, message: Any) -> None:
        stamp = message.clock
        now_ns = ns_of(stamp)
        with self._lock:
            if self._page is not None:
                # It was on its way when the page was found.
                return
            self._take(now_ns, now_ns - self._sim_ns)
        self._show()
        self._tell()

    def _use_page(self, finder: ClockFinder | None, page: PageView | None) -> None:
        """Look at a page from now on, or take messages."""
        with self._lock:
            if finder is not self._finder:
                # Its subscription has just ended.
                return
            if self._page is not None:
                self._sim_ns = self._catch_up(self._page)
            self._page = page
            if page is not None:
                now_ns, self._page_jumps, _ = page.read()
                self._take(now_ns, now_ns - self._sim_ns)
            self._wake(everybody=True)
        self._show()
        self._tell()

    def _look(self) -> None:
        """Look at the page at once: time went back, or goes on after it stood still."""
        with self._lock:
            if self._page is not None:
                self._catch_up(self._page)
                self._wake(everybody=True)
        self._show()
        self._tell()

    def _read(self, page: PageView) -> int:
        """Return a page's time; whoever is the first to see that it went back says so."""
        now_ns, jumps, _ = page.read()
        if jumps != self._page_jumps:
            with self._lock:
                if page is self._page:
                    self._catch_up(page)
            # Not here: who asks for the time may hold what the listeners want. At the very end of
            # Python no thread starts, and nobody listens.
            with contextlib.suppress(RuntimeError):
                threading.Thread(target=self._tell, name="clock jump", daemon=True).start()
        return now_ns

    def _catch_up(self, page: PageView) -> int:
        """Take in what the page shows; hold the lock."""
        now_ns, jumps, jump_ns = page.read()
        if jumps != self._page_jumps:
            self._page_jumps = jumps
            self._take(now_ns, jump_ns)
        return now_ns

    def _take(self, now_ns: int, delta_ns: int) -> None:
        """Go on to a time, of which the last one differs by so much; hold the lock."""
        self._sim_ns = now_ns
        if delta_ns < 0:
            self._jumps += 1
            self._last_jump_ns = delta_ns
            self._untold.append(delta_ns)
        self._wake(everybody=delta_ns < 0)

    def _show(self) -> None:
        for act in self._watchers:
            act()

    def _tell(self) -> None:
        """Tell the listeners of jumps, or wait for whoever is doing so."""
        with self._telling:
            while self._untold:
                delta_ns = self._untold.pop(0)
                for listener in tuple(self._listeners):
                    listener(delta_ns)

    def _is_sim_time_wanted(self) -> bool:
        return _is_true(self._read_parameter()) if self._chosen is None else self._chosen

    def _wait_for_start(self) -> bool:
        while self._use_sim_time and not self.now_ns() and not self._closed:
            with contextlib.suppress(TimeJumpError):
                self.sleep_until(1)
        return not self._closed


def _is_true(value: Any) -> bool:
    return value is True or value == "true"
