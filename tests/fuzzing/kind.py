"""What a kind of input is: a good one, and what reads it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

from gazelle.diagnostics import Diagnostics
from gazelle.workspace import Workspace

__all__ = ["SCOUT", "Kind"]

SCOUT = Path(__file__).parents[2] / "examples" / "scout_ws" / "src" / "scout_robot"


class Kind(NamedTuple):
    """A kind of file, or of what comes over a wire.

    Attributes:
        good: gives an undamaged one.
        file: its name.
        read: reads one; what is wrong is reported or raised as a `GazelleError`.
    """

    good: Callable[[], bytes]
    file: str
    read: Callable[[Path, Diagnostics, Workspace], object]
