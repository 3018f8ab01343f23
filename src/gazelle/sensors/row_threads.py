"""Rows of a picture shared among threads."""

from __future__ import annotations

import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from itertools import pairwise
from typing import TypeVar

__all__ = ["default_threads", "each_band", "row_bands"]

_BANDS_PER_THREAD = 6

Result = TypeVar("Result")


def default_threads() -> int:
    """Return how many threads a picture takes: the processors there are, at most 4."""
    return max(1, min(4, os.cpu_count() or 1))


def row_bands(rows: int, threads: int, *, multiple: int = 1) -> list[tuple[int, int]]:
    """Cut rows into (first, last + 1) bands, several per thread so that all end together.

    Args:
        rows: how many there are.
        threads: who shares them; one thread gets one band.
        multiple: bands start at multiples of this.
    """
    units = -(-rows // multiple)
    count = 1 if threads == 1 else max(1, min(units, threads * _BANDS_PER_THREAD))
    cuts = [min(rows, units * number // count * multiple) for number in range(count + 1)]
    return list(pairwise(cuts))


def each_band(
    threads: int, bands: list[tuple[int, int]], work: Callable[[int, int], Result]
) -> list[Result]:
    """Run the work on every band and return the results in order."""
    if threads == 1 or len(bands) == 1:
        return [work(first, last) for first, last in bands]
    waiting = [_pool(threads).submit(work, first, last) for first, last in bands]
    return [item.result() for item in waiting]


@cache
def _pool(threads: int) -> ThreadPoolExecutor:
    return ThreadPoolExecutor(threads, thread_name_prefix="gazelle-render")
