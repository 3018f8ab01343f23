"""``gazelle COMMAND…``, also as ``python -m gazelle.cli``, which ROS-named commands call."""

from __future__ import annotations

from typing import NoReturn

from gazelle.cli.main import main
from gazelle.ending import end_with

__all__ = ["run"]


def run() -> NoReturn:
    """Run the command of the command line and end the process."""
    end_with(main)


if __name__ == "__main__":
    run()
