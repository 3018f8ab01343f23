"""Lines as nodes of ROS 2 log them."""

from __future__ import annotations

import sys
import time

__all__ = ["say"]

_WORDS = {"warning": "WARN", "warn": "WARN", "error": "ERROR"}


def say(logger: str, level: str, text: str) -> None:
    """Write a line; warnings and errors to stderr."""
    now_ns = time.time_ns()
    word = _WORDS.get(level, "INFO")
    stream = sys.stdout if word == "INFO" else sys.stderr
    stamp = f"{now_ns // 1_000_000_000}.{now_ns % 1_000_000_000:09d}"
    print(f"[{word}] [{stamp}] [{logger}]: {text}", file=stream, flush=True)
