"""What a kernel computes compiled, and what the same function does in Python."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from gazelle.kernels import Kernel

__all__ = ["assert_as_in_python", "exact"]


def exact(value: Any) -> Any:
    """Return what is equal only for values of the same type, of floats also the same sign."""
    if isinstance(value, np.ndarray):
        return "array", value.dtype.name, value.shape, exact(tuple(value.ravel().tolist()))
    if isinstance(value, tuple):
        return type(value).__name__, *map(exact, value)
    if isinstance(value, np.generic):
        return exact(value.item())
    if isinstance(value, float):
        return "float", "nan" if math.isnan(value) else value.hex()
    return type(value).__name__, value


def _copied(value: Any) -> Any:
    if isinstance(value, np.ndarray):
        # Also the order in memory, which is another way through the compiler.
        return value.copy(order="K")
    if isinstance(value, tuple):
        items = map(_copied, value)
        return tuple(items) if type(value) is tuple else type(value)(*items)
    return value


def assert_as_in_python(kernel: Kernel, *arguments: Any) -> None:
    """Call a kernel and its function; results and what became of the arguments are the same."""
    here, there = _copied(arguments), _copied(arguments)
    found, expected = kernel(*here), kernel.source.function(*there)
    assert exact(found) == exact(expected), arguments
    assert exact(here) == exact(there), arguments
