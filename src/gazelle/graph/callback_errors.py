"""Errors of users' callbacks: each whole the first time, then how often it came again.

A callback that fails at one message fails at the next, too: thirty tracebacks a second hide what
they say.
"""

from __future__ import annotations

import time
import traceback
from collections.abc import Callable
from dataclasses import dataclass, field

__all__ = ["CallbackErrors"]

_AGAIN_S = 10.0


@dataclass(slots=True)
class _Seen:
    told_s: float
    untold: int = 0


@dataclass(slots=True)
class CallbackErrors:
    """What was told of the errors of one callback.

    Attributes:
        clock: gives seconds that pass.
    """

    clock: Callable[[], float] = time.monotonic
    _seen: dict[tuple[type[BaseException], str, int], _Seen] = field(default_factory=dict)

    def text(self, heading: str, error: BaseException) -> str:
        """Return what to print of an error: nothing for one that was printed a moment ago.

        Args:
            heading: says whose error it is, in ROS's words.
            error: as it was caught.
        """
        frames = traceback.extract_tb(error.__traceback__)
        file, line = (frames[-1].filename, frames[-1].lineno or 0) if frames else ("", 0)
        key, now_s = (type(error), file, line), self.clock()
        known = self._seen.get(key)
        if known is None:
            self._seen[key] = _Seen(now_s)
            whole = "".join(traceback.format_exception(error))
            return f"{heading}\n{whole}"
        known.untold += 1
        if now_s - known.told_s < _AGAIN_S:
            return ""
        times, known.told_s, known.untold = known.untold, now_s, 0
        last = "".join(traceback.format_exception_only(error)).strip()
        again = f"the same {times} more times" if times > 1 else "the same once more"
        return f"{heading}\n{again}: {file}:{line}: {last}\n"
