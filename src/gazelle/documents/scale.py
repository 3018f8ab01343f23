"""One knob for all limits."""

from __future__ import annotations

import math
import os

from gazelle.errors import GazelleError

__all__ = ["HOW_TO_RAISE", "LimitError", "scaled"]

_VARIABLE = "GAZELLE_LIMITS"

HOW_TO_RAISE = f"if the file means it, set the environment variable {_VARIABLE}=10 for ten times"
"""What to do about a limit, for messages."""


class LimitError(GazelleError):
    """The work a file asks for is above a limit."""


def scaled(count: int) -> int:
    """Return a limit times what ``GAZELLE_LIMITS`` says, which is 1 when it is not set.

    Raises:
        GazelleError: the variable is not a number above 0.
    """
    text = os.environ.get(_VARIABLE, "")
    if not text:
        return count
    try:
        factor = float(text)
    except ValueError:
        factor = 0.0
    if not (math.isfinite(factor) and factor > 0):
        raise GazelleError(f"{_VARIABLE}='{text}' is not a number above 0, such as 10")
    return int(count * factor)
