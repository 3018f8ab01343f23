"""``python -m gazelle.launch.exec_program COMMAND…`` runs a program that dies with its launcher."""

from __future__ import annotations

import os
import sys

from gazelle.process_lifetime import end_at_interrupts, end_with_parent

__all__ = ["main"]


def main(argv: list[str]) -> int:
    """Replace this process by the command; the parent-death signal survives exec."""
    end_at_interrupts()
    end_with_parent()
    try:
        os.execvp(argv[0], argv)  # noqa: S606 - starting what a launch file names is the purpose
    except OSError as error:
        print(f"cannot run '{argv[0]}': {error.strerror}", file=sys.stderr)  # noqa: T201
        return 127


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
