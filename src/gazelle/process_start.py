"""What a process of ours saves while it starts: garbage collections, and threads for matrices."""

from __future__ import annotations

import gc
import os

__all__ = ["collect_garbage_rarely", "want_one_blas_thread"]

_YOUNG, _MIDDLE, _OLD = 10_000, 20, 20


def collect_garbage_rarely() -> None:
    """Look for reference cycles after ten thousand new objects instead of 700 (2,000 in 3.12).

    Importing makes many objects and hardly any cycles: about a sixth of a simulator's start.
    """
    gc.set_threshold(_YOUNG, _MIDDLE, _OLD)


def want_one_blas_thread() -> None:
    """Keep NumPy's OpenBLAS from starting a thread per processor, before NumPy is imported.

    A node's matrices are small. The threads cost a tenth of a second of computing at the start,
    and how many there are would change the last digits of sums from machine to machine. Who sets
    the variable is obeyed.
    """
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
