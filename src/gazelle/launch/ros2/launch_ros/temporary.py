"""Files that nodes read while the launch runs."""

from __future__ import annotations

import atexit
from functools import cache
from pathlib import Path
from tempfile import NamedTemporaryFile, gettempdir

from gazelle.temporary_files import own_prefix, sweep

__all__ = ["write_temporary"]

_PREFIX = "launch_params_"


def write_temporary(text: str) -> Path:
    """Write a file of parameters that is deleted when the launcher ends.

    ROS 2 leaves it behind; a node that is started again reads it again. What a launcher that was
    killed left is deleted by the next one.
    """
    with NamedTemporaryFile(
        mode="w", prefix=own_prefix(_PREFIX), suffix="", delete=False, encoding="utf-8"
    ) as file:
        file.write(text)
    path = Path(file.name)
    _written().append(path)
    return path


@cache
def _written() -> list[Path]:
    files: list[Path] = []
    sweep(Path(gettempdir()), _PREFIX)

    def delete() -> None:
        for path in files:
            path.unlink(missing_ok=True)

    atexit.register(delete)
    return files
