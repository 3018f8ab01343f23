"""Where files of the user's own go: what can be made anew, settings, secrets, ROS's logs.

``XDG_CACHE_HOME``, ``XDG_CONFIG_HOME`` and ``XDG_STATE_HOME`` name the places on every system;
where they are not set, they are the system's usual ones, as `platformdirs` knows them: ``~/.cache``
on Linux, ``~/Library/Caches`` on macOS, ``%LOCALAPPDATA%`` on Windows. ROS has its own rules, the
same everywhere. Files that a process would remove at its end are removed by others when it was
killed.
"""

from __future__ import annotations

import contextlib
import os
from collections.abc import Mapping
from pathlib import Path

__all__ = [
    "cache_folder",
    "config_folder",
    "lives",
    "own_prefix",
    "ros_home",
    "ros_log_folder",
    "runtime_folder",
    "state_folder",
    "sweep",
]


_NAME = "gazelle"


def cache_folder() -> Path:
    """Return the folder of what can be made anew: ``$XDG_CACHE_HOME/gazelle``.

    Raises:
        RuntimeError: the user has no home.
    """
    return _folder("cache", os.environ)


def config_folder(environ: Mapping[str, str] = os.environ) -> Path:
    """Return the folder of what the user has chosen: ``$XDG_CONFIG_HOME/gazelle``.

    Raises:
        RuntimeError: the user has no home.
    """
    return _folder("config", environ)


def state_folder() -> Path:
    """Return the folder of what must outlive a cache: ``$XDG_STATE_HOME/gazelle``.

    Raises:
        RuntimeError: the user has no home.
    """
    return _folder("state", os.environ)


def runtime_folder() -> Path | None:
    """Return ``XDG_RUNTIME_DIR``, the user's own folder of memory until they log out, if there."""
    named = os.environ.get("XDG_RUNTIME_DIR")
    return Path(named) if named else None


def ros_home(environ: Mapping[str, str]) -> Path:
    """Return ``ROS_HOME``, ``~/.ros`` when it is not set."""
    return Path(environ.get("ROS_HOME") or Path.home() / ".ros")


def ros_log_folder(environ: Mapping[str, str]) -> Path:
    """Return ``ROS_LOG_DIR``, the folder ``log`` of `ros_home` when it is not set."""
    return Path(environ.get("ROS_LOG_DIR") or ros_home(environ) / "log")


def own_prefix(prefix: str) -> str:
    """Return how this process begins the names of its files, for others to `sweep` them."""
    return f"{prefix}{os.getpid()}-"


def sweep(folder: Path, prefix: str) -> None:
    """Remove the files below a prefix of processes of this user that are gone."""
    with contextlib.suppress(OSError):
        for left in folder.glob(f"{prefix}*-*"):
            pid = left.name.removeprefix(prefix).partition("-")[0]
            if not lives(pid):
                with contextlib.suppress(OSError):
                    left.unlink()


def lives(pid: str | int) -> bool:
    """Return whether a process is there, by its number; of any user."""
    if os.name != "posix":
        # A file that is in use cannot be removed there.
        return False
    try:
        os.kill(int(pid), 0)
    except ProcessLookupError:
        return False
    except (OSError, ValueError, OverflowError):
        pass
    return True


def _folder(kind: str, environ: Mapping[str, str]) -> Path:
    named = environ.get(f"XDG_{kind.upper()}_HOME")
    if named:
        return Path(named) / _NAME
    # 20 ms, which nobody pays who names the folders or needs none.
    import platformdirs

    folders = platformdirs.PlatformDirs(_NAME, appauthor=False)
    path: Path = getattr(folders, f"user_{kind}_path")
    if not path.is_absolute():
        raise RuntimeError("Could not determine home directory.")
    return path
