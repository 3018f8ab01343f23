"""The line that rosbag draws while it rewrites a bag."""

from __future__ import annotations

import shutil
import sys
import time

from gazelle.cli.rosbag.report import human_size

__all__ = ["ProgressMeter"]

_REST = 37
_PERIOD_S = 1.0


class ProgressMeter:
    """Draws ``name 45% 1.0 KB / 2.0 KB 00:10 ETA`` once a second."""

    def __init__(self, path: str, total: int) -> None:
        """Draw the start."""
        width = shutil.get_terminal_size().columns - _REST
        self._name = path if len(path) <= width else f"...{path[3 - width :]}"
        self._width = width
        self._total = total
        self._start_s = self._drawn_s = time.monotonic()
        self._draw(0, 0.0)

    def step(self, size: int) -> None:
        """Tell how many bytes are done."""
        now_s = time.monotonic()
        if now_s - self._drawn_s > _PERIOD_S:
            self._drawn_s = now_s
            self._draw(size, now_s - self._start_s)

    def finish(self) -> None:
        """Draw the end."""
        self._draw(self._total, time.monotonic() - self._start_s)
        print()

    def _draw(self, size: int, elapsed_s: float) -> None:
        total = human_size(self._total)
        if size >= self._total:
            clock = f"{int(elapsed_s / 60):02d}:{int(elapsed_s % 60):02d}"
            text = f"{self._name:<{self._width}} 100% {total:>19} {clock}    "
        else:
            share = size / self._total
            left_s = elapsed_s * (1 / share - 1) if share else 0.0
            left = f"{int(left_s / 60):02d}:{int(left_s % 60):02d}"
            if not share or left_s > 99 * 60:
                left = "--:--"
            head = f"{self._name:<{self._width}} {int(100 * share):3d}%"
            text = f"{head} {human_size(size):>8} / {total:>8} {left} ETA"
        sys.stdout.write(f"\r {text}")
        sys.stdout.flush()
