"""How launch logs: level, formats, folder."""

from __future__ import annotations

import datetime
import logging
import os
import socket
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

from gazelle.launch.ros2.logging import handlers
from gazelle.user_folders import ros_log_folder

__all__ = ["LaunchConfig"]

_SCREEN = {
    "default": "[{levelname}] [{name}]: {msg}",
    "default_with_timestamp": "{created:.7f} [{levelname}] [{name}]: {msg}",
}
_FILE = {"default": "{created:.7f} [{levelname}] [{name}]: {msg}"}


class LaunchConfig:
    """Level, formats and folder of launch's log.

    ``OVERRIDE_LAUNCH_SCREEN_FORMAT`` and ``OVERRIDE_LAUNCH_LOG_FORMAT`` win over the formats that
    are set. The folder is made with the first file.

    Attributes:
        file_handlers: open log files by name.
        screen_handler: the terminal, None before its first use.
        screen_formatter: of the terminal.
        file_formatter: of log files.
    """

    def __init__(self) -> None:
        self.reset()

    def reset(self) -> None:
        """Go back to how it began; open files are closed."""
        for handler in getattr(self, "file_handlers", {}).values():
            handler.close()
        self.file_handlers: dict[str, Any] = {}
        self.screen_handler: Any = None
        self.screen_formatter: logging.Formatter | None = None
        self.file_formatter: logging.Formatter | None = None
        self._log_dir: str | None = None
        self._log_handler_factory: Callable[..., Any] | None = None
        self.set_screen_format("default")
        self.set_log_format("default")

    @property
    def level(self) -> int:
        """What is logged at least, of everything that sets no level of its own."""
        return logging.root.getEffectiveLevel()

    @level.setter
    def level(self, new_level: int) -> None:
        logging.root.setLevel(new_level)

    @property
    def log_dir(self) -> str:
        """The run's folder ``DATE-HOST-PID`` below ``ROS_LOG_DIR`` or ``~/.ros/log``."""
        if self._log_dir is None:
            self._log_dir = str(_new_folder())
        return self._log_dir

    @log_dir.setter
    def log_dir(self, new_log_dir: str | None) -> None:
        if new_log_dir is not None:
            if self.file_handlers:
                warnings.warn(
                    f"log files are being written below {self._log_dir} already", stacklevel=2
                )
            if not Path(new_log_dir).is_dir():
                raise ValueError(f"{new_log_dir} is not a directory")
        self._log_dir = new_log_dir

    @property
    def log_handler_factory(self) -> Callable[..., Any]:
        """What opens a log file."""
        factory: Callable[..., Any] = self._log_handler_factory or handlers.WatchedFileHandler
        return factory

    @log_handler_factory.setter
    def log_handler_factory(self, new_factory: Callable[..., Any]) -> None:
        self._log_handler_factory = new_factory

    def set_screen_format(self, screen_format: str | None, *, screen_style: Any = None) -> None:
        """Set the format of the terminal: a name, a format, or None for the bare message."""
        variable = "OVERRIDE_LAUNCH_SCREEN_FORMAT"
        self.screen_formatter = _formatter(screen_format, screen_style, _SCREEN, variable)
        if self.screen_handler is not None:
            self.screen_handler.setFormatter(self.screen_formatter)

    def get_screen_handler(self) -> Any:
        """Return the handler of the terminal."""
        if self.screen_handler is None:
            self.screen_handler = handlers.ScreenHandler()
            self.screen_handler.setFormatter(self.screen_formatter)
        return self.screen_handler

    def set_log_format(self, log_format: str | None, *, log_style: Any = None) -> None:
        """Set the format of log files: a name, a format, or None for the bare message."""
        variable = "OVERRIDE_LAUNCH_LOG_FORMAT"
        self.file_formatter = _formatter(log_format, log_style, _FILE, variable)
        for handler in self.file_handlers.values():
            handler.setFormatter(self.file_formatter)

    def get_log_file_path(self, file_name: str = "launch.log") -> str:
        """Return the path of a log file of this run."""
        return str(Path(self.log_dir) / file_name)

    def get_log_file_handler(self, file_name: str = "launch.log") -> Any:
        """Return the handler of a log file, which is opened at first."""
        if file_name not in self.file_handlers:
            path = self.get_log_file_path(file_name)
            handler = self.log_handler_factory(path, encoding="utf-8")
            handler.setFormatter(self.file_formatter)
            self.file_handlers[file_name] = handler
        return self.file_handlers[file_name]


def _formatter(
    wanted: str | None, style: Any, names: dict[str, str], variable: str
) -> logging.Formatter | None:
    override = os.environ.get(variable)
    if override:
        wanted, style = override.encode("latin1").decode("unicode_escape"), "{"
    if wanted is None:
        return None
    if wanted in names and style is not None and not override:
        raise ValueError(f"Cannot set a custom format style for the '{wanted}' format.")
    return logging.Formatter(names.get(wanted, wanted), style=style or "{")


def _new_folder() -> Path:
    base = ros_log_folder(os.environ).expanduser()
    while True:
        now = datetime.datetime.now().strftime("%Y-%m-%d-%H-%M-%S-%f")
        folder = base / f"{now}-{socket.gethostname()}-{os.getpid()}"
        try:
            folder.mkdir(parents=True)
        except FileExistsError:
            continue
        break
    _point_latest_at(folder)
    return folder


def _point_latest_at(folder: Path) -> None:
    link = folder.parent / "latest"
    if link.exists() and not link.is_symlink():
        warnings.warn(f"'{link}' is no link, it does not follow the latest log", stacklevel=2)
        return
    part = folder.parent / f".latest-{os.getpid()}"
    part.unlink(missing_ok=True)
    part.symlink_to(folder, target_is_directory=True)
    part.replace(link)
