"""Waiting for something a launch does, and saying what it was when it does not."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterable
from typing import TypeVar

from gazelle.diagnostics import did_you_mean

__all__ = ["Waiting", "existing"]

T = TypeVar("T")
# What changes without notice (a clock of another process, say) is looked at this often.
_LOOK_S = 0.1
_MAX_NAMES = 12


class Waiting:
    """Wakes whoever waits for a launch when anything about it changes.

    Attributes:
        timeout_s: patience in seconds of real time where a wait names none.
        ended: says how the launch has ended, nothing while it runs.
    """

    def __init__(self, timeout_s: float) -> None:
        self.timeout_s = timeout_s
        self.ended: Callable[[], str] = str
        self._changed = threading.Condition()

    def wake(self, *_changes: object) -> None:
        """Look again: something has changed."""
        with self._changed:
            self._changed.notify_all()

    def until(
        self,
        found: Callable[[], T],
        wanted: str,
        timeout_s: float | None,
        *,
        hint: Callable[[], str] = str,
    ) -> T:
        """Return what a condition gives as soon as that is true.

        Args:
            found: the condition.
            wanted: what is waited for, in words that fit after "no": ``message on '/scan'``.
            timeout_s: patience, None for the usual one.
            hint: what to say besides.

        Raises:
            AssertionError: the time is up, or the launch has ended.
        """
        patience_s = self.timeout_s if timeout_s is None else timeout_s
        deadline = time.monotonic() + patience_s
        with self._changed:
            while True:
                # Asked first: what a launch did last, it did before its end.
                ended = self.ended()
                result = found()
                if result:
                    return result
                left_s = deadline - time.monotonic()
                if ended or left_s <= 0:
                    reason = f": {ended}" if ended else f" within {patience_s:g} s"
                    raise AssertionError("; ".join(filter(None, [f"no {wanted}{reason}", hint()])))
                self._changed.wait(min(left_s, _LOOK_S))


def existing(kind: str, name: str, names: Iterable[str]) -> str:
    """Return a hint: what exists that is spelled alike, or all there is."""
    known = sorted(set(names))
    near = did_you_mean(name, known)
    if near:
        return near
    shown = ", ".join(known[:_MAX_NAMES]) + (" …" if len(known) > _MAX_NAMES else "")
    return f"{kind} there: {shown or 'none'}"
