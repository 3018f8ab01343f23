"""Whether a value is numpy's, asked without importing numpy.

Where nobody has imported it no value is an array. Programs whose messages hold no arrays of
numbers, as most small ones, start in half the time without it.
"""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any, TypeGuard

if TYPE_CHECKING:
    import numpy as np

__all__ = ["is_array", "is_array_item"]


def is_array(value: Any) -> TypeGuard[np.ndarray[Any, Any]]:
    """Tell whether a value is a numpy array, of whatever shape."""
    return isinstance(value, _kind("ndarray"))


def is_array_item(value: Any) -> TypeGuard[np.generic]:
    """Tell whether a value is a single number of numpy's."""
    return isinstance(value, _kind("generic"))


def _kind(name: str) -> Any:
    # Another thread may be importing it just now.
    return getattr(sys.modules.get("numpy"), name, ())
