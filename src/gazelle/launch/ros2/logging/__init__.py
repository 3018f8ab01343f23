"""launch's log: the terminal, ``launch.log`` and the processes' own files."""

from __future__ import annotations

import logging
from typing import Any

from gazelle.launch.ros2.logging import handlers
from gazelle.launch.ros2.logging.config import LaunchConfig

__all__ = [
    "LaunchConfig",
    "LaunchLogger",
    "get_logger",
    "get_output_loggers",
    "handlers",
    "launch_config",
    "log_launch_config",
    "reset",
]

_SOURCES = ("stdout", "stderr")
_DESTINATIONS = ("screen", "log", "own_log")
# What the one-word output modes mean.
_MODES: dict[str, dict[str, set[str]]] = {
    "screen": {"both": {"screen"}},
    "log": {"both": {"log"}, "stderr": {"screen"}},
    "both": {"both": {"log", "screen"}},
    "own_log": {"both": {"own_log"}, "stdout": {"own_log"}, "stderr": {"own_log"}},
    "full": {
        "both": {"screen", "log", "own_log"},
        "stdout": {"own_log"},
        "stderr": {"own_log"},
    },
}

launch_config = LaunchConfig()
_configured: dict[str, logging.Logger] = {}


class LaunchLogger(logging.Logger):
    """A logger whose records go to its own handlers only."""

    def __init__(self, name: str, level: int = logging.NOTSET) -> None:
        super().__init__(name, level)
        self.propagate = False


def log_launch_config(*, logger: logging.Logger = logging.root) -> None:
    """Say where log files go and how much is logged."""
    if launch_config.file_handlers:
        logger.info(f"All log files can be found below {launch_config.log_dir}")
    level = logging.getLevelName(logging.root.getEffectiveLevel())
    logger.info(f"Default logging verbosity is set to {level}")


def get_logger(name: str | None = None) -> logging.Logger:
    """Return a logger that writes to the terminal and to ``launch.log``."""
    logger = _logger(name)
    for handler in (launch_config.get_screen_handler(), launch_config.get_log_file_handler()):
        if handler not in logger.handlers:
            logger.addHandler(handler)
    return logger


def get_output_loggers(process_name: str, output_config: Any) -> tuple[logging.Logger, ...]:
    """Return the loggers of a process's standard output and of its standard error.

    Args:
        process_name: such as ``talker-1``.
        output_config: ``screen``, ``log``, ``both``, ``own_log`` or ``full``, or a dictionary of
            ``stdout``, ``stderr``, ``both`` to sets of ``screen``, ``log``, ``own_log``.

    Raises:
        ValueError: there is no such mode, source or destination.
    """
    config = _normalized(output_config)
    return tuple(_output_logger(process_name, source, config) for source in _SOURCES)


def reset() -> None:
    """Forget handlers, formats and the log folder."""
    for logger in _configured.values():
        logger.setLevel(logging.NOTSET)
        logger.handlers.clear()
    _configured.clear()
    launch_config.reset()


def _logger(name: str | None) -> logging.Logger:
    usual = logging.getLoggerClass()
    logging.setLoggerClass(LaunchLogger)
    try:
        logger = logging.getLogger(name)
    finally:
        logging.setLoggerClass(usual)
    logger.propagate = False
    _configured[logger.name] = logger
    return logger


def _normalized(config: Any) -> dict[str, set[str]]:
    normalized: dict[str, set[str]] = {"both": set(), "stdout": set(), "stderr": set()}
    if isinstance(config, str):
        if config not in _MODES:
            raise ValueError(
                f"{config} is not a valid standard output config "
                'i.e. "screen", "log", "both", "own_log" or "full"'
            )
        return {**normalized, **_MODES[config]}
    if not isinstance(config, dict):
        raise ValueError(f"{config} is not a valid output configuration")
    for source, words in config.items():
        if source not in normalized:
            message = 'is not a valid output source i.e. "stdout", "stderr" or "both"'
            raise ValueError(f"{source} {message}")
        normalized[source] = {words} if isinstance(words, str) else set(words)
        for word in sorted(normalized[source] - set(_DESTINATIONS)):
            message = 'is not a valid output destination i.e. "screen", "log" or "own_log"'
            raise ValueError(f"{word} {message}")
    return normalized


def _output_logger(name: str, source: str, config: dict[str, set[str]]) -> logging.Logger:
    logger = _logger(f"{name}-{source}")
    wanted = config["both"] | config[source]
    if "screen" in wanted:
        screen = launch_config.get_screen_handler()
        screen.setFormatterFor(logger, logging.Formatter("{msg}", style="{"))
        _add(logger, screen)
    if "log" in wanted:
        file = launch_config.get_log_file_handler()
        file.setFormatterFor(logger, logging.Formatter("{created:.7f} {msg}", style="{"))
        _add(logger, file)
    if "own_log" in config[source]:
        _add(logger, _own_file(f"{name}-{source}.log"))
    if "own_log" in config["both"]:
        _add(logger, _own_file(f"{name}.log"))
    return logger


def _own_file(file_name: str) -> logging.Handler:
    handler: logging.Handler = launch_config.get_log_file_handler(file_name)
    handler.setFormatter(logging.Formatter("{msg}", style="{"))
    return handler


def _add(logger: logging.Logger, handler: logging.Handler) -> None:
    if handler not in logger.handlers:
        logger.addHandler(handler)
