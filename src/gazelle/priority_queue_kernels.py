# mypy: ignore-errors
# ruff: noqa: ANN001, ANN201
"""The compiled heap of searches: arrays of keys and of what they stand for, least key first."""

from __future__ import annotations

from gazelle.kernels import kernel

__all__ = ["sift_down", "sift_up"]


@kernel
def sift_up(keys, items, k):
    """Let what was put at the end of a heap, place k, rise."""
    key, item = keys[k], items[k]
    while k > 0:
        parent = (k - 1) >> 1
        if keys[parent] <= key:
            break
        keys[k], items[k] = keys[parent], items[parent]
        k = parent
    keys[k], items[k] = key, item


@kernel
def sift_down(keys, items, count):
    """Put the last of a heap at the top and let it sink; `count` is without it."""
    key, item = keys[count], items[count]
    k = 0
    while True:
        child = 2 * k + 1
        if child >= count:
            break
        if child + 1 < count and keys[child + 1] < keys[child]:
            child += 1
        if keys[child] >= key:
            break
        keys[k], items[k] = keys[child], items[child]
        k = child
    keys[k], items[k] = key, item
