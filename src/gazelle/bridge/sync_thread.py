"""The thread of a bridge: brings both sides together again after every change."""

from __future__ import annotations

import threading
from collections.abc import Callable

from gazelle.errors import GazelleError

__all__ = ["SyncThread"]

_SETTLE_S = 0.01
_ENDING_S = 5.0


class SyncThread:
    """Calls a bridge's ``settle`` after changes, and now and then without one."""

    def __init__(
        self, name: str, settle: Callable[[], None], notice: Callable[[str], None]
    ) -> None:
        """Do nothing before `start`.

        Args:
            name: of the thread.
            settle: makes both sides equal; its `GazelleError` is told and tried again.
            notice: tells the user; the same trouble is told once.
        """
        self._settle = settle
        self._notice = notice
        self._look_s = 0.0
        self._dirty = threading.Event()
        self._ended = threading.Event()
        self._trouble = ""
        self._thread = threading.Thread(target=self._run, name=name, daemon=True)

    @property
    def ended(self) -> bool:
        """Whether `close` was called."""
        return self._ended.is_set()

    def start(self, look_s: float) -> None:
        """Begin with a first look; the next ones are at most so many seconds apart."""
        self._look_s = look_s
        self._dirty.set()
        self._thread.start()

    def touch(self) -> None:
        """Something changed; may be called from any thread."""
        self._dirty.set()

    def wait(self, seconds: float) -> bool:
        """Wait; True as soon as the bridge ends."""
        return self._ended.wait(seconds)

    def close(self) -> bool:
        """End; False when it had ended already."""
        if self._ended.is_set():
            return False
        self._ended.set()
        self._dirty.set()
        self._thread.join(_ENDING_S)
        return True

    def _run(self) -> None:
        while not self._ended.is_set():
            self._dirty.wait(self._look_s)
            # Changes come in swarms: a node announces all it has at once.
            self._ended.wait(_SETTLE_S)
            self._dirty.clear()
            if self._ended.is_set():
                return
            try:
                self._settle()
            except GazelleError as error:
                # One thing that cannot be brought over must not end the bridge.
                if str(error) != self._trouble:
                    self._trouble = str(error)
                    self._notice(self._trouble)
