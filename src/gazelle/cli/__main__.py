"""``gazelle COMMAND…``, also as ``python -m gazelle.cli``, which ROS-named commands call."""

from __future__ import annotations

from typing import NoReturn

from gazelle.process_lifetime import (
    collect_garbage_rarely,
    end_at_interrupts,
    end_with,
    end_with_parent,
    raise_interrupts,
)

__all__ = ["run"]


def run() -> NoReturn:
    """Run the command of the command line and end the process."""
    end_at_interrupts()
    collect_garbage_rarely()
    from gazelle.cli.main import main
    from gazelle.python_warnings import shorten_library_warnings

    shorten_library_warnings()
    raise_interrupts()
    end_with_parent()
    end_with(main)


if __name__ == "__main__":
    run()
