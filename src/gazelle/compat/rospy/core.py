"""What rospy's own modules share: logging, hooks of the shutdown, names (rospy.core)."""

from __future__ import annotations

import functools
import logging
import warnings
from collections.abc import Callable
from typing import Any

from gazelle.compat.rospy import log, names
from gazelle.compat.rospy.client import (
    get_node_uri,
    get_ros_root,
    is_initialized,
    is_shutdown,
    is_shutdown_requested,
    signal_shutdown,
)
from gazelle.compat.rospy.exceptions import ParameterInvalid
from gazelle.compat.rospy.log import *  # noqa: F403
from gazelle.compat.rospy.names import *  # noqa: F403
from gazelle.compat.rospy.state import STATE

__all__ = [
    "MASTER_NAME",
    "ROSRPC",
    "NullHandler",
    "ParameterInvalid",
    "add_client_shutdown_hook",
    "add_preshutdown_hook",
    "add_shutdown_hook",
    "deprecated",
    "get_node_uri",
    "get_ros_root",
    "is_initialized",
    "is_shutdown",
    "is_shutdown_requested",
    "parse_rosrpc_uri",
    "rospydebug",
    "rospyerr",
    "rospyinfo",
    "rospywarn",
    "signal_shutdown",
]
__all__ += log.__all__
__all__ += names.__all__

MASTER_NAME = "master"
ROSRPC = "rosrpc://"
NullHandler = logging.NullHandler
_internal = logging.getLogger("rospy.internal")
rospydebug = _internal.debug
rospyinfo = _internal.info
rospywarn = _internal.warning
rospyerr = _internal.error


def deprecated(func: Callable[..., Any]) -> Callable[..., Any]:
    """Make a function warn that it is an old one."""

    @functools.wraps(func)
    def warned(*args: Any, **kwargs: Any) -> Any:
        name = func.__name__
        warnings.warn(f"Call to deprecated function {name}.", DeprecationWarning, stacklevel=2)
        return func(*args, **kwargs)

    return warned


def parse_rosrpc_uri(uri: str) -> tuple[str, int]:
    """Return host and port of ``rosrpc://HOST:PORT``.

    Raises:
        ParameterInvalid: it is none.
    """
    if not uri.startswith(ROSRPC):
        raise ParameterInvalid(f"Invalid protocol for ROS service URL: {uri}")
    host, _, port = uri.removeprefix(ROSRPC).partition("/")[0].partition(":")
    if not port.isdecimal():
        raise ParameterInvalid(f"ROS service URL is invalid: {uri}")
    return host, int(port)


def add_client_shutdown_hook(h: Callable[[], Any]) -> None:
    """Run a function without arguments at shutdown, while publishing still works."""
    STATE.add_hook(_callable(h))


def add_preshutdown_hook(h: Callable[[str], Any]) -> None:
    """Run a function of the reason at shutdown, while publishing still works."""
    _callable(h)
    STATE.add_hook(lambda: h(STATE.reason))


def add_shutdown_hook(h: Callable[[str], Any]) -> None:
    """Run a function of the reason as soon as `is_shutdown` is true."""
    _callable(h)
    if STATE.stopping.is_set():
        h("already shutdown")
    else:
        STATE.add_early_hook(h)


def _callable(h: Any) -> Any:
    if not callable(h):
        raise TypeError(f"shutdown hook [{h}] must be a function or callable object: {type(h)}")
    return h
