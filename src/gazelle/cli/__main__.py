"""``gazelle COMMAND…``, also as ``python -m gazelle.cli``, which ROS-named commands call."""

from __future__ import annotations

import os
from typing import NoReturn

from gazelle.process_exit import end_at_interrupts, end_with, raise_interrupts
from gazelle.process_start import collect_garbage_rarely

__all__ = ["run"]


def run() -> NoReturn:
    """Run the command of the command line and end the process."""
    end_at_interrupts()
    collect_garbage_rarely()
    from gazelle.cli.main import main
    from gazelle.python_warnings import shorten_library_warnings

    shorten_library_warnings()
    raise_interrupts()
    if "GAZELLE_PARENT_PID" in os.environ:
        # Started by a launch: most commands are not, and do without the module.
        from gazelle.parent_process import end_with_parent

        end_with_parent()
    end_with(main)


if __name__ == "__main__":
    run()
