"""logdebug … logfatal with their _throttle, _throttle_identical and _once forms."""

from __future__ import annotations

import sys
import time
from types import FrameType
from typing import Any

from gazelle.compat.rospy.state import STATE
from gazelle.compat.warn_once import is_first_time
from gazelle.graph import Level

__all__ = [
    f"log{word}{form}"
    for word in ("debug", "err", "fatal", "info", "warn")
    for form in ("", "_once", "_throttle", "_throttle_identical")
] + ["logerror", "logout"]

_last: dict[tuple[str, int], tuple[float, str]] = {}


def _log(level: Level, message: Any, args: tuple[Any, ...], kwargs: dict[str, Any]) -> None:
    text = str(message) % args if args else str(message)
    logger = str(kwargs.get("logger_name") or "")
    if STATE.node is None:
        sys.stderr.write(f"[{level.name}] {text}\n")
        return
    STATE.node.log(
        level,
        text,
        logger=f"{STATE.node.name}.{logger}" if logger else "",
        padded=False,
        depth=3,
    )


def _call_site() -> tuple[str, int]:
    frame: FrameType = sys._getframe(2)
    return frame.f_code.co_filename, frame.f_lineno


def _is_due(call_site: tuple[str, int], period: float, text: str, *, identical: bool) -> bool:
    """Return whether a throttled message may be said; the clock is the node's."""
    now = time.monotonic() if STATE.node is None else STATE.node.clock.now_ns() / 1e9
    last, last_text = _last.get(call_site, (float("-inf"), ""))
    if (identical and text != last_text) or now - last >= period or now < last:
        _last[call_site] = (now, text)
        return True
    return False


def logdebug(msg: Any, *args: Any, **kwargs: Any) -> None:
    """Say something at debug level."""
    _log(Level.DEBUG, msg, args, kwargs)


def loginfo(msg: Any, *args: Any, **kwargs: Any) -> None:
    """Say something at info level."""
    _log(Level.INFO, msg, args, kwargs)


logout = loginfo


def logwarn(msg: Any, *args: Any, **kwargs: Any) -> None:
    """Say something at warn level."""
    _log(Level.WARN, msg, args, kwargs)


def logerr(msg: Any, *args: Any, **kwargs: Any) -> None:
    """Say something at error level."""
    _log(Level.ERROR, msg, args, kwargs)


logerror = logerr


def logfatal(msg: Any, *args: Any, **kwargs: Any) -> None:
    """Say something at fatal level."""
    _log(Level.FATAL, msg, args, kwargs)


def _throttled(level: Level, *, identical: bool) -> Any:
    def log(period: float, msg: Any, *args: Any, **kwargs: Any) -> None:
        text = str(msg) % args if args else str(msg)
        if _is_due(_call_site(), float(period), text, identical=identical):
            _log(level, msg, args, kwargs)

    log.__doc__ = f"Say something at {level.name.lower()} level, at most once in `period` seconds."
    return log


def _once(level: Level) -> Any:
    def log(msg: Any, *args: Any, **kwargs: Any) -> None:
        if is_first_time(_call_site()):
            _log(level, msg, args, kwargs)

    log.__doc__ = f"Say something at {level.name.lower()} level, once from this place."
    return log


logdebug_throttle = _throttled(Level.DEBUG, identical=False)
loginfo_throttle = _throttled(Level.INFO, identical=False)
logwarn_throttle = _throttled(Level.WARN, identical=False)
logerr_throttle = _throttled(Level.ERROR, identical=False)
logfatal_throttle = _throttled(Level.FATAL, identical=False)
logdebug_throttle_identical = _throttled(Level.DEBUG, identical=True)
loginfo_throttle_identical = _throttled(Level.INFO, identical=True)
logwarn_throttle_identical = _throttled(Level.WARN, identical=True)
logerr_throttle_identical = _throttled(Level.ERROR, identical=True)
logfatal_throttle_identical = _throttled(Level.FATAL, identical=True)
logdebug_once = _once(Level.DEBUG)
loginfo_once = _once(Level.INFO)
logwarn_once = _once(Level.WARN)
logerr_once = _once(Level.ERROR)
logfatal_once = _once(Level.FATAL)
